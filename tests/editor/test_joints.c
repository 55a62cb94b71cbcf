/// Bones that are chosen for something in the inspector, from a list or on the stage: joints that an equilibrium follows, and the ends of
/// chains; what is active after an undo; and where the curves look.
#include "panel_session.h"

#include "beast.h"
#include "editor/core/rigs.h"
#include "folder.h"
#include "shown.h"

/// A beast that nods, with a chain in its tail and one in its left ear.
static void open_beast(struct session *session, const char *equilibrium)
{
    char scene[4096];
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(
        scene, sizeof scene,
        "{\"wiggly\": 1, \"fps\": 24, \"frames\": [0, 48], \"splines\": [{\"name\": \"flick\", \"frequency\": 1, "
        "\"damping\": 0.1, \"equilibrium\": %s, \"knots\": []}, {\"name\": \"perk\", \"frequency\": 1, "
        "\"damping\": 0.1, \"knots\": []}], \"rigs\": [{\"type\": \"model\", \"name\": \"beast\", \"model\": "
        "\"%s\", \"clip\": \"Nod\"}, {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"beast\", "
        "\"from\": \"tail_1\", \"to\": \"tail_8\", \"channels\": [{\"spline\": \"flick\", \"axis\": \"up\", "
        "\"lag\": 20, \"gain\": 8}]}]}",
        equilibrium, folder_path("beast.glb"));
    panel_open_models(session, scene);
    if (playback_of(session->editor)->playing) session_key(session, KEY_SPACE, 0);
    session_move(session, 2, 2);
    session_frame(session);
}

#define FOLLOWS "{\"model\": \"beast\", \"joint\": \"head\", \"of\": \"turn\", \"gain\": 2}"

static const struct param *equilibrium(const struct session *session)
{
    return &session->document->splines[0]->parameter[PARAMETER_EQUILIBRIUM];
}

static const struct chain *tail(const struct session *session) { return &session->document->rigs[1]->chain; }

SESSION_TEST(test_an_equilibrium_comes_to_follow_the_tip_of_its_chain, open_beast(s, "0"))
{
    const char *before = session_saved(s);
    panel_click(s, "follow.equilibrium");
    panel_click(s, "item.A joint of beast");
    assert_non_null(equilibrium(s)->motion);
    assert_string_equal(equilibrium(s)->motion->joint, "tail_8");
    assert_string_equal(equilibrium(s)->motion->chain, "tail");
    assert_int_equal(equilibrium(s)->motion->of, MOTION_UP);
    assert_true(equilibrium(s)->motion->gain > 1); // a metre is more of the tip than 1 of what knots directed
    assert_int_equal(tail(s)->channels[0].of, PART_DISPLACEMENT);
    assert_one_step(s, before);
    panel_click(s, "follow.equilibrium");
    assert_null(equilibrium(s)->motion);
}

SESSION_TEST(test_a_joint_is_chosen_from_a_list, open_beast(s, FOLLOWS))
{
    const char *before = session_saved(s);
    panel_click(s, "joint.0");
    panel_click(s, "item.neck");
    assert_string_equal(equilibrium(s)->motion->joint, "neck");
    assert_int_equal(equilibrium(s)->motion->of, MOTION_TURN);
    assert_near(equilibrium(s)->motion->gain, 2, 0);
    assert_one_step(s, before);
    panel_click(s, "joint.of.across");
    assert_int_equal(equilibrium(s)->motion->of, MOTION_ACROSS);
    panel_enter(s, "joint.gain", "-3");
    assert_near(equilibrium(s)->motion->gain, -3, 0);
    assert_string_equal(equilibrium(s)->motion->joint, "neck");
    for (int step = 0; step < 3; step++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, before);
}

/// Tab to the field, Enter, a few letters, Enter.
SESSION_TEST(test_a_joint_is_found_by_typing, open_beast(s, FOLLOWS))
{
    panel_tab_to(s, "joint.0");
    session_key(s, KEY_ENTER, 0);
    session_type(s, "fr_2");
    assert_true(panel_shows(s, "item.leg_FR_2"));
    assert_false(panel_shows(s, "item.leg_FL_2"));
    session_key(s, KEY_BACKSPACE, 0);
    assert_true(panel_shows(s, "item.leg_FR_1"));
    session_key(s, KEY_DOWN, 0);
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(equilibrium(s)->motion->joint, "leg_FR_2");
}

static int lines_on_stage(const struct session *session)
{
    const struct drawlist *list = drawn_by(session->editor);
    const struct rect stage = layout_of(session->editor)->stage;
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        const struct rect *r = &list->commands[i].bounds;
        count += list->commands[i].kind != DRAW_TEXT && r->w < stage.w / 2 && rect_contains(stage, r->x, r->y);
    }
    return count;
}

SESSION_TEST(test_a_joint_is_picked_on_the_stage, open_beast(s, FOLLOWS))
{
    const char *before = session_saved(s);
    session_move(s, 2, 2); // over no model
    session_frame(s);
    const int without = lines_on_stage(s);
    panel_click(s, "joint.pick");
    session_move(s, 2, 2);
    session_frame(s);
    assert_true(lines_on_stage(s) > without + 8); // all bones, to choose from
    session_key(s, KEY_ESCAPE, 0);
    session_click(s, "bone(leg_FL_2)");
    assert_saved(s, before); // Esc had let go: the click only selected the bone
    panel_click(s, "joint.pick");
    session_carry(s, "bone(tail_4)", 30, 20, 4); // a drag turns the camera, also over a chain
    assert_saved(s, before);
    session_click(s, "bone(neck)");
    assert_string_equal(equilibrium(s)->motion->joint, "neck");
    assert_one_step(s, before);
    const char *after = session_saved(s);
    session_click(s, "bone(spine)");
    assert_saved(s, after); // one click is what was asked for
}

