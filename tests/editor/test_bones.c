/// Imported characters on the stage: bones are pointed at, chosen, made into chains and dragged; a stranger's rig with controls, poles and
/// leaves; and models without bones.
#include "beast.h"
#include "folder.h"
#include "hands.h"

TESTS_BETWEEN(folder_make, folder_remove)

/// The beast on the stage, with chains. The pointer is where it does nothing.
static void open_beast(struct session *s, const char *equilibrium, const char *more_rigs)
{
    char text[4096];
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(text, sizeof text,
             "{'fps': 24, 'frames': [0, 48], 'splines': [{'name': 'flick', 'frequency': 1, 'damping': 0.1, "
             "'equilibrium': %s, 'knots': []}, {'name': 'perk', 'frequency': 1, 'damping': 0.1, 'knots': []}], "
             "'rigs': [{'type': 'model', 'name': 'beast', 'model': '%s'}%s]}",
             equilibrium, folder_path("beast.glb"), more_rigs);
    panel_open_models(s, text);
    hands(s, "at 2 2; keep");
}

#define CHAIN(name, from, to, axis)                                                                                  \
    ", {'type': 'chain', 'name': '" name "', 'model': 'beast', 'from': '" from "', 'to': '" to                       \
    "', 'channels': [{'spline': 'flick', 'axis': '" axis "', 'lag': 20, 'gain': 8}]}"
#define TAIL CHAIN("tail", "tail_1", "tail_8", "side")
#define TAIL_UP CHAIN("tail", "tail_1", "tail_8", "up")
#define LEFT_EAR CHAIN("ear_L", "ear_L_1", "ear_L_2", "side")

#define BEAST_TEST(name, chains) SESSION_TEST(name, open_beast(s, "0", chains))

// --- bones --------------------------------------------------------------------------------------------------------------

/// A drag from a bone moves the character; it is no click.
BEAST_TEST(test_the_bone_pointed_at_says_its_name_and_a_click_selects_it, "")
{
    hands(s, "hides neck; hover bone(neck); shows neck; is bone ;"
             "click bone(neck); is bone neck; click bone(leg_FL_2); is bone leg_FL_2; key Escape; is bone ;"
             "click bone(neck); click stage(0.02,0.95); is bone ;"
             "carry bone(neck) 40 0; is bone ;"
             "hover bone(neck)");
    assert_ptr_equal(hovered(s->editor), &thing_bone);
}

/// How far a bone is turned from its rest, as a chord.
static float turned(const struct session *s, const char *name)
{
    const struct imported *beast = models_imported(s->world.models, s->document, 0);
    const int node = gltf_find_node(&beast->gltf, name);
    const float *now = editor_stage(s->editor)->models[0].posed.pose->world[node], *rest = beast->rest.world[node];
    float square = 0;
    for (int k = 0; k < 12; k++) square += (now[k] - rest[k]) * (now[k] - rest[k]);
    return sqrtf(square);
}

/// It goes where the pointer takes it, its chain swings after it and comes to rest; one step, and Esc takes it back.
BEAST_TEST(test_a_dragged_character_moves_and_its_chain_follows_through, TAIL)
{
    const float *root = editor_stage(s->editor)->models[0].posed.root;
    const float start[2] = {root[12], root[14]};
    hands(s, "pull bone(neck) 80 0 6");
    const float held[2] = {root[12], root[14]};
    assert_true(hypotf(held[0] - start[0], held[1] - start[1]) > 0.1f);
    assert_true(turned(s, "tail_8") > 0.02f);
    assert_near(turned(s, "neck"), 0, 1e-6);
    hands(s, "release; wait; is rigs.0.position.1 0; is bone ");
    assert_near(root[12], held[0], 1e-3);
    assert_near(root[14], held[1], 1e-3);
    assert_true(hypot(number(s, "rigs.0.position.0"), number(s, "rigs.0.position.2")) > 0.1);
    hands(s, "wait 1200");
    assert_near(turned(s, "tail_8"), 0, 1e-6);
    hands(s, "once; key Ctrl+Z; pull bone(neck) 0 40; key Escape; release; kept");
}

