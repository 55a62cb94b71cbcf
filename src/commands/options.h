/// The command line of one subcommand, described by a table: parsing, help, and suggestions for misspelt words.
#ifndef COMMANDS_OPTIONS_H
#define COMMANDS_OPTIONS_H

#include "base/error.h"
#include <stdbool.h>

enum option_kind {
    OPTION_FLAG,   ///< bool: set to true; takes no value
    OPTION_TEXT,   ///< const char *: points into argv
    OPTION_OUTPUT, ///< the same, of a file that is written: no two of a command may be one file
    OPTION_LIST,   ///< struct option_list: of texts; may be given several times
    OPTION_INT,    ///< int in [minimum, maximum]
    OPTION_REAL,   ///< double in [minimum, maximum]
    OPTION_SIZE,   ///< int[2] from "1280x720", each in [minimum, maximum]
    OPTION_WORD,   ///< int: which of the words of its argument, "dark|light", from 1
};

enum { OPTION_LIST_MOST = 32 };

struct option_list {
    const char *text[OPTION_LIST_MOST];
    int count;
};

/// One option, `--name value` or `--name=value`. Without the option the target keeps its value.
struct option_spec {
    const char *name;     ///< "--frames"
    const char *alias;    ///< "-f", or NULL
    const char *argument; ///< what help calls the value: "N", or the words that it may be; NULL for a flag
    const char *help;     ///< one line
    enum option_kind kind;
    void *target;
    double minimum, maximum;
};

/// A subcommand's command line.
struct usage {
    const char *command;  ///< "live"
    const char *operands; ///< "scene.json", or "[scene.json]" where it may be left out
    const char *summary;  ///< one line
    const struct option_spec *options;
    int option_count;
    int common_count; ///< --help lists these first ones, --help-all all; 0: both list all
    int operand_maximum;
};

// Options that several commands have; 0: not given.

/// Of an enum solver_choice.
#define OPTION_SOLVER(solver)                                                                                        \
    {                                                                                                                \
        "--solver", NULL, "chain|band", "chain: fast, band: reference (default: band up to 4096 samples)",           \
            OPTION_WORD, solver, 0, 0                                                                                \
    }
/// Of 1 + an enum theme_kind.
#define OPTION_THEME(theme, help)                                                                                    \
    {                                                                                                                \
        "--theme", NULL, "dark|light", help, OPTION_WORD, theme, 0, 0                                                \
    }

/// What options_parse() returns: whether to go on, or the exit status at once.
enum options_result {
    OPTIONS_RUN = -1, ///< go on
    OPTIONS_HELP = 0, ///< --help or --help-all was printed
    OPTIONS_WRONG = 2 ///< a sentence was printed on stderr
};

/// Reads argv[1 …] (argv[0] is the subcommand's name). Options and operands may mix; after `--` all are operands.
/// `operands` has room for usage->operand_maximum pointers; those not given become NULL.
enum options_result options_parse(const struct usage *usage, int argc, char **argv, const char **operands);

/// Prints "wiggly COMMAND: sentence; see wiggly COMMAND --help" on stderr.
enum options_result options_wrong(const struct usage *usage, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Ends a command: prints the error's sentence if it is not done. Returns the exit status.
int options_end(bool done, const struct error *error);

/// The candidate with the smallest edit distance to `word`, or NULL if none is close.
const char *options_nearest(const char *word, const char *const *candidates, int count);

/// "up", "side", "front" or "x,y,z" as a vector of length 1 (y is up, z is to the front); false if it is none of these.
bool options_direction(const char *text, double direction[3]);

#endif
