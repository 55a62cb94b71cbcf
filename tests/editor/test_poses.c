/// What knots hold: poses keep their phase through every edit, still knots stay still; an edit changes nothing before the knot before it, nor
/// beyond the next one; and what is seen when a tail or a chain is let go stays there, for every joint.

#include "beast.h"
#include "folder.h"
#include "hands.h"
#include "scene/edit.h"
#include "uniform.h"

#define HOLDING                                                                                                      \
    "{'wiggly': 2, 'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1,"                 \
    "'knots': [{'frame': 20, 'value': 0.8, 'im': 0.3}, {'frame': 34, 'value': 0.5, 'settles': true},"                \
    "{'frame': 50, 'still': true}, {'frame': 64, 'value': -0.6, 'im': 0.45, 'slope': 1}]}]}"

/// Of a scene in which all knots are selected: the phases of poses in the order of time, which mirror as values do, and how many times each knot
/// is there. All in one step, but cut and paste.
static const struct edit {
    const char *steps;
    double phases[4];
    int copies;
    bool is_cut;
} edits[] = {
    {"key Alt+Up", {0.3, 0.45}, 1, false},
    {"key Alt+Right", {0.3, 0.45}, 1, false},
    {"carry knot(sway,0) 30 -20", {0.3, 0.45}, 1, false},
    {"carry knot(sway,3) 40 0", {0.3, 0.45}, 1, false},
    {"type s1 -1; wait 1; key Enter", {-0.3, -0.45}, 1, false},
    {"type s1 0.5; wait 1; key Enter", {0.15, 0.225}, 1, false},
    {"type s0.5 1; wait 1; key Enter", {0.3, 0.45}, 1, false},
    {"type s-1 1; wait 1; key Enter", {-0.45, -0.3}, 1, false}, // the swing turns the other way
    {"type s-1 -1; wait 1; key Enter", {0.45, 0.3}, 1, false},
    {"key Ctrl+D", {0.3, 0.45, 0.3, 0.45}, 2, false},
    {"key Ctrl+X; sway.knots 0; seek 30; paste", {0.3, 0.45}, 1, true},
    {"key T", {0.3, 0.45}, 1, false},
    {"key Ctrl+T", {0.3, 0.45}, 1, false},
};

static const struct spline *sway(const struct session *s) { return s->document->splines[0]; }

/// Whether a spline has those phases, and as many still and free knots as copies.
static void assert_held(const char *name, const struct spline *spline, const double *phases, int copies)
{
    int poses = 0, stills = 0, settling = 0;
    assert_int_equal(spline->knot_count, 4 * copies);
    for (int k = 0; k < spline->knot_count; k++) {
        const struct knot *knot = &spline->knots[k];
        stills += knot->still;
        settling += knot->settles;
        if (knot->still && (knot->has_slope || knot->has_phase)) fail_msg("%s: a still knot holds more", name);
        if (!knot->has_phase) continue;
        if (poses == 2 * copies || fabs(knot->phase - phases[poses]) > 1e-9)
            fail_msg("%s: the phase of pose %d is %g", name, poses, knot->phase);
        poses++;
    }
    if (poses != 2 * copies || stills != copies || settling != copies)
        fail_msg("%s: %d poses, %d still knots, %d that settle", name, poses, stills, settling);
}

/// And a knot made still keeps its value, unseen: edits of what is drawn leave it as it is, copies have it too, text does not.
TEST(edits_keep_what_knots_hold)
{
    for (const struct edit *edit = edits; edit < edits + sizeof edits / sizeof *edits; edit++) {
        const char *undo = edit->is_cut ? "key 2*Ctrl+Z" : "key Ctrl+Z",
                   *redo = edit->is_cut ? "2*Ctrl+Shift+Z" : "Ctrl+Shift+Z";
        struct session session, *const s = &session;
        int kept = 0;
        session_open(s, HOLDING);
        hands(s, "key Ctrl+A; keep; %s", edit->steps);
        assert_held(edit->steps, sway(s), edit->phases, edit->copies);
        hands(s, "%s; kept; key %s", undo, redo);
        assert_held(edit->steps, sway(s), edit->phases, edit->copies);
        hands(s, "%s; kept; click knot(sway,1); key Shift+P Ctrl+A; %s", undo, edit->steps);
        for (int k = 0; k < sway(s)->knot_count; k++)
            kept += sway(s)->knots[k].still && sway(s)->knots[k].value == 0.5;
        if (kept != (edit->is_cut ? 0 : edit->copies)) fail_msg("%s: %d still knots have a value", edit->steps, kept);
        session_close(s);
    }
}

