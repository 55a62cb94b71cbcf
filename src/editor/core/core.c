/// State and edits that all panels share.
#include "editor/core/core.h"
#include "base/file.h"
#include "base/names.h"
#include "editor/core/selection.h"
#include "maths/maths.h"
#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double MESSAGE_SECONDS = 5;

void core_set_path(struct core *core, const char *path)
{
    snprintf(core->path, sizeof core->path, "%s", path);
    snprintf(core->title, sizeof core->title, "%s", path[0] ? path_name(path) : "untitled");
}

void core_edited(struct core *core, int spline)
{
    struct edited *edited = &core->edited;
    if (spline < 0) edited->selection = true;
    for (int i = 0; i < edited->count; i++) {
        if (edited->spline[i] == spline) return;
    }
    if (spline >= 0 && edited->count < CORE_MAX_EDITED) edited->spline[edited->count++] = spline;
}

bool core_step(struct core *core, const char *label, uint64_t merge)
{
    core_close(core);
    if (history_is_open(core->history)) return false;
    history_begin(core->history, label, merge);
    core->step_ends = true;
    core->error = (struct error){0};
    core->message = (struct message){0};
    core_keep_phases(core);
    return true;
}

void core_close(struct core *core)
{
    if (!core->step_ends) return;
    core->step_ends = false;
    if (core->error.kind == ERROR_NONE) {
        core_keep_following(core);
    } else {
        history_restart(core->history);
    }
    history_end(core->history);
    core_settle(core);
}

void core_settle(struct core *core)
{
    core_refresh(core);
    if (core->error.kind == ERROR_NONE) return;
    core_message(core, true, "%s", core->error.text);
    core->error = (struct error){0};
    selection_drop_from(&core->selection, core->document->next_id); // the knot the drag had inserted
}

bool core_set_parameter(struct core *core, int spline, enum parameter parameter, double value)
{
    const struct param param = param_number(value);
    return edit_parameter(core->document, spline, parameter, &param, &core->error);
}

bool core_put_knot(struct core *core, int spline, const struct knot *knot)
{
    return knot->id == 0 ? edit_knot_insert(core->document, spline, knot, &core->error)
                         : edit_knot_set(core->document, spline, knot, &core->error);
}

double core_parameter_at(const struct core *core, const struct spline *spline, enum parameter parameter, int sample)
{
    const struct param *param = &spline->parameter[parameter];
    const wiggly_value track = evaluation_at(core->evaluation, param->track, sample);
    return parameter_clamped(parameter, spline_mode(spline), param->track < 0 ? param->value : track.y + track.re);
}

