/// The keyboard: one table of what a key does, one of what a typed character does. docs/keys.md lists them.
#include "editor/keys.h"
#include "editor/core/bones.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/drag.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/dialogs/dialogs.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "ui/theme.h"
#include <math.h>

/// Asks the app, or first the user, where to or whether work may be lost.
static void ask_for(struct editor *editor, enum request_kind kind, int number)
{
    const struct request request = {.kind = kind, .number = number};
    const bool has_path = editor->core.path[0] != '\0';
    if (kind == REQUEST_NEW || kind == REQUEST_OPEN || kind == REQUEST_FIGURE || kind == REQUEST_QUIT) {
        editor_leave(editor, &request);
    } else if (kind == REQUEST_SAVE_AS || (kind == REQUEST_SAVE && !has_path)) {
        dialogs_save_as(editor->dialogs, &editor->core);
    } else if (kind == REQUEST_EXPORT) {
        dialogs_export(editor->dialogs, &editor->core);
    } else {
        editor->core.request = request;
    }
}

static void run_insert(struct editor *e, int argument)
{
    core_insert_on_curve(&e->core, core_frame(&e->core), true, argument);
}

/// Whether a pin is selected that has not been undone.
static bool has_pin(const struct editor *editor)
{
    int rig;
    return pins_selected(&editor->core, &rig) != NULL;
}

/// Puts the brush away; without one, stops to pick a bone, ends presenting, lets go of the bone or pin that is selected, or clears the selection.
static void run_select_none(struct editor *e, int argument)
{
    (void)argument;
    if (e->core.brush.on) {
        characters_set_brush(&e->core, false);
    } else if (e->core.pick.use != BONE_SELECTED) {
        e->core.pick = (struct bone_pick){0};
    } else if (e->core.presenter.on) {
        presenter_toggle(&e->core, 0);
    } else if (e->core.bone.any) {
        bones_clear(&e->core);
    } else if (has_pin(e)) {
        pins_clear(&e->core);
    } else {
        selection_clear(&e->core.selection);
    }
}

static void run_hold(struct editor *e, int argument)
{
    (void)argument;
    stage_hold_point(e->stage, &e->core);
}

static void run_frame(struct editor *e, int argument)
{
    if (!argument && core_panel_at(&e->core, e->core.pointer_x, e->core.pointer_y) == PANEL_STAGE) {
        stage_fit(e->stage, &e->core);
    } else if (argument) {
        curves_frame_selection(e->curves, &e->core);
    } else {
        curves_frame_all(e->curves, &e->core);
    }
}

enum clipboard_use { CLIPBOARD_COPY, CLIPBOARD_CUT, CLIPBOARD_PASTE, CLIPBOARD_DUPLICATE };

/// Not while a value is typed: knots are not what is meant then.
static void run_clipboard(struct editor *e, int argument)
{
    if (inspector_ui(e->inspector)->typing) return;
    if (argument == CLIPBOARD_DUPLICATE) {
        core_duplicate_knots(&e->core);
    } else if (argument == CLIPBOARD_PASTE) {
        core_request(&e->core, REQUEST_PASTE, NULL);
    } else if (core_copy_knots(&e->core, argument == CLIPBOARD_CUT)) {
        core_request(&e->core, REQUEST_COPY, NULL);
    }
}

static void run_brush(struct editor *e, int argument)
{
    (void)argument;
    characters_set_brush(&e->core, !e->core.brush.on);
    if (e->core.brush.on) inspector_unfold(e->inspector, "section.character");
}

static void run_theme(struct editor *e, int argument)
{
    (void)e;
    (void)argument;
    theme_use((theme_in_use() + 1) % THEME_COUNT);
}

/// Arguments of run_pan() and run_orbit().
enum way { WAY_LEFT, WAY_RIGHT, WAY_UP, WAY_DOWN };

static const double PAN = 0.1;  ///< of the panel's size
static const double ZOOM = 0.8; ///< of what is seen, a step
static const float TURN = 0.1f; ///< radians
static const int way_sign[][2] = {
    [WAY_LEFT] = {-1, 0}, [WAY_RIGHT] = {1, 0}, [WAY_UP] = {0, -1}, [WAY_DOWN] = {0, 1}};

static void run_pan(struct editor *editor, int way)
{
    const struct rect *plot = &editor->core.layout.plot;
    curves_pan(editor->curves, &editor->core, -PAN * way_sign[way][0] * plot->w, -PAN * way_sign[way][1] * plot->h);
}

