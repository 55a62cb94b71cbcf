/// Widgets (immediate mode): the panel's code runs once per event and once per frame, with the same layout. In between,
/// `struct ui` keeps only what has the focus, is held by the pointer, or is being typed in.
///
///     ui_begin_event(&ui, area, event);              ui_begin_draw(&ui, area, list);
///     build(&ui, …);                                 build(&ui, …);
///     used = ui_end(&ui);                            ui_end(&ui);
///
/// A widget's id is the hash of its name and of the scopes around it, so that a name must be unique only in its scope. ui_begin_find()
/// looks for the name alone and takes the first in sight. Takes input, emits draw commands; no GL, no allocation. Tab and Shift+Tab move the focus; the pointer takes it away.
#ifndef UI_WIDGETS_H
#define UI_WIDGETS_H

#include "base/file.h"
#include "ui/drawlist.h"
#include "ui/event.h"
#include "ui/theme.h"

enum {
    UI_PAD = 12,        ///< from the panel's edge to its content
    UI_LABEL = 84,      ///< width of the label column
    UI_GAP = 8,         ///< between things in a row
    UI_MAX_FOCUS = 224, ///< widgets per panel that Tab reaches
    UI_MAX_SCOPES = 4,  ///< one inside the other, with the panel's own
    UI_TEXT_SIZE = PATH_LIMIT,
    UI_NAME_SIZE = 1024, ///< bytes of the name of a widget for a spline or a bone
};

#define UI_ROW theme_row()

/// What the pointer is over, for the cursor.
enum ui_over { UI_OVER_NOTHING, UI_OVER_NUMBER, UI_OVER_TEXT };

enum ui_pass { UI_PASS_EVENT, UI_PASS_DRAW, UI_PASS_FIND };

/// A line of text being typed.
struct ui_text {
    char bytes[UI_TEXT_SIZE];
    int length, caret; ///< bytes
    bool all;          ///< all selected: the next character replaces it
};

// Typing filters lists, the help and the palette.

enum { FILTER_SIZE = 48 };

/// The typed text. Empty text matches everything.
struct ui_filter {
    char typed[FILTER_SIZE];
};

/// How well a text matches, better ones larger. Case is ignored; of several words, all must match.
enum fit {
    FIT_NOT,
    FIT_LETTERS, ///< has the letters in order, at least four
    FIT_INSIDE,  ///< contains the text
    FIT_WORD,    ///< one of its words starts with the text
    FIT_START    ///< starts with the text
};

enum fit ui_filter_fit(const struct ui_filter *filter, const char *text);
/// The least fit to show if `best` is the best in the list: scattered letters count only without better matches.
enum fit ui_filter_least(enum fit best);
/// Adds a character or handles Backspace; true if used. A filter does not start with a space.
bool ui_filter_event(struct ui_filter *filter, const struct event *event);

// The panel.

/// A list that scrolls: rows behind a view that may be lower than they are. Its heights are all in pixels, or in whole rows. Zero is the
/// top. The caller lays out, paints and presses the rows; ui_list_begin() is for rows that are widgets.
struct ui_list {
    float offset;  ///< height scrolled out of sight
    float view;    ///< height in sight at the last layout
    float content; ///< height of all rows
};

/// Sets the heights, and scrolls no further than to the end.
void ui_list_fit(struct ui_list *list, float view, float content);
/// Scrolls down by a height, within the rows; true if that moved them.
bool ui_list_scroll(struct ui_list *list, float by);
/// Scrolls just enough to show a row, from its top on if it is higher than the view.
void ui_list_show(struct ui_list *list, float top, float height);
/// The bar in `track`, shorter by `gap` at both ends, if there is more than is in sight.
void ui_list_bar(const struct ui_list *list, struct drawlist *drawn, struct rect track, float gap);

/// A widget that Tab reaches.
struct ui_stop {
    uint32_t id;
    struct rect rect;
    struct ui_list *list; ///< that it scrolls in, or NULL
    float top;            ///< in the list
};

