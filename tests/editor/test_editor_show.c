/// What the editor shows, frame by frame: playback, views, the tail that is pulled, and what it costs. Without GL.
#include "session.h"

#include "timing/framelog.h"
#include "ui/theme.h"

static const char TAIL[] =
    "{\"wiggly\": 1, \"frames\": [0, 120], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": "
    "0.08,\"bandwidth\": 0.08, \"start\": \"loop\", \"knots\": [{\"frame\": 0, \"value\": 0.8}, {\"frame\": 40, "
    "\"value\":-1}, {\"frame\": 80, \"value\": 0.6}]}, {\"name\": \"lift\", \"frequency\": 0.5, \"damping\": 0.1, "
    "\"start\":\"loop\", \"knots\": [{\"frame\": 20, \"value\": 0.4}, {\"frame\": 90, \"value\": -0.2}]}], "
    "\"rigs\": [{\"type\":\"tail\", \"name\": \"tail\", \"position\": [0, 0.4, 0], \"channels\": [{\"spline\": "
    "\"sway\", \"axis\": \"side\"},{\"spline\": \"lift\", \"axis\": \"up\", \"gain\": 3}]}]}";

static const float PLOT_TOLERANCE = 0.01f;

static void point_at_tail(struct session *s, float share, float xy[2])
{
    char target[32];
    snprintf(target, sizeof target, "tail(tail,%g)", share);
    assert_done(editor_target(s->editor, target, &xy[0], &xy[1], &error));
}

/// Pulls the tail at `share` by (dx, dy) and waits; asserts that it follows the pointer.
static void pull(struct session *s, float share, float dx, float dy)
{
    float at[2];
    point_at_tail(s, share, at);
    session_move(s, at[0], at[1]);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, dx, dy, 20);
    for (int i = 0; i < 30; i++) session_frame(s);
    point_at_tail(s, share, at);
    assert_near(at[0], s->x, 2);
    assert_near(at[1], s->y, 2);
    session_release(s, BUTTON_LEFT);
}

static int selected_from(const struct session *s, unsigned id)
{
    int count = 0;
    for (; id < s->editor->core.focus.selection.capacity; id++) count += selection_has(selection_of(s->editor), id);
    return count;
}

SESSION_TEST(test_a_pull_taken_back_leaves_nothing_selected, session_open(s, TAIL))
{
    float at[2];
    session_click(s, "ruler(10)"); // no knot is near
    const unsigned next = s->document->next_id;
    point_at_tail(s, 0.9f, at);
    session_move(s, at[0], at[1]);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 30, 10, 5);
    assert_int_equal(selected_from(s, next), 1);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(s->document->next_id, next); // its ids are given again
    assert_int_equal(selected_from(s, next), 0);
}

SESSION_TEST(test_the_tail_follows_the_hand, session_open(s, TAIL))
{
    session_click(s, "ruler(60)");
    const char *original = session_saved(s);
    pull(s, 0.95f, 60, -40);
    assert_int_equal(s->document->splines[0]->knot_count, 4); // one knot in each channel, at the playhead
    assert_int_equal(s->document->splines[1]->knot_count, 3);
    assert_near(s->document->splines[0]->knots[2].frame, 60, 0);
    pull(s, 0.5f, -20, 10); // moves the knots that are there now
    assert_int_equal(s->document->splines[0]->knot_count, 4);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'Z', MOD_CTRL);
    assert_null(history_undo_label(s->history)); // a pull is one step
    assert_saved(s, original);
}

SESSION_TEST(test_a_pull_out_of_reach_stays_calm, session_open(s, TAIL))
{
    float at[2];
    point_at_tail(s, 0.9f, at);
    session_move(s, at[0], at[1]);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, -5000, 3000, 5);
    for (int i = 0; i < 100; i++) session_frame(s);
    for (int i = 0; i < s->work.evaluation.samples; i++)
        assert_true(fabs(s->work.evaluation.curves[0].total[i]) < 100);
    session_key(s, KEY_ESCAPE, 0);
    assert_int_equal(s->document->splines[0]->knot_count, 3);
}

