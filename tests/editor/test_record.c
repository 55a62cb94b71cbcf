/// Recording the body's way: few knots that keep to the hand's motion, a tail that swings as it did, one step to undo. And a take: the scene that
/// Shift+K kept, shown while K is held, and what the rows of Feel were.
#include "hands.h"

#include "base/need.h"
#include "base/progress.h"
#include "editor/stage/state.h"
#include "ui/theme.h"

static const char scene[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1.2, 'damping': 0.25, 'bandwidth': 0.1, 'knots': "
    "[{'frame': 0, 'value': 0.2, 'slope': 0}, <90 0.2>]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'position': [0, "
    "0.26, 0], 'channels': [{'spline': 'sway'}]}]}";

enum { JOINTS = 24, X = 12, DRAGGED = 60, WATCHED = 150 };

static float joint_x(const struct session *s, int n) { return posed(s->editor)->matrix[n][X]; }

TEST(few_knots_keep_to_the_way)
{
    enum { COUNT = 200, CAPACITY = 64 };
    double way[COUNT];
    int knots[CAPACITY];
    for (int i = 0; i < COUNT; i++) way[i] = 0.3 * (1 - cos(0.05 * i)) * exp(-0.01 * i);
    int made = record_simplify(way, COUNT, 0.004, knots, CAPACITY);
    assert_in_range(made, 3, 16);
    assert_int_equal(knots[0], 0);
    assert_int_equal(knots[made - 1], COUNT - 1);
    for (int i = 1; i < made; i++) assert_true(knots[i] > knots[i - 1]);
    assert_true(knots[1] > 1 && knots[made - 2] < COUNT - 2); // beside the ends a knot would take their slope away
    for (int i = 0; i < COUNT; i++) way[i] = 0.5;
    assert_int_equal(record_simplify(way, COUNT, 0.004, knots, CAPACITY), 2);
    for (int i = 0; i < COUNT; i++) way[i] = i % 2; // a hand that trembles: no more than there is room for
    assert_int_equal(record_simplify(way, COUNT, 0.004, knots, CAPACITY), CAPACITY);
}

/// Drags the body along x for a second while the scene plays; R recorded it or not. Notes base and tip of each frame.
static void perform(struct session *s, bool records, float base[WATCHED], float tip[WATCHED])
{
    hands(s, "hover body(tail); press; hold Space; let Space"); // playing, as a recording is
    session_move(s, s->x - 4, s->y);
    hands(s, records ? "hold X; hold R" : "hold X");
    const float x = s->x;
    for (int i = 0; i < WATCHED; i++) {
        const float u = fminf(1, (float)i / DRAGGED);
        if (i == DRAGGED + 12) session_button(s, BUTTON_LEFT, ACTION_RELEASE, 1);
        if (i < DRAGGED + 12) session_move(s, x - 180 * u * u * (3 - 2 * u), s->y);
        session_frame(s);
        base[i] = joint_x(s, 0);
        tip[i] = joint_x(s, JOINTS) - base[i];
    }
}

/// A second take keys the same spline anew where it passes, and adds no channels.
TEST(recorded_is_what_was_seen)
{
    static float live_base[WATCHED], live_tip[WATCHED], base[WATCHED], tip[WATCHED];
    struct session session, *const s = &session;
    session_open(s, scene);
    perform(s, false, live_base, live_tip);
    session_close(s);
    session_open(s, scene);
    hands(s, "keep");
    perform(s, true, base, tip);
    assert_int_equal(s->document->spline_count, 3);
    const struct spline *way = s->document->splines[1];
    assert_string_equal(way->name, "tail x");
    assert_int_equal(spline_mode(way), WIGGLY_CUBIC);
    assert_in_range(way->knot_count, 3, 12);
    const struct tail *tail = document_tail(s->document, 0);
    assert_int_equal(tail->position[0].track, 1);
    assert_int_equal(tail->position[2].track, -1);
    assert_int_equal(tail->channel_count, 2);
    assert_int_equal(tail->channels[0].of, PART_TOTAL);
    assert_int_equal(tail->channels[1].of, PART_DISPLACEMENT);
    assert_int_equal(s->document->splines[2]->parameter[PARAMETER_EQUILIBRIUM].track, 1);
    float most = 0;
    for (int i = 0; i < WATCHED; i++) {
        assert_near(base[i], live_base[i], 0.01);
        most = fmaxf(most, fabsf(live_tip[i] - live_tip[0]));
    }
    assert_true(most > 0.1f);
    for (int i = DRAGGED + 14; i < WATCHED; i++) assert_near(tip[i], live_tip[i], 0.15 * most);
    hands(s, "sway.knots 2; key Space");   // the keyed swing is as it was
    for (int i = 5; i < DRAGGED; i += 5) { // from its first half-second on
        hands(s, "seek %.17g", 24.0 * (i + 1) / 60);
        assert_near(joint_x(s, 0), live_base[i], 0.01);
        assert_near(joint_x(s, JOINTS) - joint_x(s, 0), live_tip[i], 0.1 * most);
    }
    hands(s, "key Ctrl+Z; kept; label; key Ctrl+Shift+Z; is splines.# 3; key Shift+Left");
    perform(s, true, base, tip);
    assert_int_equal(s->document->spline_count, 3);
    assert_int_equal(document_tail(s->document, 0)->channel_count, 2);
    assert_in_range(s->document->splines[1]->knot_count, 3, 20);
    session_close(s);
}

SESSION_TEST(escape_forgets_the_recording, session_open(s, scene))
{
    hands(s, "hover body(tail); keep; press; drag -40 0; hold R; drag -40 0 20; key Escape; kept");
    assert_false(record_has_motion(s->editor->stage));
}

/// A tail that only bends sideways is lifted while it records: it gets a channel that bends up, in the recording's own step.
SESSION_TEST(a_way_without_a_channel_gets_one, session_open(s, scene))
{
    const struct event y = {.kind = EVENT_KEY, .key = 'Y', .action = ACTION_PRESS, .mods = MOD_CTRL};
    const struct event r = {.kind = EVENT_KEY, .key = 'R', .action = ACTION_PRESS, .mods = MOD_CTRL};
    hands(s, "hover body(tail); keep; with Ctrl; press; hold Space; let Space");
    session_move(s, s->x, s->y - 4);
    session_send(s, y);
    session_send(s, r);
    hands(s, "drag 0 -90 20; drag 0 60 20; release");
    const struct tail *tail = document_tail(s->document, 0);
    assert_int_equal(tail->channel_count, 2);
    const struct channel *made = &tail->channels[1];
    const struct spline *up = s->document->splines[made->spline];
    assert_int_equal(made->axis, AXIS_UP);
    assert_int_equal(made->of, PART_DISPLACEMENT);
    assert_string_equal(up->name, "tail up");
    assert_int_equal(up->parameter[PARAMETER_EQUILIBRIUM].track, tail->position[1].track);
    assert_near(up->parameter[PARAMETER_FREQUENCY].value, 1.2, 0);
    hands(s, "said  knots recorded. New spline tail up: the tail swings after tail y.; key Space");
    float most = 0, first = 0; // it swings: the tip's height above the base changes
    for (int f = 0; f < 90; f++) {
        hands(s, "seek %d", f);
        const struct pose *pose = posed(s->editor);
        const float rise = pose->matrix[JOINTS][13] - pose->matrix[0][13];
        if (f == 0) first = rise;
        most = fmaxf(most, fabsf(rise - first));
    }
    assert_true(most > 0.03f);
    hands(s, "key Ctrl+Z; kept");
}

// --- a take ---

static void open_file(struct session *s, const char *path)
{
    session_open_file(s, path);
    editor_resize(s->editor, 1280, 900, 1);
    s->document->folder = need_text("assets/scenes");
    assert_done(models_update(s->work.models, s->document, &error));
    editor_open(s->editor, &s->world);
    if (playback_of(s->editor)->playing) hands(s, "key Space");
    session_move(s, 2, 2);
    session_frame(s);
}

static void open_dog(struct session *s) { open_file(s, "assets/scenes/dog.json"); }

/// What is on the stage at a frame: camera, poses and shadows.
static uint64_t stage_at(struct session *s, double frame)
{
    hands(s, "seek %g", frame);
    return editor_stage(s->editor)->hash;
}

/// Tails, chains and characters, at the playhead wherever it is, also scrubbed while K is held; K shows, and edits nothing.
TEST(k_shows_the_stage_as_it_was)
{
    static const char *const scenes[] = {"assets/scenes/tail.json", "assets/scenes/dog.json",
                                         "assets/scenes/hands.json", "assets/scenes/follow.json"};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct session session, *const s = &session;
        open_file(s, scenes[i]);
        const uint64_t before[] = {stage_at(s, 20), stage_at(s, 45)};
        hands(s, "key Shift+K");
        inspector_preset(s->editor->inspector, 3);
        const uint64_t now[] = {stage_at(s, 20), stage_at(s, 45)};
        const size_t steps = history_done(s->history);
        hands(s, "keep");
        for (int k = 0; k < 2; k++) {
            if (now[k] == before[k]) fail_msg("%s does not change", scenes[i]);
            hands(s, "seek %d; hold K; wait 1", k ? 45 : 20);
            if (editor_stage(s->editor)->hash != before[k]) fail_msg("%s is not as before", scenes[i]);
            hands(s, "let K; wait 1");
            if (editor_stage(s->editor)->hash != now[k]) fail_msg("%s does not come back", scenes[i]);
        }
        hands(s, "hold K; wait 1");
        assert_true(stage_at(s, 20) == before[0]);
        hands(s, "let K; wait 1; kept; steps %zu", steps);
        session_close(s);
    }
}

