/// Which knots are selected: a bit for each id, so that membership costs nothing in a drag of thousands.
#include "editor/core/selection.h"
#include <stdlib.h>
#include <string.h>

bool selection_has(const struct selection *selection, unsigned id)
{
    return id < selection->capacity && (selection->bits[id / 64] >> (id % 64) & 1u);
}

void selection_set(struct selection *selection, unsigned id, bool selected)
{
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

bool selection_reserve(struct selection *selection, unsigned next_id)
{
    if (next_id < selection->capacity) return true;
    unsigned capacity = (next_id / 512 + 2) * 512;
    uint64_t *bits = realloc(selection->bits, capacity / 8);
    if (!bits) return false;
    memset((char *)bits + selection->capacity / 8, 0, (capacity - selection->capacity) / 8);
    selection->bits = bits;
    selection->capacity = capacity;
    return true;
}

void selection_copy(struct selection *to, const struct selection *from)
{
    unsigned ids = to->capacity < from->capacity ? to->capacity : from->capacity;
    if (ids > 0) memcpy(to->bits, from->bits, ids / 8);
    to->changes++;
}