/// However often the hand goes around the root, the tail winds up once.
SESSION_TEST(test_a_pull_in_circles_winds_up_once, session_open(s, TAIL))
{
    float at[2], root[2];
    point_at_tail(s, 0.05f, root);
    point_at_tail(s, 0.9f, at);
    session_move(s, at[0], at[1]);
    session_press(s, BUTTON_LEFT, 1);
    const float reach = hypotf(at[0] - root[0], at[1] - root[1]), from = atan2f(at[1] - root[1], at[0] - root[0]);
    for (int i = 1; i <= 400; i++) {
        const float angle = from + 0.1f * (float)i;
        session_move(s, root[0] + reach * cosf(angle), root[1] + reach * sinf(angle));
        session_frame(s);
        for (int c = 0; c < 2; c++) // the values of seven radians where it is held
            assert_true(fabs(s->work.evaluation.curves[c].total[0]) < 6.2);
    }
}

/// Wherever the tail's swing stands, the pull is done soon: mostly with the tail in the hand; else that direction gives way.
TEST(test_a_pull_is_done_within_twelve_frames)
{
    int arrived = 0;
    for (int frame = 5; frame < 100; frame += 12) {
        struct session s;
        float at[2], later[2];
        char ruler[32];
        session_open(&s, TAIL);
        snprintf(ruler, sizeof ruler, "ruler(%d)", frame);
        session_click(&s, ruler);
        point_at_tail(&s, 0.9f, at);
        session_move(&s, at[0], at[1]);
        session_press(&s, BUTTON_LEFT, 1);
        session_move(&s, at[0] + 40, at[1] - 30);
        for (int i = 0; i < 12; i++) session_frame(&s);
        point_at_tail(&s, 0.9f, at);
        arrived += hypotf(at[0] - s.x, at[1] - s.y) < 0.5f;
        for (int i = 0; i < 30; i++) session_frame(&s);
        point_at_tail(&s, 0.9f, later);
        assert_near(at[0], later[0], 0.5);
        assert_near(at[1], later[1], 0.5);
        session_close(&s);
    }
    assert_int_equal(arrived, 6); // of 8
}

static bool is_in(const uint64_t *hashes, int count, uint64_t hash)
{
    for (int i = 0; i < count; i++) {
        if (hashes[i] == hash) return true;
    }
    return false;
}

SESSION_TEST(test_playing_redraws_the_playhead_only, session_open(s, TAIL))
{
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 400; i++) session_frame(s); // messages are gone by then
    const struct drawlist *list = drawn_by(s->editor);
    int count = list->count;
    uint64_t *before = malloc((size_t)count * sizeof *before);
    for (int i = 0; i < count; i++) before[i] = list->commands[i].hash;
    session_frame(s);
    assert_int_equal(list->count, count);
    int changed = 0;
    for (int i = 0; i < count; i++) {
        const struct draw_command *command = &list->commands[i];
        if (is_in(before, count, command->hash)) continue;
        changed++;
        bool is_status = command->bounds.y >= 720 - THEME_STATUS_HEIGHT;
        assert_true(is_status || command->bounds.w <= 48);
    }
    assert_in_range(changed, 1, 6);
    free(before);
}

SESSION_TEST(test_nothing_changes_while_nothing_happens, session_open(s, TAIL))
{
    for (int i = 0; i < 400; i++) session_frame(s);
    const struct drawlist *list = drawn_by(s->editor);
    uint64_t first = list->commands[0].hash, sum = 0, again = 0;
    for (int i = 0; i < list->count; i++) sum += list->commands[i].hash * (uint64_t)(i + 1);
    uint64_t stage = editor_stage(s->editor)->hash;
    session_frame(s);
    for (int i = 0; i < list->count; i++) again += list->commands[i].hash * (uint64_t)(i + 1);
    assert_true(first == list->commands[0].hash && sum == again);
    assert_true(stage == editor_stage(s->editor)->hash);
    assert_false(editor_wants_frames(s->editor));
    tell(s->editor, true,
         "The disk is full."); // said between two frames, and to be seen in the next one
    assert_true(editor_wants_frames(s->editor));
    session_frame(s);
    assert_false(editor_wants_frames(s->editor));
}

