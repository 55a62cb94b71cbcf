/// Imported characters and their chains: read, printed, copied, edited, and carried along when the scene is saved elsewhere.

#include "invariants.h"
#include "world.h"

/// All that is printed, but for blanks.
static const char whole[] =
    "{\"wiggly\": 1, \"fps\": 24, \"substeps\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"mode\":"
    " \"complex\", \"frequency\": 1, \"damping\": 0.1, \"bandwidth\": 0.1, \"calm\": 1, \"equilibrium\": 0, "
    "\"start\":"
    " \"free\", \"knots\": []}], \"rigs\": [{\"type\": \"model\", \"name\": \"walk\", \"model\": \"walk.glb\","
    " \"clip\": \"Walk\", \"repeat\": \"once\", \"position\": [1, 0, -0.5], \"scale\": 0.01, \"turn\": 90, \"glow\":"
    " 3}, {\"type\": \"chain\", \"name\": \"tail\", \"model\": \"walk\", \"from\": \"tail_1\", \"to\": \"tail_8\","
    " \"turn\": 15, \"mirror\": true, \"channels\": [{\"spline\": \"s\", \"axis\": \"side\", \"lag\": 20, \"gain\":"
    " [1, 2, 3.5]}, {\"spline\": \"s\", \"axis\": \"twist\", \"of\": \"displacement\", \"lag\": 6.5, \"gain\": 5,"
    " \"tint\": \"red\"}]}, {\"type\": \"model\", \"model\": \"models/cat.glb\", \"position\": [0, 0, 0], \"scale\":"
    " 1, \"turn\": 0}, {\"type\": \"chain\", \"model\": \"models/cat.glb\", \"from\": \"ear\", \"to\": \"ear tip\","
    " \"turn\": 0, \"mirror\": false, \"channels\": []}]}";

static char *printed; ///< the same in lines

static int print_whole(void **state)
{
    (void)state;
    struct document *document = document_of_text(whole);
    printed = text_of_document(document);
    document_destroy(document);
    return 0;
}

static int free_printed(void **state)
{
    (void)state;
    free(printed);
    return 0;
}

TESTS_BETWEEN(print_whole, free_printed)

enum { WALK, TAIL, CAT, EAR };

TEST(what_is_printed_is_read_again)
{
    const char *is = printed;
    for (const char *at = whole; *at || *is; at++, is++) {
        is += strspn(is, " \n");
        at += strspn(at, " ");
        if (*at != *is) fail_msg("%.40s, expected %.40s", is, at);
        if (!*at) break;
    }
    struct document *document = document_of_text(printed);
    assert_prints(document, printed);
    const struct chain *chain = &document->rigs[TAIL]->chain;
    assert_int_equal(document_find_model(document, chain->model), WALK);
    assert_int_equal(chain->channels[1].axis, AXIS_TWIST);
    chain = &document->rigs[EAR]->chain;
    assert_int_equal(document_find_model(document, chain->model), CAT);
    assert_string_equal(rig_title(document->rigs[CAT]), "models/cat.glb");
    assert_string_equal(rig_title(document->rigs[EAR]), "ear");
    document_destroy(document);
    document = document_of_text("{\"frames\": [0, 9], \"rigs\": [{\"type\": \"chain\", \"model\": \"a.glb\","
                                " \"from\": \"b\", \"to\": \"b\"}, {\"type\": \"model\", \"model\": \"a.glb\"}]}");
    const struct model_rig *model = &document->rigs[1]->model; // what is usual may be left out
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
    documents[1]->rigs[0]->model.painted->values[2][1] = 0.5f;
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
    const struct model_rig *copied = &documents[1]->rigs[0]->model;
    assert_near(copied->painted->values[2][1], 0.5, 0);
    for (int d = 0; d < 2; d++) document_destroy(documents[d]);
}

