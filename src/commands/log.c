/// `wiggly log`: summarises a timing log, as text and as a picture.
#include "base/file.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "timing/distribution.h"
#include <errno.h>
#include <stdio.h>
#include <string.h>

static bool draw(const struct timing_log *log, const char *name, const char *path, struct error *error)
{
    struct file_output output;
    if (!file_output_open(&output, path, error)) return false;
    distribution_draw(log, name, output.stream);
    return file_output_commit(&output, error);
}

int command_log(int argc, char **argv)
{
    const char *path, *picture = NULL;
    const struct option_spec options[] = {
        {"--output", "-o", "FILE.svg", "also draw the distribution", OPTION_TEXT, &picture, 0, 0},
    };
    const struct usage usage = {
        .command = "log",
        .operands = "FILE.csv",
        .summary = "Prints percentiles, frames over budget, a histogram and the slowest frames of a timing log.",
        .options = options,
        .option_count = 1,
        .operand_minimum = 1,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &path);
    if (result != OPTIONS_RUN) return (int)result;
    struct timing_log log;
    struct error error = {0};
    bool good = timing_log_read(path, &log, &error);
    if (good) {
        distribution_print(&log, path, stdout);
        good = !picture || draw(&log, path, picture, &error);
        timing_log_free(&log);
    }
    if (good) return 0;
    fprintf(stderr, "%s\n", error.text);
    return (int)error.kind;
}
