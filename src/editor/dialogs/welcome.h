/// The card with what to try first.
#ifndef EDITOR_DIALOGS_WELCOME_H
#define EDITOR_DIALOGS_WELCOME_H

#include "editor/dialogs/state.h"

/// Where the card is.
struct rect welcome_card(const struct core *core);
/// A press on the card takes it away and is used up; so do Esc, an edit and the help.
bool welcome_event(struct dialogs *dialogs, const struct core *core, const struct event *event);

#endif