/// A chain that names its model by the file follows it; one that goes by the name keeps that.
TEST(paths_lead_to_the_same_models_from_another_folder)
{
    struct document *document = document_of_text(whole);
    document->folder = strdup("/films");
    size_t size;
    char *text = scene_print(document, "/films/new", NULL, &size);
    struct document *moved = document_of_text(text);
    assert_string_equal(moved->rigs[WALK]->model.model, "../walk.glb");
    assert_string_equal(moved->rigs[CAT]->model.model, "../models/cat.glb");
    assert_string_equal(moved->rigs[EAR]->chain.model, "../models/cat.glb");
    assert_string_equal(moved->rigs[TAIL]->chain.model, "walk");
    const struct chain *ear = &moved->rigs[EAR]->chain;
    assert_int_equal(document_find_model(moved, ear->model), CAT);
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
    assert_reversible(world, EDIT(edit_channel, (struct channel_place){TAIL, 0}, NULL));
    assert_int_equal(world->document->rigs[TAIL]->chain.channel_count, 1);
    assert_refused(world, EDIT(edit_angles, (struct channel_place){TAIL, 0}, ANGLE_REST, &ramp),
                   "only a tail has angles at rest");
    assert_refused(world, edit_bend(world, WALK, 0, -1, AXIS_SIDE, -1), "there is no such rig");
    assert_refused(world, EDIT(edit_joints, TAIL, 1), "there is no such tail");
    assert_refused(world, edit_bend(world, TAIL, 0, -1, AXIS_BLINK, -1),
                   "tail: the axis must be \"side\", \"up\" or \"twist\"");
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
    assert_string_equal(world->document->rigs[5]->chain.model, file);
    assert_int_equal(document_find_model(world->document, file), 4);
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
    assert_document(world, printed);
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
    assert_document(world, printed);
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
    assert_document(world, printed);
}

/// Any edit of rigs or of what follows them, possible or not, with few names, so that they meet.
static bool random_edit(struct world *world)
{
    static const char *const names[] = {"walk", "tail", "dog", "models/cat.glb", "walk.glb", "", "s"};
    char text[2][32];
    for (int i = 0; i < 2; i++) strcpy(text[i], names[rand() % 7]);
    struct channel channel = {.axis = (enum axis)(rand() % 4), .gain = {.value = {rand()}}};
    const struct angles angles = {
        .form = (enum angle_form)(rand() % 3), .count = 1 + rand() % 4, .ramp = {{0, 1}, {1, 2}}};
    struct joint_motion motion = {
        .model = text[0], .joint = text[1], .chain = rand() % 2 ? text[1] : NULL, .gain = rand() % 5};
    struct document *document = world->document;
    struct error *error = &world->error;
    const int r = rand() % 6, spline = rand() % document->spline_count;
    const bool is_chain = rand() % 2, is_there = r < document->rig_count;
    struct rig rig = {.kind = is_chain ? RIG_CHAIN : RIG_MODEL}; // what is there, with other ends or numbers
    if (is_there && document->rigs[r]->kind == rig.kind) rig = *document->rigs[r];
    if (is_chain) {
        rig.chain.from = text[1];
        rig.chain.to = text[0];
        rig.chain.mirror = rand() % 2;
    } else {
        rig.model.clip = text[0];
        rig.model.scale = rand() % 3;
        rig.model.turn = rand() % 9;
    }
    const struct channel_place at = {r, 0};
    const struct param param = {.track = -1, .motion = rand() % 3 ? &motion : NULL};
    switch (rand() % 13) {
    case 0:
    case 1:
        rig.name = rand() % 2 ? text[0] : NULL;
        rig.extra = NULL;
        if (is_chain) {
            rig.chain.model = text[0];
            rig.chain.channels = &channel;
            rig.chain.channel_count = rand() % 2;
        } else {
            rig.model.model = text[1];
        }
        return edit_rig_add(document, &rig, error);
    case 2:
    case 3:
        return edit_rig_set(document, r, &rig, error);
    case 4:
        return edit_rig_remove(document, r, error);
    case 5:
        return edit_rig_name(document, r, text[0], error);
    case 6:
        return edit_channel(document, at, NULL, error);
    case 7:
        return edit_channel_add(document, r, spline, channel.axis, PART_TOTAL, error);
    case 8:
        return edit_angles(document, at, (enum angle_kind)(1 + rand() % 2), &angles, error);
    case 9:
        return edit_parameter(document, spline, PARAMETER_EQUILIBRIUM, &param, error);
    case 10:
        return edit_tail_add(document, r, spline, error);
    case 11:
        return edit_channel(document, at, &channel, error);
    default:
        return document->spline_count <= 6 && rand() % 2 ? edit_spline_copy(document, spline, error)
                                                         : edit_spline_move(document, spline, 0, error);
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
        assert_document(&world, printed);
        while (history_redo(world.history)) continue;
        assert_document(&world, last);
        world_close(&world);
    }
}
