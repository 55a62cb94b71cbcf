/// Conditions that hold for every document: the loader guarantees them and the editor relies on them.
#ifndef TESTS_INVARIANTS_H
#define TESTS_INVARIANTS_H

#include "documents.h"

#include "scene/order.h"

static inline void assert_scene_timing(const struct document *d)
{
    assert_true(isfinite(d->fps) && d->fps > 0 && d->fps <= SCENE_MAX_FPS);
    assert_in_range(d->substeps, 1, SCENE_MAX_SUBSTEPS);
    assert_true(d->first_frame <= d->last_frame);
    assert_true(abs(d->first_frame) <= SCENE_MAX_FRAME && abs(d->last_frame) <= SCENE_MAX_FRAME);
    assert_true((int64_t)document_samples(d) * d->spline_count <= SCENE_MAX_SAMPLES);
}

static inline int compare_ids(const void *a, const void *b)
{
    const unsigned x = *(const unsigned *)a, y = *(const unsigned *)b;
    return (x > y) - (x < y);
}

/// Knots are finite, sorted by sample, at most one per sample, inside the range; ids are unique in the document.
static inline void assert_knots(const struct document *d)
{
    int count = 0;
    for (int s = 0; s < d->spline_count; s++) count += d->splines[s]->knot_count;
    unsigned *ids = malloc(((size_t)count + 1) * sizeof *ids), *next = ids;
    for (int s = 0; s < d->spline_count; s++) {
        const struct spline *spline = d->splines[s];
        int before = -1;
        for (int k = 0; k < spline->knot_count; k++) {
            const struct knot *knot = &spline->knots[k];
            assert_true(isfinite(knot->frame) && (knot->still || isfinite(knot->value)) && isfinite(knot->slope));
            assert_true(isfinite(knot->stiffness) && knot->stiffness > 0);
            int sample = document_sample(d, knot->frame);
            if (sample <= before)
                fail_msg("knot %d of \"%s\" is on sample %d after %d", k, spline->name, sample, before);
            before = sample;
            assert_true(knot->id < d->next_id);
            *next++ = knot->id;
        }
        assert_true(before <= document_last_knot_sample(d, spline));
    }
    qsort(ids, (size_t)count, sizeof *ids, compare_ids);
    for (int i = 1; i < count; i++) assert_int_not_equal(ids[i - 1], ids[i]);
    free(ids);
}

/// `may_be_infinite`: a limit that is off.
static inline void assert_param(const struct document *d, const struct param *param, bool may_be_infinite)
{
    assert_in_range(param->track + 1, 0, d->spline_count);
    if (!param_follows(param)) assert_true(may_be_infinite ? !isnan(param->value) : isfinite(param->value));
    if (!param->motion) return;
    assert_int_equal(param->track, -1);
    assert_true(isfinite(param->motion->gain) && param->motion->joint[0]);
    assert_true(document_find_model(d, param->motion->model, param->motion->by_file) >= 0);
}

/// Parameters are in range, names and ids unique, and no spline follows itself.
static inline void assert_splines(const struct document *d)
{
    for (int s = 0; s < d->spline_count; s++) {
        const struct spline *spline = d->splines[s];
        assert_true(spline->name && spline->name[0]);
        assert_int_equal(document_find_spline(d, spline->name), s);
        assert_int_equal(document_find_spline_id(d, spline->id), s);
        assert_true(spline->id < d->next_id);
        assert_true(spline->knot_count <= spline->knot_capacity);
        assert_in_range(spline->color + 1, 0, 0x1000000);
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
            const struct param *param = &spline->parameter[p];
            assert_param(d, param, parameter_rows[p].kind == PARAMETER_LIMIT);
            if (param->track >= 0 || !spline_uses(spline, p, false)) continue;
            assert_true(param->value >= parameter_rows[p].minimum);
            assert_true(param->value <= parameter_maximum(p, spline_mode(spline)));
        }
    }
    struct order_cycle cycle;
    assert_true(scene_has_order(d, &cycle));
}

