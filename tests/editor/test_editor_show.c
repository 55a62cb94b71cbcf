/// What the editor shows, frame by frame: playback, views, the tail that is pulled, overlays on the stage, and what it costs. Without GL.
#include "editor/stage/state.h"
#include "hands.h"

#include "timing/framelog.h"
#include "ui/theme.h"

static const char TAIL[] =
    "{'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.08, 'bandwidth': 0.08, 'start': "
    "'loop', 'knots': [{'frame': 0, 'value': 0.8}, {'frame': 40, 'value':-1}, {'frame': 80, 'value': 0.6}]}, "
    "{'name': "
    "'lift', 'frequency': 0.5, 'damping': 0.1, 'start':'loop', 'knots': [{'frame': 20, 'value': 0.4}, {'frame': 90, "
    "'value': -0.2}]}], 'rigs': [{'type':'tail', 'name': 'tail', 'position': [0, 0.4, 0], 'channels': [{'spline': "
    "'sway', 'axis': 'side'},{'spline': 'lift', 'axis': 'up', 'gain': 3}]}]}";

#define TAIL_TEST(name) SESSION_TEST(name, session_open(s, TAIL))

// --- the tail that is pulled ------------------------------------------------------------------------------------------------

/// Pulls the tail at a place by (dx, dy) and waits; asserts that it follows the pointer.
static void pull(struct session *s, const char *target, float dx, float dy)
{
    float at[2];
    session_pull(s, target, dx, dy, 20);
    hands(s, "wait 30");
    session_where(s, target, at);
    assert_near(at[0], s->x, 2);
    assert_near(at[1], s->y, 2);
    session_release(s, BUTTON_LEFT);
}

/// A pull is one step, with one knot in each channel at the playhead; another moves the knots that are there then.
TAIL_TEST(test_the_tail_follows_the_hand)
{
    hands(s, "click ruler(60)");
    pull(s, "tail(tail,0.95)", 60, -40);
    hands(s, "is splines.0.knots.# 4; is splines.1.knots.# 3; is splines.0.knots.2.frame 60");
    pull(s, "tail(tail,0.5)", -20, 10);
    hands(s, "is splines.0.knots.# 4; key Ctrl+Z Ctrl+Z; label; kept");
}

static int selected_from(const struct session *s, unsigned id)
{
    int count = 0;
    for (; id < s->editor->core.focus.selection.capacity; id++) count += selection_has(selection_of(s->editor), id);
    return count;
}

/// Its ids are given again.
TAIL_TEST(test_a_pull_taken_back_leaves_nothing_selected)
{
    hands(s, "click ruler(10)"); // no knot is near
    const unsigned next = s->document->next_id;
    hands(s, "pull tail(tail,0.9) 30 10 5");
    assert_int_equal(selected_from(s, next), 1);
    hands(s, "key Escape");
    assert_int_equal(s->document->next_id, next);
    assert_int_equal(selected_from(s, next), 0);
}

TAIL_TEST(test_a_pull_out_of_reach_stays_calm)
{
    hands(s, "pull tail(tail,0.9) -5000 3000 5; wait 100");
    for (int i = 0; i < s->work.evaluation.samples; i++)
        assert_true(fabs(s->work.evaluation.curves[0].total[i]) < 100);
    hands(s, "key Escape; kept");
}

/// However often the hand goes around the root, the tail winds up once.
TAIL_TEST(test_a_pull_in_circles_winds_up_once)
{
    float root[2];
    session_where(s, "tail(tail,0.05)", root);
    session_point(s, "tail(tail,0.9)");
    session_press(s, BUTTON_LEFT, 1);
    const float reach = hypotf(s->x - root[0], s->y - root[1]), from = atan2f(s->y - root[1], s->x - root[0]);
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
        session_open(&s, TAIL);
        hands(&s, "click ruler(%d); pull tail(tail,0.9) 40 -30 1; wait 11", frame);
        session_where(&s, "tail(tail,0.9)", at);
        arrived += hypotf(at[0] - s.x, at[1] - s.y) < 0.5f;
        hands(&s, "wait 30");
        session_where(&s, "tail(tail,0.9)", later);
        assert_near(hypotf(at[0] - later[0], at[1] - later[1]), 0, 0.5);
        session_close(&s);
    }
    assert_int_equal(arrived, 6); // of 8
}

