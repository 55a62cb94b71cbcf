/// Chains: bones of characters, whatever their rolls, bend as the tail does, and two by one spline as mirror images; and they are made
/// with names, splines and channels that suit the character, motion that follows its clip, and one step to undo.
#include "beast.h"
#include "model/vector.h"
#include "posed_tail.h"
#include "rig/strand.h"
#include "stand.h"

/// A file with a triangle of some height (0: none) that node 0 shows, and these nodes.
static const char *write_nodes(double height, const char *nodes)
{
    static struct builder b;
    static char members[1 << 14];
    const float tall = (float)height;
    b = (struct builder){0};
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 0, tall, 0, 0.1f * tall, 0, 0);
    snprintf(members, sizeof members, "%s'nodes':[%s],'scenes':[{'nodes':[0,1]}]",
             height > 0 ? "'meshes':[{'primitives':[{'attributes':{'POSITION':0}}]}]," : "", nodes);
    return write_built(&b, "nodes.gltf", members);
}

static int add_chain(struct opened *opened, struct chain_wish wish)
{
    int rig;
    assert_done(chain_make(opened->document, opened->models, &wish, &rig, &error));
    return rig;
}

/// What moves one rig, and nothing else.
struct moved {
    int rig;
    struct by_hand hand;
};

static void move_one(const void *context, int rig, struct by_hand *hand)
{
    const struct moved *moved = context;
    if (rig == moved->rig) *hand = moved->hand;
}

/// Where a chain's joints and its tip are with these values. They are as far as the picture's bones go.
static void bend(const struct opened *opened, int rig, enum look look, const wiggly_value values[2],
                 struct pose *bent)
{
    struct moved moved = {rig, {.input = {values[0], values[1]}}};
    const struct posing posing = {
        .document = opened->document, .models = opened->models, .look = look, .move = move_one, .context = &moved};
    struct rig_pose chain, body;
    assert_true(rig_pose(&posing, rig, 0, &chain));
    assert_true(rig_pose_body(&posing, rig_body(opened->document, rig), 0, &body));
    const struct chain *of = &opened->document->rigs[rig]->chain;
    struct chain_bones bones;
    assert_done(chain_find(&body.imported->gltf, of->from, of->to, &bones, &error));
    assert_int_equal(chain.strand.count, bones.count + 1);
    for (int n = 0; n < bones.count; n++) {
        mat4s shown;
        mat4s root = mat4_from(body.model.root), bone = mat4_from(body.model.pose->world[bones.node[n]]);
        glm_mat4_mul(root.raw, bone.raw, shown.raw);
        for (int k = 0; k < 16; k++) assert_near(shown.raw[k / 4][k % 4], chain.strand.matrix[n][k], 4e-6);
    }
    *bent = chain.strand;
}

// --- a straight chain whose bones have rolls of their own

enum { BONES = 8 };

/// A chain along +z from (0, 1, 0) under a root that is turned; and a second child of bone 3.
static void open_rolled(struct opened *opened)
{
    static char nodes[8192];
    char *end = stpcpy(nodes, "{'mesh':0}");
    versors before = glms_quat_identity();
    for (int n = 0; n < BONES + 3; n++) { // root, bones, tip, spur
        const bool is_spur = n == BONES + 2;
        const versors after =
            n == 0 ? glms_quatv(0.4f, (vec3s){.raw = {0.3f, 1, 0.2f}})
                   : glms_quatv(1.7f * (float)n, glms_vec3_normalize((vec3s){.raw = {1, 0.3f * (float)n, -0.7f}}));
        const versors back = glms_quat_inv(before), turn = glms_quat_mul(back, after);
        const vec3s step = {.raw = {0, n == 1, n > 1 ? 0.1f : 0}}, move = glms_quat_rotatev(back, step);
        end += sprintf(end, ",{'name':'%s%.0d','rotation':[%.9g,%.9g,%.9g,%.9g],'translation':[%.9g,%.9g,%.9g]",
                       n == 0    ? "root"
                       : is_spur ? "spur"
                                 : "bone_",
                       is_spur ? 0 : n, (double)turn.x, (double)turn.y, (double)turn.z, (double)turn.w,
                       (double)move.x, (double)move.y, (double)move.z);
        if (n <= BONES) end += sprintf(end, n == 3 ? ",'children':[%d,%d]" : ",'children':[%d]", n + 2, BONES + 3);
        end = stpcpy(end, "}");
        before = after;
    }
    assert_done(opened_read(opened, write_nodes(1, nodes), &error));
    add_chain(opened, (struct chain_wish){.from = "bone_1", .to = "bone_8"});
    struct chain *chain = &opened->document->rigs[1]->chain;
    for (int c = 0; c < 2; c++) chain->channels[c].lag.value[0] = 20;
    for (int c = 0; c < 2; c++) chain->channels[c].gain.value[0] = c == 0 ? 9 : 6;
}

#define ROLLED_TEST(name) TEST_OF(struct opened, opened, open_rolled(opened), opened_free(opened), name)

