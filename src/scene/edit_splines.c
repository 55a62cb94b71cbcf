/// Edits that add, copy, remove, move, rename and colour splines.
#include "scene/edit_plan.h"
#include "scene/order.h"
#include "scene/reference.h"
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Makes room for one more spline, unless there would be too many samples or knots.
static bool reserve_spline(struct document *document, const struct spline *added, struct error *error)
{
    const bool limited = spline_is_limited(added) || document_is_limited(document);
    long long total = added->knot_count;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i].knot_count;
    if (!document_check_samples(document->spline_count + 1, document_samples(document), limited, error)) return false;
    if (total > SCENE_MAX_KNOTS) {
        return fail(error, ERROR_INPUT, "the limit is %d knots over all splines", SCENE_MAX_KNOTS);
    }
    if (document->spline_count < document->spline_capacity) return true;
    int capacity = document->spline_capacity > 0 ? 2 * document->spline_capacity : 8;
    struct spline *splines = realloc(document->splines, (size_t)capacity * sizeof *splines);
    if (!splines) return plan_no_memory(error);
    document->splines = splines;
    document->spline_capacity = capacity;
    return true;
}

/// `base`, or the first free one of "base 2", "base 3" …; a number at the end of `base` is replaced.
static char *free_name(const struct document *document, const char *base)
{
    size_t length = strlen(base), stem = length;
    while (stem > 0 && isdigit((unsigned char)base[stem - 1])) stem--;
    bool numbered = stem > 1 && stem < length && base[stem - 1] == ' ';
    if (numbered) length = stem - 1;
    char *name = malloc(length + 16);
    if (!name) return NULL;
    memcpy(name, base, length);
    name[length] = '\0';
    for (int number = 2; document_find_spline(document, name) >= 0; number++) {
        snprintf(name + length, 16, " %d", number);
    }
    return name;
}

static bool check_name(const struct document *document, const char *name, int own, struct error *error)
{
    int other = document_find_spline(document, name);
    if (!name[0]) return fail(error, ERROR_INPUT, "a spline needs a name");
    if (other < 0 || other == own) return true;
    return fail(error, ERROR_INPUT, "a spline called %s already exists", name);
}

/// Adds a spline with new ids to the plan, which owns it even if this fails.
static bool add_spline(struct document *document, int at, struct spline *held, struct change_list *list,
                       struct error *error)
{
    struct change change = {.kind = CHANGE_SPLINE_OUT, .spline = at, .held = held};
    held->id = document->next_spline_id;
    for (int k = 0; k < held->knot_count; k++) held->knots[k].id = document->next_id + (unsigned)k;
    if (!plan_add(list, &change, error)) return false;
    document->next_spline_id++;
    document->next_id += (unsigned)held->knot_count;
    return true;
}

/// A spline outside the document with room for `knots`; takes over `name`. NULL if memory runs out.
static struct spline *hold_spline(char *name, int knots)
{
    struct spline *held = name ? calloc(1, sizeof *held) : NULL;
    if (!held) {
        free(name);
        return NULL;
    }
    held->name = name;
    held->knots = calloc((size_t)knots + 1, sizeof *held->knots); // never of size 0
    held->knot_capacity = knots + 1;
    if (held->knots) return held;
    free(name);
    free(held);
    return NULL;
}

static bool check_first_knot(const struct document *document, const struct knot *knot, struct error *error)
{
    int sample = document_sample(document, knot->frame);
    if (!isfinite(knot->frame) || !isfinite(knot->value)) {
        return fail(error, ERROR_INPUT, "a knot's numbers must be finite");
    }
    if (sample >= 0 && sample < document_samples(document)) return true;
    return fail(error, ERROR_INPUT, "frame %.10g is outside %d to %d", knot->frame, document->first_frame,
                document->last_frame);
}

bool plan_spline_add(struct document *document, const struct edit *edit, struct change_list *list,
                     struct error *error)
{
    int count = document->spline_count, at = edit->spline < 0 || edit->spline > count ? count : edit->spline;
    if (edit->text && !check_name(document, edit->text, -1, error)) return false;
    if (edit->flag && !check_first_knot(document, &edit->knot, error)) return false;
    struct spline fresh = {.knot_count = edit->flag ? 1 : 0};
    spline_reset(&fresh);
    if (!reserve_spline(document, &fresh, error)) return false;
    struct spline *held = hold_spline(free_name(document, edit->text ? edit->text : "spline"), 1);
    if (!held) return plan_no_memory(error);
    spline_reset(held);
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        held->parameter[p].value = parameter_rows[p].fresh;
    }
    if (edit->flag) {
        held->knot_count = 1;
        held->knots[0] = (struct knot){
            .frame = edit->knot.frame + 0.0, .value = edit->knot.value + 0.0, .stiffness = KNOT_DEFAULT_STIFFNESS};
    }
    return add_spline(document, at, held, list, error);
}

bool plan_spline_copy(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    if (!reserve_spline(document, &document->splines[edit->spline], error)) return false;
    const struct spline *spline = &document->splines[edit->spline];
    struct spline *held = hold_spline(free_name(document, spline->name), spline->knot_count);
    if (!held) return plan_no_memory(error);
    char *name = held->name;
    struct knot *knots = held->knots;
    *held = *spline;
    held->name = name;
    held->knots = knots;
    held->knot_capacity = spline->knot_count + 1;
    for (int k = 0; k < spline->knot_count; k++) knots[k] = spline->knots[k];
    return add_spline(document, edit->spline + 1, held, list, error);
}

bool plan_spline_remove(struct document *document, const struct edit *edit, struct change_list *list,
                        struct error *error)
{
    struct change change = {.kind = CHANGE_SPLINE_IN, .spline = edit->spline};
    int followers = reference_count(document, edit->spline);
    if (followers > 0) {
        return fail(error, ERROR_INPUT, "%s: still used in %d place%s; remove those first",
                    document->splines[edit->spline].name, followers, followers == 1 ? "" : "s");
    }
    change.held = calloc(1, sizeof *change.held);
    if (!change.held) return plan_no_memory(error);
    return plan_add(list, &change, error);
}

bool plan_spline_move(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    struct change change = {.kind = CHANGE_SPLINE_MOVE, .spline = edit->spline, .to = edit->to};
    if (edit->to < 0 || edit->to >= document->spline_count) {
        return fail(error, ERROR_INPUT, "there is no such place in the list");
    }
    return edit->to == edit->spline || plan_add(list, &change, error);
}

bool plan_spline_name(struct document *document, const struct edit *edit, struct change_list *list,
                      struct error *error)
{
    struct change change = {.kind = CHANGE_NAME, .spline = edit->spline};
    if (!check_name(document, edit->text, edit->spline, error)) return false;
    if (strcmp(document->splines[edit->spline].name, edit->text) == 0) return true;
    change.name = strdup(edit->text);
    if (!change.name) return plan_no_memory(error);
    return plan_add(list, &change, error);
}

bool plan_spline_color(struct document *document, const struct edit *edit, struct change_list *list,
                       struct error *error)
{
    struct change change = {.kind = CHANGE_COLOR, .spline = edit->spline, .color = edit->color};
    if (edit->color < -1 || edit->color > 0xFFFFFF) return fail(error, ERROR_INPUT, "there is no such colour");
    return document->splines[edit->spline].color == edit->color || plan_add(list, &change, error);
}
