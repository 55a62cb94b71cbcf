/// Widgets (immediate mode): the panel's code runs once per event and once per frame, with the same layout. In between,
/// `struct ui` keeps only what has the focus, is held by the pointer, or is being typed in.
///
///     ui_begin_event(&ui, area, event);              ui_begin_draw(&ui, area, list);
///     build(&ui, …);                                 build(&ui, …);
///     used = ui_end(&ui);                            ui_end(&ui);
///
/// Widgets have names; a name is unique in its panel and is also what ui_begin_find() looks for. Takes input, emits draw
/// commands; no GL, no allocation. Tab and Shift+Tab move the focus; the pointer takes it away.
#ifndef UI_WIDGETS_H
#define UI_WIDGETS_H

#include "base/file.h"
#include "ui/drawlist.h"
#include "ui/event.h"
#include "ui/filter.h"

enum {
    UI_ROW = 24,        ///< height of a row
    UI_PAD = 12,        ///< from the panel's edge to its content
    UI_LABEL = 84,      ///< width of the label column
    UI_GAP = 8,         ///< between things in a row
    UI_MAX_FOCUS = 160, ///< widgets of one panel that Tab can reach
    UI_TEXT_SIZE = PATH_LIMIT,
};

/// The kind of widget under the pointer, for the cursor.
enum ui_over { UI_OVER_NOTHING, UI_OVER_NUMBER, UI_OVER_TEXT };

enum ui_pass { UI_PASS_EVENT, UI_PASS_DRAW, UI_PASS_FIND };

/// A line of text being typed.
struct ui_text {
    char bytes[UI_TEXT_SIZE];
    int length, caret; ///< bytes
    bool all;          ///< all is selected: the next character replaces it
};

/// A scroll area's position.
struct ui_scroll {
    float offset, content; ///< pixels scrolled, and height of the content as last laid out
};

/// A widget that Tab reaches, as laid out in this pass.
struct ui_stop {
    uint32_t id;
    struct rect rect;
};

/// The open popup, which alone gets events.
struct ui_popup {
    uint32_t id;        ///< of its name; 0: none
    int which;          ///< the caller's own: its subject
    struct rect anchor; ///< the rectangle that it opens at
    struct rect room;   ///< where it may be; nothing: in the panel
    struct ui_scroll scroll;
    uint32_t focus;          ///< the widget with the first focus; 0: its first one
    uint32_t opener;         ///< the widget that gets the focus back; 0 where the pointer opened it
    bool fresh;              ///< opened in the running event
    bool built;              ///< in the running pass
    struct ui_filter filter; ///< typed over a list: rows that do not fit it are left out
};

/// One panel's widgets; zero is a valid start.
struct ui {
    uint32_t focus;  ///< has the keyboard, drawn with a ring; 0: none
    uint32_t held;   ///< has the pointer while the button is down
    uint32_t typing; ///< its value is being typed into `text`
    struct ui_popup popup;
    bool began;   ///< ui_line_begin() was called in the running pass
    bool blocked; ///< widgets built now lie under the popup
    struct ui_text text;
    bool typed;      ///< `text` was changed since typing began
    bool refused;    ///< `text` was refused and not changed since
    bool by_pointer; ///< typing began with a double-click, so it leaves no focus behind
    bool moved;      ///< the held widget was dragged, not only pressed
    bool fine;
    float press_x, press_y;
    float handle_x, handle_y; ///< of the held handle
    float anchor_x;           ///< where the drag's mapping starts anew: at the press and where Shift changes
    double anchor_value;
    float pointer_x, pointer_y;
    const char *hint;       ///< of the widget that the pointer is over, a text that stays; NULL: none
    const char *focus_hint; ///< of the one that has the keyboard
    struct rect focus_rect; ///< where that is
    const char *offered;    ///< the last hint of this pass, and where it holds
    struct rect offered_rect;
    enum ui_over over;   ///< as of the last frame drawn
    char complaint[160]; ///< why typed text was refused; the caller shows and clears it

    enum ui_pass pass;
    const struct event *event;
    struct drawlist *list;
    uint32_t find;
    bool find_has_value;
    double find_value;
    bool found;
    float found_x, found_y;
    bool used;
    struct rect area, clip, list_clip;
    float y; ///< where the next row goes
    struct ui_scroll *scroll;
    struct rect scroll_area, scroll_clip;
    struct ui_stop stop[UI_MAX_FOCUS];
    int stop_count;
};

