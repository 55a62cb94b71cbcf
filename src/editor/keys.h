/// What each key and each typed character does, as tables, and the actions that stand for the mouse. Private to src/editor.
#ifndef EDITOR_KEYS_H
#define EDITOR_KEYS_H

#include "editor/state.h"

/// What a key does to the panels, and what it does to what they share alone.
typedef void key_action(struct editor *editor, const struct editor_world *world, int argument);
typedef void core_action(struct core *core, const struct editor_world *world, int argument);

struct binding {
    int key;         ///< or character
    unsigned mods;   ///< exactly these
    bool repeats;    ///< also while the key is kept down
    bool any_time;   ///< also while a drag holds a step of the history open
    key_action *run; ///< or
    core_action *core;
    int argument;
};

/// Up to one that does nothing. Letters are what is printed on a key, digits a place.
extern const struct binding key_bindings[];
/// Punctuation, by what is typed: every layout has it on other keys, and some need Shift for it. What AZERTY, QWERTZ or
/// Nordic layouts cannot type without AltGr has a key as well.
extern const struct binding character_bindings[];

/// Keys and characters; true where the event is used up.
bool keys_event(struct editor *editor, const struct editor_world *world, const struct event *event);

/// Arguments of keyboard_pan() and keyboard_orbit().
enum keyboard_way { WAY_LEFT, WAY_RIGHT, WAY_UP, WAY_DOWN };

/// The curves are looked at a tenth of the panel further that way.
void keyboard_pan(struct editor *editor, const struct editor_world *world, int way);
/// Nearer (1) or further away (-1), about the middle of the curves panel.
void keyboard_zoom(struct editor *editor, const struct editor_world *world, int direction);

/// The same for the stage's camera, which goes round what it looks at.
void keyboard_orbit(struct editor *editor, const struct editor_world *world, int way);
void keyboard_approach(struct editor *editor, const struct editor_world *world, int direction);
/// All of the stage's rigs in sight, from where the camera was at first.
void keyboard_fit_stage(struct editor *editor, const struct editor_world *world, int argument);

/// The selected knot's neighbour (from the playhead where not just one is selected).
void keyboard_neighbour(struct editor *editor, const struct editor_world *world, int direction);
/// The knot after the last selected one (1), or before the first one (-1), is selected besides.
void keyboard_extend(struct editor *editor, const struct editor_world *world, int direction);
/// Does away with the first warning.
void keyboard_remedy(struct editor *editor, const struct editor_world *world, int argument);

/// The next of a few sizes for the stage (0) or the inspector (1), in place of dragging a divider.
void keyboard_panel(struct editor *editor, const struct editor_world *world, int inspector);

#endif
