/// `wiggly solve`: writes every spline of a scene as CSV.
#include "base/error.h"
#include "base/file.h"
#include "commands/commands.h"
#include "commands/report.h"
#include "rig/import.h"
#include "scene/evaluate.h"
#include "scene/text.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static void write_csv(FILE *out, const struct document *document, const struct evaluation *evaluation)
{
    static const char *const suffixes[] = {"", ".re", ".im"};
    fputs("frame", out);
    for (int i = 0; i < 3 * document->spline_count; i++) {
        fputc(',', out);
        print_field(out, document->splines[i / 3]->name, suffixes[i % 3]);
    }
    fputc('\n', out);
    for (int sample = 0; sample < evaluation->samples && !ferror(out); sample++) {
        char frame[NUMBER_TEXT_SIZE];
        number_print(document_frame(document, sample), frame);
        fputs(frame, out);
        for (int i = 0; i < evaluation->count; i++) {
            const wiggly_curve *curve = &evaluation->curves[i];
            fprintf(out, ",%.17g,%.17g,%.17g", curve->total[sample], curve->re[sample], curve->im[sample]);
        }
        fputc('\n', out);
    }
}

int command_solve(int argc, char **argv)
{
    const char *scene, *out = NULL;
    enum solver_choice solver = SOLVER_BY_LENGTH;
    const struct option_spec options[] = {
        {"-o, --output FILE", "file to write (default: standard output)", OPTION_OUTPUT, &out, 0, 0},
        OPTION_SOLVER(&solver),
        {0},
    };
    const struct usage usage = {
        .command = "solve",
        .operands = "scene.json",
        .summary = "Solves every spline of a scene and writes every sample as CSV: total, Re x, Im x.",
        .options = options,
    };
    const int result = options_parse(&usage, argc, argv, &scene);
    if (result != OPTIONS_RUN) return result;

    struct opened opened;
    struct error error;
    if (!opened_read_splines(&opened, scene, &error)) return options_end(false, &error);
    opened_solve(&opened, solver);
    solution_warnings(opened.document, &opened.evaluation, scene, stderr);
    struct file_output output;
    bool done = true;
    if (!out) {
        write_csv(stdout, opened.document, &opened.evaluation);
        if (ferror(stdout) || fflush(stdout) != 0)
            done = fail(&error, ERROR_ENVIRONMENT, "standard output: cannot be written: %s", strerror(errno));
    } else if ((done = file_output_open(&output, out, &error))) {
        write_csv(output.stream, opened.document, &opened.evaluation);
        done = file_output_commit(&output, &error);
    }
    opened_free(&opened);
    return options_end(done, &error);
}
