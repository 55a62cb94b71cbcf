/// Edits of the channels of a tail or chain, and of a character's drives, floor and paint.
#include "base/need.h"
#include "scene/editing.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The channel at a place; NULL refuses the edit.
static const struct channel *find_channel(const struct document *document, struct channel_place at,
                                          struct error *error)
{
    const struct rig *rig = edit_find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return NULL;
    if (at.channel >= 0 && at.channel < rig->bent.channel_count) return &rig->bent.channels[at.channel];
    fail(error, ERROR_INPUT, "there is no such channel");
    return NULL;
}

static bool check_ramp(const struct angles *ramp, struct error *error)
{
    if (ramp->count < 2 || ramp->count > RAMP_MAX_POINTS) {
        return fail(error, ERROR_INPUT, "a ramp has from 2 to %d points", RAMP_MAX_POINTS);
    }
    for (int i = 0; i < ramp->count; i++) {
        const double at = ramp->ramp[i].at;
        if (!(at >= 0 && at <= 1)) return fail(error, ERROR_INPUT, "the places of a ramp are from 0 to 1");
        if (i > 0 && at <= ramp->ramp[i - 1].at) return fail(error, ERROR_INPUT, "the places of a ramp must ascend");
    }
    return true;
}

bool edit_check_angles(const struct rig *rig, const struct angles *angles, struct error *error)
{
    if ((unsigned)angles->form > ANGLES_RAMP) return fail(error, ERROR_INPUT, "there is no such form of angles");
    if (angles->form == ANGLES_RAMP && !check_ramp(angles, error)) return false;
    if (angles->form == ANGLES_EACH && rig->kind == RIG_TAIL && angles->count != rig->tail.joints) {
        return fail(error, ERROR_INPUT, "%s: there must be one angle for each of the %d joints", rig->name,
                    rig->tail.joints);
    }
    if (angles->form == ANGLES_EACH && (angles->count < 1 || angles->count > ANGLES_MAX_JOINTS)) {
        return fail(error, ERROR_INPUT, "there must be from 1 to %d angles", ANGLES_MAX_JOINTS);
    }
    for (int i = 0; i < angles_count(angles); i++) {
        if (!isfinite(angles_number(angles, i))) return fail(error, ERROR_INPUT, "angles must be finite");
    }
    return true;
}

_Static_assert(sizeof(struct ramp_point) == 2 * sizeof(double), "a ramp is places and angles in turn");

static int numbers_of(const struct angles *angles)
{
    return angles_count(angles) * (angles->form == ANGLES_RAMP ? 2 : 1);
}

static bool same_angles(const struct angles *a, const struct angles *b)
{
    bool same = a->form == b->form && angles_count(a) == angles_count(b);
    for (int i = 0; same && i < numbers_of(a); i++) same = a->value[i] == b->value[i];
    return same;
}

static struct angles *channel_angles(struct rig *rig, int channel, enum angle_kind kind)
{
    if (kind == ANGLE_REST) return &rig->tail.rest;
    return kind == ANGLE_LAG ? &rig->bent.channels[channel].lag : &rig->bent.channels[channel].gain;
}

bool edit_angles(struct document *document, struct channel_place at, enum angle_kind kind,
                 const struct angles *angles, struct error *error)
{
    const struct rig *rig = edit_find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return false;
    if (kind == ANGLE_REST && rig->kind != RIG_TAIL)
        return fail(error, ERROR_INPUT, "only a tail has angles at rest");
    if (kind != ANGLE_REST && !find_channel(document, at, error)) return false;
    if (!edit_check_angles(rig, angles, error)) return false;
    struct angles wanted = *angles;
    for (int i = 0; i < numbers_of(&wanted); i++) wanted.value[i] += 0.0;
    if (same_angles(channel_angles(document->rigs[at.rig], at.channel, kind), &wanted)) return true;
    *channel_angles(document_own_rig(document, at.rig), at.channel, kind) = wanted;
    return true;
}

bool edit_check_axis(enum rig_kind kind, enum axis axis, struct error *error)
{
    if ((unsigned)axis >= AXES) return fail(error, ERROR_INPUT, "there is no such axis");
    if (!axis_bends(axis) && kind != RIG_TAIL) return fail(error, ERROR_INPUT, "only a tail's body moves");
    return axis != AXIS_TWIST || kind != RIG_TAIL || fail(error, ERROR_INPUT, "a tail does not twist");
}

bool edit_check_part(enum channel_part part, struct error *error)
{
    return (unsigned)part <= PART_DISPLACEMENT || fail(error, ERROR_INPUT, "there is no such part of a spline");
}

bool edit_axis(struct document *document, struct channel_place at, enum axis axis, struct error *error)
{
    if (!find_channel(document, at, error) || !edit_check_axis(document->rigs[at.rig]->kind, axis, error))
        return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].axis = axis;
    return edit_replace_rig(document, at.rig, changed, error);
}

