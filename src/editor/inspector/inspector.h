/// Interface of the inspector.
#ifndef EDITOR_INSPECTOR_INSPECTOR_H
#define EDITOR_INSPECTOR_INSPECTOR_H

#include "editor/core/state.h"
#include "ui/widgets.h"

struct inspector;

struct inspector *inspector_create(struct core *core);
void inspector_destroy(struct inspector *in);
/// F2: starts typing the active spline's name.
void inspector_rename(struct inspector *in, int unused);
/// Puts the keyboard's focus on the last frame, so that a number can be typed.
void inspector_edit_range(struct inspector *in, int unused);
/// Opens a section and scrolls to it.
void inspector_unfold(struct inspector *in, const char *name);
/// Shows a rig and its spline.
void inspector_show_rig(struct inspector *in, int rig);
/// The same for the rig clicked on the stage, without scrolling: its feel stays in sight.
void inspector_show_clicked(struct inspector *in, int rig);
/// Shows the channel that a spline drives, of the shown rig if possible.
void inspector_show_spline(struct inspector *in, int spline);
/// A: the menu of things to add, at the pointer or at the top of the inspector.
void inspector_add_menu(struct inspector *in, int unused);
enum added { ADD_TAIL, ADD_FILE, ADD_COPY, ADD_CHAIN, ADD_SPLINE, ADD_COPY_OF };
/// Adds something and shows it. ADD_COPY copies the shown rig, ADD_COPY_OF + n the rig n.
void inspector_add(struct inspector *in, int what);
/// Applies a feel preset, in panel order, to the active spline.
void inspector_preset(struct inspector *in, int preset);
/// Rolls another variation of the active spline's motion.
void inspector_roll(struct inspector *in, int unused);
/// Mirrors the shown chain onto the other side's bones and shows the copy.
void inspector_mirror(struct inspector *in, int unused);
/// Shift+Del: asks whether to remove the shown rig.
void inspector_remove_rig(struct inspector *in, int unused);
/// Hover, focus and typed text of its widgets.
const struct ui *inspector_ui(const struct inspector *in);
/// For a new document: resets focus, drag (not the history), scrolling and channel.
void inspector_reset(struct inspector *in);
/// true if the event is used.
bool inspector_event(struct inspector *in, const struct event *event);
/// `covered`: an overlay is open.
void inspector_show(struct inspector *in, bool covered);
/// Ends a drag, focus and typing, before an overlay opens or the document changes.
void inspector_let_go(struct inspector *in);
/// Whether a slider is being dragged, so that an undo step is open.
bool inspector_is_dragging(const struct inspector *in);
/// Finds a widget by name: "frequency", "frequency,2.5" (where its bar shows 2.5), "mode.real", "spline.sway", "channel.0", "look.stiff",
/// "section.knot". false if it is not visible.
bool inspector_target(struct inspector *in, const char *name, float *x, float *y);

#endif
