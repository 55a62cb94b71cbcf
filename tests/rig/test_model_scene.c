/// Imported characters and their chains: read, printed, copied, edited, and carried along when the scene is saved elsewhere.

#include "invariants.h"
#include "world.h"

/// As it is printed.
static const char whole[] = "{\n"
                            "  \"wiggly\": 1,\n"
                            "  \"fps\": 24,\n"
                            "  \"substeps\": 1,\n"
                            "  \"frames\": [0, 48],\n"
                            "  \"splines\": [\n"
                            "    {\n"
                            "      \"name\": \"s\",\n"
                            "      \"mode\": \"complex\",\n"
                            "      \"frequency\": 1,\n"
                            "      \"damping\": 0.1,\n"
                            "      \"bandwidth\": 0.1,\n"
                            "      \"calm\": 1,\n"
                            "      \"equilibrium\": 0,\n"
                            "      \"start\": \"free\",\n"
                            "      \"knots\": []\n"
                            "    }\n"
                            "  ],\n"
                            "  \"rigs\": [\n"
                            "    {\n"
                            "      \"type\": \"model\",\n"
                            "      \"name\": \"walk\",\n"
                            "      \"model\": \"walk.glb\",\n"
                            "      \"clip\": \"Walk\",\n"
                            "      \"repeat\": \"once\",\n"
                            "      \"position\": [1, 0, -0.5],\n"
                            "      \"scale\": 0.01,\n"
                            "      \"turn\": 90,\n"
                            "      \"glow\": 3\n"
                            "    },\n"
                            "    {\n"
                            "      \"type\": \"chain\",\n"
                            "      \"name\": \"tail\",\n"
                            "      \"model\": \"walk\",\n"
                            "      \"from\": \"tail_1\",\n"
                            "      \"to\": \"tail_8\",\n"
                            "      \"turn\": 15,\n"
                            "      \"mirror\": true,\n"
                            "      \"channels\": [\n"
                            "        { \"spline\": \"s\", \"axis\": \"side\", \"lag\": 20, \"gain\": [1, 2, 3.5] },\n"
                            "        { \"spline\": \"s\", \"axis\": \"twist\", \"of\": \"displacement\", \"lag\": "
                            "6.5, \"gain\": 5, \"tint\": \"red\" }\n"
                            "      ]\n"
                            "    },\n"
                            "    {\n"
                            "      \"type\": \"model\",\n"
                            "      \"model\": \"models/cat.glb\",\n"
                            "      \"position\": [0, 0, 0],\n"
                            "      \"scale\": 1,\n"
                            "      \"turn\": 0\n"
                            "    },\n"
                            "    {\n"
                            "      \"type\": \"chain\",\n"
                            "      \"model\": \"models/cat.glb\",\n"
                            "      \"from\": \"ear\",\n"
                            "      \"to\": \"ear tip\",\n"
                            "      \"turn\": 0,\n"
                            "      \"mirror\": false,\n"
                            "      \"channels\": []\n"
                            "    }\n"
                            "  ]\n"
                            "}\n";

enum { WALK, TAIL, CAT, EAR };

TEST(what_is_printed_is_read_again)
{
    struct document *document = document_of_text(whole);
    assert_prints(document, whole);
    const struct chain *chain = &document->rigs[TAIL]->chain;
    assert_int_equal(document_find_model(document, chain->model, chain->by_file), WALK);
    assert_int_equal(chain->channels[1].axis, AXIS_TWIST);
    chain = &document->rigs[EAR]->chain;
    assert_int_equal(document_find_model(document, chain->model, chain->by_file), CAT);
    assert_string_equal(rig_title(document->rigs[CAT]), "models/cat.glb");
    assert_string_equal(rig_title(document->rigs[EAR]), "ear");
    document_destroy(document);
}

TEST(a_file_may_leave_out_what_is_usual)
{
    struct document *document =
        document_of_text("{\"frames\": [0, 9], \"rigs\": [{\"type\": \"chain\", \"model\": \"a.glb\","
                         " \"from\": \"b\", \"to\": \"b\"}, {\"type\": \"model\", \"model\": \"a.glb\"}]}");
    const struct model_rig *model = &document->rigs[1]->model;
    assert_null(model->clip);
    assert_near(model->scale, 1, 0);
    assert_near(model->turn, 0, 0);
    assert_false(document->rigs[0]->chain.mirror);
    assert_int_equal(rig_input_count(document->rigs[0]), 0);
    document_destroy(document);
}

