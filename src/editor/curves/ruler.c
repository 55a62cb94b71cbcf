/// Grids, numbers and the ruler, with the played range and a draggable mark for each pin.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/curves/state.h"
#include "maths/maths.h"
#include "scene/pins.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const float MIN_FRAME_STEP = 64, MIN_VALUE_STEP = 34, TAG_GAP = 3; ///< pixels between numbers

/// A round distance between numbers, and how many subdivisions it has.
struct grid_step {
    double size;
    int parts;
    int decimals;
};

/// The smallest of 1, 2, 5 · 10ⁿ that is not below `least`.
static struct grid_step round_step(double least)
{
    double power = maths_power_of_ten(maths_decade(least));
    double factor = least / power;
    struct grid_step step = {power, 5, 0};
    if (factor > 5) {
        step.size = 10 * power;
    } else if (factor > 2) {
        step.size = 5 * power;
    } else if (factor > 1) {
        step = (struct grid_step){2 * power, 4, 0};
    }
    step.decimals = (int)fmin(fmax(-maths_decade((1 + 1e-9) * step.size), 0), 9);
    return step;
}

/// Rounds to device pixels, so that hairlines stay sharp at every scale.
static float sharp(const struct core *core, float at) { return roundf(at * core->scale) / core->scale; }

/// The panels that share the time axis: dope sheet and plot.
static struct rect field_of(const struct core *core)
{
    const struct rect *sheet = &core->layout.sheet, *plot = &core->layout.plot;
    return (struct rect){plot->x, sheet->y, plot->w, sheet->h + plot->h};
}

static void vertical(const struct curves *curves, struct core *core, double frame, uint32_t color)
{
    const struct rect field = field_of(core);
    float x = sharp(core, curves_x(curves, core, frame));
    drawlist_rect(&core->list, (struct rect){x, field.y, 1, field.h}, color);
}

static void horizontal(const struct curves *curves, struct core *core, double value, uint32_t color)
{
    const struct rect *plot = &core->layout.plot;
    float y = sharp(core, curves_y(curves, core, value));
    drawlist_rect(&core->list, (struct rect){plot->x, y, plot->w, 1}, color);
}

static void shade_outside(const struct curves *curves, struct core *core)
{
    const struct rect field = field_of(core);
    const float right = field.x + field.w;
    float first = fmaxf(curves_x(curves, core, core->document->first_frame), field.x);
    float last = fminf(curves_x(curves, core, core->document->last_frame), right);
    if (first > field.x)
        drawlist_rect(&core->list, (struct rect){field.x, field.y, first - field.x, field.h}, theme()->outside);
    if (last < right)
        drawlist_rect(&core->list, (struct rect){last, field.y, right - last, field.h}, theme()->outside);
}

/// `unit`: frames per unit of the ruler.
static void draw_lines(const struct curves *curves, struct core *core, struct grid_step times, double unit,
                       struct grid_step values)
{
    const struct view *view = &curves->view;
    double minor = times.size / times.parts * unit;
    for (double i = ceil(view->frame0 / minor); i * minor <= view->frame1; i++) {
        if (fmod(i, times.parts) != 0) vertical(curves, core, i * minor, theme()->grid_minor);
    }
    minor = values.size / values.parts;
    for (double i = ceil(view->value0 / minor); i * minor <= view->value1; i++) {
        if (fmod(i, values.parts) != 0) horizontal(curves, core, i * minor, theme()->grid_minor);
    }
    double major = times.size * unit;
    for (double i = ceil(view->frame0 / major); i * major <= view->frame1; i++) {
        vertical(curves, core, i * major, theme()->grid_major);
    }
    for (double i = ceil(view->value0 / values.size); i * values.size <= view->value1; i++) {
        horizontal(curves, core, i * values.size, i == 0 ? theme()->zero : theme()->grid_major);
    }
}

