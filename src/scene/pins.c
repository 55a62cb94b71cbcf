/// Keeps pins in order and checks them; finds groups of splines and the order to solve them in.
#include "scene/pins.h"
#include "base/need.h"
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

void pins_insert(struct rig *rig, const struct pin *pin)
{
    rig->pins = need_more(rig->pins, (size_t)rig->pin_count + 1, sizeof *rig->pins);
    int at = rig->pin_count++;
    for (; at > 0; at--) {
        const struct pin *before = &rig->pins[at - 1];
        if (before->frame < pin->frame || (before->frame == pin->frame && before->point <= pin->point)) break;
        rig->pins[at] = *before;
    }
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

int pins_last_sample(const struct document *document, const struct rig *rig)
{
    const int samples = document_samples(document);
    for (int i = 0; i < rig_input_count(rig); i++) {
        const int spline = rig_point_input(rig, i);
        if (spline >= 0 && spline_start(document->splines[spline]) == WIGGLY_LOOP) return samples - 2;
    }
    return samples - 1;
}

static const char *member_that_holds(const struct rig *rig) { return rig->pin_count > 0 ? "pins" : "floor"; }

/// Whether no spline of a pinned rig follows another that is solved together with it, and whether all together take no more than
/// SCENE_MAX_PINNED.
static bool check_order(const struct document *document, struct pin_trouble *trouble)
{
    struct order_cycle tracks;
    struct pin_cycle cycle;
    const size_t count = (size_t)document->spline_count;
    int *group = need(4 * count, sizeof *group), *tracked = group + count, *order = tracked + count;
    unsigned char *next = need(count, 1);
    bool *placed = need(2 * count, sizeof *placed), good = true;
    *trouble = (struct pin_trouble){.pin = -1};
    if (scene_order(document, (struct order_space){order + count, next}, tracked, &tracks)) {
        pin_groups_find(document, group);
        good = pin_groups_order(document, group, tracked, placed, order, &cycle);
        if (good) { // each pin takes a solve of each spline that is solved together with its rig's
            const int samples = document_samples(document);
            long long left = SCENE_MAX_PINNED;
            for (int r = 0; good && r < document->rig_count; r++) {
                const struct rig *rig = document->rigs[r];
                const int held = is_held(rig) ? rig_point_spline(rig) : -1,
                          pins = rig->pin_count + FLOOR_PINS * rig_has_floor(rig);
                int splines = 0;
                for (int s = 0; held >= 0 && s < document->spline_count; s++) splines += group[s] == group[held];
                left -= (long long)pins * splines * samples;
                if (left >= 0) continue;
                *trouble = (struct pin_trouble){.rig = r, .pin = -1, .member = member_that_holds(rig)};
                good = fail(
                    &trouble->error, ERROR_INPUT,
                    "expected at most %d samples over all pins and the splines that each moves, got more: %d pins, "
                    "%d splines and %d samples here (a floor counts as %d pins)",
                    SCENE_MAX_PINNED, pins, splines, samples, FLOOR_PINS);
            }
        } else {
            const bool is_pinned = group[cycle.spline] >= 0;
            const bool together = is_pinned && group[cycle.spline] == group[cycle.leader];
            for (int r = document->rig_count - 1; r >= 0; r--) { // the first pinned rig that the spline moves
                if (is_held(document->rigs[r]) &&
                    rig_is_moved(document->rigs[r], is_pinned ? cycle.spline : cycle.leader))
                    trouble->rig = r;
            }
            trouble->member = member_that_holds(document->rigs[trouble->rig]);
            fail(&trouble->error, ERROR_INPUT, "expected splines %s, got \"%s\", which follows \"%s\"",
                 together ? "that do not follow each other" : "without a cycle",
                 document->splines[cycle.spline]->name, document->splines[cycle.leader]->name);
        }
    }
    free(group);
    free(next);
    free(placed);
    return good;
}

bool pins_check(const struct document *document, struct pin_trouble *trouble)
{
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        for (int i = 0; i < rig->pin_count; i++) {
            const struct pin *pin = &rig->pins[i];
            const int sample = document_sample(document, pin->frame);
            *trouble = (struct pin_trouble){.rig = r, .pin = i, .member = rig_pin_key(rig)};
            if (rig->kind == RIG_TAIL && pin->point >= rig->tail.joints)
                return fail(&trouble->error, ERROR_INPUT, "expected a whole number from 0 to %d, got %d",
                            rig->tail.joints - 1, pin->point);
            trouble->member = "frame";
            if (!document_has_frame(document, pin->frame, pins_last_sample(document, rig), &trouble->error))
                return false;
            for (int k = i - 1; k >= 0 && document_sample(document, rig->pins[k].frame) == sample; k--) {
                if (rig->pins[k].point == pin->point)
                    return fail(&trouble->error, ERROR_INPUT,
                                "expected one pin per point and sample, got another at frame %.10g", pin->frame);
            }
        }

        // A character standing below its floor would need its feet lifted, which no spline does.
        if (rig_has_floor(rig) && rig->model.floor > rig->model.position[1]) {
            *trouble = (struct pin_trouble){.rig = r, .pin = -1, .member = "floor"};
            return fail(&trouble->error, ERROR_INPUT,
                        "expected a height of at most %.10g, which is what the character stands on, got %.10g",
                        rig->model.position[1], rig->model.floor);
        }

        *trouble = (struct pin_trouble){.rig = r, .pin = -1, .member = member_that_holds(rig)};
        for (int i = 0; is_held(rig) && i < rig_input_count(rig); i++) {
            if (rig_point_input(rig, i) < 0) continue;
            const struct spline *spline = document->splines[rig_input(rig, i)];
            const struct param *pull = &spline->parameter[PARAMETER_FREQUENCY];
            const struct param *calm = &spline->parameter[PARAMETER_CALM];
            const char *why = NULL;
            if (calm->track < 0 && calm->value == 0) why = "whose calm is 0";
            if (pull->track < 0 && pull->value == 0) why = "whose frequency is 0";
            if (spline_mode(spline) == WIGGLY_CUBIC) why = "which is cubic";
            if (why)
                return fail(&trouble->error, ERROR_INPUT,
                            "expected splines with a swing of their own, got \"%s\", %s", spline->name, why);
        }
    }
    return !pins_hold_any(document) || check_order(document, trouble);
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
            const int one = group[spline], other = group[rig_point_spline(rig)];
            for (int s = 0; one != other && s < document->spline_count; s++) {
                if (group[s] == (one < other ? other : one)) group[s] = one < other ? one : other;
            }
        }
    }
}

