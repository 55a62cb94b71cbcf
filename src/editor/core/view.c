/// What is shown: where the panels are, what time it is, and the switches of how the scene looks.
#include "editor/core/core.h"
#include "ui/theme.h"
#include <math.h>
#include <string.h>

// --- layout: stage above curves at the left, inspector at the right, in upright windows at the bottom; status line below

static const float RULER_HEIGHT = 22, AXIS_WIDTH = 52, MARGIN = 12, DIVIDER_REACH = 4;
static const float MIN_STAGE = 120, MIN_CURVES = 140, MIN_LEFT = 480, MIN_INSPECTOR = 240, MAX_INSPECTOR = 480;
static const float LIST = 124, NARROW = 560; ///< width of the splines' list; narrower curves have its colours alone
static const float UPRIGHT = 800; ///< narrower windows that are higher than wide have the inspector at the bottom
static const float WHOLE = 800;   ///< inspector_width that would take all of their height

static float clamped(float value, float lo, float hi) { return fmaxf(lo, fminf(value, hi)); }

void core_layout(struct core *core)
{
    struct layout *l = &core->view.layout;
    const bool upright = l->window.w < UPRIGHT && l->window.h > l->window.w;
    theme_fit_fingers(upright);
    const float all = fmaxf(l->window.h - theme_row(), 2);
    l->upright = upright;
    const float most = upright ? MAX_INSPECTOR : fminf(MAX_INSPECTOR, fmaxf(l->window.w - MIN_LEFT, 0));
    const float size = clamped(l->inspector_width, MIN_INSPECTOR, most);
    const float below = upright ? roundf(all * size / WHOLE) : 0, height = all - below;
    const float right = upright ? 0 : size, left = fmaxf(l->window.w - right, 1);
    float stage = roundf(clamped(height * l->stage_share, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)));
    l->stage = (struct rect){0, 0, left, stage};
    l->curves = (struct rect){0, stage, left, fmaxf(height - stage, 1)};
    l->inspector = upright ? (struct rect){0, height, left, below} : (struct rect){left, 0, right, height};
    l->status = (struct rect){0, all, l->window.w, theme_row()};
    const float list = left < NARROW ? theme_row() + 6 : LIST, axis = list + AXIS_WIDTH;
    float width = fmaxf(left - axis - MARGIN, 16);
    float sheet = fminf(l->sheet_height, fmaxf(l->curves.h - RULER_HEIGHT - 17, 0));
    float plot = fmaxf(l->curves.h - RULER_HEIGHT - 1 - sheet, 16);
    l->range = (struct rect){0, stage + 1, list < LIST ? 0 : list, RULER_HEIGHT};
    l->list = (struct rect){0, stage + 1 + RULER_HEIGHT, list, sheet + plot};
    l->ruler = (struct rect){axis, stage + 1, width, RULER_HEIGHT};
    l->sheet = (struct rect){axis, stage + 1 + RULER_HEIGHT, width, sheet};
    l->plot = (struct rect){axis, stage + 1 + RULER_HEIGHT + sheet, width, plot};
    l->value_axis = (struct rect){list, l->plot.y, AXIS_WIDTH, plot};
}

void core_set_panels(struct core *core, double stage_share, double inspector_width)
{
    core->view.layout.stage_share = (float)fmin(fmax(stage_share, 0), 1);
    core->view.layout.inspector_width = (float)fmin(fmax(inspector_width, 0), 1e4);
    core_layout(core);
}

enum panel core_panel_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->view.layout;
    if (rect_contains(l->inspector, x, y)) return PANEL_INSPECTOR;
    if (rect_contains(l->status, x, y)) return PANEL_STATUS;
    if (rect_contains(l->curves, x, y)) return PANEL_CURVES;
    return rect_contains(l->stage, x, y) ? PANEL_STAGE : PANEL_NONE;
}

float core_reach(const struct core *core, float pixels) { return core->input.finger ? 1.75f * pixels : pixels; }

enum divider core_divider_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->view.layout;
    const float reach = core_reach(core, DIVIDER_REACH), off = l->upright ? y - l->inspector.y : x - l->inspector.x;
    if (y < l->status.y && fabsf(off) < reach) return l->upright ? DIVIDER_BELOW : DIVIDER_INSPECTOR;
    if (x < l->curves.w && fabsf(y - l->curves.y) < reach) return DIVIDER_STAGE;
    return DIVIDER_NONE;
}

