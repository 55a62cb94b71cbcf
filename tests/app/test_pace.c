/// Who keeps the time: the display where swaps wait for it, else the app, at the display's own rate.
#include "near.h"

#include "app/resolution.h"

/// Frames one after the other of `work` seconds each, on a display whose swaps wait for its next picture (or do not), behind
/// a queue of so many frames. Returns how long they took.
static double run(struct pace *pace, double *now, int frames, double work, double vsync, int queue)
{
    const double start = *now;
    double due = *now, shown = *now;
    for (int i = 0; i < frames; i++) {
        const double begin = fmax(*now, due);
        double done = begin + work;
        if (vsync > 0) {
            shown = vsync * ceil(fmax(done, shown + 0.5 * vsync) / vsync);
            done = fmax(done, shown - queue * vsync);
        }
        due = pace_next(pace, due, begin);
        pace_swapped(pace, done, true);
        *now = done;
    }
    return *now - start;
}

TEST(a_display_that_holds_keeps_the_time)
{
    const double rates[] = {60, 75, 90, 120, 144, 240};
    for (int i = 0; i < 18; i++) {
        struct pace pace = {0};
        double now = 3.217;
        pace_set_rate(&pace, rates[i % 6]);
        run(&pace, &now, 500, 0.0005, 1 / rates[i % 6], i / 6);
        assert_false(pace.limits);
        assert_near(run(&pace, &now, 500, 0.0005, 1 / rates[i % 6], i / 6), 500 / rates[i % 6], 3 / rates[i % 6]);
    }
}

TEST(without_one_the_app_does_at_the_display_s_rate)
{
    const double rates[] = {0, 60, 75, 144};
    for (int i = 0; i < 4; i++) {
        struct pace pace = {0};
        double now = 3.217, rate = rates[i] > 0 ? rates[i] : 60;
        pace_set_rate(&pace, rates[i]);
        run(&pace, &now, 60, 0.002, 0, 0);
        assert_true(pace.limits);
        assert_near(run(&pace, &now, 500, 0.002, 0, 0), 500 / rate, 2 / rate);
    }
}

TEST(slow_frames_are_never_held_up)
{
    struct pace pace = {0};
    double now = 1;
    pace_set_rate(&pace, 60);
    assert_near(run(&pace, &now, 100, 0.03, 0, 0), 3, 1e-6);
    assert_false(pace.limits);
    pace.limits = true;
    assert_near(run(&pace, &now, 100, 0.03, 0, 0), 3, 1e-6);
}

TEST(another_display_is_judged_anew)
{
    struct pace pace = {0};
    double now = 1;
    pace_set_rate(&pace, 60);
    run(&pace, &now, 60, 0.001, 0, 0);
    pace_set_rate(&pace, 60);
    assert_true(pace.limits);
    pace_set_rate(&pace, 144);
    assert_false(pace.limits);
}

TEST(waiting_for_input_says_nothing)
{
    struct pace pace = {0};
    for (int i = 0; i < 200; i++) pace_swapped(&pace, 0.004 * i, i % 5 != 0);
    assert_false(pace.limits);
}