SESSION_TEST(test_the_ends_of_a_chain_are_chosen_from_lists,
             open_beast(s, "{\"model\": \"beast\", \"joint\": \"tail_8\", \"of\": \"up\", \"chain\": \"tail\"}"))
{
    const char *before = session_saved(s);
    panel_click(s, "chain.to.1");
    assert_false(panel_shows(s, "item.neck")); // not below the first bone
    panel_click(s, "item.tail_6");
    assert_string_equal(tail(s)->to, "tail_6");
    assert_string_equal(equilibrium(s)->motion->joint, "tail_6"); // it still follows the tip
    assert_one_step(s, before);
    panel_click(s, "chain.from.1");
    session_type(s, "tail_2");
    session_key(s, KEY_ENTER, 0);
    assert_string_equal(tail(s)->from, "tail_2");
    assert_string_equal(tail(s)->to, "tail_6");
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, before);
}

SESSION_TEST(test_a_chain_goes_to_another_limb, open_beast(s, "0"))
{
    const char *before = session_saved(s);
    panel_click(s, "chain.from.pick");
    session_click(s, "bone(ear_L_1)");
    assert_string_equal(tail(s)->from, "ear_L_1");
    assert_string_equal(tail(s)->to, "ear_L_2");
    assert_one_step(s, before);
}

SESSION_TEST(test_ends_that_are_no_chain_are_refused, open_beast(s, "0"))
{
    const char *before = session_saved(s);
    panel_click(s, "chain.to.pick");
    session_click(s, "bone(neck)");
    assert_saved(s, before);
    assert_said_error(s->editor, "expected \"neck\" below \"tail_1\"");
    panel_click(s, "chain.from.pick");
    session_click(s, "bone(head)");
    assert_saved(s, before);
    assert_said(s->editor, "\"head\" branches into");
}

/// Two beasts side by side: a bone goes by its character's name, and can be asked for by it.
TEST(test_a_second_character_is_named)
{
    struct session s;
    char scene[2048];
    int model;
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(scene, sizeof scene,
             "{\"wiggly\": 1, \"fps\": 24, \"frames\": [0, 48], \"splines\": [], \"rigs\": [{\"type\": \"model\", "
             "\"name\": \"left\", \"model\": \"%s\", \"position\": [-1, 0, 0]}, {\"type\": \"model\", \"name\": "
             "\"right\", \"model\": \"%s\", \"position\": [1, 0, 0]}]}",
             folder_path("beast.glb"), folder_path("beast.glb"));
    panel_open_models(&s, scene);
    session_frame(&s);
    for (int rig = 0; rig < 2; rig++) {
        const char *bone = rig ? "right/neck" : "left/neck";
        char target[64];
        snprintf(target, sizeof target, "bone(%s)", bone);
        session_hover(&s, target);
        assert_non_null(shown_text(s.editor, bone));
        session_click(&s, target);
        assert_true(bones_selected(&s.editor->core, &model) >= 0);
        assert_int_equal(model, rig);
    }
    session_click(&s, "bone(right/tail_3)");
    session_key(&s, 'J', 0);
    assert_said(s.editor, "from right/tail_3 to tail_8");
    session_click(&s, "bone(neck)"); // the first that there is
    assert_true(bones_selected(&s.editor->core, &model) >= 0);
    assert_int_equal(model, 0);
    session_close(&s);
}

/// A chain that follows bends by many degrees a metre: its slider goes that far, and stays as it is while it is dragged.
SESSION_TEST(test_a_large_gain_is_on_its_slider, open_beast(s, "0"))
{
    panel_enter(s, "gain", "86");
    panel_drag(s, "gain", 120);
    assert_near(tail(s)->channels[0].gain.value[0], 120, 2);
    panel_release(s);
    panel_drag(s, "gain", 30);
    assert_near(tail(s)->channels[0].gain.value[0], 30, 2);
    panel_release(s);
}

SESSION_TEST(test_undoing_a_chain_activates_what_was_active, open_beast(s, "0"))
{
    session_key(s, KEY_PAGE_UP, 0);
    assert_int_equal(active(s->editor), 1);
    session_click(s, "bone(ear_L_1)");
    session_key(s, 'J', 0);
    session_click(s, "bone(leg_FL_1)");
    session_key(s, 'J', 0);
    assert_int_equal(active(s->editor), 4);
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(active(s->editor), 2);
    assert_int_equal(shown_rig(s->editor), 2);
    session_key(s, 'Z', MOD_CTRL);
    assert_int_equal(active(s->editor), 1);
    assert_int_equal(shown_rig(s->editor), 1);
}

/// Where the knot of the first spline is in the curves, against the plot.
static bool knot_is_seen(const struct session *s)
{
    const struct core *core = &s->editor->core;
    const struct spline *spline = s->document->splines[0];
    assert_int_equal(spline->knot_count, 1);
    const float y = curves_y(s->editor->curves, core, spline->knots[0].value);
    return y >= core->view.layout.plot.y && y <= core->view.layout.plot.y + core->view.layout.plot.h;
}

SESSION_TEST(test_the_curves_show_a_knot_that_was_pulled, open_beast(s, "0"))
{
    panel_enter(s, "gain", "0.1"); // so that a pull needs large values
    session_pull(s, "chain(tail,0.95)", 0, -40, 12);
    for (int frame = 0; frame < 90; frame++) session_frame(s);
    assert_true(knot_is_seen(s)); // already while it is pulled
    session_release(s, BUTTON_LEFT);
    for (int frame = 0; frame < 30; frame++) session_frame(s);
    assert_true(knot_is_seen(s));
}

TESTS_BETWEEN(folder_make, folder_remove)
