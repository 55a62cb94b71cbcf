/// Rigs by hand on the stage: bodies are dragged and follow through, points are pinned, floors moved; rigs come and go.
#include "hands.h"

#include "editor/stage/state.h"
#include "rig/import.h"
#include "scene/pins.h"
#include <unistd.h>

// --- the body dragged: it goes along at once, its tail follows through, and the document gets one step at the end -----------------

#define SWAY "{'name': 'sway', 'frequency': 1.5, 'damping': 0.2, 'bandwidth': 0.1}"
#define WALK_OF(members) "{'name': 'walk', 'mode': 'cubic', " members "}"
#define FOX_AT(x)                                                                                                    \
    "'rigs': [{'type': 'tail', 'name': 'tail', 'position': [" x ", 0.26, 0], 'channels': [{'spline': 'sway'}]}]}"
#define TO_RIGHT "'knots': [{'frame': 0, 'value': 0.1}, {'frame': 48, 'value': 0.1}]"
#define FOLLOWING "{'spline': 'walk'}"

static const char scene[] = "{'frames': [0, 48], 'splines': [" SWAY ", " WALK_OF(TO_RIGHT) "], " FOX_AT("0");
static const char tracked[] = "{'frames': [0, 48], 'splines': [" SWAY ", " WALK_OF(TO_RIGHT) "], " FOX_AT(FOLLOWING);

#define BODY_TEST(name, scene) SESSION_TEST(name, session_open(s, scene))

BODY_TEST(test_tail_follows_through_and_settles, scene)
{
    // the pointer goes to the left, where +x is, and the tip stays behind; the document waits
    hands(s, "hover body(tail); pull body(tail) -150 0 12; is body.x > 0.1; is tip.behind < -0.05; kept;"
             "keep body.x; release; is body.x kept ~1e-3; label Move body");
    assert_near(number(s, "rigs.0.position.0"), number(s, "body.x"), 1e-3);
    float overshoot = -1;
    for (int i = 0; i < 60; i++) {
        session_frame(s);
        overshoot = fmaxf(overshoot, (float)number(s, "tip.behind"));
    }
    assert_true(overshoot > 0.05f); // and swings past
    hands(s,
          "is wants.frames 1; wait 1200; is wants.frames 0; is tip.behind 0;" // hangs still: exactly nothing is left
          "once; key Ctrl+Z; label; kept");
}

/// Lagged joints come later: each extremum of the bend is at the base first and at the tip last.
BODY_TEST(test_swing_runs_along_the_tail, scene)
{
    float least[2] = {0, 0};
    int when[2] = {0, 0};
    hands(s, "hover body(tail); pull body(tail) -150 0 3; release"); // so fast that the base has not swung out yet
    for (int i = 0; i < 40; i++) {
        for (int far = 0; far < 2; far++) {
            const float *one = posed(s->editor)->matrix[far ? 20 : 4],
                        *before = posed(s->editor)->matrix[far ? 19 : 3];
            const float bend = atan2f(one[8], one[10]) - atan2f(before[8], before[10]);
            if (bend < least[far]) when[far] = i;
            least[far] = fminf(least[far], bend);
        }
        session_frame(s);
    }
    assert_in_range(when[1] - when[0], 8, 15); // 16 joints × 6.5° of a swing of 1.5 Hz: 0.19 s, 11.6 frames
}

/// Clicks, and presses beside the body, move nothing; a drag is taken back by Esc; axes lock, and Shift is fine.
BODY_TEST(test_a_drag_of_the_body, scene)
{
    hands(s, "click body(tail); label; carry stage(0.03,0.1) 40 0 3; is body.x 0; label;"
             "hover body(tail); pull body(tail) 80 30 6; key Escape; release; is body.x 0; is tip.behind 0;"
             "is wants.frames 0; kept; label;"
             "hover body(tail); pull body(tail) -60 40; is body.z > 0.05; key X; is body.z 0; is body.x > 0.05;"
             "key Y; is body.x 0; key Y");
    const double x = number(s, "body.x");
    s->mods = MOD_SHIFT;
    hands(s, "drag -60 0");
    const double fine = number(s, "body.x") - x;
    s->mods = 0;
    hands(s, "drag -60 0");
    assert_near(number(s, "body.x") - x - fine, 10 * fine, 1e-3);
}

