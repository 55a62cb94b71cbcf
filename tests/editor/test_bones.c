/// Bones of an imported character on the stage: pointed at, selected, made into chains, and dragged.
#include "panel_session.h"

#include "beast.h"
#include "editor/core/rigs.h"
#include "folder.h"

/// The beast on the stage at rest, with a chain in its left ear. The pointer is where it does nothing.
static void open_beast(struct session *session, const char *chains)
{
    char scene[4096];
    assert_true(beast_write(folder_path("beast.glb")));
    snprintf(
        scene, sizeof scene,
        "{\"wiggly\": 1, \"fps\": 24, \"frames\": [0, 48], \"splines\": [{\"name\": \"flick\", \"frequency\": 1, "
        "\"damping\": 0.1, \"knots\": []}], \"rigs\": [{\"type\": \"model\", \"name\": \"beast\", \"model\": "
        "\"%s\"}%s]}",
        folder_path("beast.glb"), chains);
    panel_open_models(session, scene);
    session_move(session, 2, 2);
    session_frame(session);
}

#define TAIL                                                                                                         \
    ", {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"beast\", \"from\": \"tail_1\", \"to\": \"tail_8\", "   \
    "\"channels\": [{\"spline\": \"flick\", \"axis\": \"side\", \"lag\": 20, \"gain\": 8}]}"
#define LEFT_EAR                                                                                                     \
    ", {\"type\": \"chain\", \"name\": \"ear_L\", \"model\": \"beast\", \"from\": \"ear_L_1\", \"to\": "             \
    "\"ear_L_2\", "                                                                                                  \
    "\"channels\": [{\"spline\": \"flick\", \"axis\": \"side\", \"lag\": 20, \"gain\": 8}]}"

SESSION_TEST(test_the_bone_pointed_at_says_its_name_and_a_click_selects_it, open_beast(s, ""))
{
    assert_false(session_shows(s, "neck"));
    session_hover(s, "bone(neck)");
    assert_ptr_equal(hovered(s->editor), &thing_bone);
    assert_true(session_shows(s, "neck"));
    assert_string_equal(selected_bone(s->editor), "");
    session_click(s, "bone(neck)");
    assert_string_equal(selected_bone(s->editor), "neck");
    session_click(s, "bone(leg_FL_2)");
    assert_string_equal(selected_bone(s->editor), "leg_FL_2");
    session_key(s, KEY_ESCAPE, 0);
    assert_string_equal(selected_bone(s->editor), "");
    session_click(s, "bone(neck)");
    session_click(s, "stage(0.02,0.95)");
    assert_string_equal(selected_bone(s->editor), "");
}

/// A drag from a bone moves the character; it is no click.
SESSION_TEST(test_a_drag_from_a_bone_selects_nothing, open_beast(s, ""))
{
    session_carry(s, "bone(neck)", 40, 0, 4);
    assert_string_equal(selected_bone(s->editor), "");
}

/// How far a bone is turned from its rest, as a chord.
static float turned(const struct session *s, const char *name)
{
    const struct imported *beast = models_imported(s->world.models, s->document, 0);
    const int node = gltf_find_node(&beast->gltf, name);
    const float *now = editor_stage(s->editor)->models[0].pose->world[node], *rest = beast->rest.world[node];
    float square = 0;
    for (int k = 0; k < 12; k++) square += (now[k] - rest[k]) * (now[k] - rest[k]);
    return sqrtf(square);
}

/// It goes where the pointer takes it, its chain swings after it and comes to rest; one step, and Esc takes it back.
SESSION_TEST(test_a_dragged_character_moves_and_its_chain_follows_through, open_beast(s, TAIL))
{
    const char *before = session_saved(s);
    const float *root = editor_stage(s->editor)->models[0].root;
    const float start[2] = {root[12], root[14]};
    session_pull(s, "bone(neck)", 80, 0, 6);
    assert_true(hypotf(root[12] - start[0], root[14] - start[1]) > 0.1f);
    assert_true(turned(s, "tail_8") > 0.02f);
    assert_near(turned(s, "neck"), 0, 1e-6);
    const float held[2] = {root[12], root[14]};
    session_release(s, BUTTON_LEFT);
    session_frame(s);
    const struct model_rig *moved = &s->document->rigs[0]->model;
    assert_near(root[12], held[0], 1e-3);
    assert_near(root[14], held[1], 1e-3);
    assert_true(hypot(moved->position[0], moved->position[2]) > 0.1);
    assert_near(moved->position[1], 0, 0);
    assert_string_equal(selected_bone(s->editor), "");
    for (int frame = 0; frame < 1200; frame++) session_frame(s);
    assert_near(turned(s, "tail_8"), 0, 1e-6);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    session_pull(s, "bone(neck)", 0, 40, 4);
    session_key(s, KEY_ESCAPE, 0);
    session_release(s, BUTTON_LEFT);
    assert_saved(s, before);
}

