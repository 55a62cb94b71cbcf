/// The status line: playback controls, the last message, and performance figures.
#include "editor/transport/transport.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>

enum {
    MARGIN = 6,
    PLAY_WIDTH = 24,
    LOOP_WIDTH = 42,
    SPEED_WIDTH = 44,
    AUTO_KEY_WIDTH = 64,
    KEEP_WIDTH = 48,
    UI_SCALE_WIDTH = 48,
    PRESENT_WIDTH = 28,
    NARROW = 420, ///< window without the least of them
};

struct rect controls_rect(const struct core *core, enum hover_kind control)
{
    struct rect bar = core->layout.status, r = {bar.x + MARGIN, bar.y + 2, PLAY_WIDTH, bar.h - 3};
    const float keep = bar.w < NARROW ? 0 : KEEP_WIDTH;
    const float width[] = {PLAY_WIDTH, LOOP_WIDTH, SPEED_WIDTH, AUTO_KEY_WIDTH, keep, UI_SCALE_WIDTH, PRESENT_WIDTH};
    for (int i = 1; i <= (int)control - HOVER_PLAY; i++) {
        r.x += r.w;
        r.w = width[i];
    }
    return r;
}

/// In a narrow window a message takes the whole line.
static bool is_covered(const struct core *core) { return core->message.text[0] && core->layout.status.w < 640; }

struct hover transport_hover(const struct core *core, float x, float y)
{
    for (enum hover_kind control = HOVER_PLAY; control <= HOVER_PRESENT && !is_covered(core); control++) {
        if (rect_contains(controls_rect(core, control), x, y)) return (struct hover){.kind = control};
    }
    return (struct hover){.kind = HOVER_NONE};
}

bool transport_event(struct core *core, const struct event *event)
{
    const enum hover_kind control = transport_hover(core, event->x, event->y).kind;
    if (is_covered(core) && event->kind == EVENT_BUTTON) core->message.text[0] = '\0';
    const bool turns = event->kind == EVENT_WHEEL, left = event->button == BUTTON_LEFT;
    if (control == HOVER_NONE || (turns ? event->dy == 0 : event->button == BUTTON_MIDDLE)) return false;
    const int step = turns ? (event->dy > 0 ? 1 : -1) : !left ? 0 : event->mods & MOD_SHIFT ? -1 : 1;
    if (control == HOVER_SPEED) playback_change_speed(core, step);
    if (control == HOVER_UI_SCALE) core->request = (struct request){.kind = REQUEST_UI_SCALE, .number = step};
    if (turns || !left) return true;
    if (control == HOVER_PLAY) playback_toggle(core);
    if (control == HOVER_LOOP) core_flip(core, SWITCH_LOOP);
    if (control == HOVER_AUTO_KEY) core_flip(core, SWITCH_AUTO_KEY);
    if (control == HOVER_KEEP) core_flip(core, SWITCH_KEEP);
    if (control == HOVER_PRESENT) presenter_toggle(core, 0);
    return true;
}

static void paint_play_state(struct drawlist *list, float x, float y, bool playing, bool hot)
{
    uint32_t color = playing ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    if (playing) {
        const float triangle[6] = {x, y - 5, x + 9, y, x, y + 5};
        drawlist_convex(list, triangle, 3, color);
    } else {
        drawlist_rect(list, (struct rect){x, y - 5, 3, 10}, color);
        drawlist_rect(list, (struct rect){x + 5, y - 5, 3, 10}, color);
    }
}

static void paint_word(struct core *core, struct rect r, enum font font, const char *text, bool on, bool hot)
{
    float size = font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
    uint32_t color = on ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    float x = roundf(r.x + (r.w - font_width(font, size, text)) / 2);
    float y = ui_baseline(r, font, size);
    drawlist_text(&core->list, x, y, font, size, color, text);
}

