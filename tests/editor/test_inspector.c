/// The inspector: what each widget does to the document and what it says, by the events of mouse and keyboard.
#include "folder.h"
#include "hands.h"
#include "puppet.h"

/// A keyed spline, a cubic, and one whose frequency follows the cubic; a tail that two of them bend.
static const char scene[] =
    "{'frames': [0, 96], 'splines': [{'name': 'sway', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 0, "
    "'value': "
    "0}, {'frame': 36, 'value': 1}, {'frame': 60, 'value': -0.5}]}, {'name': 'pace', 'mode': 'cubic', 'knots': "
    "[{'frame': 0, 'value': 1}, {'frame': 90, 'value': 2}]}, {'name': 'lift', 'frequency': {'spline': 'pace'}, "
    "'damping': 0.2, 'knots': [{'frame': 10, 'value': 1}]}], 'rigs': [{'type': 'tail', 'name': 'tail', 'joints': 3, "
    "'rest': [4, -2, 1], 'channels': [{'spline': 'sway', 'axis': 'side', 'lag': 6.5, 'gain': [3, 6, 9]}, {'spline': "
    "'lift', 'axis': 'up', 'lag': 5, 'gain': 4}]}]}";

// --- numbers ------------------------------------------------------------------------------------------------------------

/// A drag is one step; Esc takes it back, and closing the window in the middle of one leaves no half-open step behind.
WALK(test_a_drag_is_one_step, panel_open(s, scene, 1280, 720),
     "slide frequency 2.5; is splines.0.frequency 2.5; is sliding 1;"
     "release; is open 0; label Set frequency; once;"
     "key Ctrl+Z; kept; label;"
     "slide damping 1; is splines.0.damping 1; key Escape; kept; is open 0; label; release;"
     "slide frequency 3; close; is open 0; is asked unsaved")

WALK(test_typed_nonsense_is_said_and_refused, panel_open(s, scene, 1280, 720),
     "enter damping lots; error damping: expected a number; key A Escape;"
     "enter damping 1.5; said damping: expected 0 … 1;" // more than complex mode takes
     "kept; label")

WALK(test_typing_keeps_keys_from_the_editor, panel_open(s, scene, 1280, 720),
     "again frequency; is typing 1;"
     "key Ctrl+A; type v m.; is selected 0;" // all of what is typed, not all knots
     "key End Ctrl+A; type x; is field x;"
     "key Delete Space; is look wiggly; is playing 0; kept;"
     "key F1; is lookup keys; key Escape Escape; is typing 0;"
     "key V; is look stiff")

/// A run of nudges is one step. Without the focus the arrows are the playhead's. Delete is the default's.
WALK(test_keys_belong_to_the_focus, panel_open(s, scene, 1280, 720),
     "tab frequency; key Right Right; is splines.0.frequency 1.1; is position 0;"
     "key Ctrl+Z; kept;"
     "key 9*Right; is splines.0.frequency > 1.3; key Delete; is splines.0.frequency 1; is splines.0.knots.# 3;"
     "key Ctrl+Z; is splines.0.frequency > 1.3; key Ctrl+Z; kept;"
     "key Escape Right; is position 1; kept")

WALK(test_only_what_counts_is_shown, panel_open(s, scene, 1280, 1700),
     "lacks bandwidth; click section.advanced; finds bandwidth;"
     "click mode.real; is splines.0.mode real; lacks bandwidth;"
     "click mode.cubic; is splines.0.mode cubic; lacks frequency;"
     "click spline.lift; is active 2; lacks frequency; finds damping;" // a track drives it
     "click start.loop; is splines.2.start loop;"
     "click look.cubic; is look cubic;"
     "click section.spline; hover position.y; is hint Position of the body along y") // outlives the panel

/// The pointer's shape says that a number is dragged, and where a text is typed.
WALK(test_the_pointer_says_what_it_does, panel_open(s, scene, 1280, 720),
     "is cursor arrow; slide damping 0.3; is cursor horizontal; release; is cursor horizontal;"
     "again damping; is cursor text; key Escape;"
     "click section.knot; is cursor arrow")

// --- knots --------------------------------------------------------------------------------------------------------------

WALK(test_a_knot_is_edited_in_place, panel_open(s, scene, 1280, 1600),
     "click knot(sway,1); enter value 0.75; is splines.0.knots.1.value 0.75;"
     "enter value 8; wait 90; is plot.top > 8;"                                     // above all in sight
     "enter frame 70; is splines.0.knots.2.frame 70; is splines.0.knots.2.value 8;" // past its neighbour
     "enter frame 60; is splines.0.knots.2.frame 70; error ;"                       // where another sits
     "carry frame 600 0 1; is splines.0.knots.2.frame 96;"                          // as far as it goes
     "click has_slope; is splines.0.knots.2.slope < 0; is splines.0.knots.1.slope nothing;"
     "enter stiffness 50; is splines.0.knots.2.stiffness 50")

