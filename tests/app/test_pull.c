/// Pulls of a limb on the stage: they ask for no more than they need, take a near knot along, and leave what follows alone.
#include "blind.h"
#include "editor/core/core.h"
#include "shown.h"

enum { STEPS = 2, SETTLE = 7 };

static const double TURN = 6.28318530717958647692;

static struct core *core_of(struct blind *b) { return &b->app.work.editor->core; }

static void open_still(struct blind *b, const char *scene)
{
    blind_open(b, scene);
    blind_frame(b);
    if (core_of(b)->view.playback.playing) blind_key(b, KEY_SPACE, 0);
}

static void find(struct blind *b, const char *target, float at[2])
{
    assert_done(editor_target(b->app.work.editor, target, &at[0], &at[1], &error));
}

/// Presses on a target, pulls it by pixels, and lets the pull settle; returns where the press was.
static void pull(struct blind *b, const char *target, double right, double down, unsigned mods, float at[2])
{
    find(b, target, at);
    blind_point(b, at[0], at[1]);
    for (int i = 0; i <= STEPS; i++) {
        const float x = at[0] + (float)(right * i / STEPS), y = at[1] + (float)(down * i / STEPS);
        struct event event = {.kind = EVENT_POINTER, .x = x, .y = y, .mods = mods};
        if (i == 0) event.kind = EVENT_BUTTON, event.action = ACTION_PRESS, event.clicks = 1;
        blind_send(b, event);
        if (i > 0) blind_frame(b);
    }
    blind_frames(b, SETTLE);
}

static void let_go(struct blind *b, const float at[2])
{
    blind_button(b, BUTTON_LEFT, ACTION_RELEASE, at[0], at[1]);
    blind_frame(b);
}

/// The first two splines, the limb's, at the playhead.
static void read_limb(struct blind *b, wiggly_value x[2])
{
    for (int s = 0; s < 2; s++) x[s] = evaluation_at(&b->app.work.evaluation, s, core_of(b)->view.playback.position);
}

/// |x| of both.
static double size_of(const wiggly_value x[2])
{
    return sqrt(x[0].re * x[0].re + x[0].im * x[0].im + x[1].re * x[1].re + x[1].im * x[1].im);
}

/// Pulls by a tenth of a limb's length in 16 directions at 40 frames. What the best direction needs is the least change of x, for the length, of those that
/// get there.
TEST(a_pull_raises_x_at_most_twice_as_far_as_the_best_direction_needs)
{
    enum { FRAMES = 40, WAYS = 16 };
    static const struct {
        const char *scene, *target, *along; ///< `along`: the limb
        int joints;
        double pixels;
    } rows[] = {{NULL, "tail(tail,0.97)", "tail(tail,%.6f)", 24, 28},
                {"assets/scenes/dog.json", "chain(tail,0.97)", "chain(tail,%.6f)", 8, 18},
                {"assets/scenes/hands.json", "character(creature,0.9,0.55)", NULL, 0, 13}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct blind blind, *const b = &blind;
        double worst = 0;
        open_still(b, rows[r].scene);
        const struct document *document = b->app.work.document;
        for (int f = quick_or_all(4, 0); f < FRAMES; f += quick_or_all(5, 1)) { // 9, 19 and 29 are among the worst
            double least = INFINITY, raise = 0;
            char target[64];
            float at[2], to[2];
            blind_point(b, 5, 5);
            playback_seek(core_of(b), round(document->first_frame +
                                            (double)(document->last_frame - document->first_frame) * f / FRAMES));
            blind_frame(b);
            find(b, rows[r].target, at);
            blind_point(b, at[0], at[1]);
            const struct hover *held = &core_of(b)->input.hover; // where the limb covers itself it is another point
            snprintf(target, sizeof target, rows[r].along ? rows[r].along : rows[r].target,
                     (held->joint + held->fraction) / (rows[r].joints + !rows[r].joints));
            for (int w = 0; w < WAYS; w++) {
                const double right = cos(TURN * w / WAYS), down = sin(TURN * w / WAYS);
                wiggly_value before[2], after[2], change[2];
                read_limb(b, before);
                pull(b, target, right * rows[r].pixels, down * rows[r].pixels, 0, at);
                read_limb(b, after);
                find(b, target, to);
                for (int s = 0; s < 2; s++)
                    change[s] = (wiggly_value){.re = after[s].re - before[s].re, .im = after[s].im - before[s].im};
                const double way =
                    (right * (double)(to[0] - at[0]) + down * (double)(to[1] - at[1])) / rows[r].pixels;
                if (way > 0.9) least = fmin(least, size_of(change) / way);
                raise = fmax(raise, size_of(after) - size_of(before));
                blind_key(b, KEY_ESCAPE, 0);
                let_go(b, at);
            }
            if (isfinite(least)) worst = fmax(worst, raise / least);
        }
        printf("%s: %.2f\n", rows[r].target, worst);
        assert_true(worst < 2);
        blind_close(b);
    }
}

static const struct spline *sway(const struct blind *b) { return b->app.work.document->splines[0]; }

/// The nearest knot within a quarter of a period, here 6 frames, goes to the pose; with Alt a new one is set beside it.
TEST(a_pull_takes_a_near_knot_along)
{
    static const struct {
        int away;
        unsigned mods;
        bool takes;
    } rows[] = {{-5, 0, true}, {4, 0, true}, {1, MOD_ALT, false}, {7, 0, false}, {0, 0, false}, {0, MOD_ALT, false}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct blind blind, *const b = &blind;
        float at[2];
        open_still(b, NULL);
        const int knots = sway(b)->knot_count, frame = (int)sway(b)->knots[1].frame;
        const unsigned id = sway(b)->knots[1].id;
        assert_near(sway(b)->parameter[PARAMETER_FREQUENCY].value, 1, 0);
        playback_seek(core_of(b), frame + rows[r].away);
        blind_frame(b);
        pull(b, "tail(tail,0.97)", 0, -20, rows[r].mods, at);
        const char *hint = core_of(b)->input.drag.hint;
        assert_true(rows[r].mods ? !hint
                                 : !rows[r].takes || strstr(hint, "comes along")); // the other spline's may, too
        let_go(b, at);
        const int pose = spline_find_knot(b->app.work.document, sway(b), frame + rows[r].away);
        assert_true(pose >= 0 && sway(b)->knots[pose].has_phase);
        assert_int_equal(sway(b)->knots[pose].id == id, rows[r].takes || rows[r].away == 0);
        assert_int_equal(sway(b)->knot_count, knots + (rows[r].takes || rows[r].away == 0 ? 0 : 1));
        blind_key(b, 'Z', MOD_CTRL);
        assert_int_equal(sway(b)->knot_count, knots);
        assert_near(sway(b)->knots[1].frame, frame, 0);
        blind_close(b);
    }
}
