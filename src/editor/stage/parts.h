/// Functions that the files of the stage share. Private to the room, and to tests.
#ifndef EDITOR_STAGE_PARTS_H
#define EDITOR_STAGE_PARTS_H

#include "editor/stage/state.h"
#include "rig/imported.h"
#include "rig/posing.h"
#include <math.h>

/// `rig` is the index in the document, `n` that among its kind.
struct stage_kind {
    /// Poses it into the editor's stage view, with its shadow.
    void (*pose)(struct stage *stage, const struct core *core, int rig, int n);
    /// Steps through the scene at which the box around its motion is measured; 0: it has none of its own.
    int bound_steps;
    /// Metres that this is wider to both sides; NULL: as it is.
    float (*aside)(const struct core *core, int n);
    /// Hash over all of them in the view; NULL: another kind's hash covers them.
    uint64_t (*hash)(uint64_t hash, const struct stage_view *view);
};

/// tail_stage …
#define STAGE_KIND(constant, name) extern const struct stage_kind name##_stage;
RIG_KIND_LIST(STAGE_KIND)
#undef STAGE_KIND

/// Inputs of posing: the world, in the editor's look.
struct posing stage_posing(const struct core *core);
/// Where a point of the world is on the screen, the stage being drawn in `r`; false where it is behind the eye.
bool stage_project_point(const struct stage *stage, struct rect r, const float point[3], float xy[2]);

/// Darkens the stage below texts, or lightens it, so that they can be read over any character.
void stage_scrim(struct core *core, struct rect box);
/// A small text from (x, y) on its baseline, with a scrim of its own.
void stage_note(struct core *core, float x, float y, enum font font, uint32_t color, const char *text);
/// A ring where a tail or chain is held, or can be taken hold of.
void stage_ring(struct core *core, const float xy[2]);
/// The end of a drag that never moved: a click, on a bone or beside all.
void stage_click(void *room, struct core *core, bool keep);

/// The same, with the held body and the parts that swing after it.
struct posing stage_posing_by_hand(const struct stage *stage);
/// Pixels a metre that faces the eye takes at a place.
double stage_pixels_per_metre(const struct stage *stage, const struct core *core, const float place[3]);
/// How far along an axis of the world the pointer's way goes, in pixels as the axis goes on the screen, for each across and up.
double stage_along(double across, double up, double dx, double dy);
/// A character as the stage shows it (its number in the document): of a pair, the one that is not stiff. NULL: it does not.
const struct stage_character *stage_character_shown(const struct stage *stage, int character);
/// Where a vertex of a character is in the world that stands at a position.
void stage_vertex(const struct figure *figure, const struct morph *morph, const float position[3], int vertex,
                  float place[3]);

/// Notes the rigs on the held body, before any edit.
void base_begin(struct stage *stage, const struct core *core);
/// Where a coordinate is at a sample, metres, as a spline would have it.
double base_value(const struct core *core, int rig, int coordinate, int sample);
/// The spline that a coordinate follows, a new cubic where it is a number yet; -1 on failure.
int base_spline(const struct stage *stage, struct core *core, int coordinate);
/// Sets or inserts a knot, within the limits of its spline (see core_hold()); a level one stands still there.
void base_put_knot(struct core *core, int spline, int sample, double value, bool level, char why[STOPPED_SIZE]);
/// The coordinate follows the spline from now on.
void base_follow(const struct stage *stage, struct core *core, int coordinate, int base);
/// Lets the channels that swung with a coordinate follow its spline. A tail without such a channel gets one. Returns its new spline, or -1.
int base_hang_channels(const struct stage *stage, struct core *core, int coordinate, int base);
/// Adds a sentence on the new spline to a message; nothing for -1.
void base_say_channel(const struct core *core, int spline, char *text, size_t size);

/// Shows the model of a rig: an imported character, or the fox of a tail; NULL where it has none, or there is no room.
struct stage_model *models_show(struct stage *stage, const struct core *core, int rig, struct rig_pose *posed);

/// The one of a rig as it was last shown, or NULL.
const struct shown_strand *strand_of(const struct stage *stage, int rig);
/// Poses one with the movement by hand; `change` may be NULL. false if it, or its model, is missing.
bool strand_pose(const struct stage *stage, const struct core *core, int rig, double position,
                 const struct what_if *change, struct rig_pose *pose);
/// Where a point of it is on the screen: `fraction` 0 … 1 of the way from joint to joint + 1. false where it is behind the eye.
bool strand_project(const struct stage *stage, const struct core *core, const struct pose *strand, int joint,
                    double fraction, float xy[2]);
