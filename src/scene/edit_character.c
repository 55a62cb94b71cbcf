/// Edits of what moves a character.
#include "scene/edit_plan.h"
#include <math.h>
#include <string.h>

static const struct character_rig *rig_of(const struct document *document, const struct edit *edit)
{
    return &document->rigs[edit->rig].character;
}

/// A change that leaves the character as it is, for the caller to fill in.
static struct change unchanged(const struct document *document, const struct edit *edit)
{
    const struct character_rig *rig = rig_of(document, edit);
    struct change change = {.kind = CHANGE_DRIVES, .spline = -1};
    change.drives.rig = edit->rig;
    change.drives.count = rig->drive_count;
    memcpy(change.drives.drives, rig->drives, sizeof rig->drives);
    return change;
}

static bool has_drive(const struct document *document, const struct edit *edit, struct error *error)
{
    if (edit->channel >= 0 && edit->channel < rig_of(document, edit)->drive_count) return true;
    return fail(error, ERROR_INPUT, "this character has no such coordinate");
}

static bool check_drive(const struct document *document, const struct drive *drive, struct error *error)
{
    if (!plan_has_spline(document, drive->spline, error)) return false;
    if (isfinite(drive->amplitude) && isfinite(drive->lag)) return true;
    return fail(error, ERROR_INPUT, "amplitude and lag must be finite");
}

bool plan_drive(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    if (!has_drive(document, edit, error) || !check_drive(document, &edit->drive, error)) return false;
    struct change change = unchanged(document, edit);
    struct drive *drive = &change.drives.drives[edit->channel];
    const struct drive old = *drive;
    drive->spline = edit->drive.spline;
    drive->amplitude = edit->drive.amplitude + 0.0;
    drive->lag = edit->drive.lag + 0.0;
    bool same = old.spline == drive->spline && old.amplitude == drive->amplitude && old.lag == drive->lag;
    return same || plan_add(list, &change, error);
}

bool plan_drive_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct change change = unchanged(document, edit);
    if (!edit->drive.name || !edit->drive.name[0]) return fail(error, ERROR_INPUT, "a coordinate needs a name");
    if (!check_drive(document, &edit->drive, error)) return false;
    if (change.drives.count == CHARACTER_MAX_DRIVES) {
        return fail(error, ERROR_INPUT, "a character has at most %d coordinates", CHARACTER_MAX_DRIVES);
    }
    struct drive *drive = &change.drives.drives[change.drives.count++];
    *drive = (struct drive){.name = document_keep_text(document, edit->drive.name),
                            .spline = edit->drive.spline,
                            .amplitude = edit->drive.amplitude + 0.0,
                            .lag = edit->drive.lag + 0.0};
    if (!drive->name) return plan_no_memory(error);
    return plan_add(list, &change, error);
}

bool plan_drive_remove(struct document *document, const struct edit *edit, struct change_list *list,
                       struct error *error)
{
    if (!has_drive(document, edit, error)) return false;
    struct change change = unchanged(document, edit);
    struct drive *gone = &change.drives.drives[edit->channel];
    change.drives.count--;
    memmove(gone, gone + 1, (size_t)(change.drives.count - edit->channel) * sizeof *gone);
    return plan_add(list, &change, error);
}

bool plan_floor(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct character_rig *rig = rig_of(document, edit);
    struct change change = {.kind = CHANGE_FLOOR, .spline = -1};
    change.floor.rig = edit->rig;
    change.floor.is_on = edit->flag;
    change.floor.height = edit->number + 0.0;
    if (!isfinite(edit->number)) return fail(error, ERROR_INPUT, "a floor's height must be finite");
    const bool same = rig->has_floor == edit->flag && rig->floor == change.floor.height;
    return same || plan_add(list, &change, error);
}
