/// Keeps what follows an edit: a spline that winds up and whose knots an open step has changed gets a pose at the next free knot, so that from
/// there on it is what it was (docs/mathematics.md, Wind-up).
///
/// The rule compares the knots with those before the step, so any number of edits, in any order, gives the same. Settling knots move the
/// equilibrium of all that follows, which no pose can keep.
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/selection.h"
#include "scene/warnings.h"
#include <limits.h>

void core_keep_phases(struct core *core)
{
    const struct document *document = core->document;
    core->pressed.count = 0;
    if (!core->keep || !evaluation_is_of(core->evaluation, document)) return;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        for (int k = 0; k < spline->knot_count && spline_winds_up(document, s); k++) {
            struct knot knot = spline->knots[k];
            if (knot_holds(&knot) != HOLDS_VALUE) continue;
            knot.phase = evaluation_at(core->evaluation, s, document_sample(document, knot.frame)).im;
            originals_add(&core->pressed, s, &knot);
        }
    }
}

/// The phase of a knot of spline `old` when the step began; NULL if it is not known, or was not free.
static const double *phase_of(const struct core *core, int old, const struct knot *knot)
{
    const struct originals *pressed = &core->pressed;
    int low = 0, high = pressed->count;
    while (low < high) {
        const int middle = (low + high) / 2;
        const struct original *at = &pressed->list[middle];
        if (at->spline < old || (at->spline == old && at->knot.frame < knot->frame)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low < pressed->count && pressed->list[low].knot.id == knot->id ? &pressed->list[low].knot.phase : NULL;
}

/// Whether a curve through either knot is the same: they are equal, or one is the other with the phase it had.
static bool is_same(const struct core *core, int old, const struct knot *was, const struct knot *is)
{
    if (was->id != is->id || was->frame != is->frame || was->still != is->still || was->settles != is->settles)
        return false;
    if (is->still || was->value != is->value) return is->still;
    if (is->has_phase && !was->has_phase) {
        const double *phase = phase_of(core, old, was);
        return phase && is->phase == *phase;
    }
    if (was->has_phase || is->has_phase) return was->has_phase && is->has_phase && was->phase == is->phase;
    return was->has_slope == is->has_slope &&
           (!is->has_slope || (was->slope == is->slope && was->stiffness == is->stiffness));
}

/// Makes a free knot of a spline, `old` before the step, a pose with the phase it had.
static void hold(struct core *core, int old, int of, const struct knot *knot)
{
    const double *phase = knot_holds(knot) == HOLDS_VALUE ? phase_of(core, old, knot) : NULL;
    struct knot pose = *knot;
    if (!phase) return;
    pose.has_phase = true;
    pose.phase = *phase;
    pose.has_slope = false; // its phase has it
    core_put_knot(core, of, &pose);
}

/// Goes through the knots before and after the step in order of time, in a loop twice. The first knot after a change that stayed is held. In a loop
/// that had no pose the phase of the first knot comes from the whole round, so that knot is held, too.
static void keep_spline(struct core *core, int old, int of)
{
    const struct document *document = core->document, *earlier = history_before(core->history);
    const struct spline *before = earlier->splines[old];
    const bool loops = spline_start(document->splines[of]) == WIGGLY_LOOP;
    bool changes = false, changed = false, is_free = loops;
    for (int k = 0; k < before->knot_count; k++) is_free &= knot_holds(&before->knots[k]) == HOLDS_VALUE;
    for (int round = 0; round < (loops ? 2 : 1); round++) {
        for (int b = 0, a = 0; b < before->knot_count || a < document->splines[of]->knot_count;) {
            const struct spline *after = document->splines[of];
            const struct knot *was = b < before->knot_count ? &before->knots[b] : NULL;
            const struct knot *is = a < after->knot_count ? &after->knots[a] : NULL;
            const int then = was ? document_sample(earlier, was->frame) : INT_MAX;
            const int now = is ? document_sample(document, is->frame) : INT_MAX;
            const bool stayed = then == now && is_same(core, old, was, is);
            b += then <= now;
            a += now <= then;
            if (stayed) {
                if (changed || (changes && is_free && a == 1)) hold(core, old, of, is);
                changed = false;
            } else if (!(then <= now && was->settles) && !(now <= then && is->settles)) {
                changes = changed = true;
            }
        }
    }
}

void core_keep_following(struct core *core)
{
    const struct document *document = core->document, *before = history_before(core->history);
    const bool swings = core->drag.owner && core->mods & MOD_ALT;
    if (!core->keep || swings || core->pressed.count == 0) return;
    for (int s = 0; s < document->spline_count; s++) {
        const int old = document_find_spline_id(before, document->splines[s]->id);
        if (old < 0 || before->splines[old] == document->splines[s] || !spline_winds_up(document, s)) continue;
        keep_spline(core, old, s);
    }
}