/// Alt+V: the clip alone stands beside it, and no chain bends that one.
BEAST_TEST(test_the_original_is_shown_beside_it, TAIL)
{
    const struct stage_view *view = editor_stage(s->editor);
    const struct stage_model *beast = view->models;
    assert_done(edit_knot_insert(s->editor->core.document, 0, &(struct knot){.value = 2, .stiffness = 1}, &error));
    hands(s, "key Alt+V; wait");
    assert_int_equal(view->model_count, 2);
    const int tip = gltf_find_node(beast[0].posed.gltf, "tail_8"), hips = gltf_find_node(beast[0].posed.gltf, "hips");
    assert_true(beast[1].posed.root[12] > beast[0].posed.root[12] + 0.5f);
    assert_memory_equal(beast[0].posed.pose->world[hips], beast[1].posed.pose->world[hips],
                        sizeof *beast->posed.pose->world);
    assert_true(fabsf(beast[0].posed.pose->world[tip][12] - beast[1].posed.pose->world[tip][12]) > 0.05f);
    hands(s, "key Alt+V; wait");
    assert_int_equal(view->model_count, 1);
}

/// Seen from the side both legs lie over each other: the near one is meant.
BEAST_TEST(test_of_bones_over_each_other_the_near_one_is_picked, "")
{
    const struct stage_view *view = editor_stage(s->editor);
    for (int turn = 0; turn < 16; turn++) {
        float left[2], right[2];
        struct error error;
        hands(s, "key Ctrl+Shift+Left");
        if (!editor_target(s->editor, "bone(leg_FL_1)", &left[0], &left[1], &error)) continue;
        if (!editor_target(s->editor, "bone(leg_FR_1)", &right[0], &right[1], &error)) continue;
        if (fabsf(left[0] - right[0]) > 2) continue;
        session_move(s, (left[0] + right[0]) / 2, (left[1] + right[1]) / 2);
        session_frame(s);
        session_click_here(s, 1);
        hands(s, "is bone leg_F%c_1", view->eye[0] > 0 ? 'L' : 'R');
    }
}

/// Its tail and ears are met at three quarters from behind, whichever way it faces; what has no tail and stands upright, from the front.
BEAST_TEST(test_a_beast_is_met_from_behind, "")
{
    const float *eye = editor_stage(s->editor)->eye, *target = camera_of(s->editor)->target;
    assert_true(eye[2] < target[2] - 0.5f * (eye[0] - target[0]) && eye[0] > target[0]); // it faces +z
    struct imported beast;
    float back[2];
    assert_done(imported_read(&beast, folder_path("beast.glb"), &error));
    for (int turned = 0; turned < 2; turned++) {
        assert_true(imported_back(&beast, back));
        assert_true(turned ? back[1] > 0.4f : back[1] < -0.4f);
        assert_near(back[0], 0, 1e-3);
        for (int n = 0; n < beast.gltf.node_count; n++) beast.rest.world[n][14] *= -1;
        const float lo = beast.gltf.lo[2];
        beast.gltf.lo[2] = -beast.gltf.hi[2];
        beast.gltf.hi[2] = -lo;
    }
    for (int n = 0; n < beast.gltf.node_count; n++) beast.gltf.nodes[n].name[0] = 'n';
    assert_true(imported_back(&beast, back));
    assert_near(back[1], -1, 0);
    beast.gltf.hi[0] = beast.gltf.lo[0] + 2 * (beast.gltf.hi[2] - beast.gltf.lo[2]);
    assert_false(imported_back(&beast, back));
    imported_free(&beast);
}

// --- chains -------------------------------------------------------------------------------------------------------------

/// A key makes one to the tip in one step; a bone that branches is refused with a sentence.
BEAST_TEST(test_a_chain_is_made, "")
{
    hands(s, "key J; kept; click bone(tail_3); key J; is rigs.# 2; is rigs.1.type chain; is rigs.1.from tail_3;"
             "is rigs.1.to tail_8; is rigs.1.channels.# > 0; is rig 1");
    assert_int_equal(active(s->editor), s->document->rigs[1]->chain.channels[0].spline);
    hands(s, "once; key Ctrl+Z; is bone tail_3; click bone.chain; is rigs.# 2; key Ctrl+Z; kept;"
             "click bone(head); is bone head; key J; kept;"
             "error \"head\" branches into \"ear_L_1\" and \"ear_R_1\"");
}