static void run_zoom(struct editor *editor, int direction)
{
    const struct rect *plot = &editor->core.layout.plot;
    double factor = direction > 0 ? ZOOM : 1 / ZOOM;
    curves_zoom(editor->curves, &editor->core, plot->x + plot->w / 2, plot->y + plot->h / 2, factor, factor);
}

static void run_orbit(struct editor *editor, int way)
{
    stage_orbit(editor->stage, TURN * (float)way_sign[way][0], -TURN * (float)way_sign[way][1]);
}

static void run_approach(struct editor *editor, int direction)
{
    stage_approach(editor->stage, (float)(direction > 0 ? ZOOM : 1 / ZOOM));
}

static void run_fit_stage(struct editor *editor, int argument)
{
    (void)argument;
    stage_fit(editor->stage, &editor->core);
}

/// The first of the sizes that is clearly larger than the present one, round the end.
static double next_size(const double sizes[3], double present)
{
    int next = 0;
    while (next < 3 && sizes[next] <= present * 1.01) next++;
    return sizes[next % 3];
}

static void run_panel(struct editor *editor, int inspector)
{
    static const double shares[3] = {0.35, 0.575, 0.75}, widths[3] = {280, 360, 440};
    double share = (double)editor->core.layout.stage_share, width = (double)editor->core.layout.inspector_width;
    if (inspector) {
        width = next_size(widths, width);
    } else {
        share = next_size(shares, share);
    }
    core_set_panels(&editor->core, share, width);
}

enum { CTRL_SHIFT = MOD_CTRL | MOD_SHIFT };

