/// When the stage is drawn at a lower resolution, and when exactly again.
#include "near.h"

#include "app/resolution.h"

static const double frame = 1.0 / 60;

/// Moves for that many frames of that cost; returns the scale at the end.
static float move_at(struct resolution *r, double *now, int frames, struct resolution_cost cost)
{
    float scale = 1;
    for (int i = 0; i < frames; i++, *now += frame) {
        scale = resolution_choose(r, r->hash + 1, *now);
        resolution_measure(r, &cost);
    }
    return scale;
}

/// Frames of so long, of which drawing takes all but `other`.
static float move(struct resolution *r, double *now, int frames, double ms, double other)
{
    return move_at(r, now, frames, (struct resolution_cost){.before = other, .draw = ms - other});
}

static struct resolution adapting(void)
{
    struct resolution r;
    assert_true(resolution_parse(&r, "auto"));
    return r;
}

TEST(slow_frames_lower_it_and_stillness_restores_it)
{
    struct resolution r = adapting();
    double now = 10;
    assert_near(move(&r, &now, 30, 20, 1), 1, 0);
    assert_near(move(&r, &now, 10, 45, 1), 0.5, 0.13);
    assert_false(resolution_is_exact(&r));
    assert_true(resolution_wait(&r, now) > 0);
    now += 0.2;
    assert_near(resolution_wait(&r, now), 0, 0);
    assert_near(resolution_choose(&r, r.hash, now), 1, 0);
    assert_true(resolution_is_exact(&r) && isinf(resolution_wait(&r, now)));
    assert_near(resolution_choose(&r, r.hash + 1, now + 5), 1, 0); // one change is no movement
    assert_true(resolution_choose(&r, r.hash + 1, now + 5 + frame) < 1);
}

TEST(it_does_not_flicker)
{
    struct resolution r = adapting();
    double now = 10;
    int changes = 0;
    float before = 1;
    // 40 ms at full resolution, 20 ms below: quick enough to try again and again.
    for (int i = 0; i < 3600; i++) {
        float scale = move(&r, &now, 1, r.moving == 1 || r.moving == 0 ? 40 : 20, 1);
        if (scale != before) changes++;
        before = scale;
    }
    assert_in_range(changes, 3, 15);
}

TEST(one_slow_frame_now_and_then_changes_nothing)
{
    struct resolution r = adapting();
    double now = 10;
    for (int i = 0; i < 50; i++) {
        assert_near(move(&r, &now, 1, 80, 1), 1, 0);
        assert_near(move(&r, &now, 5, 10, 1), 1, 0);
    }
}

TEST(a_slow_solver_does_not_blur_the_stage)
{
    struct resolution r = adapting();
    double now = 10;
    assert_near(move(&r, &now, 100, 60, 50), 1, 0);
}

/// Without a clock on the graphics card, its work is in the swap; with one, the swap only waits for a slow display.
TEST(waiting_for_the_display_is_no_work)
{
    struct resolution r = adapting(), at_24_hz = adapting(), slow_card = adapting();
    double now = 10;
    assert_true(move_at(&r, &now, 100, (struct resolution_cost){.before = 1, .draw = 1, .swap = 40}) < 1);
    assert_near(move_at(&at_24_hz, &now, 100, (struct resolution_cost){.before = 1, .draw = 1, .swap = 40, .gpu = 5}),
                1, 0);
    assert_true(
        move_at(&slow_card, &now, 100, (struct resolution_cost){.before = 1, .draw = 1, .swap = 1, .gpu = 40}) < 1);
}

/// The card's clock still tells of the old resolution for a few frames: that is no reason for a second step.
TEST(a_step_is_judged_by_its_own_frames)
{
    struct resolution r = adapting();
    double now = 10;
    while (r.moving == 0) move(&r, &now, 1, 40, 1);
    assert_near(move(&r, &now, 4, 40, 1), 0.5, 0);
    assert_near(move(&r, &now, 30, 28, 1), 0.5, 0);
}

TEST(a_busy_moment_is_forgotten)
{
    struct resolution r = adapting();
    double now = 10;
    assert_true(move(&r, &now, 20, 80, 1) < 1);
    assert_near(move(&r, &now, 400, 12, 1), 1, 0);
    assert_near(r.moving, 1, 0); // there is nothing sharper
}

TEST(words_of_the_command_line)
{
    struct resolution r;
    assert_true(resolution_parse(&r, "0.5") && !r.adapts);
    double now = 0;
    assert_near(move(&r, &now, 100, 80, 1), 0.5, 0);
    assert_true(resolution_parse(&r, "1") && resolution_is_exact(&r));
    const char *const bad[] = {"", "0", "0.2", "1.5", "half", "0.5x", "nan"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) assert_false(resolution_parse(&r, bad[i]));
}
