/// Which knots are selected: a bit for each id, so that membership costs nothing in a drag of thousands.
#include "editor/core/selection.h"
#include "base/need.h"
#include <string.h>

bool selection_has(const struct selection *selection, unsigned id)
{
    return id < selection->capacity && (selection->bits[id / 64] >> (id % 64) & 1u);
}

/// Room for the ids below `end`, and for some more: ids are given in turn.
static void reserve(struct selection *selection, unsigned end)
{
    if (end <= selection->capacity) return;
    const unsigned capacity = (end / 512 + 2) * 512;
    selection->bits = need_more(selection->bits, capacity / 64, sizeof *selection->bits);
    memset((char *)selection->bits + selection->capacity / 8, 0, (capacity - selection->capacity) / 8);
    selection->capacity = capacity;
}

void selection_set(struct selection *selection, unsigned id, bool selected)
{
    if (selected) reserve(selection, id + 1);
    if (id >= selection->capacity) return;
    selection->changes++;
    uint64_t bit = UINT64_C(1) << (id % 64);
    if (selected) {
        selection->bits[id / 64] |= bit;
    } else {
        selection->bits[id / 64] &= ~bit;
    }
}

void selection_clear(struct selection *selection)
{
    if (selection->bits) memset(selection->bits, 0, selection->capacity / 8);
    selection->changes++;
}

void selection_drop_from(struct selection *selection, unsigned id)
{
    for (; id < selection->capacity; id++) selection_set(selection, id, false);
}

int selection_count(const struct selection *selection, const struct spline *spline)
{
    int count = 0;
    for (int k = 0; spline && k < spline->knot_count; k++) count += selection_has(selection, spline->knots[k].id);
    return count;
}

int selection_single(const struct selection *selection, const struct spline *spline)
{
    int found = -1;
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (!selection_has(selection, spline->knots[k].id)) continue;
        if (found >= 0) return -1;
        found = k;
    }
    return found;
}

void selection_copy(struct selection *to, const struct selection *from)
{
    reserve(to, from->capacity);
    selection_clear(to);
    if (from->bits) memcpy(to->bits, from->bits, from->capacity / 8);
}
