/// The editor's public functions: who gets an event, and what happens once a frame.
#include "editor/editor.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/curves/curves.h"
#include "editor/dialogs/dialog_files.h"
#include "editor/dialogs/dialogs.h"
#include "editor/inspector/inspector.h"
#include "editor/stage/stage.h"
#include "editor/state.h"
#include "editor/transport/transport.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COMMANDS = 16384, MAX_POINTS = 1 << 18, MAX_TEXT = 1 << 16 };

struct editor *editor_create(void)
{
    struct editor *editor = need_zeroed(1, sizeof *editor);
    drawlist_create(&editor->core.list, MAX_COMMANDS, MAX_POINTS, MAX_TEXT);
    editor->curves = curves_create();
    editor->stage = stage_create();
    editor->inspector = inspector_create(&editor->core);
    editor->dialogs = dialogs_create();
    editor->transport = transport_create();
    editor->core.layout.stage_share = 400.0f / (720 - THEME_STATUS_HEIGHT);
    editor->core.layout.inspector_width = THEME_INSPECTOR_WIDTH;
    editor->core.visible = 2;
    editor->core.active = -1;
    editor->core.ui_scale = 1;
    editor->core.brush = (struct brush){.radius = 0.12, .strength = 0.4};
    editor->core.overlays.ghost = true;
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
    transport_destroy(editor->transport);
    drawlist_destroy(&editor->core.list);
    free(editor->core.selection.bits);
    free(editor->core.hidden.bits);
    free(editor->core.solo.bits);
    free(editor->core.clipboard);
    free(editor->core.originals.list);
    free(editor);
}

void editor_resize(struct editor *editor, float width, float height, float scale)
{
    editor->core.layout.window = (struct rect){0, 0, width > 1 ? width : 1, height > 1 ? height : 1};
    const float before = editor->core.scale, now = scale > 0 ? scale : 1;
    if (before > 0) { // the pointer stays where it is on the screen
        editor->core.pointer_x *= before / now;
        editor->core.pointer_y *= before / now;
    }
    editor->core.scale = now;
    core_layout(&editor->core);
}

void editor_panels(const struct editor *editor, double *stage_share, double *inspector_width)
{
    *stage_share = (double)editor->core.layout.stage_share;
    *inspector_width = (double)editor->core.layout.inspector_width;
}

void editor_set_panels(struct editor *editor, double stage_share, double inspector_width)
{
    editor->core.layout.stage_share = (float)fmin(fmax(stage_share, 0), 1);
    editor->core.layout.inspector_width = (float)fmin(fmax(inspector_width, 0), 1e4);
    core_layout(&editor->core);
}

/// The panels start anew with a document.
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
    if (editor->seen.serial != core->serial) open_panels(editor);
    if (editor->seen.active == core->active_id) return;
    const int before = document_find_spline_id(editor->core.document, editor->seen.active);
    editor->seen.active = core->active_id;
    if (core->active < 0) return;
    if (before >= 0) curves_activate(editor->curves, core, before);
    inspector_show_spline(editor->inspector, core->active);
}

void editor_show_poles(struct editor *editor) { inspector_unfold(editor->inspector, "section.poles"); }

void editor_set_path(struct editor *editor, const char *path) { core_set_path(&editor->core, path); }

void editor_set_stage_scale(struct editor *editor, float scale) { transport_tell_scale(editor->transport, scale); }

void editor_set_stats(struct editor *editor, double fps, double solve_us)
{
    transport_tell(editor->transport, fps, solve_us);
}

struct request editor_take_request(struct editor *editor)
{
    const struct request taken = editor->core.request;
    editor->core.request = (struct request){.kind = REQUEST_NONE};
    return taken;
}

void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text)
{
    if (!dialogs_answer(editor->dialogs, &editor->core, request, ok, text) && !ok)
        core_message(&editor->core, true, text);
}

enum look editor_look(const struct editor *editor) { return editor->core.look; }

bool editor_is_playing(const struct editor *editor) { return editor->core.playback.playing; }

bool editor_wants_frames(const struct editor *editor)
{
    const struct drag_owner *dragged = editor->core.drag.owner;
    return editor->core.playback.playing || (dragged && dragged->goes_on) || stage_is_moving(editor->stage) ||
           editor->core.message.seconds_left > 0 || editor->core.unshown || editor->core.nudged_seconds > 0 ||
           presenter_is_sliding(&editor->core) || dialogs_want_frames(editor->dialogs, &editor->core) ||
           curves_wants_frames(editor->curves) || tooltip_waits(&editor->tooltip);
}

bool editor_is_presenting(const struct editor *editor) { return editor->core.presenter.on; }

void editor_tell_ui_scale(struct editor *editor, double scale) { editor->core.ui_scale = scale; }

const struct drawlist *editor_drawlist(const struct editor *editor) { return &editor->core.list; }

const struct stage_view *editor_stage(const struct editor *editor) { return stage_seen(editor->stage); }

void editor_message(struct editor *editor, bool is_error, const char *text)
{
    core_message(&editor->core, is_error, text);
}

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

const char *editor_clipboard(const struct editor *editor)
{
    return editor->core.clipboard ? editor->core.clipboard : "";
}

void editor_set_files(struct editor *editor, const struct dialog_files *files)
{
    dialogs_set_files(editor->dialogs, files);
}

void editor_set_export(struct editor *editor, const struct export_memory *memory)
{
    dialogs_set_export(editor->dialogs, memory);
}

void editor_tell_export(struct editor *editor, long done, long total)
{
    dialogs_tell_export(editor->dialogs, done, total);
}

void editor_offer_recovery(struct editor *editor, const struct recovery_offer *offer)
{
    dialogs_offer_recovery(editor->dialogs, offer);
}

bool editor_ask_changed(struct editor *editor, const char *name, bool saving)
{
    if (!saving && editor->core.drag.owner) return false;
    return dialogs_ask_changed(editor->dialogs, name, saving);
}

void editor_welcome(struct editor *editor) { dialogs_welcome(editor->dialogs); }

bool editor_is_welcoming(const struct editor *editor) { return dialogs_is_welcoming(editor->dialogs); }

int editor_active(const struct editor *editor)
{
    return editor->core.active < editor->core.document->spline_count ? editor->core.active : -1;
}
