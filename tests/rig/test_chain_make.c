/// Chains made for a character of somebody's: names, splines and channels that suit it, motion that follows its clip, one step to undo.
#include "gltf_builder.h"
#include "stand.h"

static const char dog[] = "assets/models/dog.glb";

/// Of the dog's own scene, in a step that is open.
#define DOG_TEST(name) STAND_TEST(name, (stand_open(stand, dog), stand_begin(stand)))

static const struct chain *make_with_lag(struct stand *stand, const char *from, bool follows, double lag)
{
    int rig;
    const struct chain_wish wish = {.from = from, .follows = follows, .lag = lag};
    assert_done(chain_make(stand->opened.document, stand->opened.models, &wish, &rig, &error));
    return &stand->opened.document->rigs[rig]->chain;
}

static const struct chain *make(struct stand *stand, const char *from, bool follows)
{
    return make_with_lag(stand, from, follows, 0);
}

TEST(test_a_character_opens_as_a_scene)
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
TEST(test_a_character_of_any_size_fits_the_stage)
{
    static const struct {
        float height;
        double scale;
    } cases[] = {{180, 0.009}, {0.016f, 100}, {0.5f, 1}, {3, 1}, {5, 0.3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float position[3][3] = {{0, 0, 0}, {0.1f * cases[i].height, 0, 0}, {0, cases[i].height, 0}};
        struct builder b = {0};
        add_data(&b, FLOAT, "VEC3", 3, position, sizeof position);
        const char *text = builder_json(&b, "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                                            "\"nodes\":[{\"mesh\":0}],\"scenes\":[{\"nodes\":[0]}]");
        struct document *document;
        assert_done(document = import_scene(temporary_file("size.gltf", text, strlen(text)), &error));
        assert_near(document->rigs[0]->model.scale, cases[i].scale, 1e-9);
        document_destroy(document);
    }
}

DOG_TEST(test_a_chosen_clip_gives_the_scene_its_length)
{
    const struct knot knot = {.frame = 20, .value = 1, .stiffness = 1};
    const struct gltf *gltf = &models_imported(stand->opened.models, stand->opened.document, 0)->gltf;
    assert_done(import_choose_clip(stand->opened.document, 0, gltf, "Trot", REPEAT_BY_CLIP, &error));
    assert_string_equal(stand->opened.document->rigs[0]->model.clip, "Trot");
    assert_int_equal(stand->opened.document->last_frame, 14);
    make(stand, "tail_1", true);
    assert_int_equal(spline_start(stand->opened.document->splines[0]), WIGGLY_LOOP);
    assert_done(import_choose_clip(stand->opened.document, 0, gltf, "Idle", REPEAT_BY_CLIP, &error));
    assert_int_equal(stand->opened.document->last_frame, 120); // chains go with the clip
    assert_done(edit_knot_insert(stand->opened.document, 0, &knot, &error));
    assert_done(import_choose_clip(stand->opened.document, 0, gltf, "Trot", REPEAT_BY_CLIP, &error));
    assert_int_equal(stand->opened.document->last_frame, 120); // knots keep their frames
}

DOG_TEST(test_a_tail_swings_with_the_walk_and_loops)
{
    const struct chain *tail = make(stand, "tail_1", true);
    assert_string_equal(tail->to, "tail_8");
    assert_int_equal(tail->channel_count, 2);
    assert_int_equal(tail->channels[0].of, PART_DISPLACEMENT);
    const struct spline *side = stand->opened.document->splines[tail->channels[0].spline];
    assert_string_equal(side->name, "tail side");
    assert_int_equal(spline_start(side), WIGGLY_LOOP);
    assert_int_equal(side->knot_count, 0);
    opened_solve(&stand->opened, SOLVER_BY_LENGTH);
    const wiggly_curve *curve = &stand->opened.evaluation.curves[tail->channels[0].spline];
    double swing = 0;
    for (int s = 0; s < stand->opened.evaluation.samples; s++) swing = fmax(swing, fabs(curve->re[s]));
    assert_true(swing > 0.02); // metres of the tip behind the hips
    assert_near(curve->total[stand->opened.evaluation.samples - 1], curve->total[0], 1e-9);
}

/// Metres that the tip of the last rig is off from where the clip alone has it, to the dog's left.
static double tip_off(const struct stand *stand, int sample)
{
    const struct posing unsolved = {.document = stand->opened.document, .models = stand->opened.models};
    const struct posing posing = opened_posing(&stand->opened);
    const int rig = stand->opened.document->rig_count - 1;
    struct rig_pose still, swung;
    assert_true(rig_pose(&unsolved, rig, sample, NULL, &still));
    assert_true(rig_pose(&posing, rig, sample, NULL, &swung));
    const int tip = swung.strand.count - 1;
    return (double)(swung.strand.matrix[tip][12] - still.strand.matrix[tip][12]);
}

/// For a tail that points to the back, side × along is -x; its spline is in metres that way.
DOG_TEST(test_the_tip_moves_as_far_as_its_spline)
{
    double most = 0;
    make_with_lag(stand, "tail_1", true, 1e-6);
    opened_solve(&stand->opened, SOLVER_BY_LENGTH);
    for (int s = 0; s < stand->opened.evaluation.samples; s++) {
        const double x = evaluation_at(&stand->opened.evaluation, 0, s).re;
        most = fmax(most, fabs(x));
        assert_near(tip_off(stand, s), -x, 0.25 * fabs(x) + 0.01);
    }
    assert_true(most > 0.05);
}

DOG_TEST(test_ears_share_splines)
{
    make(stand, "ear_1_L", false);
    const int splines = stand->opened.document->spline_count;
    const struct chain *right = make(stand, "ear_1_R", false);
    assert_int_equal(stand->opened.document->spline_count, splines);
    assert_true(right->mirror);
    assert_string_equal(right->to, "ear_4_R");
    assert_int_equal(right->channels[0].spline, splines - 2);
}

DOG_TEST(test_ears_may_have_splines_of_their_own)
{
    int rig;
    make(stand, "ear_1_L", true);
    const struct chain_wish wish = {.from = "ear_1_R", .follows = true, .own = true};
    assert_done(chain_make(stand->opened.document, stand->opened.models, &wish, &rig, &error));
    const struct document *document = stand->opened.document;
    assert_int_equal(document->spline_count, 4);
    const struct joint_motion *motion = document->splines[3]->parameter[PARAMETER_EQUILIBRIUM].motion;
    assert_string_equal(motion->joint, "ear_4_R");
    assert_false(document->rigs[rig]->chain.mirror);
}

DOG_TEST(test_undo_takes_all_of_it_back)
{
    make(stand, "tail_1", true);
    history_end(stand->history);
    assert_true(history_undo(stand->history));
    assert_int_equal(stand->opened.document->rig_count, 1);
    assert_int_equal(stand->opened.document->spline_count, 0);
    assert_true(history_redo(stand->history));
    assert_int_equal(stand->opened.document->spline_count, 2);
}

DOG_TEST(test_what_cannot_be_a_chain)
{
    int rig;
    const struct chain_wish wishes[] = {{.from = "chest"}, {.from = "tail_8", .to = "tail_1"}, {.from = "wing"}};
    const char *const sentences[] = {"branches into", "below \"tail_8\"", "a bone called \"wing\""};
    for (int i = 0; i < 3; i++) {
        assert_refusal(chain_make(stand->opened.document, stand->opened.models, &wishes[i], &rig, &error),
                       sentences[i]);
    }
    assert_int_equal(stand->opened.document->rig_count, 1);
}

/// Bones that lie at one place make no chain, at any scale; short ones of a small character do. A single bone without a child bends sensibly.
TEST(test_bones_at_one_place)
{
    static const struct {
        double height, step;
        bool is_chain;
    } cases[] = {{1, 0, false},  {1, 1e-6, false},   {1, 3e-4, false},  {1, 0.01, true},
                 {100, 1, true}, {100, 0.03, false}, {1e-3, 1e-5, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float height = (float)cases[i].height,
                    position[3][3] = {{0, 0, 0}, {0, height, 0}, {0, 0, 0.1f * height}};
        struct builder b = {0};
        char parts[600];
        struct opened opened;
        struct error refusal = {0};
        int rig;
        add_data(&b, FLOAT, "VEC3", 3, position, sizeof position);
        snprintf(parts, sizeof parts,
                 "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"nodes\":[{\"mesh\":0},"
                 "{\"name\":\"a\",\"children\":[2]},{\"name\":\"b\",\"translation\":[0,%g,0],\"children\":[3]},"
                 "{\"name\":\"c\",\"translation\":[0,0,%g]}],\"scenes\":[{\"nodes\":[0,1]}]",
                 cases[i].step, cases[i].step);
        const char *text = builder_json(&b, parts);
        assert_done(opened_read(&opened, temporary_file("place.gltf", text, strlen(text)), &error));
        const struct chain_wish wish = {.from = "a", .to = "c", .follows = true};
        const bool made = chain_make(opened.document, opened.models, &wish, &rig, &refusal);
        assert_int_equal(made, cases[i].is_chain);
        if (!made) assert_non_null(strstr(refusal.text, "the bones \"a\" to \"c\" lie at one place"));
        const struct chain_wish leaf = {.from = "c", .to = "c", .follows = true};
        const double tall = cases[i].height * opened.document->rigs[0]->model.scale;
        assert_done(chain_make(opened.document, opened.models, &leaf, &rig, &error));
        assert_true(opened.document->rigs[rig]->chain.channels[0].gain.value[0] * tall < 3000); // degrees
        opened_free(&opened);
    }
}

TEST(test_sides_of_names)
{
    static const char *const pairs[][2] = {{"ear_1_L", "ear_1_R"},     {"mixamorig:LeftHand", "mixamorig:RightHand"},
                                           {"arm.l.002", "arm.r.002"}, {"R_wing", "L_wing"},
                                           {"EarL", "EarR"},           {"hairR2", "hairL2"}};
    char other[BONE_NAME_SIZE];
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        assert_true(bone_other_side(pairs[i][0], other));
        assert_string_equal(other, pairs[i][1]);
        assert_true(bone_other_side(pairs[i][1], other));
        assert_string_equal(other, pairs[i][0]);
    }
    assert_false(bone_other_side("tail_1", other));
    assert_false(bone_other_side("Roll", other));
}
