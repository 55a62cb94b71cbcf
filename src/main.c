/// Reads the command line and hands over to one command.
#include "base/embedded.h"
#include "base/error.h"
#include "base/file.h"
#include "commands/commands.h"
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
    bool is_rare; ///< --help-all alone lists it
} commands[] = {
    {"live", command_live, "[scene.json]", "the app; without a scene, with the fox", false},
    {"solve", command_solve, "scene.json [-o out.csv]", "writes every spline at every sample as CSV", true},
    {"rig", command_rig, "in.glb --chain A:B -o scene.json", "gives a character's tail, ears or hair follow-through",
     false},
    {"export", command_export, "scene.json -o FILE", "writes the motion for other programs: .glb, .usda, .csv …",
     false},
    {"check", command_check, "scene.json", "prints every problem in a scene file, or what a .glb holds", false},
    {"simulate", command_simulate, "mesh.obj -o sim.npy", "shakes a mesh as a soft body and records its motion",
     false},
    {"analyze", command_analyze, "up.npy --rest mesh.obj --fps N -o creature.glb",
     "turns motions into a character that splines can drive", false},
    {"flesh", command_flesh, "in.glb -o out.glb", "makes a skinned character soft on its own bones", false},
};

enum { COMMAND_COUNT = sizeof commands / sizeof commands[0], SUMMARY_AT = 33 };

/// `all`: also what few need.
static int print_help(bool all)
{
    printf("wiggly %s: splines that swing, overshoot and follow through\n\n", WIGGLY_VERSION);
    printf("Usage: wiggly [command] [options]\n\nCommands:\n");
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (commands[i].is_rare && !all) continue;
        int length = printf("  %s %s", commands[i].name, commands[i].operands);
        if (length > SUMMARY_AT - 2) length = printf("\n") - 1;
        printf("%*s%s\n", SUMMARY_AT - length, "", commands[i].summary);
    }
    printf("\n  help [command], --help         print this, or the options of a command\n"
           "  --help-all                     print everything, also after a command\n"
           "  --version, -V                  print version and commit\n");
    if (all)
        printf("  --licenses                     print the licences of wiggly and its built-in parts\n\n"
               "Exit status: 0 done, 1 bad input, 2 wrong usage, 3 the environment failed.\n");
    return 0;
}

static const struct command *find_command(const char *name)
{
    for (int i = 0; i < COMMAND_COUNT; i++) {
        if (strcmp(commands[i].name, name) == 0) return &commands[i];
    }
    return NULL;
}

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
    static char live[] = "live", help[] = "--help";
    char *no_arguments[] = {live, NULL};
    if (argc < 2) return command_live(1, no_arguments);
    if (strcmp(argv[1], "help") == 0) { // `wiggly help export` is `wiggly export --help`
        if (argc < 3) return print_help(false);
        const struct command *command = find_command(argv[2]);
        char *arguments[] = {argv[2], help, NULL};
        return command ? command->run(2, arguments) : wrong_command(argv[2]);
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) return print_help(false);
    if (strcmp(argv[1], "--help-all") == 0) return print_help(true);
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        printf("wiggly %s (%s)\n", WIGGLY_VERSION, build_commit);
        return 0;
    }
    if (strcmp(argv[1], "--licenses") ==
        0) { // our own, then those of what is built in: fonts and header-only libraries
        fputs((const char *)embedded_find("LICENSE")->data, stdout);
        for (const struct embedded *file = NULL; (file = embedded_next("licenses/", file));) {
            printf("\n----\n%s, part of this program:\n\n", strchr(file->name, '/') + 1);
            fwrite(file->data, 1, file->size, stdout);
        }
        return 0;
    }
    const struct command *command = find_command(argv[1]);
    if (command) return command->run(argc - 1, argv + 1);
    // `wiggly scene.json` and `wiggly --headless` mean live; a word that is neither a file nor looks like one is a mistake.
    if (argv[1][0] != '-' && !strpbrk(argv[1], "./") && access(argv[1], F_OK) != 0) return wrong_command(argv[1]);
    argv[0] = live;
    return command_live(argc, argv);
}

int main(int argc, char **argv)
{
    signal(SIGXFSZ, SIG_IGN); // a file that may not grow is a failed write, with a sentence and nothing half-written
    file_guard_reads(true);
    int status = run(argc, argv);
    bool written = fflush(stdout) == 0 && !ferror(stdout);
    if (written || status != 0) return status;
    fprintf(stderr, "wiggly: cannot write standard output: is the disk full?\n");
    return 3;
}