struct knot core_knot_at(const struct document *document, int spline, int sample)
{
    const struct spline *edited = document->splines[spline];
    const int at = spline_find_knot(document, edited, sample);
    struct knot knot = {.frame = document_frame(document, sample), .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (at >= 0) knot = edited->knots[at];
    knot.still = false;
    return knot;
}

void core_refresh(struct core *core)
{
    if (core->serial != core->document->serial) {
        core_open(core);
    } else {
        spline_list_refresh(core);
    }
}

/// If undo removed the active spline, the previously active one becomes active.
static void return_to_active(struct core *core)
{
    const struct document *document = core->document;
    const bool gone = document_find_spline_id(document, core->active_id) < 0;
    for (int r = 0; r < CORE_MAX_RECENT && gone; r++) {
        if (core->recent[r] == 0 || document_find_spline_id(document, core->recent[r]) < 0) continue;
        core->active_id = core->recent[r];
        selection_clear(&core->selection);
        break;
    }
    core_refresh(core);
}

void core_undo(struct core *core, int direction)
{
    struct history *history = core->history;
    if (history_is_open(history)) return;
    const char *label = direction < 0 ? history_undo_label(history) : history_redo_label(history);
    if (label) {
        core_message(core, false, "%s: %s", direction < 0 ? "Undone" : "Redone", label);
    } else {
        core_message(core, false, "Nothing to %s", direction < 0 ? "undo" : "redo");
    }
    if (direction < 0) {
        history_undo(history);
    } else {
        history_redo(history);
    }
    return_to_active(core);
}

void core_jump(struct core *core, size_t done)
{
    if (history_is_open(core->history)) return;
    size_t before = history_done(core->history), steps = before > done ? before - done : done - before;
    if (!history_jump(core->history, done)) return;
    return_to_active(core);
    core_message(core, false, "%s %zu step%s", before > done ? "Undone:" : "Redone:", steps, steps == 1 ? "" : "s");
}

void core_request(struct core *core, enum request_kind kind, const char *path)
{
    core->request = (struct request){.kind = kind};
    snprintf(core->request.path, sizeof core->request.path, "%s", path ? path : "");
}

struct question *core_ask(struct core *core, const struct answer *answers, int count,
                          void (*answered)(void *dialogs, struct core *core, int answer))
{
    core->question = (struct question){.answers = answers, .count = count, .answered = answered};
    return &core->question;
}

void core_message(struct core *core, bool is_error, const char *format, ...)
{
    char text[2 * sizeof core->message.text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    snprintf(core->message.text, sizeof core->message.text, "%.*s", name_fit(text, sizeof core->message.text - 1),
             text);
    core->message.is_error = is_error;
    core->message.seconds_left = is_error ? 0 : MESSAGE_SECONDS;
    core->unshown = true;
}

void core_hold(const struct spline *spline, struct knot *knot, char why[STOPPED_SIZE])
{
    if (knot->still) return;
    const double within = spline_within(spline, knot->value);
    if (within != knot->value)
        snprintf(why, STOPPED_SIZE, "held by the limit %.4g of %.*s at frame %.6g", within,
                 name_fit(spline->name, 24), spline->name, knot->frame);
    knot->value = within;
}

double core_knot_value(const struct core *core, int spline, const struct knot *knot)
{
    if (!knot->still) return knot->value;
    const wiggly_value here = evaluation_at(core->evaluation, spline, document_sample(core->document, knot->frame));
    return here.y + here.re;
}

void core_add_stopped(const char *why, char *text, size_t size)
{
    const size_t length = strlen(text);
    if (why[0]) snprintf(text + length, size - length, "%s%c%s.", length ? " " : "", toupper(why[0]), why + 1);
}

void core_stopped(struct core *core, const char *why)
{
    char text[STOPPED_SIZE + 1] = "";
    core_add_stopped(why, text, sizeof text);
    core_message(core, false, "%s", text);
}

struct spline *core_active_spline(const struct core *core)
{
    bool exists = core->active >= 0 && core->active < core->document->spline_count;
    return exists ? core->document->splines[core->active] : NULL;
}

void core_turn_to(struct core *core, int spline)
{
    if (spline == core->active || spline < 0 || spline >= core->document->spline_count) return;
    memmove(core->recent + 1, core->recent, (CORE_MAX_RECENT - 1) * sizeof *core->recent);
    core->recent[0] = core->active_id;
    core->active = spline;
    core->active_id = core->document->splines[spline]->id;
}

void core_activate(struct core *core, int spline)
{
    if (spline == core->active || spline < 0 || spline >= core->document->spline_count) return;
    selection_clear(&core->selection);
    core_turn_to(core, spline);
}

void core_choose(struct core *core, int spline)
{
    core->limb = 0;
    core_activate(core, spline);
}

void core_flip(struct core *core, int which)
{
    const struct {
        bool *on;
        const char *said[2]; ///< messages for off and on
    } switches[] = {
        [SWITCH_SNAP] = {&core->no_snap,
                         {"Snapping on: hold Ctrl to place knots between frames.",
                          "Snapping off: hold Ctrl to snap to frames."}},
        [SWITCH_AUTO_KEY] = {&core->auto_key,
                             {"Auto-key off: dragging a body moves it for the whole shot.",
                              "Auto-key on: dragging a body sets knots at the playhead."}},
        [SWITCH_KEEP] = {&core->keep,
                         {"Keep off: what follows an edit swings on from it.",
                          "Keep on: the next free knot becomes a pose, and nothing changes beyond it."}},
        [SWITCH_LOOP] = {&core->playback.looping, {"Playback stops at the end.", "Playback loops."}},
        [SWITCH_ONION] = {&core->overlays.onion,
                          {"Onion skin off.", "Onion skin on: the pose at the knots around the playhead (O)."}},
        [SWITCH_TRAIL] = {&core->overlays.trail,
                          {"Motion arc off.",
                           "Motion arc on: the path of the tip or liveliest point, one mark per frame (Shift+O)."}},
        [SWITCH_SHEET] = {&core->curves.sheet,
                          {"Dope sheet off.", "Dope sheet on: drag the marks in time, or a box around them (F7)."}},
        [SWITCH_PHASE] = {&core->curves.phase,
                          {"Phase curve off.", "Phase curve on: a quarter of a swing behind the curve."}},
        [SWITCH_MORE] = {&core->more,
                         {"The inspector shows the main sections (F9).", "The inspector shows all sections (F9)."}},
        [SWITCH_SECONDS] = {&core->curves.seconds, {"The ruler shows frames.", "The ruler shows seconds."}},
        [SWITCH_NORMALISE] = {&core->curves.normalise,
                              {"All curves share one axis again.",
                               "Normalised: every curve is as high as the active one. The axis shows the active "
                               "curve's values."}},
        [SWITCH_GHOST] = {&core->overlays.ghost,
                          {"Ghost off.", "Ghost on: the pose at the knot that is dragged or nudged (F4)."}},
        [SWITCH_ORIGINAL] = {&core->overlays.original,
                             {"Original off.", "Original on: beside the character, its clip without the chains."}},
        [SWITCH_RECORD] = {&core->record_armed, {"Recording is off.", "The next drag of the body is recorded."}},
        [SWITCH_PHASE_MAP] = {&core->characters.mapped,
                              {"Phase map off.", "Phase map on: the colour of a point is its phase."}},
        [SWITCH_TWIN] = {&core->characters.compare,
                         {"Stiff twin off.", "Stiff twin on: beside the character, one that moves without phases."}},
    };
    bool *on = switches[which].on;
    *on = !*on;
    core->refit_curves |= which == SWITCH_NORMALISE;
    core->refit_stage |= which == SWITCH_TWIN || which == SWITCH_ORIGINAL;
    core_message(core, false, "%s", switches[which].said[*on]);
}

void core_set_look(struct core *core, enum look look)
{
    static const char *const texts[] = {
        [LOOK_WIGGLY] = "Wiggly: one spline, each joint with its own phase",
        [LOOK_STIFF] = "Stiff: the same spline without lag",
        [LOOK_CUBIC] = "Cubic: the same knots as a classical spline",
    };
    core->look = look;
    core_message(core, false, "%s", texts[look]);
}

void core_turn_look(struct core *core, int unused)
{
    static const enum look next[] = {
        [LOOK_WIGGLY] = LOOK_STIFF, [LOOK_STIFF] = LOOK_CUBIC, [LOOK_CUBIC] = LOOK_WIGGLY};
    (void)unused;
    core_set_look(core, next[core->look]);
}

double core_frame(const struct core *core)
{
    return core->document->first_frame + core->playback.position / core->document->substeps;
}

double core_position(const struct document *document, double frame)
{
    return (frame - document->first_frame) * document->substeps;
}

double core_round(double value, double resolution)
{
    if (!isfinite(resolution)) return value;
    int exponent = maths_decade(resolution);
    double power = maths_power_of_ten(abs(exponent));
    double rounded = exponent < 0 ? round(value * power) / power : round(value / power) * power;
    return isfinite(rounded) && fabs(value) < 1e15 * resolution ? rounded : value;
}
