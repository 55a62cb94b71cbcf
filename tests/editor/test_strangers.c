/// A stranger's rig on the stage: controls, poles and leaves between the bones that vertices follow; and models without bones.
#include "gltf_builder.h"
#include "panel_session.h"

#include "editor/core/rigs.h"
#include "editor/stage/state.h"

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
    char scene[1024];
    builder = (struct builder){0};
    write(&builder);
    snprintf(
        scene, sizeof scene,
        "{\"wiggly\": 1, \"fps\": 24, \"frames\": [0, 24], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, "
        "\"damping\": 0.1, \"knots\": []}], \"rigs\": [{\"type\": \"model\", \"name\": \"it\", \"model\": \"%s\"}]}",
        temporary_path("model.gltf"));
    panel_open_models(s, scene);
    s->editor->core.view.refit_stage = true;
    session_move(s, 2, 2);
    session_frame(s);
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
    const float *a = model->pose->world[gltf_find_node(model->gltf, from)] + 12;
    const float *b = model->pose->world[gltf_find_node(model->gltf, to)] + 12;
    float at[3];
    for (int k = 0; k < 3; k++) at[k] = model->root[12 + k] + a[k] + (b[k] - a[k]) * share;
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

SESSION_TEST(test_bones_that_carry_nothing_show_with_alt, open_written(s, write_rig))
{
    static const char *const controls[] = {"knee_pole", "foot_ik", "spline_ik", "ear_L_end"};
    static const char *const others[] = {"root", "hips", "head", "ear_L_1", "ear_L_2", "foot"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) assert_true(shows(s, others[i]));
    for (int alt = 0; alt < 2; alt++) {
        s->mods = alt ? MOD_ALT : 0;
        move_between(s, "root", "foot_ik", 1);
        for (size_t i = 0; i < sizeof controls / sizeof *controls; i++) assert_int_equal(shows(s, controls[i]), alt);
        session_click_here(s, 1);
        assert_string_equal(selected_bone(s->editor), alt ? "foot_ik" : "");
    }
}

/// All along the link from a branching bone; the bone itself goes on as the one before it.
SESSION_TEST(test_a_press_takes_the_bone_whose_part_is_drawn_there, open_written(s, write_rig))
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
        assert_string_equal(selected_bone(s->editor), presses[i].bone);
    }
}

/// Neither the ring in the ear nor its leaf is a branch, or part of the chain.
SESSION_TEST(test_hover_names_the_chain_that_the_key_makes, open_written(s, write_rig))
{
    session_hover(s, "bone(ear_L_1)");
    assert_true(session_shows(s, "ear_L_1 to ear_L_2, 2 bones"));
    session_hover(s, "bone(head)");
    assert_true(session_shows(s, "head"));
    session_click(s, "bone(ear_L_1)");
    session_key(s, 'J', 0);
    assert_string_equal(s->document->rigs[1]->chain.from, "ear_L_1");
    assert_string_equal(s->document->rigs[1]->chain.to, "ear_L_2");
}

SESSION_TEST(test_joints_count_once_and_cast_shadows_if_vertices_follow, open_written(s, write_rig))
{
    assert_int_equal(s->editor->stage->view.blob_count, 2); // the whole, and the foot
    assert_int_equal(bones_character(&s->editor->core, 0)->skeleton.own, JOINTS);
}

static float size_of_ear(const struct session *s)
{
    float a[2], b[2];
    between(s, "ear_L_1", "ear_L_2", 0, a);
    between(s, "ear_L_1", "ear_L_2", 1, b);
    return hypotf(a[0] - b[0], a[1] - b[1]);
}

SESSION_TEST(test_f_frames_the_selection_and_still_holds_frequency, open_written(s, write_rig))
{
    session_click(s, "bone(ear_L_1)");
    const float before = size_of_ear(s), height = layout_of(s->editor)->stage.h;
    session_hold(s, 'F', ACTION_PRESS);
    session_key(s, KEY_UP, 0);
    session_hold(s, 'F', ACTION_RELEASE);
    session_frame(s);
    assert_near(size_of_ear(s), before, 1e-3);
    assert_true(s->document->splines[0]->parameter[PARAMETER_FREQUENCY].value > 1);
    session_key(s, 'F', 0);
    assert_true(size_of_ear(s) > 0.3f * height);
    const float framed = size_of_ear(s);
    session_move(s, 2, layout_of(s->editor)->plot.y + 20);
    session_key(s, KEY_HOME, MOD_SHIFT);
    session_key(s, 'F', 0); // not over the curves
    assert_true(size_of_ear(s) < 0.5f * framed);
}

SESSION_TEST(test_the_wheel_zooms_to_the_pointer, open_written(s, write_rig))
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
    assert_false(session_shows(s, "Click a bone, then press Shift+J to let it swing. F1 shows all keys"));
    assert_true(session_shows(s, "It has no bones to bend. A adds a tail or a character, F1 shows all keys"));
}
