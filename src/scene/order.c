/// Sorts splines by their dependencies, finds cycles, and visits every reference to a spline in a document.
#include "scene/order.h"
#include "base/need.h"
#include "scene/fields.h"
#include <stdlib.h>
#include <string.h>

enum { UNSEEN = 0, DONE = PARAMETER_COUNT + 2 }; ///< of order_space.next; between them 1 + the next parameter

bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic)
{
    enum wiggly_mode mode = cubic ? WIGGLY_CUBIC : spline_mode(spline);
    return parameter_rows[parameter].modes >> mode & 1;
}

bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle)
{
    int ordered = 0;
    if (document->spline_count > 0) memset(space.next, UNSEEN, (size_t)document->spline_count);
    for (int root = 0; root < document->spline_count; root++) {
        // A search depth first; not recursive, because a chain of tracks may be as long as the scene.
        if (space.next[root] != UNSEEN) continue;
        int depth = 0;
        space.stack[0] = root;
        space.next[root] = 1;
        while (depth >= 0) {
            int spline = space.stack[depth];
            int parameter = space.next[spline] - 1;
            if (parameter == PARAMETER_COUNT) {
                space.next[spline] = DONE;
                order[ordered++] = spline;
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

void scene_followers(const struct document *document, int spline, bool *followers, int count)
{
    for (int s = 0; s < count; s++) followers[s] = s == spline;
    for (bool more = true; more;) {
        more = false;
        for (int s = 0; s < count; s++) {
            for (int p = 0; p < PARAMETER_COUNT && !followers[s]; p++) {
                const int track = document->splines[s]->parameter[p].track;
                if (track >= 0 && track < count && followers[track]) followers[s] = more = true;
            }
        }
    }
}

bool reference_next(const struct document *document, struct reference *reference)
{
    if (reference->kind == REFERENCE_TRACK) {
        for (; reference->owner < document->spline_count; reference->owner++, reference->number = 0) {
            while (reference->number < PARAMETER_COUNT) {
                reference->which = reference->number++;
                reference->spline = document->splines[reference->owner]->parameter[reference->which].track;
                if (reference->spline >= 0) return true;
            }
        }
        *reference = (struct reference){.kind = REFERENCE_CHANNEL};
    }
    for (; reference->owner < document->rig_count; reference->owner++, reference->number = 0) {
        int inputs, channels;
        const struct rig *rig = document->rigs[reference->owner];
        const int splines = fields_splines(rig_fields(rig), rig, &inputs);
        const enum reference_kind of_input = rig_channels(rig, &channels) ? REFERENCE_CHANNEL : REFERENCE_DRIVE;
        while (reference->number < splines) {
            const int n = reference->number++;
            reference->kind = n < inputs ? of_input : REFERENCE_POSITION;
            reference->which = n < inputs ? n : n - inputs;
            reference->spline = fields_spline(rig_fields(rig), rig, n);
            if (reference->spline >= 0) return true;
        }
    }
    return false;
}

void reference_set(struct document *document, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_TRACK) {
        document_own_spline(document, reference->owner)->parameter[reference->which].track = spline;
        return;
    }
    struct rig *rig = document_own_rig(document, reference->owner);
    fields_set_spline(rig_fields(rig), rig, reference->number - 1, spline);
}

int reference_count(const struct document *document, int spline)
{
    int count = 0;
    for (struct reference reference = {0}; reference_next(document, &reference);) count += reference.spline == spline;
    return count;
}
