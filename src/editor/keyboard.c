/// Keyboard actions for what the mouse does to views, selection and panels.
#include "editor/core/knots.h"
#include "editor/curves/curves.h"
#include "editor/editor.h"
#include "editor/keys.h"
#include "editor/stage/stage.h"
#include "editor/state.h"

static const double PAN = 0.1;  ///< of the panel's size
static const double ZOOM = 0.8; ///< of what is seen, a step
static const float TURN = 0.1f; ///< radians
static const int way_sign[][2] = {
    [WAY_LEFT] = {-1, 0}, [WAY_RIGHT] = {1, 0}, [WAY_UP] = {0, -1}, [WAY_DOWN] = {0, 1}};

void keyboard_pan(struct editor *editor, const struct editor_world *world, int way)
{
    const struct rect *plot = &editor->core.layout.plot;
    (void)world;
    curves_pan(editor->curves, &editor->core, -PAN * way_sign[way][0] * plot->w, -PAN * way_sign[way][1] * plot->h);
}

void keyboard_zoom(struct editor *editor, const struct editor_world *world, int direction)
{
    const struct rect *plot = &editor->core.layout.plot;
    double factor = direction > 0 ? ZOOM : 1 / ZOOM;
    (void)world;
    curves_zoom(editor->curves, &editor->core, plot->x + plot->w / 2, plot->y + plot->h / 2, factor, factor);
}

void keyboard_orbit(struct editor *editor, const struct editor_world *world, int way)
{
    (void)world;
    stage_orbit(editor->stage, TURN * (float)way_sign[way][0], -TURN * (float)way_sign[way][1]);
}

void keyboard_approach(struct editor *editor, const struct editor_world *world, int direction)
{
    (void)world;
    stage_approach(editor->stage, (float)(direction > 0 ? ZOOM : 1 / ZOOM));
}

void keyboard_fit_stage(struct editor *editor, const struct editor_world *world, int argument)
{
    (void)argument;
    stage_fit(editor->stage, &editor->core, world);
}

void keyboard_remedy(struct editor *editor, const struct editor_world *world, int argument)
{
    (void)argument;
    curves_remedy_first(editor->curves, &editor->core, world);
}

/// What was selected is to be seen.
static void reveal(struct editor *editor, const struct knot *knot)
{
    if (knot) curves_reveal(editor->curves, &editor->core, knot->frame, knot->value);
}

void keyboard_neighbour(struct editor *editor, const struct editor_world *world, int direction)
{
    reveal(editor, core_select_neighbour(&editor->core, world, direction));
}

void keyboard_extend(struct editor *editor, const struct editor_world *world, int direction)
{
    reveal(editor, core_extend_selection(&editor->core, world, direction));
}

/// The first of the sizes that is clearly larger than the present one, round the end.
static double next_size(const double sizes[3], double present)
{
    int next = 0;
    while (next < 3 && sizes[next] <= present * 1.01) next++;
    return sizes[next % 3];
}

void keyboard_panel(struct editor *editor, const struct editor_world *world, int inspector)
{
    static const double shares[3] = {0.35, 0.575, 0.75}, widths[3] = {280, 360, 440};
    double share, width;
    (void)world;
    editor_panels(editor, &share, &width);
    if (inspector) {
        width = next_size(widths, width);
    } else {
        share = next_size(shares, share);
    }
    editor_set_panels(editor, share, width);
}
