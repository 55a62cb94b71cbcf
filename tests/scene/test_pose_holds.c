/// A pose holds every part that lags, whatever is changed later; limits hold beside poses and still knots.
#include "documents.h"

#include "scene/edit.h"
#include "scene/evaluate.h"

/// Two knots, a pose on frame 60, a still knot, and two more knots; members of the spline, and a spline before it.
static const char SCENE[] =
    "{\"wiggly\": 2, \"frames\": [0, 144], \"splines\": [{\"name\": \"base\", \"mode\": \"cubic\", \"knots\": ["
    "{\"frame\": 0, \"value\": 0}, {\"frame\": 70, \"value\": 0.5}, {\"frame\": 144, \"value\": -0.2}]},"
    "{\"name\": \"sway\", \"frequency\": 1.1, \"damping\": 0.1, \"bandwidth\": 0.1, %s \"knots\": [%s"
    "{\"frame\": 6, \"value\": 0.7}, {\"frame\": 30, \"value\": -1, \"im\": 0.4}, {\"frame\": 60, \"value\": 0.6, "
    "\"im\": -0.8},"
    "{\"frame\": 85, \"value\": 0.2, \"slope\": 3}, {\"frame\": 110, \"value\": -0.5}]}]}";

enum { SWAY = 1, POSE = 60 };

static const char *const splines[] = {
    "",
    "\"start\": \"loop\",",
    "\"start\": \"rest\",",
    "\"equilibrium\": {\"spline\": \"base\"},",
    "\"passive\": \"filter\", \"equilibrium\": {\"spline\": \"base\"},",
    "\"variation\": {\"seed\": 3, \"amount\": 0.5},",
    "\"calm\": 0.1,",
    "\"limits\": [-1.1, 1],",
};

static const char *const knots[] = {"", "{\"frame\": 46, \"still\": true},"};

/// Knots that are changed: from a frame to another one (NAN deletes) and a value; and the frequency times a factor.
static const struct edit {
    const char *name;
    double faster;
    struct {
        double frame, to, value;
    } knots[4];
} edits[] = {
    {"frequency × 1.3", 1.3, {{0, 0, 0}}},
    {"all others deleted", 1, {{6, NAN, 0}, {30, NAN, 0}, {85, NAN, 0}, {110, NAN, 0}}},
    {"the next one deleted", 1, {{85, NAN, 0}}},
    {"others moved", 1, {{30, 30, 0.9}, {85, 85, -0.9}}},
    {"others retimed", 1, {{30, 41, -1}, {85, 66, 0.2}, {6, 17, 0.7}}},
    {"others beside it", 1, {{30, 59, -1}, {85, 61, 0.2}}},
};

static void run(struct document *document, const struct edit *edit)
{
    struct param param = document->splines[SWAY]->parameter[PARAMETER_FREQUENCY];
    param.value *= edit->faster;
    assert_done(edit_parameter(document, SWAY, PARAMETER_FREQUENCY, &param, &error));
    for (int i = 0; i < 4 && edit->knots[i].frame > 0; i++) {
        const struct spline *spline = document->splines[SWAY];
        const int at = spline_find_knot(document, spline, (int)edit->knots[i].frame);
        assert_true(at >= 0);
        struct knot knot = spline->knots[at];
        knot.frame = edit->knots[i].to;
        knot.value = edit->knots[i].value;
        if (isnan(knot.frame)) assert_done(edit_knot_remove(document, SWAY, knot.id, &error));
        if (!isnan(knot.frame)) assert_done(edit_knot_set(document, SWAY, &knot, &error));
    }
}

static const double lags[] = {0, 60, 150};

static void measure(const struct document *document, enum solver_choice solver, double parts[3])
{
    struct evaluation evaluation = {.solver = solver};
    evaluation_update(&evaluation, document, false);
    const wiggly_value at = evaluation_at(&evaluation, SWAY, POSE);
    for (int i = 0; i < 3; i++) parts[i] = wiggly_lagged(at, lags[i] * M_PI / 180);
    evaluation_free(&evaluation);
}

TEST(test_a_pose_holds_every_part_whatever_is_changed)
{
    for (size_t n = 0; n < sizeof splines / sizeof *splines * 2 * 2; n++) {
        const char *spline = splines[n / 4];
        const enum solver_choice solver = n % 2 ? SOLVER_CHAIN : SOLVER_BAND;
        char text[1200];
        snprintf(text, sizeof text, SCENE, spline, knots[n / 2 % 2]);
        for (size_t e = 0; e < sizeof edits / sizeof *edits; e++) {
            struct document *document = document_of_text(text);
            double before[3], after[3];
            measure(document, solver, before);
            run(document, &edits[e]);
            measure(document, solver, after);
            for (int i = 0; i < 3; i++) {
                if (!(fabs(after[i] - before[i]) <= 1e-9))
                    fail_msg("%s%s %s, %g degrees: off by %g", spline, knots[n / 2 % 2], edits[e].name, lags[i],
                             after[i] - before[i]);
            }
            document_destroy(document);
        }
    }
}

/// Limits only just beyond the knots, which press the curve on either side of poses and still knots.
TEST(test_limits_hold_beside_poses_and_still_knots)
{
    static const char *const starts[] = {"", "\"start\": \"loop\",", "\"start\": \"rest\",",
                                         "\"passive\": \"filter\","};
    for (size_t n = 0; n < sizeof starts / sizeof *starts * 4; n++) {
        char text[1200], spline[100];
        snprintf(spline, sizeof spline, "%s \"limits\": [-1.02, 0.72],", starts[n / 4]);
        snprintf(text, sizeof text, SCENE, spline, knots[n % 2]);
        struct document *document = document_of_text(text);
        struct evaluation evaluation = {.solver = n / 2 % 2 ? SOLVER_CHAIN : SOLVER_BAND};
        evaluation_update(&evaluation, document, false);
        const wiggly_curve *curve = &evaluation.curves[SWAY];
        int pressed = 0;
        assert_true(evaluation.status[SWAY] <= WIGGLY_LEVELLED);
        for (int i = 0; i < curve->samples; i++) {
            if (!(curve->total[i] >= -1.02 - 1e-9 && curve->total[i] <= 0.72 + 1e-9))
                fail_msg("%s: %g at %d", text, curve->total[i], i);
            pressed += curve->total[i] > 0.72 - 1e-9 || curve->total[i] < -1.02 + 1e-9;
        }
        assert_true(pressed > 0); // else this proves nothing
        for (int k = 0; k < document->splines[SWAY]->knot_count; k++) {
            const struct knot *knot = &document->splines[SWAY]->knots[k];
            const int sample = document_sample(document, knot->frame);
            assert_true(curve->total[sample] == (knot->still ? 0 : knot->value)); // to the bit
            if (knot->has_phase || knot->still) assert_near(curve->im[sample], knot->phase, 1e-9);
        }
        evaluation_free(&evaluation);
        document_destroy(document);
    }
}
