/// Where the panels are: stage over curves at the left, inspector at the right, status line below.
#include "editor/core/core.h"
#include "editor/core/presenter.h"
#include "ui/theme.h"
#include <math.h>

static const float RULER_HEIGHT = 22, AXIS_WIDTH = 52, LABEL_WIDTH = 76, DIVIDER_REACH = 4;
static const float MIN_STAGE = 120, MIN_CURVES = 140, MIN_LEFT = 480, MIN_INSPECTOR = 240, MAX_INSPECTOR = 480;

static float clamped(float value, float lo, float hi) { return fmaxf(lo, fminf(value, hi)); }

void core_layout(struct core *core)
{
    struct layout *l = &core->layout;
    float height = fmaxf(l->window.h - THEME_STATUS_HEIGHT, 2);
    float right = clamped(l->inspector_width, MIN_INSPECTOR, fminf(MAX_INSPECTOR, fmaxf(l->window.w - MIN_LEFT, 0)));
    float left = fmaxf(l->window.w - right, 1);
    float stage = roundf(clamped(height * l->stage_share, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)));
    l->stage = (struct rect){0, 0, left, stage};
    l->curves = (struct rect){0, stage, left, fmaxf(height - stage, 1)};
    l->inspector = (struct rect){left, 0, right, height};
    l->status = (struct rect){0, height, l->window.w, THEME_STATUS_HEIGHT};
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

enum panel core_panel_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->layout;
    if (rect_contains(l->inspector, x, y)) return PANEL_INSPECTOR;
    if (rect_contains(l->status, x, y)) return PANEL_STATUS;
    if (rect_contains(l->curves, x, y)) return PANEL_CURVES;
    return rect_contains(l->stage, x, y) ? PANEL_STAGE : PANEL_NONE;
}

enum divider core_divider_at(const struct core *core, float x, float y)
{
    const struct layout *l = &core->layout;
    if (core->presenter.on) return DIVIDER_NONE;
    if (y < l->status.y && fabsf(x - l->inspector.x) < DIVIDER_REACH) return DIVIDER_INSPECTOR;
    if (x < l->inspector.x && fabsf(y - l->curves.y) < DIVIDER_REACH) return DIVIDER_STAGE;
    return DIVIDER_NONE;
}

void core_divider_move(struct core *core, enum divider divider, float x, float y)
{
    struct layout *l = &core->layout;
    float height = fmaxf(l->status.y, 1);
    if (divider == DIVIDER_STAGE) {
        l->stage_share = clamped(y, MIN_STAGE, fmaxf(height - MIN_CURVES, 1)) / height;
    } else {
        l->inspector_width = roundf(clamped(l->window.w - x, MIN_INSPECTOR, MAX_INSPECTOR));
    }
    core_layout(core);
}