ROLLED_TEST(it_bends_as_the_tail_does)
{
    const wiggly_value values[] = {{.y = 0.2, .re = 1, .im = -0.5}, {.re = -0.7, .im = 0.9}};
    const struct chain *chain = &opened->document->rigs[1]->chain;
    struct tail tail = {.joints = BONES, .length = 0.8, .channels = chain->channels, .channel_count = 2};
    struct pose bent, expected;
    for (int k = 0; k < 3; k++) tail.position[k] = param_number(k == 1);
    for (enum look look = LOOK_WIGGLY; look <= LOOK_STIFF; look++) {
        bend(opened, 1, look, values, &bent);
        pose_tail(&tail, values, look, &expected);
        assert_int_equal(bent.count, expected.count);
        for (int n = 0; n <= BONES; n++)
            for (int k = 12; k < 15; k++) assert_near(bent.matrix[n][k], expected.matrix[n][k], 2e-6);
        assert_true(fabsf(bent.matrix[BONES][12]) > 0.1f);
    }
}

/// A chain below nodes that stretch, shear, mirror or turn: `bend` holds the picture to the points that the chain reports.
TEST(chains_below_any_node)
{
    static const char *const above[] = {"'scale':[1,2,1]", "'scale':[-1,1,1]",
                                        "'scale':[2,2,2],'rotation':[0.6,0,0,0.8]",
                                        "'matrix':[1,0,0,0,1,1,0,0,0,0,1,0,4,5,6,1]", "'translation':[1,2,3]"};
    for (size_t i = 0; i < sizeof above / sizeof *above; i++) {
        const wiggly_value values[] = {{.y = 0.4, .re = 0.2}, {.re = -0.3}};
        char nodes[512];
        struct opened opened;
        struct pose bent;
        snprintf(
            nodes, sizeof nodes,
            "{'mesh':0},{'name':'above',%s,'children':[2]},{'name':'b','translation':[0,0.1,0.3],'children':[3]},"
            "{'name':'c','translation':[0,0,0.3],'children':[4]},{'name':'d','translation':[0.1,0,0.2]}",
            above[i]);
        assert_done(opened_read(&opened, write_nodes(1, nodes), &error));
        struct model_rig *model = &opened.document->rigs[0]->model;
        model->turn = 70;
        model->scale = 3;
        memcpy(model->position, (const double[]){0.5, 0.25, -1}, sizeof model->position);
        bend(&opened, add_chain(&opened, (struct chain_wish){.from = "b", .to = "c"}), LOOK_WIGGLY, values, &bent);
        opened_free(&opened);
    }
}

/// The tip, by one of the side's spline: 2 stands for as far as the plain one goes.
ROLLED_TEST(axes_turn_and_mirror)
{
    static const struct {
        enum axis axis;
        bool mirror;
        double turn, tip[2]; ///< x, and y above the root
    } rows[] = {
        {AXIS_SIDE, false, 0, {2, 0}}, {AXIS_SIDE, true, 0, {-2, 0}},    {AXIS_UP, false, 0, {0, 2}},
        {AXIS_UP, true, 0, {0, 2}},    {AXIS_TWIST, false, 0, {0, 0}},   {AXIS_SIDE, false, 90, {0, 2}},
        {AXIS_UP, false, 90, {-2, 0}}, {AXIS_SIDE, false, -90, {0, -2}}, // a quarter turn about +z takes x to y, y to −x
    };
    const wiggly_value value[2] = {{.re = 1}, {.re = 0}};
    struct chain *chain = &opened->document->rigs[1]->chain;
    struct pose bent;
    bend(opened, 1, LOOK_WIGGLY, value, &bent);
    const double plain = (double)bent.matrix[BONES][12];
    assert_true(plain > 0.1);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        chain->channels[0].axis = rows[r].axis;
        chain->mirror = rows[r].mirror;
        chain->turn = rows[r].turn;
        bend(opened, 1, LOOK_WIGGLY, value, &bent);
        assert_near(bent.matrix[BONES][12], plain / 2 * rows[r].tip[0], 2e-6);
        assert_near(bent.matrix[BONES][13] - 1, plain / 2 * rows[r].tip[1], 2e-6);
    }
}

// --- ears

/// Two ears of a head. It looks along x, and its left is −z, or along z, its left being x.
struct pair {
    struct opened opened;
    bool looks_along_x;
    int rig[2];
};

/// Of the left ear; the right one points as its mirror image does, but for `crooked` of the way up.
struct ear {
    float way[3], crooked;
};

static void set_way(const struct pair *pair, const struct ear *ear, int side, float scale, float out[3])
{
    const float x = (side ? -scale : scale) * ear->way[0], z = scale * ear->way[2];
    out[0] = pair->looks_along_x ? z : x;
    out[1] = scale * (ear->way[1] + (side ? ear->crooked : 0.0f));
    out[2] = pair->looks_along_x ? -x : z;
}

enum { EAR_BONES = 3 };