static inline void assert_angles(const struct angles *angles, int joints)
{
    if (angles->form == ANGLES_EACH && joints > 0) assert_int_equal(angles->count, joints);
    for (int i = 0; i < angles_count(angles); i++) assert_true(isfinite(angles_number(angles, i)));
    for (int i = 0; angles->form == ANGLES_RAMP && i < angles->count; i++) {
        assert_true(angles->ramp[i].at >= 0 && angles->ramp[i].at <= 1);
        assert_true(i == 0 || angles->ramp[i].at > angles->ramp[i - 1].at);
    }
}

static inline void assert_tails(const struct document *d)
{
    assert_true(d->rig_count <= SCENE_MAX_RIGS);
    for (int t = 0; t < document_count_rigs(d, RIG_TAIL); t++) {
        const struct tail *tail = document_tail(d, t);
        const char *name = d->rigs[document_find_rig(d, RIG_TAIL, t)]->name;
        assert_true(name && name[0]);
        for (int u = 0; u < t; u++) assert_string_not_equal(name, d->rigs[document_find_rig(d, RIG_TAIL, u)]->name);
        assert_in_range(tail->joints, 1, TAIL_MAX_JOINTS);
        assert_true(isfinite(tail->length) && tail->length > 0);
        for (int k = 0; k < 3; k++) assert_param(d, &tail->position[k], false);
        assert_angles(&tail->rest, tail->joints);
        assert_in_range(tail->channel_count, 0, SCENE_MAX_CHANNELS);
        for (int c = 0; c < tail->channel_count; c++) {
            assert_true(tail->channels[c].spline >= 0 && tail->channels[c].spline < d->spline_count);
            assert_angles(&tail->channels[c].lag, tail->joints);
            assert_angles(&tail->channels[c].gain, tail->joints);
        }
    }
}

static inline void assert_characters(const struct document *d)
{
    for (int c = 0; c < document_count_rigs(d, RIG_CHARACTER); c++) {
        const struct character_rig *rig = document_character(d, c);
        assert_true(rig->model && rig->model[0]);
        assert_in_range(rig->drive_count, 0, CHARACTER_MAX_DRIVES);
        for (int k = 0; k < rig->drive_count; k++) {
            const struct drive *drive = &rig->drives[k];
            assert_true(drive->name && drive->spline >= 0 && drive->spline < d->spline_count);
            assert_true(isfinite(drive->amplitude) && isfinite(drive->lag));
        }
    }
}

/// A chain's model and splines exist.
static inline void assert_models(const struct document *d)
{
    for (int r = 0; r < d->rig_count; r++) {
        const struct rig *rig = d->rigs[r];
        if (rig->kind == RIG_MODEL) {
            assert_true(rig->model.model[0] && isfinite(rig->model.scale) && rig->model.scale > 0);
            assert_true(!rig->model.clip || rig->model.clip[0]);
        } else if (rig->kind == RIG_CHAIN) {
            const struct chain *chain = &rig->chain;
            assert_true(chain->from[0] && chain->to[0] && isfinite(chain->turn));
            assert_true(document_find_model(d, chain->model, chain->by_file) >= 0);
            assert_true(!chain->by_file || document_find_model(d, chain->model, false) < 0);
            assert_in_range(chain->channel_count, 0, SCENE_MAX_CHANNELS);
            for (int c = 0; c < chain->channel_count; c++) {
                assert_true(chain->channels[c].spline >= 0 && chain->channels[c].spline < d->spline_count);
                assert_angles(&chain->channels[c].lag, 0);
                assert_angles(&chain->channels[c].gain, 0);
            }
        }
    }
}

static inline void assert_invariants(const struct document *document)
{
    assert_scene_timing(document);
    assert_knots(document);
    assert_splines(document);
    assert_tails(document);
    assert_characters(document);
    assert_models(document);
}

#endif
