/// The editor's public functions: the status line, events, one frame, and names for places on the screen.
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/curves/curves.h"
#include "editor/dialogs/dialogs.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "editor/state.h"
#include "rig/background.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COMMANDS = 16384, MAX_POINTS = 1 << 18, MAX_TEXT = 1 << 16 };

struct editor *editor_create(const struct editor_app *app)
{
    static const struct figures none = {.ui_scale = 1};
    struct editor *editor = need_zeroed(1, sizeof *editor);
    if (app) editor->core.app = *app;
    if (!editor->core.app.figures) editor->core.app.figures = &none;
    drawlist_create(&editor->core.list, MAX_COMMANDS, MAX_POINTS, MAX_TEXT);
    editor->curves = curves_create();
    editor->stage = stage_create(&editor->core);
    editor->inspector = editor->core.inspector = inspector_create(&editor->core);
    editor->core.show_clicked = inspector_show_clicked;
    editor->dialogs = dialogs_create(&editor->core, commands, command_count);
    editor->core.view.layout.stage_share = 400.0f / (720 - theme_row());
    editor->core.view.layout.inspector_width = THEME_INSPECTOR_WIDTH;
    editor->core.view.plot = (struct plotted){0, 120, -1, 1};
    editor->core.view.camera = camera_default();
    editor->core.focus.active = -1;
    editor->core.focus.brush = (struct brush){.radius = 0.12, .strength = 0.4};
#define STARTS(name, starts, said_off, said_on) editor->core.view.on[SWITCH_##name] = starts;
    SWITCH_LIST(STARTS)
#undef STARTS
    editor_resize(editor, 1280, 720, 1);
    return editor;
}

void editor_destroy(struct editor *editor)
{
    if (!editor) return;
    curves_destroy(editor->curves);
    stage_destroy(editor->stage);
    inspector_destroy(editor->inspector);
    dialogs_destroy(editor->dialogs);
    drawlist_destroy(&editor->core.list);
    take_keep(&editor->core, false);
    core_simplify(&editor->core, false);
    free(editor->core.focus.selection.bits);
    free(editor->core.view.folded.bits);
    free(editor->core.view.hidden.bits);
    free(editor->core.view.solo.bits);
    free(editor->core.clipboard);
    free(editor->core.step.seen);
    free(editor->core.step.originals.list);
    free(editor->core.step.pressed.list);
    free(editor);
}

void editor_resize(struct editor *editor, float width, float height, float scale)
{
    editor->core.view.layout.window = (struct rect){0, 0, width > 1 ? width : 1, height > 1 ? height : 1};
    const float before = editor->core.view.scale, now = scale > 0 ? scale : 1;
    if (before > 0) { // the scene keeps its place under the pointer
        editor->core.input.pointer_x *= before / now;
        editor->core.input.pointer_y *= before / now;
    }
    editor->core.view.scale = now;
    core_layout(&editor->core);
}

static void open_panels(struct editor *editor)
{
    editor->seen.serial = editor->core.serial;
    curves_open(editor->curves);
    stage_open(editor->stage);
    inspector_reset(editor->inspector);
    inspector_show_spline(editor->inspector, editor->core.focus.active);
    editor->seen.active = editor->core.focus.active_id;
}

void editor_open(struct editor *editor, const struct editor_world *world)
{
    editor->core.document = world->document;
    editor->core.history = world->history;
    editor->core.evaluation = world->evaluation;
    editor->core.models = world->models;
    core_open(&editor->core);
    open_panels(editor);
}

/// At the end of each event and frame: the undo step closes, and the panels adopt a new document or active spline.
static void end_event(struct editor *editor)
{
    struct core *core = &editor->core;
    core_close(core);
    if (editor->seen.serial != core->serial) open_panels(editor);
    const bool returned = core->view.returned;
    core->view.returned = false;
    if (returned) curves_open(editor->curves); // the view follows no edit
    if (editor->seen.active == core->focus.active_id) return;
    const int before = document_find_spline_id(editor->core.document, editor->seen.active);
    editor->seen.active = core->focus.active_id;
    if (core->focus.active < 0) return;
    if (before >= 0 && !returned) curves_activate(editor->curves, core, before);
    inspector_show_spline(editor->inspector, core->focus.active);
}

void editor_show_subject(struct editor *editor, bool poles, bool phase)
{
    editor->core.view.shows_poles = poles;
    editor->core.view.on[SWITCH_PHASE] = phase;
}