/// Seen from the side both legs lie over each other: the near one is meant.
/// Alt+V: the clip alone stands beside it, and no chain bends that one.
SESSION_TEST(test_the_original_is_shown_beside_it, open_beast(s, TAIL))
{
    assert_done(edit_knot_insert(s->editor->core.document, 0, &(struct knot){.value = 2, .stiffness = 1}, &error));
    session_key(s, 'V', MOD_ALT);
    session_frame(s);
    const struct stage_view *view = editor_stage(s->editor);
    assert_int_equal(view->model_count, 2);
    const struct stage_model *beast = view->models;
    const int tip = gltf_find_node(beast[0].gltf, "tail_8"), hips = gltf_find_node(beast[0].gltf, "hips");
    assert_true(beast[1].root[12] > beast[0].root[12] + 0.5f);
    assert_memory_equal(beast[0].pose->world[hips], beast[1].pose->world[hips], sizeof *beast->pose->world);
    assert_true(fabsf(beast[0].pose->world[tip][12] - beast[1].pose->world[tip][12]) > 0.05f);
    session_key(s, 'V', MOD_ALT);
    session_frame(s);
    assert_int_equal(editor_stage(s->editor)->model_count, 1);
}

SESSION_TEST(test_of_bones_over_each_other_the_near_one_is_picked, open_beast(s, ""))
{
    const struct stage_view *view = editor_stage(s->editor);
    for (int turn = 0; turn < 16; turn++) {
        float left[2], right[2];
        struct error error;
        session_key(s, KEY_LEFT, MOD_CTRL | MOD_SHIFT);
        if (!editor_target(s->editor, "bone(leg_FL_1)", &left[0], &left[1], &error)) continue;
        if (!editor_target(s->editor, "bone(leg_FR_1)", &right[0], &right[1], &error)) continue;
        if (fabsf(left[0] - right[0]) > 2) continue;
        session_move(s, (left[0] + right[0]) / 2, (left[1] + right[1]) / 2);
        session_frame(s);
        session_click_here(s, 1);
        assert_string_equal(selected_bone(s->editor), view->eye[0] > 0 ? "leg_FL_1" : "leg_FR_1");
    }
    session_move(s, 2, 2);
}

SESSION_TEST(test_a_key_makes_a_chain_to_the_tip_in_one_step, open_beast(s, ""))
{
    const char *before = session_saved(s);
    session_key(s, 'J', 0);
    assert_saved(s, before);
    session_click(s, "bone(tail_3)");
    session_key(s, 'J', 0);
    assert_int_equal(s->document->rig_count, 2);
    const struct rig *made = s->document->rigs[1];
    assert_int_equal(made->kind, RIG_CHAIN);
    assert_string_equal(made->chain.from, "tail_3");
    assert_string_equal(made->chain.to, "tail_8");
    assert_true(made->chain.channel_count >= 1);
    assert_int_equal(active(s->editor), made->chain.channels[0].spline);
    assert_int_equal(shown_rig(s->editor), 1);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    assert_string_equal(selected_bone(s->editor), "tail_3");
    panel_click(s, "bone.chain");
    assert_int_equal(s->document->rig_count, 2);
}

SESSION_TEST(test_a_bone_that_branches_is_refused_with_a_sentence, open_beast(s, ""))
{
    const char *before = session_saved(s);
    session_click(s, "bone(head)");
    assert_string_equal(selected_bone(s->editor), "head");
    session_key(s, 'J', 0);
    assert_saved(s, before);
    assert_said_error(s->editor, "\"head\" branches into \"ear_L_1\" and \"ear_R_1\"");
}

/// The grabbed point follows the pointer, by a knot at the playhead; one step, and Esc takes it back.
SESSION_TEST(test_dragging_a_chain_sets_a_knot, open_beast(s, TAIL))
{
    const char *before = session_saved(s);
    float tip[2];
    session_pull(s, "chain(tail,0.95)", 0, -30, 12);
    for (int frame = 0; frame < 60; frame++) session_frame(s);
    const float x = s->x, y = s->y;
    session_release(s, BUTTON_LEFT);
    assert_int_equal(s->document->splines[0]->knot_count, 1);
    assert_done(editor_target(s->editor, "chain(tail,0.95)", &tip[0], &tip[1], &error));
    assert_true(hypotf(tip[0] - x, tip[1] - y) < 30); // one axis only: as near as it gets
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    session_pull(s, "chain(tail,0.8)", 25, 0, 6);
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, before);
    session_release(s, BUTTON_LEFT);
}