/// The open popup. Only it gets events.
struct ui_popup {
    uint32_t id;        ///< hash of its name, outside any scope; 0: none
    int which;          ///< its subject, chosen by the caller
    struct rect anchor; ///< the rectangle that it opens at
    struct rect room;   ///< its limits; empty: the panel
    struct ui_list list;
    uint32_t focus;          ///< widget to focus first; 0: the first
    uint32_t opener;         ///< widget that gets the focus back; 0: opened by the pointer
    bool fresh;              ///< opened by this event
    bool built;              ///< in this pass
    struct ui_filter filter; ///< typed over a list
};

/// A panel's widgets. Zero is a valid start.
struct ui {
    uint32_t focus;  ///< widget with the keyboard; 0: none
    uint32_t held;   ///< widget that holds the pointer
    uint32_t typing; ///< widget whose value is typed into `text`
    struct ui_popup popup;
    bool began;   ///< ui_line_begin() was called in this pass
    bool blocked; ///< widgets now being built lie under the popup
    struct ui_text text;
    bool typed;      ///< `text` changed since typing began
    bool refused;    ///< `text` was rejected and not changed since
    bool by_pointer; ///< a double-click began the typing, so it leaves no focus
    bool moved;      ///< the held widget was dragged
    bool fine;
    float press_x, press_y;
    float handle_x, handle_y; ///< of the held handle at the press
    float anchor_x;           ///< where the drag's mapping starts: at the press, or where Shift changed
    double anchor_value;
    double before; ///< the dragged number at the press
    float pointer_x, pointer_y;
    const char *hint;       ///< hint of the widget under the pointer, a static text, or NULL
    const char *focus_hint; ///< hint of the focused widget
    struct rect focus_rect; ///< its rectangle
    const char *offered;    ///< the last hint of this pass and its area
    struct rect offered_rect;
    enum ui_over over;   ///< at the last frame
    char complaint[160]; ///< why typed text was rejected; the caller shows and clears it

    enum ui_pass pass;
    const struct event *event;
    struct drawlist *list;
    uint32_t find;
    double find_value; ///< NAN: the present one
    uint32_t found;    ///< the widget's id; 0: none
    float found_x, found_y;
    bool used;
    struct rect area, clip, list_clip;
    float y;                  ///< of the next row
    struct ui_list *scrolled; ///< open, or NULL
    struct rect scroll_area, scroll_clip;
    struct ui_stop stop[UI_MAX_FOCUS];
    int stop_count;
    struct ui_stop
        twice; ///< a widget with the id of another one, since the start; the tests assert that there is none
    uint32_t scope[UI_MAX_SCOPES];
    int depth; ///< of the open scopes
};

void ui_begin_event(struct ui *ui, struct rect area, const struct event *event);
void ui_begin_draw(struct ui *ui, struct rect area, struct drawlist *list);
/// Finds the widget `name`, or the place on its bar for `*value` (NULL: its handle): found, found_x, found_y.
void ui_begin_find(struct ui *ui, struct rect area, const char *name, const double *value);
/// Ends the pass: moves the focus for Tab, forgets removed widgets. true if the event was used or the widget found.
bool ui_end(struct ui *ui);
/// Whether Tab (1) or Shift+Tab (-1) leads to a widget without starting over.
bool ui_has_next(const struct ui *ui, int direction);

/// Drops focus, hold and typing without a change.
void ui_release(struct ui *ui);

/// Opens a scope for the ids of the widgets that follow: a section or a row of a list, by a number that no sibling has. Popups and typed
/// lines, which other places open, have their ids outside scopes.
void ui_push(struct ui *ui, uint32_t number);
void ui_pop(struct ui *ui);

/// The next row, inset by UI_PAD.
struct rect ui_row(struct ui *ui, float height);
void ui_space(struct ui *ui, float height);

/// Widgets between these two scroll inside `view`: by the wheel, by a drag beside them, and to show the focus.
void ui_list_begin(struct ui *ui, struct ui_list *list, struct rect view);
void ui_list_end(struct ui *ui);

