/// Edits: the only way to change a document that is loaded.
///
/// Each function changes the document and returns true, or leaves it unchanged and sets an error. Data shared with other documents is
/// cloned first. An edit without effect changes nothing. history.h keeps the documents before each edit.
#ifndef SCENE_EDIT_H
#define SCENE_EDIT_H

#include "scene/document.h"

// --- knots ---------------------------------------------------------------------------------------------------------------

/// Inserts a knot; id 0: a new one is given.
bool edit_knot_insert(struct document *document, int spline, const struct knot *knot, struct error *error);
bool edit_knot_remove(struct document *document, int spline, unsigned id, struct error *error);
/// Sets frame and contents of the knot with that id.
bool edit_knot_set(struct document *document, int spline, const struct knot *knot, struct error *error);

// --- splines -------------------------------------------------------------------------------------------------------------

/// Sets a parameter; a motion is copied. A new mode clamps, so that the saved file loads.
bool edit_parameter(struct document *document, int spline, enum parameter parameter, const struct param *param,
                    struct error *error);
/// Adds a spline at a place in the list (-1: the end), with f 1, ζ 0.1, β 0.1; it loops where others do. `name` NULL: a free one. `first` NULL: it has no knot.
bool edit_spline_add(struct document *document, int at, const char *name, const struct knot *first,
                     struct error *error);
/// Inserts a copy after the spline, with a free name and new knot ids.
bool edit_spline_copy(struct document *document, int spline, struct error *error);
/// Refused if another spline or a rig refers to it.
bool edit_spline_remove(struct document *document, int spline, struct error *error);
bool edit_spline_move(struct document *document, int spline, int to, struct error *error);
/// The name must not be empty or another spline's.
bool edit_spline_name(struct document *document, int spline, const char *name, struct error *error);
/// Whether the motion settles at all of its knots that are not still; these then hold values alone.
bool edit_spline_settles(struct document *document, int spline, bool settles, struct error *error);
/// 0xRRGGBB, or -1.
bool edit_spline_color(struct document *document, int spline, int color, struct error *error);
/// "": none.
bool edit_spline_folder(struct document *document, int spline, const char *folder, struct error *error);
bool edit_spline_lock(struct document *document, int spline, bool locked, struct error *error);

// --- the scene -----------------------------------------------------------------------------------------------------------

/// `keeps_seconds`: knots and range keep their seconds instead of their frames. Slopes are per second in any case.
bool edit_fps(struct document *document, double fps, bool keeps_seconds, struct error *error);
bool edit_substeps(struct document *document, int substeps, struct error *error);

/// What to do with knots outside the new range.
enum range_fit {
    RANGE_REFUSE,
    RANGE_MOVE, ///< to the nearest free samples inside, in their order
    RANGE_TRIM, ///< delete them
};
bool edit_range(struct document *document, int first, int last, enum range_fit fit, struct error *error);
/// Replaces the background by a copy; one without a file removes it.
bool edit_background(struct document *document, const struct background_file *wanted, struct error *error);

// --- rigs ----------------------------------------------------------------------------------------------------------------

/// Appends a copy of a rig. A taken name or title gets a number.
bool edit_rig_add(struct document *document, const struct rig *contents, struct error *error);
/// The name that edit_rig_add() gives a rig called `wanted`; the caller frees it.
char *edit_rig_free_name(const struct document *document, const char *wanted);
/// Refused while a chain or spline refers to it.
bool edit_rig_remove(struct document *document, int rig, struct error *error);
/// Replaces a rig by a changed copy of it with the same name, pins and paint.
bool edit_rig_set(struct document *document, int rig, const struct rig *wanted, struct error *error);
/// The name must not be empty or another rig's. References to the old name are changed, too.
bool edit_rig_name(struct document *document, int rig, const char *name, struct error *error);

/// Shows a model by another file. References to the old file are changed, too.
bool edit_model_file(struct document *document, int rig, const char *file, struct error *error);

enum angle_kind { ANGLE_REST, ANGLE_LAG, ANGLE_GAIN };

/// A channel of a rig: of a tail or chain; ANGLE_REST is none.
struct channel_place {
    int rig, channel;
};
bool edit_angles(struct document *document, struct channel_place at, enum angle_kind kind,
                 const struct angles *angles, struct error *error);
/// Replaces a channel; NULL removes it.
bool edit_channel(struct document *document, struct channel_place at, const struct channel *channel,
                  struct error *error);
/// Appends a channel.
bool edit_channel_add(struct document *document, int rig, int spline, enum axis axis, enum channel_part of,
                      struct error *error);

/// The tail keeps its shape.
bool edit_joints(struct document *document, int rig, int count, struct error *error);
/// A copy of the rig goes beside it; if it is no tail, a plain one bent to the side by `spline` (-1: by nothing).
bool edit_tail_add(struct document *document, int rig, int spline, struct error *error);

/// Replaces the drive of a character's coordinate, except its name; index -1 appends one. NULL removes it.
bool edit_drive(struct document *document, int rig, int index, const struct drive *drive, struct error *error);

/// Replaces a character's paint by plain paint, for its model's coordinates and vertices.
bool edit_paint_new(struct document *document, int rig, int coordinates, int vertices, struct error *error);
bool edit_paint(struct document *document, int rig, const struct dab *dab, struct error *error);

/// Sets frame, point and place of the pin with that id; id 0: a new one. And removes it.
bool edit_pin_set(struct document *document, int rig, const struct pin *pin, struct error *error);
bool edit_pin_remove(struct document *document, int rig, unsigned id, struct error *error);

#endif
