/// Knots by hand: inserted, selected, dragged, nudged, scaled and sloped, of one curve and of several, in the plot, in the dope sheet and on the
/// clipboard.
#include "five_knots.h"
#include "hands.h"
#include "scene/load.h"

static const char SWAY[] =
    "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': [<0 0>, "
    "<12 1>, <24 -1>, <36 0.5>]}, {'name': 'up', 'mode': 'cubic', 'knots': [<6 0.25>]}]}";

WALK(a_double_click_inserts_at_the_pointer, session_open(s, SWAY),
     "click curve(sway,30,1.1); again; sway.frame 0 12 24 30 36; sway.3.value 1.1 ~1e-5;"
     "sway@30 sway.3.value ~0; key Ctrl+Z; sway.knots 4") // hit exactly, in the same frame

WALK(a_knot_at_the_playhead_keeps_the_curve, session_open(s, SWAY),
     "keep; click ruler(30); key I; sway.frame 0 12 24 30 36; sway.3.posed 0; steady 1e-7; key P; sway.3.posed 1")

WALK(a_drag_is_one_step_and_snaps, session_open(s, SWAY),
     "keep; pull knot(sway,1) 2.3f -20 8; sway.1.frame 14;" // already while dragging
     "release; sway.1.frame 14; sway.1.value > 1.05; once; key Ctrl+Z; label")

SESSION_TEST(modifiers_of_a_drag, session_open(s, SWAY))
{
    hands(s, "press knot(sway,1); with Ctrl; drag 2.25f 0; sway.1.frame 14.25 ~1e-4;" // no snap
             "with; key Y; drag 3f -30; sway.1.frame 12; sway.1.value > 1.05;"        // locked to its frame
             "key X; wait 1; sway.1.value 1 ~0; with Shift; key X");                  // and to its value
    const double before = spline(s, 0)->knots[1].value;
    hands(s, "drag 0 -100");
    const double fine = spline(s, 0)->knots[1].value - before;
    hands(s, "with; drag 0 -100");
    assert_near((spline(s, 0)->knots[1].value - before - fine) / fine, 10, 0.01);
}

/// 24 is taken: it waits in front, and then is past it.
WALK(a_drag_passes_through_an_occupied_frame, session_open(s, SWAY),
     "pull knot(sway,1) 11f 0 11; sway.frame 0 23 24 36; drag 1f 0 1; sway.frame 0 23 24 36;"
     "drag 1f 0 1; sway.frame 0 24 25 36; sway.value 0 -1 1 0.5; release; sway.knots 4")

WALK(a_group_keeps_its_shape_and_stays_inside, session_open(s, SWAY),
     "key Ctrl+A; press knot(sway,2); key X; drag 3000 0 6; release; sway.frame 12 24 36 48; sway.value 0 1 -1 0.5")

WALK(escape_cancels_a_drag_then_drops_the_selection, session_open(s, SWAY),
     "keep; pull knot(sway,1) 60 -20 5; key Escape; kept; open 0; label; drag 60 -20 5; release; kept;"
     "key Escape; key Delete; kept") // nothing is selected any more

SESSION_TEST(a_click_edits_nothing, session_open(s, SWAY))
{
    const uint64_t revision = history_revision(s->history);
    hands(s, "click knot(sway,1); carry knot(sway,2) 1 1 2"); // a hand that trembles
    assert_true(history_revision(s->history) == revision);
}

/// What was undone is said until the next edit, not beside what that has made.
SESSION_TEST(an_edit_ends_the_message_of_an_undo, session_open(s, SWAY))
{
    static const char *const edits[] = {"carry knot(sway,1) 0 30", "key Alt+Up", "carry slider(frequency) 9 0"};
    for (int i = 0; i < 3; i++)
        hands(s, "carry knot(sway,2) 0 -20; key Ctrl+Z; says Undone: Move knot; %s; said", edits[i]);
}

WALK(clicks_and_keys_select, session_open(s, SWAY),
     "click knot(sway,1); with Shift; click knot(sway,2); click knot(sway,3); click knot(sway,3);" // taken out again
     "with; key Delete; sway.frame 0 36; sway.1.value 0.5; key Ctrl+Z; click knot(sway,1); type .;"
     "key Backspace; sway.frame 0 12 36; sway.2.value 0.5; key PageDown Ctrl+A Delete; up.knots 0; sway.knots 3")