WALK(test_a_dragged_frame_passes_through_a_neighbour, panel_open(s, scene, 1280, 720),
     "click knot(sway,1); press frame; drag 30 0 30; is splines.0.knots.2.frame 66; is splines.0.knots.1.frame 60;"
     "release; once; key Ctrl+Z; is splines.0.knots.1.frame 36")

/// Nothing is selected: the section says what knots there are; what is below stays where it is.
WALK(test_the_knot_section_without_a_knot, panel_open(s, scene, 1280, 1400),
     "shows 3, frames 0 … 60; click spline.lift; shows 1, frame 10; click spline.sway;"
     "keep y:section.spline; seek 20; key I; is splines.0.knots.# 4; is splines.0.knots.1.frame 20;"
     "is y:section.spline kept; finds slope.flat; key Escape; lacks slope.flat")

/// Several knots at once: typed numbers are set, drags and frames move, and what is not possible changes nothing.
WALK(test_several_knots, panel_open(s, scene, 1280, 1600),
     "key Ctrl+A; lacks stiffness;" // no slopes yet
     "enter value 0.25; is splines.0.knots.0.value 0.25; is splines.0.knots.1.value 0.25;"
     "is splines.0.knots.2.value 0.25; key Ctrl+Z; kept;"
     "carry value 50 0 5; is splines.0.knots.0.value 0.5 ~1e-12; is splines.0.knots.2.value 0 ~1e-12;"
     "key Ctrl+Z; label;"
     "enter frame 10; is splines.0.knots.0.frame 10; is splines.0.knots.2.frame 70;"
     "enter frame 40; is splines.0.knots.0.frame 10; said frame 100 is outside 0 to 96;"
     "carry frame 60 0 60; is splines.0.knots.2.frame 96; is splines.0.knots.1.frame 72;" // as far as it goes
     "key T; enter stiffness 50; is splines.0.knots.0.stiffness 50; is splines.0.knots.1.stiffness 50;"
     "is splines.0.knots.2.stiffness 50;"
     "enter slope steep; said slope: expected a number")

// --- what is said of a spline -------------------------------------------------------------------------------------------

SESSION_TEST(test_says_what_the_solver_and_the_poles_mean,
             panel_open(s,
                        "{'frames': [0, 96], 'splines': [{'name': 'a', 'mode': 'real', 'frequency': 1, "
                        "'knots': [{'frame': 0, 'value': 1}, {'frame': 12, 'value': -1}, {'frame': 24, "
                        "'value': 1}]}]}",
                        1280, 720))
{
    struct drawlist *list = drawn_by(s->editor);
    assert_int_equal(s->work.evaluation.status[0], WIGGLY_OK);
    s->work.evaluation.status[0] = WIGGLY_CALMED;
    drawlist_clear(list, layout_of(s->editor)->window);
    inspector_show(s->editor->inspector, false);
    hands(s, "mentions %.23s", wiggly_status_text(WIGGLY_CALMED));
    s->work.evaluation.status[0] = WIGGLY_OK;
    hands(s, "wait; mentions Rings forever; ignores %.23s;", wiggly_status_text(WIGGLY_CALMED));
    hands(s, "slide damping 0.5; release; mentions Settles to 5 %% 21 frames after the last knot.;"
             "slide damping 2; release; mentions Settles to 5 %% 45 frames after;"
             "enter frequency 20; mentions half the sample rate");
}

// --- the list of splines ------------------------------------------------------------------------------------------------

WALK(test_a_spline_is_added_at_the_playhead, panel_open(s, scene, 1280, 900),
     "click ruler(24); click splines.add; is active.name spline; is splines.3.knots.0.frame 24;"
     "is splines.3.frequency 1; once;"
     "key Ctrl+Z; is active > -1; is active < 3")

/// What is being edited stays what it is when the list around it changes, and when that is undone.
WALK(test_the_active_spline_is_followed, panel_open(s, scene, 1280, 900),
     "click spline.pace; key F3; type spline down; key Enter; is active.name pace; is active 2; once; is active.name "
     "pace;"
     "key Ctrl+Z; is active.name pace;"
     "key F3; type duplicate the spl; key Enter; is active.name pace 2;"
     "key F3; type delete the spl; key Enter; is splines.# 3; is asked none") // nothing follows it: no question

