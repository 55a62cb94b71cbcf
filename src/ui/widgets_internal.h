/// Functions that the files of the widgets share: input tests and shapes.
#ifndef UI_WIDGETS_INTERNAL_H
#define UI_WIDGETS_INTERNAL_H

#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#define UI_RADIUS 4.0f

/// The field of a row: inset so that neighbouring rows do not touch.
struct rect ui_field_of(struct rect row);

/// Whether the running event is this button going down over `r`, not clipped and not used yet; then it is used up.
bool ui_pressed(struct ui *ui, struct rect r, enum event_button button);
/// The running event's press holds that widget from now on.
void ui_hold(struct ui *ui, uint32_t id);
/// Keys and buttons while something is held: the release drops it, Esc cancels; others are used up.
enum ui_change ui_held_change(struct ui *ui);
/// Whether the running event presses or repeats a key and widget `id` has the focus; the caller marks it as used.
bool ui_focused_key(const struct ui *ui, uint32_t id);
/// Counts a widget as shown although it was not built in this pass: the next one will build it.
void ui_keep(struct ui *ui, uint32_t id);
/// Moves the focus to the next (1) or previous (-1) widget, wrapping round, and scrolls it into view.
void ui_move_focus(struct ui *ui, int direction);
/// Enter or Space on the focused widget; used up.
bool ui_activated(struct ui *ui, uint32_t id);
/// Registers a widget that is pressed. true if it was, with the left button or by Enter or Space.
bool ui_clicked(struct ui *ui, uint32_t id, struct rect r);

/// The outline of a control; `hot`: under the pointer.
void ui_outline(struct ui *ui, struct rect r, float radius, bool hot);
void ui_focus_ring(struct ui *ui, uint32_t id, struct rect r);
void ui_number_text(struct ui *ui, struct rect r, const char *text, uint32_t color);
/// What an event does to the line that is being typed in `field`: UI_LINE_DONE by a press elsewhere, Enter, or Tab, which is not used up.
enum ui_line ui_typing_event(struct ui *ui, uint32_t id, struct rect field);
/// The line that is being typed, with its caret, inside `r`.
void ui_paint_text(struct ui *ui, struct rect r, const struct ui_text *text, enum font font, float size,
                   bool focused);

#endif
