/// Edits that add, copy, remove, move, rename and colour splines.
#include "base/need.h"
#include "scene/editing.h"
#include "scene/order.h"
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Whether one more spline fits.
static bool fits(const struct document *document, const struct spline *added, struct error *error)
{
    const bool limited = spline_is_limited(added) || document_is_limited(document);
    long long total = added->knot_count;
    for (int i = 0; i < document->spline_count; i++) total += document->splines[i]->knot_count;
    if (!document_check_samples(document->spline_count + 1, document_samples(document), limited, error)) return false;
    return total <= SCENE_MAX_KNOTS ||
           fail(error, ERROR_INPUT, "the limit is %d knots over all splines", SCENE_MAX_KNOTS);
}

/// `base`, or the first free one of "base 2", "base 3" …; a number at the end of `base` is replaced.
static char *free_name(const struct document *document, const char *base)
{
    size_t length = strlen(base), stem = length;
    while (stem > 0 && isdigit((unsigned char)base[stem - 1])) stem--;
    bool numbered = stem > 1 && stem < length && base[stem - 1] == ' ';
    if (numbered) length = stem - 1;
    char *name = need(length + 16, 1);
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

/// Where the spline at `index` ends up when the one at `from` moves to `to`.
static int moved_index(int index, int from, int to)
{
    if (index == from) return to;
    if (from < index && index <= to) return index - 1;
    return to <= index && index < from ? index + 1 : index;
}

/// Gives every reference its spline's new index. INT_MAX as `from` or `to` means outside the list.
static void move_references(struct document *document, int from, int to)
{
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        const int now = moved_index(reference.spline, from, to);
        if (now != reference.spline) reference_set(document, &reference, now);
    }
}

/// Puts a spline, with new ids, into the list.
static bool add(struct document *document, int at, struct spline *spline, struct error *error)
{
    if (!fits(document, spline, error)) {
        spline_drop(spline);
        return false;
    }
    spline->id = document->next_spline_id++;
    for (int k = 0; k < spline->knot_count; k++) spline->knots[k].id = document->next_id++;
    document_insert_spline(document, at, spline);
    move_references(document, INT_MAX, at);
    return true;
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

bool edit_spline_add(struct document *document, int at, const char *name, const struct knot *first,
                     struct error *error)
{
    const int count = document->spline_count;
    if (name && !check_name(document, name, -1, error)) return false;
    if (first && !check_first_knot(document, first, error)) return false;
    struct spline *spline = spline_create();
    spline->name = free_name(document, name ? name : "spline");
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        spline->parameter[p].value = parameter_rows[p].fresh;
    }
    spline->knots = need(1, sizeof *spline->knots);
    spline->knot_capacity = 1;
    if (first) {
        spline->knot_count = 1;
        spline->knots[0] = (struct knot){
            .frame = first->frame + 0.0, .value = first->value + 0.0, .stiffness = KNOT_DEFAULT_STIFFNESS};
    }
    return add(document, at < 0 || at > count ? count : at, spline, error);
}

bool edit_spline_copy(struct document *document, int spline, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    struct spline *copy = spline_clone(document->splines[spline]);
    free(copy->name);
    copy->name = free_name(document, document->splines[spline]->name);
    return add(document, spline + 1, copy, error);
}

bool edit_spline_remove(struct document *document, int spline, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    int followers = reference_count(document, spline);
    if (followers > 0) {
        return fail(error, ERROR_INPUT, "%s: still used in %d place%s; remove those first",
                    document->splines[spline]->name, followers, followers == 1 ? "" : "s");
    }
    move_references(document, spline, INT_MAX);
    document_remove_spline(document, spline);
    return true;
}

bool edit_spline_move(struct document *document, int spline, int to, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    if (to < 0 || to >= document->spline_count) return fail(error, ERROR_INPUT, "there is no such place in the list");
    if (to == spline) return true;
    struct spline *moved = spline_hold(document->splines[spline]);
    document_remove_spline(document, spline);
    document_insert_spline(document, to, moved);
    move_references(document, spline, to);
    return true;
}

bool edit_spline_name(struct document *document, int spline, const char *name, struct error *error)
{
    if (!edit_has_spline(document, spline, error) || !check_name(document, name, spline, error)) return false;
    if (strcmp(document->splines[spline]->name, name) == 0) return true;
    struct spline *own = document_own_spline(document, spline);
    char *copy = need_text(name);
    free(own->name);
    own->name = copy;
    return true;
}

bool edit_spline_color(struct document *document, int spline, int color, struct error *error)
{
    if (!edit_has_spline(document, spline, error)) return false;
    if (color < -1 || color > 0xFFFFFF) return fail(error, ERROR_INPUT, "there is no such colour");
    if (document->splines[spline]->color != color) document_own_spline(document, spline)->color = color;
    return true;
}