static void paint_screen(struct drawlist *list, struct rect r, bool on, bool hot)
{
    const uint32_t color = on ? theme()->accent : hot ? theme()->text : theme()->text_dim;
    const float x = roundf(r.x + (r.w - 14) / 2), y = roundf(r.y + (r.h - 12) / 2);
    drawlist_rounded_line(list, (struct rect){x, y, 14, 10}, 1.5f, 1.25f, color);
    drawlist_rect(list, (struct rect){x + 4, y + 11, 6, 1}, color);
}

/// Returns the controls' right end.
static float controls_show(struct core *core)
{
    const struct playback *playback = &core->playback;
    enum hover_kind hover = core->hover.kind;
    struct rect play = controls_rect(core, HOVER_PLAY), loop = controls_rect(core, HOVER_LOOP);
    struct rect speed = controls_rect(core, HOVER_SPEED);
    char text[16];
    snprintf(text, sizeof text, "%g×", playback->speed);
    paint_play_state(&core->list, play.x + 6, play.y + play.h / 2, playback->playing, hover == HOVER_PLAY);
    paint_word(core, loop, FONT_LABEL, "Loop", playback->looping, hover == HOVER_LOOP);
    paint_word(core, speed, FONT_NUMBER, text, playback->speed != 1, hover == HOVER_SPEED);
    const struct rect auto_key = controls_rect(core, HOVER_AUTO_KEY), keep = controls_rect(core, HOVER_KEEP);
    paint_word(core, auto_key, FONT_LABEL, "Auto-key", core->auto_key, hover == HOVER_AUTO_KEY);
    if (keep.w > 0) paint_word(core, keep, FONT_LABEL, "Keep", core->keep, hover == HOVER_KEEP);
    const struct rect scale = controls_rect(core, HOVER_UI_SCALE), present = controls_rect(core, HOVER_PRESENT);
    snprintf(text, sizeof text, "%.0f %%", 100 * core->ui_scale);
    paint_word(core, scale, FONT_NUMBER, text, core->ui_scale != 1, hover == HOVER_UI_SCALE);
    paint_screen(&core->list, present, core->presenter.on, hover == HOVER_PRESENT);
    return present.x + present.w;
}

static const double REFRESH = 0.5; ///< seconds between updates of the performance figures
static const double SOLVED = 5;    ///< µs; shorter times solved nothing

void transport_advance(struct core *core, double dt)
{
    struct status *status = &core->status;
    status->age += dt;
    if (status->shown.fps > 0 && status->age < REFRESH) return;
    status->age = 0;
    status->shown = status->told;
    status->dropped = core->playback.dropped;
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
    if (lead == LEAD_NOTHING && document->spline_count == 0)
        return "A adds a tail, Ctrl+O opens a scene. F1 shows all keys";
    return hints[lead][rigs_have_knots(document)];
}

static const char *const hover_hints[] = {
    [HOVER_KNOT] = "Drag it (X, Y: one axis, R: later ones too, Shift: fine, Ctrl: off frames)",
    [HOVER_SLOPE] = "Drag to turn the slope, pull to make it firmer; T removes it",
    [HOVER_CURVE] = "Click to edit this spline",
    [HOVER_RULER] = "Drag to scrub; Shift+drag to play part of the range, Shift+click to play it all",
    [HOVER_UNITS] = "Click to switch between frames and seconds (U)",
    [HOVER_SHEET] = "Click to open or close the dope sheet (F7)",
    [HOVER_ROW] = "Click to edit this spline; double-click to insert a knot on its curve; drag to select with a box",
    [HOVER_WARNING] = "Click to fix; Ctrl+Z undoes it",
    [HOVER_JOINT] = "Drag the tail: it is held where you let go. Ctrl+drag or H pins a joint",
    [HOVER_BONE] = "Click to select this bone (Alt shows control bones too); drag to move the character",
    [HOVER_BODY] = "Drag the body: the tail follows through (Ctrl lifts it, X, Y or Z locks an axis, R records)",
    [HOVER_PLAY] = "Play, pause (Space)",
    [HOVER_LOOP] = "Loop or stop at the end (Ctrl+L)",
    [HOVER_SPEED] = "Click: faster; Shift+click: slower; right-click: real time (- and =, or the wheel)",
    [HOVER_AUTO_KEY] =
        "Auto-key: dragging the body sets knots at the playhead; off, it moves the whole shot (Shift+A)",
    [HOVER_KEEP] =
        "Keep: an edit changes nothing beyond the next knot, which becomes a pose; hold Alt to swing through (Alt+A)",
    [HOVER_UI_SCALE] =
        "Size of everything. Click: larger; Shift+click: smaller; right-click: 100 % (Ctrl+Shift+=, -, 0)",
    [HOVER_PRESENT] = "Present: large type, keys as they are pressed, panels that slide away (F5); Esc leaves",
    [HOVER_LIMIT] = "Drag the limit; the curve stays on this side of it",
    [HOVER_BOX] =
        "Drag to scale the selected knots about the other side; with Alt about the equilibrium (P while you drag)",
    [HOVER_POINT] =
        "Drag to pin this point at the playhead (X, Y or Z locks an axis, Shift: fine); H pins it where it is",
    [HOVER_PIN] = "Drag the pin (X, Y or Z locks an axis, Shift: fine); Del removes it; Alt+arrows nudge it",
    [HOVER_FLOOR] = "Drag the floor up or down (Shift: fine); the whole character stays above it",
};