/// Deleting what others follow asks; then they keep the value of that frame, and the tail lets go of it.
WALK(test_deleting_a_followed_spline_asks, panel_open(s, scene, 1280, 900),
     "click ruler(90); click spline.pace; key F3; type delete the spl; key Enter; is asked ask; key Escape; kept;"
     "key F3; type delete the spl; key Enter D; is splines.# 2; is splines.1.frequency 2 ~1e-9;"
     "is rigs.0.channels.1.spline lift; once; click spline.lift; keep;"
     "key F3; type delete the spl; key Enter Enter; is rigs.0.channels.# 1; once")

/// The only spline may go as well; what is left still draws, and can be added to.
WALK(test_an_empty_list, panel_open(s, scene, 960, 900),
     "with Shift; click spline.lift; with; is chosen 3; key F3; type delete the spl; key Enter;"
     "mentions sway and others are used in; key D; is splines.# 0; is active -1; once;"
     "key Ctrl+Y; key F3; type delete the spl; key Enter Escape; is splines.# 0;"
     "click splines.add; is active.name spline")

WALK(test_renaming, panel_open(s, scene, 1280, 900),
     "again spline.sway; type swing; key Enter; is splines.0.name swing; once;"
     "key F2; type pace; key Enter;"
     "is splines.0.name swing; said a spline called pace already exists;"
     "key F2 End; type s; key Enter; is splines.0.name swings;" // the name that is there is what is edited
     "key Ctrl+Z; key F2 Delete Enter; is splines.0.name swing; said a spline needs a name;" // all is selected
     "is splines.0.knots.# 3")

WALK(test_colours, panel_open(s, scene, 1280, 900),
     "click color.pace; click color.3; is splines.1.color #1F9E7A; is popup 0; once;"
     "click color.pace; click color.type; type #12345; key Enter; is splines.1.color #1F9E7A;"
     "said colour: expected something like #FFB000, got “#12345”;"
     "click color.type; type #123456; key Enter; is splines.1.color #123456;"
     "click color.none; kept")

/// The order of the list does not matter to what is hidden, and only the order is an edit.
WALK(test_hidden_and_solo_curves, panel_open(s, scene, 1280, 900),
     "is curves.others 2; click eye.pace; is curves.others 1; is history.saved 1;"
     "click spline.pace; key F3; type spline up; key Enter; is curve:0 0;"
     "click spline.lift; key F3; type solo; key Enter; is curve:2 1; is curve:1 0;"
     "key F3; type solo; key Enter; click eye.pace; is curves.others 2; is history.saved 0")

/// Attached from the list, which has no spline that would make a cycle; detached, it keeps the value at the playhead.
WALK(test_a_track_is_attached_and_detached, panel_open(s, scene, 1280, 900),
     "click ruler(90); click follow.damping; finds item.pace; lacks item.sway;"
     "click item.pace; is splines.0.damping.spline pace; once; lacks damping;"
     "click spline.pace; click follow.equilibrium; is popup 0;" // both others follow it
     "said no other spline for pace to follow;"
     "click spline.sway; wait; click follow.damping; is splines.0.damping 1") // 2, as far as damping goes

// --- the scene ----------------------------------------------------------------------------------------------------------

WALK(test_frames_per_second_ask, panel_open(s, scene, 1280, 2000),
     "enter scene.fps 48; is asked ask; is fps 24;"
     "key S; is fps 48; is splines.0.knots.1.frame 72; is frames.1 192; once;"
     "key Ctrl+Z; enter scene.fps 48; key F; is fps 48; is splines.0.knots.1.frame 36;"
     "enter scene.fps 0; said rate: expected; key Escape")

/// The playhead stays on its frame, or comes inside.
WALK(test_a_range_asks_for_its_knots, panel_open(s, scene, 1280, 2000),
     "click ruler(80); enter scene.last 50; is asked ask;"
     "key T; is splines.0.knots.# 2; is position 50; once;"
     "key Ctrl+Z; enter scene.last 50; key M; is splines.0.knots.2.frame 50;"
     "enter scene.last 50.5; said last: expected a whole number, got 50.5;"
     "enter scene.first 60; said the last frame must not be before the first;"
     "enter scene.first -10; is position 60")