SESSION_TEST(test_steady_frames_allocate_nothing, session_open(s, TAIL))
{
    session_key(s, KEY_SPACE, 0);
    session_frame(s);
    long before = allocation_count();
    for (int i = 0; i < 60; i++) session_frame(s);
    assert_int_equal(allocation_count() - before, 0); // playing
    session_pull(s, "knot(sway,1)", 10, -20, 5);
    session_frame(s);
    before = allocation_count();
    for (int i = 0; i < 60; i++) session_frame(s);
    assert_int_equal(allocation_count() - before, 0); // a knot is held while it plays
    session_release(s, BUTTON_LEFT);
}

/// Vertices of the active curve (the widest line, or band) in the list.
static const float *active_line(const struct session *s, int *count)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        if ((command->kind != DRAW_LINE && command->kind != DRAW_BAND) || command->width < 2.4f) continue;
        *count = command->count;
        return &list->points[2 * command->first];
    }
    return NULL;
}

SESSION_TEST(test_the_drawn_curve_goes_through_its_knots, session_open(s, TAIL))
{
    for (int k = 0; k < 3; k++) {
        char target[32];
        int count;
        float nearest = 1e9f;
        snprintf(target, sizeof target, "knot(sway,%d)", k);
        session_hover(s, target);
        const float *xy = active_line(s, &count);
        assert_non_null(xy);
        assert_true(count <= 1280); // a vertex a column at most
        for (int i = 0; i < count; i++) {
            nearest = fminf(nearest, hypotf(xy[2 * i] - s->x, xy[2 * i + 1] - s->y));
        }
        assert_near(nearest, 0, PLOT_TOLERANCE);
    }
}

TEST(test_fine_oscillations_are_drawn_as_their_band)
{
    static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 24000], \"splines\": [{\"name\": \"hum\", \"mode\": "
                                "\"real\", \"frequency\": 3,"
                                "\"damping\": 0, \"knots\": [{\"frame\": 0, \"value\": 1}]}]}";
    struct session s;
    int count;
    session_open(&s, scene);
    const float *xy = active_line(&s, &count);
    assert_non_null(xy);
    assert_true(count <= 1280);
    session_point(&s, "curve(hum,12000,0.9)");
    for (int i = 8; i + 8 < count; i++) { // 27 frames a column: the plain samples would show some slow beat
        assert_true(fminf(xy[2 * i + 1], xy[2 * i + 3]) < s.y);
        assert_true(xy[2 * i] < xy[2 * i + 2]);
    }
    session_close(&s);
}

SESSION_TEST(test_playing_and_scrubbing, session_open(s, TAIL))
{
    const struct stage_view *stage = editor_stage(s->editor);
    session_click(s, "ruler(30)");
    assert_false(playback_of(s->editor)->playing);
    uint64_t at_30 = stage->hash;
    session_key(s, KEY_RIGHT, 0);
    assert_true(stage->hash != at_30);
    session_key(s, KEY_LEFT, 0);
    assert_true(stage->hash == at_30); // a pose is a function of the frame alone
    session_key(s, KEY_RIGHT, MOD_SHIFT);
    uint64_t at_end = stage->hash;
    session_key(s, KEY_LEFT, MOD_SHIFT);
    assert_true(stage->hash == at_end); // a loop ends where it starts
    session_click(s, "ruler(30)");
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 299; i++) session_frame(s);
    assert_true(playback_of(s->editor)->playing);
    session_key(s, KEY_SPACE, 0); // 300 frames of 1/60 s are the whole loop of 5 s
    session_click(s, "ruler(30)");
    assert_true(stage->hash == at_30);
}

SESSION_TEST(test_space_and_drag_pans_without_playing, session_open(s, TAIL))
{
    session_point(s, "curve(sway,60,0)");
    float x = s->x, y = s->y;
    session_hold(s, KEY_SPACE, ACTION_PRESS);
    session_press(s, BUTTON_LEFT, 1);
    session_drag(s, 35, -12, 4);
    session_release(s, BUTTON_LEFT);
    session_hold(s, KEY_SPACE, ACTION_RELEASE);
    assert_false(playback_of(s->editor)->playing);
    session_point(s, "curve(sway,60,0)");
    assert_near(s->x, x + 35, 0.1);
    assert_near(s->y, y - 12, 0.1);
    session_key(s, KEY_HOME, 0);
    session_point(s, "curve(sway,60,0)");
    assert_near(s->x, x, 0.1);
}