static void number_values(const struct curves *curves, struct core *core, struct grid_step step)
{
    const struct rect *axis = &core->layout.value_axis;
    float half = font_cap_height(FONT_NUMBER, THEME_TEXT_SMALL) / 2;
    for (double i = ceil(curves->view.value0 / step.size); i * step.size <= curves->view.value1; i++) {
        double value = i * step.size;
        float y = curves_y(curves, core, value);
        if (y < axis->y + 8 || y > axis->y + axis->h - 8) continue;
        char text[32];
        bool wide = fabs(value) >= 1e6 || step.size < 1e-6;
        snprintf(text, sizeof text, wide ? "%.*g" : "%.*f", wide ? 3 : step.decimals, value + 0.0);
        float x = axis->x + axis->w - 8 - font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        drawlist_text(&core->list, fmaxf(x, axis->x + 2), roundf(y + half), FONT_NUMBER, THEME_TEXT_SMALL,
                      theme()->text_dim, text);
    }
}

struct rect ruler_corner(const struct core *core)
{
    const struct layout *layout = &core->layout;
    return (struct rect){layout->value_axis.x, layout->ruler.y, layout->value_axis.w, layout->ruler.h};
}

static void show_units(struct core *core)
{
    struct rect corner = ruler_corner(core);
    const char *text = core->curves.seconds ? "s" : "frame";
    float x = corner.x + corner.w - 8 - font_width(FONT_LABEL, THEME_TEXT_SMALL, text);
    drawlist_text(&core->list, x, corner.y + 15, FONT_LABEL, THEME_TEXT_SMALL,
                  core->hover.thing == &thing_units ? theme()->text : theme()->text_dim, text);
}

/// Frames per unit of the ruler.
static double ruler_unit(const struct core *core) { return core->curves.seconds ? core->document->fps : 1; }

/// Centred over the grid lines. The number under the playhead's tag is left out.
static void number_frames(const struct curves *curves, struct core *core, struct grid_step step)
{
    const struct rect *ruler = &core->layout.ruler;
    const struct rect tag = playhead_tag(curves, core);
    double unit = ruler_unit(core);
    for (double i = ceil(curves->view.frame0 / unit / step.size); i * step.size <= curves->view.frame1 / unit; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.*f", step.decimals, i * step.size + 0.0);
        float width = font_width(FONT_NUMBER, THEME_TEXT_SMALL, text);
        float x = curves_x(curves, core, i * step.size * unit) - width / 2;
        if (x < ruler->x || x + width > ruler->x + ruler->w) continue;
        if (x < tag.x + tag.w + TAG_GAP && x + width > tag.x - TAG_GAP) continue;
        drawlist_text(&core->list, x, ruler->y + 15, FONT_NUMBER, THEME_TEXT_SMALL, theme()->text_dim, text);
    }
}

/// A press that did not move plays the whole scene again; `keep` false restores the former range.
static void end(void *room, struct core *core, bool keep)
{
    const double *before = ((const struct curves *)room)->range_before;
    if (!keep) {
        playback_choose(core, before[0], before[1]);
    } else if (!core->drag.moved) {
        playback_choose(core, -INFINITY, INFINITY);
        playback_say_range(core);
    }
}

/// Marks the played range on the ruler and tints it in the plot, unless it is the whole scene.
static void show_range(const struct curves *curves, struct core *core)
{
    const struct rect *plot = &core->layout.plot, *ruler = &core->layout.ruler;
    double range[2];
    float x[2];
    if (!playback_is_part(core)) return;
    playback_range(core, range);
    for (int end = 0; end < 2; end++)
        x[end] = fminf(fmaxf(curves_x(curves, core, range[end]), plot->x), plot->x + plot->w);
    const float width = x[1] - x[0];
    drawlist_rect(&core->list, (struct rect){x[0], plot->y, width, plot->h}, theme_fade(theme()->accent, 0.05f));
    drawlist_rect(&core->list, (struct rect){x[0], ruler->y, width, ruler->h}, theme_fade(theme()->accent, 0.14f));
    drawlist_rect(&core->list, (struct rect){x[0], ruler->y, 2, ruler->h}, theme()->accent);
    drawlist_rect(&core->list, (struct rect){x[1] - 2, ruler->y, 2, ruler->h}, theme()->accent);
}