/// More frames than the splines' samples allow are refused in the field, and nothing is asked about knots.
SESSION_TEST(test_a_range_has_an_end, panel_open(s, "{'frames': [0, 96], 'substeps': 4, 'splines': []}", 1280, 2000))
{
    const int longest = (SPLINE_MAX_SAMPLES - 1) / 4;
    hands(s,
          "keep;"
          "enter scene.last 999999999; is asked none; says last: expected -1000000000 … %d, got 999999999;"
          "enter scene.first -999999999; said first: expected %d … 1000000000; kept;"
          "enter scene.last %d; is frames.1 %d",
          longest, 96 - longest, longest, longest);
}

static unsigned next_random(unsigned *seed) { return (*seed = *seed * 1664525u + 1013904223u) >> 8; }

static void random_input(struct session *s, unsigned *seed)
{
    static const int keys[] = {KEY_ENTER, KEY_ESCAPE, KEY_TAB, KEY_UP, KEY_DOWN,  KEY_LEFT,
                               KEY_RIGHT, KEY_DELETE, KEY_F2,  '3',    KEY_SPACE, KEY_BACKSPACE};
    const unsigned what = next_random(seed) % 6;
    if (what < 2) {
        session_press(s, next_random(seed) % 8 ? BUTTON_LEFT : BUTTON_RIGHT, 1 + (int)(next_random(seed) % 4 == 0));
    } else if (what == 2) {
        session_release(s, BUTTON_LEFT);
    } else if (what == 3) {
        session_key(s, keys[next_random(seed) % 12], 0);
        session_send(s, (struct event){.kind = EVENT_TEXT, .codepoint = '0' + next_random(seed) % 75});
    } else if (what == 4) {
        session_wheel(s, (float)(next_random(seed) % 7) - 3);
    } else {
        const float x = layout_of(s->editor)->inspector.x + (float)(next_random(seed) % 280);
        session_move(s, x, (float)(next_random(seed) % 700));
    }
    if (next_random(seed) % 200 == 0) session_key(s, 'Z', MOD_CTRL);
}

/// Whatever is pressed, dragged and typed: the document stays one that loads, and all of it can be undone.
TEST(test_random_input_comes_back)
{
    int steps = 0;
    for (unsigned seed = 1; seed <= (unsigned)quick_or_all(2, 6); seed++) {
        struct session s;
        unsigned random = seed;
        panel_open(&s, scene, 1280, 2000);
        hands(&s, "click section.scene");
        for (int i = 0; i < 3000 && s.document->spline_count < 50; i++) random_input(&s, &random);
        hands(&s, "key 3*Escape; release; key Escape; is open 0");
        assert_loads_again(s.document);
        while (history_undo(s.history)) steps++;
        hands(&s, "kept");
        session_close(&s);
    }
    assert_true(steps >= quick_or_all(10, 60));
}

// --- tails: every part of one is set by hand, each a step that undo takes back byte by byte -----------------------------------

static const char tail[] =
    "{'frames': [0, 48], 'splines': [{'name': 'sway', 'knots': [{'frame': 0, 'value': 0.5}]}, {'name': 'walk', "
    "'knots': [{'frame': 0, 'value': 0.25}]}], 'rigs': [{'type': 'tail', 'name': 't', 'joints': 4, 'position': [0, "
    "0.26, 0], 'channels': [{'spline': 'sway', 'lag': 6, 'gain': 5}]}]}";

/// A slider that is dragged to an end and far beyond stops there, and the document is one that loads. What curves are there, the show's tests
/// say for all modes, starts and ends.
SESSION_TEST(test_sliders_have_ends, panel_open(s, tail, 1280, 1600))
{
    static const struct {
        const char *mode, *name, *member;
        double ends[2];
    } rows[] = {{"complex", "frequency", "splines.0.frequency", {0, 12}},
                {"complex", "damping", "splines.0.damping", {0, 1}},
                {"real", "damping", "splines.0.damping", {0, 3}},
                {"complex", "bandwidth", "splines.0.bandwidth", {0, 1}},
                {"complex", "calm", "splines.0.calm", {0, 1}},
                {"complex", "lag", "rigs.0.channels.0.lag", {0, 30}},
                {"complex", "gain", "rigs.0.channels.0.gain", {0, 20}},
                {"cubic", "rest", "rigs.0.rest", {-15, 15}}};
    hands(s, "click section.advanced");
    for (size_t r = 0; r < 2 * sizeof rows / sizeof *rows; r++) {
        hands(s, "click mode.%s; slide %s %.17g; drag %d 0; release; is open 0; is %s %.17g", rows[r / 2].mode,
              rows[r / 2].name, rows[r / 2].ends[r % 2], r % 2 ? 20000 : -20000, rows[r / 2].member,
              rows[r / 2].ends[r % 2]);
        assert_loads_again(s->document);
    }
}

