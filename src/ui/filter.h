/// Typing filters lists, the help and the palette.
#ifndef UI_FILTER_H
#define UI_FILTER_H

#include "ui/event.h"

enum { FILTER_SIZE = 48 };

/// The typed text. Empty text matches everything.
struct ui_filter {
    char typed[FILTER_SIZE];
};

/// How well a text matches, better ones larger. Case is ignored; of several words, all must match.
enum fit {
    FIT_NOT,
    FIT_LETTERS, ///< has the letters in order
    FIT_INSIDE,  ///< contains the text
    FIT_WORD,    ///< one of its words starts with the text
    FIT_START    ///< starts with the text
};

enum fit ui_filter_fit(const struct ui_filter *filter, const char *text);
/// The least fit to show if `best` is the best in the list: scattered letters count only without better matches.
enum fit ui_filter_least(enum fit best);
/// Adds a character or handles Backspace; true if used. A filter does not start with a space.
bool ui_filter_event(struct ui_filter *filter, const struct event *event);

#endif