void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text)
{
    if (!dialogs_answer(editor->dialogs, request, ok, text) && !ok) core_message(&editor->core, true, "%s", text);
}

bool editor_wants_frames(const struct editor *editor)
{
    const struct drag_owner *dragged = editor->core.input.drag.owner;
    return editor->core.view.playback.playing || (dragged && dragged->goes_on) || stage_is_moving(editor->stage) ||
           editor->core.message.seconds_left > 0 || editor->core.unshown || editor->core.step.nudged_seconds > 0 ||
           curves_wants_frames(editor->curves) || tooltip_waits(&editor->tooltip) ||
           editor->core.app.figures->unkept != editor->core.status.unkept;
}

const struct stage_view *editor_stage(const struct editor *editor) { return stage_seen(editor->stage); }

void editor_message(struct editor *editor, bool is_error, const char *format, ...)
{
    char text[2 * sizeof editor->core.message.text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    core_message(&editor->core, is_error, "%s", text);
}

struct dialogs *editor_dialogs(struct editor *editor) { return editor->dialogs; }

struct editor_choices editor_choices(const struct editor *editor)
{
    const struct view *view = &editor->core.view;
    return (struct editor_choices){.stage_share = (double)view->layout.stage_share,
                                   .inspector_width = (double)view->layout.inspector_width,
                                   .more = view->on[SWITCH_MORE],
                                   .keep = view->on[SWITCH_KEEP],
                                   .is_welcomed = !dialogs_is_welcoming(editor->dialogs)};
}

void editor_choose(struct editor *editor, const struct editor_choices *choices)
{
    core_set_panels(&editor->core, choices->stage_share, choices->inspector_width);
    editor->core.view.on[SWITCH_MORE] = choices->more;
    editor->core.view.on[SWITCH_KEEP] = choices->keep;
    if (!choices->is_welcomed) dialogs_welcome(editor->dialogs);
}

struct editor_shown editor_shown(const struct editor *editor)
{
    const struct core *core = &editor->core;
    return (struct editor_shown){&core->list, core->view.look, core->view.playback.playing};
}

void editor_refresh(struct editor *editor)
{
    core_refresh(&editor->core);
    end_event(editor);
}

void editor_show_last(struct editor *editor)
{
    inspector_show_rig(editor->inspector, editor->core.document->rig_count - 1);
    editor->core.view.refit_stage = true;
}

// --- the status line: playback controls, the last message or a hint, and performance figures

enum { PLAY, LOOP, SPEED, AUTO_KEY, KEEP, SIZE, CONTROLS };

static const struct {
    const char *name, *hint;
    float width;
    const char *word; ///< of a switch
    int flips;        ///< of enum view_switch
} controls[CONTROLS] = {
    [PLAY] = {"play", "Play, pause (Space)", 24, NULL, 0},
    [LOOP] = {"loop", "Loop or stop at the end (Ctrl+L)", 42, "Loop", SWITCH_LOOP},
    [SPEED] = {"speed", "Click: faster; Shift+click: slower; right-click: real time (- and +, or the wheel)", 44,
               NULL, 0},
    [AUTO_KEY] = {"auto-key",
                  "Auto-key: dragging the body sets knots at the playhead; off, it moves the whole shot (Shift+A)",
                  64, "Auto-key", SWITCH_AUTO_KEY},
    [KEEP] = {"keep",
              "Keep: an edit changes nothing beyond the next knot, which becomes a pose; hold Alt to swing through "
              "(Alt+A)",
              48, "Keep", SWITCH_KEEP},
    [SIZE] = {"size", "Size of everything. Click: larger; Shift+click: smaller; right-click: 100 % (F8, Shift+F8)",
              48, NULL, 0},
};

/// In a narrow window a message takes the whole line.
static bool is_covered(const struct core *core) { return core->message.text[0] && core->view.layout.status.w < 640; }

/// A press or the wheel on a control; true if used.
static bool use_control(struct core *core, int control, const struct event *event)
{
    const bool turns = event->kind == EVENT_WHEEL, left = event->button == BUTTON_LEFT;
    if (turns ? event->dy == 0 : event->button == BUTTON_MIDDLE) return false;
    const int step = turns ? (event->dy > 0 ? 1 : -1) : !left ? 0 : event->mods & MOD_SHIFT ? -1 : 1;
    if (control == SPEED) playback_change_speed(core, step);
    if (control == SIZE) core_request(core, &(struct request){.kind = REQUEST_UI_SCALE, .number = step});
    if (control == PLAY && !turns && left) playback_toggle(core);
    if (!turns && left && controls[control].word) core_flip(core, controls[control].flips);
    return true;
}

/// Lays out the controls from left to right; returns their right end.
static float lay_out_controls(struct editor *editor)
{
    struct ui *ui = &editor->status;
    struct core *core = &editor->core;
    enum { MARGIN = 6, NARROW = 420 /* a window without the least of them */ };
    const struct playback *playback = &core->view.playback;
    char speed[16], size[16];
    snprintf(speed, sizeof speed, "%g×", playback->speed);
    snprintf(size, sizeof size, "%.0f %%", 100 * core->app.figures->ui_scale);
    const struct rect bar = core->view.layout.status;
    struct rect r = {bar.x + MARGIN, bar.y + 2, 0, bar.h - 3};
    for (int c = 0; c < CONTROLS && !is_covered(core); c++) {
        if (c == KEEP && bar.w < NARROW) continue;
        r.x += r.w;
        r.w = controls[c].width;
        ui_register(ui, ui_id(ui, controls[c].name), r);
        ui_hint(ui, r, controls[c].hint);
        const bool hot = ui_hovered(ui, r);
        if (ui->pass == UI_PASS_EVENT && hot && !ui->used) ui->used = use_control(core, c, ui->event);
        if (ui->pass != UI_PASS_DRAW) continue;
        const bool on = c == PLAY    ? playback->playing
                        : c == SPEED ? playback->speed != 1
                        : c == SIZE  ? core->app.figures->ui_scale != 1
                                     : core->view.on[controls[c].flips];
        const char *word = c == SPEED ? speed : c == SIZE ? size : controls[c].word;
        const uint32_t color = on ? theme()->accent : hot ? theme()->text : theme()->text_dim;
        if (c == PLAY) {
            const float x = r.x + 6, y = r.y + r.h / 2;
            const float triangle[6] = {x, y - 5, x + 9, y, x, y + 5};
            if (!playback->playing) drawlist_convex(ui->list, triangle, 3, color);
            for (int i = 0; i < 2 && playback->playing; i++)
                drawlist_rect(ui->list, (struct rect){x + 5 * (float)i, y - 5, 3, 10}, color);
        } else {
            const enum font font = c == SPEED || c == SIZE ? FONT_NUMBER : FONT_LABEL;
            const float width = font_width(font, ui_text_size(font), word), x = roundf(r.x + (r.w - width) / 2);
            drawlist_text(ui->list, x, ui_baseline(r, font, ui_text_size(font)), font, ui_text_size(font), color,
                          word);
        }
    }
    return r.x + r.w;
}

/// A press or the wheel on the status line.
static void status_event(struct editor *editor, const struct event *event)
{
    struct core *core = &editor->core;
    if (is_covered(core) && event->kind == EVENT_BUTTON) {
        core->message.text[0] = '\0';
        return;
    }
    ui_begin_event(&editor->status, core->view.layout.status, event);
    lay_out_controls(editor);
    ui_end(&editor->status);
}

/// What the pointer does or is on, else what the user can do.
static const char *hint_of(const struct editor *editor)
{
    static const char *const picks[] = {
        [BONE_FOLLOWED] = "Click the bone that the equilibrium should follow; Esc cancels",
        [BONE_FIRST] = "Click the first bone of the chain; Esc cancels",
        [BONE_LAST] = "Click the last bone of the chain; Esc cancels",
    };
    static const char *const hints[LEADS][2] = {
        [LEAD_TAIL] = {"Drag the fox or its tail. Space plays, F1 shows all keys",
                       "Drag the fox, its tail or a knot. Space plays, F1 shows all keys"},
        [LEAD_CHARACTER] = {"Drag the character to pin a point of it. Space plays, F1 shows all keys",
                            "Drag the character to pin a point of it, or a knot. Space plays, F1 shows all keys"},
        [LEAD_CHAIN] = {"Drag a chain, or click a bone to make another chain. F1 shows all keys",
                        "Drag a chain or a knot, or click a bone to make another chain. F1 shows all keys"},
        [LEAD_MODEL] = {"Click a bone, then press Shift+J to let it swing. F1 shows all keys",
                        "Click a bone, then press Shift+J to let it swing. F1 shows all keys"},
        [LEAD_MESH] = {"It has no bones to bend. A adds a tail or a character, F1 shows all keys",
                       "It has no bones to bend. Drag a knot. F1 shows all keys"},
        [LEAD_NOTHING] = {"Double-click to set a knot. Space plays, F1 shows all keys",
                          "Drag a knot. Space plays, F1 shows all keys"},
    };
    const struct core *core = &editor->core;
    const struct hover *hover = &core->input.hover;
    const char *widget = inspector_ui(editor->inspector)->hint;
    if (widget || core->input.drag.hint) return widget ? widget : core->input.drag.hint;
    if (core->focus.pick.use != BONE_SELECTED) return picks[core->focus.pick.use];
    if (hover->hint || (hover->thing && hover->thing->hint)) return hover->hint ? hover->hint : hover->thing->hint;
    if (editor->status.hint) return editor->status.hint;
    if (core->focus.bone.any)
        return "J makes a chain from this bone to its tip, Shift+J one that follows through; Esc deselects it";
    const enum lead lead = rigs_lead(core);
    if (lead == LEAD_NOTHING && core->document->spline_count == 0)
        return "A adds a tail, Ctrl+O opens a scene. F1 shows all keys";
    return hints[lead][rigs_have_knots(core->document)];
}

void status_show(struct editor *editor)
{
    enum { GAP = 24, STATUS_MARGIN = 12 };
    static const char unkept[] = "Autosave fails: save now (Ctrl+S)"; // no recovery file holds the unsaved work
    static const double SOLVED = 5;                                   // µs; shorter times solved nothing
    struct ui *ui = &editor->status;
    struct core *core = &editor->core;
    const struct rect bar = core->view.layout.status;
    const struct message *message = &core->message;
    const struct figures *now = core->app.figures;
    const struct status *status = &core->status;
    drawlist_rect(&core->list, bar, theme()->panel);
    drawlist_rect(&core->list, (struct rect){bar.x, bar.y, bar.w, 1}, theme()->border);
    ui_begin_draw(ui, bar, &core->list);
    float x = lay_out_controls(editor);
    ui_end(ui);
    if (is_covered(core)) {
        x = bar.x + STATUS_MARGIN;
    } else { // frame and time, in a column of constant width
        char text[64];
        const double frame = core_frame(core);
        snprintf(text, sizeof text, "%5.0f  %6.2f s", round(frame), frame / core->document->fps);
        const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        ui_paint_text(&core->list, (struct rect){x, bar.y, width, bar.h}, FONT_NUMBER, theme()->text, text);
        x += width + GAP;
    }

    // Frames per second only while playing: at rest frames follow events, so their rate means nothing.
    char stage[32] = "", fps[64] = "", solve[32] = "", figures[160];
    if (core->view.playback.playing && status->shown.fps > 0)
        snprintf(fps, sizeof fps, "%.0f fps  %ld dropped", status->shown.fps, status->dropped);
    if (status->shown.solve_us >= SOLVED && core->evaluation)
        snprintf(solve, sizeof solve, "solve %.0f µs (%s)", status->shown.solve_us,
                 evaluation_solver(core->evaluation));
    if (now->stage_scale > 0 && now->stage_scale < 1)
        snprintf(stage, sizeof stage, "stage at %.0f %%", 100 * (double)now->stage_scale);
    snprintf(figures, sizeof figures, "%s%s%s%s%s", stage, stage[0] && (fps[0] || solve[0]) ? "  " : "", fps,
             fps[0] && solve[0] ? "  " : "", solve);
    if (!core->app.stats) figures[0] = '\0';

    // The message is never cut: figures and name give way to it, figures first.
    const float mark = bar.x + bar.w - STATUS_MARGIN - font_width(FONT_LABEL, THEME_TEXT_NORMAL, unkept);
    const float end = now->unkept ? mark - GAP : bar.x + bar.w - STATUS_MARGIN;
    const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, figures);
    const float needed = message->text[0] ? GAP + font_width(FONT_LABEL, THEME_TEXT_NORMAL, message->text) : 0;
    const bool saved = history_is_saved(core->history);
    char title[264]; // a dot for unsaved changes
    snprintf(title, sizeof title, "%.255s%s", core_title(core), saved ? "" : " •");
    const float title_width =
        fminf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, title), fminf(bar.w / 5, fmaxf(end - x, 0)));
    const bool roomy = x + title_width + needed + GAP + width <= end;
    if (roomy)
        ui_paint_text(&core->list, (struct rect){end - width, bar.y, width, bar.h}, FONT_NUMBER, theme()->text_dim,
                      figures);
    if (roomy || x + title_width + needed <= end) {
        ui_paint_text(&core->list, (struct rect){x, bar.y, title_width, bar.h}, FONT_LABEL,
                      saved ? theme()->text_dim : theme()->text, title);
        x += title_width + GAP;
    }
    const char *text = message->text[0] ? message->text : hint_of(editor);
    uint32_t color = !message->text[0] ? theme()->text_dim : message->is_error ? theme()->error : theme()->text;
    const struct rect middle = {x, bar.y, end - (roomy && figures[0] ? width + GAP : 0) - x, bar.h};
    if (middle.w > 40) ui_paint_text(&core->list, middle, FONT_LABEL, color, text);
    if (!now->unkept) return; // in a narrow window the mark covers the controls
    const struct rect r = {mark, bar.y, bar.x + bar.w - STATUS_MARGIN - mark, bar.h};
    drawlist_rect(&core->list, (struct rect){r.x - STATUS_MARGIN, r.y + 1, r.w + 2 * STATUS_MARGIN, r.h - 1},
                  theme()->panel);
    ui_paint_text(&core->list, r, FONT_LABEL, theme()->error, unkept);
}

