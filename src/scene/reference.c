#include "scene/reference.h"

static void visit_param(struct param *param, struct reference reference, reference_visitor *visit, void *context)
{
    if (param->track < 0) return;
    reference.spline = &param->track;
    visit(&reference, context);
}

void reference_each(struct document *document, reference_visitor *visit, void *context)
{
    for (int s = 0; s < document->spline_count; s++) {
        for (int i = 0; i < PARAMETER_COUNT; i++) {
            struct reference reference = {REFERENCE_TRACK, s, i, NULL};
            visit_param(&document->splines[s].parameter[i], reference, visit, context);
        }
    }
    for (int t = 0; t < document->tail_count; t++) {
        struct tail *tail = &document->tails[t];
        for (int i = 0; i < 3; i++) {
            struct reference reference = {REFERENCE_POSITION, t, i, NULL};
            visit_param(&tail->position[i], reference, visit, context);
        }
        for (int c = 0; c < tail->channel_count; c++) {
            struct reference reference = {REFERENCE_CHANNEL, t, c, &tail->channels[c].spline};
            visit(&reference, context);
        }
    }
    for (int c = 0; c < document->character_count; c++) {
        struct character_rig *rig = &document->characters[c];
        for (int i = 0; i < rig->drive_count; i++) {
            struct reference reference = {REFERENCE_DRIVE, c, i, &rig->drives[i].spline};
            visit(&reference, context);
        }
    }
}

struct counting {
    int spline, count;
};

static void count_reference(const struct reference *reference, void *context)
{
    struct counting *counting = context;
    counting->count += *reference->spline == counting->spline;
}

int reference_count(const struct document *document, int spline)
{
    struct counting counting = {spline, 0};
    reference_each((struct document *)(uintptr_t)document, count_reference, &counting);
    return counting.count;
}
