/// `wiggly live`: the live app, in a window or headless.
#include "app/app.h"
#include "base/progress.h"
#include "commands/commands.h"
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
    struct app_options app = {0};
    int size[2] = {0, 0};
    const struct option_spec options[] = {
        {"--size WxH", "size of the window in logical pixels (1280x720)", OPTION_SIZE, size, 320, 8192},
        {"--ui-scale S", "size of text and controls (default: as last chosen with F8, else 1)", OPTION_REAL,
         &app.ui_scale, 0.75, 3},
        OPTION_THEME(&app.theme, "colours (default: as last chosen with F10, else dark)"),
        {"--welcome", "show what to try first, as on the first start in a window", OPTION_FLAG, &app.welcome, 0, 0},
        {"--still", "start paused, for those whom motion disturbs", OPTION_FLAG, &app.still, 0, 0},
        {"--headless", "draw without a display", OPTION_FLAG, &app.headless, 0, 0},
        {"--no-draw", "headless without OpenGL: plays a replay and writes --result", OPTION_FLAG, &app.no_draw, 0, 0},
        {"--frames N", "stop after N frames (default: the replay's length; headless 1200)", OPTION_INT, &app.frames,
         1, 10000000},
        {"--scale S", "device pixels per logical pixel, headless only", OPTION_REAL, &app.scale, 0.5, 4},
        {"--stage-scale S", "stage resolution while it moves: auto or 0.25 to 1 (default: auto in a window, else 1)",
         OPTION_TEXT, &app.stage_scale, 0, 0},
        OPTION_SOLVER(&app.solver),
        {"--gl-debug", "print the OpenGL driver's messages; fail if it complains", OPTION_FLAG, &app.gl_debug, 0, 0},
        {"--stats", "show frame rate, skipped frames and solve time in the status line", OPTION_FLAG, &app.stats, 0,
         0},
        {"--log FILE.csv", "write a timing log, one row per frame", OPTION_OUTPUT, &app.log, 0, 0},
        {"--screenshot FILE.png", "save a picture of the last frame", OPTION_OUTPUT, &app.screenshot, 0, 0},
        {"--frames-dir DIR", "save a PNG of every frame", OPTION_TEXT, &app.frames_dir, 0, 0},
        {"--replay FILE", "play recorded input", OPTION_INPUT, &app.replay, 0, 0},
        {"--saves DIR", "folder for what a replay saves and exports (default: it writes nothing)", OPTION_TEXT,
         &app.saves, 0, 0},
        {"--record FILE", "record all input", OPTION_OUTPUT, &app.record, 0, 0},
        {"--turns first|second", "draw frames in turn with another program (tools/README.md)", OPTION_WORD,
         &app.turns, 0, 0},
        {"--result FILE.json", "write the document at the end", OPTION_OUTPUT, &app.result, 0, 0},
        {0},
    };
    const struct usage usage = {
        .command = "live",
        .operands = "[scene.json]",
        .summary = "The app. Without a scene it opens the fox.",
        .options = options,
        .common_count = 4,
    };
    const int result = options_parse(&usage, argc, argv, &app.scene);
    if (result != OPTIONS_RUN) return result;
    if (app.no_draw && (app.screenshot || app.frames_dir || app.gl_debug))
        return options_wrong(&usage, "--no-draw: expected no --screenshot, --frames-dir or --gl-debug");
    if (app.saves && !app.replay)
        return options_wrong(&usage, "--saves is for what a replay writes: expected --replay, too");
    app.width = size[0];
    app.height = size[1];
    progress_listen(show_large);
    struct error error = {0};
    int status = app_run(&app, &error);
    if (status != 0) fprintf(stderr, "wiggly live: %s\n", error.text);
    return status;
}