// --- what a frame costs -----------------------------------------------------------------------------------------------------

static bool is_in(const uint64_t *hashes, int count, uint64_t hash)
{
    for (int i = 0; i < count; i++)
        if (hashes[i] == hash) return true;
    return false;
}

TAIL_TEST(test_playing_redraws_the_playhead_only)
{
    hands(s, "key Space; wait 400"); // messages are gone by then
    const struct drawlist *list = drawn_by(s->editor);
    const int count = list->count;
    int changed = 0;
    uint64_t *before = malloc((size_t)count * sizeof *before);
    for (int i = 0; i < count; i++) before[i] = list->commands[i].hash;
    session_frame(s);
    assert_int_equal(list->count, count);
    for (int i = 0; i < count; i++) {
        const struct draw_command *command = &list->commands[i];
        if (is_in(before, count, command->hash)) continue;
        changed++;
        assert_true(command->bounds.y >= 720 - theme_row() || command->bounds.w <= 48);
    }
    assert_in_range(changed, 1, 6);
    free(before);
}

/// Of all that is drawn, and of the stage.
static void sum(const struct session *s, uint64_t sums[3])
{
    const struct drawlist *list = drawn_by(s->editor);
    sums[0] = list->commands[0].hash;
    sums[1] = 0;
    for (int i = 0; i < list->count; i++) sums[1] += list->commands[i].hash * (uint64_t)(i + 1);
    sums[2] = editor_stage(s->editor)->hash;
}

/// What is said between two frames is to be seen in the next one.
TAIL_TEST(test_nothing_changes_while_nothing_happens)
{
    uint64_t first[3], again[3];
    hands(s, "wait 400");
    sum(s, first);
    session_frame(s);
    sum(s, again);
    assert_memory_equal(first, again, sizeof first);
    hands(s, "is wants.frames 0");
    tell(s->editor, true, "The disk is full.");
    hands(s, "is wants.frames 1; wait; is wants.frames 0");
}

TAIL_TEST(test_steady_frames_allocate_nothing)
{
    static const char *const whiles[] = {"key Space; wait", "pull knot(sway,1) 10 -20 5; wait"};
    for (int held = 0; held < 2; held++) { // it plays; a knot is held while it plays
        hands(s, "%s", whiles[held]);
        const long before = allocation_count();
        for (int i = 0; i < 60; i++) session_frame(s);
        assert_int_equal(allocation_count() - before, 0);
    }
}

/// Only who asks for them gets figures.
TAIL_TEST(test_figures_are_shown_on_request)
{
    tell_figures(s->editor, 0, 75);
    hands(s, "wait 1; shows solve 75 µs (band)");
    s->editor->core.app.stats = false;
    hands(s, "wait 1; hides solve");
}

/// The figures at the right must not cost a redraw every frame.
TAIL_TEST(test_figures_change_twice_a_second)
{
    double last = 0;
    int changes = 0;
    for (int frame = 0; frame < 120; frame++) {
        tell_figures(s->editor, 50 + frame % 7, 200 + frame);
        editor_advance(s->editor, 1.0 / 60);
        changes += s->editor->core.status.shown.solve_us != last;
        last = s->editor->core.status.shown.solve_us;
    }
    assert_in_range(changes, 3, 5);
}

// --- the curves ---------------------------------------------------------------------------------------------------------

