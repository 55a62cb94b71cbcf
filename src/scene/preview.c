/// Keeps a take in step with the document and reads the visible samples from it.
#include "scene/preview.h"
#include "spline/desc.h"
#include "spline/take.h"

enum { MOST_MOVED = 64 }; ///< knots in one frame: 2 µs each

bool preview_serves(const wiggly_desc *desc) { return !desc_has_track(desc) && desc->start != WIGGLY_LOOP; }

static bool same_knot(const wiggly_knot *a, const wiggly_knot *b)
{
    return a->sample == b->sample && a->value == b->value && a->has_slope == b->has_slope &&
           (!a->has_slope || (a->slope == b->slope && a->stiffness == b->stiffness));
}

/// Finds the knots that differ from the take's. Returns how many; more than MOST_MOVED: too many.
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

/// Knots that move right go last to first, those that move left first to last, so that each finds its place free.
static bool move(struct preview *preview, const struct document *document, const struct spline *spline,
                 const int *moved, int count)
{
    const wiggly_desc *old = take_desc(preview->take);
    for (int turn = 0; turn < 2; turn++) {
        for (int n = 0; n < count; n++) {
            int k = moved[turn == 0 ? count - 1 - n : n];
            wiggly_knot knot = storage_knot(document, &spline->knots[k]);
            bool to_the_right = knot.sample > old->knots[k].sample;
            if (to_the_right != (turn == 0) || same_knot(&old->knots[k], &knot)) continue;
            if (!take_patch_knot(preview->take, k, knot)) return false;
            preview->moved = knot.sample;
        }
    }
    return true;
}

void preview_update(struct preview *preview, const struct document *document, const wiggly_desc *desc)
{
    const struct spline *spline = &document->splines[preview->spline];
    const wiggly_desc *old = take_desc(preview->take);
    int moved[MOST_MOVED];
    preview->is_current = false;
    if (spline->knot_count != old->knot_count || !desc_same_settings(old, desc)) return;
    int count = find_moved(old, document, spline, moved);
    if (count <= MOST_MOVED) preview->is_current = move(preview, document, spline, moved, count);
}

bool preview_show(struct preview *preview, const wiggly_curve *curve, const struct extremes *extremes, int first,
                  int count)
{
    int end = first + count < curve->samples ? first + count : curve->samples;
    if (first < 0) first = 0;
    if (first >= end) return true;
    double *total = curve->total + first, *re = curve->re + first, y = take_desc(preview->take)->equilibrium.value;
    wiggly_status status = wiggly_take_read(preview->take, first, end - first, total, curve->im + first);
    for (int i = 0; i < end - first; i++) re[i] = total[i] - y;
    extremes_update(extremes, curve->total, curve->samples, first, end - first);
    preview->is_current = status == WIGGLY_OK;
    return preview->is_current;
}
