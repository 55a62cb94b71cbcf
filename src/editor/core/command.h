/// Commands for keys, F1 and the palette. The table is in editor/commands.c.
#ifndef EDITOR_CORE_COMMAND_H
#define EDITOR_CORE_COMMAND_H

#include "editor/core/state.h"

struct editor;
struct curves;
struct inspector;

/// Bits for the place under the pointer. F1 begins with ten rows about it.
enum place {
    ON_CURVES = 1,
    ON_KNOT = 2,
    ON_TIME = 4, ///< ruler, dope sheet, status line
    ON_STAGE = 8,
    ON_PIN = 16,
    ON_INSPECTOR = 32,
    IN_STAGE_MENU = 64, ///< only a right-click on the stage lists it
    IN_EXAMPLES = 128,  ///< only the list of examples has it
    IN_CURVES_MENU = 256,
    ON_ROW = 512 ///< of the splines' list
};

/// What a command needs.
enum need {
    NEEDS_NOTHING,
    NEEDS_UNDO,
    NEEDS_REDO,
    NEEDS_SPLINE,
    NEEDS_SWING,    ///< a spline that is not cubic
    NEEDS_KNOTS,    ///< a spline with knots
    NEEDS_SELECTED, ///< a selected knot
    NEEDS_CHOSEN,   ///< a selected knot or pin
    NEEDS_PIN,
    NEEDS_BONE,
    NEEDS_RIG,
    NEEDS_TAIL, ///< or a chain
    NEEDS_TWIN, ///< a chain that can be mirrored
    NEEDS_PINNABLE,
    NEEDS_BODY,
    NEEDS_MODEL,
    NEEDS_PAINT, ///< a character with a coordinate
    NEEDS_PAGE,  ///< the app runs in a browser
    NEEDS_NO_PAGE,
    NEEDS_COUNT
};

/// When a command's key works.
enum when {
    REPEATS = 1,  ///< also while the key is held
    ANY_TIME = 2, ///< also during a drag, while its undo step is open
    FIRST = 4,    ///< before a drag, the inspector or a popup get the key
    PINS = 8,     ///< goes from pin to pin if one is selected
    IN_STEPS = 16 ///< also with Shift (larger steps) or Ctrl (smaller ones)
};

enum { CHORD_TYPED = 1 << 8 /* among `mods`: it is the typed character, wherever a keyboard has it */ };

/// A key with exactly these modifiers.
struct chord {
    int key; ///< or character; 0: none
    unsigned mods;
};

enum { COMMAND_KEYS = 96 }; ///< bytes for a key's name, or a gesture's

/// The heading of the commands that the palette lists last.
extern const char ABOUT_FILE[];

/// A row of the table. A row without a function is a gesture, listed only in F1.
struct command {
    const char *name;  ///< NULL: not listed
    const char *also;  ///< other words for it, which the palette finds; NULL for a gesture
    const char *about; ///< its heading in F1; NULL: not in F1
    unsigned at;       ///< of enum place
    struct chord chord;
    enum need needs;
    unsigned when;       ///< of enum when
    const char *gesture; ///< of the mouse or a held key; replaces the chord
    void (*run)(struct editor *editor, int argument);
    void (*act)(struct core *core);
    void (*core)(struct core *core, int argument);
    void (*curves)(struct curves *curves, struct core *core, int argument);
    void (*inspector)(struct inspector *inspector, int argument);
    const struct knot *(*knot)(struct core *core, int argument); ///< returns the knot to scroll to
    const char *section;                                         ///< inspector section to open
    enum request_kind request;                                   ///< gets the argument as its number
    int argument;
};

/// false for a gesture.
bool command_runs(const struct command *command);
/// What is missing for each need, as in "Select a knot first."; NULL: nothing.
void needs_missing(const struct core *core, const char *missing[NEEDS_COUNT]);
/// Keys that a browser keeps for itself: reload, its address, tabs and history.
bool command_is_browsers(int key, unsigned mods);
/// Its key, "Ctrl+Shift+Z", or its gesture; "" for neither, or, in a page, for a key that is the browser's own.
void command_keys(const struct command *command, bool in_page, char text[COMMAND_KEYS]);
/// A key's name, as "Esc", "PgUp", "←", or NULL.
const char *command_key_name(int key);

#endif
