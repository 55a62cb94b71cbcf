/// The table of all commands, for keys, F1 and the palette; and the keyboard. docs/keys.md lists them.
#include "editor/core/core.h"
#include "editor/curves/curves.h"
#include "editor/dialogs/dialogs.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "editor/state.h"
#include "ui/theme.h"
#include <math.h>

enum show {
    SHOW_HELP,
    SHOW_PALETTE,
    SHOW_EXAMPLES,
    SHOW_ALL,
    SHOW_SELECTION,
    SHOW_WHOLE_STAGE,
    SHOW_PART_OF_STAGE,
    SHOW_NEXT_THEME
};

static void run_show(struct editor *e, int what)
{
    const bool on_stage = core_panel_at(&e->core, e->core.input.pointer_x, e->core.input.pointer_y) == PANEL_STAGE;
    if (what == SHOW_HELP) dialogs_help(e->dialogs);
    if (what == SHOW_PALETTE) dialogs_palette(e->dialogs, 0);
    if (what == SHOW_EXAMPLES) dialogs_palette(e->dialogs, IN_EXAMPLES);
    if (what == SHOW_ALL && !on_stage) curves_frame_all(e->curves, &e->core);
    if (what == SHOW_SELECTION) curves_frame_selection(e->curves, &e->core);
    if (what == SHOW_WHOLE_STAGE || (what == SHOW_ALL && on_stage)) stage_fit(e->stage, &e->core);
    if (what == SHOW_PART_OF_STAGE) stage_frame(e->stage, &e->core);
    if (what == SHOW_NEXT_THEME) theme_use((theme_in_use() + 1) % THEME_COUNT);
}

static void run_insert(struct editor *e, int argument)
{
    core_insert_knot(&e->core, core_frame(&e->core), NAN, true, (enum holds)argument);
}

/// Escape undoes one mode at a time: brush, bone picking, selected bone, selected pin, selection.
static void run_select_none(struct editor *e, int argument)
{
    (void)argument;
    if (e->core.focus.brush.on) {
        characters_set_brush(&e->core, false);
    } else if (e->core.focus.pick.use != BONE_SELECTED) {
        e->core.focus.pick = (struct bone_pick){0};
    } else if (e->core.cleaning.of) {
        core_simplify(&e->core, false);
    } else if (e->core.focus.bone.any) {
        e->core.focus.bone.any = false;
    } else if (pins_any_selected(&e->core)) {
        e->core.focus.pin = 0;
    } else {
        selection_clear(&e->core.focus.selection);
    }
}

static void run_hold(struct editor *e, int argument)
{
    (void)argument;
    stage_hold_point(e->stage, &e->core);
}

static void run_simplify(struct editor *e, int argument)
{
    core_simplify(&e->core, argument);
    inspector_unfold(e->inspector, "section.knot");
}

enum clipboard_use { CLIPBOARD_COPY, CLIPBOARD_CUT, CLIPBOARD_DUPLICATE, CLIPBOARD_PASTE /* + enum paste */ };

/// Not while a value is typed: Ctrl+C then copies text.
static void run_clipboard(struct editor *e, int argument)
{
    if (inspector_ui(e->inspector)->typing) return;
    if (argument == CLIPBOARD_DUPLICATE) {
        core_duplicate_knots(&e->core);
    } else if (argument >= CLIPBOARD_PASTE) {
        e->core.input.paste = (enum paste)(argument - CLIPBOARD_PASTE);
        core_request(&e->core, &(struct request){.kind = REQUEST_PASTE});
    } else if (core_copy_knots(&e->core, argument == CLIPBOARD_CUT)) {
        core_request(&e->core, &(struct request){.kind = REQUEST_COPY, .text = e->core.clipboard});
    }
}

static void run_brush(struct editor *e, int argument)
{
    (void)argument;
    characters_set_brush(&e->core, !e->core.focus.brush.on);
    if (e->core.focus.brush.on) inspector_unfold(e->inspector, "section.character");
}

enum way { WAY_LEFT, WAY_RIGHT, WAY_UP, WAY_DOWN };

static const double PAN = 0.1;  ///< of the plot
static const double ZOOM = 0.8; ///< per step
static const float TURN = 0.1f; ///< radians
static const int way_sign[][2] = {
    [WAY_LEFT] = {-1, 0}, [WAY_RIGHT] = {1, 0}, [WAY_UP] = {0, -1}, [WAY_DOWN] = {0, 1}};

static void run_pan(struct editor *editor, int way)
{
    const struct rect *plot = &editor->core.view.layout.plot;
    curves_pan(editor->curves, &editor->core, -PAN * way_sign[way][0] * plot->w, -PAN * way_sign[way][1] * plot->h);
}

static void run_zoom(struct editor *editor, int direction)
{
    const struct rect *plot = &editor->core.view.layout.plot;
    double factor = direction > 0 ? ZOOM : 1 / ZOOM;
    curves_zoom(editor->curves, &editor->core, plot->x + plot->w / 2, plot->y + plot->h / 2, factor, factor);
}

static void run_orbit(struct editor *editor, int way)
{
    camera_orbit(&editor->core.view.camera, TURN * (float)way_sign[way][0], -TURN * (float)way_sign[way][1]);
}