static const char *hover_hint(const struct core *core)
{
    static const char *const picks[] = {
        [BONE_FOLLOWED] = "Click the bone that the equilibrium should follow; Esc cancels",
        [BONE_FIRST] = "Click the first bone of the chain; Esc cancels",
        [BONE_LAST] = "Click the last bone of the chain; Esc cancels",
    };
    const struct hover *hover = &core->hover;
    if (core->pick.use != BONE_SELECTED) return picks[core->pick.use];
    if (hover->kind == HOVER_KNOT) {
        const struct spline *spline = core->document->splines[hover->spline];
        const int k = spline_find_id(spline, hover->knot);
        if (k >= 0 && spline->knots[k].still)
            return "Comes to rest at the equilibrium; Shift+P gives it a value. Drag it in time (Ctrl: off frames)";
    }
    if (hover->kind == HOVER_CURVE && hover->spline == core->active)
        return "Double-click to insert a knot on the curve, with Shift a pose; drag to select with a box";
    if (hover->kind == HOVER_JOINT && core->document->rigs[hover->rig]->kind == RIG_CHAIN)
        return "Drag the chain: it is held where you let go. Ctrl+drag or H pins a joint, a click selects the bone";
    if (hover->kind == HOVER_PIN && core_panel_at(core, core->pointer_x, core->pointer_y) == PANEL_CURVES)
        return "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, Alt+PgDn: by a frame";
    if (hover->kind != HOVER_NONE) return hover_hints[hover->kind];
    if (core->bone.any)
        return "J makes a chain from this bone to its tip, Shift+J one that follows through; Esc deselects it";
    return lead_hint(core);
}

const char *transport_hint(const struct core *core)
{
    const enum hover_kind kind = core->hover.kind;
    const bool is_control = (kind >= HOVER_PLAY && kind <= HOVER_PRESENT) || kind == HOVER_UNITS;
    return is_control ? hover_hints[kind] : NULL;
}

static void paint_text(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float size = font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
    float y = ui_baseline(r, font, size);
    drawlist_text_fit(list, r.x, y, r.w, font, size, color, text);
}

/// Frame and time, in a column of constant width; returns its right end.
static float show_time(struct core *core, struct rect bar, float x)
{
    char text[64];
    double frame = core_frame(core);
    snprintf(text, sizeof text, "%5.0f  %6.2f s", round(frame), frame / core->document->fps);
    float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
    paint_text(&core->list, (struct rect){x, bar.y, width, bar.h}, FONT_NUMBER, theme()->text, text);
    return x + width;
}

/// The scene's name, with a dot for unsaved changes.
struct title {
    char text[256 + 8];
    float width;
};

static struct title title_of(const struct core *core, bool saved, float room)
{
    struct title title;
    snprintf(title.text, sizeof title.text, "%s%s", core->title, saved ? "" : " •");
    title.width = fminf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, title.text), room);
    return title;
}

