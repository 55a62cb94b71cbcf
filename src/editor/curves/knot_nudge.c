/// Nudges: the selected knots by keys, in frames and in hundredths of the values in sight.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/picked.h"
#include "editor/curves/curves.h"
#include "editor/curves/view.h"
#include <math.h>

static const double GHOST_SECONDS = 1.2;

/// Kinds of nudges for core_merge_key().
enum nudge_kind { NUDGE_FRAMES = 1, NUDGE_VALUE };

/// The shift itself, or the next multiple of it behind the knots that are in the way; 0 where there is no room, and why.
static double free_shift(const struct core *core, const struct document *document, double frames,
                         char why[STOPPED_SIZE])
{
    for (double shift = frames; frames != 0; shift += frames) {
        enum room room = originals_room(core, document, retime_shift, &shift, NULL);
        if (room == ROOM_FREE) return shift;
        if (room != ROOM_OUTSIDE) continue;
        room_say(room, 0, why);
        break;
    }
    return 0;
}

void curves_nudge(const struct curves *curves, struct core *core, const struct editor_world *world, double frames,
                  double hundredths)
{
    const struct originals *originals = &core->originals;
    if (history_is_open(world->history)) return;
    core_collect(core, world->document, false);
    char why[STOPPED_SIZE] = "";
    double shift = free_shift(core, world->document, frames, why), up = 0.01 * hundredths * core->visible;
    if (*why) core_stopped(core, why);
    if (originals->count == 0 || (shift == 0 && up == 0)) return;
    history_begin(world->history, "Nudge knots",
                  core_merge_key(core, world, frames != 0 ? NUDGE_FRAMES : NUDGE_VALUE));
    for (int i = 0; i < originals->count; i++) {
        // from the far end, so that they do not run into each other
        const struct original *original = &originals->list[shift > 0 ? originals->count - 1 - i : i];
        const double value = up / normal_map(curves, core, original->spline).scale;
        struct edit edit = core_edit_of(EDIT_KNOT_SET, original->spline);
        edit.knot = original->knot;
        edit.knot.frame += shift;
        if (value != 0) edit.knot.value = core_round(edit.knot.value + value, 0.01 * fabs(value));
        core_hold(&world->document->splines[original->spline], &edit.knot, why);
        core_edit(core, world, &edit);
    }
    if (*why) core_stopped(core, why);
    history_end(world->history);
    core->nudged_seconds = GHOST_SECONDS;
    core_edited(core, -1);
}