/// Ctrl lifts it; it never sinks into the ground, and its height is keyed above that.
BODY_TEST(test_a_body_is_lifted, scene)
{
    s->mods = MOD_CTRL;
    hands(
        s,
        "key Shift+A; hover body(tail); pull body(tail) 0 80; is body.y 0.26 ~1e-6; drag 0 -200 8; is body.y > 0.35;"
        "keep body.y");
    s->mods = 0;
    hands(s, "release; is body.y kept ~1e-3");
    assert_near(posed(s->editor)->ground, 0, 0);
}

/// A body whose way begins at a still knot: a drag with auto-key gives it a value, one of the whole shot takes it along.
TEST(test_a_still_knot_under_a_dragged_body)
{
    static const char still[] = "{'frames': [0, 48], 'splines': [" SWAY ", " WALK_OF(
        "'equilibrium': 0.05, 'knots': [{'frame': 0, 'still': true}, {'frame': 48, 'value': 0.1}]") "], " //
        FOX_AT(FOLLOWING);
    struct session s;
    session_open(&s, still);
    hands(&s,
          "hover body(tail); pull body(tail) -150 0 12; release; is splines.1.knots.0.still nothing;"
          "is splines.1.knots.0.value > 0.1;"
          "key Ctrl+Z; kept; click knot(walk,1); key Ctrl+D Shift+P Shift+A;" // the copy is still, and keeps a value
          "hover body(tail); pull body(tail) -150 0 12; release; is splines.1.knots.0.still true;"
          "is splines.1.knots.2.still true");
    const double by = number(&s, "splines.1.knots.1.value") - 0.1;
    assert_true(by > 0.1);
    assert_near(s.work.evaluation.curves[1].total[0], 0.05 + by, 1e-6);
    assert_near(s.document->splines[1]->knots[2].value, 0.1 + by, 1e-9);
    session_close(&s);
}

/// Where a spline is followed, the drag leaves a knot at the playhead; the other coordinates stay numbers. In either order of splines.
TEST(test_a_tracked_body_gets_a_knot)
{
    static const char walk_first[] =
        "{'frames': [0, 48], 'splines': [" WALK_OF(TO_RIGHT) ", " SWAY "], " FOX_AT(FOLLOWING);
    for (int track = 0; track < 2; track++) {
        struct session s;
        session_open(&s, track ? tracked : walk_first);
        hands(&s,
              "key Right Right; is body.x 0.1 ~1e-6; hover body(tail); pull body(tail) -60 0; key X; keep body.x;"
              "release; is splines.# 2; is splines.%d.knots.# 3; is splines.%d.knots.1.frame 2; is body.x kept ~1e-3;"
              "is rigs.0.position.2 0",
              track, track);
        assert_near(s.document->splines[track]->knots[1].value, number(&s, "body.x"), 1e-3);
        hands(&s, "key Ctrl+Z; kept");
        session_close(&s);
    }
}

/// Without auto-key all of the shot moves: every knot of what the place follows.
BODY_TEST(test_without_auto_key_the_shot_moves, tracked)
{
    hands(s, "key Shift+A Right; hover body(tail); pull body(tail) -60 0; key X");
    const double x = number(s, "body.x");
    hands(s, "release; is splines.1.knots.# 2; said whole shot: x +");
    for (int i = 0; i < 2; i++) assert_near(s->document->splines[1]->knots[i].value, x, 1e-3);
}