/// A copy of each kind of rig prints alike, and shares nothing with its original.
TEST(every_kind_of_rig_can_be_copied)
{
    static const char character[] =
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"s\"}], \"rigs\": [{\"type\": \"character\", \"model\":"
        " \"a.glb\", \"paint\": \"a.npy\", \"coordinates\": [{\"name\": \"up\", \"spline\": \"s\"}]},"
        " {\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}";
    struct document *documents[] = {document_of_text(whole), document_of_text(character)};
    assert_true(edit_paint_new(documents[1], 0, 1, 4, NULL));
    documents[1]->rigs[0]->character.painted->values[2][1] = 0.5f;
    for (int d = 0; d < 2; d++) {
        char *text = text_of_document(documents[d]);
        for (int r = 0; r < documents[d]->rig_count; r++) {
            struct rig *rig = documents[d]->rigs[r], *copy = rig_clone(rig);
            assert_int_equal(rig_bytes(copy, NULL), rig_bytes(rig, NULL));
            rig_drop(rig);
            documents[d]->rigs[r] = copy;
        }
        assert_prints(documents[d], text);
        free(text);
    }
    const struct character_rig *copied = &documents[1]->rigs[0]->character;
    assert_near(copied->painted->values[2][1], 0.5, 0);
    for (int d = 0; d < 2; d++) document_destroy(documents[d]);
}

/// A chain that names its model by the file follows it; one that goes by the name keeps that.
TEST(paths_lead_to_the_same_models_from_another_folder)
{
    struct document *document = document_of_text(whole);
    document->folder = strdup("/films");
    size_t size;
    char *text = scene_print_for(document, "/films/new", NULL, &size);
    struct document *moved = document_of_text(text);
    assert_string_equal(moved->rigs[WALK]->model.model, "../walk.glb");
    assert_string_equal(moved->rigs[CAT]->model.model, "../models/cat.glb");
    assert_string_equal(moved->rigs[EAR]->chain.model, "../models/cat.glb");
    assert_string_equal(moved->rigs[TAIL]->chain.model, "walk");
    const struct chain *ear = &moved->rigs[EAR]->chain;
    assert_int_equal(document_find_model(moved, ear->model, ear->by_file), CAT);
    document_destroy(moved);
    document_destroy(document);
    free(text);
}

// --- edits

WORLD_TEST(channels_of_a_chain_are_edited_as_those_of_a_tail, world_open_scene(world, whole))
{
    const struct angles ramp = {.form = ANGLES_RAMP, .count = 2, .ramp = {{0, 1}, {1, 30}}};
    const struct angles many = {.form = ANGLES_EACH, .count = 7, .value = {1, 2, 3, 4, 5, 6, 7}};
    assert_reversible(world, EDIT(edit_angles, (struct channel_place){TAIL, 0}, ANGLE_LAG, &ramp));
    assert_reversible(world, EDIT(edit_angles, (struct channel_place){TAIL, 0}, ANGLE_GAIN, &many));
    assert_reversible(world, edit_bend(world, TAIL, 0, -1, AXIS_TWIST, -1));
    assert_reversible(world, edit_bend(world, TAIL, 0, -1, -1, PART_DISPLACEMENT));
    assert_reversible(world, EDIT(edit_channel_add, EAR, 0, AXIS_TWIST, PART_TOTAL));
    assert_reversible(world, EDIT(edit_spline_add, 0, "first", NULL));
    assert_int_equal(document_find_spline(world->document, "s"),
                     world->document->rigs[TAIL]->chain.channels[1].spline);
    assert_reversible(world, edit_bend(world, TAIL, 1, 0, -1, -1));
    assert_reversible(world, EDIT(edit_channel_remove, (struct channel_place){TAIL, 0}));
    assert_int_equal(world->document->rigs[TAIL]->chain.channel_count, 1);
    assert_refused(world, EDIT(edit_angles, (struct channel_place){TAIL, 0}, ANGLE_REST, &ramp),
                   "only a tail has angles at rest");
    assert_refused(world, edit_bend(world, WALK, 0, -1, AXIS_SIDE, -1), "there is no such rig");
    assert_refused(world, EDIT(edit_joints, TAIL, 1), "there is no such tail");
    assert_refused(world, EDIT(edit_spline_remove, 1), "s: still used in 1 place; remove those first");
}