/// Vertices of the active curve (the widest line, or band) in the list; a vertex a column at most.
static const float *active_line(const struct session *s, int *count)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        if ((command->kind != DRAW_LINE && command->kind != DRAW_BAND) || command->width < 2.4f) continue;
        *count = command->count;
        assert_true(*count <= 1280);
        return &list->points[2 * command->first];
    }
    fail_msg("no curve is drawn");
    return NULL;
}

TAIL_TEST(test_the_drawn_curve_goes_through_its_knots)
{
    for (int k = 0; k < 3; k++) {
        int count;
        float nearest = 1e9f;
        hands(s, "hover knot(sway,%d)", k);
        const float *xy = active_line(s, &count);
        for (int i = 0; i < count; i++) nearest = fminf(nearest, hypotf(xy[2 * i] - s->x, xy[2 * i + 1] - s->y));
        assert_near(nearest, 0, 0.01);
    }
}

SESSION_TEST(test_fine_oscillations_are_drawn_as_their_band,
             session_open(s, "{'frames': [0, 24000], 'splines': [{'name': 'hum', 'mode': 'real', 'frequency': "
                             "3, 'damping': 0, 'knots': [{'frame': 0, 'value': 1}]}]}"))
{
    int count;
    const float *xy = active_line(s, &count);
    session_point(s, "curve(hum,12000,0.9)");
    for (int i = 8; i + 8 < count; i++) { // 27 frames a column: the plain samples would show some slow beat
        assert_true(fminf(xy[2 * i + 1], xy[2 * i + 3]) < s->y);
        assert_true(xy[2 * i] < xy[2 * i + 2]);
    }
}

static void set(struct session *s, enum parameter parameter, double value)
{
    const struct param param = param_number(value);
    assert_done(edit_parameter(s->document, 0, parameter, &param, &error));
}

/// Every slider at one of its ends, in each mode and start, with up to 400 knots of alternating values.
TEST(test_finite_curves_at_every_extreme)
{
    static const int knots[] = {0, 1, 2, 400};
    for (int n = 0; n < 4; n++) {
        char text[16000], *end = text;
        struct session s;
        int count;
        end += sprintf(end, "{'frames': [0, 820], 'splines': [{'name': 's', 'knots': [");
        for (int k = 0; k < knots[n]; k++)
            end += sprintf(end, "%s{'frame':%d,'value':%d%s}", k ? "," : "", 2 * k + 1, k % 3,
                           k % 5 == 4 ? ",'slope':1" : "");
        sprintf(end, "]}]}");
        session_open(&s, text);
        for (int i = 0; i < 9 * 16; i++) {
            const int mode = i / 48, start = i / 16 % 3, ends = i % 16;
            history_begin(s.history, "extremes", 1);
            set(&s, PARAMETER_MODE, mode);
            set(&s, PARAMETER_START, start);
            set(&s, PARAMETER_FREQUENCY, ends & 1 ? 12 : 0);
            set(&s, PARAMETER_DAMPING, ends & 2 ? (mode == WIGGLY_REAL ? 3 : 1) : 0);
            set(&s, PARAMETER_BANDWIDTH, ends & 4 ? 1 : 0);
            set(&s, PARAMETER_CALM, ends & 8 ? 1 : 0);
            history_end(s.history);
            session_frame(&s);
            for (int k = 0; k < s.work.evaluation.samples; k++)
                if (!isfinite(s.work.evaluation.curves[0].total[k]))
                    fail_msg("%d knots, mode %d, start %d, ends %d", knots[n], mode, start, ends);
            active_line(&s, &count);
            assert_true(count > 100);
        }
        session_close(&s);
    }
}

/// Whether a text stands in the curves panel.
static bool curves_say(const struct session *s, const char *text)
{
    const struct drawlist *list = drawn_by(s->editor);
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *command = &list->commands[i];
        const bool inside = command->x < 1000 && command->y > 400 && command->y < 696;
        if (command->kind == DRAW_TEXT && inside && strcmp(list->text + command->first, text) == 0) return true;
    }
    return false;
}

