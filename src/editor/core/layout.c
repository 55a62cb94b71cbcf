/// Panel layout: stage above curves at the left, inspector at the right, in upright windows at the bottom; status line below. While
/// presenting, panels slide in.
#include "editor/core/core.h"
#include "ui/theme.h"
#include <math.h>

static const float RULER_HEIGHT = 22, AXIS_WIDTH = 52, LABEL_WIDTH = 76, DIVIDER_REACH = 4;
static const float MIN_STAGE = 120, MIN_CURVES = 140, MIN_LEFT = 480, MIN_INSPECTOR = 240, MAX_INSPECTOR = 480;
static const float UPRIGHT = 800; ///< narrower windows that are higher than wide have the inspector at the bottom
static const float WHOLE = 800;   ///< inspector_width that would take all of their height

static float clamped(float value, float lo, float hi) { return fmaxf(lo, fminf(value, hi)); }

static float eased(float share) { return share * share * (3 - 2 * share); }

/// Offsets sliding panels, and gives the stage the window.
static void presenter_arrange(const struct presenter *presenter, struct layout *l)
{
    const float across = l->upright ? 0 : roundf((1 - eased(presenter->side)) * l->inspector.w);
    const float down = roundf((1 - eased(presenter->below)) * (l->window.h - l->curves.y));
    l->inspector.x += across;
    l->curves.w += across;
    l->ruler.w += across;
    l->plot.w += across;
    l->sheet.w += across;
    l->open = (struct rect){0, 0, l->curves.w, l->curves.y + down};
    struct rect *const lower[] = {&l->curves, &l->ruler, &l->sheet, &l->plot, &l->value_axis, &l->status};
    l->stage = presenter->shares || l->upright ? l->open : l->window; // upright, nothing of it would be left
    for (int i = 0; i < (int)(sizeof lower / sizeof *lower); i++) lower[i]->y += down;
    if (l->upright) l->inspector.y += down;
}

void core_layout(struct core *core)
{
    struct layout *l = &core->layout;
    const float all = fmaxf(l->window.h - THEME_STATUS_HEIGHT, 2);
    const bool upright = l->window.w < UPRIGHT && l->window.h > l->window.w;
    l->upright = upright;
    const float most = upright ? MAX_INSPECTOR : fminf(MAX_INSPECTOR, fmaxf(l->window.w - MIN_LEFT, 0));
    const float size = clamped(l->inspector_width, MIN_INSPECTOR, most);
    const float below = upright ? roundf(all * size / WHOLE) : 0, height = all - below;
    const float right = upright ? 0 : size, left = fmaxf(l->window.w - right, 1);
    float stage = roundf(clamped(height * l->stage_share, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)));
    l->stage = (struct rect){0, 0, left, stage};
    l->curves = (struct rect){0, stage, left, fmaxf(height - stage, 1)};
    l->inspector = upright ? (struct rect){0, height, left, below} : (struct rect){left, 0, right, height};
    l->status = (struct rect){0, all, l->window.w, THEME_STATUS_HEIGHT};
    float width = fmaxf(left - AXIS_WIDTH - LABEL_WIDTH, 16);
    float sheet = fminf(l->sheet_height, fmaxf(l->curves.h - RULER_HEIGHT - 17, 0));
    float plot = fmaxf(l->curves.h - RULER_HEIGHT - 1 - sheet, 16);
    l->ruler = (struct rect){AXIS_WIDTH, stage + 1, width, RULER_HEIGHT};
    l->sheet = (struct rect){AXIS_WIDTH, stage + 1 + RULER_HEIGHT, width, sheet};
    l->plot = (struct rect){AXIS_WIDTH, stage + 1 + RULER_HEIGHT + sheet, width, plot};
    l->value_axis = (struct rect){0, l->plot.y, AXIS_WIDTH, plot};
    l->open = l->stage;
    if (core->presenter.on) presenter_arrange(&core->presenter, l);
}

void core_set_panels(struct core *core, double stage_share, double inspector_width)
{
    core->layout.stage_share = (float)fmin(fmax(stage_share, 0), 1);
    core->layout.inspector_width = (float)fmin(fmax(inspector_width, 0), 1e4);
    core_layout(core);
}