enum { FROM_FRONT, FROM_SIDE, FROM_TOP };

static void run_view(struct editor *editor, int from)
{
    struct camera *camera = &editor->core.view.camera;
    camera->azimuth = from == FROM_SIDE ? 0 : -(float)M_PI / 2; // the front looks along +z
    camera->elevation = from == FROM_TOP ? CAMERA_MAX_ELEVATION : 0;
}

static void run_approach(struct editor *editor, int direction)
{
    camera_zoom(&editor->core.view.camera, (float)(direction > 0 ? ZOOM : 1 / ZOOM));
}

/// One frame or 1 % of the visible values; a pin, 1 % of the view. Shift: ten times, Ctrl: a tenth.
static void run_nudge(struct editor *editor, int way)
{
    const unsigned mods = editor->core.input.mods;
    const double size = mods & MOD_SHIFT ? 10 : mods & MOD_CTRL ? 0.1 : 1;
    const double across = size * way_sign[way][0], up = -size * way_sign[way][1];
    const bool pin = pins_any_selected(&editor->core);
    if (pin) stage_nudge_pin(editor->stage, &editor->core, across, up);
    if (!pin) curves_nudge(editor->curves, &editor->core, across, up);
}

/// The first of the sizes clearly above the present one, then the smallest again.
static double next_size(const double sizes[3], double present)
{
    int next = 0;
    while (next < 3 && sizes[next] <= present * 1.01) next++;
    return sizes[next % 3];
}

static void run_panel(struct editor *editor, int inspector)
{
    static const double shares[3] = {0.35, 0.575, 0.75}, widths[3] = {280, 360, 440};
    const struct layout *layout = &editor->core.view.layout;
    const double share = (double)layout->stage_share, width = (double)layout->inspector_width;
    core_set_panels(&editor->core, inspector ? share : next_size(shares, share),
                    inspector ? next_size(widths, width) : width);
}

enum { CTRL = MOD_CTRL, SHIFT = MOD_SHIFT, ALT = MOD_ALT, CTRL_SHIFT = MOD_CTRL | MOD_SHIFT, TYPED = CHORD_TYPED };

const char ABOUT_FILE[] = "File and edits";

/// A row: its name, places, need, when its key works, its function with its argument, its key.
#define COMMAND(...) ALSO("", __VA_ARGS__)
/// The same, which other words find, too.
#define ALSO(words, named, places, need, works, function, number, ...)                                               \
    {                                                                                                                \
        .name = (named), .also = (words), .at = (places), .needs = NEEDS_##need, .when = (works), function,          \
        .argument = (number), .chord = __VA_ARGS__                                                                   \
    }
/// A row that F1 leaves out: in the menu of its places, and in the palette, which finds it by other words, too.
#define MENU(words, named, places, need, function, number) ALSO(words, named, places, need, 0, function, number, {0})
#define PALETTE(named, need, function, number) MENU("", named, 0, need, function, number)
/// A row of the list that Examples opens.
#define EXAMPLE(named, number) COMMAND(named, IN_EXAMPLES, NOTHING, 0, .request = REQUEST_FIGURE, number, {0})
/// A row only in F1 that cannot be run: a gesture or held key.
#define GESTURE(gestured, named, places)                                                                             \
    {                                                                                                                \
        .name = (named), .at = (places), .gesture = (gestured)                                                       \
    }

