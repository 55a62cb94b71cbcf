/// Flesh that the app makes: the character swings on its bones, all else of the scene stays, and it is one step to undo.
#include "base/child.h"
#include "beast.h"
#include "blind.h"
#include "commands/commands.h"
#include "folder.h"
#include "questions.h"
#include "scene/load.h"
#include "shown.h"
#include <unistd.h>

TESTS_BETWEEN(folder_make, folder_remove)

/// The app runs its own program for it, which is this one.
__attribute__((constructor)) static void be_wiggly(int argc, char **argv)
{
    char *words[32] = {NULL};
    if (argc < 2 || argc > 20 || strcmp(argv[1], "flesh") != 0) return;
    for (int i = 1; i < argc; i++) words[i - 1] = argv[i];
    char *const quick[] = {"--tets", "100", "--substeps", "2", "--modes", "2"};
    memcpy(words + argc - 1, quick, sizeof quick);
    exit(command_flesh(argc - 1 + 6, words));
}

/// A rig without a name, to which a chain and its spline refer by its file.
static const char scene[] = "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"wag\", \"frequency\": "
                            "2, \"equilibrium\": {\"model\": "
                            "\"beast.glb\", \"joint\": \"hips\", \"of\": \"across\"}, \"knots\": []}], \"rigs\": "
                            "[{\"type\": \"model\", \"model\": "
                            "\"beast.glb\", \"clip\": \"Walk\"}, {\"type\": \"chain\", \"name\": \"ear\", \"model\": "
                            "\"beast.glb\", \"from\": "
                            "\"ear_L_1\", \"to\": \"ear_L_2\", \"channels\": [{\"spline\": \"wag\"}]}]}";

static void open_beast(struct blind *b)
{
    folder_run("rm -rf %s && mkdir %s");
    assert_true(beast_write(folder_path("beast.glb")));
    blind_open(b, folder_file("walk.json", scene));
    blind_frame(b);
}

#define BEAST_TEST(name) TEST_OF(struct blind, b, open_beast(b), blind_close(b), name)

static struct editor *e(const struct blind *b) { return b->app.work.editor; }
static const struct model_rig *beast(const struct blind *b) { return &b->app.work.document->rigs[0]->model; }
static bool is_there(const char *name) { return access(folder_path(name), F_OK) == 0; }

static void ask(struct blind *b, const char *bone)
{
    core_request(&e(b)->core, &(struct request){.kind = REQUEST_FLESH, .number = 0, .text = bone});
}

BEAST_TEST(it_hangs_on_its_bone_and_all_else_stays)
{
    ask(b, "spine");
    blind_frames(b, 2);
    assert_said(e(b), "Made flesh: 2 channels of beast-flesh.glb, in beast-flesh.glb.");
    for (int reads = 0; reads < 2; reads++) { // as it was made, and as it was saved
        const struct document *document = b->app.work.document;
        assert_string_equal(beast(b)->model, "beast-flesh.glb");
        assert_string_equal(beast(b)->clip, "Walk");
        assert_int_equal(beast(b)->drive_count, 2);
        assert_int_equal(document->spline_count, 3);
        assert_int_equal(document_next_chain(document, 0, -1), 1);
        assert_true(document_follows(document, 0, 0));
        const struct joint_motion *motion = document->splines[1]->parameter[PARAMETER_EQUILIBRIUM].motion;
        assert_string_equal(motion->joint, "spine");
        assert_int_equal(motion->of, MOTION_BASE);
        assert_int_equal(beast(b)->drives[0].spline, 1);
        blind_keys(b, "^S");
        if (reads == 0) assert_done(app_open(&b->app, folder_path("walk.json"), &error));
        blind_frame(b);
    }
}

BEAST_TEST(undo_takes_it_back_at_once)
{
    ask(b, "spine");
    blind_frames(b, 2);
    blind_keys(b, "^Z");
    assert_string_equal(beast(b)->model, "beast.glb");
    assert_int_equal(b->app.work.document->spline_count, 1);
    blind_keys(b, "^+Z");
    assert_string_equal(beast(b)->model, "beast-flesh.glb");
}