static void move_divider(void *room, struct core *core)
{
    (void)room;
    struct layout *l = &core->view.layout;
    const struct drag *drag = &core->input.drag;
    const float height = fmaxf(l->curves.y + l->curves.h, 1);
    const bool below = drag->owner == &divider_drags[DIVIDER_BELOW];
    const float across = below ? WHOLE * (1 - drag->y / fmaxf(l->status.y, 1)) : l->window.w - drag->x;
    if (drag->owner == &divider_drags[DIVIDER_STAGE]) {
        l->stage_share = clamped(drag->y, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)) / height;
    } else {
        l->inspector_width = roundf(clamped(across, MIN_INSPECTOR, MAX_INSPECTOR));
    }
    core_layout(core);
}

const struct drag_owner divider_drags[] = {
    [DIVIDER_STAGE] = {.cursor = CURSOR_VERTICAL, .move = move_divider},
    [DIVIDER_INSPECTOR] = {.cursor = CURSOR_HORIZONTAL, .move = move_divider},
    [DIVIDER_BELOW] = {.cursor = CURSOR_VERTICAL, .move = move_divider},
};

// --- playback: the played range is never saved

double core_frame(const struct core *core)
{
    return core->document->first_frame + core->view.playback.position / core->document->substeps;
}

double core_position(const struct document *document, double frame)
{
    return (frame - document->first_frame) * document->substeps;
}

void playback_range(const struct core *core, double range[2])
{
    const struct document *document = core->document;
    const double *part = core->view.playback.range;
    range[0] = fmax(part[0], document->first_frame);
    range[1] = fmin(part[1], document->last_frame);
    if (range[0] < range[1]) return;
    range[0] = document->first_frame; // the range lies outside the scene
    range[1] = document->last_frame;
}

bool playback_is_part(const struct core *core)
{
    double range[2];
    playback_range(core, range);
    return range[0] > core->document->first_frame || range[1] < core->document->last_frame;
}

void playback_choose(struct core *core, double first, double last)
{
    double *range = core->view.playback.range, shown[2];
    range[0] = first;
    range[1] = last;
    const bool part = first < last && playback_is_part(core);
    if (!part) range[0] = -INFINITY;
    if (!part) range[1] = INFINITY;
    playback_range(core, shown);
    core_message(core, false, part ? "Playing frames %.0f to %.0f." : "Playing the whole scene.", shown[0], shown[1]);
}

void playback_mark(struct core *core, int end)
{
    const struct document *document = core->document;
    double range[2], frame = round(core_frame(core));
    playback_range(core, range);
    range[end] = frame;
    if (range[0] >= range[1]) range[1 - end] = end ? document->first_frame : document->last_frame;
    playback_choose(core, range[0], range[1]);
}

static const double REFRESH = 60; ///< frames per second a display shows at least

static const double speeds[] = {0.1, 0.25, 0.5, 1, 2, 4};

enum { SPEEDS = sizeof speeds / sizeof speeds[0] };

static void go_to(struct core *core, double position)
{
    core->view.playback.position = fmin(fmax(position, 0), fmax(document_samples(core->document) - 1, 0));
}

/// The played range in samples.
static void range_positions(const struct core *core, double range[2])
{
    playback_range(core, range);
    for (int end = 0; end < 2; end++) range[end] = core_position(core->document, range[end]);
}

void playback_toggle(struct core *core)
{
    struct playback *playback = &core->view.playback;
    double range[2];
    if (playback->playing) {
        playback_seek(core, round(core_frame(core)));
        return;
    }
    playback->playing = true;
    range_positions(core, range);
    playback->dropped = 0;
    bool at_end = !core->view.on[SWITCH_LOOP] && playback->position >= range[1];
    if (at_end || playback->position < range[0] || playback->position > range[1]) playback->position = range[0];
}

void playback_advance(struct core *core, double dt)
{
    struct playback *playback = &core->view.playback;
    const struct document *document = core->document;
    double range[2], from = playback->position;
    if (!playback->playing) {
        go_to(core, from); /* an edit may have shortened the scene */
        return;
    }
    range_positions(core, range);
    double to = from + dt * document->fps * document->substeps * playback->speed;

    // Whole frames that were not shown, beyond those a display cannot show at this speed.
    const double rounding = 1e-6; // a sum of steps may end just before its frame
    const double passed = floor(to / document->substeps + rounding) - floor(from / document->substeps + rounding);
    const double expected = fmax(1, ceil(document->fps * playback->speed / REFRESH));
    if (passed > expected) playback->dropped += (long)(passed - expected);

    playback->position = fmax(to, range[0]);
    if (to < range[1]) return;
    if (core->view.on[SWITCH_LOOP] && range[1] > range[0]) {
        playback->position = range[0] + fmod(to - range[0], range[1] - range[0]);
    } else {
        playback->position = range[1];
        playback->playing = core->view.on[SWITCH_LOOP];
    }
}