/// A limit of what the place follows: all knots stop where the first does, so that the motion stays what it was.
BODY_TEST(
    test_a_limit_holds_the_body,
    "{'frames': [0, 48], 'splines': [" SWAY ", " //
    WALK_OF("'limits': [-1, 0.25], 'knots': [{'frame': 0, 'value': 0.1}, {'frame': 24, 'value': 0.2}, {'frame': "
            "48, 'value': 0.1}]") "], " FOX_AT(FOLLOWING))
{
    static const char *const told[] = {
        "Moved for the whole shot: x +0.05 m. Held by the limit 0.25 of walk at frame 24.",
        "Held by the limit 0.25 of walk at frame 24."};
    hands(s, "key Shift+A"); // what follows a spline is keyed, else
    for (int again = 0; again < 2; again++) {
        hands(s,
              "hover body(tail); pull body(tail) -150 0; key X; wait; is body.x 0.15 ~1e-6;" // under the hand, too
              "release; is splines.1.knots.0.value 0.15 ~1e-12; is splines.1.knots.1.value 0.25 ~1e-12;"
              "is splines.1.knots.2.value 0.15 ~1e-12; says %s",
              told[again]);
        assert_false(said_error(s->editor));
    }
    hands(s, "key Shift+A; hover body(tail); pull body(tail) -150 0; key X; wait; is body.x 0.25 ~1e-6; release;"
             "is splines.1.knots.0.value 0.25;"
             "says Keyed walk at frame 0. Held by the limit 0.25 of walk at frame 0.");
}

/// With it a place that was a number gets a spline, which begins where the body was, and the tail follows that through.
BODY_TEST(test_auto_key_makes_a_place_follow, scene)
{
    hands(s, "key Shift+A 12*Right; hover body(tail); pull body(tail) -60 0; key X");
    const double x = number(s, "body.x");
    hands(s, "release; is rigs.0.position.0.spline tail x; is splines.2.name tail x; is splines.2.knots.# 2;"
             "is splines.2.knots.0.value 0; is splines.2.knots.1.frame 12; is rigs.0.channels.# 2;"
             "is rigs.0.position.2 0; says Keyed tail x at frame 12.");
    assert_near(number(s, "splines.2.knots.1.value"), x, 1e-3);
    const int follows = document_tail(s->document, 0)->channels[1].spline;
    assert_int_equal(s->document->splines[follows]->parameter[PARAMETER_EQUILIBRIUM].track, 2);
    hands(s, "key Ctrl+Z; kept");
}

/// A held body may lose its tail, to an edit made meanwhile; letting go of it then changes nothing. A press in the frame in which an edit
/// takes the tail away finds nothing to take hold of.
TEST(test_a_tail_that_goes)
{
    static const char *const targets[] = {"body(tail)", "body(tail)", "tail(tail,0.5)"};
    for (int t = 0; t < 3; t++) {
        struct session s;
        session_open(&s, scene);
        hands(&s, "hover %s", targets[t]);
        if (t == 0) hands(&s, "pull %s 80 30 6", targets[t]);
        if (t > 0) history_begin(s.history, "Remove tail", 0);
        assert_done(edit_rig_remove(s.document, 0, &error));
        if (t > 0) history_end(s.history);
        s.kept = session_saved(&s);
        if (t > 0) session_press(&s, BUTTON_LEFT, 1);
        if (t > 0) session_drag(&s, 40, 10, 3);
        hands(&s, "release; kept");
        session_close(&s);
    }
}

static void strike(struct session *s, int key, unsigned mods)
{
    session_send(s, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_PRESS, .mods = mods});
    session_send(s, (struct event){.kind = EVENT_KEY, .key = key, .action = ACTION_RELEASE, .mods = mods});
}

/// What is shown is of the last frame: a tail that an event before the press took away is not taken hold of.
BODY_TEST(test_a_press_right_after_a_rig_went,
          "{'frames': [0, 48], 'splines': [{'name': 'sway', 'frequency': 1, 'knots': [{'frame': 0, 'value': 1}]}], "
          "'rigs': [{'type': 'tail', 'name': 'tail', 'spline': 'sway'}, {'type': 'model', 'name': 'gone', 'model': "
          "'gone.glb'}]}")
{
    hands(s, "click body(tail); key Space; wait 30");
    session_point(s, "tail(tail,1)");
    strike(s, KEY_DELETE, MOD_SHIFT);
    if (asked(s->editor) == DIALOG_ASK) strike(s, 'K', 0);
    hands(s, "is rigs.# 1; is playing 1");
    session_click_here(s, 1);
    hands(s, "is rigs.0.type model");
}

// --- pins ---------------------------------------------------------------------------------------------------------------

