/// Keeps pins in order and checks them; finds groups of splines and the order to solve them in.
#include "scene/pins.h"
#include "base/need.h"
#include "scene/order.h"
#include <assert.h>
#include <stdlib.h>
#include <string.h>

int pins_count(const struct document *document)
{
    int count = 0;
    for (int r = 0; r < document->rig_count; r++) count += document->rigs[r]->pin_count;
    return count;
}

static bool is_held(const struct rig *rig) { return rig->pin_count > 0 || rig_has_floor(rig); }

bool pins_hold_any(const struct document *document)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (is_held(document->rigs[r])) return true;
    }
    return false;
}

bool pins_move_spline(const struct document *document, int spline)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (is_held(document->rigs[r]) && rig_is_moved(document->rigs[r], spline)) return true;
    }
    return false;
}

int pins_find_id(const struct rig *rig, unsigned id)
{
    for (int i = 0; i < rig->pin_count; i++) {
        if (rig->pins[i].id == id) return i;
    }
    return -1;
}

int pins_find(const struct document *document, const struct rig *rig, int point, int sample)
{
    for (int i = 0; i < rig->pin_count; i++) {
        if (rig->pins[i].point == point && document_sample(document, rig->pins[i].frame) == sample) return i;
    }
    return -1;
}

static bool comes_after(const struct pin *a, const struct pin *b)
{
    return a->frame > b->frame || (a->frame == b->frame && a->point > b->point);
}

void pins_insert(struct rig *rig, const struct pin *pin)
{
    rig->pins = need_more(rig->pins, (size_t)rig->pin_count + 1, sizeof *rig->pins);
    int at = rig->pin_count++;
    for (; at > 0 && comes_after(&rig->pins[at - 1], pin); at--) rig->pins[at] = rig->pins[at - 1];
    rig->pins[at] = *pin;
}

struct pin pins_remove(struct rig *rig, unsigned id)
{
    const int at = pins_find_id(rig, id);
    assert(at >= 0);
    const struct pin pin = rig->pins[at];
    rig->pin_count--;
    memmove(&rig->pins[at], &rig->pins[at + 1], (size_t)(rig->pin_count - at) * sizeof pin);
    return pin;
}

/// An earlier pin of the same point on the same sample, or -1.
static int find_same(const struct document *document, const struct rig *rig, int at)
{
    const struct pin *pin = &rig->pins[at];
    const int sample = document_sample(document, pin->frame);
    for (int i = at - 1; i >= 0 && document_sample(document, rig->pins[i].frame) == sample; i--) {
        if (rig->pins[i].point == pin->point) return i;
    }
    return -1;
}

int pins_last_sample(const struct document *document, const struct rig *rig)
{
    const int samples = document_samples(document);
    for (int i = 0; i < rig_input_count(rig); i++) {
        const int spline = rig_point_input(rig, i);
        if (spline >= 0 && spline_start(document->splines[spline]) == WIGGLY_LOOP) return samples - 2;
    }
    return samples - 1;
}

static bool check_place(const struct document *document, const struct rig *rig, int at, struct pin_trouble *trouble)
{
    const double frame = rig->pins[at].frame;
    const int point = rig->pins[at].point;
    trouble->member = rig_pin_key(rig);
    if (rig->kind == RIG_TAIL && point >= rig->tail.joints)
        return fail(&trouble->error, ERROR_INPUT, "expected a whole number from 0 to %d, got %d",
                    rig->tail.joints - 1, point);
    trouble->member = "frame";
    if (!document_has_frame(document, frame, pins_last_sample(document, rig), &trouble->error)) return false;
    return find_same(document, rig, at) < 0 ||
           fail(&trouble->error, ERROR_INPUT, "expected one pin per point and sample, got another at frame %.10g",
                frame);
}

/// Why pins cannot move a spline; NULL: they can.
static const char *stiffness_of(const struct spline *spline)
{
    const struct param *pull = &spline->parameter[PARAMETER_FREQUENCY];
    if (spline_mode(spline) == WIGGLY_CUBIC) return "which is cubic";
    if (pull->track < 0 && pull->value == 0) return "whose frequency is 0";
    const struct param *calm = &spline->parameter[PARAMETER_CALM];
    return calm->track < 0 && calm->value == 0 ? "whose calm is 0" : NULL;
}

/// A character standing below its floor would need its feet lifted, which no spline does.
static bool check_floor(const struct rig *rig, struct pin_trouble *trouble)
{
    const struct character_rig *character = &rig->character;
    if (rig->kind != RIG_CHARACTER || !character->has_floor || character->floor <= character->position[1])
        return true;
    trouble->member = "floor";
    return fail(&trouble->error, ERROR_INPUT,
                "expected a height of at most %.10g, which is what the character stands on, got %.10g",
                character->position[1], character->floor);
}

static const char *member_that_holds(const struct rig *rig) { return rig->pin_count > 0 ? "pins" : "floor"; }

static bool check_splines(const struct document *document, const struct rig *rig, struct pin_trouble *trouble)
{
    for (int i = 0; i < rig_input_count(rig); i++) {
        if (rig_point_input(rig, i) < 0) continue;
        const struct spline *spline = document->splines[rig_input(rig, i)];
        const char *why = stiffness_of(spline);
        if (why)
            return fail(&trouble->error, ERROR_INPUT, "expected splines with a swing of their own, got \"%s\", %s",
                        spline->name, why);
    }
    return true;
}

