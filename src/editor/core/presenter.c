/// Presenting: which panels are in sight, and where they are on their way.
#include "editor/core/presenter.h"
#include "editor/core/core.h"
#include <math.h>

static const double SLIDE = 0.18; ///< seconds
static const float NEAR = 14;     ///< logical pixels from an edge that call a panel

static bool is_wanted(const struct core *core, enum panel panel)
{
    const struct layout *l = &core->layout;
    const float x = core->pointer_x, y = core->pointer_y;
    const enum panel at = core_panel_at(core, x, y);
    if (core->presenter.pinned) return true;
    if (!core->presenter.pointed) return false;
    if (panel == PANEL_INSPECTOR) return at == PANEL_INSPECTOR || x > l->window.w - NEAR;
    return at == PANEL_CURVES || at == PANEL_STATUS || y > l->window.h - NEAR;
}

void presenter_toggle(struct core *core, const struct editor_world *world, int argument)
{
    (void)world;
    (void)argument;
    core->presenter = (struct presenter){.on = !core->presenter.on, .side = 1, .below = 1};
    core_layout(core);
}

bool presenter_event(struct core *core, const struct event *event)
{
    struct presenter *presenter = &core->presenter;
    if (event->kind == EVENT_POINTER) presenter->pointed = true;
    if (!presenter->on || event->kind != EVENT_KEY || event->action != ACTION_PRESS || event->mods) return false;
    if (event->key != KEY_TAB) return false;
    presenter->pinned = !presenter->pinned;
    presenter->shares |= presenter->pinned;
    presenter->pointed = false; // else what the pointer is on would stay
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

/// Slow at both ends.
static float eased(float share) { return share * share * (3 - 2 * share); }

void presenter_arrange(const struct presenter *presenter, struct layout *l)
{
    const float across = roundf((1 - eased(presenter->side)) * l->inspector.w);
    const float down = roundf((1 - eased(presenter->below)) * (l->curves.h + l->status.h));
    l->inspector.x += across;
    l->curves.w += across;
    l->ruler.w += across;
    l->plot.w += across;
    l->sheet.w += across;
    l->open = (struct rect){0, 0, l->curves.w, l->curves.y + down};
    struct rect *const lower[] = {&l->curves, &l->ruler, &l->sheet, &l->plot, &l->value_axis, &l->status};
    l->stage = presenter->shares ? l->open : l->window;
    for (int i = 0; i < (int)(sizeof lower / sizeof *lower); i++) lower[i]->y += down;
}