WALK(test_undoing_a_chain_activates_what_was_active, open_beast(s, "0", TAIL),
     "key PageUp; is active 1; click bone(ear_L_1); key J; click bone(leg_FL_1); key J; is active 4;"
     "key Ctrl+Z; is active 2; is rig 2; key Ctrl+Z; is active 1; is rig 1")

/// How far a point of the tail is from the pointer.
static float apart(const struct session *s, const char *target)
{
    float at[2];
    session_where(s, target, at);
    return hypotf(at[0] - s->x, at[1] - s->y);
}

/// The grabbed point follows the pointer, by a knot at the playhead; one step, and Esc takes it back. A click selects its bone.
BEAST_TEST(test_dragging_a_chain_sets_a_knot, TAIL)
{
    hands(s, "pull chain(tail,0.95) 0 -30 12; wait 60; release; is splines.0.knots.# 1");
    assert_true(apart(s, "chain(tail,0.95)") < 30); // one axis only: as near as it gets
    hands(s, "once; key Ctrl+Z; pull chain(tail,0.8) 25 0 6; key Escape; kept; release;"
             "click bone(tail_4); is bone tail_4; kept");
}

/// With an axis each way the point comes to the pointer itself.
BEAST_TEST(test_a_chain_of_two_axes_comes_to_the_pointer, TAIL)
{
    hands(s,
          "click chain(tail,0.5); click splines.add; click channel.add; click axis.up; is rigs.1.channels.1.axis up;"
          "pull chain(tail,0.9) 12 18 12; wait 60; release");
    assert_true(apart(s, "chain(tail,0.9)") < 1.5f);
}

/// Already while a chain is pulled the curves show its knot, though a small gain needs large values.
BEAST_TEST(test_the_curves_show_a_knot_that_was_pulled, TAIL_UP)
{
    hands(s, "enter gain 0.1; pull chain(tail,0.95) 0 -40 12");
    for (int held = 1; held >= 0; held--) {
        hands(s, "wait 90; is splines.0.knots.# 1");
        const float y = curves_y(&s->editor->core, s->document->splines[0]->knots[0].value);
        const struct rect plot = layout_of(s->editor)->plot;
        assert_true(y >= plot.y && y <= plot.y + plot.h);
        if (held) hands(s, "release");
    }
}

// --- the inspector on characters and chains -------------------------------------------------------------------------------

WALK(test_the_inspector_chooses_the_clip, open_beast(s, "0", ""),
     "click model.clips.0; click item.Nod; is rigs.0.clip Nod;"
     "click model.loops; is rigs.0.repeat once; click model.loops; is rigs.0.repeat loop;"
     "key Ctrl+Z Ctrl+Z; once;"
     "click model.clips.0; click item.none; is rigs.0.clip nothing; kept;"
     "enter model.scale 2; enter model.turn 90; enter model.x 0.5; is rigs.0.scale 2; is rigs.0.turn 90;"
     "is rigs.0.position.0 0.5")

/// Each move of a drag makes its edit anew, of the chain as it was at the press. Its spline stays when the chain goes.
WALK(test_a_chain_is_edited_in_the_inspector, open_beast(s, "0", TAIL),
     "carry chain.turn 40 0 6; is rigs.1.turn > 0; is rigs.1.from tail_1; once; key Ctrl+Z;"
     "click axis.twist; is rigs.1.channels.0.axis twist; click chain.mirror; is rigs.1.mirror true;"
     "keep; enter offset 2.5; is rigs.1.offset 2.5; label Set offset; once; enter offset 0; kept;"
     "enter chain.turn 30; is rigs.1.turn 30; enter gain 11; is rigs.1.channels.0.gain 11;"
     "click tail.name; key Ctrl+A; type brush; key Enter; is rigs.1.name brush;"
     "click rig.delete; key K; is rigs.# 1; is splines.# 2; key 6*Ctrl+Z; kept")

/// A chain that follows bends by many degrees a metre: its slider goes that far, and stays as it is while it is dragged.
WALK(test_a_large_gain_is_on_its_slider, open_beast(s, "0", TAIL_UP),
     "enter gain 86; slide gain 120; is rigs.1.channels.0.gain 120 ~2; release;"
     "slide gain 30; is rigs.1.channels.0.gain 30 ~2; release")

