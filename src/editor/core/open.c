/// Initial state for a new document.
#include "editor/core/bones.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include <math.h>
#include <string.h>

/// The first active spline: the first that moves something, with its rig as the limb, else the first; -1 if none.
static int first_spline(struct core *core)
{
    const struct document *document = core->document;
    core->limb = 0;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        for (int r = -1; (r = document_next_rig(document, (enum rig_kind)kind, r)) >= 0;) {
            if (rig_input_count(document->rigs[r]) == 0) continue;
            core->limb = document->rigs[r]->id;
            return rig_input(document->rigs[r], 0);
        }
    }
    return document->spline_count > 0 ? 0 : -1;
}

/// Plays scenes that loop, have a clip or a description. Turns on auto-key if a body is animated.
static void open_playback(struct core *core)
{
    const struct document *document = core->document;
    core->seen_first = document->first_frame;
    core->seen_substeps = document->substeps;
    core->playback = (struct playback){
        .looping = true, .speed = 1, .playing = document->about != NULL, .range = {-INFINITY, INFINITY}};
    for (int s = 0; s < document->spline_count; s++)
        core->playback.playing |= spline_start(document->splines[s]) == WIGGLY_LOOP;
    core->auto_key = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        core->playback.playing |= rig->kind == RIG_MODEL && rig->model.clip;
        for (int k = 0; k < 3 && rig->kind == RIG_TAIL; k++) core->auto_key |= rig->tail.position[k].track >= 0;
    }
    if (core->still) core->playback.playing = false;
}

void core_open(struct core *core)
{
    const struct document *document = core->document;
    take_keep(core, false);
    selection_clear(&core->selection);
    selection_clear(&core->hidden);
    selection_clear(&core->solo);
    core->drag = (struct drag){0};
    core->hover = (struct hover){0};
    core->edited = (struct edited){0};
    core->look = LOOK_WIGGLY;
    characters_open(core);
    bones_clear(core);
    pins_clear(core);
    core->pick = (struct bone_pick){0};
    memset(core->recent, 0, sizeof core->recent);
    core->active = first_spline(core);
    core->active_id = core->active >= 0 ? document->splines[core->active]->id : 0;
    core->held_key = 0;
    core->space_down = false;
    core->message = (struct message){0};
    open_playback(core);
    core->serial = document->serial;
    core_set_path(core, document->path ? document->path : "");
}