// --- events

void editor_leave(struct editor *editor, const struct request *request)
{
    inspector_let_go(editor->inspector);
    dialogs_leave(editor->dialogs, request);
}

/// For events that no dialog, drag or inspector used.
static void pass_on(struct editor *editor, const struct event *event)
{
    struct core *core = &editor->core;
    struct request request = {.kind = event->kind == EVENT_CLOSE ? REQUEST_QUIT : REQUEST_OPEN};
    const enum divider divider = core_divider_at(core, event->x, event->y);
    const enum panel panel = core_panel_at(core, event->x, event->y);
    if (event->kind == EVENT_KEY || event->kind == EVENT_TEXT) keys_event(editor, event);
    if (event->kind == EVENT_PASTE) core_paste_knots(core, event->text);
    if (event->kind == EVENT_DROP) {
        snprintf(request.path, sizeof request.path, "%s", event->path ? event->path : "");
        if (background_suits(request.path)) request.kind = REQUEST_ADD;
        if (request.kind == REQUEST_ADD) core_request(core, &request);
    }
    if (event->kind == EVENT_CLOSE || (event->kind == EVENT_DROP && request.kind == REQUEST_OPEN))
        editor_leave(editor, &request);
    if (event->kind == EVENT_WHEEL) {
        if (panel == PANEL_CURVES) curves_wheel(editor->curves, core, event);
        if (panel == PANEL_STATUS) status_event(editor, event);
        if (panel == PANEL_STAGE) stage_wheel(core, event);
    }
    if (event->kind != EVENT_BUTTON || event->action != ACTION_PRESS) return;
    if (divider != DIVIDER_NONE && event->button == BUTTON_LEFT) {
        drag_begin(core, &divider_drags[divider], NULL, NULL, event);
    } else if (panel == PANEL_CURVES) {
        curves_press(editor->curves, core, event);
        if (event->button == BUTTON_RIGHT) dialogs_menu(editor->dialogs);
    } else if (panel == PANEL_STAGE) {
        stage_press(editor->stage, core, event);
    } else {
        status_event(editor, event);
    }
}

