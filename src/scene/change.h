/// Changes: what edits become once they were checked. A change holds the other state of what it touches, and swapping
/// it with the document's is both doing and undoing; nothing can fail there.
#ifndef SCENE_CHANGE_H
#define SCENE_CHANGE_H

#include "scene/document.h"
#include "scene/edit.h"
#include <stddef.h>

enum change_kind {
    CHANGE_KNOT_IN,  ///< the knot is in the document: swapping takes it out, and makes this a CHANGE_KNOT_OUT
    CHANGE_KNOT_OUT, ///< and the other way round
    CHANGE_KNOT,     ///< a knot's numbers
    CHANGE_SETTINGS, ///< a spline's mode, start and parameters
    CHANGE_NAME,     ///< a spline's name
    CHANGE_COLOR,    ///< a spline's colour
    CHANGE_SPLINE_IN, ///< the spline is in the document, at `spline`; tracks and channels go by where it comes and goes
    CHANGE_SPLINE_OUT,  ///< and the other way round
    CHANGE_SPLINE_MOVE, ///< the spline at `spline` goes to another place in the list
    CHANGE_DOCUMENT,    ///< the whole document
    CHANGE_TIMING,      ///< the scene's fps, substeps and frames, with them the frames of all knots
    CHANGE_CHANNEL,     ///< a channel's spline, axis and part
    CHANGE_PLACE,       ///< a tail's length and position
    CHANGE_RIG,         ///< all of a rig
    CHANGE_RIG_IN,      ///< the rig is in the document, at `rig.at`
    CHANGE_RIG_OUT,     ///< and the other way round
    CHANGE_EACH,        ///< whether angles are one for all joints or one for each
    CHANGE_ANGLE,       ///< one of them
    CHANGE_DRIVES,      ///< what moves a character's coordinates
    CHANGE_SHEET,       ///< all of the paint on a character
    CHANGE_PAINT,       ///< a stroke on it
};

/// What EDIT_PARAMETER and EDIT_SPRING change.
struct settings {
    bool spring_friction;
    struct param parameter[PARAMETER_COUNT];
};

/// Angles of a tail.
struct angles_place {
    int rig, channel; ///< the channel is not read for ANGLE_REST
    enum angle_kind kind;
};

/// What EDIT_FPS, EDIT_SUBSTEPS and EDIT_RANGE change.
struct timing {
    double fps;
    int substeps, first, last;
    double *frames; ///< of all knots, in the order of splines and knots; owned. NULL: they stay
};

struct change {
    enum change_kind kind;
    int spline; ///< -1 where no spline's solution is concerned
    union {
        struct knot knot;
        struct settings settings;
        char *name;                ///< owned
        int color;                 ///< 0xRRGGBB, or -1
        struct spline *held;       ///< owned; what it holds only while the spline is out of the document
        int to;                    ///< index in the list
        struct document *document; ///< owned
        struct timing timing;
        struct {
            int at;           ///< index in the list
            struct rig *held; ///< owned; what it holds only while the rig is out of the document
        } rig;
        struct {
            int rig, channel;
            int spline;
            enum axis axis;
            enum channel_part of;
        } channel;
        struct {
            int rig;
            double length;
            struct param position[3];
        } place;
        struct {
            struct angles_place at;
            bool each;
        } each;
        struct {
            struct angles_place at;
            int joint;
            double value;
        } angle;
        struct {
            int rig, count;
            struct drive drives[CHARACTER_MAX_DRIVES];
        } drives;
        struct {
            int rig;
            struct paint *paint; ///< owned; may be NULL
        } sheet;
        struct {
            int rig;
            struct touched *touched; ///< owned
        } stroke;
    };
};

struct change_list {
    struct change *items;
    size_t count, capacity;
};

/// Room for `count` more. Capacities are powers of two. false where memory is short.
bool change_list_reserve(struct change_list *list, size_t count);

/// Memory that a change of this document takes, with what it holds.
size_t change_bytes(const struct change *change, const struct document *document);

/// The angles at a place that exists.
struct angles *angles_at(struct document *document, struct angles_place at);

struct settings settings_of(const struct spline *spline);

struct timing timing_of(const struct document *document);

/// Swaps the change's state with the document's. A knot's spline must have room for it, and so must the document for
/// a spline.
void change_swap(struct change *change, struct document *document);

/// The step is whole: gives back memory that a change needed only while it grew. Returns how much.
size_t change_settle(struct change *change);

/// Frees what a change holds, when it is forgotten.
void change_release(struct change *change);

/// Whether the change may alter every spline's solution, or the number or order of them.
bool change_concerns_all(const struct change *change);

/// Checks an edit and adds the changes that make it up, not yet swapped, none where nothing would change.
/// false with a sentence where the edit is not possible.
bool edit_plan(struct document *document, const struct edit *edit, struct change_list *list, struct error *error);

#endif
