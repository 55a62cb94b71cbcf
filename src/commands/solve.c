/// `wiggly solve`: writes every spline of a scene as CSV.
#include "base/error.h"
#include "base/file.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "commands/report.h"
#include "rig/opened.h"
#include "scene/evaluate.h"
#include "scene/text.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static void write_header(FILE *out, const struct document *document)
{
    static const char *const suffixes[] = {"", ".re", ".im"};
    fputs("frame", out);
    for (int i = 0; i < document->spline_count; i++) {
        for (int k = 0; k < 3; k++) {
            fputc(',', out);
            print_field(out, document->splines[i]->name, suffixes[k]);
        }
    }
    fputc('\n', out);
}

static void write_row(FILE *out, const struct document *document, const struct evaluation *evaluation, int sample)
{
    char frame[NUMBER_TEXT_SIZE];
    number_print(document_frame(document, sample), frame);
    fputs(frame, out);
    for (int i = 0; i < evaluation->count; i++) {
        const wiggly_curve *curve = &evaluation->curves[i];
        fprintf(out, ",%.17g,%.17g,%.17g", curve->total[sample], curve->re[sample], curve->im[sample]);
    }
    fputc('\n', out);
}

static void write_csv(FILE *out, const struct document *document, const struct evaluation *evaluation)
{
    write_header(out, document);
    for (int i = 0; i < evaluation->samples && !ferror(out); i++) write_row(out, document, evaluation, i);
}

static bool write_output(const char *path, const struct document *document, const struct evaluation *evaluation,
                         struct error *error)
{
    if (!path) {
        write_csv(stdout, document, evaluation);
        if (!ferror(stdout) && fflush(stdout) == 0) return true;
        return fail(error, ERROR_ENVIRONMENT, "standard output: cannot be written: %s", strerror(errno));
    }
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    write_csv(output.stream, document, evaluation);
    return file_output_commit(&output, error);
}

static void warn(void *user, const char *sentence)
{
    const char *const *scene = user;
    print_line(stderr, "%s: warning: %s", *scene, sentence);
}

static bool solve(const char *scene, enum solver_choice solver, const char *out, struct error *error)
{
    struct opened opened;
    if (!opened_read_splines(&opened, scene, error)) return false;
    opened_solve(&opened, solver);
    solution_warnings(opened.document, &opened.evaluation, warn, &scene);
    const bool done = write_output(out, opened.document, &opened.evaluation, error);
    opened_free(&opened);
    return done;
}

int command_solve(int argc, char **argv)
{
    const char *scene, *out = NULL;
    enum solver_choice solver = SOLVER_BY_LENGTH;
    const struct option_spec options[] = {
        {"--output", "-o", "FILE", "file to write (default: standard output)", OPTION_OUTPUT, &out, 0, 0},
        OPTION_SOLVER(&solver),
    };
    const struct usage usage = {
        .command = "solve",
        .operands = "scene.json",
        .summary = "Solves every spline of a scene and writes every sample as CSV: total, Re x, Im x.",
        .options = options,
        .option_count = sizeof options / sizeof *options,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &scene);
    if (result != OPTIONS_RUN) return (int)result;
    struct error error;
    return options_end(solve(scene, solver, out, &error), &error);
}
