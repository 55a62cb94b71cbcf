/// Playback: the real clock, speed, the part that is played, and scrubbing. And what plays: things that swing can be caught, figures play below
/// their captions, and a tail that is keyed nowhere follows its body.
#include "hands.h"

#include "editor/stage/state.h"

/// 24 frames a second, two samples a frame: a position of 2 is one frame.
static void open_at(struct session *s, double frame)
{
    panel_open(s,
               "{'frames': [0, 100], 'substeps': 2, 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, "
               "'knots': [<0 0>, <40 1>]}]}",
               1280, 720);
    seek(s->editor, frame);
}

/// Its own frame is 1/60 s.
WALK(playing_keeps_real_time, open_at(s, 10), "key Space; pass 0.5; pass 0.25; playhead 28.4")

SESSION_TEST(speed_is_a_matter_of_the_view, open_at(s, 10))
{
    hands(s, "type -; speed 0.5; type -; speed 0.25; type -; speed 0.1; type -; speed 0.1");
    playback_of(s->editor)->playing = true;
    hands(s, "pass 1; playhead 12.4; type +; speed 0.25; type +; speed 0.5; type +; speed 1; type +; speed 2;"
             "type +; speed 4; type +; speed 4");
    seek(s->editor, 0);
    playback_of(s->editor)->playing = true;
    hands(s, "pass 0.5; playhead 48");
    assert_true(history_is_saved(s->history));
}

/// Whatever the time between pictures, the clock is kept; whole frames without a picture are counted, from the start of playing.
SESSION_TEST(dropped_frames_are_counted, open_at(s, 0))
{
    hands(s, "key Space");
    for (int i = 0; i < 119; i++) editor_advance(s->editor, 1.0 / 60);
    hands(s, "dropped 0; playhead 48; pass 0.25; dropped 5;"     // from 48 to 54: 49 … 53 were not shown
             "pass 0.3125; dropped 11; key 2*Space; dropped 0"); // to 61.5: nor 55 … 60
}

/// What a display of 60 pictures a second cannot show at four times the speed was not dropped.
SESSION_TEST(fast_is_not_dropped, open_at(s, 0))
{
    playback_of(s->editor)->speed = 4;
    hands(s, "key Space");
    for (int i = 0; i < 200; i++) editor_advance(s->editor, 1.0 / 60);
    hands(s, "dropped 0");
}

/// From outside it begins at the start, and goes round; without a loop it stops at its end.
SESSION_TEST(a_part_is_played, open_at(s, 20))
{
    hands(s, "key Ctrl+Home");
    seek(s->editor, 30);
    hands(s, "key Ctrl+End");
    seek(s->editor, 80);
    hands(s, "key Space; playhead 20.4; pass 0.25; playhead 26.4; pass 0.25; playhead 22.4; key Ctrl+L; pass 1;"
             "playhead 30; playing 0; key Space; playhead 20.4");
}

/// The playhead stays. Escape takes a drag back; of a shorter scene the part is what there still is of it.
SESSION_TEST(a_part_is_dragged_on_the_ruler, open_at(s, 5))
{
    hands(s,
          "with Shift; press ruler(60.2); point ruler(40.3); part 40 60; release; playhead 5; press; point ruler(90);"
          "part 40 90; key Escape; part 40 60; release");
    history_begin(s->history, "Range", 0);
    assert_done(edit_range(s->document, 0, 50, RANGE_REFUSE, &error));
    history_end(s->history);
    hands(s, "part 40 50");
    history_undo(s->history);
    hands(s, "click; part 0 100");
}

/// A part without an end, or with all of the scene in it, is all of it; one after its end goes to the scene's end.
SESSION_TEST(a_part_without_an_end_is_all, open_at(s, 40))
{
    hands(s, "key Ctrl+End; part 0 40; seek 60; key Ctrl+Home; part 60 100; seek 0; key Ctrl+Home; part 0 100");
    assert_false(plays_part(s->editor));
}

/// Scrubbing shows frames exactly, bit for bit a sample, and what lies between them with Ctrl, from the press on.
SESSION_TEST(scrubbing_shows_frames, open_at(s, 0))
{
    for (int frame = 7; frame < 90; frame += 13)
        hands(s, "press ruler(%d.3); playhead %d ~0; point ruler(%d.4); playhead %d ~0; release", frame, frame,
              frame + 1, frame + 1);
    hands(s, "with Ctrl; press ruler(33.4); playhead 33.4 ~0.01; point ruler(35.6); playhead 35.6 ~0.01; release");
}