const struct command commands[] = {
    {.heading = "Knots"},
    GESTURE("Double-click", "Insert a knot at the pointer", ON_CURVES),
    ALSO("key keyframe add", "Insert a knot at the playhead", ON_CURVES, SPLINE, 0, .run = run_insert, HOLDS_VALUE,
         {'I', 0}),
    ALSO("key keyframe add", "Insert a pose at the playhead", 0, SPLINE, 0, .run = run_insert, HOLDS_POSE,
         {'I', SHIFT}),
    GESTURE("Drag a knot", "Move it", ON_KNOT),
    GESTURE("Click, Shift+click", "Select a knot, or add it", ON_KNOT),
    GESTURE("Drag on empty", "Select the knots in a box", ON_CURVES),
    COMMAND("Select all knots of the spline", 0, KNOTS, 0, .core = core_select_all, 0, {'A', CTRL}),
    COMMAND("Select all knots in sight", 0, KNOTS, 0, .core = core_select_all, true, {'A', CTRL_SHIFT}),
    COMMAND("Deselect, or cancel", 0, NOTHING, 0, .run = run_select_none, 0, {KEY_ESCAPE, 0}),
    ALSO("remove erase key", "Delete the selection", ON_KNOT | ON_PIN, CHOSEN, 0, .act = core_delete, 0,
         {KEY_DELETE, 0}),
    COMMAND("Next knot or pin", ON_KNOT | ON_PIN, KNOTS, REPEATS | PINS, .knot = core_select_neighbour, 1,
            {'.', TYPED}),
    COMMAND("Previous knot or pin", ON_PIN, KNOTS, REPEATS | PINS, .knot = core_select_neighbour, -1, {',', TYPED}),
    COMMAND("Go to the next knot or pin", 0, KNOTS, REPEATS | PINS, .knot = core_visit_neighbour, 1, {KEY_END, ALT}),
    COMMAND("Go to the previous knot or pin", 0, KNOTS, REPEATS | PINS, .knot = core_visit_neighbour, -1,
            {KEY_HOME, ALT}),
    COMMAND("Also select the next knot", 0, KNOTS, REPEATS, .knot = core_extend_selection, 1, {KEY_PAGE_DOWN, SHIFT}),
    COMMAND("Also select the previous knot", 0, KNOTS, REPEATS, .knot = core_extend_selection, -1,
            {KEY_PAGE_UP, SHIFT}),
    GESTURE("Alt+arrows", "Nudge (Shift: ×10, Ctrl: ×0.1)", ON_KNOT | ON_PIN),
    COMMAND("Copy", ON_KNOT, SELECTED, 0, .run = run_clipboard, CLIPBOARD_COPY, {'C', CTRL}),
    COMMAND("Cut", 0, SELECTED, 0, .run = run_clipboard, CLIPBOARD_CUT, {'X', CTRL}),
    COMMAND("Paste at the playhead", 0, SPLINE, 0, .run = run_clipboard, CLIPBOARD_PASTE, {'V', CTRL}),
    COMMAND("Paste in place", 0, SPLINE, 0, .run = run_clipboard, CLIPBOARD_PASTE + PASTE_IN_PLACE,
            {'V', CTRL_SHIFT}),
    ALSO("repeat", "Duplicate after the selection", 0, SELECTED, 0, .run = run_clipboard, CLIPBOARD_DUPLICATE,
         {'D', CTRL}),
    ALSO("retime stretch duration length reverse flip time", "Scale the selection", ON_KNOT, SELECTED, 0,
         .curves = curves_scale, 0, {'S', 0}),
    ALSO("amplitude exaggerate", "Scale the swing of the selection", 0, SELECTED, 0, .curves = curves_scale, true,
         {'S', SHIFT}),
    ALSO("clean reduce thin knots", "Simplify: fewer knots", IN_CURVES_MENU, KNOTS, 0, .run = run_simplify, true,
         {0}),
    ALSO("noise average jitter clean", "Smooth the selection", 0, SELECTED, 0, .act = core_smooth_knots, 0, {0}),
    GESTURE("Drag their box", "Scale (Alt: the swing)", 0),

    {.heading = "While dragging"},
    GESTURE("X, Y", "Only time, only value", 0),
    GESTURE("R", "Move all later knots too", 0),
    GESTURE("Shift", "In finer steps", 0),
    GESTURE("Ctrl", "Between the frames", 0),
    GESTURE("Esc", "Cancel", 0),

    {.heading = "Slopes and poses"},
    ALSO("tangent handle", "Slope on or off", ON_KNOT, SELECTED, 0, .core = slopes_set, SLOPES_TOGGLE, {'T', 0}),
    ALSO("tangent ease", "Flat slope", 0, SELECTED, 0, .core = slopes_set, SLOPES_FLAT, {'T', SHIFT}),
    ALSO("tangent", "Smooth slope", 0, SELECTED, 0, .core = slopes_set, SLOPES_SMOOTH, {'T', CTRL}),
    COMMAND("Turn the slope up", 0, SELECTED, REPEATS, .core = slopes_set, SLOPES_UP, {'E', 0}),
    COMMAND("Turn the slope down", 0, SELECTED, REPEATS, .core = slopes_set, SLOPES_DOWN, {'D', 0}),
    COMMAND("Firmer slope", 0, SELECTED, REPEATS, .core = slopes_set, SLOPES_FIRMER, {'E', SHIFT}),
    COMMAND("Softer slope", 0, SELECTED, REPEATS, .core = slopes_set, SLOPES_SOFTER, {'D', SHIFT}),
    COMMAND("Pose: hold every part as it is", ON_KNOT, SELECTED, 0, .core = core_set_hold, HOLDS_POSE, {'P', 0}),
    ALSO("stop hold", "Still: come to rest at the knot", ON_KNOT, SELECTED, 0, .core = core_set_hold, HOLDS_STILL,
         {'P', SHIFT}),
    COMMAND("Settle at the knot's value", 0, SELECTED, 0, .act = core_toggle_settles, 0, {'P', ALT}),
    ALSO("turn stay overshoot", "Pose to pose: settle at every knot", 0, SWING, 0, .act = core_toggle_pose_to_pose, 0,
         {'P', MOD_ALT | MOD_SHIFT}),

    {.heading = "Splines"},
    COMMAND("Next spline", ON_CURVES, SPLINE, REPEATS, .core = core_activate_neighbour, 1, {KEY_PAGE_DOWN, 0}),
    COMMAND("Previous spline", 0, SPLINE, REPEATS, .core = core_activate_neighbour, -1, {KEY_PAGE_UP, 0}),
    GESTURE("Click, Ctrl, Shift", "Select rows of the list", ON_ROW),
    GESTURE("Drag a row", "Move it, or into a folder", ON_ROW),
    COMMAND("Rename the spline", ON_ROW, SPLINE, 0, .inspector = inspector_rename, 0, {KEY_F2, 0}),
    ALSO("mode interpolation", "Next kind: wiggly, spring, cubic", ON_INSPECTOR | ON_ROW, SPLINE, 0,
         .act = core_cycle_mode, 0, {'M', 0}),
    ALSO("fit tempo", "Find the frequency of the knots", ON_INSPECTOR, SWING, 0, .act = core_find_frequency, 0,
         {'F', SHIFT}),
    COMMAND("Compare: wiggly, stiff, cubic", ON_CURVES, NOTHING, ANY_TIME, .act = core_turn_look, 0, {'V', 0}),
    ALSO("repair", "Fix the first warning", ON_CURVES, SPLINE, 0, .curves = curves_remedy_first, 0, {'W', 0}),
    ALSO("snapshot", "Keep the scene as before", 0, NOTHING, 0, .core = take_keep, true, {'K', SHIFT}),
    GESTURE("Hold K", "Show the scene as it was kept", 0),
    GESTURE("Hold F, press ↑ ↓", "Frequency", 0),
    GESTURE("Hold Z, press ↑ ↓", "Damping", 0),
    GESTURE("Hold L, press ↑ ↓", "Lag of the tail", 0),

    {.heading = "Playback"},
    ALSO("stop start", "Play or pause", ON_CURVES | ON_TIME, NOTHING, 0, .act = playback_toggle, 0, {KEY_SPACE, 0}),
    COMMAND("Next frame", ON_TIME, NOTHING, REPEATS, .core = playback_step, 1, {KEY_RIGHT, 0}),
    COMMAND("Previous frame", ON_TIME, NOTHING, REPEATS, .core = playback_step, -1, {KEY_LEFT, 0}),
    COMMAND("Go to the start", ON_TIME, NOTHING, 0, .core = playback_end, -1, {KEY_LEFT, SHIFT}),
    COMMAND("Go to the end", 0, NOTHING, 0, .core = playback_end, 1, {KEY_RIGHT, SHIFT}),
    GESTURE("Drag the ruler", "Scrub", ON_TIME),
    GESTURE("Shift+drag it", "Play a part", ON_TIME),
    ALSO("loop cycle seamless", "Close all curves", 0, SPLINE, 0, .act = core_close_curves, 0, {0}),
    ALSO("range in part", "Play from here", ON_TIME, NOTHING, 0, .core = playback_mark, 0, {KEY_HOME, CTRL}),
    ALSO("range out part", "Play up to here", ON_TIME, NOTHING, 0, .core = playback_mark, 1, {KEY_END, CTRL}),
    ALSO("repeat cycle", "Loop on or off", ON_TIME, NOTHING, 0, .core = core_flip, SWITCH_LOOP, {'L', CTRL}),
    ALSO("speed", "Play faster", 0, NOTHING, ANY_TIME, .core = playback_change_speed, 1, {'+', TYPED}),
    ALSO("speed", "Play slower", 0, NOTHING, ANY_TIME, .core = playback_change_speed, -1, {'-', TYPED}),

    {.heading = "Curves"},
    GESTURE("Wheel", "Zoom (Ctrl: time, Shift: values)", ON_CURVES),
    COMMAND("Zoom in", 0, NOTHING, REPEATS, .run = run_zoom, 1, {KEY_PAGE_UP, CTRL}),
    COMMAND("Zoom out", 0, NOTHING, REPEATS, .run = run_zoom, -1, {KEY_PAGE_DOWN, CTRL}),
    GESTURE("Middle drag", "Pan", ON_CURVES),
    GESTURE("Ctrl+arrows", "Pan", 0),
    ALSO("fit frame home", "Show all", ON_CURVES, NOTHING, 0, .run = run_show, SHOW_ALL, {KEY_HOME, 0}),
    ALSO("fit frame", "Show the selection", 0, SELECTED, 0, .run = run_show, SHOW_SELECTION, {KEY_END, 0}),
    COMMAND("Normalise: all curves equally high", 0, NOTHING, 0, .core = core_flip, SWITCH_NORMALISE, {'N', 0}),
    ALSO("timeline", "Dope sheet", ON_TIME, NOTHING, 0, .core = core_flip, SWITCH_SHEET, {KEY_F7, 0}),
    COMMAND("Frames or seconds", 0, NOTHING, ANY_TIME, .core = core_flip, SWITCH_SECONDS, {'U', 0}),
    ALSO("grid magnet", "Snap to frames or not", 0, NOTHING, ANY_TIME, .core = core_flip, SWITCH_SNAP, {'G', 0}),
    COMMAND("Keep what follows an edit", 0, NOTHING, ANY_TIME, .core = core_flip, SWITCH_KEEP, {'A', ALT}),

    {.heading = "Stage"},
    GESTURE("Drag the tail, a chain", "Bend it", ON_STAGE),
    GESTURE("Drag the body", "Move it (R records)", ON_STAGE),
    GESTURE("Ctrl+drag the body", "Lift it", 0),
    ALSO("record keyframe", "Auto-key: a drag sets knots", 0, NOTHING, 0, .core = core_flip, SWITCH_AUTO_KEY,
         {'A', SHIFT}),
    GESTURE("Click a bone", "Select it", ON_STAGE),
    GESTURE("Hold Alt", "Control and leaf bones", 0),
    ALSO("jiggle simulate", "Make the bone a chain", IN_STAGE_MENU, BONE, 0, .core = bones_make_chain, 0, {'J', 0}),
    ALSO("follow-through overlap jiggle", "Make a chain over the clip", ON_STAGE, BONE, 0, .core = bones_make_chain,
         true, {'J', SHIFT}),
    ALSO("soft jiggle belly simulate", "Make flesh of the bone or character", IN_STAGE_MENU, MODEL, 0,
         .act = rigs_make_flesh, 0, {0}),
    ALSO("brush weight offset", "Paint phase and amplitude", 0, PAINT, 0, .run = run_brush, 0, {'B', SHIFT}),
    GESTURE("Right drag", "Orbit", ON_STAGE),
    GESTURE("Ctrl+Shift+arrows", "Orbit", 0),
    GESTURE("Wheel", "Zoom to the pointer (sideways: orbit)", ON_STAGE),
    COMMAND("Zoom in on the stage", 0, NOTHING, REPEATS, .run = run_approach, 1, {KEY_PAGE_UP, CTRL_SHIFT}),
    COMMAND("Zoom out on the stage", 0, NOTHING, REPEATS, .run = run_approach, -1, {KEY_PAGE_DOWN, CTRL_SHIFT}),
    COMMAND("Show all of the stage", ON_STAGE, NOTHING, 0, .run = run_show, SHOW_WHOLE_STAGE, {KEY_HOME, SHIFT}),
    COMMAND("From the front", IN_STAGE_MENU, NOTHING, REPEATS, .run = run_view, FROM_FRONT, {'1', 0}),
    COMMAND("From the side", IN_STAGE_MENU, NOTHING, REPEATS, .run = run_view, FROM_SIDE, {'3', 0}),
    COMMAND("From the top", IN_STAGE_MENU, NOTHING, REPEATS, .run = run_view, FROM_TOP, {'7', 0}),
    COMMAND("Show the bone, chain or tail", IN_STAGE_MENU, NOTHING, 0, .run = run_show, SHOW_PART_OF_STAGE, {'F', 0}),
    ALSO("ghost", "Onion skin", ON_STAGE, NOTHING, ANY_TIME, .core = core_flip, SWITCH_ONION, {'O', 0}),
    ALSO("compare bake", "Original clip beside it", 0, MODEL, ANY_TIME, .core = core_flip, SWITCH_ORIGINAL,
         {'V', ALT}),
    ALSO("trail path", "Motion arc", 0, NOTHING, ANY_TIME, .core = core_flip, SWITCH_TRAIL, {'O', SHIFT}),
    COMMAND("Ghost of the dragged knot", 0, NOTHING, ANY_TIME, .core = core_flip, SWITCH_GHOST, {KEY_F4, 0}),
    GESTURE("Drag a floor's edge", "Raise or lower the floor", 0),

    {.heading = "Pins"},
    GESTURE("Drag a surface", "Pin a point (X, Y, Z, Shift)", ON_STAGE),
    GESTURE("Ctrl+drag a tail", "Pin a joint", 0),
    ALSO("lock fix constrain", "Pin the point where it is", ON_STAGE | ON_PIN, PINNABLE, 0, .run = run_hold, 0,
         {'H', 0}),
    GESTURE("Click its marker", "Select a pin and go to its frame", ON_PIN),
    GESTURE("Drag its marker", "Move a pin", ON_PIN),
    GESTURE("Drag its ruler mark", "Move a pin in time", ON_PIN),
    COMMAND("Pin to the next frame", ON_PIN, PIN, REPEATS, .core = pins_retime, 1, {KEY_PAGE_DOWN, ALT}),
    COMMAND("Pin to the previous frame", ON_PIN, PIN, REPEATS, .core = pins_retime, -1, {KEY_PAGE_UP, ALT}),

    {.heading = "Inspector"},
    GESTURE("Tab, Shift+Tab", "Next, previous field", ON_INSPECTOR),
    GESTURE("Arrows", "Change it (Shift: ×10)", ON_INSPECTOR),
    GESTURE("Enter, double-click", "Type a number, +5, *2, 12/24", ON_INSPECTOR),
    GESTURE("Alt, in Feel", "The active spline alone", 0),
    GESTURE("Del, right-click", "Restore the default", ON_INSPECTOR),
    GESTURE("Type in a list", "Search it", ON_INSPECTOR),
    ALSO("advanced", "More or fewer sections", ON_INSPECTOR, NOTHING, ANY_TIME, .core = core_flip, SWITCH_MORE,
         {KEY_F9, 0}),
    ALSO("new rig import", "Add a tail, a character, a chain …", ON_INSPECTOR, NOTHING, 0,
         .inspector = inspector_add_menu, 0, {'A', 0}),
    ALSO("delete rig", "Remove the tail or character", ON_INSPECTOR, RIG, 0, .inspector = inspector_remove_rig, 0,
         {KEY_DELETE, SHIFT}),

    {.heading = ABOUT_FILE},
    ALSO("back", "Undo", 0, UNDO, REPEATS, .core = core_undo, -1, {'Z', CTRL}),
    COMMAND("Redo", 0, REDO, REPEATS, .core = core_undo, 1, {'Z', CTRL_SHIFT}),
    ALSO("load import", "Open a scene or character", 0, NOTHING, 0, .request = REQUEST_OPEN, 0, {'O', CTRL}),
    COMMAND("New scene", 0, NOTHING, 0, .request = REQUEST_NEW, 0, {'N', CTRL}),
    COMMAND("Save", 0, NOTHING, 0, .request = REQUEST_SAVE, 0, {'S', CTRL}),
    COMMAND("Save as", 0, NOTHING, 0, .request = REQUEST_SAVE_AS, 0, {'S', CTRL_SHIFT}),
    ALSO("bake render video", "Export: Blender, film, table", 0, NOTHING, 0, .request = REQUEST_EXPORT, 0,
         {'E', CTRL}),
    ALSO("share", "Copy a link, in a browser", 0, PAGE, 0, .request = REQUEST_SHARE, 0, {'L', CTRL_SHIFT}),
    ALSO("figure 1 2 3 4 5 6 7 resonance as a spline poles and response complex it stretches editable at any point "
         "tail from four knots phases of coordinate dog ears follow its walk creature held by hands scene",
         "Examples", 0, NOTHING, 0, .run = run_show, SHOW_EXAMPLES, {0}),
    COMMAND("Quit", 0, NO_PAGE, 0, .request = REQUEST_QUIT, 0, {'Q', CTRL}),

    {.heading = "Window"},
    COMMAND("All keys", 0, NOTHING, ANY_TIME | EARLY, .run = run_show, SHOW_HELP, {KEY_F1, 0}),
    COMMAND("Any command, by typing", 0, NOTHING, EARLY | ANY_TIME, .run = run_show, SHOW_PALETTE, {KEY_F3, 0}),
    GESTURE("Right-click", "A menu of what can be done there", 0),
    COMMAND("Resize the stage", 0, NOTHING, 0, .run = run_panel, 0, {KEY_F6, 0}),
    COMMAND("Resize the inspector", 0, NOTHING, 0, .run = run_panel, 1, {KEY_F6, SHIFT}),
    ALSO("zoom font", "Everything larger", 0, NOTHING, REPEATS, .request = REQUEST_UI_SCALE, 1, {KEY_F8, 0}),
    ALSO("zoom font", "Everything smaller", 0, NOTHING, REPEATS, .request = REQUEST_UI_SCALE, -1, {KEY_F8, SHIFT}),
    COMMAND("Everything at the display's size", 0, NOTHING, 0, .request = REQUEST_UI_SCALE, 0, {'0', CTRL_SHIFT}),
    ALSO("theme colours", "Light or dark", 0, NOTHING, ANY_TIME, .run = run_show, SHOW_NEXT_THEME, {KEY_F10, 0}),
    COMMAND("Full screen", 0, NOTHING, ANY_TIME, .request = REQUEST_FULLSCREEN, 0, {KEY_F11, 0}),
    ALSO("picture image", "Screenshot", 0, NOTHING, ANY_TIME, .request = REQUEST_SCREENSHOT, 0, {KEY_F12, 0}),

    {.heading = ""}, // not in F1
    MENU("loop rest close", "Unfold Spline: kind, equilibrium, start", 0, SPLINE, .section = "section.spline", 0),
    PALETTE("Unfold Rigs", NOTHING, .section = "section.rigs", 0),
    MENU("lag delay offset", "Unfold Tail or chain set-up: channels", 0, TAIL, .section = "section.tail", 0),
    PALETTE("Unfold Character: clip, bones, channels, paint", MODEL, .section = "section.character", 0),
    PALETTE("Unfold Pins", PINNABLE, .section = "section.pins", 0),
    MENU("oscillator filter passive phase curve imaginary time", "Unfold Advanced: bandwidth, calm, settling", 0,
         SPLINE, .section = "section.advanced", 0),
    MENU("clamp lock range", "Unfold Limits and steadiness", 0, SPLINE, .section = "section.limits", 0),
    PALETTE("Unfold Variation", SWING, .section = "section.variation", 0),
    MENU("fps duration length end start", "First and last frame, frame rate", 0, NOTHING,
         .inspector = inspector_edit_range, 0),
    PALETTE("Unfold Scene", NOTHING, .section = "section.scene", 0),
    PALETTE("Unfold History", NOTHING, .section = "section.history", 0),
    MENU("flip invert", "Paste mirrored", 0, SPLINE, .run = run_clipboard, CLIPBOARD_PASTE + PASTE_MIRRORED),
    MENU("flip invert negative", "Mirror the selection about zero", 0, SELECTED, .act = core_mirror_knots, 0),
    PALETTE("Add a tail", NOTHING, .inspector = inspector_add, ADD_TAIL),
    MENU("import load", "Add a character or model from a file", 0, NOTHING, .inspector = inspector_add, ADD_FILE),
    MENU("reference footage video image", "Background picture or film", 0, NOTHING, .inspector = inspector_add,
         ADD_FILE),
    PALETTE("Copy the rig", RIG, .inspector = inspector_add, ADD_COPY),
    PALETTE("Feel like a cat's tail", SPLINE, .inspector = inspector_preset, 0),
    PALETTE("Feel like a whip", SPLINE, .inspector = inspector_preset, 1),
    MENU("weight mass", "Feel heavy", 0, SPLINE, .inspector = inspector_preset, 2),
    PALETTE("Feel like jelly", SPLINE, .inspector = inspector_preset, 3),
    PALETTE("Feel like an antenna", SPLINE, .inspector = inspector_preset, 4),
    PALETTE("Forget before", NOTHING, .core = take_keep, false),
    PALETTE("Roll a variation of the motion", SWING, .inspector = inspector_roll, 0),
    PALETTE("Play at normal speed", NOTHING, .core = playback_change_speed, 0),
    MENU("new curve", "Add a spline", 0, NOTHING, .core = spline_list_change, LIST_ADD),
    MENU("copy curve", "Duplicate the spline", ON_ROW, SPLINE, .core = spline_list_change, LIST_COPY),
    MENU("remove curve", "Delete the spline", ON_ROW, SPLINE, .core = spline_list_change, LIST_REMOVE),
    PALETTE("Move the spline up in the list", SPLINE, .core = spline_list_change, LIST_UP),
    PALETTE("Move the spline down in the list", SPLINE, .core = spline_list_change, LIST_DOWN),
    MENU("isolate mute", "Solo: show only this spline, or all again", ON_ROW, SPLINE, .core = spline_list_change,
         LIST_SOLO),
    MENU("mute eye", "Hide the spline, or show it", ON_ROW, SPLINE, .core = spline_list_change, LIST_HIDE),
    MENU("protect", "Lock the spline, or unlock it", ON_ROW, SPLINE, .core = spline_list_change, LIST_LOCK),
    MENU("group", "Put into a folder, or take out", ON_ROW, SPLINE, .core = spline_list_change, LIST_FOLDER),
    PALETTE("Phase map on or off", PAINT, .core = core_flip, SWITCH_PHASE_MAP),
    MENU("clean reset", "Remove all paint", 0, PAINT, .act = characters_clean_paint, 0),
    MENU("flip symmetry", "Mirror the chain to the other side", 0, TWIN, .inspector = inspector_mirror, 0),
    PALETTE("Record the next drag of the body", BODY, .core = core_flip, SWITCH_RECORD),
    COMMAND("Nudge right", 0, CHOSEN, REPEATS | IN_STEPS, .run = run_nudge, WAY_RIGHT, {KEY_RIGHT, ALT}),
    COMMAND("Nudge left", 0, CHOSEN, REPEATS | IN_STEPS, .run = run_nudge, WAY_LEFT, {KEY_LEFT, ALT}),
    COMMAND("Nudge up", 0, CHOSEN, REPEATS | IN_STEPS, .run = run_nudge, WAY_UP, {KEY_UP, ALT}),
    COMMAND("Nudge down", 0, CHOSEN, REPEATS | IN_STEPS, .run = run_nudge, WAY_DOWN, {KEY_DOWN, ALT}),
    COMMAND("Pan left", 0, NOTHING, REPEATS, .run = run_pan, WAY_LEFT, {KEY_LEFT, CTRL}),
    COMMAND("Pan right", 0, NOTHING, REPEATS, .run = run_pan, WAY_RIGHT, {KEY_RIGHT, CTRL}),
    COMMAND("Pan up", 0, NOTHING, REPEATS, .run = run_pan, WAY_UP, {KEY_UP, CTRL}),
    COMMAND("Pan down", 0, NOTHING, REPEATS, .run = run_pan, WAY_DOWN, {KEY_DOWN, CTRL}),
    COMMAND("Orbit left", 0, NOTHING, REPEATS, .run = run_orbit, WAY_LEFT, {KEY_LEFT, CTRL_SHIFT}),
    COMMAND("Orbit right", 0, NOTHING, REPEATS, .run = run_orbit, WAY_RIGHT, {KEY_RIGHT, CTRL_SHIFT}),
    COMMAND("Orbit up", 0, NOTHING, REPEATS, .run = run_orbit, WAY_UP, {KEY_UP, CTRL_SHIFT}),
    COMMAND("Orbit down", 0, NOTHING, REPEATS, .run = run_orbit, WAY_DOWN, {KEY_DOWN, CTRL_SHIFT}),
    COMMAND(NULL, 0, NOTHING, REPEATS, .core = core_nudge_parameter, 1, {KEY_UP, 0}), // while F, Z or L is held
    COMMAND(NULL, 0, NOTHING, REPEATS, .core = core_nudge_parameter, -1, {KEY_DOWN, 0}),

    // Only in the list of examples.
    EXAMPLE("Figure 1: resonance as a spline", 1),
    EXAMPLE("Figure 2: poles and response", 2),
    EXAMPLE("Figure 3: a complex spline", 3),
    EXAMPLE("Figure 4: it stretches", 4),
    EXAMPLE("Figure 5: editable at any point", 5),
    EXAMPLE("Figure 6: a tail from four knots", 6),
    EXAMPLE("Figure 7: phases of a coordinate", 7),
    EXAMPLE("A dog: tail and ears follow its walk", 8),
    EXAMPLE("A creature held by its hands", 9),
};

