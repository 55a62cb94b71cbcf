/// Errors of data and of the environment: a kind, which is also the exit status, and one sentence for people.
#ifndef BASE_ERROR_H
#define BASE_ERROR_H

#include <stdarg.h>
#include <stdbool.h>

enum error_kind {
    ERROR_NONE = 0,
    ERROR_INPUT = 1,       ///< a file or an edit was bad
    ERROR_USAGE = 2,       ///< the command line was wrong
    ERROR_ENVIRONMENT = 3, ///< no GL, disk full, no memory
};

struct error {
    enum error_kind kind;
    char text[768]; ///< one sentence, no newline: "file:line: path: expected …, got …"
};

/// Fills `error` (which may be NULL) and returns false, so that callers can write `return fail(…)`.
/// Bytes that are not printable ASCII or valid UTF-8 are replaced by '?'; a text that is too long is cut at a whole character.
bool fail(struct error *error, enum error_kind kind, const char *format, ...) __attribute__((format(printf, 3, 4)));

/// fail() with "what: not enough memory"; `what` is a path or an activity.
bool fail_no_memory(struct error *error, const char *what);

#endif
