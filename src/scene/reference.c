/// Visits and sets every place where a document names a spline.
#include "scene/reference.h"

void reference_each(const struct document *document, reference_visitor *visit, void *context)
{
    for (int s = 0; s < document->spline_count; s++) {
        for (int i = 0; i < PARAMETER_COUNT; i++) {
            struct reference reference = {REFERENCE_TRACK, s, i, document->splines[s]->parameter[i].track};
            if (reference.spline >= 0) visit(&reference, context);
        }
    }
    for (int i = 0; i < document->rig_count; i++) rig_references(document->rigs[i], i, visit, context);
}

void reference_set(struct document *document, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_TRACK) {
        document_own_spline(document, reference->owner)->parameter[reference->which].track = spline;
    } else {
        rig_set_reference(document_own_rig(document, reference->owner), reference, spline);
    }
}

struct counting {
    int spline, count;
};

static void count_reference(const struct reference *reference, void *context)
{
    struct counting *counting = context;
    counting->count += reference->spline == counting->spline;
}

int reference_count(const struct document *document, int spline)
{
    struct counting counting = {spline, 0};
    reference_each(document, count_reference, &counting);
    return counting.count;
}
