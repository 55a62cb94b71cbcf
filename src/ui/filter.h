/// Typing narrows a list down: lists to choose from, the help and the palette.
#ifndef UI_FILTER_H
#define UI_FILTER_H

#include "ui/event.h"

enum { FILTER_SIZE = 48 };

/// The typed text; zero: empty, which every text matches.
struct ui_filter {
    char typed[FILTER_SIZE];
};

/// How well a text fits, the better the larger. Capitals and small letters are the same; of several words, each must be found.
enum fit {
    FIT_NOT,
    FIT_LETTERS, ///< it has the letters in their order
    FIT_INSIDE,  ///< it holds the text
    FIT_WORD,    ///< a word of it begins so
    FIT_START    ///< it begins so
};

enum fit ui_filter_fit(const struct ui_filter *filter, const char *text);
/// The least fit to show, where `best` is the best one of the list: scattered letters count only if nothing better is there.
enum fit ui_filter_least(enum fit best);
/// A character is added, Backspace takes the last one away; true where the event did either. A filter does not begin with a space.
bool ui_filter_event(struct ui_filter *filter, const struct event *event);

#endif