WALK(test_the_place_and_size_of_a_tail, panel_open(s, tail, 1280, 1600),
     "enter position.x 0.5; is rigs.0.position.0 0.5; enter length 2; is rigs.0.length 2;"
     "enter joints 8; is rigs.0.joints 8; is rigs.0.channels.0.gain 2.5;"
     "slide joints 20; slide joints 16; release; is rigs.0.channels.0.gain 1.25;" // from 8, whatever lay between
     "click position.z.follow; click item.walk; is rigs.0.position.2.spline walk; is body.z 0.25 ~1e-6;"
     "click position.z.follow; is rigs.0.position.2 0.25 ~1e-3;" // stays where it was
     "undone")

WALK(test_channels, panel_open(s, tail, 1280, 1600),
     "click axis.0; click item.lift; is rigs.0.channels.0.axis up;"
     "click part.displacement; is rigs.0.channels.0.of displacement;"
     "click feed.0; click item.walk; is rigs.0.channels.0.spline walk; is active.name walk;"
     "click channel.add; is rigs.0.channels.# 2; is rigs.0.channels.1.spline walk; is channel 1;"
     "click axis.1; click item.nod; is rigs.0.channels.1.axis nod; is rigs.0.channels.1.gain 10;" // as nods have it
     "click channel.0; click channel.delete; is rigs.0.channels.# 1; is rigs.0.channels.0.spline walk;"
     "click channel.delete; is rigs.0.channels.# 0; lacks gain; undone")

WALK(test_angles_one_for_each_joint, panel_open(s, tail, 1280, 1600),
     "click lag.each; is rigs.0.channels.0.lag.1 6 ~1e-9; is rigs.0.channels.0.lag.2 12 ~1e-9;"
     "is rigs.0.channels.0.lag.3 18 ~1e-9; is rigs.0.channels.0.lag.0 0 ~1e-9;"
     "shows 0.0 → 18.0°; click lag.each; is rigs.0.channels.0.lag 6 ~1e-9;" // lit: back to one
     "click gain.each; click gain.ramp; is rigs.0.channels.0.gain.ramp list; click gain.ramp; is "
     "rigs.0.channels.0.gain > 0;"
     "click rest.each; is rigs.0.rest.# 4")

/// A curve is drawn by a drag over the joints: one step, which Esc takes back; arrows go along it.
SESSION_TEST(test_angles_are_drawn, panel_open(s, tail, 1280, 1600))
{
    const int *joint = &s->editor->inspector->joint[ANGLE_GAIN];
    hands(s, "click gain.each; keep;"
             "press gain.curve; drag 80 -20;" // from the first joint; a third of the way is the next
             "is rigs.0.channels.0.gain.0 > 5; is rigs.0.channels.0.gain.2 5");
    assert_true(number(s, "rigs.0.channels.0.gain.1") > number(s, "rigs.0.channels.0.gain.0"));
    assert_int_equal(*joint, 1);
    hands(s, "key Escape; kept; release;"
             "carry gain.curve 300 10 6; is rigs.0.channels.0.gain.2 < 5; is rigs.0.channels.0.gain.3 < 5; once;"
             "click gain.curve");
    const int at = *joint;
    hands(s, "keep rigs.0.channels.0.gain.%d; key Up; is rigs.0.channels.0.gain.%d kept+0.5 ~1e-9; key Left Up", at,
          at);
    assert_int_equal(*joint, at - 1);
}

/// What a tail shares with another is not asked about. View state is no edit.
WALK(test_a_tail_is_named_copied_and_deleted, panel_open(s, tail, 1280, 1600),
     "click tail.name; key Ctrl+A; type brush; key Enter; is rigs.0.name brush;"
     "click rig.copy; is rigs.# 2; is stage.tails 2; is rig 1;"
     "click rig.delete; is rigs.# 1; is asked none;"
     "click rig.delete; is asked ask; key K; is rigs.# 0; is stage.tails 0; is splines.# 2;"
     "click rig.add; click item.tail; is rigs.# 1; is rigs.0.type tail; undone;"
     "click onion; click trail; click record; is onion 1; is trail 1; is record 1; label; kept")

/// An angle of each joint scales as a whole; nothing is lost on the way through zero. The numbers are those of the edited spline.
WALK(test_a_tails_array_scales_as_a_whole, panel_open(s, scene, 1280, 1600),
     "slide gain 18; is rigs.0.channels.0.gain.0 6 ~1e-12; is rigs.0.channels.0.gain.2 18;"
     "at 0 300; is rigs.0.channels.0.gain.2 0; slide gain 9; is rigs.0.channels.0.gain.0 3 ~1e-12;"
     "release; key Ctrl+Z; is rigs.0.channels.0.gain.0 3;"
     "key PageUp; is channel 1; key PageDown; is channel 0;"
     "click channel.1; slide lag 12; release; is rigs.0.channels.1.lag 12; is rigs.0.channels.0.lag 6.5")

