/// The needs of commands, and the names of their keys.
#include "editor/core/command.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include <stdio.h>

const char *const about_titles[ABOUT_COUNT] = {
    [ABOUT_KNOTS] = "Knots",         [ABOUT_DRAG] = "While dragging", [ABOUT_SLOPES] = "Slopes and poses",
    [ABOUT_SPLINE] = "Splines",      [ABOUT_PLAYBACK] = "Playback",   [ABOUT_CURVES] = "Curves",
    [ABOUT_STAGE] = "Stage",         [ABOUT_PINS] = "Pins",           [ABOUT_INSPECTOR] = "Inspector",
    [ABOUT_FILE] = "File and edits", [ABOUT_WINDOW] = "Window",       [ABOUT_SCENES] = "Scenes to try",
};

static bool can_undo(const struct core *core) { return history_done(core->history) > 0; }

static bool can_redo(const struct core *core) { return history_done(core->history) < history_count(core->history); }

static bool has_spline(const struct core *core) { return core_active_spline(core) != NULL; }

static bool has_swing(const struct core *core)
{
    return has_spline(core) && spline_mode(core_active_spline(core)) != WIGGLY_CUBIC;
}

static bool has_knots(const struct core *core)
{
    return has_spline(core) && core_active_spline(core)->knot_count > 0;
}

static bool has_selected(const struct core *core) { return selected_count(core) > 0; }

static bool has_chosen(const struct core *core) { return has_selected(core) || pins_any_selected(core); }

static bool has_bone(const struct core *core)
{
    int model;
    return bones_selected(core, &model) >= 0;
}

static bool has_rig(const struct core *core) { return core->document->rig_count > 0; }

static bool has_kind(const struct core *core, enum rig_kind kind)
{
    return document_find_rig(core->document, kind, 0) >= 0;
}

static bool has_tail(const struct core *core) { return has_kind(core, RIG_TAIL) || has_kind(core, RIG_CHAIN); }

static bool has_twin(const struct core *core) { return bones_mirrorable(core, 0) >= 0; }

static bool has_body(const struct core *core) { return has_kind(core, RIG_TAIL); }

static bool has_character(const struct core *core) { return has_kind(core, RIG_CHARACTER); }

static bool has_pinnable(const struct core *core) { return has_tail(core) || has_character(core); }

static bool has_model(const struct core *core) { return has_kind(core, RIG_MODEL); }

static bool has_coordinate(const struct core *core) { return characters_coordinate(core) != NULL; }

static bool has_page(const struct core *core) { return core->in_page; }

static bool has_no_page(const struct core *core) { return !core->in_page; }

static const struct {
    bool (*met)(const struct core *core);
    const char *missing;
} needs[] = {
    [NEEDS_UNDO] = {can_undo, "There is nothing to undo."},
    [NEEDS_REDO] = {can_redo, "There is nothing to redo."},
    [NEEDS_SPLINE] = {has_spline, "Add a spline first."},
    [NEEDS_SWING] = {has_swing, "Choose a spline that swings first: a cubic does not."},
    [NEEDS_KNOTS] = {has_knots, "Insert a knot first."},
    [NEEDS_SELECTED] = {has_selected, "Select a knot first."},
    [NEEDS_CHOSEN] = {has_chosen, "Select a knot or a pin first."},
    [NEEDS_PIN] = {pins_any_selected, "Select a pin first."},
    [NEEDS_BONE] = {has_bone, "Click a bone of an imported character first."},
    [NEEDS_RIG] = {has_rig, "Add a tail or a character first."},
    [NEEDS_TAIL] = {has_tail, "Add a tail or a chain first."},
    [NEEDS_TWIN] = {has_twin, "Make a chain of bones with a free other side first (ear_L, ear_R)."},
    [NEEDS_PINNABLE] = {has_pinnable, "Add a tail, a chain or a soft character first."},
    [NEEDS_BODY] = {has_body, "Add a tail first."},
    [NEEDS_CHARACTER] = {has_character, "Add a soft character first."},
    [NEEDS_MODEL] = {has_model, "Open a character from a file first."},
    [NEEDS_PAINT] = {has_coordinate, "Select a soft character first."},
    [NEEDS_PAGE] = {has_page, "Links are for the app in a browser."},
    [NEEDS_NO_PAGE] = {has_no_page, "Close the page instead: unsaved work is kept."},
};

bool command_runs(const struct command *command)
{
    return command->run || command->core || command->curves || command->inspector || command->knot ||
           command->section || command->request;
}

const char *need_missing(const struct core *core, enum need need)
{
    return need == NEEDS_NOTHING || needs[need].met(core) ? NULL : needs[need].missing;
}

const char *command_key_name(int key)
{
    static const struct {
        int key;
        const char *name;
    } names[] = {{KEY_ESCAPE, "Esc"}, {KEY_DELETE, "Del"}, {KEY_PAGE_UP, "PgUp"}, {KEY_PAGE_DOWN, "PgDn"},
                 {KEY_LEFT, "←"},     {KEY_RIGHT, "→"},    {KEY_UP, "↑"},         {KEY_DOWN, "↓"}};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (names[i].key == key) return names[i].name;
    }
    return key_name(key);
}

static size_t add(char text[COMMAND_KEYS], size_t length, const char *word)
{
    const int more = snprintf(text + length, COMMAND_KEYS - length, "%s", word);
    return length + (size_t)more < COMMAND_KEYS ? length + (size_t)more : COMMAND_KEYS - 1;
}

void command_keys(const struct command *command, char text[COMMAND_KEYS])
{
    size_t length = 0;
    text[0] = '\0';
    if (command->gesture) add(text, 0, command->gesture);
    const struct chord *end = command->chords + COMMAND_SHOWN;
    for (const struct chord *chord = command->chords; !command->gesture && chord < end && chord->key; chord++) {
        const char typed[2] = {(char)chord->key, '\0'};
        if (chord != command->chords) length = add(text, length, " or ");
        if (chord->mods & MOD_CTRL) length = add(text, length, "Ctrl+");
        if (chord->mods & MOD_SHIFT) length = add(text, length, "Shift+");
        if (chord->mods & MOD_ALT) length = add(text, length, "Alt+");
        length = add(text, length, chord->mods & CHORD_TYPED ? typed : command_key_name(chord->key));
    }
}
