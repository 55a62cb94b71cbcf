/// State of the inspector, and what the files of its sections share. Private to this folder and tests.
#ifndef EDITOR_INSPECTOR_STATE_H
#define EDITOR_INSPECTOR_STATE_H

#include "editor/core/state.h"
#include "editor/inspector/poles.h"
#include "ui/theme.h"
#include "ui/widgets.h"

enum { INSPECTOR_MAX_SECTIONS = 16 };

/// The inspector's view state. Zero except `core` is a valid start.
struct inspector {
    struct core *core;
    struct ui ui;
    enum ui_change change;                ///< the change a number is being set by
    struct ui_list sections, lines;       ///< of the panel; of the splines' list
    unsigned listed;                      ///< id of the spline last scrolled into the list's view
    bool adds;                            ///< the pressed row of the list joins those that are selected
    bool flipped[INSPECTOR_MAX_SECTIONS]; ///< sections open that start closed, or the reverse
    bool called[INSPECTOR_MAX_SECTIONS];  ///< requested sections, shown without More until closed
    int rig, channel;                     ///< the shown tail or chain, and its channel
    int selected;                         ///< row in the list of rigs
    double angle_reach[3];                ///< by enum angle_kind: factor on the slider's usual ends
    double ramp_scale[3][2];              ///< by enum angle_kind: lowest and highest angle of the curve
    int joint[3];                         ///< by enum angle_kind: the selected joint
    struct angles drawn;                  ///< angles as the running drag has drawn them
    float drawn_x, drawn_y;               ///< last pointer position while drawing
    struct bone_selection seen_bone;      ///< last shown bone
    const char *revealed;                 ///< section to scroll to, or NULL
    double dragged;                       ///< the dragged value; of several knots, the last possible one
    char knot_title[32];                  ///< title of the knot section
    char feel_title[96];                  ///< of that on the feel
    bool alone;                           ///< Alt was held at the last press: Feel is of the active spline alone
    struct history_view {
        struct ui_list list; ///< in rows
        size_t count, done;  ///< of the history at the last layout
    } history;
    const struct dropdown *list; ///< open in this pass, or NULL
};

/// Draws the poles of the active spline in the unit circle, and its response beside the other filters'.
void inspector_poles(struct inspector *in);

/// Stands for "no limit".
#define INSPECTOR_NO_LIMIT 1e300

enum { INSPECTOR_MAX_SPLINES = 256 }; ///< in a list

/// The sections. Each builds the rows below its header; inspector.c has the table.
void inspector_feel(struct inspector *in);
void inspector_rigs(struct inspector *in);
void inspector_spline(struct inspector *in);
void inspector_advanced(struct inspector *in);
void inspector_limits(struct inspector *in);
void inspector_variation(struct inspector *in);
void inspector_tail(struct inspector *in);
void inspector_character(struct inspector *in);
/// The splines' list, left of the curves.
void inspector_splines(struct inspector *in);

/// core_limb(), or -1 if Alt was held at the press.
int inspector_limb(const struct inspector *in);
/// The title says what Feel acts on.
const char *inspector_feel_title(struct inspector *in);

/// A row for a parameter of the active spline, if its mode uses it.
void inspector_parameter(struct inspector *in, enum parameter parameter);

/// The shown channel if the active spline bends it; below, the rows for the shown character's coordinate that it drives.
const struct channel *inspector_felt_channel(const struct inspector *in);
bool inspector_felt_drive(struct inspector *in);

/// A row that is no number: a button, a choice, a switch, a line of text.
struct row {
    const char *name, *label, *hint;
    const char *undo;  ///< label of the undo step that using it opens; NULL: it makes no edit, or core opens the step
    enum ui_icon icon; ///< of an icon button
    bool lit;          ///< of a button: shown as on
    const struct ui_choice *choices; ///< of a choice
    int count;
};

/// How rows begin: with a name and the text that shows it, with a name and an icon, with choices.
#define NAMED(id, text) .name = (id), .label = (text)
#define ICON(id, shape) .name = (id), .icon = (shape)
#define CHOICES(of) .choices = (of), .count = sizeof(of) / sizeof *(of)

// They return true if the row was used: edit now. Its undo step, if it has one, is open then, and the end of the event closes it.

/// If a row, or a widget of another kind, was used.
bool inspector_opens(struct inspector *in, bool used, const char *undo);
bool inspector_button(struct inspector *in, struct rect r, const struct row *row);
bool inspector_icon(struct inspector *in, struct rect r, const struct row *row);
/// A labelled row of segments; true if `*chosen` changed.
bool inspector_choice(struct inspector *in, const struct row *row, int *chosen);
bool inspector_toggle(struct inspector *in, struct rect r, const struct row *row, bool *on);
/// The line that ui_line_begin() opened; true once it is typed.
bool inspector_line(struct inspector *in, struct rect r, const struct row *row);

#define INSPECTOR_ICON theme_row() ///< width of an icon button
/// Buttons of one width, or icon buttons from left to right; the pressed one, or -1.
int inspector_buttons(struct inspector *in, struct rect r, const struct row *rows, int count);

