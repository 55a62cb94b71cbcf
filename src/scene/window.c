/// Keeps a take in step with the document, and reads the visible samples.
#include "scene/window.h"
#include "spline/desc.h"
#include "spline/take.h"

enum { MOST_MOVED = 64 }; ///< knots in one frame: 2 µs each

bool window_serves(const wiggly_desc *desc) { return !desc_has_track(desc) && desc->start != WIGGLY_LOOP; }

static bool same_knot(const wiggly_knot *a, const wiggly_knot *b)
{
    return a->sample == b->sample && a->value == b->value && a->has_slope == b->has_slope &&
           (!a->has_slope || (a->slope == b->slope && a->stiffness == b->stiffness));
}

/// Indices of the knots that are not as the take has them. How many; more than MOST_MOVED: too many.
static int find_moved(const wiggly_desc *old, const struct document *document, const struct spline *spline,
                      int moved[MOST_MOVED])
{
    int count = 0;
    for (int k = 0; k < spline->knot_count; k++) {
        wiggly_knot knot = storage_knot(document, &spline->knots[k]);
        if (same_knot(&old->knots[k], &knot)) continue;
        if (count == MOST_MOVED) return MOST_MOVED + 1;
        moved[count++] = k;
    }
    return count;
}

/// Later ones first where they move to the right, earlier ones first where they move to the left: each finds its place free.
static bool move(struct window *window, const struct document *document, const struct spline *spline,
                 const int *moved, int count)
{
    const wiggly_desc *old = take_desc(window->take);
    for (int turn = 0; turn < 2; turn++) {
        for (int n = 0; n < count; n++) {
            int k = moved[turn == 0 ? count - 1 - n : n];
            wiggly_knot knot = storage_knot(document, &spline->knots[k]);
            bool to_the_right = knot.sample > old->knots[k].sample;
            if (to_the_right != (turn == 0) || same_knot(&old->knots[k], &knot)) continue;
            if (!take_patch_knot(window->take, k, knot)) return false;
            window->moved = knot.sample;
        }
    }
    return true;
}

void window_follow(struct window *window, const struct document *document, const wiggly_desc *desc)
{
    const struct spline *spline = &document->splines[window->spline];
    const wiggly_desc *old = take_desc(window->take);
    int moved[MOST_MOVED];
    window->is_current = false;
    if (spline->knot_count != old->knot_count || !desc_same_settings(old, desc)) return;
    int count = find_moved(old, document, spline, moved);
    if (count <= MOST_MOVED) window->is_current = move(window, document, spline, moved, count);
}

bool window_show(struct window *window, const wiggly_curve *curve, const struct extremes *extremes, int first,
                 int count)
{
    int end = first + count < curve->samples ? first + count : curve->samples;
    if (first < 0) first = 0;
    if (first >= end) return true;
    double *total = curve->total + first, *re = curve->re + first, y = take_desc(window->take)->equilibrium.value;
    wiggly_status status = wiggly_take_read(window->take, first, end - first, total, curve->im + first);
    for (int i = 0; i < end - first; i++) re[i] = total[i] - y;
    extremes_update(extremes, curve->total, curve->samples, first, end - first);
    window->is_current = status == WIGGLY_OK;
    return window->is_current;
}