WORLD_TEST(models_and_chains_are_added, world_open_scene(world, whole))
{
    char file[] = "../films/walk.glb", from[] = "leg", to[] = "foot";
    struct channel channel = {.axis = AXIS_UP, .lag = {.value = {3}}, .gain = {.value = {4}}};
    struct rig model = {.kind = RIG_MODEL, .model = {.model = file, .clip = from, .scale = 2}};
    struct rig chain = {.kind = RIG_CHAIN,
                        .chain = {.model = file, .from = from, .to = to, .channels = &channel, .channel_count = 1}};
    assert_refused(world, EDIT(edit_rig_add, &chain),
                   "leg: expected the name or file of a model rig, got \"../films/walk.glb\"");
    assert_reversible(world, EDIT(edit_rig_add, &model));
    assert_string_equal(world->document->rigs[4]->name, "walk 2");
    assert_reversible(world, EDIT(edit_rig_add, &chain));
    assert_string_equal(world->document->rigs[5]->name, "leg");
    assert_true(world->document->rigs[5]->chain.by_file);
    chain.chain.model = world->document->rigs[4]->name;
    assert_reversible(world, EDIT(edit_rig_add, &chain));
    assert_string_equal(world->document->rigs[6]->name, "leg 2");
    memset(file, 'x', sizeof file - 1);
    memset(from, 'x', sizeof from - 1);
    channel.gain.value[0] = 100;
    assert_string_equal(world->document->rigs[4]->model.clip, "leg");
    assert_string_equal(world->document->rigs[4]->model.model, "../films/walk.glb");
    assert_near(world->document->rigs[6]->chain.channels[0].gain.value[0], 4, 0);
    model.model.scale = 0;
    assert_refused(world, EDIT(edit_rig_add, &model), "xxxxxxxxxxxxxxxxx: the scale must be above 0 and finite");
    channel.spline = 1;
    assert_refused(world, EDIT(edit_rig_add, &chain), "xxx: there is no such spline");
    world_undo_all(world);
    assert_document(world, whole);
}

WORLD_TEST(models_and_chains_are_set, world_open_scene(world, whole))
{
    char from[] = "a", to[] = "b", run[] = "Run", nothing[] = "";
    struct rig place = *world->document->rigs[WALK], ends = *world->document->rigs[TAIL];
    place.model.position[2] = 3, place.model.scale = 4, place.model.turn = -5;
    ends.chain.from = from, ends.chain.to = to, ends.chain.turn = 7, ends.chain.mirror = false;
    assert_reversible(world, EDIT(edit_rig_set, WALK, &place));
    assert_near(world->document->rigs[WALK]->model.position[2], 3, 0);
    place.model.clip = run;
    assert_reversible(world, EDIT(edit_rig_set, WALK, &place));
    place.model.clip = NULL;
    assert_reversible(world, EDIT(edit_rig_set, WALK, &place));
    assert_null(world->document->rigs[WALK]->model.clip);
    assert_reversible(world, EDIT(edit_rig_set, TAIL, &ends));
    assert_string_equal(world->document->rigs[TAIL]->chain.to, "b");
    assert_false(world->document->rigs[TAIL]->chain.mirror);
    ends.chain.to = nothing;
    assert_refused(world, EDIT(edit_rig_set, TAIL, &ends), "tail: \"to\" must not be empty");
    place.model.turn = NAN;
    assert_refused(world, EDIT(edit_rig_set, WALK, &place), "walk: the turn must be finite");
    assert_refused(world, EDIT(edit_rig_set, TAIL, &place), "there is no such model");
    world_undo_all(world);
    assert_document(world, whole);
}

WORLD_TEST(chains_keep_to_their_model, world_open_scene(world, whole))
{
    assert_refused(world, EDIT(edit_rig_remove, WALK), "walk: still needed by tail; remove those first");
    assert_reversible(world, EDIT(edit_rig_name, WALK, "dog"));
    assert_string_equal(world->document->rigs[TAIL]->chain.model, "dog");
    assert_reversible(world, EDIT(edit_rig_name, CAT, "cat"));
    assert_string_equal(world->document->rigs[EAR]->chain.model, "models/cat.glb");
    assert_refused(world, EDIT(edit_rig_name, WALK, "models/cat.glb"),
                   "expected a name that is no model's file, got models/cat.glb");
    assert_refused(world, EDIT(edit_rig_name, EAR, "tail"), "there is a rig called tail already");
    assert_refused(world, EDIT(edit_rig_name, EAR, NULL), "a chain needs a name");
    assert_reversible(world, EDIT(edit_rig_remove, EAR));
    assert_reversible(world, EDIT(edit_rig_remove, CAT));
    world_undo_all(world);
    assert_document(world, whole);
}