/// With an axis each way the point comes to the pointer itself.
SESSION_TEST(test_a_chain_of_two_axes_comes_to_the_pointer, open_beast(s, TAIL))
{
    float tip[2];
    session_click(s, "chain(tail,0.5)");
    panel_click(s, "splines.add");
    panel_click(s, "channel.add");
    panel_click(s, "axis.up");
    assert_int_equal(s->document->rigs[1]->chain.channels[1].axis, AXIS_UP);
    session_pull(s, "chain(tail,0.9)", 12, 18, 12);
    for (int frame = 0; frame < 60; frame++) session_frame(s);
    const float x = s->x, y = s->y;
    session_release(s, BUTTON_LEFT);
    assert_done(editor_target(s->editor, "chain(tail,0.9)", &tip[0], &tip[1], &error));
    assert_true(hypotf(tip[0] - x, tip[1] - y) < 1.5f);
}

SESSION_TEST(test_a_click_on_a_chain_selects_its_bone, open_beast(s, TAIL LEFT_EAR))
{
    const char *before = session_saved(s);
    session_click(s, "bone(tail_4)");
    assert_string_equal(selected_bone(s->editor), "tail_4");
    assert_saved(s, before);
}

SESSION_TEST(test_the_inspector_chooses_the_clip, open_beast(s, ""))
{
    const char *before = session_saved(s);
    panel_click(s, "model.clips.0");
    panel_click(s, "item.Nod");
    assert_string_equal(s->document->rigs[0]->model.clip, "Nod");
    panel_click(s, "model.loops");
    assert_int_equal(s->document->rigs[0]->model.repeat, REPEAT_ONCE);
    assert_non_null(strstr(session_saved(s), "\"repeat\": \"once\""));
    panel_click(s, "model.loops");
    assert_int_equal(s->document->rigs[0]->model.repeat, REPEAT_LOOP);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, 'Z', MOD_CTRL);
    assert_one_step(s, before);
    panel_click(s, "model.clips.0");
    panel_click(s, "item.none");
    assert_null(s->document->rigs[0]->model.clip);
    assert_saved(s, before);
    panel_enter(s, "model.scale", "2");
    panel_enter(s, "model.turn", "90");
    panel_enter(s, "model.x", "0.5");
    assert_near(s->document->rigs[0]->model.scale, 2, 0);
    assert_near(s->document->rigs[0]->model.turn, 90, 0);
    assert_near(s->document->rigs[0]->model.position[0], 0.5, 0);
}

/// Each move of the drag makes its edit anew, of the chain as it was at the press.
SESSION_TEST(test_a_chains_turn_is_dragged, open_beast(s, TAIL))
{
    const char *before = session_saved(s);
    char *from = strdup(s->document->rigs[1]->chain.from);
    panel_pull(s, "chain.turn", 40, 0, 6);
    assert_true(s->document->rigs[1]->chain.turn > 0);
    assert_string_equal(s->document->rigs[1]->chain.from, from);
    assert_one_step(s, before);
    free(from);
}

SESSION_TEST(test_a_chain_is_edited_in_the_inspector, open_beast(s, TAIL))
{
    const char *before = session_saved(s);
    panel_click(s, "axis.twist");
    assert_int_equal(s->document->rigs[1]->chain.channels[0].axis, AXIS_TWIST);
    panel_click(s, "chain.mirror");
    panel_enter(s, "chain.turn", "30");
    panel_enter(s, "gain", "11");
    panel_click(s, "tail.name");
    session_key(s, 'A', MOD_CTRL);
    panel_type(s, "brush");
    session_key(s, KEY_ENTER, 0);
    const struct rig *rig = s->document->rigs[1];
    assert_true(rig->chain.mirror);
    assert_near(rig->chain.turn, 30, 0);
    assert_near(rig->chain.channels[0].gain.value[0], 11, 0);
    assert_string_equal(rig->name, "brush");
    panel_click(s, "rig.delete");
    session_key(s, 'K', 0); // its spline stays
    assert_int_equal(s->document->rig_count, 1);
    for (int step = 0; step < 6; step++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, before);
}

static const struct angles *gain_of_tail(const struct session *s)
{
    return &s->document->rigs[1]->chain.channels[0].gain;
}