enum panel core_panel_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->layout;
    if (rect_contains(l->inspector, x, y)) return PANEL_INSPECTOR;
    if (rect_contains(l->status, x, y)) return PANEL_STATUS;
    if (rect_contains(l->curves, x, y)) return PANEL_CURVES;
    return rect_contains(l->stage, x, y) ? PANEL_STAGE : PANEL_NONE;
}

float core_reach(const struct core *core, float pixels) { return core->finger ? 1.75f * pixels : pixels; }

enum divider core_divider_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->layout;
    if (core->presenter.on) return DIVIDER_NONE;
    const float reach = core_reach(core, DIVIDER_REACH), off = l->upright ? y - l->inspector.y : x - l->inspector.x;
    if (y < l->status.y && fabsf(off) < reach) return l->upright ? DIVIDER_BELOW : DIVIDER_INSPECTOR;
    if (x < l->curves.w && fabsf(y - l->curves.y) < reach) return DIVIDER_STAGE;
    return DIVIDER_NONE;
}

void core_divider_move(struct core *core, enum divider divider, float x, float y)
{
    struct layout *l = &core->layout;
    const float height = fmaxf(l->curves.y + l->curves.h, 1);
    const float across = divider == DIVIDER_BELOW ? WHOLE * (1 - y / fmaxf(l->status.y, 1)) : l->window.w - x;
    if (divider == DIVIDER_STAGE) {
        l->stage_share = clamped(y, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)) / height;
    } else {
        l->inspector_width = roundf(clamped(across, MIN_INSPECTOR, MAX_INSPECTOR));
    }
    core_layout(core);
}

static const double SLIDE = 0.18; ///< seconds
static const float NEAR = 14;     ///< logical pixels from an edge that call its panel

static bool is_wanted(const struct core *core, enum panel panel)
{
    const struct layout *l = &core->layout;
    const float x = core->pointer_x, y = core->pointer_y;
    const enum panel at = core_panel_at(core, x, y);
    if (core->presenter.pinned) return true;
    if (!core->presenter.pointed) return false;
    if (panel == PANEL_INSPECTOR && !l->upright) return at == PANEL_INSPECTOR || x > l->window.w - NEAR;
    return at == PANEL_CURVES || at == PANEL_STATUS || (l->upright && at == PANEL_INSPECTOR) ||
           y > l->window.h - NEAR;
}

void presenter_toggle(struct core *core, int argument)
{
    (void)argument;
    core->presenter = (struct presenter){.on = !core->presenter.on, .side = 1, .below = 1};
    core_layout(core);
}

bool presenter_event(struct core *core, const struct event *event)
{
    struct presenter *presenter = &core->presenter;
    if (event->kind == EVENT_POINTER) presenter->pointed = true;
    if (!presenter->on || event->action != ACTION_PRESS) return false;
    if (event->kind == EVENT_BUTTON)
        return presenter_is_sliding(core); // a finger that calls the panels aims at nothing
    if (event->kind != EVENT_KEY || event->key != KEY_TAB || event->mods) return false;
    presenter->pinned = !presenter->pinned;
    presenter->shares |= presenter->pinned;
    presenter->pointed = false; // else the hover would stay
    return true;
}

/// Moves a share towards 0 or 1.
static void slide(float *share, bool in, double dt)
{
    const float by = (float)(dt / SLIDE);
    *share = in ? fminf(*share + by, 1) : fmaxf(*share - by, 0);
}

void presenter_advance(struct core *core, double dt, bool busy)
{
    struct presenter *presenter = &core->presenter;
    if (!presenter->on) return;
    if (!busy && !core->drag.owner) {
        presenter->side_wanted = is_wanted(core, PANEL_INSPECTOR);
        presenter->below_wanted = is_wanted(core, PANEL_CURVES);
    }
    if (!presenter_is_sliding(core)) return;
    slide(&presenter->side, presenter->side_wanted, dt);
    slide(&presenter->below, presenter->below_wanted, dt);
    presenter->shares &= presenter->pinned || presenter->side > 0 || presenter->below > 0;
    core_layout(core);
}

bool presenter_is_sliding(const struct core *core)
{
    const struct presenter *p = &core->presenter;
    return p->on && (p->side != (float)p->side_wanted || p->below != (float)p->below_wanted);
}
