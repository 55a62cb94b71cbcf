/// `wiggly live`: the live app, in a window or headless; and `wiggly log`, which summarises the timing log that it writes.
#include "app/app.h"
#include "base/progress.h"
#include "commands/commands.h"
#include "commands/options.h"
#include "timing/framelog.h"
#include <stdio.h>

/// Reports once that a large file is being read.
static void show_large(const char *doing, long done, long bytes)
{
    enum { LARGE = 24 << 20 };
    static long told;
    if (done > 0 || bytes < LARGE || bytes == told) return;
    told = bytes;
    fprintf(stderr, "wiggly live: %s of %ld MiB: this takes a while\n", doing, bytes >> 20);
}

int command_live(int argc, char **argv)
{
    struct app_options options = {0};
    int size[2] = {0, 0};
    enum { COMMON = 5 };
    const struct option_spec specs[] = {
        {"--size", NULL, "WxH", "size of the window in logical pixels (1280x720)", OPTION_SIZE, size, 320, 8192},
        {"--ui-scale", NULL, "S", "size of text and controls (default: as last chosen with F8, else 1)", OPTION_REAL,
         &options.ui_scale, 0.75, 3},
        OPTION_THEME(&options.theme, "colours (default: as last chosen with F10, else dark)"),
        {"--demo", NULL, NULL, "show what the app does, in a loop; the first key or click opens the start scene",
         OPTION_FLAG, &options.demo, 0, 0},
        {"--welcome", NULL, NULL, "show what to try first, as on the first start in a window", OPTION_FLAG,
         &options.welcome, 0, 0},
        {"--still", NULL, NULL, "start paused, for those whom motion disturbs", OPTION_FLAG, &options.still, 0, 0},
        {"--headless", NULL, NULL, "draw without a display", OPTION_FLAG, &options.headless, 0, 0},
        {"--no-draw", NULL, NULL, "headless without OpenGL: plays a replay and writes --result", OPTION_FLAG,
         &options.no_draw, 0, 0},
        {"--frames", NULL, "N", "stop after N frames (default: the replay's length; headless 1200)", OPTION_INT,
         &options.frames, 1, 10000000},
        {"--scale", NULL, "S", "device pixels per logical pixel, headless only", OPTION_REAL, &options.scale, 0.5, 4},
        {"--stage-scale", NULL, "S",
         "stage resolution while it moves: auto or 0.25 to 1 (default: auto in a window, else 1)", OPTION_TEXT,
         &options.stage_scale, 0, 0},
        OPTION_SOLVER(&options.solver),
        {"--gl-debug", NULL, NULL, "print the OpenGL driver's messages; fail if it complains", OPTION_FLAG,
         &options.gl_debug, 0, 0},
        {"--log", NULL, "FILE.csv", "write a timing log, one row per frame", OPTION_OUTPUT, &options.log, 0, 0},
        {"--screenshot", NULL, "FILE.png", "save a picture of the last frame", OPTION_OUTPUT, &options.screenshot, 0,
         0},
        {"--frames-dir", NULL, "DIR", "save a PNG of every frame", OPTION_TEXT, &options.frames_dir, 0, 0},
        {"--replay", NULL, "FILE", "play recorded input", OPTION_INPUT, &options.replay, 0, 0},
        {"--saves", NULL, "DIR", "folder for what a replay saves and exports (default: it writes nothing)",
         OPTION_TEXT, &options.saves, 0, 0},
        {"--record", NULL, "FILE", "record all input", OPTION_OUTPUT, &options.record, 0, 0},
        {"--turns", NULL, "first|second", "draw frames in turn with another program (docs/measuring.md)", OPTION_WORD,
         &options.turns, 0, 0},
        {"--result", NULL, "FILE.json", "write the document at the end", OPTION_OUTPUT, &options.result, 0, 0},
    };
    const struct usage usage = {
        .command = "live",
        .operands = "[scene.json]",
        .summary = "The app. Without a scene it opens the fox.",
        .options = specs,
        .option_count = sizeof specs / sizeof *specs,
        .common_count = COMMON,
        .operand_maximum = 1,
    };
    enum options_result result = options_parse(&usage, argc, argv, &options.scene);
    if (result != OPTIONS_RUN) return (int)result;
    if (options.demo && (options.scene || options.replay || options.record))
        return (int)options_wrong(&usage,
                                  "--demo brings its own scene and input: expected no scene, --replay or --record");
    if (options.no_draw && (options.screenshot || options.frames_dir || options.gl_debug))
        return (int)options_wrong(&usage, "--no-draw: expected no --screenshot, --frames-dir or --gl-debug");
    if (options.saves && !options.replay)
        return (int)options_wrong(&usage, "--saves is for what a replay writes: expected --replay, too");
    options.width = size[0];
    options.height = size[1];
    progress_listen(show_large);
    struct error error = {0};
    int status = app_run(&options, &error);
    if (status != 0) fprintf(stderr, "wiggly live: %s\n", error.text);
    return status;
}

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