/// Its points are dragged, set beside the line by a double-click, and deleted down to two; lit, the button goes back to one angle.
BEAST_TEST(test_a_gain_becomes_a_ramp_whose_points_move, TAIL)
{
    const char *before = s->kept;
    hands(s, "click gain.ramp; is rigs.1.channels.0.gain.ramp.# 2; is rigs.1.channels.0.gain.ramp.1.1 8; keep;"
             "carry gain.point.1 -40 -12; is rigs.1.channels.0.gain.ramp.1.1 > 8;"
             "is rigs.1.channels.0.gain.ramp.1.0 < 1; once;"
             "press gain.point.0; drag 60 -8 1; release");
    session_move(s, s->x + 8, s->y + 16);
    session_click_here(s, 2);
    hands(s, "is rigs.1.channels.0.gain.ramp.# 3;"
             "press gain.point.1; release; key Delete; is rigs.1.channels.0.gain.ramp.# 2;"
             "key Delete; is rigs.1.channels.0.gain.ramp.# 2;"
             "click gain.ramp; is rigs.1.channels.0.gain > 0");
    s->kept = before;
    hands(s, "undone");
}

BEAST_TEST(test_a_ramps_plot_is_as_high_as_its_points, TAIL)
{
    const double *scale = s->editor->inspector->ramp_scale[ANGLE_GAIN];
    hands(s, "click gain.ramp; carry gain.point.0 0 -30 2; is rigs.1.channels.0.gain.ramp.0.1 > 10");
    assert_near(scale[1], 1.2 * number(s, "rigs.1.channels.0.gain.ramp.0.1"), 1e-9);
    session_move(s, s->x + 60, s->y + 50);
    session_click_here(s, 2); // a point between
    hands(s, "carry gain.point.2 0 -80 2; is rigs.1.channels.0.gain.ramp.# 3");
    const double last = number(s, "rigs.1.channels.0.gain.ramp.2.1");
    assert_near(scale[1], 1.2 * last, 1e-9);
    hands(s, "key Delete; is rigs.1.channels.0.gain.ramp.# 2"); // the highest
    const double ends[] = {number(s, "rigs.1.channels.0.gain.ramp.0.1"),
                           number(s, "rigs.1.channels.0.gain.ramp.1.1")};
    assert_true(fmax(ends[0], ends[1]) < last);
    assert_near(scale[1], 1.2 * fmax(ends[0], ends[1]), 1e-9);
}

/// Turned the other way round, as in a mirror. What has one already gets none, nor has a tail one.
BEAST_TEST(test_a_chain_gets_a_twin_on_the_other_side, LEFT_EAR)
{
    hands(s, "enter chain.turn 30; enter offset 1.5; keep");
    assert_null(missing(s->editor, NEEDS_TWIN));
    hands(s, "click chain.twin; is rigs.# 3; is rigs.2.name ear_R; is rigs.2.from ear_R_1; is rigs.2.to ear_R_2;"
             "is rigs.2.mirror true; is rigs.2.turn -30; is rigs.2.offset 1.5; is rigs.2.channels.0.spline flick; "
             "lacks chain.twin");
    assert_non_null(missing(s->editor, NEEDS_TWIN));
    hands(s, "once");
    session_close(s);
    open_beast(s, "0", TAIL);
    hands(s, "finds rig.delete; lacks chain.twin");
    assert_non_null(missing(s->editor, NEEDS_TWIN));
}

/// Sections come below, without scrolling.
BEAST_TEST(test_a_clicked_chain_leaves_its_feel_in_sight, LEFT_EAR)
{
    editor_resize(s->editor, 1280, 720, 1);
    hands(s, "more off; click bone(ear_L_2); wait; is bone ear_L_2; is scrolled 0");
}

// --- bones that are chosen for something ------------------------------------------------------------------------------------

#define FOLLOWS "{'model': 'beast', 'joint': 'head', 'of': 'turn', 'gain': 2}"
#define FOLLOWS_TIP "{'model': 'beast', 'joint': 'tail_8', 'of': 'up', 'chain': 'tail'}"