SESSION_TEST(controls_are_clicked, open_at(s, 10))
{
    hands(s, "click widget(play); playing 1; click widget(play); playing 0; click widget(loop); looping 0;"
             "click widget(speed); speed 2; with Shift; click widget(speed); click widget(speed); speed 0.5; with;"
             "wheel -1; speed 0.25; point widget(speed)");
    session_press(s, BUTTON_RIGHT, 1);
    session_release(s, BUTTON_RIGHT);
    hands(s, "speed 1; sway.knots 2");
}

// --- what swings is caught ---

#define SWINGS(x)                                                                                                    \
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.02, 'start': "                    \
    "'loop', 'knots': [<0 1>, <48 1>]}, {'name': 'run', "                                                            \
    "'mode': 'cubic', 'start': 'loop', 'knots': [<0 0>, {'frame': 48, "                                              \
    "'value': 9}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'position': [" x ", 0.26, 0], "                       \
    "'channels': [{'spline': 'sway', 'lag': 6, 'gain': 6}]}]}"

/// Where the pointer was put, nothing is after a quarter of a second; the press still takes what it was put on. While the scene stands, what
/// is pressed is what is seen: the camera turns.
TEST(what_swings_is_caught)
{
    static const struct {
        const char *scene, *steps, *taken;
    } rows[] = {{SWINGS("0"), "point tail(tail,0.95); wait 15", "Pull tail"},
                {SWINGS("{'spline': 'run'}"), "point body(tail); wait 15", "Move body"},
                {SWINGS("0"), "point tail(tail,0.95); wait 15; key Space", NULL}};
    for (int i = 0; i < 3; i++) {
        struct session session, *const s = &session;
        session_open(s, rows[i].scene);
        hands(s, "key Space; wait 30; %s", rows[i].steps);
        if (rows[i].taken && hovered(s->editor)) fail_msg("%s is still there", rows[i].taken);
        hands(s, "press");
        if (rows[i].taken) assert_string_equal(dragged(s->editor), rows[i].taken);
        if (!rows[i].taken) assert_null(dragged(s->editor));
        session_close(s);
    }
}

/// The highest point of any tail or body over the whole scene, pixels from the stage's upper edge.
static float highest(struct session *s)
{
    const struct stage *stage = s->editor->stage;
    float y = INFINITY;
    for (int t = 0; t < stage->tail_count; t++) {
        const float *base = stage->strands[t].pose.matrix[0] + 12;
        const float ears[3] = {base[0], base[1] + 0.8f, base[2] - 0.4f};
        float xy[2];
        assert_true(stage_project_point(s->editor->stage, ears, xy));
        y = fminf(y, xy[1]);
        for (int n = 0; n < stage->strands[t].pose.count; n++) {
            stage_project_point(s->editor->stage, stage->strands[t].pose.matrix[n] + 12, xy);
            y = fminf(y, xy[1]);
        }
    }
    return y - layout_of(s->editor)->stage.y;
}

TEST(figures_play_below_their_captions)
{
    for (int figure = 1; figure <= 6; figure++) {
        char path[64];
        struct session session, *const s = &session;
        snprintf(path, sizeof path, "assets/scenes/figure%d.json", figure);
        session_open_file(s, path);
        editor_open(s->editor, &s->world);
        hands(s, "wait 1; playing 1");
        const float caption = caption_height(layout_of(s->editor)->stage, s->document);
        assert_true(caption > 30);
        for (int i = 0; i < 120; i++) {
            session_frame(s);
            if (highest(s) <= caption) fail_msg("%s: %g is in the caption", path, (double)highest(s));
        }
        session_close(s);
    }
}

