/// The status line: playback controls, the last message, and performance figures.
#include "editor/transport/transport.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/core/view.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>

enum { PLAY, LOOP, SPEED, AUTO_KEY, KEEP, SIZE, PRESENT, CONTROLS };

static const struct {
    const char *name, *hint;
    float width;
} controls[CONTROLS] = {
    [PLAY] = {"play", "Play, pause (Space)", 24},
    [LOOP] = {"loop", "Loop or stop at the end (Ctrl+L)", 42},
    [SPEED] = {"speed", "Click: faster; Shift+click: slower; right-click: real time (- and =, or the wheel)", 44},
    [AUTO_KEY] = {"auto-key",
                  "Auto-key: dragging the body sets knots at the playhead; off, it moves the whole shot (Shift+A)",
                  64},
    [KEEP] = {"keep",
              "Keep: an edit changes nothing beyond the next knot, which becomes a pose; hold Alt to swing through "
              "(Alt+A)",
              48},
    [SIZE] = {"size",
              "Size of everything. Click: larger; Shift+click: smaller; right-click: 100 % (Ctrl+Shift+=, -, 0)", 48},
    [PRESENT] = {"present", "Present: large type, keys as they are pressed, panels that slide away (F5); Esc leaves",
                 28},
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
    if (turns || !left) return true;
    if (control == PLAY) playback_toggle(core);
    if (control == LOOP) core_flip(core, SWITCH_LOOP);
    if (control == AUTO_KEY) core_flip(core, SWITCH_AUTO_KEY);
    if (control == KEEP) core_flip(core, SWITCH_KEEP);
    if (control == PRESENT) presenter_toggle(core, 0);
    return true;
}

static void paint_control(const struct core *core, struct drawlist *list, int control, struct rect r, bool hot)
{
    const struct playback *playback = &core->view.playback;
    char speed[16], size[16];
    snprintf(speed, sizeof speed, "%g×", playback->speed);
    snprintf(size, sizeof size, "%.0f %%", 100 * core->app.figures->ui_scale);
    const bool on[] = {
        [PLAY] = playback->playing,         [LOOP] = playback->looping, [SPEED] = playback->speed != 1,
        [AUTO_KEY] = core->step.auto_key,   [KEEP] = core->step.keep,   [SIZE] = core->app.figures->ui_scale != 1,
        [PRESENT] = core->view.presenter.on};
    const char *const words[CONTROLS] = {
        [LOOP] = "Loop", [SPEED] = speed, [AUTO_KEY] = "Auto-key", [KEEP] = "Keep", [SIZE] = size};
    const uint32_t color = on[control] ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    if (control == PLAY) {
        const float x = r.x + 6, y = r.y + r.h / 2;
        const float triangle[6] = {x, y - 5, x + 9, y, x, y + 5};
        if (playback->playing) drawlist_convex(list, triangle, 3, color);
        for (int bar = 0; bar < 2 && !playback->playing; bar++)
            drawlist_rect(list, (struct rect){x + 5 * (float)bar, y - 5, 3, 10}, color);
    } else if (control == PRESENT) {
        const float x = roundf(r.x + (r.w - 14) / 2), y = roundf(r.y + (r.h - 12) / 2);
        drawlist_rounded_line(list, (struct rect){x, y, 14, 10}, 1.5f, 1.25f, color);
        drawlist_rect(list, (struct rect){x + 4, y + 11, 6, 1}, color);
    } else {
        const bool is_number = control == SPEED || control == SIZE;
        const enum font font = is_number ? FONT_NUMBER : FONT_LABEL;
        const float high = is_number ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
        const float x = roundf(r.x + (r.w - font_width(font, high, words[control])) / 2);
        drawlist_text(list, x, ui_baseline(r, font, high), font, high, color, words[control]);
    }
}

/// Lays out the controls from left to right; returns their right end.
static float lay_out_controls(struct ui *ui, struct core *core)
{
    enum { MARGIN = 6, NARROW = 420 /* a window without the least of them */ };
    const struct rect bar = core->view.layout.status;
    struct rect r = {bar.x + MARGIN, bar.y + 2, 0, bar.h - 3};
    for (int c = 0; c < CONTROLS && !is_covered(core); c++) {
        if (c == KEEP && bar.w < NARROW) continue;
        r.x += r.w;
        r.w = controls[c].width;
        ui_register(ui, ui_id(ui, controls[c].name), r);
        ui_hint(ui, r, controls[c].hint);
        const bool hot = ui_hovered(ui, r);
        if (ui->pass == UI_PASS_DRAW) paint_control(core, ui->list, c, r, hot);
        if (ui->pass == UI_PASS_EVENT && hot && !ui->used) ui->used = use_control(core, c, ui->event);
    }
    return r.x + r.w;
}