const int command_count = sizeof commands / sizeof commands[0];

void command_run(struct editor *editor, const struct command *command)
{
    struct core *core = &editor->core;
    const int argument = command->argument;
    if (command->run) command->run(editor, argument);
    if (command->act) command->act(core);
    if (command->core) command->core(core, argument);
    if (command->curves) command->curves(editor->curves, core, argument);
    if (command->inspector) command->inspector(editor->inspector, argument);
    if (command->section) inspector_unfold(editor->inspector, command->section);

    // A request goes to the app. Some first need a file name, or an answer about unsaved work.
    const struct request request = {.kind = command->request, .number = argument};
    const enum request_kind kind = request.kind;
    if (kind == REQUEST_NEW || kind == REQUEST_OPEN || kind == REQUEST_FIGURE || kind == REQUEST_QUIT) {
        editor_leave(editor, &request);
    } else if (kind == REQUEST_SAVE_AS || (kind == REQUEST_SAVE && !core_path(core)[0])) {
        dialogs_save_as(editor->dialogs);
    } else if (kind == REQUEST_EXPORT) {
        dialogs_export(editor->dialogs);
    } else if (kind != REQUEST_NONE) {
        core_request(core, &request);
    }

    // The neighbouring pin if one is selected, else the knot, which the curves scroll to.
    const bool pins = command->when & PINS && pins_any_selected(&editor->core);
    if (pins) pins_select_neighbour(core, argument);
    const struct knot *knot = command->knot && !pins ? command->knot(core, argument) : NULL;
    if (knot) curves_reveal(editor->curves, core, knot->frame, core_knot_value(core, core->focus.active, knot));
}

