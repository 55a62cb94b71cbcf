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

/// Marks a spline (−1: none) that is not of the group.
static void mark(const int *group, int which, int spline, bool *bases)
{
    if (spline >= 0 && group[spline] != which) bases[spline] = true;
}

/// All that bends the model of a chain.
static void mark_chains(const struct document *document, const struct chain *pinned, const int *group, int which,
                        bool *bases)
{
    const int model = document_find_model(document, pinned->model, pinned->by_file);
    for (int r = document_next_rig(document, RIG_CHAIN, 0); r >= 0;
         r = document_next_rig(document, RIG_CHAIN, r + 1)) {
        const struct chain *chain = &document->rigs[r]->chain;
        if (document_find_model(document, chain->model, chain->by_file) != model) continue;
        for (int c = 0; c < chain->channel_count; c++) mark(group, which, chain->channels[c].spline, bases);
    }
}

void pin_groups_find_bases(const struct document *document, const int *group, int which, bool *bases)
{
    for (int s = 0; s < document->spline_count; s++) bases[s] = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = pins_hold_rig(rig) ? rig_point_spline(rig) : -1;
        if (spline < 0 || group[spline] != which) continue;
        for (int k = 0; rig->kind == RIG_TAIL && k < 3; k++) mark(group, which, rig->tail.position[k].track, bases);
        for (int c = 0; rig->kind == RIG_TAIL && c < rig->tail.channel_count; c++) {
            if (rig->tail.channels[c].axis == AXIS_STRETCH) mark(group, which, rig->tail.channels[c].spline, bases);
        }
        if (rig->kind == RIG_CHAIN) mark_chains(document, &rig->chain, group, which, bases);
    }
}

/// One search for an order.
struct ordering {
    const struct document *document;
    const int *group;
    bool *placed, *bases;
    int *order, count;
    bool is_lenient; ///< what else moves a group's rigs need not be placed
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

static bool is_group_ready(struct ordering *o, int which)
{
    for (int s = 0; s < o->document->spline_count; s++) {
        if (o->group[s] == which && !is_ready(o, s)) return false;
    }
    if (o->is_lenient) return true;
    pin_groups_find_bases(o->document, o->group, which, o->bases);
    for (int s = 0; s < o->document->spline_count; s++) {
        if (o->bases[s] && !o->placed[s]) return false;
    }
    return true;
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

bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed,
                      bool *bases, int *order, struct pin_cycle *cycle)
{
    const int count = document->spline_count;
    struct ordering o = {.document = document, .group = group, .placed = placed, .bases = bases, .order = order};
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