/// A list over the panel.
struct dropdown {
    const char *name, *label, *hint; ///< of the field that opens it; its label may be NULL
    const char *undo;                ///< as in struct row
    const char *pick; ///< of bones: the button beside the field, which picks one on the stage for `use`
    enum bone_use use;
    /// Lays out the list after the rest of the panel, and carries out the choice.
    void (*build)(struct inspector *in, const struct dropdown *list);
};
/// Call wherever something may have opened the list.
void inspector_offer(struct inspector *in, const struct dropdown *list);
/// The field that opens a list, with a text and unless `color` is 0 a swatch. `which` is passed on. The second shows a spline.
void inspector_dropdown(struct inspector *in, const struct dropdown *list, struct rect r, int which, const char *text,
                        uint32_t color);
void inspector_spline_field(struct inspector *in, const struct dropdown *list, struct rect r, int which, int spline);
/// The open list of a dropdown, with the item of a value chosen; the value to edit by now, or -1.
int inspector_list(struct inspector *in, const struct dropdown *list, const struct ui_item *items, int count,
                   int chosen);
/// The menu of A.
extern const struct dropdown inspector_add_list;

/// The field of a list of bones, and the button that picks one on the stage for `of`, a spline or a chain.
void inspector_bone_field(struct inspector *in, const struct dropdown *list, struct rect r, int which,
                          const char *text, int of);
/// The open list of a model's bones below `top` (−1: all), by name; the picked node, or −1.
int inspector_bone_list(struct inspector *in, const struct dropdown *list, int model, int top, const char *chosen);

/// core_step() for a change. A drag is one step, redone from the original at each movement; Esc reverts it. A run of nudges of `what` with
/// the same selection is one step too. true if you should edit now.
bool inspector_step(struct inspector *in, enum ui_change change, const char *label, const char *what);

/// Where a table's numbers are: in a rig, in another struct, or behind get().
struct number_home {
    const int *rig; ///< the index of the rig that holds them, or NULL; then set() may be NULL
    const void *of; ///< the struct that holds them, or NULL
    void *own;      ///< the same beside the document: each is written there at once
    /// Number `which`, or if `kept` the one before (take_keep()), which the bar marks and the row shows while K is held; NAN: none. May
    /// write a text to show in its place.
    double (*get)(const struct inspector *in, int which, bool kept, char text[64]);
    bool (*set)(struct inspector *in, int which, double number, struct error *error);
    bool settles; ///< set only when a drag ends, because setting may ask a question
};

/// A number: its widget, and what the inspector does with it.
struct number_row {
    struct ui_number ui;
    const char *undo; ///< as in struct row
    size_t at;        ///< offset in the struct, for number_at()
    bool is_whole;    ///< stored as an int
    double scale;     ///< shown this many times as large; 0: as it is
};

/// Where a row's double is, or its int.
#define NUMBER_AT(type, member) .at = offsetof(type, member)
#define WHOLE_AT(type, member) .at = offsetof(type, member), .is_whole = true
/// The ends of a bar, and of typed numbers: any, angles, places. A row leaves out zeros.
#define BAR(from, to) .minimum = (from), .maximum = (to)
#define TYPED(from, to) .lowest = (from), .highest = (to)
#define ANY_NUMBER TYPED(-INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT)
#define DEGREES .unit = "°", TYPED(-36000, 36000)
#define METRES .unit = "m", TYPED(-1e6, 1e6), .step = 0.01, .decimals = 3

/// Reads a row's number from its struct, and writes it.
double number_at(const struct number_row *row, const void *of);
void number_put(const struct number_row *row, void *of, double number);

/// Shows a number's row and edits the number.
enum ui_change inspector_number(struct inspector *in, const struct number_row *row, const struct number_home *home,
                                int which, struct rect r);
/// All rows of a table, each with its index as `which`.
void inspector_numbers(struct inspector *in, const struct number_row *rows, int count,
                       const struct number_home *home);

/// Lists the document's splines, except those in `left_out` (by index; may be NULL), at most INSPECTOR_MAX_SPLINES; returns how many.
int inspector_spline_items(const struct inspector *in, const bool *left_out, struct ui_item *items);
/// The open spline list; the picked spline, or -1.
int inspector_spline_list(struct inspector *in, const struct dropdown *list, int chosen);

/// A label in its own row or at the left of one; returns the rest of the row.
struct rect inspector_label(struct inspector *in, struct rect r, const char *label);
struct rect inspector_labelled(struct inspector *in, const char *label);

/// A row with nothing to set, so that rows below stay in place.
void inspector_idle(struct inspector *in, const char *label, const char *text);

/// The first of `most` visible rows of a list that follows the chosen one.
int inspector_first_row(int count, int chosen, int most);
/// Notes below a list that it has more rows.
void inspector_more(struct inspector *in, int count, int most, const char *what);

void inspector_find_rig(struct inspector *in);
/// The shown tail or chain, or NULL.
const struct rig *inspector_shown(const struct inspector *in);

/// Rows for the angles of the shown tail or channel.
void inspector_angles(struct inspector *in, enum angle_kind kind);
/// The height of the highest curve below such a row, among all channels.
float inspector_highest_curve(const struct inspector *in, enum angle_kind kind);

#endif