const struct binding key_bindings[] = {
    {.key = 'Z', .mods = MOD_CTRL, .repeats = true, .core = core_undo, .argument = -1},
    {.key = 'Z', .mods = MOD_CTRL | MOD_SHIFT, .repeats = true, .core = core_undo, .argument = 1},
    {.key = 'Y', .mods = MOD_CTRL, .repeats = true, .core = core_undo, .argument = 1},
    {.key = 'N', .mods = MOD_CTRL, .request = REQUEST_NEW},
    {.key = 'O', .mods = MOD_CTRL, .request = REQUEST_OPEN},
    {.key = 'Q', .mods = MOD_CTRL, .request = REQUEST_QUIT},
    {.key = 'S', .mods = MOD_CTRL, .request = REQUEST_SAVE},
    {.key = 'S', .mods = MOD_CTRL | MOD_SHIFT, .request = REQUEST_SAVE_AS},
    {.key = 'E', .mods = MOD_CTRL, .request = REQUEST_EXPORT},
    {.key = '1', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 1},
    {.key = '2', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 2},
    {.key = '3', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 3},
    {.key = '4', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 4},
    {.key = '5', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 5},
    {.key = '6', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 6},
    {.key = '7', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 7},
    {.key = '8', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 8},
    {.key = '9', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 9},
    {.key = '0', .mods = MOD_CTRL, .request = REQUEST_FIGURE, .argument = 10},
    {.key = '=', .mods = CTRL_SHIFT, .repeats = true, .request = REQUEST_UI_SCALE, .argument = 1},
    {.key = '+', .mods = CTRL_SHIFT, .repeats = true, .request = REQUEST_UI_SCALE, .argument = 1},
    {.key = '-', .mods = CTRL_SHIFT, .repeats = true, .request = REQUEST_UI_SCALE, .argument = -1},
    {.key = '0', .mods = CTRL_SHIFT, .request = REQUEST_UI_SCALE, .argument = 0},
    {.key = KEY_F8, .mods = MOD_SHIFT, .repeats = true, .request = REQUEST_UI_SCALE, .argument = -1},
    {.key = KEY_F8, .repeats = true, .request = REQUEST_UI_SCALE, .argument = 1},
    {.key = KEY_F5, .core = presenter_toggle},
    {.key = KEY_F10, .any_time = true, .run = run_theme},
    {.key = KEY_F11, .any_time = true, .request = REQUEST_FULLSCREEN},
    {.key = KEY_F12, .any_time = true, .request = REQUEST_SCREENSHOT},
    {.key = 'I', .run = run_insert, .argument = false},
    {.key = 'I', .mods = MOD_SHIFT, .run = run_insert, .argument = true},
    {.key = KEY_DELETE, .core = core_delete},
    {.key = KEY_BACKSPACE, .core = core_delete},
    {.key = 'A', .inspector = inspector_add_menu},
    {.key = KEY_DELETE, .mods = MOD_SHIFT, .inspector = inspector_remove_rig},
    {.key = 'A', .mods = MOD_CTRL, .core = core_select_all, .argument = false},
    {.key = 'A', .mods = CTRL_SHIFT, .core = core_select_all, .argument = true},
    {.key = 'A', .mods = MOD_SHIFT, .core = core_flip, .argument = SWITCH_AUTO_KEY},
    {.key = KEY_ESCAPE, .run = run_select_none},
    {.key = 'C', .mods = MOD_CTRL, .run = run_clipboard, .argument = CLIPBOARD_COPY},
    {.key = 'X', .mods = MOD_CTRL, .run = run_clipboard, .argument = CLIPBOARD_CUT},
    {.key = 'V', .mods = MOD_CTRL, .run = run_clipboard, .argument = CLIPBOARD_PASTE},
    {.key = 'D', .mods = MOD_CTRL, .run = run_clipboard, .argument = CLIPBOARD_DUPLICATE},
    {.key = KEY_PAGE_UP, .repeats = true, .core = core_activate_neighbour, .argument = -1},
    {.key = KEY_PAGE_DOWN, .repeats = true, .core = core_activate_neighbour, .argument = 1},
    {.key = KEY_PAGE_UP, .mods = MOD_SHIFT, .repeats = true, .knot = core_extend_selection, .argument = -1},
    {.key = KEY_PAGE_DOWN, .mods = MOD_SHIFT, .repeats = true, .knot = core_extend_selection, .argument = 1},
    {.key = 'P', .core = core_set_hold, .argument = HOLDS_POSE},
    {.key = 'P', .mods = MOD_SHIFT, .core = core_set_hold, .argument = HOLDS_STILL},
    {.key = 'T', .core = slopes_set, .argument = SLOPES_TOGGLE},
    {.key = 'T', .mods = MOD_SHIFT, .core = slopes_set, .argument = SLOPES_FLAT},
    {.key = 'T', .mods = MOD_CTRL, .core = slopes_set, .argument = SLOPES_SMOOTH},
    {.key = 'D', .repeats = true, .core = slopes_turn, .argument = -1},
    {.key = 'E', .repeats = true, .core = slopes_turn, .argument = 1},
    {.key = 'D', .mods = MOD_SHIFT, .repeats = true, .core = slopes_stiffen, .argument = -1},
    {.key = 'E', .mods = MOD_SHIFT, .repeats = true, .core = slopes_stiffen, .argument = 1},
    {.key = 'M', .core = core_cycle_choice, .argument = PARAMETER_MODE},
    {.key = 'M', .mods = MOD_SHIFT, .core = core_cycle_choice, .argument = PARAMETER_PASSIVE},
    {.key = 'F', .mods = MOD_SHIFT, .core = core_find_frequency},
    {.key = KEY_F2, .inspector = inspector_rename},
    {.key = 'S', .curves = curves_scale, .argument = false},
    {.key = 'S', .mods = MOD_SHIFT, .curves = curves_scale, .argument = true},
    {.key = 'N', .core = core_flip, .argument = SWITCH_NORMALISE},
    {.key = KEY_F3, .core = core_flip, .argument = SWITCH_SHEET},
    {.key = 'U', .any_time = true, .core = core_flip, .argument = SWITCH_SECONDS},
    {.key = 'G', .any_time = true, .core = core_flip, .argument = SWITCH_SNAP},
    {.key = KEY_UP, .repeats = true, .core = core_nudge_parameter, .argument = 1},
    {.key = KEY_DOWN, .repeats = true, .core = core_nudge_parameter, .argument = -1},
    {.key = KEY_LEFT, .repeats = true, .core = playback_step, .argument = -1},
    {.key = KEY_RIGHT, .repeats = true, .core = playback_step, .argument = 1},
    {.key = KEY_LEFT, .mods = MOD_SHIFT, .core = playback_end, .argument = -1},
    {.key = KEY_RIGHT, .mods = MOD_SHIFT, .core = playback_end, .argument = 1},
    {.key = 'L', .mods = MOD_CTRL, .core = core_flip, .argument = SWITCH_LOOP},
    {.key = KEY_HOME, .mods = MOD_CTRL, .core = playback_mark, .argument = 0},
    {.key = KEY_END, .mods = MOD_CTRL, .core = playback_mark, .argument = 1},
    {.key = KEY_LEFT, .mods = MOD_CTRL, .repeats = true, .run = run_pan, .argument = WAY_LEFT},
    {.key = KEY_RIGHT, .mods = MOD_CTRL, .repeats = true, .run = run_pan, .argument = WAY_RIGHT},
    {.key = KEY_UP, .mods = MOD_CTRL, .repeats = true, .run = run_pan, .argument = WAY_UP},
    {.key = KEY_DOWN, .mods = MOD_CTRL, .repeats = true, .run = run_pan, .argument = WAY_DOWN},
    {.key = KEY_PAGE_UP, .mods = MOD_CTRL, .repeats = true, .run = run_zoom, .argument = 1},
    {.key = KEY_PAGE_DOWN, .mods = MOD_CTRL, .repeats = true, .run = run_zoom, .argument = -1},
    {.key = '=', .mods = MOD_CTRL, .repeats = true, .run = run_zoom, .argument = 1},
    {.key = '+', .mods = MOD_CTRL, .repeats = true, .run = run_zoom, .argument = 1},
    {.key = '-', .mods = MOD_CTRL, .repeats = true, .run = run_zoom, .argument = -1},
    {.key = KEY_LEFT, .mods = CTRL_SHIFT, .repeats = true, .run = run_orbit, .argument = WAY_LEFT},
    {.key = KEY_RIGHT, .mods = CTRL_SHIFT, .repeats = true, .run = run_orbit, .argument = WAY_RIGHT},
    {.key = KEY_UP, .mods = CTRL_SHIFT, .repeats = true, .run = run_orbit, .argument = WAY_UP},
    {.key = KEY_DOWN, .mods = CTRL_SHIFT, .repeats = true, .run = run_orbit, .argument = WAY_DOWN},
    {.key = KEY_PAGE_UP, .mods = CTRL_SHIFT, .repeats = true, .run = run_approach, .argument = 1},
    {.key = KEY_PAGE_DOWN, .mods = CTRL_SHIFT, .repeats = true, .run = run_approach, .argument = -1},
    {.key = KEY_HOME, .mods = MOD_SHIFT, .run = run_fit_stage},
    {.key = 'W', .curves = curves_remedy_first},
    {.key = KEY_F6, .run = run_panel, .argument = 0},
    {.key = KEY_F6, .mods = MOD_SHIFT, .run = run_panel, .argument = 1},
    {.key = KEY_HOME, .run = run_frame, .argument = 0},
    {.key = KEY_END, .run = run_frame, .argument = 1},
    {.key = 'V', .any_time = true, .core = core_turn_look},
    {.key = 'O', .any_time = true, .core = core_flip, .argument = SWITCH_ONION},
    {.key = KEY_F4, .any_time = true, .core = core_flip, .argument = SWITCH_GHOST},
    {.key = 'O', .mods = MOD_SHIFT, .any_time = true, .core = core_flip, .argument = SWITCH_TRAIL},
    {.key = 'K', .run = run_brush},
    {.key = 'H', .run = run_hold},
    {.key = KEY_PAGE_UP, .mods = MOD_ALT, .repeats = true, .core = pins_retime, .argument = -1},
    {.key = KEY_PAGE_DOWN, .mods = MOD_ALT, .repeats = true, .core = pins_retime, .argument = 1},
    {.key = ',', .mods = MOD_ALT, .repeats = true, .pins = true, .knot = core_visit_neighbour, .argument = -1},
    {.key = '.', .mods = MOD_ALT, .repeats = true, .pins = true, .knot = core_visit_neighbour, .argument = 1},
    {.key = KEY_HOME, .mods = MOD_ALT, .repeats = true, .pins = true, .knot = core_visit_neighbour, .argument = -1},
    {.key = KEY_END, .mods = MOD_ALT, .repeats = true, .pins = true, .knot = core_visit_neighbour, .argument = 1},
    {.key = 'J', .core = bones_make_chain, .argument = false},
    {.key = 'J', .mods = MOD_SHIFT, .core = bones_make_chain, .argument = true},
    {.key = 0},
};

