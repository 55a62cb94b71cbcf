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
#define FOLLOWS_TIP "{\"model\": \"beast\", \"joint\": \"tail_8\", \"of\": \"up\", \"chain\": \"tail\"}"

static const struct param *equilibrium(const struct session *session)
{
    return &session->document->splines[0]->parameter[PARAMETER_EQUILIBRIUM];
}

static const struct chain *tail(const struct session *session) { return &session->document->rigs[1]->chain; }

static void turn_from(struct session *s, const char *target) { session_carry(s, target, 30, 20, 4); }
static void shows(struct session *s, const char *widget) { assert_true(panel_shows(s, widget)); }
static void lacks(struct session *s, const char *widget) { assert_false(panel_shows(s, widget)); }
static void gain(struct session *s, const char *number) { panel_enter(s, "joint.gain", number); }
/// By its first letter; LEAVE is Esc.
static void key(struct session *s, const char *name)
{
    static const int keys[] = {['B'] = KEY_BACKSPACE, ['D'] = KEY_DOWN, ['E'] = KEY_ENTER, ['L'] = KEY_ESCAPE};
    session_key(s, keys[(size_t)*name], 0);
}

/// Steps with ; between them.
static void take_steps(struct session *s, const char *steps)
{
    static const struct {
        const char *word;
        void (*take)(struct session *s, const char *what);
    } all[] = {{"panel", panel_click}, {"on", session_click},  {"turn", turn_from},
               {"tab", panel_tab_to},  {"type", session_type}, {"gain", gain},
               {"shows", shows},       {"lacks", lacks},       {"key", key}};
    for (char word[16], what[64]; *steps;) {
        int used = 0;
        size_t i = 0;
        assert_int_equal(sscanf(steps, " %15[a-z] %63[^;]%n", word, what, &used), 2);
        while (strcmp(word, all[i].word) != 0) assert_true(++i < sizeof all / sizeof *all);
        all[i].take(s, what);
        steps += used + (steps[used] == ';');
    }
}

/// What is chosen is in the scene, by one step; or nothing is changed, and said to be wrong.
TEST(test_bones_are_chosen)
{
    static const struct {
        const char *equilibrium, *steps;
        const char *saves[2]; ///< NULL: nothing has changed
        const char *error;
    } rows[] = {
        // from the start it follows the tip of its chain, as the swing only: a metre is more of the tip than 1 of what knots directed
        {"0",
         "panel follow.equilibrium;panel item.A joint of beast",
         {"\"joint\": \"tail_8\", \"of\": \"up\", \"gain\": ", "\"axis\": \"up\", \"of\": \"displacement\""},
         NULL},
        {FOLLOWS, "panel joint.0;panel item.neck", {"\"joint\": \"neck\", \"of\": \"turn\", \"gain\": 2"}, NULL},
        {FOLLOWS, "panel joint.of.across", {"\"joint\": \"head\", \"of\": \"across\", \"gain\": 2"}, NULL},
        {FOLLOWS, "gain -3", {"\"joint\": \"head\", \"of\": \"turn\", \"gain\": -3"}, NULL},
        {FOLLOWS,
         "tab joint.0;key ENTER;type fr_2;shows item.leg_FR_2;lacks item.leg_FL_2;key BACKSPACE;shows item.leg_FR_1;"
         "key DOWN;key ENTER",
         {"\"joint\": \"leg_FR_2\""},
         NULL},
        {FOLLOWS, "panel joint.pick;key LEAVE;on bone(leg_FL_2)", {NULL}, NULL}, // the click only selected the bone
        {FOLLOWS, "panel joint.pick;turn bone(tail_4)", {NULL}, NULL},           // also over a chain
        {FOLLOWS, "panel joint.pick;turn bone(tail_4);on bone(neck)", {"\"joint\": \"neck\""}, NULL},
        {FOLLOWS,
         "panel joint.pick;on bone(neck);on bone(spine)",
         {"\"joint\": \"neck\""},
         NULL}, // one click was asked for
        // the end of a chain is below its first bone, and what follows its tip still does
        {FOLLOWS_TIP,
         "panel chain.to.1;lacks item.neck;panel item.tail_6",
         {"\"to\": \"tail_6\"", "\"joint\": \"tail_6\""},
         NULL},
        {FOLLOWS_TIP,
         "panel chain.from.1;type tail_2;key ENTER",
         {"\"from\": \"tail_2\"", "\"to\": \"tail_8\""},
         NULL},
        {"0", "panel chain.from.pick;on bone(ear_L_1)", {"\"from\": \"ear_L_1\"", "\"to\": \"ear_L_2\""}, NULL},
        {"0", "panel chain.to.pick;on bone(neck)", {NULL}, "expected \"neck\" below \"tail_1\""},
        {"0", "panel chain.from.pick;on bone(head)", {NULL}, "\"head\" branches into"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct session s;
        open_beast(&s, rows[r].equilibrium);
        const char *before = session_saved(&s);
        take_steps(&s, rows[r].steps);
        if (!rows[r].saves[0]) assert_saved(&s, before);
        if (rows[r].saves[0]) assert_one_step(&s, before);
        for (int k = 0; k < 2 && rows[r].saves[k]; k++) {
            if (!strstr(session_saved(&s), rows[r].saves[k])) fail_msg("%s: no %s", rows[r].steps, rows[r].saves[k]);
        }
        if (rows[r].error) assert_said_error(s.editor, rows[r].error);
        session_close(&s);
    }
}

SESSION_TEST(test_an_equilibrium_that_follows_comes_back, open_beast(s, "0"))
{
    take_steps(s, "panel follow.equilibrium;panel item.A joint of beast");
    assert_true(equilibrium(s)->motion->gain > 1);
    assert_string_equal(equilibrium(s)->motion->chain, "tail");
    panel_click(s, "follow.equilibrium");
    assert_null(equilibrium(s)->motion);
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

SESSION_TEST(test_all_bones_are_shown_to_choose_from, open_beast(s, FOLLOWS))
{
    session_move(s, 2, 2); // over no model
    session_frame(s);
    const int without = lines_on_stage(s);
    panel_click(s, "joint.pick");
    session_move(s, 2, 2);
    session_frame(s);
    assert_true(lines_on_stage(s) > without + 8);
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
