/// The status line: where playback is, which scene, and one sentence: a message, or what the pointer is over.
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/transport/state.h"
#include "editor/transport/transport.h"
#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double REFRESH = 0.5; ///< seconds between changes of the figures at the right
static const double SOLVED = 5;    ///< µs; what took less was only a look for something to solve

void transport_advance(struct transport *transport, const struct core *core, double dt)
{
    struct status *status = &transport->status;
    status->age += dt;
    if (status->fps > 0 && status->age < REFRESH) return;
    status->age = 0;
    status->fps = transport->fps;
    status->solve_us = transport->solve_us;
    status->dropped = core->playback.dropped;
}

/// What to try where nothing is pointed at; knots are not spoken of where there are none.
static const char *lead_hint(const struct document *document)
{
    static const char *const hints[LEADS][2] = {
        [LEAD_TAIL] = {"Drag the fox or its tail. Space plays, F1 shows all keys",
                       "Drag the fox, its tail or a knot. Space plays, F1 shows all keys"},
        [LEAD_CHARACTER] = {"Drag the character to pin a point of it. Space plays, F1 shows all keys",
                            "Drag the character to pin a point of it, or a knot. Space plays, F1 shows all keys"},
        [LEAD_CHAIN] = {"Drag a chain, or click a bone to make another chain. F1 shows all keys",
                        "Drag a chain or a knot, or click a bone to make another chain. F1 shows all keys"},
        [LEAD_MODEL] = {"Point at a bone and click it to make a chain. F1 shows all keys",
                        "Point at a bone and click it to make a chain. F1 shows all keys"},
        [LEAD_NOTHING] = {"Double-click to set a knot. Space plays, F1 shows all keys",
                          "Drag a knot. Space plays, F1 shows all keys"},
    };
    const enum lead lead = rigs_lead(document);
    if (lead == LEAD_NOTHING && document->spline_count == 0)
        return "A adds a tail, Ctrl+O opens a scene. F1 shows all keys";
    return hints[lead][rigs_have_knots(document)];
}

static const char *hover_hint(const struct core *core, const struct document *document)
{
    static const char *const picks[] = {
        [BONE_FOLLOWED] = "Click the bone that the equilibrium is to follow; Esc: none",
        [BONE_FIRST] = "Click the bone that the chain is to begin with; Esc: none",
        [BONE_LAST] = "Click the bone that the chain is to end with; Esc: none",
    };
    if (core->pick.use != BONE_SELECTED) return picks[core->pick.use];
    switch (core->hover.kind) {
    case HOVER_KNOT:
        return "Drag it (X, Y: one axis, R: later ones too, Shift: fine, Ctrl: off frames)";
    case HOVER_SLOPE:
        return "Drag to turn the slope, pull to make it firmer; T removes it";
    case HOVER_CURVE:
        return core->hover.spline == core->active
                   ? "Double-click to insert a knot without changing the curve; drag to select with a box"
                   : "Click to edit this spline";
    case HOVER_RULER:
        return "Drag to scrub; Shift+drag to play part of the range, Shift+click to play it all";
    case HOVER_WARNING:
        return "Click to fix; Ctrl+Z undoes it";
    case HOVER_SHEET:
        return "Click to open or close the dope sheet (F3)";
    case HOVER_ROW:
        return "Click to edit this spline; double-click to insert a knot on its curve; drag to select with a box";
    case HOVER_UNITS:
        return "Click to switch between frames and seconds (U)";
    case HOVER_JOINT:
        return document->rigs[core->hover.rig].kind == RIG_CHAIN
                   ? "Drag the chain to set the knot at the playhead; Ctrl+drag or H pins a joint; click to select "
                     "the bone"
                   : "Drag the tail to set the knot at the playhead; Ctrl+drag or H pins a joint";
    case HOVER_BONE:
        return "Click to select this bone";
    case HOVER_BODY:
        return "Drag the body and the tail follows through (Ctrl: lift it, X, Y or Z locks an axis, R records)";
    case HOVER_PLAY:
        return "Play, pause (Space)";
    case HOVER_LOOP:
        return "Loop or stop at the end (Ctrl+L)";
    case HOVER_SPEED:
        return "Click: faster; Shift+click: slower; right-click: real time (- and =, or the wheel)";
    case HOVER_AUTO_KEY:
        return "Whether dragging the body sets knots at the playhead, or moves the whole shot (Shift+A)";
    case HOVER_UI_SCALE:
        return "How large everything is. Click: larger; Shift+click: smaller; right-click: 100 % (Ctrl+Shift+=, -, "
               "0)";
    case HOVER_PRESENT:
        return "Present: large type, keys as they are pressed, panels that slide away (F5); Esc leaves";
    case HOVER_LIMIT:
        return "Drag the limit; the curve stays on this side of it";
    case HOVER_BOX:
        return "Drag to scale the selected knots about the other side; with Alt about the equilibrium (P while you "
               "drag)";
    case HOVER_POINT:
        return "Drag to pin this point at the playhead (X, Y or Z locks an axis, Shift: fine); H pins it where it is";
    case HOVER_PIN:
        if (core_panel_at(core, core->pointer_x, core->pointer_y) == PANEL_CURVES)
            return "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, Alt+PgDn: by a frame";
        return "Drag the pin (X, Y or Z locks an axis, Shift: fine); Del removes it; Alt+arrows nudge it";
    case HOVER_FLOOR:
        return "Drag the floor up or down (Shift: fine); the whole character stays above it";
    case HOVER_NONE:
        break;
    }
    if (core->bone.any)
        return "J makes a chain from this bone to its tip, Shift+J one that follows through; Esc lets go";
    return lead_hint(document);
}

