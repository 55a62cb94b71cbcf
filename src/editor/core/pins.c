/// Edits of pins.
#include "editor/core/pins.h"
#include "base/hash.h"
#include "editor/core/core.h"
#include "editor/core/selection.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>

enum pin_nudge { NUDGE_PLACE, NUDGE_FRAME };

static const double RESOLUTION = 1e-4; ///< metres, of saved positions

const struct pin *pins_next(const struct document *document, struct pin_place *place)
{
    place->at++;
    for (; place->rig < document->rig_count && place->at >= document->rigs[place->rig]->pin_count; place->rig++)
        place->at = 0;
    return place->rig < document->rig_count ? &document->rigs[place->rig]->pins[place->at] : NULL;
}

const struct pin *pins_selected(const struct core *core, int *rig)
{
    struct pin_place place = PINS_START;
    const struct pin *pin = NULL;
    while (core->pin.any && (pin = pins_next(core->document, &place)) && pin->id != core->pin.id) continue;
    *rig = place.rig;
    return pin;
}

bool pins_any_selected(const struct core *core)
{
    int rig;
    return pins_selected(core, &rig) != NULL;
}

uint32_t pins_color(const struct document *document, int rig)
{
    const int spline = rig_point_spline(document->rigs[rig]);
    return spline >= 0 ? spline_list_color(document, spline) : theme()->text_dim;
}

/// Selects a pin and deselects knots.
static void pins_select(struct core *core, unsigned id)
{
    selection_clear(&core->selection);
    core->pin = (struct pin_selection){.any = true, .id = id};
}

void pins_visit(struct core *core, const struct pin *pin)
{
    core->playback.playing = false;
    playback_seek(core, pin->frame);
    pins_select(core, pin->id);
}

void pins_clear(struct core *core) { core->pin.any = false; }

double pins_frame_here(const struct core *core, int rig)
{
    const struct document *document = core->document;
    const int sample = document_sample(document, round(core_frame(core)));
    const int last = pins_last_sample(document, document->rigs[rig]);
    return document_frame(document, sample < 0 ? 0 : sample > last ? last : sample);
}

bool pins_set(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    struct pin rounded = *pin;
    for (int k = 0; k < 3; k++) rounded.to[k] = core_round(pin->to[k], RESOLUTION);
    return pin->id == 0 ? edit_pin_add(document, rig, &rounded, error) : edit_pin_set(document, rig, &rounded, error);
}

void pins_tell(struct core *core, int rig)
{
    const struct rig *moved = core->document->rigs[rig];
    for (int i = 0; i < rig_input_count(moved); i++) {
        if (rig_point_input(moved, i) >= 0) core_edited(core, rig_point_input(moved, i));
    }
}

bool pins_put(struct core *core, int rig, int point, double frame, const double to[3])
{
    const struct document *document = core->document;
    const int sample = document_sample(document, frame);
    const int there = pins_find(document, document->rigs[rig], point, sample);
    struct pin pin = {.frame = frame, .point = point};
    if (there >= 0) pin = document->rigs[rig]->pins[there];
    for (int k = 0; k < 3; k++) pin.to[k] = to[k];
    if (!pins_set(core->document, rig, &pin, &core->error)) return false;
    pins_select(core, document->rigs[rig]->pins[pins_find(document, document->rigs[rig], point, sample)].id);
    pins_tell(core, rig);
    return true;
}

void pins_put_here(struct core *core, int rig, int point, const double to[3])
{
    const double frame = pins_frame_here(core, rig);
    if (!core_step(core, "Pin", 0) || !pins_put(core, rig, point, frame, to)) return;
    core_message(core, false, "Pinned at frame %.6g. Drag the marker, or type its place in the section Pins.", frame);
    core->playback.playing = false;
    playback_seek(core, frame);
}

/// Equal nudges of a pin are one undo step.
static uint64_t merge_key(const struct pin *pin, enum pin_nudge kind)
{
    return hash_word(hash_word(HASH_START, (uint64_t)kind), pin->id);
}

void pins_nudge(struct core *core, const double by[3])
{
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    struct pin moved = *pin;
    for (int k = 0; k < 3; k++) moved.to[k] += by[k];
    if (!core_step(core, "Nudge pin", merge_key(pin, NUDGE_PLACE))) return;
    if (pins_set(core->document, rig, &moved, &core->error)) pins_tell(core, rig);
}

void pins_retime(struct core *core, int frames)
{
    int rig;
    const struct document *document = core->document;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin) return;
    struct pin moved = *pin;
    int sample;
    do {
        moved.frame += frames;
        sample = document_sample(document, moved.frame);
        if (sample < 0 || sample > pins_last_sample(document, document->rigs[rig])) return;
    } while (pins_find(document, document->rigs[rig], pin->point, sample) >= 0);
    if (!core_step(core, "Move pin in time", merge_key(pin, NUDGE_FRAME))) return;
    if (!pins_set(core->document, rig, &moved, &core->error)) return;
    playback_seek(core, moved.frame);
    pins_tell(core, rig);
}

void pins_delete(struct core *core)
{
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin || !core_step(core, "Delete pin", 0)) return;
    if (edit_pin_remove(core->document, rig, pin->id, &core->error)) pins_clear(core);
}

/// Orders by frame, then id.
static bool is_before(const struct pin *a, const struct pin *b)
{
    return a->frame != b->frame ? a->frame < b->frame : a->id < b->id;
}

void pins_select_neighbour(struct core *core, int direction)
{
    int rig;
    const struct pin *from = pins_selected(core, &rig), *best = NULL;
    struct pin_place place = PINS_START;
    for (const struct pin *pin; from && (pin = pins_next(core->document, &place));) {
        if (pin == from || is_before(pin, from) == (direction > 0)) continue;
        if (!best || is_before(pin, best) == (direction > 0)) best = pin;
    }
    if (best) pins_visit(core, best);
}
