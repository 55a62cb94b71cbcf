/// The keyboard: the command of a key or character, and keys that act while they are held.
#include "editor/commands.h"
#include "editor/core/core.h"
#include "editor/core/view.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "scene/parameter.h"

const struct command *keys_command(int key, unsigned mods)
{
    for (int i = 0; i < command_count; i++) {
        for (const struct chord *chord = commands[i].chords; chord->key; chord++) {
            if (chord->key == key && chord->mods == mods) return &commands[i];
        }
    }
    return NULL;
}

/// Runs the chord's command, unless it excludes key repeats or drags; true if there is one.
static bool run(struct editor *editor, int key, unsigned mods, bool repeated)
{
    const struct command *command = keys_command(key, mods);
    const bool busy = history_is_open(editor->core.history);
    if (command && (command->when & REPEATS || !repeated) && (command->when & ANY_TIME || !busy))
        command_run(editor, command);
    return command != NULL;
}

/// Space plays on release, unless it panned.
static void space_event(struct editor *editor, const struct event *event)
{
    if (event->action == ACTION_PRESS) {
        editor->core.space_down = true;
        editor->core.space_used = false;
    } else if (event->action == ACTION_RELEASE && editor->core.space_down) {
        editor->core.space_down = false;
        if (!editor->core.space_used) playback_toggle(&editor->core);
    }
}

static bool is_held_letter(int key)
{
    return key == 'L' || key == 'K' || parameter_of_letter(key) != PARAMETER_COUNT;
}

/// Text of a key used elsewhere (to close the help, say) runs no command.
static bool text_event(struct editor *editor, const struct event *event)
{
    const struct press *press = &editor->press;
    return !press->used && run(editor, (int)event->codepoint, CHORD_TYPED, press->repeated);
}

static unsigned mods_of(const struct event *event) { return event->mods & (MOD_SHIFT | MOD_CTRL | MOD_ALT); }

bool keys_first(struct editor *editor, const struct event *event)
{
    if (event->kind != EVENT_KEY || event->action != ACTION_PRESS) return false;
    const struct command *command = keys_command(event->key, mods_of(event));
    if (!command || !(command->when & FIRST)) return false;
    if (!inspector_is_dragging(editor->inspector)) command_run(editor, command);
    return true;
}

bool keys_event(struct editor *editor, const struct event *event)
{
    if (event->kind == EVENT_TEXT) return text_event(editor, event);
    const unsigned mods = mods_of(event);
    struct core *core = &editor->core;
    if (event->key == KEY_SPACE && (mods == 0 || event->action == ACTION_RELEASE)) {
        space_event(editor, event);
        return true;
    }
    if (event->action == ACTION_RELEASE) {
        if (event->key != core->held_key) return false;
        core->held_key = 0;
        const bool on_stage = core_panel_at(core, core->pointer_x, core->pointer_y) == PANEL_STAGE;
        return !core->held_used && on_stage && run(editor, event->key, 0, false); // F alone
    }
    const bool holds = mods == 0 && is_held_letter(event->key);
    if (holds && event->action == ACTION_PRESS) {
        core->held_key = event->key;
        core->held_used = false;
        if (event->key == 'K') take_explain(core);
    }
    const bool bound = !holds && run(editor, event->key, mods, event->action == ACTION_REPEAT);
    editor->press.opened = inspector_ui(editor->inspector)->popup.id != 0;
    editor->press.used |= bound && mods & MOD_ALT; // some systems still send the key's text
    return bound;
}