const struct binding character_bindings[] = {
    {.key = ',', .repeats = true, .pins = true, .knot = core_select_neighbour, .argument = -1},
    {.key = '.', .repeats = true, .pins = true, .knot = core_select_neighbour, .argument = 1},
    {.key = '<', .repeats = true, .knot = core_extend_selection, .argument = -1},
    {.key = '>', .repeats = true, .knot = core_extend_selection, .argument = 1},
    {.key = '[', .core = playback_mark, .argument = 0},
    {.key = ']', .core = playback_mark, .argument = 1},
    {.key = '-', .any_time = true, .core = playback_change_speed, .argument = -1},
    {.key = '=', .any_time = true, .core = playback_change_speed, .argument = 1},
    {.key = '+', .any_time = true, .core = playback_change_speed, .argument = 1},
    {.key = 0},
};

static const struct nudge_key {
    int key;
    int frames, values; ///< frames, and hundredths of the visible values; of a pin, hundredths of what is seen
} nudge_keys[] = {
    {.key = KEY_LEFT, .frames = -1},
    {.key = KEY_RIGHT, .frames = 1},
    {.key = KEY_UP, .values = 1},
    {.key = KEY_DOWN, .values = -1},
};

/// Alt+arrows; Shift ten times, Ctrl a tenth.
static bool nudge_event(struct editor *editor, const struct event *event)
{
    if (!(event->mods & MOD_ALT)) return false;
    double factor = event->mods & MOD_SHIFT ? 10 : event->mods & MOD_CTRL ? 0.1 : 1;
    for (size_t i = 0; i < sizeof nudge_keys / sizeof nudge_keys[0]; i++) {
        if (nudge_keys[i].key != event->key) continue;
        const double across = nudge_keys[i].frames * factor, up = nudge_keys[i].values * factor;
        if (has_pin(editor)) {
            stage_nudge_pin(editor->stage, &editor->core, across, up);
        } else {
            curves_nudge(editor->curves, &editor->core, across, up);
        }
        return true;
    }
    return false;
}

