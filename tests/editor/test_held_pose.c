/// What is seen when a tail or a chain is let go stays there, for every joint, whatever is changed later.
#include "panel_session.h"

#include "beast.h"
#include "folder.h"
#include "scene/edit.h"

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

static void retune(struct document *document, int s, unsigned held)
{
    struct param faster = document->splines[s]->parameter[PARAMETER_FREQUENCY];
    (void)held;
    faster.value *= 1.3;
    assert_done(edit_parameter(document, s, PARAMETER_FREQUENCY, &faster, &error));
}

static void delete_others(struct document *document, int s, unsigned held)
{
    const struct spline *spline = document->splines[s];
    for (int k = spline->knot_count - 1; k >= 0; k--)
        if (spline->knots[k].id != held) assert_done(edit_knot_remove(document, s, spline->knots[k].id, &error));
}

/// Sets all knots but the held one to a multiple of their value, some frames later.
static void change_others(struct document *document, int s, unsigned held, double factor, double frames)
{
    for (int k = document->splines[s]->knot_count - 1; k >= 0; k--) {
        struct knot knot = document->splines[s]->knots[k];
        knot.value *= factor;
        knot.frame += frames;
        if (knot.id != held) assert_done(edit_knot_set(document, s, &knot, &error));
    }
}

static void turn_others(struct document *document, int s, unsigned held) { change_others(document, s, held, -2, 0); }

static void retime_others(struct document *document, int s, unsigned held) { change_others(document, s, held, 1, 3); }

/// The largest difference at a sample between two solutions of a spline, of any lag, where `size` is the largest knot.
static double moved(const wiggly_curve *from, const wiggly_curve *to, int sample, double size)
{
    const double dy = to->total[sample] - to->re[sample] - from->total[sample] + from->re[sample];
    return (fabs(dy) + hypot(to->re[sample] - from->re[sample], to->im[sample] - from->im[sample])) / size;
}

/// Changes copies of the document in each way, and sees that nothing moves at the knot on the sample.
static void assert_held(const struct session *session, int s, int sample)
{
    void (*const changes[])(struct document * document, int spline, unsigned held) = {retune, delete_others,
                                                                                      turn_others, retime_others};
    const struct spline *spline = session->document->splines[s];
    const int at = spline_find_knot(session->document, spline, sample);
    assert_true(at >= 0 && spline->knots[at].has_phase);
    double size = 0;
    for (int k = 0; k < spline->knot_count; k++) size = fmax(size, fabs(spline->knots[k].value));
    for (size_t c = 0; c < sizeof changes / sizeof changes[0]; c++) {
        struct document *changed = document_copy(session->document);
        struct evaluation evaluation = {0};
        changes[c](changed, s, spline->knots[at].id);
        evaluation_update(&evaluation, changed, false);
        const double by = moved(&solved(session->editor)->curves[s], &evaluation.curves[s], sample, size);
        if (!(by <= 1e-9)) fail_msg("change %zu moves %s by %g of its largest knot", c, spline->name, by);
        evaluation_free(&evaluation);
        document_destroy(changed);
    }
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
