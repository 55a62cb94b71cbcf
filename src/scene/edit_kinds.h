/// Edits as data.
#ifndef SCENE_EDIT_KINDS_H
#define SCENE_EDIT_KINDS_H

#include "scene/edit.h"
#include "scene/history.h"

enum edit_kind {
    EDIT_KNOT_INSERT, ///< spline, knot (id 0: a new one is given)
    EDIT_KNOT_REMOVE, ///< spline, knot.id
    EDIT_KNOT_SET,    ///< spline, knot (found by id; frame, value, slope, has_slope, stiffness are replaced)
    EDIT_PARAMETER, ///< spline, parameter, param (its motion is copied). A new mode clamps, so that the saved file loads
    EDIT_SPLINE_ADD,  ///< spline: its place in the list, text (NULL: a free name), and if `flag` its first knot. f 1,
                      ///< ζ 0.1, β 0.1
    EDIT_SPLINE_COPY, ///< spline: a copy goes after it, with a free name and new knot ids
    EDIT_SPLINE_REMOVE, ///< spline; refused if something follows it
    EDIT_SPLINE_MOVE,   ///< spline, to: its new place in the list
    EDIT_SPLINE_NAME,   ///< spline, text: not empty, and no other's name
    EDIT_SPLINE_COLOR,  ///< spline, color: 0xRRGGBB, or -1
    EDIT_FPS, ///< number; flag: knots and range keep their seconds instead of their frames. Slopes are per second anyway
    EDIT_SUBSTEPS,    ///< substeps
    EDIT_RANGE,       ///< first, last: the scene's frames; fit: what happens to knots that would fall outside
    EDIT_ANGLES,      ///< rig, channel (-1: rest), angle: which, angles
    EDIT_AXIS,        ///< rig, channel, axis
    EDIT_PART,        ///< rig, channel, of
    EDIT_FEED,        ///< rig, channel, spline: the spline that the channel bends by
    EDIT_POSITION,    ///< rig, coordinate, param: metres, or a spline to follow
    EDIT_LENGTH,      ///< rig, number: metres, above 0
    EDIT_JOINTS,      ///< rig, to: how many; the tail keeps its shape
    EDIT_TAIL_ADD,    ///< rig: a copy goes beside it; if it is no tail, a plain one bent by `spline` (-1: by nothing)
    EDIT_RIG_REMOVE,  ///< rig; refused while a chain or a spline needs it
    EDIT_RIG_NAME,    ///< rig, text: not empty, and no other rig's. What goes by the old name goes by the new one
    EDIT_CHANNEL_ADD, ///< rig, spline, axis, of: one more, the last
    EDIT_CHANNEL_REMOVE, ///< rig, channel
    EDIT_DRIVE,          ///< rig, channel: which drive, drive: replaces spline, amplitude and lag
    EDIT_DRIVE_ADD,      ///< rig, drive (its name is copied)
    EDIT_DRIVE_REMOVE,   ///< rig, channel: which drive
    EDIT_FLOOR,          ///< rig, flag: whether it has one, number: its height, metres
    EDIT_PAINT_NEW, ///< rig, coordinates, vertices (of its model): replaces its paint by one that changes nothing
    EDIT_PAINT,     ///< rig, dab. All dabs of a step on one coordinate make one change
    EDIT_MODEL_ADD, ///< contents: a model rig, which becomes the last. Its name, or else its file's, gets a number if it is taken
    EDIT_RIG_ADD,    ///< contents: a character or a meadow, likewise
    EDIT_CHAIN_ADD,  ///< contents: a chain, likewise; without a name it is called after its first joint
    EDIT_CLIP,       ///< rig, text: the model's clip, or NULL
    EDIT_PLACE,      ///< rig, contents: the model's position, scale and turn
    EDIT_CHAIN,      ///< rig, contents: the chain's from, to, turn and mirror
    EDIT_MEADOW,     ///< rig, contents: all numbers of the meadow
    EDIT_PIN_ADD,    ///< rig, pin (its id is given)
    EDIT_PIN_SET,    ///< rig, pin (found by id; frame, point and place are replaced)
    EDIT_PIN_REMOVE, ///< rig, pin.id
};

struct edit {
    enum edit_kind kind;
    int spline;
    struct knot knot;
    enum parameter parameter;
    struct param param;
    bool flag;
    const char *text; ///< read during the call only
    int to, color;
    int substeps, first, last;
    enum range_fit fit;
    int rig; ///< index of a rig of a kind that the edit is for
    int channel;
    enum angle_kind angle;
    enum axis axis;
    enum channel_part of;
    int coordinate; ///< 0 … 2: x, y, z
    double number;
    struct drive drive;
    int coordinates, vertices;
    const struct dab *dab;       ///< read during the call only
    const struct angles *angles; ///< read during the call only
    const struct rig *contents;  ///< read during the call only
    struct pin pin;
};

bool history_apply(struct history *history, struct document *document, const struct edit *edit, struct error *error);

#endif
