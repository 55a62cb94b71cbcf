/// Characters in scene files: read, printed, edited and carried along when the scene is saved elsewhere.
#include "documents.h"
#include "folder.h"

#include "base/file.h"
#include "scene/edit.h"
#include "scene/history.h"
#include <sys/stat.h>

#define SPLINES "\"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": []}, {\"name\": \"t\", \"knots\": []}]"
#define SCENE(rig) "{\"wiggly\": 1, \"frames\": [0, 48],\n" SPLINES ",\n\"rigs\": [" rig "]}"

static const char whole[] = SCENE(
    "{\"type\": \"character\", \"model\": \"../models/a.glb\", \"glow\": 3, \"coordinates\": [{\"name\": \"up\","
    " \"spline\": \"s\", \"amplitude\": 0.5, \"lag\": 30, \"tint\": \"red\"}, {\"name\": \"side\", \"spline\":"
    " \"t\"}], \"paint\": \"a.npy\"}, {\"type\": \"tail\", \"name\": \"tail\"}");

TEST(a_character_is_read)
{
    struct document *document = document_of_text(whole);
    assert_int_equal(document_count_rigs(document, RIG_CHARACTER), 1);
    assert_int_equal(document_count_rigs(document, RIG_TAIL), 1);
    const struct character_rig *rig = document_character(document, 0);
    assert_string_equal(rig->model, "../models/a.glb");
    assert_string_equal(rig->paint_file, "a.npy");
    assert_int_equal(rig->drive_count, 2);
    assert_string_equal(rig->drives[0].name, "up");
    assert_near(rig->drives[0].amplitude, 0.5, 0);
    assert_near(rig->drives[0].lag, 30, 0);
    assert_int_equal(rig->drives[1].spline, 1);
    assert_near(rig->drives[1].amplitude, 1, 0);
    assert_near(rig->drives[1].lag, 0, 0);
    document_destroy(document);
}

/// The order of the rigs and what the file says beyond what we know are kept, and printing is stable.
TEST(it_is_printed_as_it_was_read)
{
    struct document *document = document_of_text(whole);
    char *text = text_of_document(document);
    assert_true(strstr(text, "\"character\"") < strstr(text, "\"tail\""));
    assert_non_null(strstr(text, "\"model\": \"../models/a.glb\""));
    assert_non_null(strstr(text, "\"lag\": 30, \"tint\": \"red\" }"));
    assert_non_null(strstr(text, "\"paint\": \"a.npy\",\n      \"glow\": 3"));
    assert_loads_again(document);
    free(text);
    document_destroy(document);
}

/// The document of a step that opens; and its end, after an edit that must be possible.
static struct document *begin(struct history *history, struct document *document)
{
    history_begin(history, "Edit", 0);
    return document;
}

static void end(struct history *history, bool done)
{
    assert_true(done);
    history_end(history);
}

TEST(edits_are_undone_to_the_byte)
{
    struct document *document = document_of_text(whole);
    struct history *history = history_create(document);
    char *before = text_of_document(document), twist[] = "twist";
    end(history, edit_drive(begin(history, document), 0, 0,
                            &(const struct drive){.spline = 1, .amplitude = -2, .lag = 45}, NULL));
    end(history, edit_drive(begin(history, document), 0, -1,
                            &(const struct drive){.name = twist, .spline = 0, .amplitude = 1}, NULL));
    end(history, edit_drive_remove(begin(history, document), 0, 0, NULL));
    const struct character_rig *rig = document_character(document, 0);
    assert_int_equal(rig->drive_count, 2);
    assert_string_equal(rig->drives[0].name, "side");
    assert_string_equal(rig->drives[1].name, "twist");
    char *after = text_of_document(document);
    while (history_undo(history)) continue;
    assert_prints(document, before);
    while (history_redo(history)) continue;
    assert_prints(document, after);
    free(before);
    free(after);
    history_destroy(history);
    document_destroy(document);
}

/// Where the rigs' types begin in a scene's text, as "tct": tails and characters in their order.
static void assert_order(const struct document *document, const char *order)
{
    char *text = text_of_document(document);
    const char *at = text;
    for (; *order; order++) {
        at = strstr(at, "\"type\": ");
        assert_non_null(at);
        at += strlen("\"type\": \"");
        assert_int_equal(*at, *order);
    }
    assert_null(strstr(at, "\"type\": "));
    free(text);
}