void playback_seek(struct core *core, double frame)
{
    core->view.playback.playing = false;
    go_to(core, core_position(core->document, frame));
}

void playback_step(struct core *core, int direction)
{
    double frame = core_frame(core);
    playback_seek(core, direction > 0 ? floor(frame + 1e-6) + 1 : ceil(frame - 1e-6) - 1);
}

void playback_end(struct core *core, int direction)
{
    playback_seek(core, direction > 0 ? core->document->last_frame : core->document->first_frame);
}

void playback_change_speed(struct core *core, int direction)
{
    double *speed = &core->view.playback.speed;
    int at = 0;
    while (at < SPEEDS - 1 && speeds[at] < *speed) at++;
    at += direction;
    *speed = direction == 0 ? 1 : speeds[at < 0 ? 0 : at >= SPEEDS ? SPEEDS - 1 : at];
    core_message(core, false, *speed == 1 ? "Playback in real time." : "Playback at %g× speed.", *speed);
}

// --- switches and looks

void core_flip(struct core *core, int which)
{
    static const char *const said[][2] = {
#define SAID(name, starts, said_off, said_on) [SWITCH_##name] = {said_off, said_on},
        SWITCH_LIST(SAID)
#undef SAID
    };
    bool *on = &core->view.on[which];
    *on = !*on;
    core->view.refit_curves |= which == SWITCH_NORMALISE;
    core->view.refit_stage |= which == SWITCH_ORIGINAL;
    core_message(core, false, "%s", said[which][*on]);
}

void core_set_look(struct core *core, enum look look)
{
    static const char *const texts[] = {
        [LOOK_WIGGLY] = "Wiggly: one spline, each joint with its own phase",
        [LOOK_STIFF] = "Stiff: the same spline without lag",
        [LOOK_CUBIC] = "Cubic: the same knots as a classical spline",
    };
    core->view.look = look;
    core_message(core, false, "%s", texts[look]);
}

void core_turn_look(struct core *core) { core_set_look(core, (core->view.look + 1) % (LOOK_CUBIC + 1)); }

// --- the scene as it was kept (Shift+K), to compare with (hold K)

void take_keep(struct core *core, int keep)
{
    struct take *take = &core->take;
    evaluation_free(&take->evaluation);
    document_destroy(take->document);
    *take = (struct take){.look = core->view.look};
    core_message(core, false, keep ? "Kept as before. Hold K to see it." : "Before is forgotten.");
    if (!keep) return;
    take->document = document_copy(core->document);
    if (core->evaluation) take->evaluation.solver = core->evaluation->solver;
    if (core->evaluation) take->evaluation.models = core->evaluation->models;
    evaluation_update(&take->evaluation, take->document, core->view.look == LOOK_CUBIC);
}

bool take_is_shown(const struct core *core)
{
    return core->take.document && core->input.held_key == 'K' && !core->input.drag.owner &&
           !history_is_open(core->history);
}

/// Whether a rig is posed as before: its bones are the same ones.
static bool take_has(const struct rig *now, const struct rig *before)
{
    if (now->id != before->id || now->kind != before->kind) return false;
    if (now->kind == RIG_MODEL && now->model.drive_count > 0)
        return strcmp(now->model.model, before->model.model) == 0;
    return now->kind != RIG_TAIL || now->tail.joints == before->tail.joints;
}

bool take_is_posed(const struct core *core)
{
    const struct document *now = core->document, *before = core->take.document;
    if (!take_is_shown(core) || now->rig_count != before->rig_count) return false;
    if (now->first_frame != before->first_frame || now->substeps != before->substeps) return false;
    int r = 0;
    while (r < now->rig_count && take_has(now->rigs[r], before->rigs[r])) r++;
    return r == now->rig_count && (!core->models || models_suit(core->models, before));
}

int take_spline(const struct core *core, int spline)
{
    const struct take *take = &core->take;
    return take->document ? document_find_spline_id(take->document, core->document->splines[spline]->id) : -1;
}

const struct rig *take_rig(const struct core *core, int rig)
{
    const struct document *before = core->take.document;
    for (int r = 0; before && r < before->rig_count; r++) {
        if (take_has(core->document->rigs[rig], before->rigs[r])) return before->rigs[r];
    }
    return NULL;
}