/// Pixels from its centre line within which a tail is taken.
#define STRAND_REACH 16.0f
/// Sets `hover` (HOVER_JOINT) and `nearest` (pixels) if a point of it is nearer to p than that.
void strand_nearer(const struct stage *stage, const struct core *core, int rig, const struct pose *strand,
                   const float p[2], float *nearest, struct hover *hover);
/// The nearest point of a tail (HOVER_JOINT), or HOVER_NONE. Chains are pointed at by their bones (bone_hover()).
struct hover strand_hover(const struct stage *stage, const struct core *core, float x, float y);
/// The end of the joint of a tail or chain that is nearest to a point between two (HOVER_POINT); HOVER_NONE where it is behind the eye.
struct hover strand_end(const struct stage *stage, const struct core *core, const struct hover *between);

/// Whether the document has it and, of a character, its model.
bool point_exists(const struct core *core, struct rig_point point);
/// Its place in the document at a position in samples, world; false where its model is missing.
bool point_place(const struct core *core, struct rig_point point, double position, float place[3]);

/// Adds the bones of a character that is shown.
void bones_add(struct stage *stage, int model, const struct rig_pose *pose);
/// Marks those of a chain of a model rig.
void bones_mark(struct stage *stage, const struct core *core, int rig, int model, const struct chain_bones *bones);

/// The bone under a point of the stage: HOVER_JOINT of its chain, else HOVER_BONE, or HOVER_NONE.
struct hover bone_hover(const struct stage *stage, const struct core *core, float x, float y);
/// A click where the pointer went down: selects the bone there, or none.
void bone_click(const struct stage *stage, struct core *core);

/// Draws them: all of the character under the pointer, those behind the selected bone.
void bones_show(const struct stage *stage, struct core *core);

/// A floor as it is seen: corners in turn, on the screen.
struct shown_floor {
    float xy[4][2];
    int first; ///< the corner that is nearest to the eye
};

/// The edge of a floor under a point of the stage (HOVER_FLOOR), or HOVER_NONE.
struct hover floors_hover(const struct stage *stage, const struct core *core, float x, float y);

/// Starts to drag a floor; edits nothing until the pointer moves.
void floors_begin(struct stage *stage, struct core *core, const struct hover *hover, const struct event *event);
/// Draws all floors: brighter where a character stands on one, in the colour of warnings where it is below.
void floors_show(const struct stage *stage, struct core *core);

/// The pin under a point of the stage: a marker (HOVER_PIN), else, where nothing else was `found` there, a surface point
/// that can be pinned (HOVER_POINT), else HOVER_NONE.
struct hover pins_hover(struct stage *stage, const struct core *core, const struct hover *found, float x, float y);

/// Starts to drag the point or marker under the pointer; edits nothing until it moves.
void pins_begin(struct stage *stage, struct core *core, const struct hover *hover, const struct event *event);

/// Draws all markers, highlights, and the path of the held or selected point.
void pins_show(struct stage *stage, struct core *core);

/// Frees its memory.
void brush_free(struct painting *painting);
/// Handles a press on the stage; true if it began a stroke.
bool brush_press(struct stage *stage, struct core *core, const struct event *event);
/// Ctrl+wheel changes the radius, Shift+wheel the strength; true if it was one of these.
bool brush_wheel(struct core *core, const struct event *event);
/// Finds the surface point under the pointer once the stage is posed, and the brush's reach from there.
void brush_pose(struct stage *stage, struct core *core, bool covered);

/// Draws the ring on the surface; above the legend, the brush's mode and the paint at the pointer.
void brush_show(struct stage *stage, struct core *core);

/// The body under a point of the stage (HOVER_BODY) at a position in samples, the nearest to the eye, or HOVER_NONE.
struct hover body_hover(struct stage *stage, const struct core *core, double position, float x, float y);
/// Points of a body that are likely to be in sight, the likeliest first, on the screen; false where one is behind the eye.
enum { BODY_HEAD = 1, BODY_POINTS = 4 };
bool body_point(const struct stage *stage, const struct core *core, int tail, int point, float xy[2]);
/// The tail of a rig; NULL: it is none, or gone.
struct tail *tail_of(const struct document *document, int rig);
/// Starts to drag a body, over the ground or, with Ctrl, up and across. X, Y and Z lock an axis, R records.
void body_drag_begin(struct stage *stage, struct core *core, int rig, const struct event *event);
/// Whether a body is dragged.
bool body_is_held(const struct core *core);
/// A ring on the ground round the body that is held or can be.
void body_drag_show(struct stage *stage, struct core *core);