/// Tails come and go before and behind a character, which keeps its place in the file and what moves it.
TEST(rigs_keep_their_order)
{
    struct document *document =
        document_of_text(SCENE("{\"type\": \"tail\", \"name\": \"a\"}, {\"type\": \"character\", \"model\":"
                               " \"a.glb\"}, {\"type\": \"tail\", \"name\": \"b\"}"));
    struct history *history = history_create(document);
    assert_order(document, "tct");
    end(history, edit_tail_add(begin(history, document), 2, 0, NULL));
    assert_order(document, "tctt");
    end(history, edit_rig_remove(begin(history, document), 0, NULL));
    assert_order(document, "ctt");
    const struct drive drive = {.name = "up", .spline = 1, .amplitude = 1};
    end(history, edit_drive(begin(history, document), 0, -1, &drive, NULL));
    end(history, edit_rig_remove(begin(history, document), 1, NULL));
    assert_order(document, "ct");
    assert_string_equal(document->rigs[1]->name, "tail");
    while (history_undo(history)) continue;
    assert_order(document, "tct");
    assert_int_equal(document_character(document, 0)->drive_count, 0);
    while (history_redo(history)) continue;
    assert_order(document, "ct");
    assert_int_equal(document_character(document, 0)->drive_count, 1);
    history_destroy(history);
    document_destroy(document);
}

TEST(impossible_edits_are_refused)
{
    struct document *document = document_of_text(whole);
    struct history *history = history_create(document);
    const struct drive good = {.amplitude = 1}, other = {.spline = 2}, endless = {.amplitude = (double)INFINITY};
    struct error error = {0};
    history_begin(history, "Edit", 0);
    assert_false(edit_drive(document, 1, 0, &good, &error));
    assert_string_equal(error.text, "there is no such character");
    assert_false(edit_drive(document, 0, 2, &good, &error));
    assert_string_equal(error.text, "this character has no such coordinate");
    assert_false(edit_drive(document, 0, 0, &other, &error));
    assert_string_equal(error.text, "../models/a.glb: there is no such spline");
    assert_false(edit_drive(document, 0, 0, &endless, &error));
    assert_string_equal(error.text, "../models/a.glb: the amplitude must be finite");
    assert_false(edit_drive(document, 0, -1, &good, &error));
    assert_string_equal(error.text, "../models/a.glb: \"name\" must not be empty");
    assert_false(edit_drive_remove(document, 0, -1, &error));
    assert_string_equal(error.text, "this character has no such coordinate");
    history_end(history);
    assert_true(history_is_saved(history) || history_undo_label(history) == NULL);
    history_destroy(history);
    document_destroy(document);
}

/// Splines move in their list, and what moves the character goes with them; one that moves it stays.
TEST(drives_follow_their_splines)
{
    struct document *document = document_of_text(whole);
    struct history *history = history_create(document);
    end(history, edit_spline_move(begin(history, document), 0, 1, NULL));
    assert_int_equal(document_character(document, 0)->drives[0].spline, 1);
    assert_int_equal(document_character(document, 0)->drives[1].spline, 0);
    struct error error = {0};
    history_begin(history, "Remove", 0);
    assert_false(edit_spline_remove(document, 0, &error));
    history_end(history);
    history_destroy(history);
    document_destroy(document);
}

TEST(paths_are_rebased)
{
    static const struct {
        const char *path, *from, *to, *moved;
    } cases[] = {
        {"a.glb", "/x/y", "/x/y/z", "../a.glb"},    {"a.glb", "/x/y", "/x", "y/a.glb"},
        {"../m/a.glb", "/x/y", "/", "x/m/a.glb"},   {"a.glb", "/x/yy", "/x/y", "../yy/a.glb"},
        {"./b/../a.glb", "/x", "/y", "../x/a.glb"},
    };
    char moved[PATH_LIMIT];
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_true(path_rebase(cases[i].path, cases[i].from, cases[i].to, moved));
        assert_string_equal(moved, cases[i].moved);
    }
    assert_false(path_rebase("/x/a.glb", "/x", "/y", moved));
    assert_false(path_rebase("a.glb", "/x", "/x", moved));
    assert_false(path_rebase("a.glb", "/x/", "/x", moved));
}

/// "Save as" into another folder: the file there leads to the same model; the document that goes on keeps its folder.
TEST_WITH(folder_make, folder_remove, a_scene_saved_elsewhere_finds_its_model)
{
    char absolute[PATH_LIMIT];
    const char *path = folder_path("deeper/scene.json");
    assert_int_equal(mkdir(folder_path("deeper"), 0777), 0);
    struct document *document = document_of_text(whole);
    document->folder = strdup(folder);
    free(document_character(document, 0)->model);
    document_character(document, 0)->model = strdup("models/a.glb");
    assert_done(scene_save(document, path, &error));
    assert_string_equal(document_character(document, 0)->model, "models/a.glb");
    struct document *loaded = document_of_file(path);
    assert_string_equal(document_character(loaded, 0)->model, "../models/a.glb");
    assert_true(path_resolve(loaded->folder, document_character(loaded, 0)->model, absolute));
    assert_string_equal(absolute, folder_path("models/a.glb"));
    document_destroy(document);
    document_destroy(loaded);
}
