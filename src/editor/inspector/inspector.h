/// Interface of the inspector.
#ifndef EDITOR_INSPECTOR_INSPECTOR_H
#define EDITOR_INSPECTOR_INSPECTOR_H

#include "editor/core/state.h"
#include "ui/widgets.h"

struct inspector;

struct inspector *inspector_create(struct core *core);
void inspector_destroy(struct inspector *in);
/// F2: the active spline's name can be typed.
void inspector_rename(struct inspector *in, int unused);
/// Opens a section, with all of it in sight where there is room.
void inspector_unfold(struct inspector *in, const char *name);
/// Shows a rig, with its feel.
void inspector_show_rig(struct inspector *in, int rig);
/// Shows the channel that a spline drives: of the shown rig if it has one.
void inspector_show_spline(struct inspector *in, int spline);
/// A: the menu of what can be added, at the pointer over stage and curves, else on top of the inspector. And on something of the inspector.
void inspector_add_menu(struct inspector *in, int unused);
/// Choices of inspector_add().
enum added { ADD_TAIL, ADD_FILE, ADD_COPY, ADD_CHAIN, ADD_MEADOW, ADD_SPLINE };
/// Adds it, ADD_COPY one more of the rig that is shown, and shows it.
void inspector_add(struct inspector *in, int what);
/// Gives the active spline one of the presets of its feel, in their order on the panel.
void inspector_preset(struct inspector *in, int preset);
/// Another variation of the active spline's motion.
void inspector_roll(struct inspector *in, int unused);
/// Makes the chain that is shown once more, mirrored, on the bones of the other side, and shows it.
void inspector_mirror(struct inspector *in, int unused);
/// Shift+Del: asks whether to remove the shown rig, which is that of the active spline.
void inspector_remove_rig(struct inspector *in, int unused);
/// Its widgets: hover, focus, typed text.
const struct ui *inspector_ui(const struct inspector *in);
/// A new document is on the table: forgets focus, running drag (without touching the history), scrolling and channel.
void inspector_reset(struct inspector *in);
/// An event for the inspector; true where it used it up.
bool inspector_event(struct inspector *in, const struct event *event);
/// Draws it; `covered`: something lies over the panels.
void inspector_show(struct inspector *in, bool covered);
/// Ends a running drag where it is, and drops focus and typing, before something opens over the panel or the document changes.
void inspector_let_go(struct inspector *in);
/// Whether a slider is being dragged (a history step is open).
bool inspector_is_dragging(const struct inspector *in);
/// Where the widget `name` is: "frequency", "frequency,2.5" (where its bar shows 2.5), "mode.real", "spline.sway",
/// "channel.0", "look.stiff", "section.knot". false where it is not shown or scrolled out of sight.
bool inspector_target(struct inspector *in, const char *name, float *x, float *y);

#endif
