/// The needs of commands, and the names of their keys.
#include "editor/core/core.h"
#include <stdio.h>

void needs_missing(const struct core *core, const char *missing[NEEDS_COUNT])
{
    const struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const bool knots = selected_count(core) > 0, pin = pins_any_selected(core);
    const bool tail = document_find_rig(document, RIG_TAIL, 0) >= 0;
    const bool bent = tail || document_find_rig(document, RIG_CHAIN, 0) >= 0;
    int model;
    const struct {
        bool is_met;
        const char *otherwise;
    } needs[NEEDS_COUNT] = {
        [NEEDS_NOTHING] = {true, NULL},
        [NEEDS_UNDO] = {history_done(core->history) > 0, "There is nothing to undo."},
        [NEEDS_REDO] = {history_done(core->history) < history_count(core->history), "There is nothing to redo."},
        [NEEDS_SPLINE] = {spline, "Add a spline first."},
        [NEEDS_SWING] = {spline && spline_mode(spline) != WIGGLY_CUBIC,
                         "Choose a spline that swings first: a cubic does not."},
        [NEEDS_KNOTS] = {spline && spline->knot_count > 0, "Insert a knot first."},
        [NEEDS_SELECTED] = {knots, "Select a knot first."},
        [NEEDS_CHOSEN] = {knots || pin, "Select a knot or a pin first."},
        [NEEDS_PIN] = {pin, "Select a pin first."},
        [NEEDS_BONE] = {bones_selected(core, &model) >= 0, "Click a bone of a character first."},
        [NEEDS_RIG] = {document->rig_count > 0, "Add a tail or a character first."},
        [NEEDS_TAIL] = {bent, "Add a tail or a chain first."},
        [NEEDS_TWIN] = {bones_mirrorable(core, 0) >= 0,
                        "Make a chain of bones with a free other side first (ear_L, ear_R)."},
        [NEEDS_PINNABLE] = {bent || characters_rig(core) >= 0, "Add a tail, a chain or a soft character first."},
        [NEEDS_BODY] = {tail, "Add a tail first."},
        [NEEDS_MODEL] = {document_find_rig(document, RIG_MODEL, 0) >= 0, "Open a character from a file first."},
        [NEEDS_PAINT] = {characters_coordinate(core), "Select a soft character first."},
        [NEEDS_PAGE] = {core->app.in_page, "Links are for the app in a browser."},
        [NEEDS_NO_PAGE] = {!core->app.in_page, "Close the page instead: unsaved work is kept."},
    };
    for (int need = 0; need < NEEDS_COUNT; need++) missing[need] = needs[need].is_met ? NULL : needs[need].otherwise;
}

bool command_runs(const struct command *command)
{
    return command->run || command->act || command->core || command->curves || command->inspector || command->knot ||
           command->section || command->request;
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

bool command_is_browsers(int key, unsigned mods)
{
    const bool is_arrow = key == KEY_LEFT || key == KEY_RIGHT || key == KEY_UP || key == KEY_DOWN;
    if (key == KEY_F5 || key == KEY_F6) return true;
    if (mods == MOD_ALT) return is_arrow;
    if (mods == MOD_CTRL && (key == KEY_PAGE_UP || key == KEY_PAGE_DOWN || key == 'N')) return true;
    if (mods == MOD_CTRL) return key == 'R' || key == 'L' || key == 'W' || key == 'T';
    return mods == (MOD_CTRL | MOD_SHIFT) && (key == 'R' || key == 'W' || key == 'T');
}

void command_keys(const struct command *command, bool in_page, char text[COMMAND_KEYS])
{
    const struct chord *chord = &command->chord;
    const char typed[2] = {(char)chord->key, '\0'};
    const bool has_key = chord->key && !(in_page && command_is_browsers(chord->key, chord->mods));
    snprintf(text, COMMAND_KEYS, "%s", command->gesture ? command->gesture : "");
    if (command->gesture || !has_key) return;
    snprintf(text, COMMAND_KEYS, "%s%s%s%s", chord->mods & MOD_CTRL ? "Ctrl+" : "",
             chord->mods & MOD_SHIFT ? "Shift+" : "", chord->mods & MOD_ALT ? "Alt+" : "",
             chord->mods & CHORD_TYPED ? typed : command_key_name(chord->key));
}