bool editor_keeps(const struct editor *editor, int key, unsigned mods)
{
    const struct ui *ui = inspector_ui(editor->inspector);
    const bool asks = dialogs_cover(editor->dialogs) || ui->popup.id;
    if (command_is_browsers(key, mods)) return false;
    if (key == KEY_TAB && !asks && (mods == 0 || mods == MOD_SHIFT))
        return ui_has_next(ui, mods & MOD_SHIFT ? -1 : 1);
    const bool is_plain = !(mods & (MOD_CTRL | MOD_ALT | MOD_SUPER)) && (key < KEY_F1 || key > KEY_F12);
    return is_plain || asks || ui->typing || keys_command(key, mods);
}

void editor_let_go(struct editor *editor)
{
    drag_end(&editor->core, true);
    inspector_let_go(editor->inspector);
}

/// Overlays get events first, then a running drag, then the inspector. A text field takes all keys except Ctrl chords and F keys; a focused
/// slider arrows, Enter and digits; an open dialog all.
void editor_event(struct editor *editor, const struct event *event)
{
    struct core *core = &editor->core;
    const bool is_key = event->kind == EVENT_KEY, is_button = event->kind == EVENT_BUTTON;
    const bool has_pointer = event->kind == EVENT_POINTER || is_button || event->kind == EVENT_WHEEL;
    if (has_pointer) {
        core->input.pointer_x = event->x;
        core->input.pointer_y = event->y;
        core->input.finger = event->finger;
    }
    if (has_pointer || is_key) core->input.mods = event->mods;
    if ((is_key || is_button) && event->action == ACTION_PRESS && core->message.is_error)
        core->message = (struct message){.text = ""};
    if (((is_key || is_button) && event->action != ACTION_RELEASE) || event->kind == EVENT_TEXT ||
        event->kind == EVENT_WHEEL || event->kind == EVENT_SIZE)
        tooltip_dismiss(&editor->tooltip);
    if (event->kind == EVENT_SIZE) editor_resize(editor, event->x, event->y, event->scale);
    const struct drag *drag = &core->input.drag; // on the stage, the right button orbits if it moves
    const bool asks_menu = is_button && event->action == ACTION_RELEASE && event->button == BUTTON_RIGHT &&
                           drag->owner && drag->room == editor->stage && drag->button == BUTTON_RIGHT && !drag->moved;
    if (event->kind == EVENT_TEXT && editor->press.opened) return;
    bool used = (!dialogs_are_asking(editor->dialogs) && keys_first(editor, event)) ||
                dialogs_event(editor->dialogs, event) || drag_event(core, event) ||
                (!core->input.drag.owner && inspector_event(editor->inspector, event));
    if (event->kind == EVENT_KEY && event->action != ACTION_RELEASE) {
        editor->press = (struct press){.used = used, .repeated = event->action == ACTION_REPEAT};
    }
    if (!used) pass_on(editor, event);
    if (asks_menu) dialogs_menu(editor->dialogs);
    const struct command *chosen = dialogs_take_command(editor->dialogs);
    if (chosen) command_run(editor, chosen);
    end_event(editor);

    // A question or another new overlay ends any drag and releases held keys.
    if (dialogs_ask(editor->dialogs)) inspector_let_go(editor->inspector);
    if (!dialogs_cover(editor->dialogs)) return;
    drag_end(core, true);
    core->input.held_key = 0;
    core->input.space_down = false;
}