void grid_show(const struct curves *curves, struct core *core)
{
    const struct layout *layout = &core->layout;
    double unit = ruler_unit(core);
    struct grid_step times = round_step(MIN_FRAME_STEP / (curves_pixels_per_frame(curves, core) * unit));
    struct grid_step values = round_step(MIN_VALUE_STEP / curves_pixels_per_value(curves, core));
    drawlist_rect(&core->list, layout->curves, theme()->panel);
    struct rect clip = drawlist_push_clip(&core->list, field_of(core));
    shade_outside(curves, core);
    draw_lines(curves, core, times, unit, values);
    drawlist_set_clip(&core->list, clip);
    drawlist_rect(&core->list, (struct rect){layout->ruler.x, layout->sheet.y - 1, layout->ruler.w, 1},
                  theme()->border);
    show_range(curves, core);
    clip = drawlist_push_clip(&core->list, layout->ruler);
    number_frames(curves, core, times);
    drawlist_set_clip(&core->list, clip);
    show_units(core);
    clip = drawlist_push_clip(&core->list, layout->value_axis);
    number_values(curves, core, values);
    drawlist_set_clip(&core->list, clip);
}

static void move(void *room, struct core *core)
{
    const double from = round(curves_frame(room, core, core->drag.start_x));
    const double to = round(curves_frame(room, core, core->drag.x));
    playback_choose(core, fmin(from, to), fmax(from, to));
    playback_say_range(core);
}

static void scrub(void *room, struct core *core)
{
    const double frame = curves_frame(room, core, core->drag.x);
    playback_seek(core, core->drag.snap ? round(frame) : frame);
}

/// Moves the playhead; with Shift chooses the played range.
static void press_ruler(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    static const struct drag_owner scrubbing = {.cursor = CURSOR_HORIZONTAL, .move = scrub},
                                   choosing = {.cursor = CURSOR_HORIZONTAL, .move = move, .end = end};
    struct curves *curves = room;
    const double frame = curves_frame(curves, core, event->x);
    (void)hover;
    drag_begin(core, event->mods & MOD_SHIFT ? &choosing : &scrubbing, curves, NULL, event);
    memcpy(curves->range_before, core->playback.range, sizeof curves->range_before);
    if (!(event->mods & MOD_SHIFT)) playback_seek(core, drag_snaps(core, event->mods) ? round(frame) : frame);
}

static bool find_ruler(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct rect *ruler = &core->layout.ruler;
    xy[0] = curves_x(room, core, target->number[0]);
    xy[1] = ruler->y + ruler->h / 2;
    return rect_contains(*ruler, xy[0], xy[1]);
}

const struct thing thing_ruler = {
    .cursor = CURSOR_HORIZONTAL,
    .hint = "Drag to scrub; Shift+drag to play part of the range, Shift+click to play it all",
    .place = ON_TIME,
    .press = press_ruler,
    .name = "ruler",
    .numbers = 1,
    .find = find_ruler,
    .missing = "that frame is not on the visible part of the ruler"};

static const float REACH = 6;                        ///< pixels at which a mark is hit
static const float RADIUS = 4, ABOVE = 9, BELOW = 6; ///< pixels around a mark on the ruler's lower edge

static void place(const struct curves *curves, const struct core *core, const struct pin *pin, float xy[2])
{
    const struct rect *ruler = &core->layout.ruler;
    xy[0] = curves_x(curves, core, document_frame(core->document, document_sample(core->document, pin->frame)));
    xy[1] = ruler->y + ruler->h - 1;
}