void ui_begin_event(struct ui *ui, struct rect area, const struct event *event);
void ui_begin_draw(struct ui *ui, struct rect area, struct drawlist *list);
/// Looks for the widget `name`, or the place on its bar that shows `*value` (NULL: where it is held): found, found_x, found_y.
void ui_begin_find(struct ui *ui, struct rect area, const char *name, const double *value);
/// Ends the pass: moves the focus for Tab, drops widgets that are gone. true if the event was used or the widget found.
bool ui_end(struct ui *ui);

/// Cancels focus, hold and typing without a change.
void ui_release(struct ui *ui);
/// Whether a key event belongs to the text being typed: all but F keys and Ctrl chords, of which Ctrl+A does.
bool ui_is_typing_key(const struct ui *ui, const struct event *event);

/// The next row of `height` pixels, inset by UI_PAD from the panel's sides.
struct rect ui_row(struct ui *ui, float height);
void ui_space(struct ui *ui, float height);

/// Widgets built between these scroll inside `view`: by the wheel, and to show the focused widget.
void ui_scroll_begin(struct ui *ui, struct ui_scroll *scroll, struct rect view);
void ui_scroll_end(struct ui *ui);

/// Baseline that centres capitals in `r`.
float ui_baseline(struct rect r, enum font font, float size);
/// One line of text, cut with "…" if it does not fit; vertically centred.
void ui_label(struct ui *ui, struct rect r, const char *text, uint32_t color);
void ui_label_right(struct ui *ui, struct rect r, const char *text, uint32_t color);
/// Small text on up to 4 rows, broken at spaces.
void ui_paragraph(struct ui *ui, const char *text, uint32_t color);
/// Header of a section; a click opens and closes it. Returns whether it is open.
bool ui_section(struct ui *ui, const char *name, const char *title, bool *closed);
/// true if it was pressed (or by Enter or Space).
bool ui_button(struct ui *ui, struct rect r, const char *name, const char *label, bool primary);
bool ui_toggle(struct ui *ui, struct rect r, const char *name, bool *on);
/// A row of a list: a swatch of `color` and a text.
bool ui_list_row(struct ui *ui, struct rect r, const char *name, const char *text, uint32_t color, bool selected);

struct ui_choice {
    const char *name, *label; ///< a segment is found as "<control>.<name>"
};

/// One of `count` segments; true if `*index` (-1: none) changed.
bool ui_segments(struct ui *ui, struct rect r, const char *name, const struct ui_choice *choices, int count,
                 int *index);

/// A number: a bar from `minimum` to `maximum` if those differ, else a field that a drag changes by `step` per pixel.
struct ui_number {
    const char *name;
    const char *label; ///< in the label column; NULL: the field takes the whole rectangle
    const char *unit;  ///< behind the number, or NULL
    const char *hint;
    const char *shown;       ///< in place of the number, or NULL
    double minimum, maximum; ///< ends of the bar
    double lowest, highest;  ///< limits of typed numbers
    double fallback;         ///< right-click, Delete; NAN: none
    double step;             ///< step of arrow keys, and of a drag
    int decimals;
};

/// How a number changed, for undo: a drag is one step, however many UI_DRAG it has.
enum ui_change {
    UI_NONE,
    UI_DRAG,   ///< the pointer moved it; more may come
    UI_DROP,   ///< the drag has ended (the value is that of the last UI_DRAG)
    UI_CANCEL, ///< the drag was cancelled by Esc: back to the value before
    UI_SET,    ///< once: typed, or the default
    UI_NUDGE,  ///< once, by an arrow key; a run of them is one step
};

/// Drag to change (Shift: a tenth as fast), double-click or Enter to type, right-click or (focused) Delete for the default,
/// arrows when focused.
/// `*value` is set for UI_DRAG, UI_SET and UI_NUDGE.
enum ui_change ui_value(struct ui *ui, struct rect r, const struct ui_number *number, double *value);

/// A point to drag in two directions, or to move by the arrow keys.
struct ui_handle {
    const char *name, *hint;
    float x, y;         ///< where it is; for UI_DRAG where it was dragged to, which may be outside the area
    int step_x, step_y; ///< UI_NUDGE: arrow keys to the right and up (Shift: 10 at once)
};

/// Several handles in an area; a press takes the nearest. `*which` is the one that changed. The caller paints them.
enum ui_change ui_handles(struct ui *ui, struct rect area, struct ui_handle *handles, int count, int *which);

