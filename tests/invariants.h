/// What holds for every document at any time and the editor relies on: all that the loader demands, which assert_loads_again() asks, and what
/// no file says.
#ifndef TESTS_INVARIANTS_H
#define TESTS_INVARIANTS_H

#include "documents.h"

#include "scene/document.h"

static inline int compare_ids(const void *a, const void *b)
{
    const unsigned x = *(const unsigned *)a, y = *(const unsigned *)b;
    return (x > y) - (x < y);
}

/// The ids of splines, knots, rigs and pins are all different, and below the next one.
static inline void assert_ids_differ(const struct document *d)
{
    int count = d->spline_count + d->rig_count;
    for (int s = 0; s < d->spline_count; s++) count += d->splines[s]->knot_count;
    for (int r = 0; r < d->rig_count; r++) count += d->rigs[r]->pin_count;
    unsigned *ids = malloc(((size_t)count + 1) * sizeof *ids), *next = ids;
    for (int s = 0; s < d->spline_count; s++) {
        *next++ = d->splines[s]->id;
        for (int k = 0; k < d->splines[s]->knot_count; k++) *next++ = d->splines[s]->knots[k].id;
    }
    for (int r = 0; r < d->rig_count; r++) {
        *next++ = d->rigs[r]->id;
        for (int i = 0; i < d->rigs[r]->pin_count; i++) *next++ = d->rigs[r]->pins[i].id;
    }
    qsort(ids, (size_t)count, sizeof *ids, compare_ids);
    for (int i = 1; i < count; i++) assert_int_not_equal(ids[i - 1], ids[i]);
    if (count > 0) assert_true(ids[count - 1] < d->next_id);
    free(ids);
}

/// Knots are finite, sorted by sample, at most one per sample, inside the range.
static inline void assert_knots(const struct document *d, const struct spline *spline)
{
    int before = -1;
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        const int sample = document_sample(d, knot->frame);
        assert_true(isfinite(knot->frame) && (knot->still || isfinite(knot->value)) && isfinite(knot->slope));
        assert_true(isfinite(knot->stiffness) && knot->stiffness > 0);
        if (sample <= before) fail_msg("knot %d of \"%s\" is on sample %d after %d", k, spline->name, sample, before);
        before = sample;
    }
    assert_true(before <= document_last_knot_sample(d, spline));
}

/// Parameters are in range where the mode uses them, names and ids find their spline, and no spline follows itself.
static inline void assert_splines(const struct document *d)
{
    for (int s = 0; s < d->spline_count; s++) {
        const struct spline *spline = d->splines[s];
        assert_int_equal(document_find_spline(d, spline->name), s);
        assert_int_equal(document_find_spline_id(d, spline->id), s);
        assert_knots(d, spline);
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct param *param = &spline->parameter[p];
            assert_in_range(param->track + 1, 0, d->spline_count);
            if (param_follows(param) || !spline_uses(spline, p, false)) continue;
            assert_true(param->value >= parameter_rows[p].minimum);
            assert_true(param->value <= parameter_maximum(p, spline_mode(spline)));
        }
    }
    struct order_cycle cycle;
    assert_true(scene_has_order(d, &cycle));
}

/// Inputs of rigs are splines that are there, and models of chains are rigs that are there.
static inline void assert_rigs(const struct document *d)
{
    for (int r = 0; r < d->rig_count; r++) {
        const struct rig *rig = d->rigs[r];
        for (int i = 0; i < rig_input_count(rig); i++) assert_in_range(rig_input(rig, i), 0, d->spline_count - 1);
        if (rig->kind == RIG_CHAIN) assert_true(document_find_model(d, rig->chain.model) >= 0);
    }
}

static inline void assert_invariants(const struct document *document)
{
    assert_true((int64_t)document_samples(document) * document->spline_count <= SCENE_MAX_SAMPLES);
    assert_ids_differ(document);
    assert_splines(document);
    assert_rigs(document);
}

#endif