/// From a list or on the stage: what is chosen is in the scene, by one step; or nothing is changed, and said to be wrong.
TEST(test_bones_are_chosen)
{
    static const struct {
        const char *equilibrium, *steps;
    } rows[] = {
        // from the start it follows the tip of its chain, as the swing only: a metre is more of the tip than 1 of what knots directed
        {"0",
         "click follow.equilibrium; click item.A_joint_of_beast; once; is splines.0.equilibrium.joint tail_8;"
         "is splines.0.equilibrium.of up; is splines.0.equilibrium.gain > 1; is splines.0.equilibrium.chain tail;"
         "saves 'axis': 'up', 'of': 'displacement'; click follow.equilibrium; is splines.0.equilibrium 0 ~0.01"},
        {FOLLOWS, "click joint.0; click item.neck; once; saves 'joint': 'neck', 'of': 'turn', 'gain': 2"},
        {FOLLOWS, "click joint.of.across; once; saves 'joint': 'head', 'of': 'across', 'gain': 2"},
        {FOLLOWS, "enter joint.gain -3; once; saves 'joint': 'head', 'of': 'turn', 'gain': -3"},
        {FOLLOWS, "tab joint.0; key Enter; type fr_2; finds item.leg_FR_2; lacks item.leg_FL_2; key Backspace;"
                  "finds item.leg_FR_1; key Down Enter; once; is splines.0.equilibrium.joint leg_FR_2"},
        {FOLLOWS, "click joint.pick; key Escape; click bone(leg_FL_2); kept"}, // only selected the bone
        {FOLLOWS, "click joint.pick; carry bone(tail_4) 30 20; kept"},         // also over a chain
        {FOLLOWS, "click joint.pick; carry bone(tail_4) 30 20; click bone(neck); once; saves 'joint': 'neck'"},
        {FOLLOWS,
         "click joint.pick; click bone(neck); click bone(spine); once; saves 'joint': 'neck'"}, // one was asked for
        // the end of a chain is below its first bone, and what follows its tip still does
        {FOLLOWS_TIP, "click chain.to.1; lacks item.neck; click item.tail_6; once; is rigs.1.to tail_6;"
                      "is splines.0.equilibrium.joint tail_6"},
        {FOLLOWS_TIP, "click chain.from.1; type tail_2; key Enter; once; is rigs.1.from tail_2; is rigs.1.to tail_8"},
        {"0", "click chain.from.pick; click bone(ear_L_1); once; is rigs.1.from ear_L_1; is rigs.1.to ear_L_2"},
        {"0", "click chain.to.pick; click bone(neck); kept; error expected \"neck\" below \"tail_1\""},
        {"0", "click chain.from.pick; click bone(head); kept; error \"head\" branches into"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct session s;
        open_beast(&s, rows[r].equilibrium, TAIL_UP);
        hands(&s, "%s", rows[r].steps);
        session_close(&s);
    }
}

static int lines_on_stage(const struct session *s)
{
    const struct drawlist *list = drawn_by(s->editor);
    const struct rect stage = layout_of(s->editor)->stage;
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        const struct rect *r = &list->commands[i].bounds;
        count += list->commands[i].kind != DRAW_TEXT && r->w < stage.w / 2 && rect_contains(stage, r->x, r->y);
    }
    return count;
}

SESSION_TEST(test_all_bones_are_shown_to_choose_from, open_beast(s, FOLLOWS, TAIL_UP))
{
    const int without = lines_on_stage(s);
    hands(s, "click joint.pick; at 2 2");
    assert_true(lines_on_stage(s) > without + 8);
}

/// Two beasts side by side: a bone goes by its character's name, and can be asked for by it.
TEST(test_a_second_character_is_named)
{
    struct session s;
    char text[2048];
    int model;
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(
        text, sizeof text,
        "{'fps': 24, 'frames': [0, 48], 'splines': [], 'rigs': [{'type': 'model', 'name': 'left', 'model': '%s', "
        "'position': [-1, 0, 0]}, {'type': 'model', 'name': 'right', 'model': '%s', 'position': [1, 0, 0]}]}",
        folder_path("beast.glb"), folder_path("beast.glb"));
    panel_open_models(&s, text);
    hands(&s, "wait");
    for (int rig = 0; rig < 2; rig++) {
        const char *side = rig ? "right" : "left";
        hands(&s, "hover bone(%s/neck); shows %s/neck; click bone(%s/neck)", side, side, side);
        assert_true(bones_selected(&s.editor->core, &model) >= 0);
        assert_int_equal(model, rig);
    }
    hands(
        &s,
        "click bone(right/tail_3); key J; said from right/tail_3 to tail_8; click bone(neck)"); // the first that there is
    assert_true(bones_selected(&s.editor->core, &model) >= 0);
    assert_int_equal(model, 0);
    session_close(&s);
}

