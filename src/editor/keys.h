/// What each key and each typed character does, as tables. Private to src/editor.
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include "editor/editor.h"

/// What a key does: one of these, with its argument.
struct binding {
    int key;       ///< or character
    unsigned mods; ///< exactly these
    bool repeats;  ///< also while the key is kept down
    bool any_time; ///< also while a drag holds a step of the history open
    void (*run)(struct editor *editor, int argument);
    void (*core)(struct core *core, int argument);
    void (*curves)(struct curves *curves, struct core *core, int argument);
    void (*inspector)(struct inspector *inspector);
    const struct knot *(*knot)(struct core *core, int argument); ///< which is to be seen then
    bool pins;                                                   ///< goes from pin to pin where one is selected
    enum request_kind request;                                   ///< its number is the argument
    int argument;
};

/// Up to one that does nothing. Letters are what is printed on a key, digits a place.
extern const struct binding key_bindings[];
/// Punctuation, by the character typed: every layout has it on other keys. What AZERTY, QWERTZ or Nordic layouts type only with
/// AltGr has a key as well.
extern const struct binding character_bindings[];

/// Keys and characters; true where the event is used up.
bool keys_event(struct editor *editor, const struct event *event);

#endif