/// One run is one step, another selection another one.
WALK(
    nudges_merge, session_open(s, SWAY),
    "keep; click knot(sway,1); key 3*Alt+Right; sway.1.frame 15; key Ctrl+Alt+Right; sway.1.frame 15.1; key Ctrl+Z;"
    "kept; click knot(sway,1); key Alt+Up; click knot(sway,2); key Alt+Up Ctrl+Z; sway.1.value > 1; key Ctrl+Z; kept")

WALK(a_nudge_passes_through, session_open(s, SWAY),
     "click knot(sway,2); key Alt+Shift+Right; sway.2.frame 34; key 2*Alt+Right; sway.frame 0 12 36 37;"
     "sway.3.value -1")

SESSION_TEST(a_slope_is_set_by_keys_and_its_handle, session_open(s, SWAY))
{
    hands(s, "click knot(sway,1); key T; sway.1.sloped 1");
    const double slope = spline(s, 0)->knots[1].slope;
    hands(s,
          "key E; sway.1.slope > %.17g; key D; sway.1.slope %.17g; key Shift+E; sway.1.stiffness 1250;"
          "carry handle(sway,1,1) 0 -60 5; sway.1.slope > %.17g; sway.1.value 1; key Ctrl+Z; sway.1.slope %.17g;"
          "key T; sway.1.sloped 0",
          slope, slope, slope + 0.1, slope);
}

/// However long the keys are held, a stiffness stays one that a scene may have.
WALK(stiffness_stays_in_range, session_open(s, SWAY),
     "click knot(sway,1); key 80*Shift+E; sway.1.stiffness 1e9 ~0; key 160*Shift+D; sway.1.stiffness 1e-3 ~0")

/// Where nothing is held nothing happens.
WALK(held_letters_set_parameters, session_open(s, SWAY),
     "hold F; key 4*Up; let F; key Up; sway.frequency 1.2; hold Z; key 30*Down; let Z; sway.damping 0; key Ctrl+Z;"
     "sway.damping 0.1; key Ctrl+Z; sway.frequency 1; key M; sway.mode 1")

WALK(keys_during_a_drag_do_not_mix, session_open(s, SWAY),
     "pull knot(sway,1) 30 -20 3; key Delete Ctrl+Z PageDown; drag 5 0 1; release; sway.knots 4; sway.1.frame > 12;"
     "key Ctrl+Z; sway.frame 0 12 24 36; sway.1.value 1")

// --- slopes ---

/// The first has only one neighbour. The inspector's buttons do the same.
WALK(slopes_are_flat_and_smooth, session_open(s, FIVE),
     "key Ctrl+A; keep; key Ctrl+T; sway.0.slope 2.4 ~1e-2; sway.2.slope -0.6 ~1e-2; sway.3.slope 0.8 ~1e-2; once;"
     "keep; key Shift+T; sway.sloped 1 1 1 1 1; sway.slope 0 0 0 0 0 ~0; once;"
     "click slope.smooth; sway.0.slope 2.4 ~1e-2; click slope.switch; sway.sloped 0 0 0 0 0")

SESSION_TEST(a_longer_handle_is_stiffer, session_open(s, FIVE))
{
    float knot[2], end[2];
    hands(s, "click knot(sway,1)");
    session_where(s, "knot(sway,1)", knot);
    session_where(s, "handle(sway,1,1)", end);
    const double size = hypot(end[0] - knot[0], end[1] - knot[1]);
    const double x = (end[0] - knot[0]) / size, y = (end[1] - knot[1]) / size;
    hands(s,
          "pull handle(sway,1,1) %.9g %.9g 3; sway.1.stiffness 1000;"          // a hand is not that steady
          "drag %.9g %.9g 5; sway.1.stiffness 1e5 ~1e4; sway.1.slope 2 ~0.05;" // 24 pixels are two powers of ten
          "drag %.9g %.9g 5; sway.1.stiffness < 50",
          6 * x, 6 * y, 26 * x, 26 * y, -64 * x, -64 * y);
}

/// A handle that is pulled past its knot stays steep on its own side.
WALK(a_handle_does_not_flip, session_open(s, FIVE),
     "click knot(sway,1); carry handle(sway,1,1) -150 -40 8; sway.1.slope > 20;"
     "carry handle(sway,1,0) 150 100 8; sway.1.slope > 20")

