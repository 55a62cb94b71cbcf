/// A brush that paints phase and amplitude onto a character's surface. Private to the folder.
///
/// It works as an airbrush does: as long as the button is down, what it reaches from the way of the pointer since the last frame
/// changes by its flow times the time that has passed. A stroke is one step of the history.
#ifndef EDITOR_STAGE_BRUSH_H
#define EDITOR_STAGE_BRUSH_H

#include "editor/editor.h"
#include "model/reach.h"

enum brush_mode {
    BRUSH_ADVANCE,
    BRUSH_DELAY,
    BRUSH_SMOOTH_PHASE,
    BRUSH_MORE,
    BRUSH_LESS,
    BRUSH_SMOOTH_AMPLITUDE,
    BRUSH_ERASE, ///< back to what the model says
};

/// Memory for figures of up to `capacity` vertices.
struct brush_work {
    int capacity;
    struct reach reach;
    float (*posed)[3]; ///< positions in the world
    int *vertices;     ///< of a dab, and their new values
    float (*values)[2];
    float (*steps)[2];  ///< that smoothing is about to make
    float (*turned)[2]; ///< by what smoothing has multiplied each vertex in this frame; 1 for all others
};

struct brush {
    bool on;
    enum brush_mode mode, stroke; ///< chosen, and what the running stroke does (Shift and Ctrl make it another)
    double radius;                ///< share of the character's height
    double strength;              ///< 0 … 1
    bool covers;                  ///< the pointer is over the character, at `spot`
    struct surface_spot spot;
    uint64_t posed_hash; ///< of the stage and the character on it that `posed` was made for
    float x, y;          ///< pointer in the last frame of the running stroke
    bool has_dabbed;     ///< the running stroke has come to a frame
    struct brush_work work;
};

/// At the start; and at the end.
void brush_init(struct brush *brush);
void brush_free(struct brush *brush);

/// Takes the brush up or puts it away. It cannot be taken up where no character with a coordinate is selected.
void brush_set(struct editor *editor, const struct editor_world *world, bool on);

/// A press on the stage; true where it began a stroke.
bool brush_press(struct editor *editor, const struct editor_world *world, const struct event *event);

/// The wheel on the stage, with Ctrl the radius, with Shift the strength; true where that is what it meant.
bool brush_wheel(struct editor *editor, const struct event *event);

/// Time passes: the running stroke goes on.
void brush_advance(struct editor *editor, const struct editor_world *world, double dt);

/// Ends the running stroke; `keep` false takes it back.
void brush_end(struct editor *editor, const struct editor_world *world, bool keep);

/// Finds what is under the pointer once the stage is posed, and what the brush reaches from there.
void brush_pose(struct editor *editor, const struct editor_world *world);

/// What a stroke that begins with these modifiers does: Shift smooths, Ctrl turns it round. And its name.
enum brush_mode brush_stroke(const struct brush *brush, unsigned mods);
const char *brush_label(enum brush_mode stroke);

/// The ring on the surface, and above the legend what the brush does and what is painted at the pointer.
void brush_show(struct editor *editor, const struct editor_world *world);

/// The radius on a figure, metres.
static inline float brush_radius_of(const struct brush *brush, const struct figure *figure)
{
    return (float)brush->radius * (figure->hi[1] - figure->lo[1]);
}

/// The figure that is painted on, or NULL; and its coordinate.
const struct figure *brush_figure(const struct editor *editor, const struct editor_world *world, int *coordinate);

/// Takes all paint off the selected character, as a step of the history.
void brush_clean(struct editor *editor, const struct editor_world *world);

/// A dab for what work.reach holds: `flow` is the strength times the time. Its arrays are the brush's own.
struct dab brush_dab(struct brush *brush, const struct paint *paint, const struct figure *figure, int coordinate,
                     double flow);

#endif