/// Space plays on release, unless it was used to pan.
static void space_event(struct editor *editor, const struct event *event)
{
    if (event->action == ACTION_PRESS) {
        editor->core.space_down = true;
        editor->core.space_used = false;
    } else if (event->action == ACTION_RELEASE && editor->core.space_down) {
        editor->core.space_down = false;
        if (!editor->core.space_used) playback_toggle(&editor->core);
    }
}

static bool is_held_letter(int key) { return key == 'L' || parameter_of_letter(key) != PARAMETER_COUNT; }

/// Does what is bound, unless it excludes key repeats or running drags; true if anything is bound.
static bool run(struct editor *editor, const struct binding *list, int key, unsigned mods, bool repeated)
{
    struct core *core = &editor->core;
    const struct binding *b = list;
    while (b->key && (b->key != key || b->mods != mods)) b++;
    if ((repeated && !b->repeats) || (history_is_open(core->history) && !b->any_time)) return b->key != 0;
    if (b->run) b->run(editor, b->argument);
    if (b->core) b->core(core, b->argument);
    if (b->curves) b->curves(editor->curves, core, b->argument);
    if (b->inspector) b->inspector(editor->inspector);
    if (b->request) ask_for(editor, b->request, b->argument);
    const bool pins = b->pins && has_pin(editor);
    if (pins) pins_select_neighbour(core, b->argument);
    const struct knot *knot = b->knot && !pins ? b->knot(core, b->argument) : NULL;
    if (knot) curves_reveal(editor->curves, core, knot->frame, core_knot_value(core, core->active, knot));
    return b->key != 0;
}

/// The character of a key that was used elsewhere, say to close the help, is no command.
static bool text_event(struct editor *editor, const struct event *event)
{
    const struct press *press = &editor->press;
    return !press->used && run(editor, character_bindings, (int)event->codepoint, 0, press->repeated);
}

bool keys_event(struct editor *editor, const struct event *event)
{
    if (event->kind == EVENT_TEXT) return text_event(editor, event);
    unsigned mods = event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT);
    if (event->key == KEY_SPACE && (mods == 0 || event->action == ACTION_RELEASE)) {
        space_event(editor, event);
        return true;
    }
    if (event->action == ACTION_RELEASE) {
        if (event->key == editor->core.held_key) editor->core.held_key = 0;
        return false;
    }
    if (mods == 0 && event->action == ACTION_PRESS && is_held_letter(event->key)) editor->core.held_key = event->key;
    if (nudge_event(editor, event)) return true;
    const bool bound = run(editor, key_bindings, event->key, mods, event->action == ACTION_REPEAT);
    editor->press.used |= bound && mods & MOD_ALT; // some systems still send the character of such a key
    return bound;
}
