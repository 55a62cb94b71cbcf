/// What an animator feels first: presets, time to settle, wind-up, what is the limb's, what stays in its place, and a sentence on every control
/// near the pointer.
#include "panel_session.h"

static const char tail_scene[] =
    "{\"wiggly\": 1, \"frames\": [0, 96], \"splines\": [" PANEL_SPLINES "],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"joints\": 3, \"rest\": [4, -2, 1], \"channels\": ["
    "{\"spline\": \"sway\", \"axis\": \"side\", \"lag\": 6.5, \"gain\": {\"ramp\": [[0, 3], [1, 9]]}},"
    "{\"spline\": \"lift\", \"axis\": \"up\", \"lag\": 5, \"gain\": [1, 2, 3]}]}]}";

static const struct param *of(const struct session *s, enum parameter which)
{
    return &s->document->splines[active(s->editor)]->parameter[which];
}

SESSION_TEST(test_a_preset_is_one_step, panel_open(s, tail_scene, 1280, 720))
{
    const char *before = session_saved(s);
    panel_click(s, "preset.whip");
    assert_near(of(s, PARAMETER_FREQUENCY)->value, 1.8, 0);
    assert_near(of(s, PARAMETER_DAMPING)->value, 0.12, 0);
    assert_near(document_tail(s->document, 0)->channels[0].lag.value[0], 130, 0); // 260° over two joints
    assert_near(document_tail(s->document, 0)->channels[1].lag.value[0], 130, 0);
    assert_near(of(s, PARAMETER_WIND_UP)->value, 0.35, 0);
    assert_one_step(s, before);
    session_key(s, 'Z', MOD_CTRL);
    panel_click(s, "spline.pace"); // a cubic begins to swing; it bends nothing
    panel_click(s, "preset.antenna");
    assert_int_equal(spline_mode(s->document->splines[1]), WIGGLY_COMPLEX);
    assert_near(of(s, PARAMETER_FREQUENCY)->value, 5, 0);
    assert_near(document_tail(s->document, 0)->channels[0].lag.value[0], 6.5, 0);
}

static const char limb_scene[] =
    "{\"frames\": [0, 96], \"splines\": ["
    "{\"name\": \"bend\", \"frequency\": 1.1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 1}]},"
    "{\"name\": \"lift\", \"frequency\": 1.4, \"damping\": 0.1, \"wind_up\": 0.5, \"knots\": []},"
    "{\"name\": \"led\", \"frequency\": {\"spline\": \"pace\"}, \"damping\": 0.2, \"knots\": []},"
    "{\"name\": \"still\", \"mode\": \"real\", \"frequency\": 0, \"damping\": 1.2, \"knots\": []},"
    "{\"name\": \"breath\", \"frequency\": 0.5, \"damping\": 0.1, \"knots\": []},"
    "{\"name\": \"pace\", \"mode\": \"cubic\", \"knots\": [{\"frame\": 0, \"value\": 2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"brush\", \"joints\": 3, \"channels\": ["
    "{\"spline\": \"bend\", \"axis\": \"side\", \"lag\": 6}, {\"spline\": \"lift\", \"axis\": \"up\", \"lag\": [1, "
    "-4, 2]},"
    "{\"spline\": \"led\", \"axis\": \"up\", \"lag\": 0}, {\"spline\": \"still\", \"axis\": \"side\", \"lag\": 3},"
    "{\"spline\": \"breath\", \"axis\": \"breath\", \"lag\": 2}]}]}";

static void preset(struct session *s) { panel_click(s, "preset.heavy"); }
static void type_frequency(struct session *s) { panel_enter(s, "frequency", "2.2"); }
static void drag_damping(struct session *s)
{
    panel_drag(s, "damping", 0.2);
    panel_release(s);
}
static void type_wind_up(struct session *s) { panel_enter(s, "wind-up", "11"); }
static void type_settle(struct session *s)
{
    show_more(s->editor, true);
    session_frame(s);
    panel_enter(s, "settle", "1.2");
}
static void press_f_up(struct session *s)
{
    session_hold(s, 'F', ACTION_PRESS);
    session_key(s, KEY_UP, 0);
    session_hold(s, 'F', ACTION_RELEASE);
}
static void with_alt(struct session *s)
{
    s->mods = MOD_ALT;
    type_frequency(s);
    s->mods = 0;
}
static void after_the_curve(struct session *s)
{
    const wiggly_value here = evaluation_at(solved(s->editor), 0, 20);
    char curve[64];
    snprintf(curve, sizeof curve, "curve(bend,20,%g)", here.y + here.re);
    session_click(s, curve);
    type_frequency(s);
}
static void after_the_row(struct session *s)
{
    panel_click(s, "spline.bend");
    type_frequency(s);
}
static void after_the_tail(struct session *s)
{
    panel_click(s, "spline.bend");
    session_click(s, "tail(brush,0.8)");
    type_frequency(s);
}

