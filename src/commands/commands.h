/// The subcommands. argv[0] is the subcommand's name; the result is the exit status: 0 done, 1 bad input, 2 wrong usage, 3 environment
/// failed.
#ifndef COMMANDS_COMMANDS_H
#define COMMANDS_COMMANDS_H

#include "base/error.h"
#include <stdbool.h>

int command_live(int argc, char **argv);
int command_solve(int argc, char **argv);
int command_rig(int argc, char **argv);
int command_export(int argc, char **argv);
int command_check(int argc, char **argv);
int command_simulate(int argc, char **argv);
int command_analyze(int argc, char **argv);
int command_flesh(int argc, char **argv);

// The command line of a subcommand, described by a table: parsing, help, and suggestions for misspelt words.

enum option_kind {
    OPTION_FLAG,   ///< bool: becomes true; no value
    OPTION_TEXT,   ///< const char *: points into argv
    OPTION_INPUT,  ///< the same, a path to read
    OPTION_OUTPUT, ///< a path to write; no other path to read or write, nor an operand, may be the same file
    OPTION_LIST,   ///< struct option_list; may repeat
    OPTION_INT,
    OPTION_REAL,
    OPTION_SIZE, ///< int[2] from "1280x720", each in [minimum, maximum]
    OPTION_WORD, ///< int: index of the given word among "dark|light", from 1
};

enum { OPTION_LIST_MOST = 32 };

struct option_list {
    const char *text[OPTION_LIST_MOST];
    int count;
};

/// An option, `--name value` or `--name=value`. If it is not given, its target stays unchanged.
struct option_spec {
    const char *words; ///< as in help: "-o, --output FILE", "--theme dark|light", "--quiet"
    const char *help;  ///< one line
    enum option_kind kind;
    void *target;
    double minimum, maximum;
};

enum { OPTIONS_MOST = 32 };

/// A subcommand's command line.
struct usage {
    const char *command;               ///< "live"
    const char *operands;              ///< "scene.json", or "[scene.json]" if optional
    const char *summary;               ///< one line
    const struct option_spec *options; ///< up to OPTIONS_MOST, and {0}
    int common_count;                  ///< --help lists this many options, --help-all all; 0: both list all
    int operand_maximum;               ///< 0: 1
};

// Options that several commands share; 0: not given.

/// enum solver_choice.
#define OPTION_SOLVER(solver)                                                                                        \
    {                                                                                                                \
        "--solver chain|band", "chain: fast, band: reference (default: band up to 4096 samples)", OPTION_WORD,       \
            solver, 0, 0                                                                                             \
    }
/// 1 + enum theme_kind.
#define OPTION_THEME(theme, help)                                                                                    \
    {                                                                                                                \
        "--theme dark|light", help, OPTION_WORD, theme, 0, 0                                                         \
    }

/// Whether to go on, or the exit status.
enum {
    OPTIONS_RUN = -1,
    OPTIONS_HELP = 0, ///< --help or --help-all was printed
    OPTIONS_WRONG = 2 ///< an error was printed on stderr
};

/// Parses argv[1 …]; argv[0] is the subcommand's name. Options and operands may mix; after `--` all are operands. `operands` has room for
/// the most of them, NULL where not given. Operands and paths to read are guarded from outputs (file_note_read()).
int options_parse(const struct usage *usage, int argc, char **argv, const char **operands);

/// Prints "wiggly COMMAND: text; see wiggly COMMAND --help" on stderr; `format` is a literal. Returns OPTIONS_WRONG.
#define options_wrong(usage, format, ...)                                                                            \
    (print_line(stderr, "wiggly %s: " format "; see wiggly %s --help", (usage)->command, ##__VA_ARGS__,              \
                (usage)->command),                                                                                   \
     OPTIONS_WRONG)

/// Prints the error unless `done`; returns the exit status.
int options_end(bool done, const struct error *error);

/// The candidate closest to `word`, or NULL if none is close.
const char *options_nearest(const char *word, const char *const *candidates, int count);

/// Parses "up", "side", "front" or "x,y,z" into a unit vector (y up, z to the front); false if it is none of these.
bool options_direction(const char *text, double direction[3]);

#endif
