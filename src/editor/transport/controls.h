/// The controls of playback.
#ifndef EDITOR_TRANSPORT_CONTROLS_H
#define EDITOR_TRANSPORT_CONTROLS_H

#include "editor/transport/state.h"

/// Where a control is.
struct rect controls_rect(const struct core *core, enum control control);
/// Returns the controls' right end.
float controls_show(struct core *core);

#endif