// --- a stranger's rig: controls, poles and leaves between the bones that vertices follow ------------------------------------------

/// The joints of the rig, parents first. A triangle follows each that has a `size`; two skins share them all.
static const struct joint {
    const char *name;
    int parent;
    float at[3], size; ///< from the parent; of the triangle
} joints[] = {
    {"root", -1, {0, 0, 0}, 0},             // 0: a control on the ground
    {"hips", 0, {0, 1, 0}, 0.3f},           // 1
    {"chest", 1, {0, 0.4f, 0}, 0.3f},       // 2
    {"head", 2, {0, 0.3f, 0}, 0.2f},        // 3
    {"ear_L_1", 3, {0.3f, 0.1f, 0}, 0.1f},  // 4
    {"ear_L_2", 4, {0.2f, 0.1f, 0}, 0.1f},  // 5
    {"ear_L_end", 5, {0.2f, 0.1f, 0}, 0},   // 6: a leaf
    {"ear_R_1", 3, {-0.3f, 0.1f, 0}, 0.1f}, // 7
    {"leg", 1, {0, -0.5f, 0}, 0.2f},        // 8
    {"foot", 8, {0, -0.45f, 0.1f}, 0.1f},   // 9
    {"knee_pole", 0, {0, 0.5f, 1}, 0},      // 10
    {"foot_ik", 0, {0.4f, 0.02f, 0.5f}, 0}, // 11
    {"spline_ik", 11, {0, 0, -0.2f}, 0},    // 12
};

enum { JOINTS = sizeof joints / sizeof *joints };

static const float triangle[3][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}};

static void write_rig(struct builder *b)
{
    float inverse[JOINTS][16] = {{0}}, place[JOINTS][3] = {{0}}, position[3 * JOINTS][3],
          weight[3 * JOINTS][4] = {{0}};
    unsigned char follows[3 * JOINTS][4] = {{0}};
    char nodes[4096] = "", list[256] = "", members[8192];
    int vertices = 0;
    for (int j = 0; j < JOINTS; j++) {
        const struct joint *joint = &joints[j];
        char children[128] = "";
        for (int k = 0; k < 3; k++) place[j][k] = joint->at[k] + (j > 0 ? place[joint->parent][k] : 0);
        for (int k = 0; k < 16; k++) inverse[j][k] = k % 5 == 0;
        for (int k = 0; k < 3; k++) inverse[j][12 + k] = -place[j][k];
        for (int i = 0; joint->size > 0 && i < 3; i++, vertices++) {
            for (int k = 0; k < 3; k++) position[vertices][k] = place[j][k] + joint->size * triangle[i][k];
            follows[vertices][0] = (unsigned char)j;
            weight[vertices][0] = 1;
        }
        for (int c = 0; c < JOINTS; c++) {
            char *end = children + strlen(children);
            if (c > 0 && joints[c].parent == j) sprintf(end, children[0] ? ",%d" : ",\"children\":[%d", c);
        }
        if (strcmp(joint->name, "ear_L_1") == 0) sprintf(children + strlen(children), ",%d", JOINTS); // a ring in it
        sprintf(nodes + strlen(nodes), "{\"name\":\"%s\",\"translation\":[%g,%g,%g]%s%s},", joint->name,
                (double)joint->at[0], (double)joint->at[1], (double)joint->at[2], children, children[0] ? "]" : "");
        sprintf(list + strlen(list), j ? ",%d" : "%d", j);
    }
    add_data(b, FLOAT, "VEC3", vertices, position, sizeof *position * (size_t)vertices);
    add_data(b, UBYTE, "VEC4", vertices, follows, sizeof *follows * (size_t)vertices);
    add_data(b, FLOAT, "VEC4", vertices, weight, sizeof *weight * (size_t)vertices);
    add_data(b, FLOAT, "MAT4", JOINTS, inverse, sizeof inverse);
    snprintf(
        members, sizeof members,
        "\"scenes\":[{\"nodes\":[0,%d,%d]}],\"nodes\":[%s{\"name\":\"ring\",\"mesh\":1},{\"mesh\":0,\"skin\":0},"
        "{\"mesh\":0,\"skin\":1}],\"skins\":[{\"joints\":[%s],\"inverseBindMatrices\":3},{\"joints\":[%s],"
        "\"inverseBindMatrices\":3}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,"
        "\"WEIGHTS_0\":2}}]},{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]",
        JOINTS + 1, JOINTS + 2, nodes, list, list);
    const char *json = builder_json(b, members);
    temporary_file("model.gltf", json, strlen(json));
}