// --- the keyboard: the command of a key or character, and keys that act while they are held

const struct command *keys_command(int key, unsigned mods)
{
    const unsigned step = mods & CTRL_SHIFT;
    if (key == KEY_BACKSPACE && mods == 0) key = KEY_DELETE; // laptops such as Macs have no other
    for (int i = 0; i < command_count; i++) {
        const struct command *command = &commands[i];
        const unsigned apart = command->when & IN_STEPS && step != CTRL_SHIFT ? step : 0;
        if (command->chord.key == key && command->chord.mods == mods - apart) return command;
    }
    return NULL;
}

/// Runs the chord's command, unless it excludes key repeats or drags; true if there is one.
static bool keys_run(struct editor *editor, int key, unsigned mods, bool repeated)
{
    const struct command *command = keys_command(key, mods);
    const bool busy = history_is_open(editor->core.history);
    if (command && (command->when & REPEATS || !repeated) && (command->when & ANY_TIME || !busy))
        command_run(editor, command);
    return command != NULL;
}

static unsigned mods_of(const struct event *event) { return event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT); }

bool keys_first(struct editor *editor, const struct event *event)
{
    if (event->kind != EVENT_KEY || event->action != ACTION_PRESS) return false;
    const struct command *command = keys_command(event->key, mods_of(event));
    if (!command || !(command->when & EARLY)) return false;
    if (!inspector_is_dragging(editor->inspector)) command_run(editor, command);
    return true;
}

