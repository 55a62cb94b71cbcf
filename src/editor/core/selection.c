/// The selected knots: one bit per id, so that lookups are cheap in drags of thousands. Iterates over them, stores them before an edit, and
/// moves them.
#include "editor/core/selection.h"
#include "base/need.h"
#include "editor/core/core.h"
#include <stdio.h>
#include <string.h>

bool selection_has(const struct selection *selection, unsigned id)
{
    return id < selection->capacity && (selection->bits[id / 64] >> (id % 64) & 1u);
}

/// Ids are consecutive, so this reserves some more.
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

/// Hidden knots are not edited, except the active spline's.
static bool is_open(const struct core *core, int spline)
{
    return spline == core->active || spline_list_shows(core, spline);
}

bool selected_next(const struct core *core, struct knot_place *at)
{
    if (at->spline < 0) *at = (struct knot_place){0, -1};
    for (; at->spline < core->document->spline_count; at->spline++, at->knot = -1) {
        const struct spline *spline = core->document->splines[at->spline];
        bool open = at->knot >= 0 || is_open(core, at->spline);
        while (open && ++at->knot < spline->knot_count) {
            if (selection_has(&core->selection, spline->knots[at->knot].id)) return true;
        }
    }
    return false;
}

int selected_count(const struct core *core)
{
    int count = 0;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) count++;
    return count;
}

void selected_settle(struct core *core)
{
    struct knot_place first = SELECTED_START;
    if (selection_count(&core->selection, core_active_spline(core)) > 0) return;
    if (selected_next(core, &first)) core_turn_to(core, first.spline);
}

void originals_add(struct originals *originals, int spline, const struct knot *knot)
{
    if (originals->count == originals->capacity) {
        originals->capacity = 2 * originals->capacity + 64;
        originals->list = need_more(originals->list, (size_t)originals->capacity, sizeof *originals->list);
    }
    originals->list[originals->count++] = (struct original){.spline = spline, .knot = *knot};
}

void core_collect(struct core *core, bool later)
{
    struct originals *originals = &core->originals;
    originals->count = 0;
    for (int s = 0; s < core->document->spline_count; s++) {
        const struct spline *spline = core->document->splines[s];
        bool begun = false;
        if (!is_open(core, s)) continue;
        for (int k = 0; k < spline->knot_count; k++) {
            bool selected = selection_has(&core->selection, spline->knots[k].id);
            begun |= selected;
            if (!selected && !(later && begun)) continue;
            originals_add(originals, s, &spline->knots[k]);
            originals->list[originals->count - 1].value = core_knot_value(core, s, &spline->knots[k]);
        }
    }
}

/// Whether the knot at a sample is one of the originals, which are sorted.
static bool is_original(const struct originals *originals, const struct document *document, int spline, int sample)
{
    int low = 0, high = originals->count;
    while (low < high) {
        int middle = (low + high) / 2;
        const struct original *original = &originals->list[middle];
        int there = document_sample(document, original->knot.frame);
        if (original->spline == spline && there == sample) return true;
        bool before = original->spline < spline || (original->spline == spline && there < sample);
        if (before) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return false;
}

enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE])
{
    const struct document *document = core->document;
    const struct originals *originals = &core->originals;
    enum room room = ROOM_FREE;
    double stopped = 0;
    for (int i = 0, before = 0; i < originals->count && room != ROOM_OUTSIDE; i++) {
        const struct original *original = &originals->list[i];
        const struct spline *spline = document->splines[original->spline];
        const double frame = rule(how, original).frame;
        const int sample = document_sample(document, frame);
        const bool meets = i > 0 && originals->list[i - 1].spline == original->spline && sample == before;
        const bool outside = sample < 0 || sample > document_last_knot_sample(document, spline);
        const bool taken = spline_find_knot(document, spline, sample) >= 0 &&
                           !is_original(originals, document, original->spline, sample);
        if (room == ROOM_FREE) stopped = frame;
        if (meets || taken) room = ROOM_OCCUPIED;
        if (outside) room = ROOM_OUTSIDE;
        before = sample;
    }
    if (room == ROOM_OUTSIDE) snprintf(why, STOPPED_SIZE, "a knot would leave the range");
    if (room == ROOM_OCCUPIED) snprintf(why, STOPPED_SIZE, "a knot would land on another on frame %g", stopped);
    return room;
}

/// Whether a rule reverses the knots' order.
static bool are_reversed(const struct originals *originals, knot_rule *rule, const void *how)
{
    const struct original *list = originals->list;
    for (int i = 1; i < originals->count; i++) {
        if (list[i].spline == list[i - 1].spline) return rule(how, &list[i]).frame < rule(how, &list[i - 1]).frame;
    }
    return false;
}

/// To avoid collisions, knots moving right go first, the last one first. If the order is reversed, all are removed before.
bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE])
{
    const struct originals *originals = &core->originals;
    const bool reversed = are_reversed(originals, rule, how);
    bool done = true;
    for (int i = 0; i < 2 * originals->count && done; i++) {
        const bool first = i < originals->count;
        const int at = first ? originals->count - 1 - i : i - originals->count;
        const struct original *original = &originals->list[at];
        struct knot knot = rule(how, original);
        if (reversed && first) {
            done = edit_knot_remove(core->document, original->spline, knot.id, &core->error);
        } else if (reversed || first == (knot.frame > original->knot.frame)) {
            core_hold(core->document->splines[original->spline], &knot, why);
            done =
                (reversed ? edit_knot_insert : edit_knot_set)(core->document, original->spline, &knot, &core->error);
        }
    }
    return done;
}