void editor_advance(struct editor *editor, double dt)
{
    static const double REFRESH = 0.5; // seconds between updates of the figures, to save redraws
    struct status *status = &editor->core.status;
    struct message *message = &editor->core.message;
    editor->press = (struct press){.used = false}; // the text event comes in the same frame
    if (message->seconds_left > 0) {
        message->seconds_left -= dt;
        if (message->seconds_left <= 0) message->text[0] = 0;
    }
    editor->core.step.nudged_seconds = fmax(editor->core.step.nudged_seconds - dt, 0);
    status->age += dt;
    if (status->shown.fps <= 0 || status->age >= REFRESH) {
        status->age = 0;
        status->shown = *editor->core.app.figures;
        status->dropped = editor->core.view.playback.dropped;
    }
    tooltip_advance(&editor->tooltip, dt);
    playback_advance(&editor->core, dt);
    curves_advance(editor->curves, &editor->core, dt);
    drag_apply(&editor->core, dt);
    core_simplify_advance(&editor->core);
    stage_advance(editor->stage, &editor->core, dt);
    end_event(editor);
}

void editor_pose(struct editor *editor)
{
    sheet_update(editor->curves, &editor->core);
    if (editor->core.view.refit_curves) curves_frame_all(editor->curves, &editor->core);
    editor->core.view.refit_curves = false;
    follow_edits(editor->curves, &editor->core);
    stage_pose(editor->stage, &editor->core, dialogs_cover(editor->dialogs));
}