bool keys_event(struct editor *editor, const struct event *event)
{
    const unsigned mods = mods_of(event);
    struct core *core = &editor->core;
    const struct press *press = &editor->press;
    if (event->kind == EVENT_TEXT) // of a key used elsewhere (to close the help, say), it runs no command
        return !press->used && keys_run(editor, (int)event->codepoint, CHORD_TYPED, press->repeated);

    // Space plays on release, unless it panned.
    if (event->key == KEY_SPACE && (mods == 0 || event->action == ACTION_RELEASE)) {
        if (event->action == ACTION_PRESS) {
            core->input.space_down = true;
            core->input.space_used = false;
        } else if (event->action == ACTION_RELEASE && core->input.space_down) {
            core->input.space_down = false;
            if (!core->input.space_used) playback_toggle(core);
        }
        return true;
    }

    if (event->action == ACTION_RELEASE) {
        if (event->key != core->input.held_key) return false;
        core->input.held_key = 0;
        const bool on_stage = core_panel_at(core, core->input.pointer_x, core->input.pointer_y) == PANEL_STAGE;
        return !core->input.held_used && on_stage && keys_run(editor, event->key, 0, false); // F alone
    }

    const int key = event->key;
    const bool holds = mods == 0 && (key == 'F' || key == 'Z' || key == 'L' || key == 'K');
    if (holds && event->action == ACTION_PRESS) {
        core->input.held_key = event->key;
        core->input.held_used = false;
        if (key == 'K' && !core->take.document) {
            core_message(core, false, "Nothing is kept yet: Shift+K keeps the scene as before.");
        } else if (key == 'K' && take_is_shown(core) && !take_is_posed(core)) {
            core_message(core, false, "Only the curves show before: the rigs or frames have changed since.");
        }
    }
    const bool bound = !holds && keys_run(editor, event->key, mods, event->action == ACTION_REPEAT);
    editor->press.opened = inspector_ui(editor->inspector)->popup.id != 0;
    editor->press.used |= bound && mods & MOD_ALT; // some systems still send the key's text
    return bound;
}
