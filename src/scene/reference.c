/// Goes through all places where a document names a spline, and sets them.
#include "scene/order.h"

/// The n-th place of a rig that may name a spline, its inputs first; NULL: there are no more.
static int *place_in_rig(struct rig *rig, int n)
{
    const int inputs = rig_input_count(rig);
    if (n >= inputs) return rig->kind == RIG_TAIL && n < inputs + 3 ? &rig->tail.position[n - inputs].track : NULL;
    if (rig->kind == RIG_CHARACTER) return &rig->character.drives[n].spline;
    return rig->kind == RIG_MEADOW ? &rig->meadow.spline : &rig->bent.channels[n].spline;
}

static bool next_in_rig(struct rig *rig, struct reference *reference)
{
    const int inputs = rig_input_count(rig);
    for (const int *place; (place = place_in_rig(rig, reference->number)) != NULL;) {
        const int n = reference->number++;
        const enum reference_kind of_input = rig->kind == RIG_CHARACTER ? REFERENCE_DRIVE
                                             : rig->kind == RIG_MEADOW  ? REFERENCE_MEADOW
                                                                        : REFERENCE_CHANNEL;
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
