/// Another program, run beside this one without a shell.
#ifndef BASE_CHILD_H
#define BASE_CHILD_H

#include <stdio.h>
#include <sys/types.h>

/// Zero: none.
struct child {
    pid_t process; ///< 0: none, or ended and waited for
    FILE *words;   ///< what it writes to standard error
};

/// Starts a program from PATH, shielded from the terminal's Ctrl+C. `input` and `output` become its standard input and output; −1: ours, and nowhere.
/// Returns 0 or errno. In a browser there are no programs: ENOSYS.
int child_start(struct child *child, char *const *arguments, int input, int output);

enum child_state { CHILD_RUNS, CHILD_DONE, CHILD_FAILED };

/// Whether it has ended, after waiting for that up to so many milliseconds. Its words stay.
enum child_state child_state(struct child *child, int patience);

/// The last line that it wrote to standard error, or "it was ended".
void child_last_words(const struct child *child, char *words, size_t size);

/// Ends it if it runs, and forgets it. It may first remove what it has half-written.
void child_end(struct child *child);

#endif
