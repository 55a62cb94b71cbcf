/// The inspector's section on a character, by mouse and keys; and the stage that shows what it says.
#include "folder.h"
#include "panel_session.h"
#include "puppet.h"

static const char *model(void) { return folder_path("puppet.glb"); }

static int make_model(void **state)
{
    if (folder_make(state) != 0) return -1;
    struct character character = puppet_character(0.1f, 3);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[0].re[i][1] = 0.2f;
        character.coordinates[1].im[i][0] = 0.3f;
    }
    character.coordinates[0].frequency = 1.25;
    puppet_write(&character, model());
    return 0;
}

static void open_puppet(struct session *s)
{
    char scene[600];
    snprintf(scene, sizeof scene,
             "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": "
             "[{\"frame\": 0, \"value\": 1}, {\"frame\": 20, \"value\": -1}]}, {\"name\": \"t\", \"knots\": "
             "[{\"frame\": 9, \"value\": 2}]}], \"rigs\": [{\"type\": \"character\", \"model\": \"%s\", "
             "\"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}]}",
             model());
    panel_open_models(s, scene);
    session_frame(s);
}

/// Of several rigs the character's own is edited, whichever comes first.
TEST(a_character_behind_a_tail_is_edited)
{
    struct session s;
    char scene[600];
    snprintf(
        scene, sizeof scene,
        "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}], \"rigs\": ["
        "{\"type\": \"tail\", \"name\": \"tail\", \"channels\": []}, {\"type\": \"character\", \"model\": \"%s\", "
        "\"coordinates\": [{\"name\": \"a\", \"spline\": \"s\"}]}]}",
        model());
    panel_open_models(&s, scene);
    session_frame(&s);
    panel_enter(&s, "drive.lag", "90");
    assert_near(document_character(s.document, 0)->drives[0].lag, 90, 0);
    session_close(&s);
}

/// Both coordinates are one limb, until one spline is chosen.
TEST(a_lag_is_the_characters)
{
    struct session s;
    char scene[600];
    snprintf(
        scene, sizeof scene,
        "{\"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"knots\": []}, {\"name\": \"t\", \"knots\": []}], "
        "\"rigs\": [{\"type\": \"character\", \"model\": \"%s\", \"coordinates\": [{\"name\": \"a\", \"spline\": "
        "\"s\", \"lag\": 20}, {\"name\": \"b\", \"spline\": \"t\", \"lag\": 30}]}]}",
        model());
    panel_open_models(&s, scene);
    session_frame(&s);
    panel_enter(&s, "drive.lag", "40");
    assert_near(document_character(s.document, 0)->drives[0].lag, 40, 0);
    assert_near(document_character(s.document, 0)->drives[1].lag, 60, 0);
    panel_click(&s, "spline.t");
    panel_enter(&s, "drive.lag", "15");
    assert_near(document_character(s.document, 0)->drives[0].lag, 40, 0);
    assert_near(document_character(s.document, 0)->drives[1].lag, 15, 0);
    session_close(&s);
}

static const struct stage_character *on_stage(const struct session *s, int index)
{
    const struct stage_view *view = editor_stage(s->editor);
    assert_true(index < view->character_count);
    return &view->characters[index];
}

#define PUPPET_TEST(name) SESSION_TEST(name, open_puppet(s))

PUPPET_TEST(amplitude_and_lag_are_live_and_one_step_each)
{
    const float before = on_stage(s, 0)->morph.weight[0][0];
    panel_drag(s, "amplitude", 1.5);
    assert_true(fabs(document_character(s->document, 0)->drives[0].amplitude - 1.5) < 0.05);
    assert_near((double)on_stage(s, 0)->morph.weight[0][0],
                (double)before * document_character(s->document, 0)->drives[0].amplitude, 1e-4);
    panel_release(s);
    panel_enter(s, "drive.lag", "90");
    assert_near(document_character(s->document, 0)->drives[0].lag, 90, 0);
    assert_true(history_undo(s->history));
    assert_near(document_character(s->document, 0)->drives[0].lag, 0, 0);
    assert_true(history_undo(s->history));
    assert_near(document_character(s->document, 0)->drives[0].amplitude, 1, 0);
    assert_false(history_undo(s->history));
}

PUPPET_TEST(coordinates_come_and_go_and_change_their_spline)
{
    panel_click(s, "drive.add.0");
    panel_click(s, "item.b");
    assert_int_equal(document_character(s->document, 0)->drive_count, 2);
    assert_string_equal(document_character(s->document, 0)->drives[1].name, "b");
    panel_click(s, "drive.1");
    panel_click(s, "drive.splines.0");
    panel_click(s, "item.t");
    assert_int_equal(document_character(s->document, 0)->drives[1].spline, 1);
    assert_int_equal(document_character(s->document, 0)->drives[0].spline, 0);
    assert_int_equal(on_stage(s, 0)->morph.count, 2);
    panel_click(s, "drive.0.remove");
    assert_int_equal(document_character(s->document, 0)->drive_count, 1);
    assert_string_equal(document_character(s->document, 0)->drives[0].name, "b");
    while (history_undo(s->history)) continue;
    assert_int_equal(document_character(s->document, 0)->drive_count, 1);
    assert_string_equal(document_character(s->document, 0)->drives[0].name, "a");
}

PUPPET_TEST(phases_and_twin_are_views)
{
    assert_int_equal(on_stage(s, 0)->map_coordinate, -1);
    panel_click(s, "phases.z");
    session_frame(s);
    assert_int_equal(on_stage(s, 0)->map_coordinate, 0);
    assert_int_equal(on_stage(s, 0)->map_axis, 2);
    panel_click(s, "twin.on");
    session_frame(s);
    assert_int_equal(editor_stage(s->editor)->character_count, 2);
    assert_true(on_stage(s, 0)->coarse && on_stage(s, 1)->coarse);
    assert_true(on_stage(s, 1)->position[0] - on_stage(s, 0)->position[0] > 1.0f);
    assert_near((double)on_stage(s, 1)->morph.weight[0][1], 0, 0);
    assert_true(history_is_saved(s->history) || history_undo_label(s->history) == NULL);
}

PUPPET_TEST(the_look_is_stiff_for_characters_too)
{
    session_key(s, KEY_RIGHT, 0);
    assert_true(fabsf(on_stage(s, 0)->morph.weight[0][1]) > 1e-3f);
    session_key(s, 'V', 0);
    assert_near((double)on_stage(s, 0)->morph.weight[0][1], 0, 0);
}

TESTS_BETWEEN(make_model, folder_remove)