/// Paused between two frames, the playhead names the frame on which I sets a knot. V: which way the curves are shown stands beside them for
/// as long as they are, and so does whether the phase curve is.
TAIL_TEST(test_the_curves_say_how_they_are_shown)
{
    assert_false(curves_say(s, "phase"));
    hands(s, "click spline.sway");
    unfold(s->editor, "section.advanced");
    hands(s, "click phase");
    assert_true(curves_say(s, "phase"));
    hands(s, "key V V");
    assert_true(curves_say(s, "Cubic"));
    assert_false(curves_say(s, "phase"));
    hands(s,
          "click ruler(50); key Space; wait 3; key Space"); // at 24 fps four frames of 1/60 s are 1.6 of the scene's
    assert_true(curves_say(s, "52"));
    hands(s, "key I; is splines.0.knots.2.frame 52");
}

// --- time, views, windows -----------------------------------------------------------------------------------------------------

/// A pose is a function of the frame alone; a loop ends where it starts.
TAIL_TEST(test_playing_and_scrubbing)
{
    const struct stage_view *stage = editor_stage(s->editor);
    hands(s, "click ruler(30); is playing 0");
    const uint64_t at_30 = stage->hash;
    hands(s, "key Right");
    assert_true(stage->hash != at_30);
    hands(s, "key Left");
    assert_true(stage->hash == at_30);
    hands(s, "key Shift+Right");
    const uint64_t at_end = stage->hash;
    hands(s, "key Shift+Left");
    assert_true(stage->hash == at_end);
    // 300 frames of 1/60 s are the whole loop of 5 s
    hands(s, "click ruler(30); key Space; wait 299; is playing 1; key Space; click ruler(30)");
    assert_true(stage->hash == at_30);
}

/// Space and a drag pan without playing; Home brings all into sight, and the wheel zooms about the pointer, whatever is held.
TAIL_TEST(test_the_curves_are_panned_and_zoomed)
{
    float from[2], at[2];
    session_where(s, "curve(sway,60,0)", from);
    session_hold(s, KEY_SPACE, ACTION_PRESS);
    hands(s, "carry curve(sway,60,0) 35 -12");
    session_hold(s, KEY_SPACE, ACTION_RELEASE);
    for (int back = 0; back < 2; back++) {
        session_where(s, "curve(sway,60,0)", at);
        assert_near(at[0], from[0] + (back ? 0 : 35), 0.1);
        assert_near(at[1], from[1] - (back ? 0 : 12), 0.1);
        hands(s, "is playing 0; key Home");
    }
    for (int i = 0; i < 3; i++) {
        session_point(s, "knot(sway,1)");
        s->mods = i == 0 ? 0 : i == 1 ? MOD_CTRL : MOD_SHIFT;
        session_wheel(s, 3);
        s->mods = 0;
        session_where(s, "knot(sway,1)", at);
        assert_near(at[0], s->x, 0.1);
        assert_near(at[1], s->y, 0.1);
    }
}

/// The stage turns only by hand, and the light stays with the world. Home puts everything back into sight where the pointer is: the camera
/// over the stage, else the curves.
TAIL_TEST(test_the_stage_is_turned_and_comes_back)
{
    float view[16], lamp[3], before[2], after[2];
    memcpy(lamp, editor_stage(s->editor)->key_from, sizeof lamp);
    memcpy(view, editor_stage(s->editor)->view, sizeof view);
    session_where(s, "tail(tail,0.9)", before);
    hands(s, "click knot(sway,1); key Alt+Up");
    assert_memory_equal(view, editor_stage(s->editor)->view, sizeof view);
    hands(s, "key Ctrl+Z");
    session_point(s, "stage(0.9,0.2)");
    session_press(s, BUTTON_RIGHT, 1);
    session_drag(s, 90, 30, 3);
    session_release(s, BUTTON_RIGHT);
    assert_memory_not_equal(view, editor_stage(s->editor)->view, sizeof view);
    assert_memory_equal(lamp, editor_stage(s->editor)->key_from, sizeof lamp);
    for (int over = 0; over < 2; over++) {
        session_point(s, over ? "stage(0.9,0.2)" : "curve(sway,60,0)");
        hands(s, "key Home");
        session_where(s, "tail(tail,0.9)", after);
        const float apart = hypotf(after[0] - before[0], after[1] - before[1]);
        assert_true(over ? apart < 0.02f : apart > 5);
    }
}