static const char pinned_tail[] =
    "{'frames': [0, 60], 'splines': [{'name': 's', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 0, 'value': "
    "0}]}, {'name': 'u', 'frequency': 0.7, 'damping': 0.1, 'knots': [{'frame': 0, 'value': 0}]}], 'rigs': [{'type': "
    "'tail', 'name': 'tail', 'position': [0, 0.4, 0], 'channels': [{'spline': 's', 'axis': 'side'}, {'spline': 'u', "
    "'axis': 'up'}]}]}";

static const char creature[] =
    "{'frames': [0, 60], 'splines': [{'name': 's', 'frequency': 1, 'damping': 0.1, 'knots': []}, {'name': 'u', "
    "'frequency': 0.7, 'damping': 0.1, 'knots': []}], 'rigs': [{'type': 'character', 'name': 'c', 'model': "
    "'assets/models/creature.glb', 'coordinates': [{'name': 'up', 'spline': 's'}, {'name': 'side', 'spline': "
    "'u'}]}]}";

static void open_models(struct session *s, const char *text)
{
    panel_open_models(s, text);
    session_frame(s);
}

#define PIN_TEST(name, scene) SESSION_TEST(name, open_models(s, scene))

static const struct pin *pin_of(const struct session *s, int at) { return &s->document->rigs[0]->pins[at]; }

/// Presses on a target with Ctrl, which pins joints, and drags.
static void pull_with_ctrl(struct session *s, const char *target, float dx, float dy)
{
    s->mods = MOD_CTRL;
    session_point(s, target);
    session_press(s, BUTTON_LEFT, 1);
    s->mods = 0;
    session_drag(s, dx, dy, 4);
}

/// The plain drag sets knots.
PIN_TEST(test_ctrl_and_a_drag_pin_a_joint_which_follows_the_pointer, pinned_tail)
{
    float tip[2], marker[2];
    hands(s, "key 10*Right");
    pull_with_ctrl(s, "tail(tail,1)", 0, -30);
    session_where(s, "tail(tail,1)", tip);
    session_where(s, "pin(tail,0)", marker);
    assert_true(hypotf(marker[0] - s->x, marker[1] - s->y) < 1);
    const float apart = hypotf(tip[0] - marker[0], tip[1] - marker[1]);
    if (!(apart < 8)) fail_msg("the tip is %g pixels from the pointer", (double)apart);
    hands(s,
          "release; is rigs.0.pins.# 1; is rigs.0.pins.0.joint 23; is rigs.0.pins.0.frame 10; is splines.0.knots.# 1;"
          "once; key Ctrl+Z; carry tail(tail,0.9) 20 20; is rigs.0.pins.# nothing; is splines.0.knots.# 2");
}

PIN_TEST(test_an_axis_can_be_locked_and_esc_cancels, pinned_tail)
{
    struct pin pins[3];
    hands(s, "is rigs.# 1");
    pull_with_ctrl(s, "tail(tail,1)", 30, 25);
    for (int locked = 0; locked < 3; locked++) {
        if (locked) session_key(s, locked == 1 ? 'Y' : 'X', 0);
        pins[locked] = *pin_of(s, 0);
    }
    assert_true(pins[1].to[1] != pins[0].to[1] || pins[1].to[0] != pins[0].to[0]);
    assert_true(pins[1].to[0] != pins[2].to[0]);
    assert_near(pins[1].to[2], pins[2].to[2], 1e-9);         // neither moves along z
    hands(s, "key Escape; kept; release; key Delete; kept"); // nothing is selected now
}

/// Pins the tip where it is, at frame 10.
static void open_pinned(struct session *s)
{
    open_models(s, pinned_tail);
    hands(s, "key 10*Right; hover tail(tail,1); key H; is rigs.0.pins.# 1; keep");
}

#define PINNED_TEST(name) SESSION_TEST(name, open_pinned(s))

PINNED_TEST(test_a_pin_is_moved_nudged_retimed_and_deleted_by_keys)
{
    hands(s, "keep rigs.0.pins.0.to.1; key Alt+Up Alt+Up; is rigs.0.pins.0.to.1 > kept+0.01; once;" // both nudges
             "key Alt+PageDown; is rigs.0.pins.0.frame 11; is playhead 11;"
             "at 2 2; key 9*Right H;" // the same point, once more
             "shows Pinned at frame 20. Drag the marker, or type its place in the section Pins.;"
             "is rigs.0.pins.# 2; is rigs.0.pins.1.frame 20");
    assert_near(pin_of(s, 1)->to[1], pin_of(s, 0)->to[1], 0);
    session_type(s, ",");
    hands(s, "is playhead 11; key Delete; is rigs.0.pins.# 1; is rigs.0.pins.0.frame 20");
}