/// Of handles that nearly touch the one under the pointer is pulled.
WALK(the_nearest_handle_is_pulled,
     session_open(s, "{'wiggly': 1, 'frames': [0, 240], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, "
                     "'knots': [{'frame': 100, 'value': 0, 'slope': 0}, {'frame': 101, 'value': 0, 'slope': 0}]}]}"),
     "key Ctrl+A; carry handle(sway,0,1) 0 -60 5; sway.0.slope > 0.1; sway.1.slope 0 ~0; key Ctrl+Z;"
     "carry handle(sway,1,1) 0 -60 5; sway.1.slope > 0.1; sway.0.slope 0 ~0")

/// The slope that a curve has does not change it, in a loop that swings about a moving equilibrium with a varying frequency, too.
WALK(a_slope_of_a_varying_loop_is_the_curves,
     session_open(s, "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 'sway', 'start': 'loop', 'frequency': "
                     "{'spline': 'pace'}, 'equilibrium': {'spline': 'base'}, 'knots': [<8 1>, <30 -1>]}, {'name': "
                     "'pace', 'mode': 'cubic', 'start': 'loop', 'knots': [<0 1>, <24 2>]}, {'name': 'base', 'mode': "
                     "'cubic', 'start': 'loop', 'knots': [<5 0>, <20 1>]}]}"),
     "keep; key Ctrl+A T; sway.sloped 1 1; sway.0.slope ! 0; steady 1e-4") // slopes are rounded

// --- several curves at once ---

static const char THREE[] =
    "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': [<10 0>, "
    "<20 1>, <30 -1>, <60 0>]}, {'name': 'up', 'mode': 'cubic', 'limits': [-50, 60], 'knots': [<20 0.5>, <40 "
    "-0.5>]}, {'name': 'far', 'mode': 'cubic', 'knots': [<22 0.2>]}]}";

/// A box around 20 of sway and up and 22 of far, and one that takes 30 of sway, too.
#define BOX "box curve(sway,17,1.1) curve(sway,26,0.1);"
#define LARGE_BOX "box curve(sway,17,1.1) curve(sway,34,-1.2);"

SESSION_TEST(all_of_one_and_of_all_that_are_shown, session_open(s, THREE))
{
    hands(s, "key Ctrl+A; selected 4; key Ctrl+Shift+A; selected 7; key Ctrl+A; selected 4"); // fewer again
    selection_set(hidden_of(s->editor), s->document->splines[2]->id, true);
    hands(s, "key Ctrl+Shift+A; selected 6");
}

/// Where a box takes of the other curve alone, that one is worked on.
WALK(a_box_takes_knots_of_all_curves, session_open(s, THREE),
     BOX "selected 3; active 0; box curve(sway,37,-0.3) curve(sway,45,-0.7); selected 1; active 1")

/// Active is the one that has what is still selected.
WALK(shift_clicks_add_knots_of_another_curve, session_open(s, THREE),
     "click knot(sway,1); with Shift; click knot(up,1); selected 2; click knot(up,1); selected 1; active 0")

SESSION_TEST(a_drag_moves_all_in_one_step, session_open(s, THREE))
{
    hands(s, "keep;" BOX "carry knot(up,0) 5f -12; sway.frame 10 25 30 60; up.0.frame 25; far.0.frame 27");
    const double up = spline(s, 1)->knots[0].value - 0.5;
    assert_true(up > 0.01);
    hands(s, "sway.1.value %g ~0.01; far.0.value %g ~0.01; once", 1 + up, 0.2 + up);
}

/// The last knot of one spline stops them all; none is lost where another knot is in the way, of one spline for both.
WALK(what_one_meets_stops_all, session_open(s, THREE),
     "key Ctrl+Shift+A; carry knot(up,0) 900 0 6; sway.frame 46 56 66 96; up.1.frame 76; key Ctrl+Z;"
     "click knot(sway,1); with Shift; click knot(far,0); with; key Alt+Shift+Right; sway.2.frame 40; far.0.frame 42")

SESSION_TEST(normalised_curves_move_by_the_same_height, session_open(s, THREE))
{
    hands(s, "key N; wait 1; key Ctrl+Shift+A; keep; key Alt+Shift+Up; once; sway.1.value > 1");
    const double by[] = {spline(s, 0)->knots[1].value - 1, spline(s, 1)->knots[0].value - 0.5};
    assert_true(by[1] > 0 && by[1] < 0.7 * by[0]); // of a curve that is drawn larger than it is
}

WALK(delete_and_slopes_are_one_step, session_open(s, THREE),
     "key Ctrl+Shift+A; keep; key Shift+T; sway.0.sloped 1; up.0.sloped 1; far.0.sloped 1; once; keep;"
     "key Delete; sway.knots 0; up.knots 0; far.knots 0; once")

