/// Edits of pins.
#include "scene/editing.h"
#include "scene/pins.h"
#include <math.h>

static bool check_numbers(const struct rig *rig, const struct pin *pin, struct error *error)
{
    bool finite = isfinite(pin->frame);
    for (int k = 0; k < 3; k++) finite &= isfinite(pin->to[k]);
    if (!finite) return fail(error, ERROR_INPUT, "%s: a pin's numbers must be finite", rig_title(rig));
    if (pin->point >= 0 && (rig->kind != RIG_TAIL || pin->point < rig->tail.joints)) return true;
    return fail(error, ERROR_INPUT, "%s: there is no point %d to pin", rig_title(rig), pin->point);
}

/// −0 is saved as 0, so it must be 0 in the document, too.
static struct pin without_negative_zeros(struct pin pin)
{
    pin.frame += 0.0;
    for (int k = 0; k < 3; k++) pin.to[k] += 0.0;
    return pin;
}

/// The rig that has the pin; NULL refuses the edit.
static const struct rig *find(const struct document *document, int rig, unsigned id, struct error *error)
{
    const struct rig *found = edit_find_rig(document, rig, EDIT_PINNED, error);
    if (!found || pins_find_id(found, id) >= 0) return found;
    fail(error, ERROR_INPUT, "%s: this pin no longer exists", rig_title(found));
    return NULL;
}

bool edit_pin_add(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    const struct rig *old = edit_find_rig(document, rig, EDIT_PINNED, error);
    struct pin added = without_negative_zeros(*pin);
    if (!old || !check_numbers(old, pin, error)) return false;
    if (pins_count(document) >= SCENE_MAX_PINS)
        return fail(error, ERROR_INPUT, "the limit of %d pins is reached", SCENE_MAX_PINS);
    struct document *before = edit_begin(document);
    added.id = document->next_id++;
    pins_insert(document_own_rig(document, rig), &added);
    return edit_end(document, before, true, error);
}

bool edit_pin_remove(struct document *document, int rig, unsigned id, struct error *error)
{
    if (!find(document, rig, id, error)) return false;
    struct document *before = edit_begin(document);
    pins_remove(document_own_rig(document, rig), id);
    return edit_end(document, before, true, error);
}

static bool same_pin(const struct pin *a, const struct pin *b)
{
    bool same = a->frame == b->frame && a->point == b->point;
    for (int k = 0; k < 3; k++) same &= a->to[k] == b->to[k];
    return same;
}

bool edit_pin_set(struct document *document, int rig, const struct pin *pin, struct error *error)
{
    const struct rig *old = find(document, rig, pin->id, error);
    struct pin changed = without_negative_zeros(*pin);
    if (!old || !check_numbers(old, pin, error)) return false;
    const struct pin *was = &old->pins[pins_find_id(old, pin->id)];
    if (same_pin(was, &changed)) return true;
    changed.extra = was->extra;
    struct document *before = edit_begin(document);
    struct rig *own = document_own_rig(document, rig);
    pins_remove(own, changed.id);
    pins_insert(own, &changed);
    return edit_end(document, before, true, error);
}