void editor_pose_alone(struct editor *editor, double frame, float width, float height)
{
    editor->core.view.layout.stage = (struct rect){0, 0, width, height};
    editor->core.view.plain = true;
    editor->core.view.playback.position = core_position(editor->core.document, frame);
    editor_pose(editor);
}

static void show_divider(struct editor *editor, enum divider divider)
{
    enum { LENGTH = 36, THICKNESS = 3 };
    struct core *core = &editor->core;
    const struct rect *curves = &core->view.layout.curves, *inspector = &core->view.layout.inspector;
    const bool across = divider != DIVIDER_INSPECTOR, held = core->input.drag.owner == &divider_drags[divider];
    const bool hot =
        !core->input.drag.owner && core_divider_at(core, core->input.pointer_x, core->input.pointer_y) == divider;
    const float y = divider == DIVIDER_STAGE ? curves->y : inspector->y;
    const struct rect line =
        across ? (struct rect){0, y, curves->w, 1} : (struct rect){inspector->x, 0, 1, inspector->h};
    const float w = across ? LENGTH : THICKNESS, h = across ? THICKNESS : LENGTH;
    const struct rect grip = {roundf(line.x + (line.w - w) / 2), roundf(line.y + (line.h - h) / 2), w, h};
    drawlist_rect(&core->list, line, theme()->border);
    drawlist_rounded(&core->list, grip, THICKNESS / 2.0f,
                     held  ? theme()->accent
                     : hot ? theme()->text
                           : theme()->text_dim);
}

