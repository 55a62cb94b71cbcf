/// The commands of keys, F1 and the palette. The table is in editor/commands.c.
#ifndef EDITOR_CORE_COMMAND_H
#define EDITOR_CORE_COMMAND_H

#include "editor/core/state.h"

struct editor;
struct curves;
struct inspector;

/// Under which heading F1 lists a command.
enum about {
    ABOUT_KNOTS,
    ABOUT_DRAG,
    ABOUT_SLOPES,
    ABOUT_SPLINE,
    ABOUT_PLAYBACK,
    ABOUT_CURVES,
    ABOUT_STAGE,
    ABOUT_PINS,
    ABOUT_INSPECTOR,
    ABOUT_FILE,
    ABOUT_WINDOW,
    ABOUT_SCENES,
    ABOUT_COUNT,
    ABOUT_NOTHING = ABOUT_COUNT ///< F1 does not list it
};
extern const char *const about_titles[ABOUT_COUNT];

/// The place under the pointer, one bit each: F1 begins with ten rows about it.
enum place {
    ON_CURVES = 1,
    ON_KNOT = 2,
    ON_TIME = 4, ///< ruler, dope sheet, status line
    ON_STAGE = 8,
    ON_PIN = 16,
    ON_INSPECTOR = 32
};

/// Needs of a command.
enum need {
    NEEDS_NOTHING,
    NEEDS_UNDO,
    NEEDS_REDO,
    NEEDS_SPLINE,
    NEEDS_SWING,    ///< a spline that is no cubic
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
    NEEDS_CHARACTER,
    NEEDS_MODEL,
    NEEDS_MEADOW,
    NEEDS_NO_MEADOW,
    NEEDS_PAINT, ///< a character with a coordinate
    NEEDS_COUNT
};

/// When its keys work.
enum when {
    REPEATS = 1,  ///< also while the key is kept down
    ANY_TIME = 2, ///< also while a drag holds a step of the history open
    FIRST = 4,    ///< before a drag, the inspector or a popup get the key
    PINS = 8      ///< goes from pin to pin where one is selected
};

enum { CHORD_TYPED = 1 << 8 /* among `mods`: it is the typed character, wherever a keyboard has it */ };

/// A key with exactly these modifiers.
struct chord {
    int key; ///< or character; 0: none
    unsigned mods;
};

enum {
    COMMAND_CHORDS = 5,
    COMMAND_SHOWN = 2, ///< of them, in F1 and the palette; docs/keys.md has all
    COMMAND_KEYS = 96  ///< bytes of their names
};

/// A row of the table: a command's name and function. A row without a function is a gesture, which only F1 shows.
struct command {
    const char *name; ///< in plain words; NULL: neither F1 nor the palette lists it
    enum about about;
    unsigned at;                         ///< of enum place
    struct chord chords[COMMAND_CHORDS]; ///< up to one without a key
    enum need needs;
    unsigned when;       ///< of enum when
    const char *gesture; ///< with the mouse or a held key; in place of the chords
    void (*run)(struct editor *editor, int argument);
    void (*core)(struct core *core, int argument);
    void (*curves)(struct curves *curves, struct core *core, int argument);
    void (*inspector)(struct inspector *inspector, int argument);
    const struct knot *(*knot)(struct core *core, int argument); ///< which is to be seen then
    enum request_kind request;                                   ///< its number is the argument
    int argument;
};

/// Whether it is more than a gesture.
bool command_runs(const struct command *command);
/// The need that is not met, as in "Select a knot first."; NULL: the command can run now.
const char *command_missing(const struct core *core, const struct command *command);
/// The same for a need.
const char *need_missing(const struct core *core, enum need need);
/// Its first keys, "Ctrl+Y or Ctrl+Shift+Z", or its gesture; "" for a command without a key.
void command_keys(const struct command *command, char text[COMMAND_KEYS]);
/// Name of a key: "Esc", "PgUp", "←". NULL: it has none.
const char *command_key_name(int key);

#endif