/// Shows frames per second only while playing. At rest frames follow events, so their rate means nothing.
static void figures_text(const struct core *core, char *text, size_t size)
{
    const struct status *status = &core->status;
    char stage[32] = "", fps[64] = "", solve[32] = "";
    if (core->playback.playing && status->shown.fps > 0)
        snprintf(fps, sizeof fps, "%.0f fps  %ld dropped", status->shown.fps, status->dropped);
    if (status->shown.solve_us >= SOLVED && core->evaluation)
        snprintf(solve, sizeof solve, "solve %.0f µs (%s)", status->shown.solve_us,
                 evaluation_solver(core->evaluation));
    if (status->stage_scale > 0 && status->stage_scale < 1)
        snprintf(stage, sizeof stage, "stage at %.0f %%", 100 * (double)status->stage_scale);
    snprintf(text, size, "%s%s%s%s%s", stage, stage[0] && (fps[0] || solve[0]) ? "  " : "", fps,
             fps[0] && solve[0] ? "  " : "", solve);
}

enum { GAP = 24, STATUS_MARGIN = 12 };

static const char unkept[] = "Autosave fails: save now (Ctrl+S)";

/// The mark at the right end for unsaved work without a recovery file.
static struct rect unkept_rect(struct rect bar)
{
    const float width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, unkept);
    return (struct rect){bar.x + bar.w - STATUS_MARGIN - width, bar.y + 1, width, bar.h - 1};
}

/// In a narrow window the mark covers the controls.
static void show_unkept(struct core *core, struct rect bar)
{
    const struct rect r = unkept_rect(bar);
    if (!core->unkept) return;
    drawlist_rect(&core->list, (struct rect){r.x - STATUS_MARGIN, r.y, r.w + 2 * STATUS_MARGIN, r.h}, theme()->panel);
    paint_text(&core->list, (struct rect){r.x, bar.y, r.w, bar.h}, FONT_LABEL, theme()->error, unkept);
}

void transport_show(struct core *core, const char *hint)
{
    struct rect bar = core->layout.status;
    const struct message *message = &core->message;
    drawlist_rect(&core->list, bar, theme()->panel);
    drawlist_rect(&core->list, (struct rect){bar.x, bar.y, bar.w, 1}, theme()->border);
    float x = is_covered(core) ? bar.x + STATUS_MARGIN : show_time(core, bar, controls_show(core)) + GAP;
    char figures[160];
    figures_text(core, figures, sizeof figures);
    const float end = core->unkept ? unkept_rect(bar).x - GAP : bar.x + bar.w - STATUS_MARGIN;
    const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, figures);
    // The message is never cut: figures and name give way to it, figures first.
    const float needed = message->text[0] ? GAP + font_width(FONT_LABEL, THEME_TEXT_NORMAL, message->text) : 0;
    const bool saved = history_is_saved(core->history);
    const struct title title = title_of(core, saved, fminf(bar.w / 5, fmaxf(end - x, 0)));
    const bool roomy = x + title.width + needed + GAP + width <= end;
    if (roomy)
        paint_text(&core->list, (struct rect){end - width, bar.y, width, bar.h}, FONT_NUMBER, theme()->text_dim,
                   figures);
    if (roomy || x + title.width + needed <= end) {
        paint_text(&core->list, (struct rect){x, bar.y, title.width, bar.h}, FONT_LABEL,
                   saved ? theme()->text_dim : theme()->text, title.text);
        x += title.width + GAP;
    }
    const char *text = message->text[0] ? message->text : hint ? hint : hover_hint(core);
    uint32_t color = !message->text[0] ? theme()->text_dim : message->is_error ? theme()->error : theme()->text;
    const struct rect middle = {x, bar.y, end - (roomy && figures[0] ? width + GAP : 0) - x, bar.h};
    if (middle.w > 40) paint_text(&core->list, middle, FONT_LABEL, color, text);
    show_unkept(core, bar);
}