// --- characters ---------------------------------------------------------------------------------------------------------

static int make_model(void **state)
{
    if (folder_make(state) != 0) return -1;
    struct character character = puppet_character(0.1f, 3);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[0].re[i][1] = 0.2f;
        character.coordinates[1].im[i][0] = 0.3f;
    }
    character.coordinates[0].frequency = 1.25;
    puppet_write(&character, folder_path("puppet.glb"));
    return 0;
}

TESTS_BETWEEN(make_model, folder_remove)

/// A character behind a tail: of several rigs its own is edited.
static void open_puppet(struct session *s, const char *more_rigs, const char *coordinates)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{'frames': [0, 48], 'splines': [{'name': 's', 'frequency': 1, 'knots': [{'frame': 0, 'value': 1}, "
             "{'frame': 20, 'value': -1}]}, {'name': 't', 'knots': [{'frame': 9, 'value': 2}]}], 'rigs': [%s{'type': "
             "'character', 'model': '%s', 'coordinates': [%s]}]}",
             more_rigs, folder_path("puppet.glb"), coordinates);
    panel_open_models(s, text);
    session_frame(s);
}

static const struct stage_model *on_stage(const struct session *s, int index)
{
    const struct stage_view *view = editor_stage(s->editor);
    assert_true(index < view->model_count);
    return &view->models[index];
}

SESSION_TEST(test_a_character_behind_a_tail_is_edited,
             open_puppet(s, "{'type': 'tail', 'name': 'tail', 'channels': []}, ", "{'name': 'a', 'spline': 's'}"))
{
    hands(s, "enter drive.lag 90; is rigs.1.coordinates.0.lag 90; once");
}

/// Both coordinates are one limb, until one spline is chosen.
SESSION_TEST(test_a_lag_is_the_characters,
             open_puppet(s, "", "{'name': 'a', 'spline': 's', 'lag': 20}, {'name': 'b', 'spline': 't', 'lag': 30}"))
{
    hands(s, "enter drive.lag 40; is rigs.0.coordinates.0.lag 40; is rigs.0.coordinates.1.lag 60;"
             "click spline.t; enter drive.lag 15; is rigs.0.coordinates.0.lag 40; is rigs.0.coordinates.1.lag 15");
}

SESSION_TEST(test_a_character_is_edited_live, open_puppet(s, "", "{'name': 'a', 'spline': 's'}"))
{
    const float before = on_stage(s, 0)->posed.morph.weight[0][0];
    hands(s, "slide amplitude 1.5; is rigs.0.coordinates.0.amplitude 1.5 ~0.05");
    assert_near(on_stage(s, 0)->posed.morph.weight[0][0],
                (double)before * number(s, "rigs.0.coordinates.0.amplitude"), 1e-4);
    hands(s, "release; once; enter drive.lag 90; is rigs.0.coordinates.0.lag 90;"
             "key Ctrl+Z; is rigs.0.coordinates.0.lag 0; key Ctrl+Z; kept; label;"
             "click drive.add.0; click item.b; is rigs.0.coordinates.# 2; is rigs.0.coordinates.1.name b;"
             "enter offset 2.5; is rigs.0.offset 2.5; label Set offset; key Ctrl+Z; is rigs.0.offset nothing;"
             "click drive.1; click drive.splines.0; click item.t; is rigs.0.coordinates.1.spline t;"
             "is rigs.0.coordinates.0.spline s");
    assert_int_equal(on_stage(s, 0)->posed.morph.count, 2);
    hands(s, "click drive.0.remove; is rigs.0.coordinates.# 1; is rigs.0.coordinates.0.name b; undone");
}

/// The map of phases, and the stiff look.
SESSION_TEST(test_views_of_a_character, open_puppet(s, "", "{'name': 'a', 'spline': 's'}"))
{
    const struct stage_model *const it = on_stage(s, 0);
    assert_int_equal(it->map_coordinate, -1);
    hands(s, "click phases.z; wait");
    assert_true(it->map_coordinate == 0 && it->map_axis == 2);
    hands(s, "kept; label; key Right");
    assert_true(fabsf(it->posed.morph.weight[0][1]) > 1e-3f);
    session_key(s, 'V', 0);
    assert_near(it->posed.morph.weight[0][1], 0, 0);
}

// --- the list of the history ----------------------------------------------------------------------------------------------

/// Opens the section, with `steps` knots inserted one after the other.
static void open_list(struct session *s, int steps)
{
    panel_open(s,
               "{'frames': [0, 480], 'splines': [{'name': 'sway', 'mode': 'cubic', 'knots': [{'frame': 0, "
               "'value': 0}]}]}",
               1280, 1184);
    hands(s, "click section.history; key Shift+Left");
    for (int i = 0; i < steps; i++) hands(s, "key Right I");
    hands(s, "is splines.0.knots.# %d", 1 + steps);
}

/// What was undone stays in the list. While a drag holds a step open, the list does nothing.
SESSION_TEST(test_a_click_goes_to_a_step, open_list(s, 4))
{
    hands(s, "finds history.4; lacks history.5; click history.1; is splines.0.knots.# 2; finds history.4;"
             "click history.3; is splines.0.knots.# 4; click history.0; is splines.0.knots.# 1; is history.saved 1;"
             "click history.2");
    history_begin(s->history, "Drag", 0);
    hands(s, "click history.0; is splines.0.knots.# 3");
    history_end(s->history);
}

/// A press gives no keyboard focus; Tab does.
WALK(test_keys_go_through_the_steps, open_list(s, 4),
     "click section.history; click section.history; tab history.4; key Up Up; is splines.0.knots.# 3;"
     "key Down; is splines.0.knots.# 4; key 9*Up; is splines.0.knots.# 1;"
     "key Tab Enter; is splines.0.knots.# 2") // the row after it

/// More steps than rows: the list follows the present one, and the wheel shows the others.
WALK(test_a_long_history, open_list(s, 40),
     "finds history.40; lacks history.0; click history.36; is splines.0.knots.# 37;"
     "wheel 1 20; finds history.0; is splines.0.knots.# 37;" // looking is not going
     "click history.2; is splines.0.knots.# 3;"
     "key 26*Ctrl+Shift+Z; finds history.28")

/// Over the list the wheel moves only that, until it is at its end; then the panel.
SESSION_TEST(test_the_wheel_over_the_history, open_list(s, 40))
{
    const struct ui_list *steps = &s->editor->inspector->history.list;
    editor_resize(s->editor, 1280, 600, 1);
    unfold(s->editor, "section.history");
    hands(s, "wait; hover section.history; keep scrolled; is scrolled > 100");
    session_move(s, s->x, s->y + 60);
    for (float top = steps->offset; top > 0; top = steps->offset) {
        hands(s, "wheel 1; is scrolled kept");
        assert_true(steps->offset < top);
    }
    hands(s, "wheel 1; is scrolled < kept");
}

WALK(test_the_background,
     panel_open(s, "{'frames': [0, 9], 'background': {'file': 'films/walk.mp4', 'mine': 1}}", 1280, 1500),
     "more; click section.scene; shows walk.mp4; keep; enter background.offset -12; is background.offset -12;"
     "label Move background; undone;"
     "click background.delete; is background nothing; hides walk.mp4; lacks widget(background.offset);"
     "label Remove background; undone; is background.mine 1")

/// The list says what it does not have any more.
SESSION_TEST(test_a_history_that_has_dropped_steps, open_list(s, 0))
{
    editor_resize(s->editor, 1280, 984, 1);
    history_set_limit(s->history, 2000);
    for (int i = 0; i < 40; i++) hands(s, "key Right I");
    const int dropped = (int)history_dropped(s->history);
    assert_true(dropped > 10);
    for (int i = 0; i < 20; i++) {
        hands(s, "hover section.history");
        session_move(s, s->x, s->y + 40);
        session_wheel(s, 1);
    }
    hands(s, "click history.0; is splines.0.knots.# %d; shows %d older steps were dropped", 1 + dropped, dropped);
}

// --- the first start: what an animator needs first, each further section when it is wanted, and More for the rest ---------------

static void open_first(struct session *s)
{
    session_open_file(s, "assets/scenes/tail.json");
    show_more(s->editor, false);
    session_frame(s);
}

SESSION_TEST(test_twenty_controls_at_the_first_start, open_first(s))
{
    static const char *const headers[] = {"section.feel", "section.knot"};
    const struct ui *ui = inspector_of(s->editor);
    hands(s, "finds preset.cat; finds frequency; finds damping; finds wind-up; finds lag; finds gain;"
             "finds spline.sway; finds splines.add; finds more; finds look.stiff;"
             "lacks follow.frequency; lacks gain.ramp; lacks gain.curve;"
             "lacks section.spline; lacks section.rigs; lacks section.tail; lacks section.pins;"
             "lacks section.limits; lacks section.history; wait");
    int count = ui->stop_count; // that Tab reaches, without headers
    for (int i = 0; i < 2 * ui->stop_count; i++) count -= ui->stop[i / 2].id == ui_id(ui, headers[i % 2]);
    assert_in_range(count, 10, 20);
}

/// A section comes with what it is about, and goes with it or when it is closed.
SESSION_TEST(test_sections_come_when_they_are_wanted, open_first(s))
{
    hands(s, "key H; finds section.pins; key Escape; lacks section.pins;" // it pins the tip
             "key A; type tai; key Enter; finds section.tail; click section.tail; lacks section.tail;"
             "click more; finds follow.frequency; key F9; lacks follow.frequency; key F9");
    sections(s->editor)->offset = 1e6f;
    hands(s, "wait; finds section.history");
}

/// A click on a tail makes it the subject: its spline is the active one, and its section comes.
WALK(test_a_clicked_tail_is_shown, open_first(s),
     "key PageDown PageDown; lacks section.tail;" // the breath
     "click tail(tail,0.8); is active.name sway; finds section.tail;"
     "key PageDown; click tail(tail,0.8); is active.name up; is steps 0") // bent by this one, too

/// Without splines there is something to begin with.
WALK(test_an_empty_scene_is_not_an_empty_inspector, panel_open(s, "{'frames': [0, 96]}", 1280, 720),
     "more off; finds rig.add; finds splines.add")

static const char mixed[] =
    "{'frames': [0, 96], 'splines': [{'name': 'tail', 'frequency': 1, 'damping': 0.1, 'knots': [{'frame': 0, "
    "'value': "
    "1}]}, {'name': 'cubic', 'mode': 'cubic', 'knots': [{'frame': 0, 'value': 1}]}, {'name': 'follows', 'frequency': "
    "{'spline': 'cubic'}, 'knots': [{'frame': 0, 'value': 1}]}, {'name': 'fast', 'frequency': 40, 'knots': "
    "[{'frame': "
    "0, 'value': 1}]}, {'name': 'idle', 'mode': 'real', 'knots': []}], 'rigs': [{'type': 'tail', 'name': 'tail', "
    "'joints': 3, 'channels': [{'spline': 'tail', 'lag': {'ramp': [[0, 6], [1, 9]]}, 'gain': [3, 6, 9]}, {'spline': "
    "'fast', 'axis': 'up'}]}]}";

/// No row moves when another spline becomes active, whatever kind it is and whatever is said of it; nor with More, beside a spline whose lag
/// or gain is a curve.
SESSION_TEST(test_rows_stay_where_they_are, panel_open(s, mixed, 1280, 2000))
{
    static const char *const rows[] = {"section.knot", "more", "section.rigs", "section.tail"};
    for (int more = 0; more < 2; more++) {
        const int count = more ? 4 : 2;
        hands(s, more ? "more" : "more off");
        for (int r = 0; r < count; r++) hands(s, "keep y:%s", rows[r]);
        for (int i = 0; i < 5; i++) {
            hands(s, "key PageDown; wait");
            for (int r = 0; r < count; r++) hands(s, "is y:%s kept", rows[r]);
        }
    }
}

/// Where a text is drawn; outside the panel if it is scrolled out of sight.
static float drawn_at(const struct session *s, const char *words)
{
    const struct draw_command *text = shown_text(s->editor, words);
    return text ? text->y : -1e6f;
}

/// In the frame in which the panel gets shorter, or a section is asked for, it is drawn where it stays. A section higher than the panel is
/// shown from its top, also if it is half in sight.
SESSION_TEST(test_the_first_frame_is_right, panel_open(s, mixed, 1280, 360))
{
    struct inspector *inspector = s->editor->inspector;
    hands(s, "more");
    inspector->sections.offset = 1e6f;
    session_frame(s);
    for (int unfolded = 0; unfolded < 2; unfolded++) {
        const char *title = unfolded ? "Tail set-up" : "More";
        if (unfolded) inspector_unfold(inspector, "section.tail");
        show_more(s->editor, unfolded);
        session_frame(s);
        const float first = drawn_at(s, title);
        session_frame(s);
        assert_near(drawn_at(s, title), first, 0);
        assert_in_range(first, 0, unfolded ? 2 * UI_ROW : 360);
    }
    inspector->sections.offset += 100;
    inspector_unfold(inspector, "section.tail");
    session_frame(s);
    assert_in_range(drawn_at(s, "Tail set-up"), 0, 2 * UI_ROW);
}