/// 20 is 10 behind the first one, of another spline.
SESSION_TEST(pasted_knots_go_to_their_splines, session_open(s, THREE))
{
    hands(s, "key Ctrl+Shift+A Ctrl+C");
    assert_non_null(strstr(copied(s->editor), "\"spline\": \"up\""));
    hands(s, "keep; click ruler(21); paste; sway.knots 8; up.frame 20 31 40 51; far.knots 2; selected 7; once");
}

/// What is of a spline that this scene lacks goes to the active one; of one spline alone, always.
SESSION_TEST(pasted_knots_of_unknown_splines_go_to_the_active_one, session_open(s, THREE))
{
    hands(s, "click ruler(70); paste [{\"spline\": \"up\", \"frame\": 0, \"value\": 1}, {\"spline\": \"gone\", "
             "\"frame\": 2, \"value\": 2}]; sway.4.frame 72; up.2.frame 70; click knot(sway,1); key Ctrl+C");
    assert_null(strstr(copied(s->editor), "spline"));
    hands(s, "paste [{\"spline\": 3, \"frame\": 0, \"value\": 1}]; said [0].spline: expected");
}

/// 10 … 60 and 40 behind each other: 20 later.
WALK(copies_go_behind_the_end, session_open(s, THREE),
     "key Ctrl+Shift+A; keep; key Ctrl+D; sway.knots 8; is frames.1 130; sway.7.frame 130; up.2.frame 90; selected "
     "7; once")

// --- scaling ---

static void assert_scaling_says(const struct session *s, const char *part)
{
    const char *sentence = s->editor->curves->scaling.sentence;
    if (!strstr(sentence, part)) fail_msg("\"%s\" lacks \"%s\"", sentence, part);
}

SESSION_TEST(scaling_about_the_equilibrium, session_open(s, THREE))
{
    hands(s, "key Ctrl+Shift+A; keep");
    session_strike(s, 'S', MOD_SHIFT, 'S');
    hands(s, "type 2; wait 1");
    assert_scaling_says(s, "value × 2");
    hands(s,
          "key Enter; sway.value 0 2 -2 0; up.1.value -1; sway.1.frame 20; once"); // a cubic's equilibrium is 0 too
}

SESSION_TEST(two_factors_and_what_stops_them, session_open(s, THREE))
{
    static const struct {
        const char *typed, *sentence;
    } rows[] = {
        {BOX
         "type s; type 3 1.5; wait 1; far.0.frame 24; sway.1.frame 18; sway.1.value 1.2 ~1e-6", // about 21 and 0.6
         "time × 3, value × 1.5"},
        {"key Escape; type s; type 11 1; wait 1; sway.1.frame 20", "a knot would land on another on frame 10"},
        {"key 2*Backspace; type 0 1; wait 1", "a knot would leave the range"},
        {"key Escape; type sy300; wait 1; sway.1.value 120.6 ~1e-3; up.0.value -29.4 ~1e-3", "value × 300"},
        {"type 0; wait 1; up.0.value -50 ~0", "held by the limit -50 of up at frame 20"}, // sway has no limit
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        hands(s, "%s", rows[i].typed);
        assert_scaling_says(s, rows[i].sentence);
        assert_int_equal(strstr(s->editor->curves->scaling.sentence, "limit") != NULL, i == 4);
    }
}

/// The upper edge goes along with the pointer, the lower one stays; the factor is beside the pointer.
SESSION_TEST(an_edge_of_the_box_scales_about_the_other_side, session_open(s, THREE))
{
    hands(s, LARGE_BOX "keep; pull box(0,-1) 0 0.5v; shows value × 1.25");
    assert_scaling_says(s, "value × 1.25 about the other side.  P: the equili");
    hands(s, "release; sway.1.value 1.5 ~0.01; sway.2.value -1; up.0.value 0.875 ~0.01; sway.1.frame 20; once");
}

/// With Alt, or with P: the upper edge goes along, the lower one the other way.
WALK(an_edge_of_the_box_scales_about_the_equilibrium, session_open(s, THREE),
     "keep; key Ctrl+A; with Alt; carry box(0,-1) 0 0.5v; sway.value 0 1.5 -1.5 0 ~0.01; with; key Ctrl+Z; kept;"
     "pull box(0,-1) 0 0.5v; key P; release; sway.value 0 1.5 -1.5 0 ~0.01")