void editor_show(struct editor *editor)
{
    struct core *core = &editor->core;
    const bool covered = dialogs_cover(editor->dialogs);
    const struct ui *ui = inspector_ui(editor->inspector);
    const bool lists = ui->popup.id != 0; // it may lie over other panels
    const float x = core->input.pointer_x, y = core->input.pointer_y;
    drawlist_clear(&core->list, core->view.layout.window);

    // Anew in every frame, because things move under the pointer.
    editor->status.pointer_x = -1;
    editor->status.hint = NULL;
    if (!core->input.drag.owner) {
        const bool is_beside = covered || lists || core_divider_at(core, x, y) != DIVIDER_NONE;
        const enum panel panel = is_beside ? PANEL_NONE : core_panel_at(core, x, y);
        core->input.hover = (struct hover){.thing = NULL};
        if (panel == PANEL_CURVES) core->input.hover = curves_hover(editor->curves, core, x, y);
        if (panel == PANEL_STAGE) core->input.hover = stage_hover(editor->stage, core, x, y);
        if (panel == PANEL_STATUS) editor->status.pointer_x = x, editor->status.pointer_y = y;
    }

    stage_show(editor->stage, core);
    stage_show_caption(core, dialogs_show_welcome(editor->dialogs, stage_figure(editor->stage, core)));
    curves_show(editor->curves, core);
    show_divider(editor, DIVIDER_STAGE); // below the inspector's menus
    inspector_show(editor->inspector, covered);
    show_divider(editor, core->view.layout.upright ? DIVIDER_BELOW : DIVIDER_INSPECTOR);
    status_show(editor);
    dialogs_show(editor->dialogs);

    // The tooltip is for the control under the pointer, else for the focused one.
    const struct rect cursor = {x, y - 4, 14, 22};
    const struct thing *thing = core->input.hover.thing;
    const char *control = thing && thing->is_control ? thing->hint : editor->status.hint;
    const char *text = ui->hint ? ui->hint : control;
    const bool is_focus = !text && ui->focus && !lists;
    if (is_focus) text = ui->focus_hint;
    if (covered || core->input.drag.owner) text = NULL;
    tooltip_offer(&editor->tooltip, text, x, y, is_focus ? ui->focus_rect : cursor);
    tooltip_show(&editor->tooltip, core->view.layout.window, &core->list);
    core->unshown = false;
    core->status.unkept = core->app.figures->unkept;
}

enum mouse_cursor editor_cursor(const struct editor *editor)
{
    static const enum mouse_cursor of_widget[] = {
        [UI_OVER_NOTHING] = CURSOR_ARROW, [UI_OVER_NUMBER] = CURSOR_HORIZONTAL, [UI_OVER_TEXT] = CURSOR_TEXT};
    const enum ui_over over = inspector_ui(editor->inspector)->over;
    if (dialogs_cover(editor->dialogs)) return of_widget[dialogs_over(editor->dialogs)];
    if (editor->core.input.drag.owner) return editor->core.input.drag.owner->cursor;
    enum divider divider = core_divider_at(&editor->core, editor->core.input.pointer_x, editor->core.input.pointer_y);
    if (divider != DIVIDER_NONE) return divider_drags[divider].cursor;
    if (over != UI_OVER_NOTHING) return of_widget[over];
    if (editor->status.hint) return CURSOR_HAND;
    return editor->core.input.hover.thing ? editor->core.input.hover.thing->cursor : CURSOR_ARROW;
}

// --- names for places on the screen, as replays use them: "knot(sway,2)", "tail(tail,0.9)". They survive layout changes

static bool find_divider(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct layout *l = &core->view.layout;
    const bool inspector = strcmp(target->name, "inspector") == 0;
    (void)room;
    xy[0] = inspector ? l->inspector.x : l->curves.x + l->curves.w / 2;
    xy[1] = inspector ? l->inspector.h / 2 : l->curves.y;
    return inspector || strcmp(target->name, "stage") == 0;
}