struct hover ruler_pins_hover(const struct curves *curves, const struct core *core, float x, float y)
{
    const struct rect *ruler = &core->layout.ruler;
    struct hover hover = {.thing = NULL};
    float best = REACH;
    const float edge = ruler->y + ruler->h;
    if (y < edge - ABOVE || y >= edge + BELOW || x < ruler->x || x >= ruler->x + ruler->w) return hover;
    struct pin_place at = PINS_START;
    for (const struct pin *pin; (pin = pins_next(core->document, &at));) {
        float xy[2];
        place(curves, core, pin, xy);
        float distance = fabsf(x - xy[0]);
        if (distance < REACH && core->pin.any && core->pin.id == pin->id) distance = -1;
        if (distance >= best) continue;
        best = distance;
        hover = (struct hover){.thing = &thing_pin_time, .rig = at.rig, .joint = pin->point, .pin = pin->id};
    }
    return hover;
}

static void apply(void *room, struct core *core)
{
    struct curves *curves = room;
    struct pin_time_drag *drag = &curves->pin_drag;
    const struct document *document = core->document;
    int rig;
    const struct pin *pin = pins_selected(core, &rig);
    if (!pin || pin->id != drag->id) return;
    struct pin moved = *pin;
    double frame = drag->frame + core->drag.moved_x / curves_pixels_per_frame(curves, core);
    if (core->drag.snap) frame = round(frame);
    int sample = document_sample(document, frame), last = pins_last_sample(document, document->rigs[rig]);
    sample = sample < 0 ? 0 : sample > last ? last : sample;
    const int there = pins_find(document, document->rigs[rig], pin->point, sample);
    if (there < 0 || document->rigs[rig]->pins[there].id == pin->id)
        drag->free_frame = document_frame(document, sample); // else it stays at the last free frame
    moved.frame = drag->free_frame;
    if (!pins_set(core->document, rig, &moved, &core->error)) return;
    playback_seek(core, moved.frame);
    pins_tell(core, rig);
}

/// Selects the pin, goes to its frame and starts dragging it.
static void press_pin(void *room, struct core *core, const struct hover *hover, const struct event *event)
{
    struct curves *curves = room;
    static const struct drag_owner owner = {.cursor = CURSOR_HORIZONTAL, .apply = apply};
    const struct document *document = core->document;
    const struct rig *rig = document->rigs[hover->rig];
    const int at = pins_find_id(rig, hover->pin);
    if (at < 0) return;
    drag_begin(core, &owner, curves, "Move pin in time", event);
    curves->pin_drag = (struct pin_time_drag){.id = hover->pin, .frame = rig->pins[at].frame};
    curves->pin_drag.free_frame = curves->pin_drag.frame;
    pins_visit(core, &rig->pins[at]);
}

void ruler_pins_show(const struct curves *curves, struct core *core)
{
    const struct rect *ruler = &core->layout.ruler;
    struct pin_place at = PINS_START;
    for (const struct pin *pin; (pin = pins_next(core->document, &at));) {
        const uint32_t color = pins_color(core->document, at.rig);
        const bool selected = core->pin.any && core->pin.id == pin->id;
        const bool hot = core->hover.thing == &thing_pin_time && core->hover.pin == pin->id;
        const float radius = RADIUS + (selected || hot ? 1 : 0);
        float xy[2];
        place(curves, core, pin, xy);
        if (xy[0] < ruler->x || xy[0] > ruler->x + ruler->w) continue;
        drawlist_disc(&core->list, xy, radius, selected ? theme()->playhead : color);
        drawlist_circle(&core->list, xy, radius, 1, selected || hot ? color : theme()->panel);
    }
}

static bool find_pin(void *room, const struct core *core, const struct target *target, float xy[2])
{
    place(room, core, target->pin, xy);
    return rect_contains(core->layout.ruler, xy[0], xy[1]);
}

/// pintime(tail,0): a pin's mark on the ruler, counted by frame.
const struct thing thing_pin_time = {
    .cursor = CURSOR_MOVE,
    .hint = "Drag to move the pin in time (Ctrl: off frames); Del removes it; Alt+PgUp, Alt+PgDn: by a frame",
    .place = ON_PIN,
    .press = press_pin,
    .name = "pintime",
    .of = OF_PIN,
    .numbers = 1,
    .find = find_pin,
    .missing = "that pin is not on the visible part of the ruler"};