enum { MORPHS = 8 };

/// A triangle that eight targets move 4 m along x, each a frame of its run.
static void write_runner(struct builder *b)
{
    float moved[3][3] = {{0}}, times[MORPHS], weights[MORPHS][MORPHS] = {{0}};
    char targets[256] = "";
    for (int t = 0; t < MORPHS; t++) {
        times[t] = 0.1f * (float)t;
        weights[t][t] = 1;
        sprintf(targets + strlen(targets), t ? ",{\"POSITION\":1}" : "{\"POSITION\":1}");
    }
    for (int i = 0; i < 3; i++) moved[i][0] = i < 2 ? 0.5f : -0.5f;
    add_data(b, FLOAT, "VEC3", 3, triangle, sizeof triangle);
    add_data(b, FLOAT, "VEC3", 3, moved, sizeof moved);
    add_data(b, FLOAT, "SCALAR", MORPHS, times, sizeof times);
    add_data(b, FLOAT, "SCALAR", MORPHS * MORPHS, weights, sizeof weights);
    char members[2048];
    snprintf(
        members, sizeof members,
        "\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":\"stable\",\"children\":[1]},{\"mesh\":0}],\"meshes\":"
        "[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"targets\":[%s]}]}],\"animations\":[{\"name\":\"run\","
        "\"channels\":[{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"weights\"}}],\"samplers\":[{\"input\":2,"
        "\"output\":3}]}]",
        targets);
    const char *json = builder_json(b, members);
    temporary_file("model.gltf", json, strlen(json));
}

static void open_written(struct session *s, void (*write)(struct builder *b))
{
    static struct builder builder;
    char text[1024];
    builder = (struct builder){0};
    write(&builder);
    snprintf(text, sizeof text,
             "{'fps': 24, 'frames': [0, 24], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': "
             "[]}], 'rigs': [{'type': 'model', 'name': 'it', 'model': '%s'}]}",
             temporary_path("model.gltf"));
    panel_open_models(s, text);
    s->editor->core.view.refit_stage = true;
    hands(s, "at 2 2");
}

static bool shows(const struct session *s, const char *bone)
{
    char target[64];
    float xy[2];
    struct error error;
    snprintf(target, sizeof target, "bone(%s)", bone);
    return editor_target(s->editor, target, &xy[0], &xy[1], &error);
}

/// On the screen, a place on the way from one joint to another.
static void between(const struct session *s, const char *from, const char *to, float share, float xy[2])
{
    const struct stage *stage = s->editor->stage;
    const struct stage_model *model = &stage->view.models[0];
    const float *a = model->posed.pose->world[gltf_find_node(model->posed.gltf, from)] + 12;
    const float *b = model->posed.pose->world[gltf_find_node(model->posed.gltf, to)] + 12;
    float at[3];
    for (int k = 0; k < 3; k++) at[k] = model->posed.root[12 + k] + a[k] + (b[k] - a[k]) * share;
    const struct rect r = layout_of(s->editor)->stage;
    assert_true(camera_project(stage->view.view, stage->view.projection, (float[]){r.x, r.y, r.w, r.h}, at, xy));
}

static void move_between(struct session *s, const char *from, const char *to, float share)
{
    float xy[2];
    between(s, from, to, share, xy);
    session_move(s, xy[0], xy[1]);
    session_frame(s);
}

#define RIG_TEST(name) SESSION_TEST(name, open_written(s, write_rig))

/// Joints count once, and cast shadows if vertices follow them. Bones that carry nothing show with Alt.
RIG_TEST(test_bones_that_carry_nothing_show_with_alt)
{
    static const char *const bones[] = {"root", "hips",      "head",    "ear_L_1",   "ear_L_2",
                                        "foot", "knee_pole", "foot_ik", "spline_ik", "ear_L_end"};
    assert_int_equal(s->editor->stage->view.blob_count, 2); // the whole, and the foot
    assert_int_equal(bones_character(&s->editor->core, 0)->skeleton.own, JOINTS);
    for (int alt = 0; alt < 2; alt++) {
        s->mods = alt ? MOD_ALT : 0;
        move_between(s, "root", "foot_ik", 1);
        for (int i = 0; i < 10; i++)
            if (shows(s, bones[i]) != (i < 6 || alt)) fail_msg("%s, Alt %d", bones[i], alt);
        session_click_here(s, 1);
        hands(s, "is bone %s", alt ? "foot_ik" : "");
    }
}