/// Lines in the plot with this colour, whatever its opacity.
static int count_lines(const struct session *s, uint32_t color)
{
    int count = 0;
    EACH_DRAWN(c, s->editor) count += c->kind == DRAW_LINE && c->color >> 8 == color >> 8 && c->count > 100;
    return count;
}

SESSION_TEST(k_shows_the_curves_as_they_were, open_dog(s))
{
    const uint32_t colors[] = {theme()->playhead, theme()->spline[1]}; // of the active one and another
    int before[2];
    hands(s, "key Shift+K");
    inspector_preset(s->editor->inspector, 1);
    session_frame(s);
    for (int i = 0; i < 2; i++) before[i] = count_lines(s, colors[i]);
    hands(s, "hold K; wait 1; shows Before");
    for (int i = 0; i < 2; i++) assert_int_equal(count_lines(s, colors[i]), before[i] + 1);
    const long allocated = allocation_count();
    for (int i = 0; i < 20; i++) session_frame(s);
    assert_int_equal(allocation_count(), allocated);
    hands(s, "let K; wait 1; hides Before");
    assert_int_equal(count_lines(s, colors[0]), before[0]);
}

static int count_marks(const struct session *s)
{
    const float left = layout_of(s->editor)->inspector.x;
    int count = 0;
    EACH_DRAWN(c, s->editor)
    {
        count += c->kind == DRAW_RECT && c->color == theme_fade(theme()->playhead, 0.6f) && c->bounds.x > left;
    }
    return count;
}