/// 110 is outside.
WALK(a_corner_of_the_box_scales_both_and_says_what_stops_it, session_open(s, THREE),
     LARGE_BOX "keep; pull box(1,-1) 10f 0; sway.2.frame 40; sway.1.frame 20; shows time × 2; drag 80f 0 10;"
               "shows a knot would leave the range; sway.2.frame < 96.001; key Escape; kept")

/// A knot is where a handle would be, and a press there takes the knot; a single one, and knots on one frame, have fewer handles.
SESSION_TEST(the_box_has_the_handles_that_can_scale, session_open(s, THREE))
{
    hands(s, "click knot(sway,1); lacks box(0,-1); with Shift; click knot(up,0); with; finds box(0,-1);"
             "lacks box(1,0); lacks box(1,-1); hover knot(sway,1)");
    assert_ptr_equal(hovered(s->editor), &thing_knot);
}

/// With Alt, from the playhead.
SESSION_TEST(the_playhead_goes_to_the_next_knot, session_open(s, THREE))
{
    hands(s, "key Alt+End; playhead 10; key 2*Alt+End; playhead 30; key Alt+Home;"
             "playhead 20; sway.picked 0 1 0 0; key 2*Alt+Home; playhead 10; said No knot lies before;"
             "click knot(sway,3); again; playhead 60; label");
}

// --- the dope sheet: rows of marks that share the ruler's time ---

SESSION_TEST(the_sheet_takes_its_room_from_the_curves, session_open(s, THREE))
{
    const struct layout *layout = layout_of(s->editor);
    const struct rect plot = layout->plot;
    assert_near(layout->sheet.h, 0, 0);
    hands(s, "key F7");
    assert_true(layout->sheet.h > 20);
    assert_near(layout->plot.h, plot.h - layout->sheet.h, 0.01);
    assert_near(layout->sheet.y, layout->ruler.y + layout->ruler.h, 0.01);
    assert_near(layout->sheet.x, plot.x, 0); // marks are under their frames on the ruler
    assert_near(layout->sheet.w, plot.w, 0);
    session_move(s, layout->value_axis.x + 6, layout->ruler.y + 10); // the triangle
    hands(s, "click");
    assert_near(layout->plot.h, plot.h, 0);
}

WALK(marks_are_dragged_in_time_alone, session_open(s, THREE),
     "key F7; keep; carry mark(up,1) 7f 40; active 1; up.1.frame 47; up.1.value -0.5 ~0; once")

/// The box grows into the next row.
WALK(a_box_takes_the_marks_of_its_rows, session_open(s, THREE),
     "key F7; point mark(sway,1); drag -3f 0 1; press; drag 6f 2 2; selected 1; drag 0 14 2; selected 2; release; "
     "keep;"
     "carry mark(sway,1) 5f 0; sway.1.frame 25; up.0.frame 25; sway.1.value 1 ~0; once")

SESSION_TEST(rows_choose_and_insert, session_open(s, THREE))
{
    hands(s, "key F7; point mark(up,1); drag 10f 0 1; click; active 1");
    const wiggly_value there = evaluation_at(s->world.evaluation, 1, 50);
    hands(s, "again; up.frame 20 40 50; up.2.value %.17g ~1e-6", there.y + there.re);
    hands(s, "point mark(sway,3); drag 10f 0 1; with Shift; click; again; active 0; sway.posed 0 0 0 0 1");
}

/// Ten rows are more than it shows: the wheel scrolls, and the active spline's row comes into sight by itself.
TEST(rows_scroll)
{
    char scene[2048] = "{'wiggly': 1, 'frames': [0, 96], 'splines': [";
    for (int i = 0; i < 10; i++)
        sprintf(scene + strlen(scene), "%s{'name': 's%d', 'frequency': 1, 'knots': [{'frame': %d, 'value': 0}]}",
                i ? ", " : "", i, 10 + i);
    struct session session, *const s = &session;
    session_open(s, strcat(scene, "]}"));
    hands(s, "key F7; point mark(s0,0); lacks mark(s9,0); wheel -1; wheel -1; wait 1; lacks mark(s0,0);"
             "key PageUp; wait 1; finds mark(s9,0)"); // round to the last one
    selection_set(hidden_of(s->editor), s->document->splines[9]->id, true);
    hands(s, "wait 1; lacks mark(s9,0)");
    session_close(s);
}

// --- knots as text and on the clipboard: what is read, what is refused and with which words, and what pasting does ---

