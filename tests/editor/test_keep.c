/// Keep: an edit changes nothing before the knot before it, nor beyond the next one.
#include "session.h"
#include "uniform.h"

enum { FRAMES = 240, EDITED = 200, MOST = 7 };

/// Random knots; some are poses, still or have a slope. Some layouts loop, some swing about a moving equilibrium.
static void write_scene(uint64_t *seed, char *text, size_t size)
{
    const bool loops = uniform(seed) < 0.4, moves = uniform(seed) < 0.4;
    const int count = loops ? 1 + (int)(uniform(seed) * 6) : 3 + (int)(uniform(seed) * 4);
    size_t n = (size_t)snprintf(text, size,
                                "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [{\"name\": \"sway\", "
                                "\"frequency\": %.3f, \"damping\": %.3f, \"wind_up\": %.2f, \"start\": \"%s\", "
                                "%s\"knots\": [",
                                FRAMES, 0.4 + 2 * uniform(seed), 0.3 * uniform(seed), 0.3 + uniform(seed),
                                loops ? "loop" : "free", moves ? "\"equilibrium\": {\"spline\": \"base\"}, " : "");
    for (int k = 0; k < count; k++) {
        const double what = uniform(seed);
        const int frame = 10 + 32 * k + (int)(20 * uniform(seed));
        n += (size_t)snprintf(text + n, size - n, "%s{\"frame\": %d", k ? ", " : "", frame);
        if (what < 0.1 && k > 0) {
            n += (size_t)snprintf(text + n, size - n, ", \"still\": true}");
            continue;
        }
        n += (size_t)snprintf(text + n, size - n, ", \"value\": %.3f", 2 * uniform(seed) - 1);
        if (what > 0.1 && what < 0.25)
            n += (size_t)snprintf(text + n, size - n, ", \"im\": %.3f", uniform(seed) - 0.5);
        if (what > 0.85 && k > 0)
            n += (size_t)snprintf(text + n, size - n, ", \"slope\": %.3f", 4 * uniform(seed) - 2);
        n += (size_t)snprintf(text + n, size - n, "}");
    }
    snprintf(text + n, size - n,
             "]}, {\"name\": \"base\", \"mode\": \"cubic\", \"start\": \"%s\", \"knots\": [{\"frame\": 0, \"value\": "
             "0.3}, {\"frame\": 90, \"value\": -0.4}, {\"frame\": 170, \"value\": 0.5}]}]}",
             loops ? "loop" : "free");
}

static const struct spline *sway(const struct session *s) { return s->document->splines[0]; }

/// The kinds of edits, each of one knot.
enum edit { EDIT_VALUE, EDIT_TIME, EDIT_NUDGE, EDIT_DELETE, EDIT_INSERT, EDIT_STILL, EDIT_FREE, EDITS };

