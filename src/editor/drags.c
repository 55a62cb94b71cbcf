/// A running drag's events go to the panel that began it.
#include "editor/drags.h"
#include "editor/core/drag.h"
#include "editor/core/layout.h"
#include "editor/curves/curves.h"
#include "editor/stage/stage.h"
#include "editor/state.h"

/// A divider between the panels follows the pointer.
static void move_divider(struct editor *editor, const struct event *event)
{
    enum drag_kind kind = editor->core.drag.kind;
    if (kind == DRAG_STAGE_DIVIDER || kind == DRAG_INSPECTOR_DIVIDER)
        core_divider_move(&editor->core, kind, event->x, event->y);
}

void drags_end(struct editor *editor, const struct editor_world *world, bool keep)
{
    curves_drag_end(editor->curves, &editor->core, world, keep);
    stage_drag_end(editor->stage, &editor->core, world, keep);
    drag_end(&editor->core, world, keep);
}

bool drags_event(struct editor *editor, const struct editor_world *world, const struct event *event)
{
    if (editor->core.drag.kind == DRAG_NONE) return false;
    if (event->kind == EVENT_POINTER) {
        if (!drag_move(&editor->core, world, event)) return true;
        curves_drag_move(editor->curves, &editor->core, world, event);
        stage_drag_move(editor->stage, &editor->core);
        move_divider(editor, event);
        return true;
    }
    enum drag_answer answer = curves_drag_event(editor->curves, &editor->core, world, event);
    if (answer == DRAG_PASSES) answer = stage_drag_event(editor->stage, &editor->core, world, event);
    if (answer == DRAG_PASSES) answer = drag_event(&editor->core.drag, event);
    if (answer == DRAG_KEEP || answer == DRAG_TAKE_BACK) drags_end(editor, world, answer == DRAG_KEEP);
    return answer != DRAG_PASSES;
}
