/// The keyboard: from keys and typed characters to commands. Private to src/editor.
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include "editor/editor.h"

struct command;

/// The command of a key with exactly these modifiers, or with CHORD_TYPED of a typed character: every layout has punctuation on other keys,
/// and what AZERTY, QWERTZ or Nordic layouts type only with AltGr has a key as well. NULL: there is none.
const struct command *keys_command(int key, unsigned mods);
/// Keys with one meaning whatever has the focus; true where the event is used up.
bool keys_first(struct editor *editor, const struct event *event);
/// Keys and characters; true where the event is used up.
bool keys_event(struct editor *editor, const struct event *event);

#endif