SESSION_TEST(test_the_wheel_zooms_about_the_pointer, session_open(s, TAIL))
{
    const unsigned mods[] = {0, MOD_CTRL, MOD_SHIFT};
    for (int i = 0; i < 3; i++) {
        session_point(s, "knot(sway,1)");
        float x = s->x, y = s->y;
        s->mods = mods[i];
        session_wheel(s, 3);
        s->mods = 0;
        session_point(s, "knot(sway,1)");
        assert_near(s->x, x, 0.1);
        assert_near(s->y, y, 0.1);
    }
}

SESSION_TEST(test_the_stage_turns_only_by_hand, session_open(s, TAIL))
{
    float before[16], lamp[3];
    memcpy(lamp, editor_stage(s->editor)->key_from, sizeof lamp);
    memcpy(before, editor_stage(s->editor)->view, sizeof before);
    session_click(s, "knot(sway,1)");
    session_key(s, KEY_UP, MOD_ALT);
    assert_memory_equal(before, editor_stage(s->editor)->view, sizeof before);
    session_point(s, "stage(0.05,0.1)");
    session_press(s, BUTTON_RIGHT, 1);
    session_drag(s, 50, 0, 3);
    session_release(s, BUTTON_RIGHT);
    assert_memory_not_equal(before, editor_stage(s->editor)->view, sizeof before);
    assert_memory_equal(lamp, editor_stage(s->editor)->key_from, sizeof lamp); // the light stays with the world
}

/// Whether a text stands in the curves panel.
static bool shows_text(const struct session *s, const char *text)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        bool inside = command->x < 1000 && command->y > 400 && command->y < 696;
        if (command->kind == DRAW_TEXT && inside && strcmp(list->text + command->first, text) == 0) return true;
    }
    return false;
}

/// Paused between two frames, the playhead names the frame on which I sets a knot.
SESSION_TEST(test_the_playhead_names_the_frame_of_the_next_knot, session_open(s, TAIL))
{
    session_click(s, "ruler(50)");
    session_key(s, KEY_SPACE, 0);
    for (int i = 0; i < 3; i++) session_frame(s); // at 24 fps four frames of 1/60 s are 1.6 of the scene's
    session_key(s, KEY_SPACE, 0);
    assert_true(shows_text(s, "52"));
    session_key(s, 'I', 0);
    assert_near(s->document->splines[0]->knots[2].frame, 52, 0);
}

/// V: which way the curves are shown stands beside them for as long as they are. Shift+V: the phase curve, named where it is drawn.
SESSION_TEST(test_the_curves_say_how_they_are_shown, session_open(s, TAIL))
{
    assert_false(shows_text(s, "phase"));
    session_key(s, 'V', MOD_SHIFT);
    assert_true(shows_text(s, "phase"));
    session_key(s, 'V', 0);
    session_key(s, 'V', 0);
    assert_true(shows_text(s, "Cubic"));
    assert_false(shows_text(s, "phase"));
}

/// Home puts everything back into sight where the pointer is: the camera over the stage, else the curves.
SESSION_TEST(test_home_brings_the_tail_back, session_open(s, TAIL))
{
    float before[2], after[2];
    point_at_tail(s, 0.9f, before);
    session_point(s, "stage(0.9,0.2)");
    session_press(s, BUTTON_RIGHT, 1);
    session_drag(s, 90, 30, 3);
    session_release(s, BUTTON_RIGHT);
    session_point(s, "curve(sway,60,0)");
    session_key(s, KEY_HOME, 0);
    point_at_tail(s, 0.9f, after);
    assert_true(fabsf(after[0] - before[0]) > 5);
    session_point(s, "stage(0.9,0.2)");
    session_key(s, KEY_HOME, 0);
    point_at_tail(s, 0.9f, after);
    assert_near(after[0], before[0], 0.01);
    assert_near(after[1], before[1], 0.01);
}

