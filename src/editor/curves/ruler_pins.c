/// Pins on the ruler: a mark at the frame of each, which is dragged to move it in time.
#include "editor/core/arrange.h"
#include "editor/core/core.h"
#include "editor/core/pins.h"
#include "editor/core/playback.h"
#include "editor/curves/curves.h"
#include "editor/curves/gestures.h"
#include "editor/curves/view.h"
#include "scene/pins.h"
#include "ui/theme.h"
#include <math.h>

static const float REACH = 6;                        ///< pixels beside a mark
static const float RADIUS = 4, ABOVE = 9, BELOW = 6; ///< of a mark on the ruler's lower edge: how far it is taken

/// Where its mark is.
static void place(const struct curves *curves, const struct core *core, const struct document *document,
                  const struct pin *pin, float xy[2])
{
    const struct rect *ruler = &core->layout.ruler;
    xy[0] = curves_x(curves, core, document_frame(document, document_sample(document, pin->frame)));
    xy[1] = ruler->y + ruler->h - 1;
}

struct hover ruler_pins_hover(const struct curves *curves, const struct core *core, const struct document *document,
                              float x, float y)
{
    const struct rect *ruler = &core->layout.ruler;
    struct hover hover = {.kind = HOVER_NONE};
    float best = REACH;
    const float edge = ruler->y + ruler->h;
    if (y < edge - ABOVE || y >= edge + BELOW || x < ruler->x || x >= ruler->x + ruler->w) return hover;
    for (int r = 0; r < document->rig_count; r++) {
        for (int i = 0; i < document->rigs[r].pin_count; i++) {
            const struct pin *pin = &document->rigs[r].pins[i];
            float xy[2];
            place(curves, core, document, pin, xy);
            float distance = fabsf(x - xy[0]);
            if (distance < REACH && core->pin.any && core->pin.id == pin->id) distance = 0;
            if (distance >= best) continue;
            best = distance;
            hover = (struct hover){.kind = HOVER_PIN, .rig = r, .joint = pin->point, .pin = pin->id};
        }
    }
    return hover;
}

/// The pin goes to the pointer's frame, and the playhead goes along.
static void apply(void *room, struct core *core, const struct editor_world *world)
{
    struct curves *curves = room;
    struct pin_time_drag *drag = &curves->pin_drag;
    const struct document *document = world->document;
    int rig;
    const struct pin *pin = pins_selected(core, document, &rig);
    if (!pin || pin->id != drag->id) return;
    struct pin moved = *pin;
    double frame = drag->frame + core->drag.moved_x / curves_pixels_per_frame(curves, core);
    if (core->drag.snap) frame = round(frame);
    int sample = document_sample(document, frame), last = pins_last_sample(document, &document->rigs[rig]);
    sample = sample < 0 ? 0 : sample > last ? last : sample;
    const int there = pins_find(document, &document->rigs[rig], pin->point, sample);
    if (there < 0 || document->rigs[rig].pins[there].id == pin->id)
        drag->free_frame = document_frame(document, sample); // else it stays where it last was free
    moved.frame = drag->free_frame;
    const struct edit edit = pins_edit(EDIT_PIN_SET, rig, &moved);
    if (!core_edit(core, world, &edit)) return;
    playback_seek(core, document, moved.frame);
    pins_tell(core, world, rig);
}

void ruler_pins_begin(struct curves *curves, struct core *core, const struct editor_world *world,
                      const struct hover *hover, const struct event *event)
{
    static const struct drag_owner owner = {.cursor = CURSOR_HORIZONTAL, .apply = apply};
    const struct document *document = world->document;
    const struct rig *rig = &document->rigs[hover->rig];
    const int at = pins_find_id(rig, hover->pin);
    if (at < 0) return;
    drag_begin(core, &owner, curves, "Move pin in time", event);
    curves->pin_drag = (struct pin_time_drag){.id = hover->pin, .frame = rig->pins[at].frame};
    curves->pin_drag.free_frame = curves->pin_drag.frame;
    pins_visit(core, document, &rig->pins[at]);
}

void ruler_pins_show(const struct curves *curves, struct core *core, const struct document *document)
{
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = &document->rigs[r];
        const int spline = rig_point_spline(rig);
        const uint32_t color = spline >= 0 ? arrange_color(document, spline) : theme()->text_dim;
        for (int i = 0; i < rig->pin_count; i++) {
            const struct pin *pin = &rig->pins[i];
            const bool selected = core->pin.any && core->pin.id == pin->id;
            const bool hot = core->hover.kind == HOVER_PIN && core->hover.pin == pin->id;
            const float radius = RADIUS + (selected || hot ? 1 : 0);
            float xy[2];
            place(curves, core, document, pin, xy);
            if (xy[0] < core->layout.ruler.x || xy[0] > core->layout.ruler.x + core->layout.ruler.w) continue;
            const struct rect disc = {xy[0] - radius, xy[1] - radius, 2 * radius, 2 * radius};
            drawlist_rounded(&core->list, disc, radius, selected ? theme()->playhead : color);
            drawlist_rounded_line(&core->list, disc, radius, 1, selected || hot ? color : theme()->panel);
        }
    }
}

bool curves_pin_point(const struct curves *curves, const struct core *core, const struct document *document,
                      const struct pin *pin, float xy[2])
{
    place(curves, core, document, pin, xy);
    return rect_contains(core->layout.ruler, xy[0], xy[1]);
}
