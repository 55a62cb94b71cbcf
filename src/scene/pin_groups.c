/// Finds groups of splines, and the order in which they are solved.
#include "scene/pins.h"

static void merge(int *group, int count, int into, int from)
{
    for (int s = 0; s < count; s++) {
        if (group[s] == from) group[s] = into;
    }
}

static void join(int *group, int count, int a, int b)
{
    if (group[a] < group[b]) {
        merge(group, count, group[a], group[b]);
    } else if (group[b] < group[a]) {
        merge(group, count, group[b], group[a]);
    }
}

void pin_groups_find(const struct document *document, int *group)
{
    for (int s = 0; s < document->spline_count; s++) group[s] = -1;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int inputs = pins_hold_rig(rig) ? rig_input_count(rig) : 0;
        for (int i = 0; i < inputs; i++) {
            const int spline = rig_point_input(rig, i);
            if (spline < 0) continue;
            if (group[spline] < 0) group[spline] = spline;
            join(group, document->spline_count, group[spline], group[rig_point_spline(rig)]);
        }
    }
}

static void visit_chains(const struct document *document, const struct chain *pinned, spline_visitor *visit,
                         void *context)
{
    const int model = document_find_model(document, pinned->model, pinned->by_file);
    for (int r = document_next_rig(document, RIG_CHAIN, 0); r >= 0;
         r = document_next_rig(document, RIG_CHAIN, r + 1)) {
        const struct chain *chain = &document->rigs[r]->chain;
        if (document_find_model(document, chain->model, chain->by_file) != model) continue;
        for (int c = 0; c < chain->channel_count; c++) visit(chain->channels[c].spline, context);
    }
}

/// A visitor that passes on what is not of a group.
struct outside {
    const int *group;
    int which;
    spline_visitor *visit;
    void *context;
};

static void visit_outside(int spline, void *context)
{
    const struct outside *outside = context;
    if (spline >= 0 && outside->group[spline] != outside->which) outside->visit(spline, outside->context);
}

void pin_groups_visit_bases(const struct document *document, const int *group, int which, spline_visitor *visit,
                            void *context)
{
    struct outside outside = {group, which, visit, context};
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = pins_hold_rig(rig) ? rig_point_spline(rig) : -1;
        if (spline < 0 || group[spline] != which) continue;
        for (int k = 0; rig->kind == RIG_TAIL && k < 3; k++) visit_outside(rig->tail.position[k].track, &outside);
        for (int c = 0; rig->kind == RIG_TAIL && c < rig->tail.channel_count; c++) {
            if (rig->tail.channels[c].axis == AXIS_STRETCH) visit_outside(rig->tail.channels[c].spline, &outside);
        }
        if (rig->kind == RIG_CHAIN) visit_chains(document, &rig->chain, visit_outside, &outside);
    }
}

/// One search for an order.
struct ordering {
    const struct document *document;
    const int *group;
    bool *placed;
    int *order, count;
    bool is_lenient; ///< what else moves a group's rigs need not be placed
    bool waits;
    struct pin_cycle cycle;
};

/// Whether a spline's leaders are placed, but for those of its own group.
static bool is_ready(struct ordering *o, int spline)
{
    for (int p = 0; p < PARAMETER_COUNT; p++) {
        const int leader = o->document->splines[spline]->parameter[p].track;
        if (leader < 0 || o->placed[leader]) continue;
        o->cycle = (struct pin_cycle){spline, leader};
        return false;
    }
    return true;
}

static void wait_for(int spline, void *context)
{
    struct ordering *o = context;
    if (!o->placed[spline]) o->waits = true;
}

static bool is_group_ready(struct ordering *o, int which)
{
    for (int s = 0; s < o->document->spline_count; s++) {
        if (o->group[s] == which && !is_ready(o, s)) return false;
    }
    o->waits = false;
    if (!o->is_lenient) pin_groups_visit_bases(o->document, o->group, which, wait_for, o);
    return !o->waits;
}

static void place(struct ordering *o, int spline)
{
    o->placed[spline] = true;
    o->order[o->count++] = spline;
}

/// Places what is ready, or its whole group with it.
static void try_to_place(struct ordering *o, int spline)
{
    const int which = o->group[spline];
    if (o->placed[spline] || !(which < 0 ? is_ready(o, spline) : is_group_ready(o, which))) return;
    if (which < 0) place(o, spline);
    for (int s = 0; which >= 0 && s < o->document->spline_count; s++) {
        if (o->group[s] == which) place(o, s);
    }
    o->is_lenient = false;
}

bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed, int *order,
                      struct pin_cycle *cycle)
{
    const int count = document->spline_count;
    struct ordering o = {.document = document, .group = group, .placed = placed, .order = order};
    for (int s = 0; s < count; s++) placed[s] = false;
    while (o.count < count) {
        const int before = o.count;
        for (int i = 0; i < count; i++) try_to_place(&o, tracked[i]);
        if (o.count > before) continue;
        if (o.is_lenient) {
            *cycle = o.cycle;
            return false;
        }
        o.is_lenient = true;
    }
    return true;
}
