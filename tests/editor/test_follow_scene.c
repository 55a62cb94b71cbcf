/// assets/scenes/follow.json: a body that hops aside and back, and a tail that is keyed nowhere and follows through.
#include "panel_session.h"

enum { JOINTS = 24, FRAMES = 96, X = 12, Y = 13 };

static void open_scene(struct session *s)
{
    struct document *document = document_of_file("assets/scenes/follow.json");
    char *text = text_of_document(document);
    session_open(s, text);
    free(text);
    document_destroy(document);
    session_key(s, KEY_LEFT, MOD_SHIFT);
}

/// How far joint n turns sideways from the one before, radians.
static double side_bend(const struct pose *pose, int n)
{
    const float *a = pose->matrix[n - 1], *b = pose->matrix[n];
    double x = (double)(a[0] * b[8] + a[1] * b[9] + a[2] * b[10]);
    double z = (double)(a[8] * b[8] + a[9] * b[9] + a[10] * b[10]);
    return atan2(x, z);
}

/// The first step is to +x: joints bend to −x one after the other, and the swing has nearly gone before the second.
SESSION_TEST(test_tail_lags_and_settles, open_scene(s))
{
    double least_near = 0, least_far = 0, first = 0, last = 0;
    int near_at = 0, far_at = 0, tip_stays_behind = 0;
    for (int frame = 0; frame < FRAMES; frame++) {
        const struct pose *pose = posed(s->editor);
        double near = side_bend(pose, 3), far = side_bend(pose, 21);
        double tip = (double)(pose->matrix[JOINTS][X] - pose->matrix[0][X]);
        if (frame >= 8 && frame < 30 && near < least_near) least_near = near, near_at = frame;
        if (frame >= 8 && frame < 40 && far < least_far) least_far = far, far_at = frame;
        if (frame >= 8 && frame <= 18 && tip < 0) tip_stays_behind++;
        if (frame > 18 && frame < 34) first = fmax(first, fabs(tip));
        if (frame >= 42 && frame < 48) last = fmax(last, fabs(tip));
        session_key(s, KEY_RIGHT, 0);
    }
    assert_in_range(far_at - near_at, 3, 7); // 18 joints × 5° of 1.2 Hz: 5 frames
    assert_true(tip_stays_behind >= 4);
    assert_true(last < 0.75 * first);
}

/// It stands on the ground between the hops, and on that of the scene while it hops.
SESSION_TEST(test_hops_over_the_ground, open_scene(s))
{
    assert_near(posed(s->editor)->matrix[0][Y], 0.26, 1e-3);
    assert_near(posed(s->editor)->ground, 0, 0);
    for (int i = 0; i < 12; i++) session_key(s, KEY_RIGHT, 0);
    assert_near(posed(s->editor)->matrix[0][Y], 0.45, 0.02); // stretched, too
    assert_near(posed(s->editor)->ground, 0, 0);
}

/// Playing, stepping and jumping show the same pose at the same time, to the last bit; the last frame is the first again.
SESSION_TEST(test_playing_is_scrubbing, open_scene(s))
{
    static struct pose played[4 * FRAMES];
    session_hold(s, KEY_SPACE, ACTION_PRESS);
    session_hold(s, KEY_SPACE, ACTION_RELEASE);
    double at[4 * FRAMES];
    int count = 0;
    while (count < 4 * FRAMES / 2) {
        session_frame(s);
        at[count] = playback_of(s->editor)->position;
        played[count++] = *posed(s->editor);
    }
    session_key(s, KEY_SPACE, 0);
    for (int i = count - 1; i >= 0; i -= 7) {
        playback_of(s->editor)->position = at[i];
        session_frame(s);
        assert_memory_equal(posed(s->editor)->matrix, played[i].matrix, (JOINTS + 1) * sizeof played[i].matrix[0]);
    }
    session_key(s, KEY_LEFT, MOD_SHIFT);
    struct pose first = *posed(s->editor);
    session_key(s, KEY_RIGHT, MOD_SHIFT);
    assert_memory_equal(posed(s->editor)->matrix, first.matrix, (JOINTS + 1) * sizeof first.matrix[0]);
}

static const char SETTLES[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [{\"name\": \"walk\", \"mode\": \"cubic\", \"knots\": ["
    "{\"frame\": 0, \"value\": 0}, {\"frame\": 20, \"value\": 0.4}]}, {\"name\": \"swing\", \"frequency\": 1.5, "
    "\"damping\": 0.3, \"wind_up\": 0.5, \"equilibrium\": {\"spline\": \"walk\"}, \"knots\": ["
    "{\"frame\": 0, \"value\": 0}, {\"frame\": 40, \"value\": 5.4, \"settles\": true}]}], \"rigs\": [{\"type\": "
    "\"tail\", \"name\": \"tail\", \"joints\": 24, \"position\": [{\"spline\": \"walk\"}, 0.26, 0], \"channels\": "
    "[{\"spline\": \"swing\", \"axis\": \"side\", \"of\": \"displacement\", \"gain\": 2}]}]}";

/// A tail that follows its body, and comes to bend by five times its gain, stays so; that the body stands aside does not bend it.
SESSION_TEST(test_a_tail_that_follows_settles_bent, session_open(s, SETTLES))
{
    session_click(s, "ruler(20)");
    assert_true(fabs(side_bend(posed(s->editor), 3)) < 0.03);
    session_click(s, "ruler(96)");
    assert_near(fabs(side_bend(posed(s->editor), 3)), 10 * 3.14159265358979 / 180, 0.01);
}