/// Shift+P again, or the button. A knot that was loaded still has no value, so it stays where it is seen.
TEST(a_value_comes_back)
{
    static const struct row {
        const char *knot;
        double high; ///< set meanwhile
        double value;
        const char *said;
    } rows[] = {
        {"<48 2.5>", INFINITY, 2.5, ""},
        {"{'frame': 48, 'value': 2.5, 'im': 0.3, 'slope': 1}", INFINITY, 2.5, ""},
        {"<48 2.5>", 2.25, 2.25, "Held by the limit 2.25"},
        {"{'frame': 48, 'still': true}", INFINITY, 2, ""},
    };
    for (size_t i = 0; i < 2 * sizeof rows / sizeof *rows; i++) {
        const struct row *row = &rows[i / 2];
        const char *makes_still = i / 2 == 3 ? "" : "key Shift+P; said comes to rest at the equilibrium;";
        char scene[512];
        struct session session, *const s = &session;
        snprintf(scene, sizeof scene,
                 "{'wiggly': 2, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'equilibrium': 2, "
                 "'knots': [<24 2.125>, %s]}]}",
                 row->knot);
        session_open(s, scene);
        hands(s, "click knot(sway,1); %s finds equilibrium; finds follow.equilibrium; sway.1.still 1; sway@48 2",
              makes_still);
        assert_loads_again(s->document);
        if (row->high < INFINITY) {
            const struct param high = param_number(row->high);
            assert_done(edit_parameter(s->document, 0, PARAMETER_HIGH, &high, &error));
            session_frame(s);
        }
        hands(s, "%s; sway.1.still 0; sway.1.posed 0; sway.1.sloped 0; sway.1.value %g",
              i % 2 ? "click holds.value" : "key Shift+P", row->value);
        assert_said(s->editor, row->said);
        session_close(s);
    }
}

/// Shift+F finds the same with the value that a still knot keeps as without one.
TEST(a_kept_value_explains_nothing)
{
    static const char *const knots[] = {"'value': 9", "'still': true"};
    double found[2];
    for (int i = 0; i < 2; i++) {
        char scene[512];
        struct session session, *const s = &session;
        snprintf(scene, sizeof scene,
                 "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'equilibrium': 2, 'knots': [<0 "
                 "3>, <9 1.1>, <18 2.8>, <27 1.3>, {'frame': 60, %s}]}]}",
                 knots[i]);
        session_open(s, scene);
        hands(s, "click knot(sway,4); %s key Shift+F; said Best; sway.frequency 1.3333 ~0.02",
              i == 0 ? "key Shift+P;" : "");
        found[i] = s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value;
        session_close(s);
    }
    assert_near(found[0], found[1], 0);
}

/// Alt+P and the button, for all selected knots but still ones, in one step each.
WALK(knots_settle_and_do_not, session_open(s, HOLDING),
     "keep; key Ctrl+A Alt+P; sway.settles 1 1 0 1; click settles; sway.settles 0 0 0 0; key 2*Ctrl+Z; kept;"
     "click knot(sway,2); key Alt+P; said no value to settle at; kept")

TEST(edits_of_the_scene_keep_what_knots_hold)
{
    static const double phases[] = {0.3, 0.45};
    struct document *document = document_of_scene(HOLDING);
    assert_done(edit_spline_copy(document, 0, &error));
    assert_held("a copy", document->splines[1], phases, 1);
    assert_done(edit_fps(document, 48, true, &error));
    assert_held("another rate", document->splines[0], phases, 1);
    assert_done(edit_range(document, 40, 240, RANGE_MOVE, &error));
    assert_held("a shorter range", document->splines[0], phases, 1);
    assert_loads_again(document);
    document_destroy(document);
}