PINNED_TEST(test_a_marker_is_dragged_on_the_stage_and_on_the_ruler)
{
    float from[2], to[2], mark[2];
    hands(s, "key Escape; carry pin(tail,0) 0 -25; is rigs.0.pins.# 1; once; keep");
    session_where(s, "ruler(10)", from);
    session_where(s, "ruler(25)", to);
    const double way = (double)(to[0] - from[0]);
    hands(s, "carry pintime(tail,0) %g 0; is rigs.0.pins.0.frame 25; is playhead 25; once", way);
    session_where(s, "pintime(tail,0)", mark); // it hangs over the ruler's edge, and is taken there, too
    session_move(s, mark[0], mark[1] + 4);
    while (said(s->editor)[0]) session_frame(s);
    session_frame(s);
    assert_non_null(shown_text(s->editor,
                               "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, "
                               "Alt+PgDn: by a frame"));
    session_press(s, BUTTON_LEFT, 1);
    hands(s, "drag %g 0; release; is rigs.0.pins.0.frame 40", way);
}

/// Of two marks close together on the ruler the nearer one is under the pointer, unless the other is selected and in reach.
PINNED_TEST(test_the_selected_mark_is_taken_first)
{
    float marks[2][2];
    hands(s, "key Escape Right H Escape; is rigs.0.pins.# 2");
    plot_of(s->editor)->frame0 -= 300; // frames are so narrow that both marks are in reach
    plot_of(s->editor)->frame1 += 300;
    session_frame(s);
    for (int m = 0; m < 2; m++) session_where(s, m ? "pintime(tail,1)" : "pintime(tail,0)", marks[m]);
    assert_true(marks[1][0] - marks[0][0] > 1 && marks[1][0] - marks[0][0] < 5);
    for (int chosen = -1; chosen < 2; chosen++) {
        for (int m = 0; m < 2; m++) {
            s->editor->core.focus.pin = chosen >= 0 ? pin_of(s, chosen > 0)->id : 0;
            session_move(s, marks[m][0], marks[m][1]);
            session_frame(s);
            assert_ptr_equal(hovered(s->editor), &thing_pin_time);
            assert_int_equal(s->editor->core.input.hover.pin, pin_of(s, chosen >= 0 ? chosen : m)->id);
        }
    }
    session_move(s, marks[1][0] + 20, marks[1][1]);
    session_frame(s);
    assert_ptr_not_equal(hovered(s->editor), &thing_pin_time);
}

WALK(test_the_inspector_lists_pins_and_takes_numbers, open_pinned(s),
     "key Escape; lacks pin.x; click pin.0; finds pin.x; enter pin.x 0.25; is rigs.0.pins.0.to.0 0.25;"
     "enter pin.frame 12; is rigs.0.pins.0.frame 12; enter pin.point 11; is rigs.0.pins.0.joint 11;"
     "click pin.0.remove; is rigs.0.pins.# nothing")

/// The surface is pinned and follows the pointer. The soles hardly move: pulling them would throw all else far.
PIN_TEST(test_the_surface_of_a_character_is_pinned, creature)
{
    hands(s, "hover character(c,0.4,0.01); is hovered nothing; key 10*Right; hover character(c,0.5,0.9)");
    assert_ptr_equal(hovered(s->editor), &thing_point);
    hands(s, "carry character(c,0.5,0.9) 25 8; is rigs.0.pins.# 1");
    const struct pin_left *left = evaluation_pin(&s->work.evaluation, s->document, 0, 0);
    assert_true(left && left->is_found);
    assert_true(fabs(left->way[0]) < 0.05 && fabs(left->way[1]) < 0.05);
    hands(s, "once");
}