TAIL_TEST(test_windows_and_dividers)
{
    const float sizes[][2] = {{1280, 720}, {960, 600}, {3000, 1700}, {200, 100}, {1, 1}, {1280, 720}};
    const struct stage_view *stage = editor_stage(s->editor);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        editor_resize(s->editor, sizes[i][0], sizes[i][1], 1);
        session_frame(s);
        const struct drawlist *list = drawn_by(s->editor);
        assert_false(list->overflow);
        for (int p = 0; p < 2 * list->point_count; p++) assert_true(isfinite(list->points[p]));
    }
    const float height = stage->viewport.h;
    for (int let_go = 0; let_go < 2; let_go++) {
        hands(s, let_go ? "drag 0 -100" : "carry divider(stage) 0 -100");
        assert_near(stage->viewport.h, height - 100, 1);
    }
}

TAIL_TEST(test_targets_that_are_not_there)
{
    static const char *const wrong[] = {"",
                                        "knot",
                                        "knot()",
                                        "knot(sway)",
                                        "knot(nope,0)",
                                        "knot(sway,9)",
                                        "knot(sway,-1)",
                                        "stage(a,b)",
                                        "curve(sway,1)",
                                        "tail(dog,0.5)",
                                        "handle(sway,0,1)",
                                        "ruler(1e9)",
                                        "divider(x)",
                                        "slider(nope)",
                                        "knot(sway,0"};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        struct error error = {0};
        float x, y;
        if (editor_target(s->editor, wrong[i], &x, &y, &error) || !error.text[0]) fail_msg("“%s” is found", wrong[i]);
    }
}

// --- onion skin, motion arc and ghost: what they show, and that they follow an edit in its own frame -----------------------------