/// Small shapes instead of words.
enum ui_icon {
    UI_ICON_ADD,
    UI_ICON_COPY,
    UI_ICON_DELETE,
    UI_ICON_UP,
    UI_ICON_DOWN,
    UI_ICON_EYE,
    UI_ICON_EYE_CLOSED,
    UI_ICON_SOLO,
    UI_ICON_FOLLOW,   ///< a link
    UI_ICON_UNFOLLOW, ///< the same, broken
    UI_ICON_PICK,     ///< a target
    UI_ICON_RAMP,     ///< a curve through points
    UI_ICON_EACH,     ///< a bar for each of several
};
/// A square button with an icon; `lit`: it shows something that is on. true if it was pressed.
bool ui_icon_button(struct ui *ui, struct rect r, const char *name, enum ui_icon icon, bool lit, const char *hint);

/// A field with a text (after a swatch unless `color` is 0) that opens the popup `name`, about `which`.
void ui_dropdown(struct ui *ui, struct rect r, const char *name, int which, const char *text, uint32_t color);
/// A swatch called `name` that opens a popup.
void ui_swatch(struct ui *ui, struct rect r, const char *name, const char *popup, int which, uint32_t color);
/// A larger one to choose; true if it was pressed.
bool ui_color(struct ui *ui, struct rect r, const char *name, uint32_t color, bool chosen);

struct ui_item {
    const char *name, *label; ///< its row is found as "item.<name>"
    uint32_t color;           ///< of a swatch; 0: none
};
/// The popup of a drop-down: its rows, one of them chosen (-1: none); what is typed filters them. Built as ui_popup_begin() says.
/// Returns the one picked, which closes it; -1: none.
int ui_popup_list(struct ui *ui, const char *name, const struct ui_item *items, int count, int chosen);

/// Opens a popup under `anchor`, or above it if there is no room.
void ui_popup_open(struct ui *ui, const char *name, int which, struct rect anchor);
void ui_popup_close(struct ui *ui);
/// Whether the popup is open; then its content is built between begin and end, after all else in the panel. Arrows and Tab go
/// from widget to widget, Esc and a press outside close it.
bool ui_popup_is_open(const struct ui *ui, const char *name);
void ui_popup_begin(struct ui *ui, float width, float height);
void ui_popup_end(struct ui *ui);

/// A row of a list that a drag reorders: `ui->pointer_y` says where when it is dropped. The drag holds it by `label`; the
/// rest of the row is the caller's.
enum ui_row_event { UI_ROW_NONE, UI_ROW_PRESSED, UI_ROW_TWICE, UI_ROW_DROPPED };
enum ui_row_event ui_sort_row(struct ui *ui, struct rect row, struct rect label, const char *name, const char *text,
                              bool selected);
/// Whether that row is being dragged.
bool ui_is_dragged(const struct ui *ui, const char *name);

/// A line of text that is edited in place, between ui_line_begin() and Enter, Tab or a press elsewhere (UI_LINE_DONE:
/// `ui->text` is the result) or Esc (UI_LINE_CANCEL).
enum ui_line { UI_LINE_NONE, UI_LINE_DONE, UI_LINE_CANCEL };
void ui_line_begin(struct ui *ui, const char *name, const char *text);
bool ui_line_is_open(const struct ui *ui, const char *name);
enum ui_line ui_line(struct ui *ui, struct rect r, const char *name);

/// A line of text to type in; its content is ui->text while `typing`. true if the text changed.
bool ui_text_field(struct ui *ui, struct rect r, const char *name);

void ui_text_set(struct ui_text *text, const char *utf8);
/// Ctrl+A.
bool ui_selects_all(const struct event *event);
/// One key or character; false if the line does not use it. `changed` may be NULL.
bool ui_text_event(struct ui_text *text, const struct event *event, bool *changed);

/// A hint for the widgets in `r`, shown to who points at them or has the keyboard there.
void ui_hint(struct ui *ui, struct rect r, const char *text);
/// Width of a label.
float ui_text_width(const char *text);

/// For widgets made elsewhere: the id of a name, whether the pointer is over (and not over anything clipped), registration.
uint32_t ui_id(const char *name);
bool ui_hovered(const struct ui *ui, struct rect r);
void ui_register(struct ui *ui, uint32_t id, struct rect r);

#endif
