/// Changes: what checked edits become. A change holds the other state of what it touches; swapping that with the document's both does
/// and undoes it, and cannot fail.
#ifndef SCENE_CHANGE_H
#define SCENE_CHANGE_H

#include "scene/document.h"
#include "scene/edit.h"
#include <stddef.h>

enum change_kind {
    CHANGE_KNOT_IN,    ///< the knot is in the document: swapping takes it out and makes this a CHANGE_KNOT_OUT
    CHANGE_KNOT_OUT,   ///< and the other way round
    CHANGE_KNOT,       ///< a knot's numbers
    CHANGE_SETTINGS,   ///< a spline's mode, start and parameters
    CHANGE_NAME,       ///< a spline's name
    CHANGE_COLOR,      ///< a spline's colour
    CHANGE_SPLINE_IN,  ///< the spline is in the document, at `spline`; references are renumbered as it comes and goes
    CHANGE_SPLINE_OUT, ///< and the other way round
    CHANGE_SPLINE_MOVE, ///< moves the spline at `spline` in the list
    CHANGE_DOCUMENT,    ///< the whole document
    CHANGE_TIMING,      ///< the scene's fps, substeps and frames, and with them the frames of all knots
    CHANGE_CHANNEL,     ///< a channel's spline, axis and part
    CHANGE_PLACE,       ///< a tail's length and position
    CHANGE_RIG,         ///< all of a rig
    CHANGE_RIG_IN,      ///< the rig is in the document, at `rig.at`
    CHANGE_RIG_OUT,     ///< and the other way round
    CHANGE_FORM,        ///< the form of angles, and how many there are
    CHANGE_ANGLE,       ///< one of their numbers: an angle, or a place of a ramp
    CHANGE_DRIVES,      ///< the drives of a character
    CHANGE_FLOOR,       ///< the floor of a character
    CHANGE_SHEET,       ///< all of the paint on a character
    CHANGE_PAINT,       ///< a stroke on it
    CHANGE_PIN_IN,      ///< the pin is in the document: swapping takes it out and makes this a CHANGE_PIN_OUT
    CHANGE_PIN_OUT,     ///< and the other way round
    CHANGE_PIN,         ///< a pin's numbers
};

/// What EDIT_PARAMETER changes.
struct settings {
    struct param parameter[PARAMETER_COUNT];
};

/// Angles of a rig.
struct angles_place {
    int rig, channel; ///< `channel` is unused for ANGLE_REST
    enum angle_kind kind;
};

/// What EDIT_FPS, EDIT_SUBSTEPS and EDIT_RANGE change.
struct timing {
    double fps;
    int substeps, first, last;
    double *frames; ///< of all knots, spline by spline, and of all pins, rig by rig; owned. NULL: they stay
};

struct change {
    enum change_kind kind;
    int spline; ///< -1 if the change affects no spline's solution
    union {
        struct knot knot;
        struct settings settings;
        char *name;                ///< owned
        int color;                 ///< 0xRRGGBB, or -1
        struct spline *held;       ///< owned; its contents only while the spline is out of the document
        int to;                    ///< index in the list
        struct document *document; ///< owned
        struct timing timing;
        struct {
            int at;           ///< index in the list
            struct rig *held; ///< owned; its contents only while the rig is out of the document
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
            enum angle_form form;
            int count;
        } form;
        struct {
            struct angles_place at;
            int index; ///< of value[]: a ramp is places and angles in turn
            double value;
        } angle;
        struct {
            int rig, count;
            struct drive drives[CHARACTER_MAX_DRIVES];
        } drives;
        struct {
            int rig;
            bool is_on;
            double height;
        } floor;
        struct {
            int rig;
            struct paint *paint; ///< owned; may be NULL
        } sheet;
        struct {
            int rig;
            struct touched *touched; ///< owned
        } stroke;
        struct {
            int rig;
            struct pin pin;
        } pin;
    };
};

struct change_list {
    struct change *items;
    size_t count, capacity;
};

/// Makes room for `count` more. Capacities are powers of two. false if memory runs out.
bool change_list_reserve(struct change_list *list, size_t count);

/// Bytes that a change to this document takes, with what it owns.
size_t change_bytes(const struct change *change, const struct document *document);

/// The angles at a place, which must exist.
struct angles *change_angles(struct document *document, struct angles_place at);

struct settings settings_of(const struct spline *spline);

struct timing timing_of(const struct document *document);

/// Swaps the change's state with the document's. There must be room for a knot in its spline and for a spline in the document.
void change_swap(struct change *change, struct document *document);

/// Rewrites the paths in what it holds for another folder; false if memory runs out.
bool change_rebase(struct change *change, const char *from, const char *to);

/// Frees memory that a change needed only while its step was open. Returns how much.
size_t change_settle(struct change *change);

/// Frees what a change owns.
void change_release(struct change *change);

/// Whether the change may affect every spline's solution, or how many there are or their order.
bool change_concerns_all(const struct change *change);

/// Checks an edit and adds the changes that make it up, not yet swapped; none if nothing would change. false with a sentence if the
/// edit is not possible.
bool edit_plan(struct document *document, const struct edit *edit, struct change_list *list, struct error *error);

#endif