/// Where the amplitude is raised, a part of its own is made, and the paint that chose it goes; the rest stays.
BEAST_TEST(paint_chooses_the_part)
{
    enum { VERTICES = 8 * BEAST_BONES };
    static int vertices[VERTICES];
    static float values[VERTICES][2];
    struct document *document = b->app.work.document;
    ask(b, "spine");
    blind_frames(b, 2);
    for (int v = 0; v < VERTICES; v++) {
        vertices[v] = v;
        values[v][0] = v / 8 == 1 ? 1 : -0.5f;
        values[v][1] = 0.25f;
    }
    assert_done(edit_paint_new(document, 0, 2, VERTICES, &error));
    assert_done(edit_paint(document, 0, &(struct dab){1, VERTICES, vertices, (const float(*)[2])values}, &error));
    ask(b, NULL);
    blind_frames(b, 2);
    assert_said(e(b), "in beast-flesh-2.glb.");
    assert_true(is_there("beast-flesh.glb"));
    const struct paint *paint = beast(b)->painted;
    assert_true(paint->coordinates > 2);
    for (int n = 0; n < paint->coordinates * VERTICES; n++) {
        const bool painted = n / VERTICES == 1;
        assert_near(paint->values[n][0], painted && n % VERTICES / 8 != 1 ? -0.5 : 0, 0);
        assert_near(paint->values[n][1], painted ? 0.25 : 0, 0);
    }
    const struct figure *figure = models_figure(b->app.work.models, document, 0);
    for (int v = 0; v < VERTICES; v++) {
        const float *way = figure->character.coordinates[2].re[v];
        if (v / 8 != 1 && (way[0] != 0 || way[1] != 0 || way[2] != 0)) fail_msg("vertex %d moves", v);
    }
}

BEAST_TEST(asked_again_it_stops_and_leaves_nothing)
{
    ask(b, "spine");
    ask(b, "spine");
    assert_said(e(b), "Stopped. Nothing was written.");
    blind_frames(b, 2);
    assert_string_equal(beast(b)->model, "beast.glb");
    assert_false(is_there("beast-flesh.glb"));
}

/// Where it is stopped while it writes, it removes that first; one that does not listen ends, too.
TEST(a_child_that_is_ended_may_tidy_up)
{
    static const char *const shells[] = {"trap 'rm half; exit 1' TERM; touch half; while :; do sleep 0.01; done",
                                         "trap '' TERM; touch half; while :; do sleep 0.01; done"};
    folder_run("rm -rf %s && mkdir %s");
    for (int row = 0; row < 2; row++) {
        char line[256];
        struct child child;
        snprintf(line, sizeof line, "cd %s; %s", folder, shells[row]);
        char *const words[] = {"sh", "-c", line, NULL};
        assert_int_equal(child_start(&child, words, -1, -1), 0);
        for (int i = 0; i < 1000 && !is_there("half"); i++) assert_int_equal(child_state(&child, 10), CHILD_RUNS);
        child_end(&child);
        assert_int_equal(is_there("half"), row);
        assert_int_equal(child.process, 0);
    }
}

BEAST_TEST(what_went_wrong_is_said)
{
    struct document *document = b->app.work.document;
    ask(b, "wing"); // the file was changed meanwhile
    blind_frames(b, 2);
    assert_said(e(b), "beast.glb: expected a bone for --part, got \"wing\"");
    ask(b, "spine");
    folder_run("cp %s/beast.glb %s/other.glb");
    assert_done(edit_model_file(document, 0, "other.glb", &error));
    blind_frames(b, 2);
    assert_said(e(b), "but its character is no longer here.");
    document_set_path(document, NULL);
    ask(b, NULL);
    assert_said(e(b), "Save the scene first: flesh is written beside it.");
}