static const char MARKED[] = "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': "
                             "1, 'damping': 0.1, 'knots': [<10 0>, {'frame': 20.5, 'value': 1, 'slope': "
                             "2, 'stiffness': 50}, <30 -1>, <40 0.5>, {'frame': 60, 'value': 0, 'mark': 'kept'}]}]}";

static void assert_read(const char *text, const struct knot expected[2])
{
    struct knot_list list;
    struct error error = {0};
    if (!knots_parse("clipboard", text, &list, &error)) fail_msg("%s: %s", text, error.text);
    if (list.count != 2) fail_msg("%s: %d knots", text, list.count);
    for (int k = 0; k < 2; k++) {
        const struct knot *is = &list.knots[k], *e = &expected[k];
        if (is->frame != e->frame || is->value != e->value || is->slope != e->slope ||
            is->stiffness != e->stiffness || is->has_slope != e->has_slope)
            fail_msg("%s: knot %d is %g, %g, %g, %g", text, k, is->frame, is->value, is->slope, is->stiffness);
    }
    knot_list_free(&list);
}

TEST(text_reads_back_equal)
{
    struct knot knots[] = {{.frame = -3.25, .value = 1.0 / 3, .stiffness = KNOT_DEFAULT_STIFFNESS},
                           {.frame = 7, .value = -2e-9, .has_slope = true, .slope = 0.1, .stiffness = 12}};
    char *text = knots_print(&(struct knot_list){.knots = knots, .count = 2});
    assert_non_null(strstr(text, "{ \"frame\": 7, \"value\": -2e-9, \"slope\": 0.1, \"stiffness\": 12 }"));
    assert_read(text, knots);
    free(text);
}

TEST(csv_is_read_in_its_dialects)
{
    static const struct knot knots[] = {
        {.frame = 1, .value = 2, .stiffness = KNOT_DEFAULT_STIFFNESS},
        {.frame = 3, .value = 4.5, .has_slope = true, .slope = 0.25, .stiffness = 80}};
    static const char *const texts[] = {
        "1,2\n3,4.5,0.25,80\n",
        "frame,value,slope,stiffness\r\n1,2\r\n3,4.5,0.25,80\r\n",
        "1;2\n\n# a comment\n3;4,5;0,25;80",
        "\xEF\xBB\xBFvalue\tframe\tnote\tstiffness\tslope\n2\t1\t\t\t\n\"4.5\"\t3\thi\t80\t0.25",
        " 1 , 2 \n 3 , 4.5 , 0.25 , 80 ",
        "1,2\r\n\r\n\t\r\n \n  # a comment\r\n3,4.5,0.25,80\r\n\r\n", // blank lines of every kind
        "\"1\",\"2\"\n\"3\",\"4.5\",\"0.25\",\"80\"",
    };
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) assert_read(texts[i], knots);
    // What `wiggly solve` writes has other columns after the first two; they are no slopes.
    static const struct knot samples[] = {{.value = 1, .stiffness = KNOT_DEFAULT_STIFFNESS},
                                          {.frame = 1, .value = 2, .stiffness = KNOT_DEFAULT_STIFFNESS}};
    assert_read("frame,sway,sway.re,sway.im\n0,1,1,0.5\n1,2,2,0.25\n", samples);
}

#define NO_VALUE "expected a value or still after the frame (frame,value[,slope[,stiffness[,im]]]), got "
#define NO_FRAME "expected a frame from -1000000000 to 1000000000, got "

TEST(bad_text_is_refused_in_one_sentence)
{
    static const struct {
        const char *text, *sentence;
    } cases[] = {
        {"1,2\n3\n", "clipboard:2: " NO_VALUE "nothing"},
        {"1,2\n3,x\n", "clipboard:2: " NO_VALUE "\"x\""},
        {"hello", "clipboard:1: " NO_FRAME "\"hello\""},
        {"1,2\n\nlater,3\n", "clipboard:3: " NO_FRAME "\"later\""},
        {"1e30,2", "clipboard:1: " NO_FRAME "\"1e30\""},
        {"1,2,steep", "clipboard:1: expected a number as the slope, got \"steep\""},
        {"1,2,0,-4", "clipboard:1: expected a number above 0 as the stiffness, got \"-4\""},
        {"1,nan", "clipboard:1: " NO_VALUE "\"nan\""},
        {"frame,value\n", "clipboard:1: expected knots as JSON or as lines frame,value, got nothing"},
        {"[]", "clipboard:1: scene: expected at least one knot, got none"},
        {"{\"knots\": 3}", "clipboard:1: knots: expected an array, got a number"},
        {"[{\"frame\": 1}]", "clipboard:1: [0].value: expected a number, got nothing"},
        {"[{\"frame\": 1, \"value\": 2},\n{\"frame\": \"a\", \"value\": 2}]",
         "clipboard:2: [1].frame: expected a number, got a string"},
        {"[{\"frame\": 1, \"value\": 2}", NULL}, // whatever the sentence, its place is
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct knot_list list = {0};
        struct error error = {0};
        if (knots_parse("clipboard", cases[i].text, &list, &error) || list.knots)
            fail_msg("%s is read", cases[i].text);
        if (cases[i].sentence) assert_string_equal(error.text, cases[i].sentence);
        assert_ptr_equal(strstr(error.text, "clipboard:"), error.text);
    }
}

