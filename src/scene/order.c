/// Sorts splines by their dependencies, finds cycles, and visits every reference to a spline in a document.
#include "scene/order.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

enum { UNSEEN = 0, DONE = PARAMETER_COUNT + 2 }; ///< of order_space.next; between them 1 + the next parameter

bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic)
{
    enum wiggly_mode mode = cubic ? WIGGLY_CUBIC : spline_mode(spline);
    return parameter_rows[parameter].modes >> mode & 1;
}

/// Depth-first search from one spline; not recursive, because a chain of tracks may be as long as the scene.
static bool visit(const struct document *document, struct order_space space, int root, int *order, int *ordered,
                  struct order_cycle *cycle)
{
    int depth = 0;
    space.stack[0] = root;
    space.next[root] = 1;
    while (depth >= 0) {
        int spline = space.stack[depth];
        int parameter = space.next[spline] - 1;
        if (parameter == PARAMETER_COUNT) {
            space.next[spline] = DONE;
            order[(*ordered)++] = spline;
            depth--;
            continue;
        }
        space.next[spline]++;
        int leader = document->splines[spline]->parameter[parameter].track;
        if (leader < 0 || space.next[leader] == DONE) continue;
        if (space.next[leader] != UNSEEN) {
            *cycle = (struct order_cycle){spline, (enum parameter)parameter};
            return false;
        }
        space.next[leader] = 1;
        space.stack[++depth] = leader;
    }
    return true;
}

bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle)
{
    int ordered = 0;
    if (document->spline_count > 0) memset(space.next, UNSEEN, (size_t)document->spline_count);
    for (int i = 0; i < document->spline_count; i++) {
        if (space.next[i] == UNSEEN && !visit(document, space, i, order, &ordered, cycle)) return false;
    }
    return true;
}

bool scene_has_order(const struct document *document, struct order_cycle *cycle)
{
    size_t count = (size_t)document->spline_count;
    struct order_space space = {need(count, sizeof *space.stack), need(count, 1)};
    int *order = need(count, sizeof *order);
    const bool found = scene_order(document, space, order, cycle);
    free(order);
    free(space.next);
    free(space.stack);
    return found;
}

static bool follows_any(const struct spline *spline, const bool *marked, int count)
{
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        int track = spline->parameter[i].track;
        if (track >= 0 && track < count && marked[track]) return true;
    }
    return false;
}

void scene_followers(const struct document *document, int spline, bool *followers, int count)
{
    for (int s = 0; s < count; s++) followers[s] = s == spline;
    for (bool more = true; more;) {
        more = false;
        for (int s = 0; s < count; s++) {
            if (followers[s] || !follows_any(document->splines[s], followers, count)) continue;
            followers[s] = more = true;
        }
    }
}

/// A rig's n-th reference to a spline, its inputs first; NULL: there are no more.
static int *place_in_rig(struct rig *rig, int n)
{
    const int inputs = rig_input_count(rig);
    if (n >= inputs) return rig->kind == RIG_TAIL && n < inputs + 3 ? &rig->tail.position[n - inputs].track : NULL;
    if (rig->kind == RIG_CHARACTER) return &rig->character.drives[n].spline;
    return &rig->bent.channels[n].spline;
}

static bool next_in_rig(struct rig *rig, struct reference *reference)
{
    const int inputs = rig_input_count(rig);
    for (const int *place; (place = place_in_rig(rig, reference->number)) != NULL;) {
        const int n = reference->number++;
        const enum reference_kind of_input = rig->kind == RIG_CHARACTER ? REFERENCE_DRIVE : REFERENCE_CHANNEL;
        reference->kind = n < inputs ? of_input : REFERENCE_POSITION;
        reference->which = n < inputs ? n : n - inputs;
        reference->spline = *place;
        if (*place >= 0) return true;
    }
    return false;
}

static bool next_track(const struct spline *spline, struct reference *reference)
{
    while (reference->number < PARAMETER_COUNT) {
        reference->which = reference->number++;
        reference->spline = spline->parameter[reference->which].track;
        if (reference->spline >= 0) return true;
    }
    return false;
}

bool reference_next(const struct document *document, struct reference *reference)
{
    if (reference->kind == REFERENCE_TRACK) {
        for (; reference->owner < document->spline_count; reference->owner++, reference->number = 0) {
            if (next_track(document->splines[reference->owner], reference)) return true;
        }
        *reference = (struct reference){.kind = REFERENCE_CHANNEL};
    }
    for (; reference->owner < document->rig_count; reference->owner++, reference->number = 0) {
        if (next_in_rig(document->rigs[reference->owner], reference)) return true;
    }
    return false;
}

void reference_set(struct document *document, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_TRACK) {
        document_own_spline(document, reference->owner)->parameter[reference->which].track = spline;
    } else {
        *place_in_rig(document_own_rig(document, reference->owner), reference->number - 1) = spline;
    }
}

int reference_count(const struct document *document, int spline)
{
    int count = 0;
    for (struct reference reference = {0}; reference_next(document, &reference);) count += reference.spline == spline;
    return count;
}