#define RESTS_AT_2(knots)                                                                                            \
    "{'wiggly': 2, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': "                      \
    "0.1, 'equilibrium': 2, 'knots': [" knots ", {'frame': 48, 'still': true}]}]}"

/// T goes by the knots that can have a slope, and aims at where a still knot is, not at 0: from 2 to 2.
WALK(slopes_beside_a_still_knot, session_open(s, RESTS_AT_2("<24 2>, <36 3>")),
     "key Ctrl+A Ctrl+T; sway.1.slope 0; key T; sway.1.sloped 0")

/// A still knot is picked up where it is seen.
SESSION_TEST(a_still_knot_is_where_it_is_seen, session_open(s, RESTS_AT_2("<24 2.5>")))
{
    hands(s, "hover knot(sway,1)");
    assert_ptr_equal(hovered(s->editor), &thing_knot);
    assert_non_null(shown_text(
        s->editor, "Comes to rest at the equilibrium; Shift+P gives it a value. Drag it in time (Ctrl: off frames)"));
}

// --- keep: what an edit leaves as it is ---

enum { FRAMES = 240, EDITED = 200, MOST = 7 };

/// Random knots; some are poses, still or have a slope. Some layouts loop, some swing about a moving equilibrium.
static void write_scene(uint64_t *seed, char *text)
{
    const bool loops = uniform(seed) < 0.4, moves = uniform(seed) < 0.4;
    const int count = loops ? 1 + (int)(uniform(seed) * 6) : 3 + (int)(uniform(seed) * 4);
    text += sprintf(text,
                    "{'wiggly': 1, 'frames': [0, %d], 'splines': [{'name': 'sway', 'frequency': %.3f, "
                    "'damping': %.3f, 'wind_up': %.2f, 'start': '%s', %s'knots': [",
                    FRAMES, 0.4 + 2 * uniform(seed), 0.3 * uniform(seed), 0.3 + uniform(seed),
                    loops ? "loop" : "free", moves ? "'equilibrium': {'spline': 'base'}, " : "");
    for (int k = 0; k < count; k++) {
        const double what = uniform(seed);
        const int frame = 10 + 32 * k + (int)(20 * uniform(seed));
        text += sprintf(text, "%s{'frame': %d", k ? ", " : "", frame);
        if (what < 0.1 && k > 0) {
            text += sprintf(text, ", 'still': true}");
            continue;
        }
        text += sprintf(text, ", 'value': %.3f", 2 * uniform(seed) - 1);
        if (what > 0.1 && what < 0.25) text += sprintf(text, ", 'im': %.3f", uniform(seed) - 0.5);
        if (what > 0.85 && k > 0) text += sprintf(text, ", 'slope': %.3f", 4 * uniform(seed) - 2);
        text += sprintf(text, "}");
    }
    sprintf(text, "]}, {'name': 'base', 'mode': 'cubic', 'start': '%s', 'knots': [<0 0.3>, <90 -0.4>, <170 0.5>]}]}",
            loops ? "loop" : "free");
}

/// The kinds of edits, each of one knot.
enum change { EDIT_VALUE, EDIT_TIME, EDIT_NUDGE, EDIT_DELETE, EDIT_INSERT, EDIT_STILL, EDIT_FREE, EDITS };

/// Edits the k-th knot by hand; returns the first and last sample that it says something of.
static void edit(struct session *s, enum change what, int k, uint64_t *seed, int touched[2])
{
    const int frame = (int)sway(s)->knots[k].frame;
    int to = frame;
    if (what == EDIT_INSERT) {
        const bool last = k + 1 == sway(s)->knot_count;
        const int next = last ? FRAMES : (int)sway(s)->knots[k + 1].frame;
        to = frame + 1 + (int)(uniform(seed) * (next - frame - 2));
        hands(s, "click ruler(%d); key I", to);
    } else if (what == EDIT_VALUE) {
        hands(s, "carry knot(sway,%d) 0 %d 3", k, uniform(seed) < 0.5 ? 31 : -37);
    } else if (what == EDIT_TIME) {
        hands(s, "carry knot(sway,%d) 4f -9 3", k);
    } else {
        const char *nudge = what == EDIT_NUDGE && uniform(seed) < 0.5 ? "Alt+Up" : "Alt+Right";
        const char *const keys[EDITS] = {
            [EDIT_NUDGE] = nudge, [EDIT_DELETE] = "Delete", [EDIT_STILL] = "Shift+P", [EDIT_FREE] = "P"};
        hands(s, "click knot(sway,%d); key %s", k, keys[what]);
    }
    const int at = what == EDIT_DELETE ? -1 : what == EDIT_INSERT ? k + 1 : k;
    if (at >= 0) to = (int)sway(s)->knots[at].frame;
    touched[0] = to < frame || what == EDIT_INSERT ? to : frame;
    touched[1] = to > frame || what == EDIT_INSERT ? to : frame;
}

