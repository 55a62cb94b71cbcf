/// The command line of one subcommand, described by a table: parsing, help, and suggestions for misspelt words.
#ifndef COMMANDS_OPTIONS_H
#define COMMANDS_OPTIONS_H

#include "base/error.h"
#include <stdbool.h>

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

/// Prints "wiggly COMMAND: text; see wiggly COMMAND --help" on stderr.
int options_wrong(const struct usage *usage, const char *format, ...) __attribute__((format(printf, 2, 3)));

/// Prints the error unless `done`; returns the exit status.
int options_end(bool done, const struct error *error);

/// The candidate closest to `word`, or NULL if none is close.
const char *options_nearest(const char *word, const char *const *candidates, int count);

/// Parses "up", "side", "front" or "x,y,z" into a unit vector (y up, z to the front); false if it is none of these.
bool options_direction(const char *text, double direction[3]);

#endif