void transport_event(struct ui *ui, struct core *core, const struct event *event)
{
    if (is_covered(core) && event->kind == EVENT_BUTTON) {
        core->message.text[0] = '\0';
        return;
    }
    ui_begin_event(ui, core->view.layout.status, event);
    lay_out_controls(ui, core);
    ui_end(ui);
}

bool transport_target(struct ui *ui, struct core *core, const char *name, float *x, float *y)
{
    ui_begin_find(ui, core->view.layout.status, name, NULL);
    lay_out_controls(ui, core);
    const bool found = ui_end(ui);
    *x = ui->found_x;
    *y = ui->found_y;
    return found;
}

void transport_advance(struct core *core, double dt)
{
    static const double REFRESH = 0.5; // seconds between updates of the performance figures
    struct status *status = &core->status;
    status->age += dt;
    if (status->shown.fps > 0 && status->age < REFRESH) return;
    status->age = 0;
    status->shown = *core->app.figures;
    status->dropped = core->view.playback.dropped;
}

/// The hint with nothing under the pointer.
static const char *lead_hint(const struct core *core)
{
    const struct document *document = core->document;
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
    const enum lead lead = rigs_lead(core);
    if (core->focus.bone.any)
        return "J makes a chain from this bone to its tip, Shift+J one that follows through; Esc deselects it";
    if (lead == LEAD_NOTHING && document->spline_count == 0)
        return "A adds a tail, Ctrl+O opens a scene. F1 shows all keys";
    return hints[lead][rigs_have_knots(document)];
}

static void paint_text(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float size = font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
    float y = ui_baseline(r, font, size);
    drawlist_text_fit(list, r.x, y, r.w, font, size, color, text);
}

void transport_show(struct ui *ui, struct core *core, const char *hint)
{
    enum { GAP = 24, STATUS_MARGIN = 12 };
    static const char unkept[] = "Autosave fails: save now (Ctrl+S)"; // no recovery file holds the unsaved work
    static const double SOLVED = 5;                                   // µs; shorter times solved nothing
    struct rect bar = core->view.layout.status;
    const struct message *message = &core->message;
    const struct figures *now = core->app.figures;
    const struct status *status = &core->status;
    drawlist_rect(&core->list, bar, theme()->panel);
    drawlist_rect(&core->list, (struct rect){bar.x, bar.y, bar.w, 1}, theme()->border);
    ui_begin_draw(ui, bar, &core->list);
    float x = lay_out_controls(ui, core);
    ui_end(ui);
    if (is_covered(core)) {
        x = bar.x + STATUS_MARGIN;
    } else { // frame and time, in a column of constant width
        char text[64];
        const double frame = core_frame(core);
        snprintf(text, sizeof text, "%5.0f  %6.2f s", round(frame), frame / core->document->fps);
        const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        paint_text(&core->list, (struct rect){x, bar.y, width, bar.h}, FONT_NUMBER, theme()->text, text);
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
        paint_text(&core->list, (struct rect){end - width, bar.y, width, bar.h}, FONT_NUMBER, theme()->text_dim,
                   figures);
    if (roomy || x + title_width + needed <= end) {
        paint_text(&core->list, (struct rect){x, bar.y, title_width, bar.h}, FONT_LABEL,
                   saved ? theme()->text_dim : theme()->text, title);
        x += title_width + GAP;
    }
    const char *text = message->text[0] ? message->text : hint ? hint : ui->hint ? ui->hint : lead_hint(core);
    uint32_t color = !message->text[0] ? theme()->text_dim : message->is_error ? theme()->error : theme()->text;
    const struct rect middle = {x, bar.y, end - (roomy && figures[0] ? width + GAP : 0) - x, bar.h};
    if (middle.w > 40) paint_text(&core->list, middle, FONT_LABEL, color, text);
    if (!now->unkept) return; // in a narrow window the mark covers the controls
    const struct rect r = {mark, bar.y, bar.x + bar.w - STATUS_MARGIN - mark, bar.h};
    drawlist_rect(&core->list, (struct rect){r.x - STATUS_MARGIN, r.y + 1, r.w + 2 * STATUS_MARGIN, r.h - 1},
                  theme()->panel);
    paint_text(&core->list, r, FONT_LABEL, theme()->error, unkept);
}