static const char nine[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 4, "
    "'value': "
    "0}, {'frame': 14, 'value': 1}, {'frame': 24, 'value': -1}, {'frame': 34, 'value': 1}, {'frame': 44, 'value': "
    "-1}, {'frame': 54, 'value': 1}, {'frame': 64, 'value': 0}, {'frame': 74, 'value': 1}, {'frame': 84, 'value': "
    "0}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'position': [0, 0.26, 0], 'channels': [{'spline': 'sway'}]}]}";

enum { MAX_FOUND = 400 };

struct found {
    const struct draw_command *command[MAX_FOUND];
    int count;
};

/// The commands of a kind and colour (whatever its opacity) on the stage.
static struct found find(const struct session *s, enum draw_kind kind, uint32_t color)
{
    struct found found = {.count = 0};
    const struct drawlist *list = drawn_by(s->editor);
    const struct rect *stage = &layout_of(s->editor)->stage;
    for (int i = 0; i < list->count && found.count < MAX_FOUND; i++) {
        const struct draw_command *command = &list->commands[i];
        bool inside =
            command->clip.y + command->clip.h <= stage->y + stage->h && command->clip.x < stage->x + stage->w;
        if (command->kind == kind && command->color >> 8 == color >> 8 && inside) {
            found.command[found.count++] = command;
        }
    }
    return found;
}

static void middle_of(const struct session *s, const struct draw_command *command, float xy[2])
{
    const float *points = drawn_by(s->editor)->points + 2 * command->first;
    xy[0] = xy[1] = 0;
    for (int i = 0; i < command->count; i++) {
        xy[0] += points[2 * i] / (float)command->count;
        xy[1] += points[2 * i + 1] / (float)command->count;
    }
}

#define SKINS(s) find(s, DRAW_LINE, theme()->spline[0])
#define MARKS(s) find(s, DRAW_RECT, theme()->playhead)
#define NINE_TEST(name) SESSION_TEST(name, session_open(s, nine))

/// Of nine knots eight, the ninth is the farthest; in the frame of a nudge.
NINE_TEST(test_onion_shows_the_nearest_knots)
{
    assert_int_equal(SKINS(s).count, 0);
    hands(s, "key F4 O"); // no ghost besides
    struct found skins = SKINS(s);
    assert_int_equal(skins.count, 8);
    const struct draw_command *nearest = skins.command[7], *farthest = skins.command[0];
    assert_true((nearest->color & 0xFF) > (farthest->color & 0xFF));
    const uint64_t before = nearest->hash;
    hands(s, "click knot(sway,0); key Alt+Up");
    skins = SKINS(s);
    assert_int_equal(skins.count, 8);
    assert_true(skins.command[7]->hash != before);
    const uint64_t at_once = skins.command[0]->hash;
    document_own_rig(s->document, 0)->offset = 5; // the poses are those of the knots
    hands(s, "key O O");
    assert_true(SKINS(s).command[0]->hash == at_once);
    hands(s, "key Delete Ctrl+A Delete");
    assert_int_equal(SKINS(s).count, 0);
    hands(s, "key O; is onion 0");
}

/// How often a line crosses itself.
static int crossings(const struct session *s, const struct draw_command *command)
{
    const float(*p)[2] = (const float(*)[2])(drawn_by(s->editor)->points + 2 * command->first);
    int count = 0;
#define TURN(a, b, c) ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    for (int i = 0; i + 1 < command->count; i++) {
        for (int k = i + 2; k + 1 < command->count; k++) {
            count += TURN(p[i], p[i + 1], p[k]) * TURN(p[i], p[i + 1], p[k + 1]) < 0 &&
                     TURN(p[k], p[k + 1], p[i]) * TURN(p[k], p[k + 1], p[i + 1]) < 0;
        }
    }
    return count;
}

NINE_TEST(test_outlines_do_not_fold_from_any_side)
{
    hands(s, "key F4 O");
    for (int a = 0; a < 24; a++) {
        camera_of(s->editor)->azimuth = 6.2831853f * (float)a / 24;
        session_frame(s);
        const struct found skins = SKINS(s);
        assert_int_equal(skins.count, 8);
        for (int i = 0; i < skins.count; i++) assert_int_equal(crossings(s, skins.command[i]), 0);
    }
}

/// A mark a frame, where the tip will be, two seconds ahead of the first frame, less what has faded. It follows an edit at once.
NINE_TEST(test_the_arc_is_where_the_tip_goes)
{
    float middle[3][2];
    hands(s, "key Shift+O");
    assert_in_range(MARKS(s).count, 44, 49);
    for (int step = 1; step <= 3; step++) {
        float expected[2], tip[2];
        middle_of(s, MARKS(s).command[step], expected);
        hands(s, "key %d*Right", step);
        session_where(s, "tail(tail,1)", tip);
        assert_near(tip[0], expected[0], 0.1);
        assert_near(tip[1], expected[1], 0.1);
        hands(s, "key Shift+Left");
    }
    static const char *const edits[] = {"wait", "click knot(sway,1); key Shift+Alt+Up", "key Ctrl+Z"};
    for (int i = 0; i < 3; i++) {
        hands(s, "%s", edits[i]);
        middle_of(s, MARKS(s).command[14], middle[i]);
    }
    assert_true(hypotf(middle[1][0] - middle[0][0], middle[1][1] - middle[0][1]) > 2);
    assert_near(hypotf(middle[2][0] - middle[0][0], middle[2][1] - middle[0][1]), 0, 2e-4);
}

/// Both stay as they are when another document comes, and neither minds one without tails.
SESSION_TEST(test_overlays_outlive_documents, session_open(s, "{'frames': [0, 9], 'splines': [{'name': 'x'}]}"))
{
    hands(s, "key O Shift+O; opened; wait; is onion 1; is trail 1");
}