SESSION_TEST(test_a_gain_becomes_a_ramp_whose_points_move, open_beast(s, TAIL))
{
    const char *before = session_saved(s);
    panel_click(s, "gain.ramp");
    assert_int_equal(gain_of_tail(s)->form, ANGLES_RAMP);
    assert_int_equal(gain_of_tail(s)->count, 2);
    assert_near(gain_of_tail(s)->ramp[1].angle, 8, 0);
    const char *flat = session_saved(s);
    panel_pull(s, "gain.point.1", -40, -12, 4);
    assert_true(gain_of_tail(s)->ramp[1].angle > 8);
    assert_true(gain_of_tail(s)->ramp[1].at < 1);
    assert_one_step(s, flat);
    panel_press(s, "gain.point.0", 1);
    session_move(s, s->x + 60, s->y - 8);
    session_release(s, BUTTON_LEFT);
    session_move(s, s->x + 8, s->y + 16); // beside the line
    session_click_here(s, 2);
    assert_int_equal(gain_of_tail(s)->count, 3);
    panel_press(s, "gain.point.1", 1);
    session_release(s, BUTTON_LEFT);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(gain_of_tail(s)->count, 2);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(gain_of_tail(s)->count, 2); // a ramp needs them
    panel_click(s, "gain.ramp");                 // lit: back to one
    assert_int_equal(gain_of_tail(s)->form, ANGLES_ONE);
    for (int step = 0; step < 6; step++) session_key(s, 'Z', MOD_CTRL);
    assert_saved(s, before);
}

static double highest(const struct angles *ramp)
{
    double highest = 0;
    for (int i = 0; i < ramp->count; i++) highest = fmax(highest, ramp->ramp[i].angle);
    return highest;
}

SESSION_TEST(test_a_ramps_plot_is_as_high_as_its_points, open_beast(s, TAIL))
{
    panel_click(s, "gain.ramp");
    const double *scale = s->editor->inspector->ramp_scale[ANGLE_GAIN];
    panel_pull(s, "gain.point.0", 0, -30, 2);
    assert_true(gain_of_tail(s)->ramp[0].angle > 10);
    assert_near(scale[1], 1.2 * gain_of_tail(s)->ramp[0].angle, 1e-9);
    session_move(s, s->x + 60, s->y + 50);
    session_click_here(s, 2); // a point between
    panel_pull(s, "gain.point.2", 0, -80, 2);
    assert_int_equal(gain_of_tail(s)->count, 3);
    const double last = gain_of_tail(s)->ramp[2].angle;
    assert_near(scale[1], 1.2 * last, 1e-9);
    session_key(s, KEY_DELETE, 0); // the highest
    assert_int_equal(gain_of_tail(s)->count, 2);
    assert_true(highest(gain_of_tail(s)) < last);
    assert_near(scale[1], 1.2 * highest(gain_of_tail(s)), 1e-9);
}

SESSION_TEST(test_a_chain_gets_a_twin_on_the_other_side, open_beast(s, LEFT_EAR))
{
    panel_enter(s, "chain.turn", "30");
    const char *before = session_saved(s);
    assert_null(missing(s->editor, NEEDS_TWIN));
    panel_click(s, "chain.twin");
    assert_int_equal(s->document->rig_count, 3);
    const struct rig *twin = s->document->rigs[2];
    assert_string_equal(twin->name, "ear_R");
    assert_string_equal(twin->chain.from, "ear_R_1");
    assert_string_equal(twin->chain.to, "ear_R_2");
    assert_true(twin->chain.mirror);
    assert_near(twin->chain.turn, -30, 0); // turned the other way round, as in a mirror
    assert_int_equal(twin->chain.channels[0].spline, s->document->rigs[1]->chain.channels[0].spline);
    assert_false(panel_shows(s, "chain.twin")); // there is one now
    assert_non_null(missing(s->editor, NEEDS_TWIN));
    assert_one_step(s, before);
}

/// Sections come below, without scrolling.
SESSION_TEST(test_a_clicked_chain_leaves_its_feel_in_sight, open_beast(s, LEFT_EAR))
{
    editor_resize(s->editor, 1280, 720, 1);
    show_more(s->editor, false);
    session_frame(s);
    session_click(s, "bone(ear_L_2)");
    session_frame(s);
    assert_string_equal(selected_bone(s->editor), "ear_L_2");
    assert_near(sections(s->editor)->offset, 0, 0);
}

SESSION_TEST(test_a_tail_has_no_twin, open_beast(s, TAIL))
{
    assert_true(panel_shows(s, "rig.delete"));
    assert_false(panel_shows(s, "chain.twin"));
    assert_non_null(missing(s->editor, NEEDS_TWIN));
}

TESTS_BETWEEN(folder_make, folder_remove)

/// Its tail and ears are met at three quarters from behind, whichever way it faces; what has no tail and stands upright, from the front.
SESSION_TEST(test_a_beast_is_met_from_behind, open_beast(s, ""))
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
