/// What an animator feels first: presets, time to settle, wind-up, what is the limb's, the dice, what stays in its place,
/// and a sentence on every control near the pointer.
#include "hands.h"

static const char tail_scene[] = "{'wiggly': 1, 'frames': [0, 96], 'splines': [" PANEL_SPLINES
                                 "], 'rigs': [{'type': 'tail', 'name': 'tail', 'joints': 3, 'rest': [4, -2, 1], "
                                 "'channels': [{'spline': 'sway', 'axis': 'side', 'lag': 6.5, 'gain': {'ramp': [[0, "
                                 "3], [1, 9]]}}, {'spline': 'lift', 'axis': 'up', 'lag': 5, 'gain': [1, 2, 3]}]}]}";

static const struct tail *tail_of(const struct session *s) { return document_tail(s->document, 0); }

/// 260° over two joints. A cubic begins to swing; it bends nothing.
SESSION_TEST(a_preset_is_one_step, panel_open(s, tail_scene, 1280, 720))
{
    hands(s, "keep; click preset.whip; sway.frequency 1.8 ~0; sway.damping 0.12 ~0; sway.wind_up 0.35 ~0");
    for (int i = 0; i < 2; i++) assert_near(tail_of(s)->channels[i].lag.value[0], 130, 0);
    hands(s, "once; key Ctrl+Z; click spline.pace; click preset.antenna; pace.mode 0; pace.frequency 5 ~0");
    assert_near(tail_of(s)->channels[0].lag.value[0], 6.5, 0);
}

static const char limb_scene[] =
    "{'frames': [0, 96], 'splines': [{'name': 'bend', 'frequency': 1.1, 'damping': 0.1, 'knots': [<0 1>]}, {'name': "
    "'lift', 'frequency': 1.4, 'damping': 0.1, 'wind_up': 0.5, 'knots': []}, {'name': 'led', 'frequency': {'spline': "
    "'pace'}, 'damping': 0.2, 'knots': []}, {'name': 'still', 'mode': 'real', 'frequency': 0, 'damping': 1.2, "
    "'knots': []}, {'name': 'breath', 'frequency': 0.5, 'damping': 0.1, 'knots': []}, {'name': 'pace', 'mode': "
    "'cubic', 'knots': [<0 2>]}], 'rigs': [{'type': 'tail', 'name': 'brush', 'joints': 3, 'channels': [{'spline': "
    "'bend', 'axis': 'side', 'lag': 6}, {'spline': 'lift', 'axis': 'up', 'lag': [1, -4, 2]}, {'spline': 'led', "
    "'axis': 'up', 'lag': 0}, {'spline': 'still', 'axis': 'side', 'lag': 3}, {'spline': 'breath', 'axis': 'breath', "
    "'lag': 2}]}]}";