/// A pin that throws a rig far makes its curves high, by hand or by number: they come into sight.
PIN_TEST(test_the_curves_follow_a_pin, creature)
{
    static const char *const ways[] = {"key 10*Right; carry character(c,0.5,0.8) 120 -80; is rigs.0.pins.# 1",
                                       "enter pin.y 3"};
    for (int typed = 0; typed < 2; typed++) {
        hands(s, "%s; wait 90", ways[typed]);
        for (int i = 0; i < 122; i++) {
            const double total = s->world.evaluation->curves[i % 2].total[i / 2];
            assert_true(total < plot_of(s->editor)->value1 && total > plot_of(s->editor)->value0);
        }
    }
}

/// Without a mouse H pins what moves most.
TEST(test_the_keyboard_alone_is_enough)
{
    for (int tail = 0; tail < 2; tail++) {
        struct session s;
        open_models(&s, tail ? pinned_tail : creature);
        hands(&s, "at 2 2; key H; is rigs.0.pins.# 1");
        if (tail) hands(&s, "is rigs.0.pins.0.joint 23");
        session_close(&s);
    }
}

// --- the floor: its edge is pointed at and dragged up and down --------------------------------------------------------------

PIN_TEST(test_a_floor_is_dragged,
         "{'frames': [0, 60], 'splines': [{'name': 's', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 0, "
         "'value': 0}, {'frame': 20, 'value': 5}]}], 'rigs': [{'type': 'character', 'name': 'c', 'model': "
         "'assets/models/creature.glb', 'position': [0, 0.2, 0], 'coordinates': [{'name': 'up', 'spline': 's'}], "
         "'floor': 0}]}")
{
    float from[2], to[2];
    hands(s, "hover floor(c); is cursor vertical");
    assert_ptr_equal(hovered(s->editor), &thing_floor);
    session_where(s, "floor(c)", from);
    hands(s, "pull floor(c) 0 30");
    session_where(s, "floor(c)", to);
    if (!(fabsf(to[1] - from[1] - 30) < 6)) fail_msg("the edge moved by %g pixels of 30", (double)(to[1] - from[1]));
    hands(s, "release; is rigs.0.floor < -0.02; once; key Ctrl+Z;"
             "pull floor(c) 0 -300; is rigs.0.floor 0.2 ~1e-12; key Escape; release; kept"); // not above the feet
    const double was = s->world.evaluation->curves[0].total[35];
    hands(s, "pull floor(c) 0 -30");
    assert_true(fabs(s->world.evaluation->curves[0].total[35] - was) > 1e-3); // the motion follows in the same frame
    hands(s, "release; is rigs.0.floor > 0.02");
    session_where(s, "floor(c)", to);
    s->document->rigs[0]->model.has_floor = false;
    session_move(s, to[0], to[1]);
    session_frame(s);
    assert_ptr_not_equal(hovered(s->editor), &thing_floor);
    assert_refusal(editor_target(s->editor, "floor(c)", &to[0], &to[1], &error), "");
}

// --- rigs come and go, each as one step -------------------------------------------------------------------------------------

static const char bear[] =
    "{'frames': [0, 48], 'splines': [{'name': 's', 'knots': [{'frame': 0, 'value': 1}]}, {'name': "
    "'t', 'knots': []}], 'rigs': [{'type': 'character', 'name': 'bear', 'model': "
    "'assets/models/creature.glb', 'coordinates': [{'name': 'up', 'spline': 's'}]}]}";

SESSION_TEST(test_the_menu_opens_by_its_key, panel_open(s, "{'frames': [0, 48], 'splines': []}", 1280, 720))
{
    float x, y;
    hands(s, "at 300 200; key A");
    assert_true(widget_at(s->editor, "item.tail", &x, &y));
    assert_true(x > 300 && x < 600 && y > 200 && y < 260); // at the pointer
    hands(s, "key Enter; is rigs.# 1; is rigs.0.type tail; is splines.# 1; is splines.0.knots.# 1; once");
    assert_int_equal(document_tail(s->document, 0)->channels[0].spline, 0);                 // that bends it
    hands(s, "key A; lacks item.chain; key Escape;"                                         // there are no bones
             "at 1100 600; key A; click item.tail; is rigs.# 2; is rigs.1.position.0 > 1"); // over the inspector, too
    // the file dialog asks the app; a bad file leaves a sentence and the document as it was
    session_asked(s);
    hands(s, "keep; key A; click item.file; is asked add; type no.glb; key Enter; asks add no.glb;"
             "answer add no.glb: cannot be read; is refused no.glb: cannot be read; kept");
}

