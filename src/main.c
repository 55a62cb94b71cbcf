/// Reads the command line and hands over to one command.
#include "base/embedded.h"
#include "base/error.h"
#include "commands/commands.h"
#include "commands/options.h"
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>
#include <wiggly/wiggly.h>

static const struct command {
    const char *name;
    int (*run)(int argc, char **argv);
    const char *operands, *summary;
} commands[] = {
    {"live", command_live, "[scene.json]", "the app; without a scene, a swinging tail"},
    {"solve", command_solve, "scene.json [-o out.csv]", "writes every spline at every sample as CSV"},
    {"rig", command_rig, "in.glb --chain A:B -o scene.json", "gives a character's tail, ears or hair follow-through"},
    {"export", command_export, "scene.json -o FILE", "writes the motion for other programs: .glb, .usda, .csv …"},
    {"check", command_check, "scene.json", "prints every problem in a scene file, or what a .glb holds"},
    {"simulate", command_simulate, "mesh.obj -o sim.npy",
     "shakes a closed mesh as a soft body and records its motion"},
    {"analyze", command_analyze, "up.npy --rest mesh.obj --fps N -o creature.glb",
     "turns motions into a character that splines can drive"},
    {"log", command_log, "FILE.csv [-o FILE.svg]", "summarises the frame times in a timing log"},
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0], SUMMARY_AT = 33 };

static int print_help(void)
{
    printf("wiggly %s: splines that swing, overshoot and follow through\n\n", WIGGLY_VERSION);
    printf("Usage: wiggly [command] [options]\n\nCommands:\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        int length = printf("  %s %s", commands[i].name, commands[i].operands);
        if (length > SUMMARY_AT - 2) length = printf("\n") - 1;
        printf("%*s%s\n", SUMMARY_AT - length, "", commands[i].summary);
    }
    printf("\n  --version                      print version and commit\n"
           "  --licenses                     print the licences of wiggly and its built-in parts\n"
           "  <command> --help               print a command's options\n\n"
           "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 the environment failed.\n");
    return 0;
}

/// Our own licence, then those of what is built in: fonts and header-only libraries.
static int print_licenses(void)
{
    fputs((const char *)embedded_find("LICENSE")->data, stdout);
    for (const struct embedded *file = NULL; (file = embedded_next("licenses/", file));) {
        printf("\n----\n%s, part of this program:\n\n", strchr(file->name, '/') + 1);
        fwrite(file->data, 1, file->size, stdout);
    }
    return 0;
}

static const struct command *find_command(const char *name)
{
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) == 0) return &commands[i];
    }
    return NULL;
}

/// `wiggly scene.json` and `wiggly --headless` mean live; a word that is neither a file nor looks like one is a mistake.
static bool means_live(const char *word) { return word[0] == '-' || strpbrk(word, "./") || access(word, F_OK) == 0; }

static int wrong_command(const char *word)
{
    const char *names[COMMAND_COUNT];
    char shown[256];
    printable(word, shown, sizeof shown);
    for (int i = 0; i < COMMAND_COUNT; i++) names[i] = commands[i].name;
    const char *nearest = options_nearest(word, names, COMMAND_COUNT);
    if (nearest) {
        fprintf(stderr, "wiggly: unknown command %s (did you mean %s?); see wiggly --help\n", shown, nearest);
    } else {
        fprintf(stderr, "wiggly: unknown command %s; see wiggly --help\n", shown);
    }
    return 2;
}

static int run(int argc, char **argv)
{
    static char live[] = "live";
    char *no_arguments[] = {live, NULL};
    if (argc < 2) return command_live(1, no_arguments);
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) return print_help();
    if (strcmp(argv[1], "--version") == 0) {
        printf("wiggly %s (%s)\n", WIGGLY_VERSION, build_commit);
        return 0;
    }
    if (strcmp(argv[1], "--licenses") == 0) return print_licenses();
    const struct command *command = find_command(argv[1]);
    if (command) return command->run(argc - 1, argv + 1);
    if (!means_live(argv[1])) return wrong_command(argv[1]);
    argv[0] = live;
    return command_live(argc, argv);
}

int main(int argc, char **argv)
{
    signal(SIGXFSZ, SIG_IGN); // a file that may not grow is a failed write, with a sentence and nothing half-written
    int status = run(argc, argv);
    bool written = fflush(stdout) == 0 && !ferror(stdout);
    if (written || status != 0) return status;
    fprintf(stderr, "wiggly: cannot write standard output: is the disk full?\n");
    return 3;
}
