/// Knots on the clipboard and twice.
#ifndef EDITOR_CORE_CLIPBOARD_H
#define EDITOR_CORE_CLIPBOARD_H

#include "editor/core/state.h"

/// The selected knots as text for the clipboard; `cut` also deletes them. false where there is nothing to copy.
bool core_copy_knots(struct core *core, const struct editor_world *world, bool cut);
/// Knots from text: the first one at the playhead, the others as far behind it as they are in the text; selected. All or, where
/// one would not fit, none.
void core_paste_knots(struct core *core, const struct editor_world *world, const char *text);
/// Copies of the selected knots behind them, selected.
void core_duplicate_knots(struct core *core, const struct editor_world *world);

#endif
