/// The part of the scene that is played.
#ifndef EDITOR_CORE_PLAY_RANGE_H
#define EDITOR_CORE_PLAY_RANGE_H

#include "editor/core/state.h"

/// First and last frame that are played: the part that was chosen, as far as the scene has it, else all.
void playback_range(const struct core *core, const struct document *document, double range[2]);
/// Whether less than the whole scene is played.
bool playback_is_part(const struct core *core, const struct document *document);
/// Sets the part; one that is empty or holds everything is none.
void playback_choose(struct core *core, const struct document *document, double first, double last);
/// Says which part is played.
void playback_say_range(struct core *core, const struct document *document);
/// The part begins (end 0) or ends (1) at the playhead's frame.
void playback_mark(struct core *core, const struct editor_world *world, int end);

#endif
