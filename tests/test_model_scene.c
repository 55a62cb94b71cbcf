/// Imported characters and their chains in scene files: read, printed, refused, copied, and carried along when the scene is saved elsewhere.
#include "near.h"

#include "scene/edit.h"
#include "scene/load.h"
#include <stdlib.h>
#include <string.h>

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

static struct document *parse(const char *text)
{
    struct error error = {0};
    struct document *document = scene_parse("scene.json", text, strlen(text), NULL, &error);
    if (!document) fail_msg("%s", error.text);
    return document;
}

static void assert_prints(const struct document *document, const char *expected)
{
    size_t size;
    char *text = scene_print(document, &size);
    assert_string_equal(text, expected);
    free(text);
}

static void what_is_printed_is_read_again(void **state)
{
    (void)state;
    struct document *document = parse(whole);
    assert_prints(document, whole);
    const struct chain *chain = &document->rigs[TAIL].chain;
    assert_int_equal(document_find_model(document, chain->model, chain->by_file), WALK);
    assert_int_equal(chain->channels[1].axis, AXIS_TWIST);
    chain = &document->rigs[EAR].chain;
    assert_int_equal(document_find_model(document, chain->model, chain->by_file), CAT);
    assert_string_equal(rig_title(&document->rigs[CAT]), "models/cat.glb");
    assert_string_equal(rig_title(&document->rigs[EAR]), "ear");
    document_destroy(document);
}

static void a_file_may_leave_out_what_is_usual(void **state)
{
    (void)state;
    struct document *document =
        parse("{\"frames\": [0, 9], \"rigs\": [{\"type\": \"chain\", \"model\": \"a.glb\","
              " \"from\": \"b\", \"to\": \"b\"}, {\"type\": \"model\", \"model\": \"a.glb\"}]}");
    const struct model_rig *model = &document->rigs[1].model;
    assert_null(model->clip);
    assert_near(model->scale, 1, 0);
    assert_near(model->turn, 0, 0);
    assert_false(document->rigs[0].chain.mirror);
    assert_int_equal(rig_input_count(&document->rigs[0]), 0);
    document_destroy(document);
}

/// A copy of each kind of rig prints alike, and shares nothing with its original.
static void every_kind_of_rig_can_be_copied(void **state)
{
    (void)state;
    static const char character[] =
        "{\"frames\": [0, 9], \"splines\": [{\"name\": \"s\"}], \"rigs\": [{\"type\": \"character\", \"model\":"
        " \"a.glb\", \"paint\": \"a.npy\", \"coordinates\": [{\"name\": \"up\", \"spline\": \"s\"}]},"
        " {\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}";
    struct document *documents[] = {parse(whole), parse(character)};
    struct history *history = history_create();
    struct error error = {0};
    const struct edit paint = {.kind = EDIT_PAINT_NEW, .coordinates = 1, .vertices = 4};
    history_begin(history, "Paint", 0);
    assert_true(history_apply(history, documents[1], &paint, &error));
    history_end(history);
    documents[1]->rigs[0].character.painted->values[2][1] = 0.5f;
    for (int d = 0; d < 2; d++) {
        size_t size;
        char *text = scene_print(documents[d], &size);
        for (int r = 0; r < documents[d]->rig_count; r++) {
            struct rig *rig = &documents[d]->rigs[r], copy;
            const size_t bytes = rig_bytes(rig);
            assert_true(rig_copy(rig, &copy));
            assert_int_equal(rig_bytes(&copy), bytes);
            rig_release(rig);
            *rig = copy;
        }
        assert_prints(documents[d], text);
        free(text);
    }
    const struct character_rig *copied = &documents[1]->rigs[0].character;
    assert_near(copied->painted->values[2][1], 0.5, 0);
    history_destroy(history);
    for (int d = 0; d < 2; d++) document_destroy(documents[d]);
}

/// A chain that names its model by the file follows it; one that goes by the name keeps that.
static void paths_lead_to_the_same_models_from_another_folder(void **state)
{
    (void)state;
    struct document *document = parse(whole);
    document->folder = strdup("/films");
    assert_true(document_set_folder(document, "/films/new"));
    assert_string_equal(document->rigs[WALK].model.model, "../walk.glb");
    assert_string_equal(document->rigs[CAT].model.model, "../models/cat.glb");
    assert_string_equal(document->rigs[EAR].chain.model, "../models/cat.glb");
    assert_string_equal(document->rigs[TAIL].chain.model, "walk");
    const struct chain *ear = &document->rigs[EAR].chain;
    assert_int_equal(document_find_model(document, ear->model, ear->by_file), CAT);
    document_destroy(document);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_printed_is_read_again),
        cmocka_unit_test(a_file_may_leave_out_what_is_usual),
        cmocka_unit_test(every_kind_of_rig_can_be_copied),
        cmocka_unit_test(paths_lead_to_the_same_models_from_another_folder),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