/// Three bones to each ear. Their frames are alike, x up, y along z, not mirrored.
static void open_pair(struct pair *pair, const struct ear *ear, bool follows)
{
    static const struct ear root = {{0.07f, 1, 0}, 0};
    char text[4096], *end = stpcpy(text, "{'mesh':0},{'name':'head','children':[2,5]}");
    for (int side = 0; side < 2; side++) {
        float at[3], turned[3];
        set_way(pair, &root, side, 1, at);
        for (int n = 0; n < EAR_BONES; n++) {
            end += sprintf(end, ",{'name':'Ear%d.%c','translation':[%.9g,%.9g,%.9g]", n + 1, "LR"[side],
                           (double)at[0], (double)at[1], (double)at[2]);
            if (n == 0) end += sprintf(end, ",'rotation':[0.5,0.5,0.5,0.5]");
            end += sprintf(end, n + 1 < EAR_BONES ? ",'children':[%d]}" : "}", 3 + EAR_BONES * side + n);
            set_way(pair, ear, side, 0.1f, turned);
            for (int k = 0; k < 3; k++) at[k] = turned[(k + 1) % 3];
        }
    }
    assert_done(opened_read(&pair->opened, write_nodes(1, text), &error));
    for (int side = 0; side < 2; side++)
        pair->rig[side] =
            add_chain(&pair->opened, (struct chain_wish){.from = side ? "Ear1.R" : "Ear1.L", .follows = follows});
}

static void check_mirrored(const struct pair *pair, double side, double up, double tolerance)
{
    const wiggly_value values[2] = {{.re = side}, {.re = up}}, none[2] = {{.re = 0}, {.re = 0}};
    double moved[2][3], size = 0;
    for (int s = 0; s < 2; s++) {
        struct pose rest, bent;
        bend(&pair->opened, pair->rig[s], LOOK_WIGGLY, none, &rest);
        bend(&pair->opened, pair->rig[s], LOOK_WIGGLY, values, &bent);
        for (int k = 0; k < 3; k++)
            moved[s][k] = (double)(bent.matrix[EAR_BONES][12 + k] - rest.matrix[EAR_BONES][12 + k]);
    }
    for (int k = 0; k < 3; k++) {
        const bool is_across = k == (pair->looks_along_x ? 2 : 0);
        assert_near(moved[1][k], is_across ? -moved[0][k] : moved[0][k], tolerance);
        size += fabs(moved[0][k]);
    }
    assert_true(size > 0.02);
}

TEST(ears_that_share_a_spline_mirror)
{
    static const struct ear ears[] = {
        {{0.1f, 1, 0}, 0},         // they stand
        {{0.5f, 0.7f, -0.4f}, 0},  // out, up and back
        {{1, 0, 0}, 0},            // out
        {{0.3f, -1, 0.1f}, 0},     // they droop
        {{0.1f, 0, -1}, 0},        // back
        {{0.2031f, 1, 0}, 0.002f}, // nearly the same: one stands less than what counts as upright, the other more
    };
    for (size_t e = 0; e < sizeof ears / sizeof *ears; e++) {
        for (int way = 0; way < 4; way++) {
            struct pair pair = {.looks_along_x = way & 1};
            open_pair(&pair, &ears[e], way & 2);
            const double unit = way & 2 ? 0.05 : 1, tolerance = ears[e].crooked > 0 ? 1e-3 : 1e-6; // metres, or 1
            check_mirrored(&pair, unit, 0, tolerance);
            check_mirrored(&pair, 0, unit, tolerance);
            check_mirrored(&pair, unit, -unit, tolerance);
            opened_free(&pair.opened);
        }
    }
}

TEST(sides_of_names)
{
    static const char *const pairs[][2] = {{"ear_1_L", "ear_1_R"},
                                           {"mixamorig:LeftHand", "mixamorig:RightHand"},
                                           {"arm.l.002", "arm.r.002"},
                                           {"R_wing", "L_wing"},
                                           {"EarL", "EarR"},
                                           {"hairR2", "hairL2"},
                                           {"LEFT", "RIGHT"},
                                           {"my left", "my right"},
                                           {"l", "r"},
                                           {"aL.b", "aR.b"}};
    static const char *const none[] = {"tail_1", "Roll", "earl", "EARL", "", "lid", "xl"};
    char other[BONE_NAME_SIZE], longest[BONE_NAME_SIZE + 2];
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        for (int side = 0; side < 2; side++) {
            assert_true(bone_other_side(pairs[i][side], other));
            assert_string_equal(other, pairs[i][!side]);
        }
    }
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        if (bone_other_side(none[i], other)) fail_msg("%s became %s", none[i], other);
    for (int length = BONE_NAME_SIZE - 2; length <= BONE_NAME_SIZE; length++) { // the other name must have room
        memset(longest, '_', sizeof longest);
        strcpy(longest + length - 1, "L");
        assert_int_equal(bone_other_side(longest, other), length < BONE_NAME_SIZE);
        strcpy(longest + length - 4, "Left");
        assert_int_equal(bone_other_side(longest, other), length + 1 < BONE_NAME_SIZE);
    }
}

// --- bones as they are seen and clicked

