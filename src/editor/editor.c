/// The editor's public functions: who gets an event, and what happens once a frame.
#include "editor/editor.h"
#include "base/path.h"
#include "editor/core/bones.h"
#include "editor/core/characters.h"
#include "editor/core/core.h"
#include "editor/core/knots.h"
#include "editor/core/pins.h"
#include "editor/core/presenter.h"
#include "editor/core/selection.h"
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

/// Passes core's news on to the panels.
static void hear(void *who, const struct editor_world *world, enum news news, int spline)
{
    struct editor *editor = who;
    switch (news) {
    case NEWS_OPENED:
        editor_open(editor, world);
        break;
    case NEWS_RENUMBERED:
        curves_forget(editor->curves);
        break;
    case NEWS_ACTIVATES:
        curves_activate(editor->curves, &editor->core, spline);
        break;
    case NEWS_ACTIVATED:
        inspector_show_spline(editor->inspector, &editor->core, world->document, spline);
        break;
    case NEWS_EDITED:
        curves_follow(editor->curves, spline);
        break;
    }
}

struct editor *editor_create(struct error *error)
{
    struct editor *editor = calloc(1, sizeof *editor);
    bool good = editor != NULL;
    if (good) {
        drawlist_create(&editor->core.list, MAX_COMMANDS, MAX_POINTS, MAX_TEXT);
        editor->curves = curves_create();
        editor->stage = stage_create();
        editor->inspector = inspector_create();
        editor->dialogs = dialogs_create();
        editor->transport = transport_create();
        good = editor->curves && editor->stage && editor->inspector && editor->dialogs && editor->transport;
    }
    if (!good) {
        editor_destroy(editor);
        fail(error, ERROR_ENVIRONMENT, "out of memory for the editor");
        return NULL;
    }
    editor->core.layout.stage_share = 400.0f / (720 - THEME_STATUS_HEIGHT);
    editor->core.layout.inspector_width = THEME_INSPECTOR_WIDTH;
    editor->core.visible = 2;
    editor->core.active = -1;
    editor->core.ui_scale = 1;
    editor->core.brush = (struct brush){.radius = 0.12, .strength = 0.4};
    editor->core.overlays.ghost = true;
    editor->core.listener = (struct listener){hear, editor};
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

/// The spline that is active first: the first that moves something, else the first; -1 if there is none.
static int first_spline(const struct document *document)
{
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        int r = document_next_rig(document, (enum rig_kind)kind, 0);
        for (; r >= 0; r = document_next_rig(document, (enum rig_kind)kind, r + 1)) {
            if (rig_input_count(&document->rigs[r]) > 0) return rig_input(&document->rigs[r], 0);
        }
    }
    return document->spline_count > 0 ? 0 : -1;
}

void editor_reserve(struct editor *editor, const struct document *document)
{
    core_reserve(&editor->core, document);
    if (!curves_reserve(editor->curves, &editor->core))
        core_message(&editor->core, true, "Out of memory: no box can be taken back.");
}

void editor_open(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    selection_clear(&editor->core.selection);
    editor->core.drag = (struct drag){0};
    editor->core.hover = (struct hover){0};
    curves_open(editor->curves);
    stage_open(editor->stage);
    editor->fitted = false;
    editor->core.look = LOOK_WIGGLY;
    characters_open(&editor->core, document);
    bones_clear(&editor->core);
    pins_clear(&editor->core);
    editor->core.pick = (struct bone_pick){0};
    memset(editor->core.recent, 0, sizeof editor->core.recent);
    editor->core.active = first_spline(document);
    editor->core.active_id = editor->core.active >= 0 ? document->splines[editor->core.active].id : 0;
    selection_clear(&editor->core.hidden);
    selection_clear(&editor->core.solo);
    editor->core.seen_first = document->first_frame;
    editor->core.seen_substeps = document->substeps;
    editor->core.held_key = 0;
    editor->core.space_down = false;
    editor->core.message = (struct message){0};
    editor->core.playback = (struct playback){.looping = true, .speed = 1, .playing = document->about != NULL};
    for (int s = 0; s < document->spline_count; s++) {
        editor->core.playback.playing |= spline_start(&document->splines[s]) == WIGGLY_LOOP;
    }
    editor->core.auto_key = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = &document->rigs[r];
        editor->core.playback.playing |= rig->kind == RIG_MODEL && rig->model.clip;
        for (int k = 0; k < 3 && rig->kind == RIG_TAIL; k++)
            editor->core.auto_key |= rig->tail.position[k].track >= 0; // who animates a body goes on to
    }
    editor->core.serial = document->serial;
    editor_reserve(editor, document);
    inspector_reset(editor->inspector);
    inspector_show_spline(editor->inspector, &editor->core, document, editor->core.active);
    editor_set_path(editor, document->path ? document->path : "");
}

void editor_show_poles(struct editor *editor) { inspector_unfold(editor->inspector, "section.poles"); }

void editor_set_path(struct editor *editor, const char *path)
{
    snprintf(editor->core.path, sizeof editor->core.path, "%s", path);
    snprintf(editor->core.title, sizeof editor->core.title, "%s", path[0] ? path_name(path) : "untitled");
}

void editor_set_stage_scale(struct editor *editor, float scale) { transport_tell_scale(editor->transport, scale); }

void editor_set_stats(struct editor *editor, double fps, double solve_us)
{
    transport_tell(editor->transport, fps, solve_us);
}

struct request editor_take_request(struct editor *editor)
{
    struct request taken = {.kind = REQUEST_NONE};
    if (editor->core.request_count == 0) return taken;
    taken = editor->core.requests[0];
    editor->core.request_count--;
    memmove(&editor->core.requests[0], &editor->core.requests[1], (size_t)editor->core.request_count * sizeof taken);
    return taken;
}

void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text)
{
    if (!dialogs_answer(editor->dialogs, &editor->core, request, ok, text) && !ok)
        core_message(&editor->core, true, text);
}

enum look editor_look(const struct editor *editor) { return editor->core.look; }

wiggly_method editor_method(const struct editor *editor) { return editor->core.method; }

void editor_set_method(struct editor *editor, wiggly_method method) { editor->core.method = method; }

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

void editor_refresh(struct editor *editor, const struct editor_world *world) { core_refresh(&editor->core, world); }

void editor_show_last(struct editor *editor, const struct editor_world *world)
{
    inspector_show_rig(editor->inspector, &editor->core, world, world->document->rig_count - 1);
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

int editor_active(const struct editor *editor, const struct document *document)
{
    return editor->core.active < document->spline_count ? editor->core.active : -1;
}
