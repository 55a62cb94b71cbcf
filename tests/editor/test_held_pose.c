/// What is seen when a tail or a chain is let go stays there, for every joint.
#include "panel_session.h"

#include "beast.h"
#include "folder.h"

/// A beast whose tail, chain and ear have lags; `knots` of its two splines.
static void open_beast(struct session *session, const char *knots)
{
    char scene[4096];
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(scene, sizeof scene,
             "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"flick\", \"frequency\": 1.5, "
             "\"damping\": 0.1, \"bandwidth\": 0.1, \"knots\": [%s]}, {\"name\": \"ear\", \"start\": \"loop\", "
             "\"frequency\": 2, \"damping\": 0.05, \"knots\": [%s]}], \"rigs\": [{\"type\": \"model\", \"name\": "
             "\"beast\", \"model\": \"%s\"}, {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"beast\", "
             "\"from\": \"tail_1\", \"to\": \"tail_8\", \"channels\": [{\"spline\": \"flick\", \"axis\": \"side\", "
             "\"lag\": 20, \"gain\": 8}]}, {\"type\": \"chain\", \"name\": \"ear\", \"model\": \"beast\", \"from\": "
             "\"ear_L_1\", \"to\": \"ear_L_2\", \"channels\": [{\"spline\": \"ear\", \"axis\": \"up\", \"lag\": 70, "
             "\"gain\": 30}]}]}",
             knots, knots, folder_path("beast.glb"));
    panel_open_models(session, scene);
    session_move(session, 2, 2);
    session_frame(session);
}

static const char two_knots[] = "{\"frame\": 12, \"value\": 0.3}, {\"frame\": 72, \"value\": -0.4}";

/// The knot on the sample is a pose, of what the curve shows there. test_pose_holds.c has what may change then.
static void assert_held(const struct session *session, int s, int sample)
{
    const struct spline *spline = session->document->splines[s];
    const wiggly_curve *curve = &solved(session->editor)->curves[s];
    const int at = spline_find_knot(session->document, spline, sample);
    assert_true(at >= 0 && spline->knots[at].has_phase);
    assert_near(spline->knots[at].value, curve->total[sample], 1e-9);
    assert_near(spline->knots[at].phase, curve->im[sample], 1e-9);
}

/// Pulls at a frame, and holds still until the point is there.
static void pull_at(struct session *session, double frame, const char *target, float dx, float dy)
{
    float before[2], after[2];
    seek(session->editor, frame);
    session_frame(session);
    session_pull(session, target, dx, dy, 8);
    for (int i = 0; i < 30; i++) session_frame(session);
    session_where(session, target, before);
    session_release(session, BUTTON_LEFT);
    session_where(session, target, after);
    assert_near(hypotf(after[0] - before[0], after[1] - before[1]), 0, 0.01); // letting go moves nothing
}

SESSION_TEST(a_tail_that_is_let_go_is_held, session_open_file(s, "assets/scenes/tail.json"))
{
    const char *before = session_saved(s);
    pull_at(s, 60, "tail(tail,0.9)", 60, -40);
    assert_held(s, 0, 60);
    assert_held(s, 1, 60);
    assert_one_step(s, before);
    pull_at(s, 60, "tail(tail,0.9)", -50, 10); // and again, from the pose that it was
    assert_held(s, 0, 60);
    assert_held(s, 1, 60);
}

SESSION_TEST(so_are_chains_and_ears, open_beast(s, two_knots))
{
    pull_at(s, 40, "chain(tail,0.9)", 30, 0);
    assert_held(s, 0, 40);
    pull_at(s, 72, "chain(ear,0.9)", 0, -8); // where there is a knot
    assert_held(s, 1, 72);
    assert_int_equal(s->document->splines[1]->knot_count, 2);
}

/// A part without knots begins from rest, a quarter of a period before; in a loop also around its end.
SESSION_TEST(the_first_pull_begins_from_rest, open_beast(s, ""))
{
    pull_at(s, 40, "chain(tail,0.9)", 30, 0);
    const struct spline *tail = s->document->splines[0];
    assert_int_equal(tail->knot_count, 2);
    assert_true(tail->knots[0].still && tail->knots[1].has_phase);
    assert_near(tail->knots[0].frame, 36, 0); // 24 frames a second, 1.5 Hz
    for (int i = 0; i <= 36; i++) assert_near(solved(s->editor)->curves[0].total[i], 0, 1e-12);
    pull_at(s, 1, "chain(ear,0.9)", 0, -8);
    const struct spline *ear = s->document->splines[1];
    assert_int_equal(ear->knot_count, 2);
    assert_true(ear->knots[0].has_phase && ear->knots[1].still);
    assert_near(ear->knots[1].frame, 94, 0);
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(s->document->splines[1]->knot_count, 0); // one step
}