/// Whether a frame lies from the knot before the touched ones to the knot after them, by the frames before the edit.
static bool is_between(const int *frames, int count, bool loops, const int touched[2], int at)
{
    int before = -1, after = FRAMES + 1;
    for (int k = 0; k < count; k++) {
        if (frames[k] < touched[0] && frames[k] > before) before = frames[k];
        if (frames[k] > touched[1] && frames[k] < after) after = frames[k];
    }
    if (before < 0) before = loops ? frames[count - 1] - FRAMES : -1;
    if (after > FRAMES && loops) after = frames[0] + FRAMES;
    return (at > before && at < after) || (loops && at > before + FRAMES) || (loops && at < after - FRAMES);
}

TEST(an_edit_changes_nothing_beyond_the_next_knot)
{
    int edited = 0, posed = 0;
    for (uint64_t round = 0; edited < EDITED; round++) {
        uint64_t seed = 77 + round;
        struct session session, *const s = &session;
        static double was[3][FRAMES + 1];
        static char scene[4096];
        int frames[MOST], touched[2], poses = 0;
        for (int i = 0; i < 8; i++) uniform(&seed);
        write_scene(&seed, scene);
        session_open(s, scene);
        const wiggly_curve *curve = &s->work.evaluation.curves[0];
        const char *original = session_saved(s);
        const int count = sway(s)->knot_count, k = (int)(uniform(&seed) * count);
        const bool loops = spline_start(sway(s)) == WIGGLY_LOOP;
        const enum change what = (enum change)(round % EDITS);
        for (int n = 0; n < count; n++) frames[n] = (int)sway(s)->knots[n].frame;
        for (int n = 0; n < count; n++) poses -= sway(s)->knots[n].has_phase;
        memcpy(was[0], curve->total, sizeof was[0]);
        memcpy(was[1], curve->re, sizeof was[1]);
        memcpy(was[2], curve->im, sizeof was[2]);
        if (what != EDIT_FREE || sway(s)->knots[k].has_phase) edit(s, what, k, &seed, touched);
        const bool done = strcmp(session_saved(s), original) != 0;
        for (int i = 0; i <= FRAMES && done; i++) {
            if (is_between(frames, count, loops, touched, i)) continue;
            if (was[0][i] != curve->total[i] || was[1][i] != curve->re[i] || was[2][i] != curve->im[i])
                fail_msg("round %d, edit %d of knot %d changes frame %d of %s", (int)round, what, k, i, scene);
        }
        for (int n = 0; n < sway(s)->knot_count; n++) poses += sway(s)->knots[n].has_phase;
        posed += poses > 0;
        edited += done;
        if (done) assert_one_step(s, original);
        session_close(s);
    }
    assert_true(posed > EDITED / 4);
}

static const char SWAY[] = "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': "
                           "0.1, 'wind_up': 0.5, 'knots': [<0 0>, <24 1>, <50 -1>, <70 0.5>]}]}";

/// Off, with Alt held, by a drag that is taken back, or for a knot that settles, nothing becomes a pose; nor for a whole curve.
SESSION_TEST(an_edit_swings_through_on_demand, session_open(s, SWAY))
{
    hands(
        s,
        "keep; pull knot(sway,1) 0 -30 3; sway.posed 0 0 1 0;" // already while dragging
        "with Alt; drag 0 -5 2; sway.posed 0 0 0 0; with; drag 0 -5 2; sway.posed 0 0 1 0; key Escape; release; kept;"
        "key Alt+A; carry knot(sway,1) 0 -30 3; sway.posed 0 0 0 0; key Ctrl+Z Alt+A Alt+P;"
        "sway.settles 0 1 0 0; sway.posed 0 0 0 0; carry knot(sway,1) 0 -30 3; sway.posed 0 0 0 0; key 2*Ctrl+Z");
    document_own_spline(s->document, 0)->parameter[PARAMETER_WIND_UP].value = 0;
    hands(s, "carry knot(sway,1) 0 -30 3; sway.posed 0 0 0 0");
}