/// Two tails have their names at their feet, each behind a dot in the colour of its curve.
SESSION_TEST(two_tails_are_told_apart,
             session_open(s,
                          "{'frames': [0, 24], 'splines': [{'name': 'a', 'color': '#ff8000'}, {'name': 'b', 'color': "
                          "'#0080ff'}], 'rigs': [{'type': 'tail', 'name': 'old', 'channels': [{'spline': 'a'}]}, "
                          "{'type': 'tail', 'name': 'new', 'position': [2, 0, 0], 'channels': [{'spline': 'b'}]}]}"))
{
    session_frame(s);
    const struct rect stage = layout_of(s->editor)->stage;
    float x[2] = {0};
    EACH_DRAWN(c, s->editor)
    {
        if (c->kind != DRAW_TEXT || !rect_contains(stage, c->x, c->y)) continue;
        for (int t = 0; t < 2; t++) {
            if (strcmp(drawn_by(s->editor)->text + c->first, t ? "new" : "old") != 0) continue;
            x[t] = c->x;
            assert_int_equal(c[-1].color, spline_list_color(s->document, t));
        }
    }
    assert_true(x[0] > 0 && x[1] > 0 && fabsf(x[0] - x[1]) > 100);
}

// --- assets/scenes/follow.json: a body that hops aside and back, and a tail that is keyed nowhere and follows through ---

enum { JOINTS = 24, FRAMES = 96, X = 12, Y = 13 };

static void open_hops(struct session *s)
{
    session_open_file(s, "assets/scenes/follow.json");
    hands(s, "key Shift+Left");
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
SESSION_TEST(tail_lags_and_settles, open_hops(s))
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
        hands(s, "key Right");
    }
    assert_in_range(far_at - near_at, 3, 7); // 18 joints × 5° of 1.2 Hz: 5 frames
    assert_true(tip_stays_behind >= 4);
    assert_true(last < 0.75 * first);
}

/// It stands on the ground between the hops, and on that of the scene while it hops.
SESSION_TEST(hops_over_the_ground, open_hops(s))
{
    assert_near(posed(s->editor)->matrix[0][Y], 0.26, 1e-3);
    assert_near(posed(s->editor)->ground, 0, 0);
    hands(s, "key 12*Right");
    assert_near(posed(s->editor)->matrix[0][Y], 0.45, 0.02); // stretched, too
    assert_near(posed(s->editor)->ground, 0, 0);
}

/// Playing, stepping and jumping show the same pose at the same time, to the last bit; the last frame is the first again.
SESSION_TEST(playing_is_scrubbing, open_hops(s))
{
    enum { COUNT = 2 * FRAMES };
    static struct pose played[COUNT];
    double at[COUNT];
    hands(s, "hold Space; let Space");
    for (int i = 0; i < COUNT; i++) {
        session_frame(s);
        at[i] = playback_of(s->editor)->position;
        played[i] = *posed(s->editor);
    }
    hands(s, "key Space");
    for (int i = COUNT - 1; i >= 0; i -= 7) {
        playback_of(s->editor)->position = at[i];
        session_frame(s);
        assert_memory_equal(posed(s->editor)->matrix, played[i].matrix, (JOINTS + 1) * sizeof played[i].matrix[0]);
    }
    hands(s, "key Shift+Left");
    struct pose first = *posed(s->editor);
    hands(s, "key Shift+Right");
    assert_memory_equal(posed(s->editor)->matrix, first.matrix, (JOINTS + 1) * sizeof first.matrix[0]);
}

static const char SETTLES[] =
    "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'walk', 'mode': 'cubic', 'knots': [<0 0>, <20 0.4>]}, "
    "{'name': 'swing', 'frequency': 1.5, 'damping': 0.3, 'wind_up': 0.5, 'equilibrium': {'spline': 'walk'}, 'knots': "
    "[<0 0>, {'frame': 40, 'value': 5.4, 'settles': true}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'joints': "
    "24, 'position': [{'spline': 'walk'}, 0.26, 0], 'channels': [{'spline': 'swing', 'axis': 'side', 'of': "
    "'displacement', 'gain': 2}]}]}";

/// A tail that follows its body, and comes to bend by five times its gain, stays so; that the body stands aside does not bend it.
SESSION_TEST(a_tail_that_follows_settles_bent, session_open(s, SETTLES))
{
    hands(s, "click ruler(20)");
    assert_true(fabs(side_bend(posed(s->editor), 3)) < 0.03);
    hands(s, "click ruler(96)");
    assert_near(fabs(side_bend(posed(s->editor), 3)), 10 * 3.14159265358979 / 180, 0.01);
}
