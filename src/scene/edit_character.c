/// Edits of what moves a character, of its floor and of its paint.
#include "base/need.h"
#include "scene/editing.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const struct character_rig *find(const struct document *document, int rig, struct error *error)
{
    const struct rig *found = edit_find_rig(document, rig, EDIT_KIND(RIG_CHARACTER), error);
    return found ? &found->character : NULL;
}

static const struct drive *find_drive(const struct document *document, int rig, int index, struct error *error)
{
    const struct character_rig *character = find(document, rig, error);
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
    const struct character_rig *old = find(document, rig, error);
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
    if (!find(document, rig, error)) return false;
    if (!isfinite(height)) return fail(error, ERROR_INPUT, "a floor's height must be finite");
    struct rig *changed = rig_clone(document->rigs[rig]);
    changed->character.has_floor = on;
    changed->character.floor = height + 0.0;
    return edit_replace_rig(document, rig, changed, error);
}

bool edit_paint_new(struct document *document, int rig, int coordinates, int vertices, struct error *error)
{
    if (!find(document, rig, error)) return false;
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
    const struct character_rig *old = find(document, rig, error);
    if (!old || !check_dab(old->painted, dab, error)) return false;
    if (dab->count > 0) paint_dab(&document_own_rig(document, rig)->character.painted, dab);
    return true;
}