bool edit_part(struct document *document, struct channel_place at, enum channel_part of, struct error *error)
{
    if (!find_channel(document, at, error) || !edit_check_part(of, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].of = of;
    return edit_replace_rig(document, at.rig, changed, error);
}

bool edit_feed(struct document *document, struct channel_place at, int spline, struct error *error)
{
    if (!find_channel(document, at, error) || !edit_has_spline(document, spline, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel].spline = spline;
    return edit_replace_rig(document, at.rig, changed, error);
}

void edit_append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of)
{
    const size_t count = (size_t)rig->bent.channel_count;
    rig->bent.channels = need_more(rig->bent.channels, count + 1, sizeof *rig->bent.channels);
    struct channel *channel = &rig->bent.channels[count];
    *channel = (struct channel){.spline = spline, .axis = axis, .of = of};
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    channel->gain.value[0] = axis_gain(axis);
    rig->bent.channel_count++;
}

bool edit_channel_add(struct document *document, int rig, int spline, enum axis axis, enum channel_part of,
                      struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_BENT, error);
    if (!old || !edit_has_spline(document, spline, error) || !edit_check_axis(old->kind, axis, error) ||
        !edit_check_part(of, error))
        return false;
    if (old->bent.channel_count >= SCENE_MAX_CHANNELS) {
        return fail(error, ERROR_INPUT, "%s: there are %d channels, and no more fit", rig_title(old),
                    SCENE_MAX_CHANNELS);
    }
    struct rig *changed = rig_clone(old);
    edit_append_channel(changed, spline, axis, of);
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_channel_remove(struct document *document, struct channel_place at, struct error *error)
{
    if (!find_channel(document, at, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    struct channel *gone = &changed->bent.channels[at.channel];
    memmove(gone, gone + 1, (size_t)(--changed->bent.channel_count - at.channel) * sizeof *gone);
    return edit_replace_rig(document, at.rig, changed, error);
}

static const struct character_rig *find_character(const struct document *document, int rig, struct error *error)
{
    const struct rig *found = edit_find_rig(document, rig, EDIT_KIND(RIG_CHARACTER), error);
    return found ? &found->character : NULL;
}

static const struct drive *find_drive(const struct document *document, int rig, int index, struct error *error)
{
    const struct character_rig *character = find_character(document, rig, error);
    if (!character) return NULL;
    if (index >= 0 && index < character->drive_count) return &character->drives[index];
    fail(error, ERROR_INPUT, "this character has no such coordinate");
    return NULL;
}

static bool check_drive(const struct document *document, const struct drive *drive, struct error *error)
{
    if (!edit_has_spline(document, drive->spline, error)) return false;
    if (isfinite(drive->amplitude) && isfinite(drive->lag)) return true;
    return fail(error, ERROR_INPUT, "amplitude and lag must be finite");
}

bool edit_drive(struct document *document, int rig, int index, const struct drive *drive, struct error *error)
{
    if (!find_drive(document, rig, index, error) || !check_drive(document, drive, error)) return false;
    struct rig *changed = rig_clone(document->rigs[rig]);
    struct drive *own = &changed->character.drives[index];
    own->spline = drive->spline;
    own->amplitude = drive->amplitude + 0.0;
    own->lag = drive->lag + 0.0;
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_drive_add(struct document *document, int rig, const char *name, const struct drive *drive,
                    struct error *error)
{
    const struct character_rig *old = find_character(document, rig, error);
    if (!old) return false;
    if (!name || !name[0]) return fail(error, ERROR_INPUT, "a coordinate needs a name");
    if (!check_drive(document, drive, error)) return false;
    if (old->drive_count == CHARACTER_MAX_DRIVES) {
        return fail(error, ERROR_INPUT, "a character has at most %d coordinates", CHARACTER_MAX_DRIVES);
    }
    struct rig *changed = rig_clone(document->rigs[rig]);
    struct character_rig *own = &changed->character;
    own->drives[own->drive_count] = (struct drive){.name = need_text(name),
                                                   .spline = drive->spline,
                                                   .amplitude = drive->amplitude + 0.0,
                                                   .lag = drive->lag + 0.0};
    own->drive_count++;
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_drive_remove(struct document *document, int rig, int index, struct error *error)
{
    if (!find_drive(document, rig, index, error)) return false;
    struct rig *changed = rig_clone(document->rigs[rig]);
    struct character_rig *own = &changed->character;
    struct drive *gone = &own->drives[index];
    free(gone->name);
    memmove(gone, gone + 1, (size_t)(--own->drive_count - index) * sizeof *gone);
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_floor(struct document *document, int rig, bool on, double height, struct error *error)
{
    if (!find_character(document, rig, error)) return false;
    if (!isfinite(height)) return fail(error, ERROR_INPUT, "a floor's height must be finite");
    struct rig *changed = rig_clone(document->rigs[rig]);
    changed->character.has_floor = on;
    changed->character.floor = height + 0.0;
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_paint_new(struct document *document, int rig, int coordinates, int vertices, struct error *error)
{
    if (!find_character(document, rig, error)) return false;
    if (coordinates < 1 || vertices < 1)
        return fail(error, ERROR_INPUT, "there is nothing to paint on this character");
    struct paint *paint = paint_create(coordinates, vertices);
    struct character_rig *own = &document_own_rig(document, rig)->character;
    paint_drop(own->painted);
    own->painted = paint;
    return true;
}

static bool check_dab(const struct paint *paint, const struct dab *dab, struct error *error)
{
    if (!paint) return fail(error, ERROR_INPUT, "this character has no paint yet");
    if (dab->coordinate < 0 || dab->coordinate >= paint->coordinates) {
        return fail(error, ERROR_INPUT, "there is no such coordinate in the paint");
    }
    for (int i = 0; i < dab->count; i++) {
        const float *value = dab->values[i];
        const bool good = fabsf(value[0]) <= PAINT_MOST_SWELL && fabsf(value[1]) <= PAINT_MOST_LEAD;
        if (!good || dab->vertices[i] < 0 || dab->vertices[i] >= paint->vertices) {
            return fail(error, ERROR_INPUT, "paint must be finite, and on the model");
        }
    }
    return true;
}

bool edit_paint(struct document *document, int rig, const struct dab *dab, struct error *error)
{
    const struct character_rig *old = find_character(document, rig, error);
    if (!old || !check_dab(old->painted, dab, error)) return false;
    if (dab->count > 0) paint_dab(&document_own_rig(document, rig)->character.painted, dab);
    return true;
}
