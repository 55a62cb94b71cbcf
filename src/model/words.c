/// Takes words and numbers from a text.
#include "model/surface_readers.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHOWN_MAX = 24 };

void words_skip_line(struct words *w) { w->at += strcspn(w->at, "\n"); }

bool words_more(struct words *w)
{
    for (;; w->at++) {
        if (*w->at == '#') words_skip_line(w);
        if (!*w->at) return false;
        if (*w->at == '\n') w->line++;
        if (!strchr(" \t\r\n\f\v", *w->at)) return true;
    }
}

bool words_expected(struct words *w, const char *what)
{
    if (!words_more(w))
        return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got the end of the file", w->path, w->line, what);
    int shown = (int)strcspn(w->at, " \t\r\n");
    if (shown > SHOWN_MAX) shown = SHOWN_MAX;
    return fail(w->error, ERROR_INPUT, "%s:%d: expected %s, got '%.*s'", w->path, w->line, what, shown, w->at);
}

bool words_take(struct words *w, const char *word)
{
    const size_t length = strlen(word);
    if (!words_more(w) || strncmp(w->at, word, length) != 0 || !strchr(" \t\r\n", w->at[length])) return false;
    w->at += length;
    return true;
}

bool words_number(struct words *w, const char *what, double *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtod(w->at, &end);
    if (end == w->at || !strchr(" \t\r\n", *end) || !(fabs(*number) < 1e38)) return words_expected(w, what);
    w->at = end;
    return true;
}

bool words_integer(struct words *w, const char *what, long least, long most, long *number)
{
    if (!words_more(w)) return words_expected(w, what);
    char *end;
    *number = strtol(w->at, &end, 10);
    if (end == w->at || !strchr(" \t\r\n", *end) || *number < least || *number > most) return words_expected(w, what);
    w->at = end;
    return true;
}