const char *transport_hint(const struct core *core, const struct document *document)
{
    switch (core->hover.kind) {
    case HOVER_PLAY:
    case HOVER_LOOP:
    case HOVER_SPEED:
    case HOVER_UNITS:
        return hover_hint(core, document);
    default:
        return NULL;
    }
}

static void paint_text(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text)
{
    float size = font == FONT_NUMBER ? THEME_TEXT_SMALL : THEME_TEXT_NORMAL;
    float y = ui_baseline(r, font, size);
    drawlist_text_fit(list, r.x, y, r.w, font, size, color, text);
}

/// Frame and time, in a column whose width does not depend on them; returns the column's right end.
static float show_time(struct core *core, const struct document *document, struct rect bar, float x)
{
    char text[64];
    double frame = core_frame(core, document);
    snprintf(text, sizeof text, "%5.0f  %6.2f s", round(frame), frame / document->fps);
    float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
    paint_text(&core->list, (struct rect){x, bar.y, width, bar.h}, FONT_NUMBER, theme()->text, text);
    return x + width;
}

/// The scene's name, with a dot while it has unsaved changes.
struct title {
    char text[256 + 8];
    float width;
};

static struct title title_of(const struct core *core, bool saved, struct rect bar)
{
    struct title title;
    snprintf(title.text, sizeof title.text, "%s%s", core->title, saved ? "" : " •");
    title.width = fminf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, title.text), bar.w / 5);
    return title;
}

/// Frames a second only while it plays: at rest frames come as events do, and their number would say nothing.
static void figures_text(const struct transport *transport, const struct core *core, char *text, size_t size)
{
    const struct status *status = &transport->status;
    char stage[32] = "", fps[64] = "", solve[32] = "";
    if (core->playback.playing && status->fps > 0) {
        snprintf(fps, sizeof fps, "%.0f fps  %ld dropped", status->fps, status->dropped);
    }
    if (status->solve_us >= SOLVED) {
        snprintf(solve, sizeof solve, "solve %.0f µs (%s)", status->solve_us, evaluation_solver(core->method));
    } else if (core->method != WIGGLY_CHAIN) {
        snprintf(solve, sizeof solve, "%s", evaluation_solver(core->method));
    }
    if (transport->stage_scale > 0 && transport->stage_scale < 1) {
        snprintf(stage, sizeof stage, "stage at %.0f %%", 100 * (double)transport->stage_scale);
    }
    snprintf(text, size, "%s%s%s%s%s", stage, stage[0] && (fps[0] || solve[0]) ? "  " : "", fps,
             fps[0] && solve[0] ? "  " : "", solve);
}

enum { GAP = 24, MARGIN = 12 };

static const char unkept[] = "Autosave fails: save now (Ctrl+S)";

/// The mark at the right end while unsaved work has no recovery file.
static struct rect unkept_rect(struct rect bar)
{
    const float width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, unkept);
    return (struct rect){bar.x + bar.w - MARGIN - width, bar.y + 1, width, bar.h - 1};
}

/// In a narrow window it covers what is there.
static void show_unkept(struct core *core, struct rect bar)
{
    const struct rect r = unkept_rect(bar);
    if (!core->unkept) return;
    drawlist_rect(&core->list, (struct rect){r.x - MARGIN, r.y, r.w + 2 * MARGIN, r.h}, theme()->panel);
    paint_text(&core->list, (struct rect){r.x, bar.y, r.w, bar.h}, FONT_LABEL, theme()->error, unkept);
}

void transport_show(const struct transport *transport, struct core *core, const struct editor_world *world,
                    const char *hint)
{
    struct rect bar = core->layout.status;
    const struct message *message = &core->message;
    drawlist_rect(&core->list, bar, theme()->panel);
    drawlist_rect(&core->list, (struct rect){bar.x, bar.y, bar.w, 1}, theme()->border);
    float x = show_time(core, world->document, bar, controls_show(core)) + GAP;
    char figures[160];
    figures_text(transport, core, figures, sizeof figures);
    const float end = core->unkept ? unkept_rect(bar).x - GAP : bar.x + bar.w - MARGIN;
    const float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, figures);
    // What has happened is said in full: the figures give way to it, and the name of the scene.
    const float needed = GAP + font_width(FONT_LABEL, THEME_TEXT_NORMAL, message->text);
    const bool saved = history_is_saved(world->history);
    const struct title title = title_of(core, saved, bar);
    const bool tight = message->text[0] && x + title.width + needed > end - width - GAP;
    const float right = tight ? end : end - width;
    if (!tight && right > x)
        paint_text(&core->list, (struct rect){right, bar.y, width, bar.h}, FONT_NUMBER, theme()->text_dim, figures);
    if (!tight || x + title.width + needed <= end) {
        paint_text(&core->list, (struct rect){x, bar.y, title.width, bar.h}, FONT_LABEL,
                   saved ? theme()->text_dim : theme()->text, title.text);
        x += title.width + GAP;
    }
    const char *text = message->text[0] ? message->text : hint ? hint : hover_hint(core, world->document);
    uint32_t color = !message->text[0] ? theme()->text_dim : message->is_error ? theme()->error : theme()->text;
    struct rect middle = {x, bar.y, right - (tight ? 0 : GAP) - x, bar.h};
    if (middle.w > 40) paint_text(&core->list, middle, FONT_LABEL, color, text);
    show_unkept(core, bar);
}

struct transport *transport_create(void) { return calloc(1, sizeof(struct transport)); }

void transport_destroy(struct transport *transport) { free(transport); }

void transport_tell(struct transport *transport, double fps, double solve_us)
{
    transport->fps = fps;
    transport->solve_us = solve_us;
}

void transport_tell_scale(struct transport *transport, float scale) { transport->stage_scale = scale; }