/// How far the pointer has moved the held body, metres, limits aside; 0 where none is held.
void body_drag_way(const struct stage *stage, const struct core *core, double offset[3]);
/// Moves the held body as far as pointer and limits allow: before everything else advances.
void body_drag_advance(struct stage *stage, const struct core *core);
/// How far the running drag has moved a rig from its place in the document, metres; 0 where it is not on the held body.
void body_drag_offset(const struct stage *stage, const struct core *core, int rig, double offset[3]);

/// Advances by `dt` seconds: the bases go where body_drag_offset() says, and their tails and chains swing.
void drag_inertia_advance(struct stage *stage, const struct core *core, double dt);
/// The document now holds the offset: the base has not moved by that.
void drag_inertia_land(struct stage *stage);
/// Stops the follow-through of a body at once.
void drag_inertia_stop(struct stage *stage, const struct document *document, int body);
/// swing_scale() of a channel that swings; else 0.
double drag_inertia_scale(const struct stage *stage, const struct document *document, int rig, int channel);
/// Adds the follow-through to the values of a rig's channels.
void drag_inertia_add(const struct stage *stage, const struct document *document, int rig,
                      wiggly_value values[RIG_MAX_INPUTS]);

/// Starts to record at the playhead, and plays; the body must be held.
void record_begin(struct stage *stage, struct core *core);
/// Records the body's place up to the playhead; stops at the end of the played range.
void record_advance(struct stage *stage, const struct core *core);
/// The path of the body under the pointer or in hand, and the motion recorded so far.
void record_show(struct stage *stage, struct core *core);
/// Whether a motion was recorded.
bool record_has_motion(const struct stage *stage);
/// Forgets the motion.
void record_forget(struct stage *stage);
/// Indices (from 0) of knots that a cubic through them, level at both ends, needs to stay within `tolerance` of `count` values a
/// sample; at most `capacity` (at least 2). Returns how many. Allocates.
int record_simplify(const double *values, int count, double tolerance, int *knots, int capacity);

/// Makes the edits, in the open step: base splines for the coordinates that moved, and channels that follow them. Says how many
/// knots that took, then forgets the motion.
void record_keep(struct stage *stage, struct core *core);

/// Whether a tail or chain is in the document and has the joint.
bool tail_drag_holds(const struct document *document, int rig, int joint);
/// Starts to pull a tail or chain; edits nothing until the pointer moves.
void tail_drag_begin(struct stage *stage, struct core *core, const struct hover *hover, const struct event *event);

/// The tail or chain that the active spline moves, else the first; -1 where there is none to be seen.
int overlay_rig(const struct stage *stage, const struct core *core);
/// Onion skin (O): the outline of the tail or the soft character, or the line of the chain, at the active spline's knots, those
/// nearest to the playhead.
void onion_show(struct stage *stage, struct core *core);

/// Ghost (F4): the same at the knot that is dragged, or was just nudged, where that is not the
/// pose that is shown.
void ghost_show(struct stage *stage, struct core *core);

/// The point of a rig where none is under the pointer: the tip of the tail or chain that the active spline moves, else the liveliest
/// vertex of the selected character. It may not exist (point_exists()).
struct rig_point overlay_point(struct stage *stage, const struct core *core);
/// Motion arc (Shift+O): where that point goes within two seconds of the playhead, with a mark at each frame.
void trail_show(struct stage *stage, struct core *core);
/// The same of any point of a rig.
void path_show(struct stage *stage, struct core *core, enum trail which, struct rig_point point);

/// How much of the upper edge of a stage the scene's description takes, pixels; 0 without one.
float caption_height(struct rect place, const struct document *document);
/// The names of tails at their feet, in the colour of the spline that moves them, where there are several.
void names_show(const struct stage *stage, struct core *core);

/// Where the legend is, when it is shown.
struct rect characters_legend(const struct core *core);
/// Legend of the phase map, and the labels of a pair.
void characters_show(const struct stage *stage, struct core *core);

/// How far along the segment a … b the point nearest to p is, 0 … 1.
static inline float segment_nearest(const float a[2], const float b[2], const float p[2])
{
    const float dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
    const float along = (p[0] - a[0]) * dx + (p[1] - a[1]) * dy;
    return square > 0 ? fmaxf(0, fminf(1, along / square)) : 0;
}

/// Frees its memory.
void skin_free(struct skin *skin);
/// Memory for the surface of any character that is shown; allocates only where a larger one has come onto the stage.
void skin_reserve(struct stage *stage);
/// Poses the surface of a character (by its number in the document, not its stiff twin), unless that is done
/// already. false where it is not shown.
bool skin_pose(struct stage *stage, int character);
/// The surface point (of the posed figure) under a point of the stage; false where there is none.
bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot);

#endif
