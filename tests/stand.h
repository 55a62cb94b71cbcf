/// A scene with its models that is edited and solved, without an app.
#ifndef TESTS_STAND_H
#define TESTS_STAND_H

#include "near.h"

#include "model/figure.h"
#include "rig/import.h"
#include "scene/edit.h"
#include "scene/history.h"
#include "scene/load.h"
#include "scene/pins.h"

struct stand {
    struct opened opened;
    struct history *history;
};

static inline void stand_open(struct stand *stand, const char *path)
{
    assert_done(opened_read(&stand->opened, path, &error));
    stand->history = history_create(stand->opened.document);
    assert_non_null(stand->history);
}

static inline void stand_close(struct stand *stand)
{
    if (history_is_open(stand->history)) history_end(stand->history);
    history_destroy(stand->history);
    opened_free(&stand->opened);
}

#define STAND_TEST(name, opens) TEST_OF(struct stand, stand, opens, stand_close(stand), name)

/// The document of a step that opens; and its end, after an edit that must be possible.
static inline struct document *stand_begin(struct stand *stand)
{
    history_begin(stand->history, "Edit", 0);
    return stand->opened.document;
}

static inline void stand_end(struct stand *stand, bool done)
{
    assert_true(done);
    history_end(stand->history);
}

/// As a frame solves what its edits changed.
static inline void stand_solve(struct stand *stand)
{
    stand->opened.evaluation.models = models_source(stand->opened.models);
    evaluation_update(&stand->opened.evaluation, stand->opened.document, false);
}

/// The point and, of each spline, how it moves it (c may be NULL).
static inline struct pin_point stand_find(const struct stand *stand, int rig, int point, double frame, pin_pull *c)
{
    const struct document *document = stand->opened.document;
    const struct model_source source = models_source(stand->opened.models);
    struct pin_point found;
    struct pin pin = {.frame = frame, .point = point};
    int splines[64];
    for (int s = 0; s < document->spline_count; s++) splines[s] = s;
    const struct pin_query query = {rig, &pin, splines, c ? document->spline_count : 0, 0};
    assert_true(source.find(source.context, &stand->opened.evaluation, document, &query, c, &found));
    return found;
}

static inline const struct pin_left *stand_left(const struct stand *stand, int rig, int pin)
{
    const struct pin_left *left = evaluation_pin(&stand->opened.evaluation, stand->opened.document, rig, pin);
    assert_non_null(left);
    assert_true(left->is_found);
    return left;
}

static inline double length_of(const double v[3]) { return hypot(hypot(v[0], v[1]), v[2]); }

static inline void assert_knots_are_hit(const struct stand *stand)
{
    const struct document *document = stand->opened.document;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        for (int k = 0; k < spline->knot_count; k++) {
            const int sample = document_sample(document, spline->knots[k].frame);
            assert_near(stand->opened.evaluation.curves[s].total[sample], spline->knots[k].value, 1e-9);
        }
    }
}

#endif