/// Of bend, lift, led, still and breath. Ratios stay, 0 and what follows a spline too; a preset keeps the ratios of frequencies alone.
SESSION_TEST(test_a_weight_is_the_limbs, panel_open(s, limb_scene, 1280, 900))
{
    static const struct {
        void (*change)(struct session *s);
        enum parameter parameter;
        double values[5];
    } cases[] = {
        {type_frequency, PARAMETER_FREQUENCY, {2.2, 2.8, 0, 0, 0.5}},
        {press_f_up, PARAMETER_FREQUENCY, {1.15, 1.463636, 0, 0, 0.5}},
        {preset, PARAMETER_FREQUENCY, {0.5, 0.636364, 0, 0, 0.5}},
        {preset, PARAMETER_DAMPING, {0.35, 0.35, 0.35, 0.35, 0.1}},
        {preset, PARAMETER_WIND_UP, {0.7, 0.7, 0.7, 0, 0}},
        {drag_damping, PARAMETER_DAMPING, {0.2, 0.2, 0.4, 2.4, 0.1}},
        {type_wind_up, PARAMETER_WIND_UP, {0.5042, 0.5, 0.5042, 0, 0}},
        {type_settle, PARAMETER_DAMPING, {0.3612, 0.3612, 0.7224, 4.3344, 0.1}},
        {with_alt, PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {after_the_curve, PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {after_the_row, PARAMETER_FREQUENCY, {2.2, 1.4, 0, 0, 0.5}},
        {after_the_tail, PARAMETER_FREQUENCY, {2.2, 2.8, 0, 0, 0.5}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        session_close(s);
        panel_open(s, limb_scene, 1280, 900);
        show_more(s->editor, false);
        const char *before = session_saved(s);
        cases[i].change(s);
        for (int k = 0; k < 5; k++) {
            const struct param *param = &s->document->splines[k]->parameter[cases[i].parameter];
            if (fabs(param->value - cases[i].values[k]) > 1e-4)
                fail_msg("case %zu: %g of %s", i, param->value, s->document->splines[k]->name);
            assert_int_equal(param->track, cases[i].parameter == PARAMETER_FREQUENCY && k == 2 ? 5 : -1);
        }
        assert_one_step(s, before);
    }
}

static void assert_lags(const struct session *s, double bend, double lift, double led, double still)
{
    const struct channel *c = document_tail(s->document, 0)->channels;
    const double lags[] = {bend, lift, led, still, 2};
    for (int k = 0; k < 5; k++) assert_near(angles_largest(&c[k].lag), lags[k], 1e-5);
    assert_near(c[1].lag.value[0], -lift / 4, 1e-5);
}

SESSION_TEST(test_a_lag_is_the_limbs, panel_open(s, limb_scene, 1280, 900))
{
    panel_enter(s, "lag", "12");
    assert_lags(s, 12, -8, 0, 6);
    s->mods = MOD_ALT;
    panel_enter(s, "lag", "6");
    s->mods = 0;
    assert_lags(s, 6, -8, 0, 6);
    session_hold(s, 'L', ACTION_PRESS);
    for (int i = 0; i < 6; i++) session_key(s, KEY_UP, 0);
    session_hold(s, 'L', ACTION_RELEASE);
    assert_lags(s, 9, -12, 0, 9);
    panel_click(s, "spline.led");
    panel_enter(s, "lag", "4");
    assert_lags(s, 9, -12, 4, 9);
}

/// The heading says what the rows are of, also while Alt is held.
SESSION_TEST(test_the_heading_names_the_limb, panel_open(s, limb_scene, 1280, 900))
{
    assert_true(session_shows(s, "Feel · brush (4 splines)"));
    session_send(s, (struct event){.kind = EVENT_KEY, .key = 0, .action = ACTION_PRESS, .mods = MOD_ALT});
    session_frame(s);
    assert_true(session_shows(s, "Feel · bend"));
    session_send(s, (struct event){.kind = EVENT_KEY, .key = 0, .action = ACTION_RELEASE});
    session_frame(s);
    assert_true(session_shows(s, "Feel · brush (4 splines)"));
    for (int i = 0; i < 4; i++) session_key(s, KEY_PAGE_DOWN, 0);
    assert_true(session_shows(s, "Feel · breath"));
    session_click(s, "tail(brush,0.8)");
    assert_true(session_shows(s, "Feel · brush (4 splines)"));
}

/// All knots but still ones settle, or none does, in one step.
SESSION_TEST(test_pose_to_pose_settles_at_every_knot, panel_open(s, tail_scene, 1280, 1700))
{
    struct spline **const *splines = &s->document->splines;
    session_click(s, "knot(sway,0)");
    session_key(s, 'P', MOD_SHIFT);
    const char *before = session_saved(s);
    panel_click(s, "settles.all.on");
    assert_true(!(*splines)[0]->knots[0].settles && (*splines)[0]->knots[1].settles &&
                (*splines)[0]->knots[2].settles);
    assert_false((*splines)[2]->knots[0].settles);
    assert_one_step(s, before);
    panel_click(s, "settles.all.off");
    assert_true(!(*splines)[0]->knots[1].settles && !(*splines)[0]->knots[2].settles);
    panel_click(s, "spline.pace"); // a cubic does not settle
    assert_false(panel_shows(s, "settles.all.on"));
}

/// Calm is of the whole curve, or of a loop.
SESSION_TEST(test_calm_shows_where_it_acts, panel_open(s, tail_scene, 1280, 1700))
{
    panel_click(s, "section.advanced");
    assert_true(panel_shows(s, "calm"));
    panel_enter(s, "wind-up", "12");
    assert_false(panel_shows(s, "calm"));
    session_hold(s, 'C', ACTION_PRESS);
    session_key(s, KEY_DOWN, 0);
    session_hold(s, 'C', ACTION_RELEASE);
    assert_near(of(s, PARAMETER_CALM)->value, 1, 0);
    assert_said(s->editor, "whole curves");
    panel_click(s, "start.loop");
    assert_true(panel_shows(s, "calm"));
}

/// An exponential's envelope falls to 5 % after ln 20 / (2π f ζ).
SESSION_TEST(test_the_time_to_settle_is_set, panel_open(s, tail_scene, 1280, 900))
{
    const double tau = 2 * acos(-1.0), ln20 = log(20);
    const char *before = session_saved(s);
    panel_enter(s, "settle", "2");
    assert_near(of(s, PARAMETER_FREQUENCY)->value, 1, 0);
    assert_near(of(s, PARAMETER_DAMPING)->value, ln20 / (tau * 2), 1e-4);
    assert_one_step(s, before);
    panel_enter(s, "settle", "0.01"); // sooner than critical damping
    assert_said_error(s->editor, "settles in: expected 0.48");
    session_key(s, KEY_ESCAPE, 0);
    panel_pull(s, "settle", 20, 0, 4); // a second later
    assert_near(of(s, PARAMETER_DAMPING)->value, ln20 / (tau * 3), 2e-3);
    panel_click(s, "mode.real");
    panel_enter(s, "settle", "1.5");
    const double damping = of(s, PARAMETER_DAMPING)->value;
    assert_true(damping > 0.2 && damping < 0.4);
}

/// At 24 frames a second a period of 1 Hz has 24; beyond two of them stands the whole curve.
SESSION_TEST(test_the_wind_up_is_set_in_frames, panel_open(s, tail_scene, 1280, 900))
{
    static const struct {
        const char *typed;
        double periods;
    } cases[] = {{"12", 0.5}, {"47", 1.9583}, {"48", 0}, {"1", 0.0417}, {"900", 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const char *before = session_saved(s);
        panel_enter(s, "wind-up", cases[i].typed);
        assert_near(of(s, PARAMETER_WIND_UP)->value, cases[i].periods, 0);
        assert_one_step(s, before);
    }
    panel_enter(s, "wind-up", "0");
    assert_true(said_error(s->editor));
    session_key(s, KEY_ESCAPE, 0);
    panel_click(s, "mode.real");
    assert_false(panel_shows(s, "wind-up"));
    inspector_add(s->editor->inspector, ADD_SPLINE);
    assert_near(of(s, PARAMETER_WIND_UP)->value, 0.5, 0);
}

static float place_of(struct session *s, const char *name)
{
    float x, y;
    assert_true(widget_at(s->editor, name, &x, &y));
    return y;
}

SESSION_TEST(test_selecting_knots_moves_nothing, panel_open(s, tail_scene, 1280, 1600))
{
    const float before = place_of(s, "mode.real");
    session_click(s, "knot(sway,1)");
    assert_near((double)place_of(s, "mode.real"), (double)before, 0);
    session_key(s, 'T', 0);
    assert_near((double)place_of(s, "mode.real"), (double)before, 0);
    session_key(s, 'A', MOD_CTRL);
    assert_near((double)place_of(s, "mode.real"), (double)before, 0);
}

static void wait(struct session *s, int frames)
{
    for (int i = 0; i < frames; i++) session_frame(s);
}

/// It comes after half a second of rest, beside the pointer and inside the window, and goes with a press.
SESSION_TEST(test_a_tooltip_is_near_the_pointer, panel_open(s, tail_scene, 960, 600))
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
        wait(s, 20);
        session_move(s, x + 2, y); // not at rest yet
        wait(s, 20);
        assert_false(tooltip_is_shown(tooltip));
        wait(s, 20);
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
    wait(s, 40);
    assert_false(tooltip_is_shown(tooltip));
    session_key(s, KEY_TAB, 0); // the first section's header has the keyboard
    wait(s, 40);
    assert_true(tooltip_is_shown(tooltip));
    assert_true(tooltip_box(tooltip, window).x > window.w - 280);
}

SESSION_TEST(test_controls_below_have_tooltips, panel_open(s, tail_scene, 960, 600))
{
    static const char *const controls[] = {"play", "loop", "speed", "auto-key", "keep", "size", "present"};
    for (size_t i = 0; i < sizeof controls / sizeof controls[0]; i++) {
        char target[32];
        snprintf(target, sizeof target, "widget(%s)", controls[i]);
        session_hover(s, target);
        wait(s, 40);
        assert_true(tooltip_is_shown(tooltip_of(s->editor)));
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

SESSION_TEST(test_every_control_of_a_tail_explains_itself, panel_open(s, tail_scene, 1280, 3200))
{
    session_click(s, "knot(sway,1)");
    session_key(s, 'T', 0);
    assert_all_explained(s);
    panel_click(s, "mode.real");
    panel_click(s, "spline.lift");
    assert_all_explained(s);
}

static void open_file(struct session *s, const char *scene)
{
    struct models *models = panel_open_models(s, scene);
    assert_non_null(models);
    editor_resize(s->editor, 1280, 3200, 1);
    wait(s, 2);
}

SESSION_TEST(
    test_every_control_of_characters_explains_itself,
    open_file(
        s,
        "{\"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": 0, "
        "\"value\": 1}]}], \"rigs\": ["
        "{\"type\": \"character\", \"model\": \"assets/models/creature.glb\", \"coordinates\": "
        "[{\"name\": \"up\", \"spline\": \"s\"}], \"pins\": [{\"frame\": 4, \"vertex\": 9, \"to\": [0, 1, 0]}]}]}"))
{
    session_key(s, 'B', MOD_SHIFT);
    assert_all_explained(s);
    session_close(s);
    open_file(s, "{\"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"knots\": [{\"frame\": 0, "
                 "\"value\": 1}]}], \"rigs\": [{\"type\": \"model\", \"name\": \"dog\", \"model\": "
                 "\"assets/models/dog.glb\"}, {\"type\": \"chain\", \"name\": \"ear\", \"model\": \"dog\", \"from\": "
                 "\"ear_1_L\", \"to\": \"ear_2_L\", \"channels\": [{\"spline\": \"s\"}]}]}");
    session_key(s, 'J', 0);
    assert_all_explained(s);
}

SESSION_TEST(test_presets_can_be_read_on_a_small_window, panel_open(s, tail_scene, 640, 360))
{
    static const char *const words[] = {"Cat", "Whip", "Heavy", "Jelly", "Antenna"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) assert_true(session_shows(s, words[i]));
    panel_click(s, "preset.jelly");
    assert_near(of(s, PARAMETER_FREQUENCY)->value, 3, 0);
}