/// What was pasted is selected.
SESSION_TEST(what_is_copied_is_pasted_at_the_playhead, session_open(s, MARKED))
{
    hands(s, "click knot(sway,1); with Shift; click knot(sway,2); with; key Ctrl+C");
    assert_int_equal(session_asked(s).kind, REQUEST_COPY);
    hands(s, "click ruler(70); keep; key Ctrl+V");
    assert_int_equal(session_asked(s).kind, REQUEST_PASTE);
    hands(s, "paste; sway.frame 10 20.5 30 40 60 70 79.5; sway.5.slope 2; sway.5.stiffness 50; sway.6.value -1;"
             "sway.picked 0 0 0 0 0 1 1; once");
}

/// Pasted at the first one's frame, they are where they were.
SESSION_TEST(a_cut_is_one_step, session_open(s, MARKED))
{
    hands(s, "key Ctrl+A; keep; key Ctrl+X; sway.knots 0; label Cut knots");
    assert_int_equal(session_asked(s).kind, REQUEST_COPY);
    hands(s, "once; click ruler(10); paste; sway.frame 10 20.5 30 40 60");
}

/// The second knot would hit the one at 40, the third of the next text the end of the range.
WALK(a_paste_that_does_not_fit_changes_nothing, session_open(s, MARKED),
     "click ruler(35); keep; paste 0,1\n5,2\n; says sway: there is already a knot at frame 40;"
     "paste 0,1\n1,2\n200,3\n; says sway: frame 235 is outside 0 to 96;"
     "paste 0,1\n0,2\n; says sway: there is already a knot at frame 35; paste nonsense; error clipboard;"
     "label; kept; paste \n; says The clipboard has no text.")

/// 30, 40 → 50, and 60 is taken: 51, 61. Then 10 … 61, the copies from 62 on: the scene gets longer.
SESSION_TEST(copies_come_behind_and_pass_through, session_open(s, MARKED))
{
    hands(s, "click knot(sway,2); with Shift; click knot(sway,3); with; keep; key Ctrl+D;"
             "sway.frame 10 20.5 30 40 51 60 61; sway.6.value 0.5; once;"
             "key Ctrl+A; keep; key Ctrl+D; sway.knots 14; is frames.1 113; said now ends on frame 113; once;"
             "key Ctrl+Z; click knot(sway,5); key Ctrl+D");
    const char *mark = strstr(session_saved(s), "\"mark\": \"kept\"");
    assert_non_null(mark);
    assert_non_null(strstr(mark + 1, "\"mark\": \"kept\"")); // keys that nobody here knows are copied too
}

// --- cleaning up ---

/// A swing of 1 Hz with noise.
#define NOISY                                                                                                        \
    "<0 0.749>, <3 0.054>, <6 -0.54>, <9 -0.772>, <12 -0.551>, <15 -0.059>, <18 0.391>, <21 0.533>, <24 "            \
    "0.376>, <27 0.02>, <30 -0.249>, <33 -0.367>, <36 -0.266>, <39 -0.049>, <42 0.155>, <45 0.268>, <48 "            \
    "0.189>, <51 0.036>, <54 -0.1>, <57 -0.185>"

static const char noisy[] =
    "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1.6, 'damping': 0.1, "
    "'wind_up': 0.5, 'knots': [" NOISY "]}]}";

/// At once and by one slide: few knots that swing as they did. Esc goes back to before the slide, undo to before all.
WALK(noisy_knots_become_few, session_open(s, noisy),
     "keep; key F3; type reduce; key Enter; wait 1; sway.knots 3; sway.frequency 1 ~0.03; said 20 knots → 3: ;"
     "shows 20 knots → 3; sway@9 -0.72 ~0.06; sway@30 -0.24 ~0.1; slide tolerance 0; wait 1; sway.knots 20;"
     "key Escape; wait 1; sway.knots 3; release; slide tolerance 0.3; wait 1; release; sway.knots 3; once;"
     "key Ctrl+Z; wait 1; kept; lacks tolerance")
