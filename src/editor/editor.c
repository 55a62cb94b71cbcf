/// The editor's public functions: events, and one frame.
#include "editor/editor.h"
#include "base/need.h"
#include "editor/commands.h"
#include "editor/core/core.h"
#include "editor/core/view.h"
#include "editor/curves/curves.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "ui/theme.h"
#include <stdlib.h>

enum { MAX_COMMANDS = 16384, MAX_POINTS = 1 << 18, MAX_TEXT = 1 << 16 };

struct editor *editor_create(void)
{
    struct editor *editor = need_zeroed(1, sizeof *editor);
    drawlist_create(&editor->core.list, MAX_COMMANDS, MAX_POINTS, MAX_TEXT);
    editor->curves = curves_create();
    editor->stage = stage_create(&editor->core);
    editor->inspector = inspector_create(&editor->core);
    editor->dialogs = dialogs_create(commands, command_count);
    editor->core.layout.stage_share = 400.0f / (720 - THEME_STATUS_HEIGHT);
    editor->core.layout.inspector_width = THEME_INSPECTOR_WIDTH;
    editor->core.visible = 2;
    editor->core.active = -1;
    editor->core.ui_scale = 1;
    editor->core.brush = (struct brush){.radius = 0.12, .strength = 0.4};
    editor->core.overlays.ghost = true;
    editor->core.keep = true;
    editor_resize(editor, 1280, 720, 1);
    return editor;
}

void editor_destroy(struct editor *editor)
{
    if (!editor) return;
    curves_destroy(editor->curves);
    stage_destroy(editor->stage);
    inspector_destroy(editor->inspector);
    dialogs_destroy(editor->dialogs);
    drawlist_destroy(&editor->core.list);
    take_keep(&editor->core, false);
    free(editor->core.selection.bits);
    free(editor->core.hidden.bits);
    free(editor->core.solo.bits);
    free(editor->core.clipboard);
    free(editor->core.originals.list);
    free(editor->core.pressed.list);
    free(editor);
}

void editor_resize(struct editor *editor, float width, float height, float scale)
{
    editor->core.layout.window = (struct rect){0, 0, width > 1 ? width : 1, height > 1 ? height : 1};
    const float before = editor->core.scale, now = scale > 0 ? scale : 1;
    if (before > 0) { // the scene keeps its place under the pointer
        editor->core.pointer_x *= before / now;
        editor->core.pointer_y *= before / now;
    }
    editor->core.scale = now;
    core_layout(&editor->core);
}

static void open_panels(struct editor *editor)
{
    editor->seen.serial = editor->core.serial;
    editor->fitted = false;
    curves_open(editor->curves);
    stage_open(editor->stage);
    inspector_reset(editor->inspector);
    inspector_show_spline(editor->inspector, editor->core.active);
    editor->seen.active = editor->core.active_id;
}

void editor_open(struct editor *editor, const struct editor_world *world)
{
    editor->core.document = world->document;
    editor->core.history = world->history;
    editor->core.evaluation = world->evaluation;
    editor->core.models = world->models;
    core_open(&editor->core);
    open_panels(editor);
}

void editor_settle(struct editor *editor)
{
    struct core *core = &editor->core;
    core_close(core);
    if (editor->seen.serial != core->serial) open_panels(editor);
    inspector_show_clicked(editor->inspector);
    if (editor->seen.active == core->active_id) return;
    const int before = document_find_spline_id(editor->core.document, editor->seen.active);
    editor->seen.active = core->active_id;
    if (core->active < 0) return;
    if (before >= 0) curves_activate(editor->curves, core, before);
    inspector_show_spline(editor->inspector, core->active);
}

void editor_show_poles(struct editor *editor) { inspector_unfold(editor->inspector, "section.poles"); }

struct request editor_take_request(struct editor *editor)
{
    const struct request taken = editor->core.request;
    editor->core.request = (struct request){.kind = REQUEST_NONE};
    return taken;
}

void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text)
{
    if (!dialogs_answer(editor->dialogs, &editor->core, request, ok, text) && !ok)
        core_message(&editor->core, true, "%s", text);
}

bool editor_wants_frames(const struct editor *editor)
{
    const struct drag_owner *dragged = editor->core.drag.owner;
    return editor->core.playback.playing || (dragged && dragged->goes_on) || stage_is_moving(editor->stage) ||
           editor->core.message.seconds_left > 0 || editor->core.unshown || editor->core.nudged_seconds > 0 ||
           presenter_is_sliding(&editor->core) || dialogs_want_frames(editor->dialogs, &editor->core) ||
           curves_wants_frames(editor->curves) || tooltip_waits(&editor->tooltip);
}

const struct stage_view *editor_stage(const struct editor *editor) { return stage_seen(editor->stage); }

void editor_tell_unkept(struct editor *editor, bool unkept)
{
    editor->core.unshown |= unkept != editor->core.unkept;
    editor->core.unkept = unkept;
}

void editor_refresh(struct editor *editor)
{
    core_refresh(&editor->core);
    editor_settle(editor);
}

void editor_show_last(struct editor *editor)
{
    inspector_show_rig(editor->inspector, editor->core.document->rig_count - 1);
    editor->core.refit_stage = true;
}