/// Rows that have changed have a mark where they were, and while K is held the numbers are those of before.
SESSION_TEST(rows_show_what_they_were, open_dog(s))
{
#define OF(does) does " 1.30 Hz; " does " 0.16; " does " 9 frames; " does " 16.0°;"
#define NOW(does) does " 1.80 Hz; " does " 0.12; " does " 5 frames; " does " 37.1°;"
    hands(s, "key Shift+K");
    assert_int_equal(count_marks(s), 0);
    hands(s, "click preset.whip");
    session_move(s, 2, 2);
    hands(s, "wait 1;" NOW("shows") OF("hides"));
    assert_int_equal(count_marks(s), 4);
    hands(s, "hold K; wait 1;" OF("shows") NOW("hides"));
    assert_int_equal(count_marks(s), 0);
}

/// With other rigs the stage stays as it is, and says so; with another document nothing is kept.
SESSION_TEST(what_k_cannot_show, open_dog(s))
{
    hands(s, "hold K; wait 1; said Nothing is kept yet; let K; key Shift+K");
    inspector_add(s->editor->inspector, ADD_TAIL);
    session_frame(s);
    const uint64_t now = stage_at(s, 20);
    hands(s, "hold K; wait 1; said Only the curves");
    assert_true(editor_stage(s->editor)->hash == now);
    hands(s, "let K; wait 1");
    editor_open(s->editor, &s->world);
    hands(s, "hold K; wait 1; said Nothing is kept yet");
}

/// A drag edits what is now, and is seen.
WALK(a_drag_goes_before_k, open_dog(s),
     "key Shift+K; hold K; wait 1; pull knot(tail,1) 0 20; hides Before; release; shows Before")