/// All along the link from a branching bone; the bone itself goes on as the one before it.
RIG_TEST(test_a_press_takes_the_bone_whose_part_is_drawn_there)
{
    static const struct {
        const char *from, *to;
        float share;
        const char *bone;
    } presses[] = {
        {"head", "ear_L_1", 0.6f, "ear_L_1"},    {"head", "ear_R_1", 0.6f, "ear_R_1"},
        {"chest", "head", 0.5f, "chest"},        {"chest", "head", 1.2f, "head"},
        {"hips", "chest", 0.5f, "hips"},         {"hips", "leg", 0.5f, "leg"},
        {"ear_L_1", "ear_L_2", 0.5f, "ear_L_1"}, {"root", "hips", 0.25f, "root"},
    };
    for (size_t i = 0; i < sizeof presses / sizeof *presses; i++) {
        move_between(s, presses[i].from, presses[i].to, presses[i].share);
        session_click_here(s, 1);
        hands(s, "is bone %s", presses[i].bone);
    }
}

/// Neither the ring in the ear nor its leaf is a branch, or part of the chain.
WALK(test_hover_names_the_chain_that_the_key_makes, open_written(s, write_rig),
     "hover bone(ear_L_1); shows ear_L_1 to ear_L_2, 2 bones; hover bone(head); shows head;"
     "click bone(ear_L_1); key J; is rigs.1.from ear_L_1; is rigs.1.to ear_L_2")

static float size_of_ear(const struct session *s)
{
    float a[2], b[2];
    between(s, "ear_L_1", "ear_L_2", 0, a);
    between(s, "ear_L_1", "ear_L_2", 1, b);
    return hypotf(a[0] - b[0], a[1] - b[1]);
}

RIG_TEST(test_f_frames_the_selection_and_still_holds_frequency)
{
    hands(s, "click bone(ear_L_1)");
    const float before = size_of_ear(s), height = layout_of(s->editor)->stage.h;
    session_hold(s, 'F', ACTION_PRESS);
    hands(s, "key Up");
    session_hold(s, 'F', ACTION_RELEASE);
    hands(s, "wait; is splines.0.frequency > 1");
    assert_near(size_of_ear(s), before, 1e-3);
    hands(s, "key F");
    const float framed = size_of_ear(s);
    assert_true(framed > 0.3f * height);
    session_move(s, 2, layout_of(s->editor)->plot.y + 20);
    hands(s, "key Shift+Home F"); // not over the curves
    assert_true(size_of_ear(s) < 0.5f * framed);
}

RIG_TEST(test_the_wheel_zooms_to_the_pointer)
{
    for (int i = 0; i < 2; i++) {
        float xy[2];
        const float before = size_of_ear(s);
        move_between(s, "foot", "leg", 0);
        session_wheel(s, i == 0 ? 8 : -5);
        between(s, "foot", "leg", 0, xy);
        assert_true(i == 0 ? size_of_ear(s) > 2 * before : size_of_ear(s) < 0.6f * before);
        assert_true(hypotf(xy[0] - s->x, xy[1] - s->y) < 0.03f * layout_of(s->editor)->stage.h);
    }
}

/// Its eight targets are never seen at once: it is at most 3 m wide.
SESSION_TEST(test_a_model_of_morphs_fills_the_view, open_written(s, write_runner))
{
    const struct rect figure = stage_figure(s->editor->stage, &s->editor->core), stage = layout_of(s->editor)->stage;
    const struct stage_model *model = &s->editor->stage->view.models[0];
    assert_true(model->hi[0] - model->lo[0] < 3);
    assert_true(figure.w > 0.5f * stage.w || figure.h > 0.5f * stage.h);
    hands(s, "hides Click a bone, then press Shift+J to let it swing. F1 shows all keys;"
             "shows It has no bones to bend. A adds a tail or a character, F1 shows all keys");
}
