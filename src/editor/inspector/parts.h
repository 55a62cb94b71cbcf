/// Functions that the inspector's sections share. Private to the room.
#ifndef EDITOR_INSPECTOR_PARTS_H
#define EDITOR_INSPECTOR_PARTS_H

#include "editor/inspector/state.h"
#include "ui/theme.h"

/// A number's limits where there are none.
#define INSPECTOR_NO_LIMIT 1e300

enum { INSPECTOR_MAX_SPLINES = 256 }; ///< in a list to choose from, from the top

/// The sections; inspector.c has the table. Each builds the rows below its header.
void inspector_scene(struct inspector *in);
void inspector_splines(struct inspector *in);
void inspector_feel(struct inspector *in);
void inspector_rigs(struct inspector *in);
void inspector_spline(struct inspector *in);
void inspector_advanced(struct inspector *in);
void inspector_limits(struct inspector *in);
void inspector_variation(struct inspector *in);
void inspector_poles(struct inspector *in);
void inspector_knot(struct inspector *in);
void inspector_tail(struct inspector *in);
void inspector_character(struct inspector *in);
void inspector_pins(struct inspector *in);
void inspector_meadow(struct inspector *in);
void inspector_model(struct inspector *in);
void inspector_history(struct inspector *in);
/// Title of the section on knots: how many are selected.
const char *inspector_knot_title(struct inspector *in);

/// A row for a parameter of the active spline, where its mode uses it.
void inspector_parameter(struct inspector *in, enum parameter parameter);

/// The channel that is shown, where it bends by the active spline; and rows for the coordinate of the shown character that it drives.
const struct channel *inspector_felt_channel(const struct inspector *in);
bool inspector_felt_drive(struct inspector *in);

/// A list that opens over the panel.
struct dropdown {
    const char *name, *hint; ///< and a hint for the field that opens it
    /// Lays it out after all else in the panel, and carries out the choice.
    void (*build)(struct inspector *in, const struct dropdown *list);
};
/// Has it built where it is open: to be called where something may have opened it.
void inspector_offer(struct inspector *in, const struct dropdown *list);
/// A field with a text, and a swatch unless `color` is 0, that opens it, about `which`. And the same with a spline.
void inspector_dropdown(struct inspector *in, const struct dropdown *list, struct rect r, int which, const char *text,
                        uint32_t color);
void inspector_spline_field(struct inspector *in, const struct dropdown *list, struct rect r, int which, int spline);
/// The menu of A.
extern const struct dropdown inspector_add_list;

/// An open list of the bones of a model rig below one (−1: all), by name; the node that was picked, or −1.
int inspector_bone_list(struct inspector *in, const struct dropdown *list, int model, int top, const char *chosen);

/// Whether that is the end of a change, and no step of a drag: the curves may follow.
bool inspector_changed(enum ui_change change);
/// What a number's change means for the history: a drag is one step, made anew at each movement; a run of nudges of `what`
/// (the number's name, with the same selection) is one; Esc takes the drag back. true where edits are due, on the document as it was
/// before the drag; inspector_end() comes after them.
bool inspector_begin(struct inspector *in, enum ui_change change, const char *label, const char *what);
/// After the edits. Not `done`: they are taken back.
void inspector_end(struct inspector *in, enum ui_change change, bool done);

/// Where the numbers of a table are: the struct that holds number `which` (or, without one, what it is), and the edit that makes it
/// another.
struct number_home {
    int (*rig)(const struct inspector *in); ///< whose struct rig has them, or NULL; then set() may be NULL
    const void *(*of)(const struct inspector *in);
    double (*get)(const struct inspector *in, int which);
    bool (*set)(struct inspector *in, int which, double number, struct error *error);
    bool settles; ///< they are set once a drag has ended, by a step of their own or none, because that may ask before
    /// Text in place of a number; returns `text`, or NULL for the number. Itself NULL: none.
    const char *(*shown)(const struct inspector *in, int which, char text[64]);
};

/// A row of a table: a number.
struct number_row {
    const char *name, *label, *unit, *hint; ///< as struct ui_number
    const char *undo;                       ///< name of its undo step; NULL: set() makes no edit
    size_t at;                              ///< of the number in its struct, for number_at()
    bool is_whole;                          ///< it is an int there
    double minimum, maximum;                ///< ends of the bar
    double lowest, highest;                 ///< limits of typed numbers
    double fallback, step;
    int decimals;
};

/// The place of a number in a struct, and of a whole one.
#define NUMBER_AT(type, member) offsetof(type, member), false
#define WHOLE_AT(type, member) offsetof(type, member), true

/// The number of a row, read from its struct; and written.
double number_at(const struct number_row *row, const void *of);
void number_put(const struct number_row *row, void *of, double number);

/// A row on the panel, and its edit where it changes.
enum ui_change inspector_number(struct inspector *in, const struct number_row *row, const struct number_home *home,
                                int which, struct rect r);
/// All rows of a table, each with its place in it as `which`.
void inspector_numbers(struct inspector *in, const struct number_row *rows, int count,
                       const struct number_home *home);

/// Rows for the splines of the document, without those that are left out (by index; NULL: none), in room for INSPECTOR_MAX_SPLINES;
/// returns how many. `row`: that of the chosen spline, or -1.
int inspector_spline_items(const struct inspector *in, const bool *left_out, int chosen, struct ui_item *items,
                           int *splines, int *row);
/// The open list of them; the one that was picked, or -1.
int inspector_spline_list(struct inspector *in, const struct dropdown *list, int chosen);

/// A label, in a row of its own or at the left of one; returns the rest of the row.
struct rect inspector_label(struct inspector *in, struct rect r, const char *label);
struct rect inspector_labelled(struct inspector *in, const char *label);

/// A row without anything to set now, so that those below it stay where they are.
void inspector_idle(struct inspector *in, const char *label, const char *text);

/// A row of segments with a label; true if `*chosen` changed.
bool inspector_choice(struct inspector *in, const char *label, const char *hint, const char *name,
                      const struct ui_choice *choices, int count, int *chosen);

/// A small button of a row of them.
struct icon_button {
    const char *name, *hint;
    enum ui_icon icon;
};
enum { INSPECTOR_ICON = 24 };
/// Icon buttons from the left of a rectangle on; the one that was pressed, or -1.
int inspector_icons(struct inspector *in, struct rect r, const struct icon_button *buttons, int count);

/// The first of `most` rows to show of a list, the chosen one among them.
int inspector_first_row(int count, int chosen, int most);
/// Below the rows: says that there are more.
void inspector_more(struct inspector *in, int count, int most, const char *what);

/// Switches of the stage's overlays: onion skin, motion arc, ghost.
void inspector_overlays(struct inspector *in);

/// Finds the shown rigs in the document.
void inspector_find_rig(struct inspector *in);
/// The tail or chain that is shown; NULL where there is none.
const struct rig *inspector_shown(const struct inspector *in);

/// Rows for the angles of the tail or channel that the inspector shows.
void inspector_angles(struct inspector *in, enum angle_kind kind);
/// An edit: replaces them.
bool inspector_set_angles(struct inspector *in, enum angle_kind kind, const struct angles *angles);

#endif