WALK(a_tolerance_of_0_gives_all_back, session_open(s, noisy),
     "keep; click knot.simplify; wait 1; sway.knots 3; slide tolerance 0; wait 1; kept; release; wait 1; kept")
WALK(another_edit_ends_it, session_open(s, noisy),
     "keep; click knot.simplify; wait 1; finds tolerance; lacks knot.simplify; carry knot(sway,1) 0 20; wait 1; "
     "lacks tolerance;"
     "key 2*Ctrl+Z; wait 1; kept; finds knot.simplify; click knot.simplify; wait 1; finds tolerance; key Escape; "
     "lacks tolerance; sway.knots 3")

/// Of selected knots only those go, and the frequency stays.
WALK(selected_knots_are_thinned, session_open(s, noisy),
     "keep; click knot(sway,5); with Shift; click knot(sway,6); click knot(sway,7); click knot(sway,8); with; key "
     "F3; type reduce;"
     "key Enter; wait 1; finds tolerance; slide tolerance 0.3; wait 1; release; sway.knots < 20; sway.knots > 15; "
     "sway.frequency 1.6;"
     "sway.1.frame 3; sway.4.frame 12; once")

/// Loops close, limits and poses hold, whatever the spline is and follows; one undo brings back every byte.
TEST(all_kinds_are_simplified)
{
    static const char *const kinds[] = {
        "'mode': 'real'",
        "'mode': 'cubic'",
        "'start': 'loop', 'wind_up': 0.5",
        "'start': 'rest', 'wind_up': 0",
        "'limits': [-0.8, 0.8]",
        "'frequency': {'spline': 'lead'}, 'equilibrium': {'spline': 'lead'}",
        "'variation': {'seed': 3, 'amount': 0.2}",
    };
    static const char knots[] =
        NOISY ", {'frame': 60, 'value': 0.1, 'im': 0.2}, {'frame': 66, 'still': true, 'mood': 1}, "
              "{'frame': 70, 'value': 0.3, 'slope': 1, 'settles': true}, <72 0.2>, <75 0.1>";
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        struct session session = {0}, *s = &session;
        char scene[2048];
        snprintf(scene, sizeof scene,
                 "{'wiggly': 1, 'frames': [0, 96], 'splines': [{'name': 'sway', 'damping': 0.1, %s, 'knots': [%s]}, "
                 "{'name': "
                 "'lead', 'mode': 'cubic', 'knots': [<0 1>, <90 1.5>]}]}",
                 kinds[i], knots);
        session_open(s, scene);
        hands(s, "keep; click knot.simplify; wait 1; slide tolerance 0.2; wait 1; release; wait 1; sway.knots < 25; "
                 "sway.knots > 1; saves 'im': 0.2;"
                 "saves 'mood': 1; finds tolerance");
        assert_loads_again(s->document);
        if (i == 4) {
            for (int k = 0; k < s->document->splines[0]->knot_count; k++)
                assert_true(fabs(s->document->splines[0]->knots[k].value) <= 0.8 ||
                            s->document->splines[0]->knots[k].still);
        }
        hands(s, "once; key Ctrl+Z; kept; key Ctrl+Y; wait 2; key Ctrl+Z; wait 1; kept");
        session_close(s);
    }
}

/// Each time they zigzag less. The ends of a row stay.
WALK(selected_knots_are_smoothed,
     session_open(s, "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, "
                     "'knots': [<0 0>, <4 "
                     "0.2>, <8 0>, <12 0.2>, <16 0>, <20 0.2>, <24 0>, <28 0.2>]}]}"),
     "keep; key Ctrl+A; key F3; type jitter; key Enter; wait 1; sway.knots 8; sway.0.value 0 ~0; sway.7.value 0.2 ~0;"
     "sway.3.value ! 0.2; sway.3.value 0.1 ~0.07; sway.4.value 0.1 ~0.07; undone; key F3; type jitter; key Enter; "
     "wait 1; key F3; type jitter;"
     "key Enter; wait 1; sway.3.value 0.1 ~0.05; sway.4.value 0.1 ~0.05; key 2*Ctrl+Z; kept; click knot(sway,4); "
     "keep; key F3; type jitter;"
     "key Enter; wait 1; kept; said three knots")