/// All parts of bones, each as where it begins, > or (of a link beside a main child) /, and where it ends, in a bone or a tip; ~ behind those
/// that are hidden. And where the back is.
static const char *print_bones(const struct imported *imported)
{
    static char text[4096];
    char *end = strcpy(text, "");
    float back[2];
    for (int b = 0; b < imported->skeleton.count; b++) {
        const struct bone *bone = &imported->skeleton.bones[b];
        const struct gltf_node *nodes = imported->gltf.nodes;
        float ends[2][3];
        skeleton_ends(bone, &imported->rest, ends);
        end += sprintf(end, "%s%s%s", b ? " " : "", nodes[bone->from].name, b < imported->skeleton.own ? ">" : "/");
        if (bone->child >= 0)
            end += sprintf(end, "%s", nodes[bone->child].name);
        else
            end += sprintf(end, "%.3g,%.3g,%.3g", (double)(ends[1][0] - ends[0][0]),
                           (double)(ends[1][1] - ends[0][1]), (double)(ends[1][2] - ends[0][2]));
        if (bone->hidden) end = stpcpy(end, "~");
    }
    if (imported_back(imported, back)) sprintf(end, " back %.2g %.2g", (double)back[0], (double)back[1]);
    return text;
}

#define ROOT "{'name':'a','children':[1]}"
#define BONE(name, at, more) ",{'name':'" name "','translation':[" at "]" more "}"
#define FORK(one, two) ROOT BONE("b", "0,1,0", ",'children':[2]") BONE("c", "0,1,0", ",'children':[3,4]") one two