SESSION_TEST(test_small_windows, session_open(s, TAIL))
{
    const float sizes[][2] = {{1280, 720}, {960, 600}, {3000, 1700}, {200, 100}, {1, 1}};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        editor_resize(s->editor, sizes[i][0], sizes[i][1], 1);
        session_frame(s);
        const struct drawlist *list = drawn_by(s->editor);
        assert_false(list->overflow);
        for (int p = 0; p < 2 * list->point_count; p++) assert_true(isfinite(list->points[p]));
    }
}

SESSION_TEST(test_dividers, session_open(s, TAIL))
{
    float height = editor_stage(s->editor)->viewport.h;
    session_carry(s, "divider(stage)", 0, -100, 4);
    assert_near(editor_stage(s->editor)->viewport.h, height - 100, 1);
    session_drag(s, 0, -100, 4); // let go
    assert_near(editor_stage(s->editor)->viewport.h, height - 100, 1);
}

/// A scene with that many knots of alternating values.
static char *scene_with_knots(int knots)
{
    size_t room = 512 + (size_t)knots * 48;
    char *text = malloc(room);
    size_t used = (size_t)snprintf(
        text, room, "{\"wiggly\": 1, \"frames\": [0, 820], \"splines\": [{\"name\": \"s\", \"knots\": [");
    for (int k = 0; k < knots; k++) {
        used += (size_t)snprintf(text + used, room - used, "%s{\"frame\": %d, \"value\": %d%s}", k ? "," : "",
                                 2 * k + 1, k % 3, k % 5 == 4 ? ", \"slope\": 1" : "");
    }
    snprintf(text + used, room - used, "]}]}");
    return text;
}

static void set(struct session *s, enum parameter parameter, double value)
{
    const struct param param = param_number(value);
    assert_done(edit_parameter(s->document, 0, parameter, &param, &error));
}

/// Sets every slider to one of its ends, as the bits of `ends` say, and looks at the curve.
static void assert_finite_at(struct session *s, enum wiggly_mode mode, enum wiggly_start start, int ends)
{
    history_begin(s->history, "extremes", 1);
    set(s, PARAMETER_MODE, mode);
    set(s, PARAMETER_START, start);
    set(s, PARAMETER_FREQUENCY, ends & 1 ? 12 : 0);
    set(s, PARAMETER_DAMPING, ends & 2 ? (mode == WIGGLY_REAL ? 3 : 1) : 0);
    set(s, PARAMETER_BANDWIDTH, ends & 4 ? 1 : 0);
    set(s, PARAMETER_CALM, ends & 8 ? 1 : 0);
    history_end(s->history);
    session_frame(s);
    for (int i = 0; i < s->work.evaluation.samples; i++) assert_true(isfinite(s->work.evaluation.curves[0].total[i]));
    int count = 0;
    assert_non_null(active_line(s, &count));
    assert_true(count > 100);
}

TEST(test_finite_curves_at_every_extreme)
{
    const int knots[] = {0, 1, 2, 400};
    for (int i = 0; i < 4; i++) {
        char *scene = scene_with_knots(knots[i]);
        struct session s;
        session_open(&s, scene);
        for (int mode = 0; mode < 3; mode++) {
            for (int start = 0; start < 3; start++) {
                for (int ends = 0; ends < 16; ends++) {
                    assert_finite_at(&s, (enum wiggly_mode)mode, (enum wiggly_start)start, ends);
                }
            }
        }
        session_close(&s);
        free(scene);
    }
}

SESSION_TEST(test_targets_that_are_not_there, session_open(s, TAIL))
{
    const char *const wrong[] = {"",
                                 "knot",
                                 "knot()",
                                 "knot(sway)",
                                 "knot(nope,0)",
                                 "knot(sway,9)",
                                 "knot(sway,-1)",
                                 "curve(sway,1)",
                                 "stage(a,b)",
                                 "tail(dog,0.5)",
                                 "ruler(1e9)",
                                 "handle(sway,0,1)",
                                 "divider(x)",
                                 "slider(nope)",
                                 "knot(sway,0"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct error error = {0};
        float x, y;
        assert_false(editor_target(s->editor, wrong[i], &x, &y, &error));
        assert_true(error.text[0] != 0);
    }
}