/// Marks a spline (−1: none) outside the group.
static void mark_base(const int *group, int which, int spline, bool *bases)
{
    if (spline >= 0 && group[spline] != which) bases[spline] = true;
}

void pin_groups_find_bases(const struct document *document, const int *group, int which, bool *bases)
{
    for (int s = 0; s < document->spline_count; s++) bases[s] = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        const int spline = is_held(rig) ? rig_point_spline(rig) : -1;
        if (spline < 0 || group[spline] != which) continue;
        for (int k = 0; rig->kind == RIG_TAIL && k < 3; k++)
            mark_base(group, which, rig->tail.position[k].track, bases);
        for (int c = 0; rig->kind == RIG_TAIL && c < rig->tail.channel_count; c++) {
            if (rig->tail.channels[c].axis == AXIS_STRETCH)
                mark_base(group, which, rig->tail.channels[c].spline, bases);
        }
        if (rig->kind != RIG_CHAIN) continue;
        const int model = document_find_model(document, rig->chain.model);
        for (int on = -1; (on = document_next_chain(document, model, on)) >= 0;) { // everything that bends its model
            const struct chain *chain = &document->rigs[on]->chain;
            for (int c = 0; c < chain->channel_count; c++) mark_base(group, which, chain->channels[c].spline, bases);
        }
    }
}

/// One search for an order.
struct ordering {
    const struct document *document;
    const int *group;
    bool *placed, *bases;
    int count;       ///< placed
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

bool pin_groups_order(const struct document *document, const int *group, const int *tracked, bool *placed, int *order,
                      struct pin_cycle *cycle)
{
    const int count = document->spline_count;
    struct ordering o = {.document = document, .group = group, .placed = placed, .bases = placed + count};
    for (int s = 0; s < count; s++) placed[s] = false;
    while (o.count < count) {
        const int before = o.count;
        for (int i = 0; i < count; i++) { // places a spline, or its whole group, if it is ready
            const int spline = tracked[i], which = group[spline];
            if (placed[spline] || !(which < 0 ? is_ready(&o, spline) : is_group_ready(&o, which))) continue;
            for (int s = which < 0 ? spline : 0; s < (which < 0 ? spline + 1 : count); s++) {
                if (group[s] != which) continue;
                placed[s] = true;
                order[o.count++] = s;
            }
            o.is_lenient = false;
        }
        if (o.count > before) continue;
        if (o.is_lenient) {
            *cycle = o.cycle;
            return false;
        }
        o.is_lenient = true;
    }
    return true;
}