/// Lays out the widgets; the editor ends up unchanged.
static bool find_widget(void *room, const struct core *core, const struct target *target, float xy[2])
{
    struct editor *editor = room;
    struct ui *ui = &editor->status;
    if (inspector_target(editor->inspector, target->name, &xy[0], &xy[1])) return true;
    ui_begin_find(ui, core->view.layout.status, target->name, NULL);
    lay_out_controls(editor);
    const bool found = ui_end(ui);
    xy[0] = ui->found_x;
    xy[1] = ui->found_y;
    return found;
}

static const char hidden[] = "neither inspector nor status line shows it";

static const struct thing divider = {.name = "divider",
                                     .of = OF_ITSELF,
                                     .find = find_divider,
                                     .missing = "there is no such divider: expected stage or inspector"},
                          slider = {.name = "slider", .of = OF_ITSELF, .find = find_widget, .missing = hidden},
                          widget = {.name = "widget", .of = OF_ITSELF, .find = find_widget, .missing = hidden};

static const struct thing *const editor_things[] = {&divider, &slider, &widget, NULL};

/// Parses kind(name,number,…). Returns the kind's thing in a list, or NULL.
static const struct thing *parse_target(const struct thing *const *things, const char *text, struct target *target)
{
    const size_t kind = strcspn(text, "("), length = strlen(text);
    while (*things && (strlen((*things)->name) != kind || strncmp((*things)->name, text, kind) != 0)) things++;
    if (!*things || kind == length || text[length - 1] != ')' || length - kind > sizeof target->name) return NULL;
    *target = (struct target){.name = ""};
    memcpy(target->name, text + kind + 1, length - kind - 2);
    for (int n = (*things)->numbers - 1; n >= 0; n--) {
        char *comma = strrchr(target->name, ','), *digits = comma ? comma + 1 : target->name, *end;
        target->number[n] = strtod(digits, &end);
        if (end == digits || *end || !isfinite(target->number[n])) return NULL;
        *(comma ? comma : digits) = 0;
    }
    return ((*things)->of != OF_NOBODY) == (target->name[0] != 0) ? *things : NULL;
}

bool editor_target(struct editor *editor, const char *text, float *x, float *y, struct error *error)
{
    const struct thing *const *const lists[] = {curves_things, stage_things, editor_things};
    void *const rooms[] = {editor->curves, editor->stage, editor};
    const struct document *document = editor->core.document;
    const struct thing *thing = NULL;
    struct target target;
    float xy[2];
    int list = -1;
    while (!thing && ++list < 3) thing = parse_target(lists[list], text, &target);
    if (!thing) return fail(error, ERROR_INPUT, "\"%s\" is no target such as knot(sway,2) or stage(0.5,0.5)", text);
    const double k = target.number[0];
    if (thing->of == OF_SPLINE || thing->of == OF_KNOT) {
        target.spline = document_find_spline(document, target.name);
        if (target.spline < 0) return fail(error, ERROR_INPUT, "there is no spline \"%s\"", target.name);
        const struct spline *spline = document->splines[target.spline];
        if (thing->of == OF_KNOT && !(k >= 0 && k < spline->knot_count))
            return fail(error, ERROR_INPUT, "the spline \"%s\" has %d knots, no knot %g", spline->name,
                        spline->knot_count, k);
        if (thing->of == OF_KNOT) target.knot = &spline->knots[(int)k];
    }
    bool found = thing->of != OF_RIG && thing->of != OF_PIN;
    while (!found && target.rig < document->rig_count) {
        const struct rig *rig = document->rigs[target.rig];
        found = strcmp(rig_title(rig), target.name) == 0; // an unnamed character goes by its model
        if (thing->of == OF_PIN) {
            found &= k >= 0 && k < rig->pin_count;
            if (found) target.pin = &rig->pins[(int)k];
        } else {
            found &= rig->kind == thing->rig;
        }
        target.rig += !found;
    }
    if (!found && thing->of == OF_PIN)
        return fail(error, ERROR_INPUT, "there is no pin %g of \"%s\"", k, target.name);
    if (!found) return fail(error, ERROR_INPUT, "there is no %s \"%s\"", rig_word(thing->rig), target.name);
    if (!thing->find(rooms[list], &editor->core, &target, xy)) return fail(error, ERROR_INPUT, "%s", thing->missing);
    *x = xy[0];
    *y = xy[1];
    return true;
}
