/// Edits of pins.
#include "scene/edit_plan.h"
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

bool plan_pin_add(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    struct rig *rig = &document->rigs[edit->rig];
    struct change change = {.kind = CHANGE_PIN_OUT, .spline = -1};
    change.pin.rig = edit->rig;
    change.pin.pin = without_negative_zeros(edit->pin);
    change.pin.pin.id = document->next_id;
    if (!check_numbers(rig, &edit->pin, error)) return false;
    if (pins_count(document) >= SCENE_MAX_PINS)
        return fail(error, ERROR_INPUT, "the limit of %d pins is reached", SCENE_MAX_PINS);
    if (!pins_reserve(rig, 1)) return plan_no_memory(error);
    if (!plan_add(list, &change, error)) return false;
    document->next_id++;
    return true;
}

static bool is_gone(const struct rig *rig, struct error *error)
{
    return fail(error, ERROR_INPUT, "%s: this pin no longer exists", rig_title(rig));
}

bool plan_pin_remove(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error)
{
    const struct rig *rig = &document->rigs[edit->rig];
    struct change change = {.kind = CHANGE_PIN_IN, .spline = -1};
    change.pin.rig = edit->rig;
    change.pin.pin = edit->pin;
    if (pins_find_id(rig, edit->pin.id) < 0) return is_gone(rig, error);
    return plan_add(list, &change, error);
}

static bool same_pin(const struct pin *a, const struct pin *b)
{
    bool same = a->frame == b->frame && a->point == b->point;
    for (int k = 0; k < 3; k++) same &= a->to[k] == b->to[k];
    return same;
}

bool plan_pin_set(struct document *document, const struct edit *edit, struct change_list *list, struct error *error)
{
    const struct rig *rig = &document->rigs[edit->rig];
    struct change change = {.kind = CHANGE_PIN, .spline = -1};
    const int at = pins_find_id(rig, edit->pin.id);
    if (at < 0) return is_gone(rig, error);
    change.pin.rig = edit->rig;
    change.pin.pin = without_negative_zeros(edit->pin);
    change.pin.pin.extra = rig->pins[at].extra;
    if (!check_numbers(rig, &edit->pin, error)) return false;
    return same_pin(&change.pin.pin, &rig->pins[at]) || plan_add(list, &change, error);
}