TEST(bones_as_they_are_seen)
{
    static const struct {
        double height;
        const char *nodes, *bones;
    } rows[] = {
        {0, "{}" BONE("b", "9,9,9", ",'children':[2]") BONE("c", "0,2,0", ",'children':[3]") BONE("d", "0,1,0", ""),
         "c>d d>0,1,0"},
        {0,
         ROOT BONE("b", "0,1,0", ",'scale':[2,2,2],'children':[2]")
             BONE("c", "0,1,0", ",'rotation':[0,0,0.6,0.8],'children':[3]") BONE("d", "0,1,0", ""),
         "b>c c>d d>-1.92,0.56,0"},
        // of several children the one that goes straight on, within a cosine of 0.8; the others are linked, and all are short
        {0, FORK(BONE("d", "0.5,1,0", ""), BONE("e", "-0.8,1,0", "")), "b>c c>d d>0.2,0.4,0 e>-0.32,0.4,0 c/e"},
        {0, FORK(BONE("d", "0.5,1,0", ""), BONE("e", "-0.1,1,0", "")), "b>c c>e d>0.2,0.4,0 e>-0.04,0.4,0 c/d"},
        {0, FORK(BONE("d", "0.8,1,0", ""), BONE("e", "-0.8,1,0", "")),
         "b>c c>0,1,0 d>0.32,0.4,0 e>-0.32,0.4,0 c/d c/e"},
        // a single mesh is no skeleton; of two, what carries none is hidden, and no way on
        {1, "{'mesh':0},{'name':'a','children':[2]},{'name':'b'}", ""},
        {1,
         "{'mesh':0},{'name':'a','children':[2]}" BONE("b", "0,1,0", ",'children':[3,4,5]")
             BONE("c", "1,0,0", ",'mesh':0") BONE("d", "0,1,0", "") BONE("e", "-1,0,0", ",'children':[6]")
                 BONE("f", "-1,0,0", ""),
         "b>c c>0.4,0,0 d>0,0.4,0~ e>f~ f>-1,0,0~ b/d~ b/e~"},
        // joints of skins are bones; a mesh without one is carried by the bone above it; what is longer than wide has a back
        {1,
         "{'mesh':0},{'name':'a','children':[2,3]}" BONE("b", "0,1,0", "")
             BONE("c", "0,1,0", "") "],'skins':[{'joints':[1,2]}",
         "a>b~ b>0,1,0~"},
        {1,
         "{'mesh':0,'rotation':[0,0.6,0,0.8]},{'name':'a','children':[2]}" BONE("b", "0,1,0", ",'children':[3]")
             BONE("c", "0,0,0", ",'mesh':0,'rotation':[0,0.6,0,0.8]") "],'skins':[{'joints':[1,2]}",
         "a>b b>0,1,0 back 0 -1"},
        // the back is where the tail's end is that is farthest from the middle, unless that is in the middle
        {1, "{'mesh':0}" BONE("Tail", "0,0,-2", "") "],'skins':[{'joints':[1]}", "Tail>0,0.1,0~ back -0.05 -2"},
        {1, "{'mesh':0,'rotation':[0,0.6,0,0.8]}" BONE("tail", "0.014,0,-0.05", "") "],'skins':[{'joints':[1]}",
         "tail>0,0.1,0~ back 0 -1"},
        {1,
         "{'mesh':0},{'name':'a','children':[2]}" BONE("My_Tail", "0,1,-1", ",'children':[3]")
             BONE("tail 2", "0,0,-1", ",'children':[4]") BONE("hair", "0,0,-1", ",'children':[5]")
                 BONE("tail 3", "0,0,2.9", ",'children':[6]")
                     BONE("tail 4", "0,0,2", "") "],'skins':[{'joints':[1,2,3,4,5,6]}",
         "a>My_Tail~ My_Tail>tail 2~ tail 2>hair~ hair>tail 3~ tail 3>tail 4~ tail 4>0,0,2~ back -0.05 3.9"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct imported imported;
        assert_done(imported_read(&imported, write_nodes(rows[r].height, rows[r].nodes), &error));
        if (strcmp(print_bones(&imported), rows[r].bones) != 0)
            fail_msg("%s\n   has %s\nexpected %s", rows[r].nodes, print_bones(&imported), rows[r].bones);
        imported_free(&imported);
    }
    struct imported beast;
    assert_true(beast_write(temporary_path("beast.glb")));
    assert_done(imported_read(&beast, temporary_path("beast.glb"), &error));
    assert_string_equal(
        print_bones(&beast),
        "hips>tail_1 spine>neck neck>head head>0,0.17,0.12 ear_L_1>ear_L_2 ear_L_2>0.02,0.09,0 ear_R_1>ear_R_2 "
        "ear_R_2>-0.02,0.09,0 leg_FL_1>leg_FL_2 leg_FL_2>0,-0.26,0 leg_FR_1>leg_FR_2 leg_FR_2>0,-0.26,0 "
        "leg_BL_1>leg_BL_2 leg_BL_2>0,-0.26,0 leg_BR_1>leg_BR_2 leg_BR_2>0,-0.26,0 jaw>0,-0.02,0.024 tail_1>tail_2 "
        "tail_2>tail_3 tail_3>tail_4 tail_4>tail_5 tail_5>tail_6 tail_6>tail_7 tail_7>tail_8 tail_8>0,0.03,-0.08 "
        "hips/spine hips/leg_BL_1 hips/leg_BR_1 spine/leg_FL_1 spine/leg_FR_1 head/ear_L_1 head/ear_R_1 head/jaw "
        "back 0 -0.81");
    imported_free(&beast);
}

/// Which bones make a chain, and what is said of those that do not: names of the first and the last, which may be left to be found.
ROLLED_TEST(bones_of_a_chain)
{
    static const struct {
        const char *from, *to, *says; ///< or how many there are
    } rows[] = {
        {"bone_4", "bone_6", "3"},
        {"bone_4", NULL, "6"},
        {"bone_8", "bone_8", "1"},
        {"bone_4", "bone_2", "nodes.gltf: expected \"bone_2\" below \"bone_4\", got it elsewhere"},
        {"bone_4", "ear", "nodes.gltf: expected a bone called \"ear\", got none"},
        {"ear", "bone_4", "nodes.gltf: expected a bone called \"ear\", got none"},
        {"ear", NULL, "nodes.gltf: expected a bone called \"ear\", got none"},
        {"bone_1", NULL,
         "\"bone_3\" branches into \"bone_4\" and \"spur\": choose the bone where the chain begins or ends"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const struct chain_wish wish = {.from = rows[r].from, .to = rows[r].to};
        struct error refusal = {0};
        int rig;
        if (chain_make(opened->document, opened->models, &wish, &rig, &refusal)) {
            struct strand strand;
            assert_true(strand_find(&(struct posing){.document = opened->document, .models = opened->models}, 0, rig,
                                    &strand));
            snprintf(refusal.text, sizeof refusal.text, "%d", strand.joints);
        }
        if (!strstr(refusal.text, rows[r].says))
            fail_msg("%s to %s: '%s' lacks '%s'", rows[r].from, rows[r].to ? rows[r].to : "its end", refusal.text,
                     rows[r].says);
    }
}

/// A row of bones, one of which a matrix may shear: a chain of 256 is the longest.
TEST(long_and_sheared_chains)
{
    enum { MOST = ANGLES_MAX_JOINTS };
    static const struct {
        int bones, sheared;
        const char *to, *says;
    } rows[] = {
        {MOST, 0, NULL, NULL},
        {MOST, 0, "b256", NULL},
        {MOST + 1, 0, NULL, "below \"b1\" there are more than 256 bones: choose the one where the chain ends"},
        {MOST + 1, 0, "b257", "expected at most 256 bones from \"b1\" to \"b257\", got more"},
        {9, 5, NULL, "expected a bone that can turn, got \"b5\", which a matrix shears or flattens"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        static char nodes[1 << 15];
        struct opened opened;
        char *end = stpcpy(nodes, "{'mesh':0}");
        for (int n = 1; n <= rows[r].bones; n++) {
            end += sprintf(end, ",{'name':'b%d',", n);
            end = stpcpy(end, n == rows[r].sheared ? "'matrix':[1,0,0,0,1,1,0,0,0,0,1,0,0,1,0,1]"
                                                   : "'translation':[0,1,0]");
            end += sprintf(end, n < rows[r].bones ? ",'children':[%d]}" : "}", n + 1);
        }
        assert_done(opened_read(&opened, write_nodes(1, nodes), &error));
        const struct chain_wish wish = {.from = "b1", .to = rows[r].to};
        int rig;
        if (rows[r].says)
            assert_refusal(chain_make(opened.document, opened.models, &wish, &rig, &error), rows[r].says);
        else
            assert_done(chain_make(opened.document, opened.models, &wish, &rig, &error));
        opened_free(&opened);
    }
}

ROLLED_TEST(a_model_that_could_not_be_read_has_no_bones)
{
    struct models *none = models_create();
    const struct chain_wish wish = {.from = "bone_4"};
    int rig;
    assert_refusal(chain_make(opened->document, none, &wish, &rig, &error), "could not be read, so it has no bones");
    models_destroy(none);
}

// --- characters become scenes, and their bones chains

static const char dog[] = "assets/models/dog.glb";

TEST(a_character_opens_as_a_scene)
{
    struct document *document;
    assert_done(document = import_scene(dog, &error));
    assert_null(document->path); // saving must not write over the character
    assert_int_equal(document->rig_count, 1);
    assert_string_equal(document->rigs[0]->name, "dog");
    assert_string_equal(document->rigs[0]->model.clip, "Walk");
    assert_near(document->fps, 24, 0);
    assert_int_equal(document->last_frame, 24);
    document_destroy(document);
    assert_refusal(import_scene("assets/models/no.glb", &error), "assets/models/no.glb");
}

/// One in centimetres, or as small as a thumb, comes about as tall as others, by a number that one would write; the rest stay.
TEST(a_character_of_any_size_fits_the_stage)
{
    static const struct {
        double height, scale;
    } rows[] = {{180, 0.009}, {0.016, 100}, {0.29, 6}, {0.31, 1}, {0.5, 1}, {3, 1}, {3.9, 1}, {4.1, 0.4}, {5, 0.3}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct document *document;
        assert_done(document = import_scene(write_nodes(rows[r].height, "{'mesh':0},{}"), &error));
        assert_near(document->rigs[0]->model.scale, rows[r].scale, 1e-9);
        document_destroy(document);
    }
}

/// Bones that lie at one place make no chain, at any scale; short ones of a small character do. A single bone without a child bends sensibly.
TEST(bones_at_one_place)
{
    static const struct {
        double height, step;
        bool is_chain;
    } rows[] = {{1, 0, false},  {1, 1e-6, false},   {1, 3e-4, false},  {1, 0.01, true},
                {100, 1, true}, {100, 0.03, false}, {1e-3, 1e-5, true}};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        char nodes[400];
        struct opened opened;
        struct error refusal = {0};
        int rig;
        snprintf(nodes, sizeof nodes,
                 "{'mesh':0},{'name':'a','children':[2]},{'name':'b','translation':[0,%g,0],'children':[3]},"
                 "{'name':'c','translation':[0,0,%g]}",
                 rows[r].step, rows[r].step);
        assert_done(opened_read(&opened, write_nodes(rows[r].height, nodes), &error));
        const struct chain_wish wish = {.from = "a", .to = "c", .follows = true};
        assert_int_equal(chain_make(opened.document, opened.models, &wish, &rig, &refusal), rows[r].is_chain);
        if (!rows[r].is_chain) assert_non_null(strstr(refusal.text, "the bones \"a\" to \"c\" lie at one place"));
        const double tall = rows[r].height * opened.document->rigs[0]->model.scale;
        rig = add_chain(&opened, (struct chain_wish){.from = "c", .to = "c", .follows = true});
        assert_true(opened.document->rigs[rig]->chain.channels[0].gain.value[0] * tall < 3000); // degrees
        opened_free(&opened);
    }
}

/// Of the dog's own scene, in a step that is open.
#define DOG_TEST(name) STAND_TEST(name, (stand_open(stand, dog), stand_begin(stand)))

/// Splines that follow the clip go with it, and loop if it does; knots and pins keep their frames.
DOG_TEST(a_chosen_clip_gives_the_scene_its_length)
{
    enum then { NOTHING, ADD_CHAIN, ADD_KNOT, REMOVE_KNOT, ADD_PIN, REMOVE_PIN, FOLLOW_NOTHING };
    static const struct {
        const char *clip;
        int last_frame;
        enum then then; ///< before the next row
    } rows[] = {{"Trot", 14, ADD_CHAIN}, {"Idle", 120, ADD_KNOT},  {"Trot", 120, REMOVE_KNOT},
                {"Trot", 14, ADD_PIN},   {"Walk", 14, REMOVE_PIN}, {"Walk", 24, FOLLOW_NOTHING},
                {"Trot", 24, NOTHING}};
    const struct knot knot = {.frame = 12, .value = 1, .stiffness = 1};
    const struct pin pin = {.frame = 3, .point = 7};
    const struct param none = param_number(0);
    struct document *document = stand->opened.document;
    const struct gltf *gltf = &models_imported(stand->opened.models, document, 0)->gltf;
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const enum then then = rows[r].then;
        assert_done(import_choose_clip(document, 0, gltf, rows[r].clip, REPEAT_BY_CLIP, &error));
        assert_string_equal(document->rigs[0]->model.clip, rows[r].clip);
        if (document->last_frame != rows[r].last_frame)
            fail_msg("row %zu, %s: %d frames", r, rows[r].clip, document->last_frame);
        if (then == ADD_CHAIN) add_chain(&stand->opened, (struct chain_wish){.from = "tail_1", .follows = true});
        assert_int_equal(spline_start(document->splines[0]), WIGGLY_LOOP);
        if (then == ADD_KNOT) assert_done(edit_knot_insert(document, 1, &knot, &error));
        if (then == REMOVE_KNOT)
            assert_done(edit_knot_remove(document, 1, document->splines[1]->knots[0].id, &error));
        if (then == ADD_PIN) assert_done(edit_pin_set(document, 1, &pin, &error));
        if (then == REMOVE_PIN) assert_done(edit_pin_remove(document, 1, document->rigs[1]->pins[0].id, &error));
        for (int s = 0; s < 2 && then == FOLLOW_NOTHING; s++)
            assert_done(edit_parameter(document, s, PARAMETER_EQUILIBRIUM, &none, &error));
    }
}

/// A rig that is a chain, its side's channel and that spline.
static const char *print_chain(const struct document *document, int rig)
{
    static char text[256];
    const struct chain *chain = &document->rigs[rig]->chain;
    const struct channel *side = &chain->channels[0];
    const struct spline *spline = document->splines[side->spline];
    const struct joint_motion *motion = spline->parameter[PARAMETER_EQUILIBRIUM].motion;
    snprintf(text, sizeof text, "%s to %s, %s of %d by lag %g, %s gain %g%s: %g Hz, %g, %s, %d knots, by %s",
             document->rigs[rig]->name, chain->to, spline->name, document->spline_count, side->lag.value[0],
             side->of == PART_DISPLACEMENT ? "displacement" : "total", side->gain.value[0],
             chain->mirror ? ", mirrored" : "", spline->parameter[PARAMETER_FREQUENCY].value,
             spline->parameter[PARAMETER_DAMPING].value, spline_start(spline) == WIGGLY_LOOP ? "loops" : "rests",
             spline->knot_count, motion ? motion->joint : "none");
    return text;
}

/// Longer chains swing slower. A twin shares splines, mirrored, unless it is to have its own.
DOG_TEST(chains_of_the_dog)
{
    static const struct {
        struct chain_wish wish;
        const char *chain;
    } rows[] = {
        {{.from = "tail_1", .follows = true},
         "tail to tail_8, tail side of 2 by lag 14, displacement gain 43.2: 1.3 Hz, 0.12, loops, 0 knots, by tail_8"},
        {{.from = "ear_1_L"},
         "ear_1_L to ear_4_L, ear_1_L side of 4 by lag 28, total gain 27.5: 2.1 Hz, 0.12, loops, 0 knots, by none"},
        {{.from = "ear_1_R"},
         "ear_1_R to ear_4_R, ear_1_L side of 4 by lag 28, total gain 27.5, mirrored: 2.1 Hz, 0.12, loops, 0 knots, "
         "by none"},
        {{.from = "ear_1_R", .own = true, .follows = true},
         "ear_1_R 2 to ear_4_R, ear_1_R 2 side of 6 by lag 28, displacement gain 133: 2.1 Hz, 0.12, loops, 0 knots, "
         "by ear_4_R"},
        {{.from = "ear_2_L", .frequency = 2.5, .damping = 0.3, .lag = 11},
         "ear_2_L to ear_4_L, ear_2_L side of 8 by lag 11, total gain 36.7: 2.5 Hz, 0.3, loops, 0 knots, by none"},
        {{.from = "neck", .to = "head"},
         "neck to head, neck side of 10 by lag 55, total gain 55: 2.1 Hz, 0.12, loops, 0 knots, by none"},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        const int rig = add_chain(&stand->opened, rows[r].wish);
        const char *chain = print_chain(stand->opened.document, rig);
        if (strcmp(chain, rows[r].chain) != 0) fail_msg("%s, expected %s", chain, rows[r].chain);
    }
    history_end(stand->history);
    assert_true(history_undo(stand->history));
    assert_int_equal(stand->opened.document->rig_count, 1);
    assert_int_equal(stand->opened.document->spline_count, 0);
    assert_true(history_redo(stand->history));
    assert_int_equal(stand->opened.document->spline_count, 10);
}

/// Metres that the tip of the last rig is off from where the clip alone has it, to the dog's left.
static double tip_off(const struct stand *stand, int sample)
{
    const struct posing unsolved = {.document = stand->opened.document, .models = stand->opened.models};
    const struct posing posing = opened_posing(&stand->opened);
    const int rig = stand->opened.document->rig_count - 1;
    struct rig_pose still, swung;
    assert_true(rig_pose(&unsolved, rig, sample, &still));
    assert_true(rig_pose(&posing, rig, sample, &swung));
    const int tip = swung.strand.count - 1;
    return (double)(swung.strand.matrix[tip][12] - still.strand.matrix[tip][12]);
}

/// The largest angle, degrees, by which a chain that follows a clip turns its last bone from where the clip alone has it.
static double largest_turn(struct opened *opened, const char *bone)
{
    double largest = 0;
    const int rig = add_chain(opened, (struct chain_wish){.from = bone, .follows = true});
    opened_solve(opened, SOLVER_BY_LENGTH);
    const struct posing posing = opened_posing(opened);
    for (int s = 0; s < opened->evaluation.samples; s++) {
        struct rig_pose posed;
        assert_true(rig_pose_body(&posing, 0, s, &posed));
        const struct gltf *gltf = &posed.imported->gltf;
        const int node = gltf_find_node(gltf, opened->document->rigs[rig]->chain.to);
        const mat3s swung = glms_mat4_pick3(mat4_from(posed.model.pose->world[node]));
        struct gltf_pose *clip = posing_clip(&posing, 0, s, POSE_UNSEEN);
        gltf_pose_world(gltf, clip);
        const mat3s turn = glms_mat3_mul(swung, mat3_inverse(glms_mat4_pick3(mat4_from(clip->world[node]))));
        const double trace = (double)(turn.m00 + turn.m11 + turn.m22);
        largest = fmax(largest, acos(fmin((trace - 1) / 2, 1)) * 180 / 3.14159265358979323846);
    }
    return largest;
}

/// Whatever the chain's length, the character's size and the clip; but for swings that nobody would see.
TEST(a_clip_swings_every_chain_as_far)
{
    static const struct {
        const char *clip, *bone;
        double scale, least, most;
    } rows[] = {
        {"Walk", "tail_1", 1, 29, 31}, {"Walk", "ear_1_L", 1, 29, 31},         {"Walk", "jaw", 1, 29, 31},
        {"Trot", "tail_1", 1, 29, 31}, {"Trot", "thigh_front_L", 1, 29, 31},   {"Walk", "tail_1", 30, 29, 31},
        {"Walk", "jaw", 0.01, 29, 31}, {"Idle", "thigh_front_L", 1, 0.01, 29},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct opened opened;
        assert_done(opened_read(&opened, dog, &error));
        const struct gltf *gltf = &models_imported(opened.models, opened.document, 0)->gltf;
        document_own_rig(opened.document, 0)->model.scale = rows[r].scale;
        assert_done(import_choose_clip(opened.document, 0, gltf, rows[r].clip, REPEAT_BY_CLIP, &error));
        const double turn = largest_turn(&opened, rows[r].bone);
        if (!(turn >= rows[r].least && turn <= rows[r].most))
            fail_msg("row %zu: %s turns %s by %g", r, rows[r].clip, rows[r].bone, turn);
        opened_free(&opened);
    }
}

/// By chain_bend_a_metre(): for a tail that points to the back, side × along is −x; its spline is in metres that way. It swings with the walk
/// and loops.
DOG_TEST(the_tip_moves_as_far_as_its_spline)
{
    double most = 0;
    struct strand strand;
    const struct posing unsolved = {.document = stand->opened.document, .models = stand->opened.models};
    const int rig = add_chain(&stand->opened, (struct chain_wish){.from = "tail_1", .follows = true, .lag = 1e-6});
    assert_true(strand_find(&unsolved, 0, rig, &strand));
    document_own_rig(stand->opened.document, rig)->chain.channels[0].gain.value[0] =
        chain_bend_a_metre(strand.imported, &strand.bones, 1);
    opened_solve(&stand->opened, SOLVER_BY_LENGTH);
    const struct evaluation *evaluation = &stand->opened.evaluation;
    for (int s = 0; s < evaluation->samples; s++) {
        const double x = evaluation_at(evaluation, 0, s).re;
        most = fmax(most, fabs(x));
        assert_near(tip_off(stand, s), -x, 0.25 * fabs(x) + 0.01);
    }
    assert_true(most > 0.05);
    assert_near(evaluation->curves[0].total[evaluation->samples - 1], evaluation->curves[0].total[0], 1e-9);
}

/// What a chain with an offset adds to its clip is what it added then, also around the seam; the clip goes on as ever, and the twin.
STAND_TEST(an_offset_delays_what_bends_not_the_clip, stand_open(stand, "assets/scenes/dog.json"))
{
    static const char *const joints[] = {"ear_1_R", "ear_4_R", "ear_1_L", "tail_8"};
    const double offset = 2.37;
    versors bends[2][4];
    stand_solve(stand);
    const struct posing posing = opened_posing(&stand->opened);
    for (double at = 0; at <= 96; at += 7.5) {
        for (int later = 0; later < 2; later++) {
            document_own_rig(stand->opened.document, 3)->offset = later ? offset : 0;
            for (int j = 0; j < 4; j++) {
                const double read = !later && j < 2 ? at - offset : at, seen = 4 * (read < 0 ? read + 96 : read);
                struct rig_pose posed;
                assert_true(rig_pose_body(&posing, 0, seen, &posed));
                const int node = gltf_find_node(&posed.imported->gltf, joints[j]);
                versors bent, clip;
                memcpy(bent.raw, posed.model.pose->place[node].rotation, sizeof bent.raw);
                memcpy(clip.raw, posing_clip(&posing, 0, seen, POSE_UNSEEN)->place[node].rotation, sizeof clip.raw);
                bends[later][j] = glms_quat_mul(glms_quat_inv(clip), bent);
            }
        }
        for (int j = 0; j < 4; j++)
            for (int k = 0; k < 4; k++) assert_near(bends[1][j].raw[k], (double)bends[0][j].raw[k], 1e-6);
    }
}