/// The second nudge goes on from the first, whose pose has the phase from before both.
SESSION_TEST(nudges_keep_the_first_phase, session_open(s, SWAY))
{
    const double phase = s->work.evaluation.curves[0].im[50];
    hands(s, "click knot(sway,1); key 3*Alt+Up; sway.posed 0 0 1 0; sway.2.phase %.17g ~0", phase);
}

// --- what is let go ---

/// A beast whose tail, chain and ear have lags; `knots` of its two splines.
static void open_beast(struct session *session, const char *knots)
{
    char scene[4096];
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(scene, sizeof scene,
             "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'flick', 'frequency': 1.5, 'damping': 0.1, "
             "'bandwidth': 0.1, 'knots': [%s]}, {'name': 'ear', 'start': 'loop', 'frequency': 2, 'damping': 0.05, "
             "'knots': [%s]}], 'rigs': [{'type': 'model', 'name': 'beast', 'model': '%s'}, {'type': 'chain', 'name': "
             "'tail', 'model': 'beast', 'from': 'tail_1', 'to': 'tail_8', 'channels': [{'spline': 'flick', 'axis': "
             "'side', 'lag': 20, 'gain': 8}]}, {'type': 'chain', 'name': 'ear', 'model': 'beast', 'from': 'ear_L_1', "
             "'to': 'ear_L_2', 'channels': [{'spline': 'ear', 'axis': 'up', 'lag': 70, 'gain': 30}]}]}",
             knots, knots, folder_path("beast.glb"));
    panel_open_models(session, scene);
    session_move(session, 2, 2);
    session_frame(session);
}

static const char two_knots[] = "<12 0.3>, <72 -0.4>";

/// The knot on the sample is a pose, of what the curve shows there. test_solutions.c has what may change then.
static void assert_pose(const struct session *session, int s, int sample)
{
    const struct spline *spline = session->document->splines[s];
    const wiggly_curve *curve = &solved(session->editor)->curves[s];
    const int at = spline_find_knot(session->document, spline, sample);
    assert_true(at >= 0 && spline->knots[at].has_phase);
    assert_near(spline->knots[at].value, curve->total[sample], 1e-9);
    assert_near(spline->knots[at].phase, curve->im[sample], 1e-9);
}

/// Pulls at a frame, and holds still until the point is there.
static void pull_at(struct session *session, double frame, const char *target, double dx, double dy)
{
    float before[2], after[2];
    hands(session, "seek %g; pull %s %g %g 8; wait 30", frame, target, dx, dy);
    session_where(session, target, before);
    session_release(session, BUTTON_LEFT);
    session_where(session, target, after);
    assert_near(hypotf(after[0] - before[0], after[1] - before[1]), 0, 0.01); // letting go moves nothing
}

SESSION_TEST(a_tail_that_is_let_go_is_held, session_open_file(s, "assets/scenes/tail.json"))
{
    const char *before = session_saved(s);
    pull_at(s, 60, "tail(tail,0.9)", 60, -40);
    assert_pose(s, 0, 60);
    assert_pose(s, 1, 60);
    assert_one_step(s, before);
    pull_at(s, 60, "tail(tail,0.9)", -50, 10); // and again, from the pose that it was
    assert_pose(s, 0, 60);
    assert_pose(s, 1, 60);
}

SESSION_TEST(so_are_chains_and_ears, open_beast(s, two_knots))
{
    pull_at(s, 40, "chain(tail,0.9)", 30, 0);
    assert_pose(s, 0, 40);
    pull_at(s, 72, "chain(ear,0.9)", 0, -8); // where there is a knot
    assert_pose(s, 1, 72);
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
