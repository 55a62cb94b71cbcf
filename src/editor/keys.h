/// Maps keys and typed characters to commands. Private to src/editor.
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include "editor/editor.h"

struct command;

/// The command of a key with exactly these modifiers, or with CHORD_TYPED of a typed character. Punctuation is matched as a character
/// because its key depends on the layout; what some layouts type only with AltGr also has a key. NULL: none.
const struct command *keys_command(int key, unsigned mods);
/// Keys that work whatever has the focus; true if used.
bool keys_first(struct editor *editor, const struct event *event);
/// true if used.
bool keys_event(struct editor *editor, const struct event *event);

#endif