/// Baseline that centres capitals in `r`.
float ui_baseline(struct rect r, enum font font, float size);
/// The size of a font's text in a line, where numbers are small; and such a line, cut with "…".
float ui_text_size(enum font font);
void ui_paint_text(struct drawlist *list, struct rect r, enum font font, uint32_t color, const char *text);
/// One centred line, cut with "…".
void ui_label(struct ui *ui, struct rect r, const char *text, uint32_t color);
void ui_label_right(struct ui *ui, struct rect r, const char *text, uint32_t color);
/// Small text on up to 4 rows, broken at spaces.
void ui_paragraph(struct ui *ui, const char *text, uint32_t color);
/// A section's header; a click opens or closes it. Returns whether it is open.
bool ui_section(struct ui *ui, const char *name, const char *title, bool *closed);
/// true if pressed, also by Enter or Space.
bool ui_button(struct ui *ui, struct rect r, const char *name, const char *label, bool primary);
bool ui_toggle(struct ui *ui, struct rect r, const char *name, bool *on);
/// A list row: a swatch of `color` and a text.
bool ui_list_row(struct ui *ui, struct rect r, const char *name, const char *text, uint32_t color, bool selected);

struct ui_choice {
    const char *name, *label; ///< found as "<control>.<name>"
};

/// `count` segments; true if `*index` (-1: none) changed.
bool ui_segments(struct ui *ui, struct rect r, const char *name, const struct ui_choice *choices, int count,
                 int *index);

/// A number: a bar from `minimum` to `maximum`, or if those are equal a field that a drag changes by `step` per pixel.
struct ui_number {
    const char *name;
    const char *label; ///< in the label column; NULL, or in a narrow rectangle: the field fills it
    const char *unit;  ///< after the number, or NULL
    const char *hint;
    const char *shown;       ///< replaces the number, or NULL
    double minimum, maximum; ///< of the bar
    const double *was;       ///< an earlier value to mark on the bar, or NULL
    double lowest, highest;  ///< of typed numbers
    double fallback;         ///< for right-click and Delete; NAN: none
    double step;             ///< of arrow keys and drags
    int decimals;
};

/// How a number changed. All UI_DRAGs of a drag are one undo step.
enum ui_change {
    UI_NONE,
    UI_DRAG,   ///< dragged; more may follow
    UI_DROP,   ///< the drag ended; the value is the last UI_DRAG's
    UI_CANCEL, ///< Esc cancelled the drag; the value is as it was before
    UI_SET,    ///< typed, or the default
    UI_NUDGE,  ///< arrow key; a run of them is one undo step
};

/// Drag (Shift: a tenth as fast), double-click or Enter to type, right-click or Delete for the default, arrow keys when focused. Sets
/// `*value` unless the change is UI_NONE or UI_DROP.
enum ui_change ui_value(struct ui *ui, struct rect r, const struct ui_number *number, double *value);

/// A point to drag, or to move by arrow keys.
struct ui_handle {
    const char *name, *hint;
    float x, y;         ///< position; for UI_DRAG the new one, which may be outside the area
    int step_x, step_y; ///< UI_NUDGE: steps right and up (Shift: 10)
};

/// Several handles in an area. A press takes the nearest; `*which` is the one that changed. The caller paints them.
enum ui_change ui_handles(struct ui *ui, struct rect area, struct ui_handle *handles, int count, int *which);

enum ui_icon {
    UI_ICON_ADD,
    UI_ICON_COPY,
    UI_ICON_DELETE,
    UI_ICON_RIGHT,
    UI_ICON_DOWN,
    UI_ICON_EYE,
    UI_ICON_EYE_CLOSED,
    UI_ICON_LOCK,
    UI_ICON_UNLOCKED,
    UI_ICON_FOLLOW,   ///< a link
    UI_ICON_UNFOLLOW, ///< the same, broken
    UI_ICON_PICK,     ///< a target
    UI_ICON_RAMP,     ///< a curve through points
    UI_ICON_EACH,     ///< a bar for each of several
};
/// `lit`: shown as on. true if pressed.
bool ui_icon_button(struct ui *ui, struct rect r, const char *name, enum ui_icon icon, bool lit, const char *hint);

/// A field that opens the popup `name` about `which`, with a swatch before the text unless `color` is 0.
void ui_dropdown(struct ui *ui, struct rect r, const char *name, int which, const char *text, uint32_t color);
/// A swatch that opens a popup.
void ui_swatch(struct ui *ui, struct rect r, const char *name, const char *popup, int which, uint32_t color);
/// A larger swatch to choose; true if pressed.
bool ui_color(struct ui *ui, struct rect r, const char *name, uint32_t color, bool chosen);