bool pins_check(const struct document *document, struct pin_trouble *trouble)
{
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        for (int i = 0; i < rig->pin_count; i++) {
            *trouble = (struct pin_trouble){.rig = r, .pin = i};
            if (!check_place(document, rig, i, trouble)) return false;
        }
        *trouble = (struct pin_trouble){.rig = r, .pin = -1, .member = member_that_holds(rig)};
        if (!check_floor(rig, trouble)) return false;
        if (is_held(rig) && !check_splines(document, rig, trouble)) return false;
    }
    return true;
}

/// The first pinned rig that a spline drives.
static int pinned_rig_of(const struct document *document, int spline)
{
    for (int r = 0; r < document->rig_count; r++) {
        if (is_held(document->rigs[r]) && rig_is_moved(document->rigs[r], spline)) return r;
    }
    return 0;
}

static void name_cycle(const struct document *document, const int *group, const struct pin_cycle *cycle,
                       struct pin_trouble *trouble)
{
    const char *name = document->splines[cycle->spline]->name, *leader = document->splines[cycle->leader]->name;
    const bool is_pinned = group[cycle->spline] >= 0;
    trouble->rig = pinned_rig_of(document, is_pinned ? cycle->spline : cycle->leader);
    trouble->member = member_that_holds(document->rigs[trouble->rig]);
    const bool together = is_pinned && group[cycle->spline] == group[cycle->leader];
    fail(&trouble->error, ERROR_INPUT, "expected splines %s, got \"%s\", which follows \"%s\"",
         together ? "that do not follow each other" : "without a cycle", name, leader);
}

/// Each pin takes a solve of each spline that is solved together with its rig's.
static bool check_work(const struct document *document, const int *group, struct pin_trouble *trouble)
{
    const int samples = document_samples(document);
    long long left = SCENE_MAX_PINNED;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int lead = is_held(rig) ? rig_point_spline(rig) : -1,
                  pins = rig->pin_count + FLOOR_PINS * rig_has_floor(rig);
        int splines = 0;
        for (int s = 0; lead >= 0 && s < document->spline_count; s++) splines += group[s] == group[lead];
        left -= (long long)pins * splines * samples;
        if (left >= 0) continue;
        *trouble = (struct pin_trouble){.rig = r, .pin = -1, .member = member_that_holds(rig)};
        return fail(
            &trouble->error, ERROR_INPUT,
            "expected at most %d samples over all pins and the splines that each moves, got more: %d pins, %d "
            "splines and %d samples here (a floor counts as %d pins)",
            SCENE_MAX_PINNED, pins, splines, samples, FLOOR_PINS);
    }
    return true;
}

bool pins_check_order(const struct document *document, struct pin_trouble *trouble)
{
    struct order_cycle tracks;
    struct pin_cycle cycle;
    if (!pins_hold_any(document)) return true;
    const size_t count = (size_t)document->spline_count;
    int *group = need(4 * count, sizeof *group), *tracked = group + count, *order = tracked + count;
    unsigned char *next = need(count, 1);
    bool *placed = need(2 * count, sizeof *placed), good = true;
    *trouble = (struct pin_trouble){.pin = -1};
    if (scene_order(document, (struct order_space){order + count, next}, tracked, &tracks)) {
        pin_groups_find(document, group);
        good = pin_groups_order(document, group, tracked, placed, placed + count, order, &cycle);
        if (!good) name_cycle(document, group, &cycle, trouble);
        good = good && check_work(document, group, trouble);
    }
    free(group);
    free(next);
    free(placed);
    return good;
}

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
        const int inputs = is_held(rig) ? rig_input_count(rig) : 0;
        for (int i = 0; i < inputs; i++) {
            const int spline = rig_point_input(rig, i);
            if (spline < 0) continue;
            if (group[spline] < 0) group[spline] = spline;
            join(group, document->spline_count, group[spline], group[rig_point_spline(rig)]);
        }
    }
}

/// Marks a spline (−1: none) outside the group.
static void mark(const int *group, int which, int spline, bool *bases)
{
    if (spline >= 0 && group[spline] != which) bases[spline] = true;
}

/// Marks everything that bends the model of a chain.
static void mark_chains(const struct document *document, const struct chain *pinned, const int *group, int which,
                        bool *bases)
{
    const int model = document_find_model(document, pinned->model, pinned->by_file);
    for (int r = -1; (r = document_next_chain(document, model, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        for (int c = 0; c < chain->channel_count; c++) mark(group, which, chain->channels[c].spline, bases);
    }
}

void pin_groups_find_bases(const struct document *document, const int *group, int which, bool *bases)
{
    for (int s = 0; s < document->spline_count; s++) bases[s] = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = is_held(rig) ? rig_point_spline(rig) : -1;
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
    bool is_lenient; ///< splines outside the group that move its rigs need not be placed
    struct pin_cycle cycle;
};

/// Whether all splines that a spline follows are placed, or in its own group.
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

/// Places a spline, or its whole group, if it is ready.
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
