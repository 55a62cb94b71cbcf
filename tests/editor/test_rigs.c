/// Tails, characters and models come and go in the window, each as one step of the history.
#include "panel_session.h"
#include "rig/import.h"
#include <unistd.h>

static const char bear[] =
    "{\"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": [{\"frame\": 0, \"value\": 1}]}, {\"name\": "
    "\"t\", \"knots\": []}], \"rigs\": [{\"type\": \"character\", \"name\": \"bear\", \"model\": "
    "\"assets/models/creature.glb\", \"coordinates\": [{\"name\": \"up\", \"spline\": \"s\"}]}]}";

SESSION_TEST(test_the_menu_opens_by_its_key, panel_open(s, "{\"frames\": [0, 48], \"splines\": []}", 1280, 720))
{
    const char *before = session_saved(s);
    session_move(s, 300, 200);
    session_key(s, 'A', 0);
    float x, y;
    assert_true(widget_at(s->editor, "item.tail", &x, &y));
    assert_true(x > 300 && x < 600 && y > 200 && y < 260); // at the pointer
    session_key(s, KEY_ENTER, 0);
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 1);
    assert_int_equal(s->document->spline_count, 1); // that bends it
    assert_int_equal(s->document->splines[0]->knot_count, 1);
    assert_int_equal(document_tail(s->document, 0)->channels[0].spline, 0);
    assert_one_step(s, before);
    session_key(s, 'A', 0);
    assert_false(panel_shows(s, "item.chain")); // there are no bones
    session_key(s, KEY_ESCAPE, 0);
    session_move(s, 1100, 600); // over the inspector it opens there
    session_key(s, 'A', 0);
    panel_click(s, "item.tail");
    assert_int_equal(document_count_rigs(s->document, RIG_TAIL), 2);
    assert_true(document_tail(s->document, 1)->position[0].value > 1);
}

SESSION_TEST(test_a_second_bear_stands_beside_the_first, panel_open_models(s, bear))
{
    session_frame(s);
    const char *before = session_saved(s);
    session_key(s, 'A', 0);
    panel_click(s, "item.copy.0");
    session_frame(s);
    const struct character_rig *second = document_character(s->document, 1);
    assert_non_null(second);
    assert_true(second->position[0] > 0.5);
    assert_int_equal(second->drives[0].spline, 0);
    assert_int_equal(editor_stage(s->editor)->character_count, 2);
    assert_int_equal(s->editor->core.focus.characters.character, 1);
    assert_one_step(s, before);
}

SESSION_TEST(test_a_rig_goes_with_its_splines_or_without, panel_open_models(s, bear))
{
    const char *before = session_saved(s);
    session_key(s, KEY_DELETE, MOD_SHIFT);
    assert_int_equal(asked(s->editor), DIALOG_ASK);
    assert_non_null(strstr(dialog_of(s->editor)->question.title, "Remove bear"));
    session_key(s, KEY_ESCAPE, 0);
    assert_saved(s, before);
    session_key(s, KEY_DELETE, MOD_SHIFT);
    session_key(s, 'K', 0);
    assert_int_equal(s->document->rig_count, 0);
    assert_int_equal(s->document->spline_count, 2);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    session_key(s, KEY_DELETE, MOD_SHIFT);
    session_key(s, 'W', 0);
    assert_int_equal(s->document->rig_count, 0);
    assert_int_equal(s->document->spline_count, 1);
    assert_string_equal(s->document->splines[0]->name, "t");
    assert_one_step(s, before);
    session_key(s, KEY_DELETE, MOD_SHIFT);
    assert_said(s->editor, "nothing on the stage");
}

/// A model goes with the chains on it; what followed its joints keeps its place.
SESSION_TEST(test_a_model_goes_with_its_chains,
             panel_open_models(
                 s, "{\"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"equilibrium\": {\"model\": \"dog\", "
                    "\"joint\": \"hips\", \"of\": \"turn\"}, "
                    "\"knots\": []}, {\"name\": \"u\", \"knots\": []}], \"rigs\": [{\"type\": \"tail\", \"name\": "
                    "\"t\", \"spline\": \"s\"}, {\"type\": \"model\", \"name\": \"dog\", \"model\": "
                    "\"assets/models/dog.glb\"}, {\"type\": \"chain\", \"name\": \"ear\", \"model\": \"dog\", "
                    "\"from\": \"ear_1_L\", \"to\": \"ear_2_L\", \"channels\": [{\"spline\": \"u\"}]}]}"))
{
    const char *before = session_saved(s);
    panel_click(s, "model.0");
    panel_click(s, "rig.copy"); // with its chain
    assert_int_equal(document_count_rigs(s->document, RIG_CHAIN), 2);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    panel_click(s, "model.0");
    panel_click(s, "rig.delete");
    session_key(s, 'W', 0);
    assert_int_equal(s->document->rig_count, 1);
    assert_int_equal(s->document->spline_count, 1);
    assert_null(s->document->splines[0]->parameter[PARAMETER_EQUILIBRIUM].motion);
    assert_one_step(s, before);
}

/// A chain goes, too, where its own spline follows a joint by the chain's axes, as Shift+J makes it.
SESSION_TEST(test_a_chain_goes_with_its_splines,
             panel_open_models(
                 s, "{\"frames\": [0, 48], \"splines\": [{\"name\": \"u\", \"equilibrium\": {\"model\": \"dog\", "
                    "\"joint\": \"hips\", \"of\": \"across\", \"chain\": \"ear\"}, \"knots\": []}], \"rigs\": ["
                    "{\"type\": \"model\", \"name\": \"dog\", \"model\": \"assets/models/dog.glb\"}, {\"type\": "
                    "\"chain\", \"name\": \"ear\", \"model\": \"dog\", \"from\": \"ear_1_L\", \"to\": \"ear_2_L\", "
                    "\"channels\": [{\"spline\": \"u\"}]}]}"))
{
    const char *before = session_saved(s);
    for (int keep = 0; keep < 2; keep++) {
        session_key(s, KEY_DELETE, MOD_SHIFT);
        session_key(s, keep ? 'K' : 'W', 0);
        assert_int_equal(s->document->rig_count, 1);
        assert_int_equal(s->document->spline_count, keep);
        assert_one_step(s, before);
        session_key(s, 'Z', MOD_CTRL);
    }
}

/// The file dialog asks the app for it; a bad file leaves a sentence and the document as it was.
SESSION_TEST(test_a_file_is_asked_for, panel_open(s, "{\"frames\": [0, 48], \"splines\": []}", 1280, 720))
{
    session_asked(s);
    const char *before = session_saved(s);
    session_key(s, 'A', 0);
    panel_click(s, "item.file");
    assert_int_equal(asked(s->editor), DIALOG_ADD);
    session_type(s, "no.glb");
    session_key(s, KEY_ENTER, 0);
    const struct request request = session_asked(s);
    assert_int_equal(request.kind, REQUEST_ADD);
    assert_string_equal(request.path, "no.glb");
    panel_answer(s, REQUEST_ADD, false, "no.glb: cannot be read");
    assert_string_equal(asked_error(s->editor), "no.glb: cannot be read");
    assert_saved(s, before);
}

TEST(test_files_are_told_apart)
{
    struct document *document = document_create();
    assert_done(import_add(document, "assets/models/creature.glb", -1, &error));
    assert_done(import_add(document, "assets/models/dog.glb", 0, &error));
    assert_done(import_add(document, "assets/models/creature.glb", 0, &error));
    assert_refusal(import_add(document, "Makefile", 0, &error), "Makefile");
    assert_int_equal(document_count_rigs(document, RIG_CHARACTER), 2);
    assert_int_equal(document_count_rigs(document, RIG_MODEL), 1);
    assert_int_equal(document->spline_count, 1);
    assert_string_equal(document->rigs[2]->name, "creature 2");
    document_destroy(document);
}

/// A .glb by another name is one, too; anything else is not.
TEST(test_a_glb_is_told_by_its_beginning)
{
    char path[] = "/tmp/wiggly-test-XXXXXX", command[128];
    close(mkstemp(path));
    snprintf(command, sizeof command, "cp assets/models/dog.glb %s", path);
    assert_int_equal(system(command), 0);
    assert_true(import_suits(path));
    assert_false(import_suits("Makefile"));
    assert_false(import_suits("/tmp/there-is-none"));
    struct document *document;
    assert_done(document = import_scene(path, &error));
    assert_int_equal(document->rigs[0]->kind, RIG_MODEL);
    assert_near(document->fps, 24, 0);
    document_destroy(document);
    unlink(path);
}
