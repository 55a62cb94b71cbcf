/// `wiggly log`: summarises a timing log.
#include "commands/commands.h"
#include "commands/options.h"
#include "timing/framelog.h"
#include <stdio.h>

int command_log(int argc, char **argv)
{
    const char *path;
    const struct usage usage = {
        .command = "log",
        .operands = "FILE.csv",
        .summary = "Prints percentiles, frames over budget, a histogram and the slowest frames of a timing log.",
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &path);
    if (result != OPTIONS_RUN) return (int)result;
    struct timing_log log;
    struct error error = {0};
    const bool done = timing_log_read(path, &log, &error);
    if (done) distribution_print(&log, path, stdout);
    timing_log_free(&log);
    return options_end(done, &error);
}