/// One of few names, so that they meet.
static const char *random_name(void)
{
    static const char *const names[] = {"walk", "tail", "dog", "models/cat.glb", "walk.glb", "", "s"};
    return names[rand() % 7];
}

/// Gives a rig the ends of a chain like that, or the numbers of a model.
static bool set_like(struct document *document, int r, const struct rig *like, struct error *error)
{
    struct rig changed = *like;
    if (r < document->rig_count && document->rigs[r]->kind == like->kind) {
        changed = *document->rigs[r];
        if (like->kind == RIG_CHAIN) {
            changed.chain.from = like->chain.from;
            changed.chain.to = like->chain.to;
            changed.chain.mirror = like->chain.mirror;
        } else {
            changed.model.clip = like->model.clip;
            changed.model.scale = like->model.scale;
            changed.model.turn = like->model.turn;
        }
    }
    return edit_rig_set(document, r, &changed, error);
}

/// Any edit of rigs or of what follows them, possible or not.
static bool random_edit(struct world *world)
{
    char text[2][32];
    for (int i = 0; i < 2; i++) snprintf(text[i], sizeof text[i], "%s", random_name());
    struct channel channel = {.axis = (enum axis)(rand() % 4), .gain = {.value = {rand()}}};
    const struct angles angles = {
        .form = (enum angle_form)(rand() % 3), .count = 1 + rand() % 4, .ramp = {{0, 1}, {1, 2}}};
    struct rig rig = {.name = rand() % 2 ? text[0] : NULL};
    struct joint_motion motion = {
        .model = text[0], .joint = text[1], .chain = rand() % 2 ? text[1] : NULL, .gain = rand() % 5};
    struct document *document = world->document;
    struct error *error = &world->error;
    const int r = rand() % 6, spline = rand() % document->spline_count;
    const struct channel_place at = {r, 0};
    const struct param param = {.track = -1, .motion = rand() % 3 ? &motion : NULL};
    const int kind = rand() % 15;
    if (kind < 2) {
        rig.kind = RIG_CHAIN;
        rig.chain = (struct chain){.model = text[0], .from = text[1], .to = text[0], .mirror = rand() % 2};
        if (rand() % 2) rig.chain.channels = &channel, rig.chain.channel_count = 1;
    } else {
        rig.kind = RIG_MODEL;
        rig.model = (struct model_rig){.model = text[1], .clip = text[0], .scale = rand() % 3, .turn = rand() % 9};
    }
    switch (kind) {
    case 0:
        return edit_rig_add(document, &rig, error);
    case 1:
        return set_like(document, r, &rig, error);
    case 2:
        return edit_rig_add(document, &rig, error);
    case 3:
    case 6:
        return set_like(document, r, &rig, error);
    case 4:
        return edit_rig_remove(document, r, error);
    case 5:
        return edit_rig_name(document, r, text[0], error);
    case 7:
        return edit_channel_remove(document, at, error);
    case 8:
        return edit_channel_add(document, r, spline, channel.axis, PART_TOTAL, error);
    case 9:
        return edit_angles(document, at, (enum angle_kind)(1 + rand() % 2), &angles, error);
    case 10:
        return edit_parameter(document, spline, PARAMETER_EQUILIBRIUM, &param, error);
    case 11:
        return edit_tail_add(document, r, spline, error);
    case 12:
        return edit_channel(document, at, &channel, error);
    case 13:
        return document->spline_count <= 6 && edit_spline_copy(document, spline, error);
    default:
        return edit_spline_move(document, spline, 0, error);
    }
}

/// Whatever was done: what is there holds together, all of it can be saved, and undo gives back the first document to the byte.
TEST(random_walks_lead_back)
{
    for (unsigned seed = 1; seed <= (unsigned)quick_or_all(6, 20); seed++) {
        struct world world;
        srand(seed);
        world_open_scene(&world, whole);
        for (int i = 0; i < 150; i++) {
            history_begin(world.history, "Random", 0);
            for (int k = rand() % 3; k >= 0; k--) random_edit(&world);
            if (rand() % 9 == 0) history_restart(world.history);
            history_end(world.history);
            for (int k = rand() % 6 - 3; k > 0; k--) history_undo(world.history);
            for (int k = rand() % 6 - 3; k > 0; k--) history_redo(world.history);
            assert_invariants(world.document);
            assert_loads_again(world.document);
        }
        while (history_redo(world.history)) continue;
        const char *last = world_print(&world);
        assert_true(world_undo_all(&world) > 0);
        assert_document(&world, whole);
        while (history_redo(world.history)) continue;
        assert_document(&world, last);
        world_close(&world);
    }
}