/// The pose at the knot in hand, as the curve is in this frame, and for a moment after a nudge.
NINE_TEST(test_the_ghost_is_the_pose_at_the_knot_in_hand)
{
    static const struct {
        const char *does;
        int ghosts;
    } rows[] = {
        {"pull knot(sway,2) 0 20 2", 1},        {"drag 0 20 1", 1}, {"release", 0}, {"key Alt+Up", 1}, {"wait 90", 0},
        {"key F4; pull knot(sway,2) 0 20 2", 0}};
    uint64_t hash[2] = {0, 0};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        hands(s, "%s", rows[i].does);
        const struct found ghost = SKINS(s);
        if (ghost.count != rows[i].ghosts) fail_msg("%s: %d ghosts", rows[i].does, ghost.count);
        if (i < 2) hash[i] = ghost.command[0]->hash;
    }
    assert_true(hash[0] != hash[1]);
}

static void open_bear(struct session *s)
{
    panel_open_models(
        s, "{'frames': [0, 96], 'splines': [{'name': 'swing', 'knots': [{'frame': 0, 'value': 0}, {'frame': 40, "
           "'value': 1}]}], 'rigs': [{'type': 'character', 'name': 'bear', 'model': "
           "'assets/models/creature.glb', 'coordinates': [{'name': 'side', 'spline': 'swing'}]}]}");
    session_frame(s);
}

/// How far the coordinates move a vertex, squared.
static float way_of(const struct character *c, int vertex)
{
    float way = 0;
    for (int i = 0; i < c->coordinate_count; i++) {
        for (int k = 0; k < 3; k++) {
            const float re = c->coordinates[i].re[vertex][k], im = c->coordinates[i].im[vertex][k];
            way += re * re + im * im;
        }
    }
    return way;
}

/// Onion skin and motion arc are not for tails alone: a scene of a soft character shows its outlines, and where it moves most.
SESSION_TEST(test_a_character_has_skins_and_an_arc, open_bear(s))
{
    assert_int_equal(SKINS(s).count, 0);
    session_key(s, 'O', 0);
    assert_true(SKINS(s).count >= 2); // of two knots
    assert_int_equal(MARKS(s).count, 0);
    session_key(s, 'O', MOD_SHIFT);
    assert_in_range(MARKS(s).count, 44, 49);
    const struct character *bear = &models_figure(s->world.models, s->document, 0)->character;
    const int point = overlay_point(s->editor->stage, &s->editor->core).at;
    for (int i = 0; i < bear->vertex_count; i++) assert_true(way_of(bear, i) <= way_of(bear, point) + 1e-6f);
    hands(s, "click onion; click trail");
    assert_int_equal(SKINS(s).count, 0);
    assert_int_equal(MARKS(s).count, 0);
}

/// At the height of the character: from its ears, above the middle of its head, to its feet.
SESSION_TEST(test_a_character_has_a_ghost, open_bear(s))
{
    const uint32_t color = theme()->spline[0];
    session_pull(s, "knot(swing,1)", 0, 8, 2);
    const struct found ghost = find(s, DRAW_LINE, color);
    assert_true(ghost.count >= 1);
    const float *points = drawn_by(s->editor)->points + 2 * ghost.command[0]->first;
    float low = INFINITY, high = -INFINITY;
    for (int i = 0; i < ghost.command[0]->count; i++) {
        low = fminf(low, points[2 * i + 1]);
        high = fmaxf(high, points[2 * i + 1]);
    }
    float head[2], foot[2];
    session_release(s, BUTTON_LEFT);
    session_click(s, "ruler(40)");
    session_frame(s);
    session_where(s, "character(bear,0.5,1)", head);
    session_where(s, "character(bear,0.4,0)", foot);
    assert_in_range((int)(head[1] - low), 0, 60);
    assert_near(high, foot[1], 60);
}