PIN_TEST(test_a_character_comes_and_goes, bear)
{
    hands(s, "key A; click item.copy.0; wait; is rigs.# 2; is rigs.1.position.0 > 0.5;"
             "is rigs.1.coordinates.0.spline s; is stage.models 2");
    assert_int_equal(s->editor->core.focus.characters.character, 1);
    hands(s, "once; key Ctrl+Z; key Shift+Delete; is asked ask");
    assert_non_null(strstr(dialog_of(s->editor)->question.title, "Remove bear"));
    hands(s, "key Escape; kept; key Shift+Delete K; is rigs.# 0; is splines.# 2; once; key Ctrl+Z;"
             "key Shift+Delete W; is rigs.# 0; is splines.# 1; is splines.0.name t; once;"
             "key Shift+Delete; said nothing on the stage");
}

/// A model goes with the chains on it; what followed its joints keeps its place.
PIN_TEST(test_a_model_goes_with_its_chains,
         "{'frames': [0, 48], 'splines': [{'name': 's', 'equilibrium': {'model': 'dog', 'joint': 'hips', 'of': "
         "'turn'}, 'knots': []}, {'name': 'u', 'knots': []}], 'rigs': [{'type': 'tail', 'name': 't', 'spline': 's'}, "
         "{'type': 'model', 'name': 'dog', 'model': 'assets/models/dog.glb'}, {'type': 'chain', 'name': 'ear', "
         "'model': 'dog', 'from': 'ear_1_L', 'to': 'ear_2_L', 'channels': [{'spline': 'u'}]}]}")
{
    hands(s, "click model.0; click rig.copy; is rigs.# 5; is rigs.4.type chain; once; key Ctrl+Z;"
             "click model.0; click rig.delete; key W; is rigs.# 1; is splines.# 1;"
             "is splines.0.equilibrium.joint nothing; once");
}

/// A chain goes, too, where its own spline follows a joint by the chain's axes, as Shift+J makes it.
PIN_TEST(test_a_chain_goes_with_its_splines,
         "{'frames': [0, 48], 'splines': [{'name': 'u', 'equilibrium': {'model': 'dog', 'joint': 'hips', 'of': "
         "'across', 'chain': 'ear'}, 'knots': []}], 'rigs': [{'type': 'model', 'name': 'dog', 'model': "
         "'assets/models/dog.glb'}, {'type': 'chain', 'name': 'ear', 'model': 'dog', 'from': 'ear_1_L', 'to': "
         "'ear_2_L', 'channels': [{'spline': 'u'}]}]}")
{
    hands(s, "key Shift+Delete W; is rigs.# 1; is splines.# 0; once; key Ctrl+Z;"
             "key Shift+Delete K; is rigs.# 1; is splines.# 1; once");
}

/// Files are told apart; a .glb by another name is one, too; anything else is not.
TEST(test_a_glb_is_told_by_its_beginning)
{
    char path[] = "/tmp/wiggly-test-XXXXXX", command[128];
    struct document *document = document_create(), *imported;
    assert_done(import_add(document, "assets/models/creature.glb", -1, &error));
    assert_done(import_add(document, "assets/models/dog.glb", 0, &error));
    assert_done(import_add(document, "assets/models/creature.glb", 0, &error));
    assert_refusal(import_add(document, "Makefile", 0, &error), "Makefile");
    assert_int_equal(document_count_rigs(document, RIG_MODEL), 3);
    assert_int_equal(document->spline_count, 1);
    assert_string_equal(document->rigs[2]->name, "creature 2");
    document_destroy(document);
    close(mkstemp(path));
    snprintf(command, sizeof command, "cp assets/models/dog.glb %s", path);
    assert_int_equal(system(command), 0);
    assert_true(import_suits(path));
    assert_false(import_suits("Makefile"));
    assert_false(import_suits("/tmp/there-is-none"));
    assert_done(imported = import_scene(path, &error));
    assert_int_equal(imported->rigs[0]->kind, RIG_MODEL);
    assert_near(imported->fps, 24, 0);
    document_destroy(imported);
    unlink(path);
}