struct ui_item {
    const char *name, *label; ///< found as "item.<name>"
    uint32_t color;           ///< of its swatch; 0: none
    int value;                ///< what it stands for; the caller's
};
/// A drop-down's popup list with one row chosen (-1: none); typing filters it. Build it as with ui_popup_begin(). Returns the picked row,
/// which closes it, or -1.
int ui_popup_list(struct ui *ui, const char *name, const struct ui_item *items, int count, int chosen);

/// Opens a popup below `anchor`, or above if there is no room.
void ui_popup_open(struct ui *ui, const char *name, int which, struct rect anchor);
void ui_popup_close(struct ui *ui);
/// Whether the popup is open. If so, build its content between begin and end, after the rest of the panel. Arrows and Tab move between
/// widgets; Esc and a press outside close it.
bool ui_popup_is_open(const struct ui *ui, const char *name);
void ui_popup_begin(struct ui *ui, float width, float height);
void ui_popup_end(struct ui *ui);

/// A row that a drag reorders; when dropped, `ui->pointer_y` says where. Only `label` can be dragged; the rest belongs to the caller. A press that
/// ends without a drag is a click.
enum ui_row_event { UI_ROW_NONE, UI_ROW_PRESSED, UI_ROW_CLICKED, UI_ROW_TWICE, UI_ROW_DROPPED };
enum ui_row_event ui_sort_row(struct ui *ui, struct rect row, struct rect label, const char *name, const char *text,
                              bool selected);
bool ui_is_dragged(const struct ui *ui, const char *name);

/// Text edited in place, from ui_line_begin() to Enter, Tab or a press elsewhere (UI_LINE_DONE, the result is `ui->text`) or Esc
/// (UI_LINE_CANCEL).
enum ui_line { UI_LINE_NONE, UI_LINE_DONE, UI_LINE_CANCEL };
void ui_line_begin(struct ui *ui, const char *name, const char *text);
/// Goes on with what was typed and refused, unless a press elsewhere or Tab ended it.
void ui_line_again(struct ui *ui, const char *name);
bool ui_line_is_open(const struct ui *ui, const char *name);
enum ui_line ui_line(struct ui *ui, struct rect r, const char *name);

/// A text field. While `typing`, its content is ui->text. true if it changed.
bool ui_text_field(struct ui *ui, struct rect r, const char *name);

void ui_text_set(struct ui_text *text, const char *utf8);
/// Handles a key or character; false if not used. `changed` may be NULL.
bool ui_text_event(struct ui_text *text, const struct event *event, bool *changed);

/// A hint for the widgets in `r`, shown on hover or focus.
void ui_hint(struct ui *ui, struct rect r, const char *text);
float ui_text_width(const char *text);

/// For widgets defined elsewhere: the id of a name in the open scope, whether the pointer is over `r` and not clipped, registration.
uint32_t ui_id(const struct ui *ui, const char *name);
bool ui_hovered(const struct ui *ui, struct rect r);
void ui_register(struct ui *ui, uint32_t id, struct rect r);

// A sentence beside the control under the pointer or with the focus.

/// Zero: none.
struct tooltip {
    const char *text; ///< NULL: none
    struct rect at;   ///< must stay visible
    float x, y;       ///< of the pointer
    double rest;      ///< seconds without movement
    bool spent;       ///< a press dismissed it, until the text changes
};

/// Offers a tooltip for the control at `at` with the pointer at x, y. Movement restarts the wait.
void tooltip_offer(struct tooltip *tooltip, const char *text, float x, float y, struct rect at);
/// Call on a press, a key or the wheel.
void tooltip_dismiss(struct tooltip *tooltip);
void tooltip_advance(struct tooltip *tooltip, double dt);
bool tooltip_is_shown(const struct tooltip *tooltip);
/// Whether it will appear soon, so that frames must go on.
bool tooltip_waits(const struct tooltip *tooltip);
/// Below or above the control, inside the window.
struct rect tooltip_box(const struct tooltip *tooltip, struct rect window);
void tooltip_show(const struct tooltip *tooltip, struct rect window, struct drawlist *list);

#endif