/// Of bend, lift, led, still and breath. Ratios stay, 0 and what follows a spline too; a preset keeps the ratios of frequencies alone.
TEST(a_weight_is_the_limbs)
{
#define FREQUENCY "enter frequency 2.2"
    static const struct {
        const char *steps; ///< %g: where the curve is at 20
        enum parameter parameter;
        double values[5];
    } rows[] = {
        {FREQUENCY, PARAMETER_FREQUENCY, {2.2, 2.8, 0, 0, 0.5}},
        {"hold F; key Up; let F", PARAMETER_FREQUENCY, {1.15, 1.463636, 0, 0, 0.5}},
        {"click preset.heavy", PARAMETER_FREQUENCY, {0.5, 0.636364, 0, 0, 0.5}},
        {"click preset.heavy", PARAMETER_DAMPING, {0.35, 0.35, 0.35, 0.35, 0.1}},
        {"click preset.heavy", PARAMETER_WIND_UP, {0.7, 0.7, 0.7, 0, 0}},
        {"slide damping 0.2; release", PARAMETER_DAMPING, {0.2, 0.2, 0.4, 2.4, 0.1}},
        {"enter wind-up 11", PARAMETER_WIND_UP, {0.5042, 0.5, 0.5042, 0, 0}},
        {"enter settle 1.2", PARAMETER_DAMPING, {0.3612, 0.3612, 0.7224, 4.3344, 0.1}},
        {"with Alt; " FREQUENCY "; with", PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {"click curve(bend,20,%g); " FREQUENCY, PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {"click spline.bend; " FREQUENCY, PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {"click spline.bend; click tail(brush,0.8); " FREQUENCY, PARAMETER_FREQUENCY, {2.2, 2.8, 0, 0, 0.5}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct session session, *const s = &session;
        panel_open(s, limb_scene, 1280, 900);
        if (strstr(rows[i].steps, "settle")) unfold(s->editor, "section.advanced");
        hands(s, "keep; wait 1");
        hands(s, rows[i].steps, s->work.evaluation.curves[0].total[20]);
        for (int k = 0; k < 5; k++) {
            const struct param *param = &s->document->splines[k]->parameter[rows[i].parameter];
            const int track = rows[i].parameter == PARAMETER_FREQUENCY && k == 2 ? 5 : -1;
            if (fabs(param->value - rows[i].values[k]) > 1e-4 || param->track != track)
                fail_msg("%s: %g of %s", rows[i].steps, param->value, s->document->splines[k]->name);
        }
        hands(s, "once");
        session_close(s);
    }
}

/// Of bend, lift, led and still; the breath's stays 2. A lag of several joints keeps its shape.
SESSION_TEST(a_lag_is_the_limbs, panel_open(s, limb_scene, 1280, 900))
{
    static const struct {
        const char *steps;
        double lags[5];
    } rows[] = {{"enter lag 12", {12, -8, 0, 6, 2}},
                {"with Alt; enter lag 6; with", {6, -8, 0, 6, 2}},
                {"hold L; key 6*Up; let L", {9, -12, 0, 9, 2}},
                {"click spline.led; enter lag 4", {9, -12, 4, 9, 2}}};
    for (int i = 0; i < 4; i++) {
        hands(s, "%s", rows[i].steps);
        const struct channel *channels = tail_of(s)->channels;
        for (int k = 0; k < 5; k++) {
            const double lag = angles_largest(&channels[k].lag);
            if (fabs(lag - rows[i].lags[k]) > 1e-5) fail_msg("%s: %g of channel %d", rows[i].steps, lag, k);
        }
        assert_near(channels[1].lag.value[0], -rows[i].lags[1] / 4, 1e-5);
    }
}

/// The heading says what the rows are of, also while Alt is held.
SESSION_TEST(the_heading_names_the_limb, panel_open(s, limb_scene, 1280, 900))
{
    hands(s, "shows Feel · brush (4 splines)");
    session_send(s, (struct event){.kind = EVENT_KEY, .key = 0, .action = ACTION_PRESS, .mods = MOD_ALT});
    hands(s, "wait 1; shows Feel · bend");
    session_send(s, (struct event){.kind = EVENT_KEY, .key = 0, .action = ACTION_RELEASE});
    hands(s, "wait 1; shows Feel · brush (4 splines); key 4*PageDown; shows Feel · breath; click tail(brush,0.8);"
             "shows Feel · brush (4 splines)");
}

/// All knots but still ones settle, or none does, in one step; a cubic does not settle.
WALK(pose_to_pose_settles_at_every_knot, panel_open(s, tail_scene, 1280, 1700),
     "click knot(sway,0); key Shift+P; keep; click settles.all.on; sway.settles 0 1 1; lift.settles 0; once;"
     "click settles.all.off; sway.settles 0 0 0; click spline.pace; lacks settles.all.on")

/// A limb's poses become values that all of its splines settle at; Alt means the active spline alone.
WALK(pose_to_pose_is_of_the_limb, panel_open(s, tail_scene, 1280, 1700),
     "carry tail(tail,0.8) 20 10; keep; key Alt+Shift+P; sway.posed 0 0 0; sway.settles 1 1 1; once")

/// Calm is of the whole curve, or of a loop.
WALK(calm_shows_where_it_acts, panel_open(s, tail_scene, 1280, 1700),
     "click section.advanced; finds calm; enter wind-up 12; lacks calm; click start.loop; finds calm")

/// An exponential's envelope falls to 5 % after ln 20 / (2π f ζ). No sooner than with critical damping; then a second later.
WALK(the_time_to_settle_is_set, panel_open(s, tail_scene, 1280, 1700),
     "click section.advanced; keep; enter settle 2; sway.frequency 1 ~0; sway.damping 0.238394 ~1e-4; once; enter "
     "settle 0.01;"
     "error settles in: expected 0.48; key Escape; carry settle 20 0; sway.damping 0.158929 ~2e-3;"
     "click mode.real; enter settle 1.5; sway.damping 0.3 ~0.0999")

/// At 24 frames a second a period of 1 Hz has 24; beyond two of them stands the whole curve.
SESSION_TEST(the_wind_up_is_set_in_frames, panel_open(s, tail_scene, 1280, 900))
{
    static const char *const rows[][2] = {
        {"12", "0.5"}, {"47", "1.9583"}, {"48", "0"}, {"1", "0.0417"}, {"900", "0"}};
    for (int i = 0; i < 5; i++) hands(s, "keep; enter wind-up %s; sway.wind_up %s ~0; once", rows[i][0], rows[i][1]);
    hands(s, "enter wind-up 0; error wind-up; key Escape; click mode.real; lacks wind-up");
    inspector_add(s->editor->inspector, ADD_SPLINE);
    assert_near(active_spline(s->editor)->parameter[PARAMETER_WIND_UP].value, 0.5, 0);
}

SESSION_TEST(selecting_knots_moves_nothing, panel_open(s, tail_scene, 1280, 1600))
{
    static const char *const steps[] = {"wait 1", "click knot(sway,1)", "key T", "key Ctrl+A"};
    float x, y, before = 0;
    for (int i = 0; i < 4; i++) {
        hands(s, "%s", steps[i]);
        assert_true(widget_at(s->editor, "mode.real", &x, &y));
        if (i > 0) assert_near(y, before, 0);
        before = y;
    }
}

// --- the dice, and the frequency of knots ---

/// Extrema of 1.25 Hz, 24 frames a second, and more.
#define EXTREMA "<5 1>, <15 -0.9>, <24 0.8>"
#define EXTREME(more)                                                                                                \
    "{'wiggly': 1, 'frames': [0, 120], 'splines': [{'name': 'sway', 'frequency': 3, 'damping': 0.4, "                \
    "'knots': [" EXTREMA more "]}]}"
#define SWINGING EXTREME(", <34 -0.7>, <43 0.62>")

WALK(a_key_finds_the_frequency, session_open(s, SWINGING),
     "wait 1; keep; key Shift+F; wait 1; sway.frequency 1.26 ~0.06; sway.damping < 0.1; key Ctrl+Z; kept")
WALK(too_few_knots_are_told, session_open(s, EXTREME("")),
     "wait 1; key Shift+F; said Four knots; sway.frequency 3 ~0")

SESSION_TEST(the_dice_rolls_another_motion, panel_open(s, SWINGING, 1280, 1200))
{
    hands(s, "keep; click section.variation");
    const double before = s->world.evaluation->curves[0].total[20];
    hands(s, "click variation.roll; wait 1; sway@20 ! %.17g; sway@15 -0.9 ~0", before);
    const struct param *parameters = s->document->splines[0]->parameter;
    assert_near(parameters[PARAMETER_VARIATION].value, 0.3, 0);
    const double seed = parameters[PARAMETER_SEED].value;
    hands(s, "click variation.roll");
    assert_true(s->document->splines[0]->parameter[PARAMETER_SEED].value != seed);
    hands(s, "key 2*Ctrl+Z; kept");
}

WALK(the_file_has_both_numbers_and_what_else_is_there,
     session_open(s, "{'wiggly': 1, 'frames': [0, 24], 'splines': [{'name': 'a', 'frequency': 1, 'variation': "
                     "{'seed': 7, 'amount': 0.3, 'mood': 'mild'}, 'knots': []}]}"),
     "saves \"variation\": { \"seed\": 7, \"amount\": 0.3, \"mood\": \"mild\" }")

// --- a sentence on every control ---

/// It comes after half a second of rest, beside the pointer and inside the window, and goes with a press.
SESSION_TEST(a_tooltip_is_near_the_pointer, panel_open(s, tail_scene, 960, 600))
{
    static const char *const names[] = {"frequency", "preset.cat", "look.cubic"};
    const struct rect window = layout_of(s->editor)->window;
    const struct tooltip *tooltip = tooltip_of(s->editor);
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        float x, y;
        assert_true(widget_at(s->editor, names[i], &x, &y));
        session_move(s, x, y);
        session_frame(s);
        assert_false(tooltip_is_shown(tooltip));
        assert_true(editor_wants_frames(s->editor));
        hands(s, "wait 20");
        session_move(s, x + 2, y); // not at rest yet
        hands(s, "wait 20");
        assert_false(tooltip_is_shown(tooltip));
        hands(s, "wait 20");
        assert_true(tooltip_is_shown(tooltip));
        const struct rect box = tooltip_box(tooltip, window);
        assert_false(rect_contains(box, s->x, s->y));
        assert_true(fabsf(box.y + box.h / 2 - s->y) < 80 && box.x <= s->x + 20);
        assert_true(box.x >= 0 && box.y >= 0 && box.x + box.w <= window.w && box.y + box.h <= window.h);
    }
    session_press(s, BUTTON_MIDDLE, 1);
    session_frame(s);
    assert_false(tooltip_is_shown(tooltip));
    session_release(s, BUTTON_MIDDLE);
    session_move(s, 100, 100);
    hands(s, "wait 40");
    assert_false(tooltip_is_shown(tooltip));
    session_key(s, KEY_TAB, 0); // the first section's header has the keyboard
    hands(s, "wait 40");
    assert_true(tooltip_is_shown(tooltip));
    assert_true(tooltip_box(tooltip, window).x > window.w - 280);
}

SESSION_TEST(controls_below_have_tooltips, panel_open(s, tail_scene, 960, 600))
{
    static const char *const controls[] = {"play", "loop", "speed", "auto-key", "keep", "size"};
    for (size_t i = 0; i < sizeof controls / sizeof controls[0]; i++) {
        hands(s, "hover widget(%s); wait 40", controls[i]);
        if (!tooltip_is_shown(tooltip_of(s->editor))) fail_msg("%s has no tooltip", controls[i]);
    }
}

/// All words of a tooltip are drawn, inside its box.
static void assert_whole(const struct tooltip *tooltip, struct rect window)
{
    struct drawlist list;
    char said[512] = "";
    const struct rect box = tooltip_box(tooltip, window);
    drawlist_create(&list, 64, 1024, 1024);
    drawlist_clear(&list, window);
    tooltip_show(tooltip, window, &list);
    for (int i = 0; i < list.count; i++) {
        const struct draw_command *c = &list.commands[i];
        if (c->kind != DRAW_TEXT) continue;
        const char *line = list.text + c->first;
        strcat(strcat(said, *said && said[strlen(said) - 1] != ' ' ? " " : ""), line);
        assert_true(c->x > box.x && c->x + font_width(c->font, c->width, line) < box.x + box.w);
        assert_true(c->y - c->width > box.y && c->y < box.y + box.h);
    }
    assert_string_equal(said, tooltip->text);
    drawlist_destroy(&list);
}

/// Points at each control that Tab could reach, in every section.
static void assert_all_explained(struct session *s)
{
    struct ui *ui = inspector_of(s->editor);
    panel_unfold(s);
    struct ui_stop stops[UI_MAX_FOCUS];
    const int count = ui->stop_count;
    assert_true(count > 40 && count < UI_MAX_FOCUS);
    memcpy(stops, ui->stop, sizeof stops);
    for (int i = 0; i < count; i++) {
        const struct rect *r = &stops[i].rect;
        session_move(s, r->x + r->w / 2, r->y + r->h / 2);
        session_frame(s);
        const char *hint = inspector_of(s->editor)->hint;
        if (!hint)
            fail_msg("the control at %g, %g, %g × %g has no tooltip", (double)r->x, (double)r->y, (double)r->w,
                     (double)r->h);
        assert_whole(&(struct tooltip){.text = hint, .at = *r, .rest = 1}, layout_of(s->editor)->window);
    }
}

SESSION_TEST(every_control_of_a_tail_explains_itself, panel_open(s, tail_scene, 1280, 3200))
{
    hands(s, "click knot(sway,1); key T");
    assert_all_explained(s);
    hands(s, "click mode.real; click spline.lift");
    assert_all_explained(s);
}

static void open_file(struct session *s, const char *scene)
{
    struct models *models = panel_open_models(s, scene);
    assert_non_null(models);
    editor_resize(s->editor, 1280, 3200, 1);
    hands(s, "wait 2");
}

SESSION_TEST(every_control_of_characters_explains_itself,
             open_file(s, "{'frames': [0, 48], 'splines': [{'name': 's', 'frequency': 1, 'knots': [<0 1>]}], 'rigs': "
                          "[{'type': 'character', 'model': 'assets/models/creature.glb', 'coordinates': [{'name': "
                          "'up', 'spline': 's'}], 'pins': [{'frame': 4, 'vertex': 9, 'to': [0, 1, 0]}]}]}"))
{
    hands(s, "key Shift+B");
    assert_all_explained(s);
    session_close(s);
    open_file(s, "{'frames': [0, 48], 'splines': [{'name': 's', 'frequency': 1, 'knots': [<0 1>]}], 'rigs': "
                 "[{'type': 'model', 'name': 'dog', 'model': 'assets/models/dog.glb'}, {'type': 'chain', 'name': "
                 "'ear', 'model': 'dog', 'from': 'ear_1_L', 'to': 'ear_2_L', 'channels': [{'spline': 's'}]}]}");
    hands(s, "key J");
    assert_all_explained(s);
}

WALK(presets_can_be_read_on_a_small_window, panel_open(s, tail_scene, 640, 360),
     "shows Cat; shows Whip; shows Heavy; shows Jelly; shows Antenna; click preset.jelly; sway.frequency 3 ~0")
