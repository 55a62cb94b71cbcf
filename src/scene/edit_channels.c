/// Edits of the channels of a tail or chain, and of a character's drives and paint.
#include "base/need.h"
#include "scene/editing.h"
#include <math.h>
#include <string.h>

/// The channel at a place; NULL and an error if there is none.
static const struct channel *find_channel(const struct document *document, struct channel_place at,
                                          struct error *error)
{
    const struct rig *rig = edit_find_rig(document, at.rig, EDIT_BENT, error);
    if (!rig) return NULL;
    if (at.channel >= 0 && at.channel < rig->bent.channel_count) return &rig->bent.channels[at.channel];
    fail(error, ERROR_INPUT, "there is no such channel");
    return NULL;
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
    struct rig *changed = rig_clone(rig);
    *channel_angles(changed, at.channel, kind) = *angles;
    return edit_replace_rig(document, at.rig, changed, error);
}

bool edit_channel(struct document *document, struct channel_place at, const struct channel *channel,
                  struct error *error)
{
    if (!find_channel(document, at, error)) return false;
    struct rig *changed = rig_clone(document->rigs[at.rig]);
    changed->bent.channels[at.channel] = *channel;
    return edit_replace_rig(document, at.rig, changed, error);
}

void edit_append_channel(struct rig *rig, int spline, enum axis axis, enum channel_part of)
{
    const size_t count = (size_t)rig->bent.channel_count;
    rig->bent.channels = need_more(rig->bent.channels, count + 1, sizeof *rig->bent.channels);
    struct channel *channel = &rig->bent.channels[count];
    *channel = (struct channel){.spline = spline, .axis = axis, .of = of};
    channel->lag.value[0] = CHANNEL_DEFAULT_LAG;
    if ((unsigned)axis < AXES) channel->gain.value[0] = axis_gain(axis);
    rig->bent.channel_count++;
}

bool edit_channel_add(struct document *document, int rig, int spline, enum axis axis, enum channel_part of,
                      struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_BENT, error);
    if (!old) return false;
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

static bool put_drives(struct document *document, int rig, struct drive *drives, int count, struct error *error)
{
    struct rig wanted = *document->rigs[rig];
    wanted.character.drives = drives;
    wanted.character.drive_count = count;
    return edit_rig_set(document, rig, &wanted, error);
}

/// Copies a character's drives into `drives`. Returns how many there are; −1 and an error if it is no character.
static int take_drives(const struct document *document, int rig, struct drive drives[CHARACTER_MAX_DRIVES + 1],
                       struct error *error)
{
    const struct character_rig *character = find_character(document, rig, error);
    if (!character) return -1;
    for (int i = 0; i < character->drive_count; i++) drives[i] = character->drives[i];
    return character->drive_count;
}

bool edit_drive(struct document *document, int rig, int index, const struct drive *drive, struct error *error)
{
    struct drive drives[CHARACTER_MAX_DRIVES + 1];
    const int count = take_drives(document, rig, drives, error);
    if (count < 0) return false;
    if (index < -1 || index >= count) return fail(error, ERROR_INPUT, "this character has no such coordinate");
    struct drive *own = &drives[index < 0 ? count : index];
    char *const name = index < 0 ? drive->name : own->name; // the coordinate keeps its name
    *own = *drive;
    own->name = name;
    return put_drives(document, rig, drives, count + (index < 0), error);
}

bool edit_drive_remove(struct document *document, int rig, int index, struct error *error)
{
    struct drive drives[CHARACTER_MAX_DRIVES + 1];
    const int count = take_drives(document, rig, drives, error);
    if (count < 0) return false;
    if (index < 0 || index >= count) return fail(error, ERROR_INPUT, "this character has no such coordinate");
    memmove(&drives[index], &drives[index + 1], (size_t)(count - 1 - index) * sizeof *drives);
    return put_drives(document, rig, drives, count - 1, error);
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