/// Edits the k-th knot by hand; returns the first and last sample that it says something of.
static void edit(struct session *s, enum edit what, int k, uint64_t *seed, int touched[2])
{
    char target[64], ruler[64];
    const int frame = (int)sway(s)->knots[k].frame;
    int to = frame;
    snprintf(target, sizeof target, "knot(sway,%d)", k);
    if (what == EDIT_INSERT) {
        const bool last = k + 1 == sway(s)->knot_count;
        const int next = last ? FRAMES : (int)sway(s)->knots[k + 1].frame;
        to = frame + 1 + (int)(uniform(seed) * (next - frame - 2));
        snprintf(ruler, sizeof ruler, "ruler(%d)", to);
        session_click(s, ruler);
        session_key(s, 'I', 0);
    } else if (what == EDIT_VALUE) {
        session_carry(s, target, 0, uniform(seed) < 0.5 ? 31 : -37, 3);
    } else if (what == EDIT_TIME) {
        float ends[2][2];
        session_where(s, "curve(sway,10,0)", ends[0]);
        session_where(s, "curve(sway,20,0)", ends[1]);
        session_carry(s, target, (ends[1][0] - ends[0][0]) * 0.4f, -9, 3);
    } else {
        session_click(s, target);
        if (what == EDIT_NUDGE) session_key(s, uniform(seed) < 0.5 ? KEY_UP : KEY_RIGHT, MOD_ALT);
        if (what == EDIT_DELETE) session_key(s, KEY_DELETE, 0);
        if (what == EDIT_STILL) session_key(s, 'P', MOD_SHIFT);
        if (what == EDIT_FREE) session_key(s, 'P', 0);
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
        write_scene(&seed, scene, sizeof scene);
        session_open(s, scene);
        const wiggly_curve *curve = &s->work.evaluation.curves[0];
        const char *original = session_saved(s);
        const int count = sway(s)->knot_count, k = (int)(uniform(&seed) * count);
        const bool loops = spline_start(sway(s)) == WIGGLY_LOOP;
        const enum edit what = (enum edit)(round % EDITS);
        for (int n = 0; n < count; n++) frames[n] = (int)sway(s)->knots[n].frame;
        for (int n = 0; n < count; n++) poses -= sway(s)->knots[n].has_phase;
        memcpy(was[0], curve->total, sizeof was[0]);
        memcpy(was[1], curve->re, sizeof was[1]);
        memcpy(was[2], curve->im, sizeof was[2]);
        if (what != EDIT_FREE || sway(s)->knots[k].has_phase) edit(s, what, k, &seed, touched);
        const bool done = strcmp(session_saved(s), original) != 0;
        for (int i = 0; i <= FRAMES && done; i++) {
            if (is_between(frames, count, loops, touched, i)) continue;
            assert_true(was[0][i] == curve->total[i] && was[1][i] == curve->re[i] && was[2][i] == curve->im[i]);
        }
        for (int n = 0; n < sway(s)->knot_count; n++) poses += sway(s)->knots[n].has_phase;
        posed += poses > 0;
        edited += done;
        if (done) assert_one_step(s, original);
        session_close(s);
    }
    assert_true(posed > EDITED / 4);
}

static const char SWAY[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, "
    "\"wind_up\": 0.5, \"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 24, \"value\": 1}, "
    "{\"frame\": 50, \"value\": -1}, {\"frame\": 70, \"value\": 0.5}]}]}";

/// Off, with Alt held, by a drag that is taken back, or for a knot that settles, nothing becomes a pose; nor for a whole curve.
SESSION_TEST(an_edit_swings_through_on_demand, session_open(s, SWAY))
{
    const char *original = session_saved(s);
    session_pull(s, "knot(sway,1)", 0, -30, 3);
    assert_true(sway(s)->knots[2].has_phase && !sway(s)->knots[3].has_phase); // already while dragging
    s->mods = MOD_ALT;
    session_drag(s, 0, -5, 2);
    assert_false(sway(s)->knots[2].has_phase);
    s->mods = 0;
    session_drag(s, 0, -5, 2);
    assert_true(sway(s)->knots[2].has_phase);
    session_key(s, KEY_ESCAPE, 0);
    session_release(s, BUTTON_LEFT);
    assert_saved(s, original);
    session_key(s, 'A', MOD_ALT);
    session_carry(s, "knot(sway,1)", 0, -30, 3);
    assert_false(sway(s)->knots[2].has_phase);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'A', MOD_ALT);
    session_key(s, 'P', MOD_ALT);
    assert_true(sway(s)->knots[1].settles && !sway(s)->knots[2].has_phase);
    session_carry(s, "knot(sway,1)", 0, -30, 3);
    assert_false(sway(s)->knots[2].has_phase);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'Z', MOD_CTRL);
    document_own_spline(s->document, 0)->parameter[PARAMETER_WIND_UP].value = 0;
    session_carry(s, "knot(sway,1)", 0, -30, 3);
    assert_false(sway(s)->knots[2].has_phase);
}

/// The second nudge goes on from the first, whose pose has the phase from before both.
SESSION_TEST(nudges_keep_the_first_phase, session_open(s, SWAY))
{
    const double phase = s->work.evaluation.curves[0].im[50];
    session_click(s, "knot(sway,1)");
    for (int n = 0; n < 3; n++) session_key(s, KEY_UP, MOD_ALT);
    assert_true(sway(s)->knots[2].has_phase && sway(s)->knots[2].phase == phase);
    assert_false(sway(s)->knots[3].has_phase);
}
