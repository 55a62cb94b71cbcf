/// Splines of thousands of knots: which are selected, and how they are drawn.
#include "editor/core/knots.h"
#include "five_knots.h"
#include "panel_session.h"
#include "shown.h"

enum { CROWD = 30000 };

/// A spline of so many knots, and another of two before it.
static void open_crowd(struct session *s, int knots)
{
    const size_t room = 256 + (size_t)knots * 40;
    char *scene = malloc(room);
    assert_non_null(scene);
    size_t at = (size_t)sprintf(scene,
                                "{\"wiggly\": 1, \"frames\": [0, %d], \"splines\": [{\"name\": \"few\", \"knots\": "
                                "[{\"frame\": 3, \"value\": 2}, {\"frame\": 9, \"value\": 1}]}, {\"name\": \"many\", "
                                "\"mode\": \"cubic\", \"knots\": [",
                                knots);
    for (int k = 0; k < knots; k++)
        at += (size_t)sprintf(scene + at, "%s{\"frame\": %d, \"value\": %d}", k ? "," : "", k, k * 7919 % 1009);
    strcpy(scene + at, "]}]}");
    panel_open(s, scene, 1280, 900);
    activate(s->editor, 1);
    free(scene);
}

/// By a look at all of them.
static void assert_walked(struct session *s)
{
    struct core *core = &s->editor->core;
    int expected = 0;
    session_frame(s);
    struct knot_place at = SELECTED_START;
    for (int of = 0; of < s->document->spline_count; of++) {
        for (int k = 0; k < spline(s, of)->knot_count; k++) {
            if (!selection_has(&core->focus.selection, spline(s, of)->knots[k].id)) continue;
            expected++;
            assert_true(selected_next(core, &at));
            assert_int_equal(at.spline, of);
            assert_int_equal(at.knot, k);
        }
    }
    assert_false(selected_next(core, &at));
    assert_int_equal(selected_count(core), expected);
}

SESSION_TEST(edits_and_selections_are_found, open_crowd(s, CROWD))
{
    struct core *core = &s->editor->core;
    assert_walked(s);
    selection_set(&core->focus.selection, spline(s, 1)->knots[CROWD - 1].id, true);
    assert_walked(s);
    session_key(s, KEY_UP, 0); // its value
    assert_walked(s);
    selection_set(&core->focus.selection, spline(s, 1)->knots[100].id, true);
    selection_set(&core->focus.selection, spline(s, 0)->knots[1].id, true);
    assert_walked(s);
    core_activate(core, 0);
    assert_walked(s);
    core_activate(core, 1);
    selection_set(&core->focus.selection, spline(s, 1)->knots[100].id, true);
    core_delete(core, 0); // indices move
    assert_true(spline(s, 1)->knot_count < CROWD);
    assert_walked(s);
    session_key(s, 'Z', MOD_CTRL);
    assert_walked(s);
    session_key(s, 'A', MOD_CTRL);
    assert_walked(s);
}

/// While a knot is dragged past others, and after.
SESSION_TEST(a_drag_is_found, open_crowd(s, 300))
{
    session_pull(s, "knot(many,150)", 5, 5, 2);
    for (int i = 0; i < 30; i++) {
        session_drag(s, i < 20 ? 7 : -21, i % 2 ? 30 : -28, 1);
        assert_walked(s);
    }
    assert_true(selected(s->editor) == 1);
    session_release(s, BUTTON_LEFT);
    assert_walked(s);
    session_key(s, 'Z', MOD_CTRL);
    assert_walked(s);
}

/// Of a crowd each pixel column shows one knot, and the highest and lowest value are reached by its stroke.
SESSION_TEST(a_crowd_is_drawn_as_columns, open_crowd(s, CROWD))
{
    session_frame(s);
    const int few = drawn_by(s->editor)->point_count;
    session_close(s);
    open_crowd(s, 3 * CROWD);
    session_frame(s);
    const int many = drawn_by(s->editor)->point_count;
    assert_true(many < few + few / 4);
}
