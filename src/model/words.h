/// The words of a text file, one after the other. Private to the readers of meshes.
#ifndef MODEL_WORDS_H
#define MODEL_WORDS_H

#include "base/error.h"
#include <stdbool.h>

struct words {
    const char *path;
    char *at; ///< ends in a NUL
    int line; ///< from 1
    struct error *error;
};

/// Goes to the next word, past comments from "#" to the end of a line; false at the end of the text.
bool words_more(struct words *words);

/// Takes the next word if it is this one.
bool words_take(struct words *words, const char *word);
void words_skip_line(struct words *words);

/// Takes a finite number, or a whole one from `least` to `most`. Fails with what was expected.
bool words_number(struct words *words, const char *what, double *number);
bool words_integer(struct words *words, const char *what, long least, long most, long *number);

/// "file:line: expected …, got …"
bool words_expected(struct words *words, const char *what);

#endif
