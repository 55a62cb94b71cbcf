/// The overlay with all keys.
#ifndef EDITOR_DIALOGS_HELP_H
#define EDITOR_DIALOGS_HELP_H

#include "editor/dialogs/state.h"

/// F1 opens it; wheel, ↑ ↓ and PgUp PgDn scroll it; any other key or a click closes it. While it is open help_event() is true
/// for keys, text, buttons and the wheel.
bool help_event(struct dialogs *dialogs, const struct core *core, const struct event *event, bool busy);

#endif
