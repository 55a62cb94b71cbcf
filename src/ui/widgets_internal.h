/// What the widgets' two files share.
#ifndef UI_WIDGETS_INTERNAL_H
#define UI_WIDGETS_INTERNAL_H

#include "ui/font.h"
#include "ui/theme.h"
#include "ui/widgets.h"

#define UI_RADIUS 4.0f

/// A row's field, inset so that neighbours do not touch.
struct rect ui_field_of(struct rect row);

/// The id of a name outside scopes.
uint32_t ui_hash(const char *name);
/// Whether this event presses `button` over `r`, unclipped and unused; then it is used.
bool ui_pressed(struct ui *ui, struct rect r, enum event_button button);
/// Makes the widget hold the pointer.
void ui_hold(struct ui *ui, uint32_t id);
/// Handles events while something is held: release drops it, Esc cancels, others are used up.
enum ui_change ui_held_change(struct ui *ui);
/// Whether this event presses or repeats a key and the widget has the focus. The caller marks it as used.
bool ui_focused_key(const struct ui *ui, uint32_t id);
/// Keeps a widget alive that was not built in this pass.
void ui_keep(struct ui *ui, uint32_t id);

/// `hot`: under the pointer.
void ui_outline(struct ui *ui, struct rect r, float radius, bool hot);
void ui_focus_ring(struct ui *ui, uint32_t id, struct rect r);
void ui_number_text(struct ui *ui, struct rect r, const char *text, uint32_t color);

#endif
