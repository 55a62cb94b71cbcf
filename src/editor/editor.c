/// The editor's public functions: who gets an event, and what happens once a frame.
#include "editor/core/actions.h"
#include "editor/core/arrange.h"
#include "editor/curves/curves.h"
#include "editor/stage/follow.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_COMMANDS = 16384, MAX_POINTS = 1 << 18, MAX_TEXT = 1 << 16 };

static const double MESSAGE_SECONDS = 5;

struct editor *editor_create(struct error *error)
{
    struct editor *editor = calloc(1, sizeof *editor);
    if (!editor || !drawlist_create(&editor->list, MAX_COMMANDS, MAX_POINTS, MAX_TEXT)) {
        free(editor);
        fail(error, ERROR_ENVIRONMENT, "out of memory for the editor");
        return NULL;
    }
    editor->layout.stage_share = 400.0f / (720 - THEME_STATUS_HEIGHT);
    editor->layout.inspector_width = THEME_INSPECTOR_WIDTH;
    editor->view = (struct view){0, 120, -1, 1};
    editor->camera = camera_default();
    editor->active = -1;
    brush_init(&editor->brush);
    editor_resize(editor, 1280, 720, 1);
    return editor;
}

void editor_destroy(struct editor *editor)
{
    if (!editor) return;
    drawlist_destroy(&editor->list);
    free(editor->selection.bits);
    free(editor->hidden.bits);
    free(editor->solo.bits);
    free(editor->before_box.bits);
    free(editor->clipboard);
    brush_free(&editor->brush);
    free(editor->drag.originals);
    free(editor);
}

void editor_resize(struct editor *editor, float width, float height, float scale)
{
    editor->layout.window = (struct rect){0, 0, width > 1 ? width : 1, height > 1 ? height : 1};
    editor->scale = scale > 0 ? scale : 1;
    editor_layout(editor);
}

void editor_panels(const struct editor *editor, double *stage_share, double *inspector_width)
{
    *stage_share = (double)editor->layout.stage_share;
    *inspector_width = (double)editor->layout.inspector_width;
}

void editor_set_panels(struct editor *editor, double stage_share, double inspector_width)
{
    editor->layout.stage_share = (float)fmin(fmax(stage_share, 0), 1);
    editor->layout.inspector_width = (float)fmin(fmax(inspector_width, 0), 1e4);
    editor_layout(editor);
}

/// Ids are given in turn, so room for the next ones is taken along.
static bool reserve_selection(struct selection *selection, unsigned next_id)
{
    if (next_id < selection->capacity) return true;
    unsigned capacity = (next_id / 512 + 2) * 512;
    uint64_t *bits = realloc(selection->bits, capacity / 8);
    if (!bits) return false;
    memset((char *)bits + selection->capacity / 8, 0, (capacity - selection->capacity) / 8);
    selection->bits = bits;
    selection->capacity = capacity;
    return true;
}

static bool reserve_drag(struct drag *drag, int knots)
{
    if (drag->capacity > 0 && knots <= drag->capacity) return true;
    int capacity = knots + knots / 2 + 64;
    struct knot *originals = realloc(drag->originals, (size_t)capacity * sizeof *originals);
    if (!originals) return false;
    drag->originals = originals;
    drag->capacity = capacity;
    return true;
}

void editor_reserve(struct editor *editor, const struct document *document)
{
    int most = 0;
    for (int s = 0; s < document->spline_count; s++) {
        if (document->splines[s].knot_count > most) most = document->splines[s].knot_count;
    }
    bool enough = reserve_selection(&editor->selection, document->next_id);
    enough &= reserve_selection(&editor->before_box, document->next_id);
    enough &= reserve_selection(&editor->hidden, document->next_spline_id);
    enough &= reserve_selection(&editor->solo, document->next_spline_id);
    if (!reserve_drag(&editor->drag, most) || !enough) {
        editor_message(editor, true, "Out of memory: some knots cannot be selected.");
    }
}

/// The spline to begin with: the first that moves something, else the first; -1 where there is none.
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

void editor_open(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    selection_clear(&editor->selection);
    editor->drag.kind = DRAG_NONE;
    editor->ghost.visible = false;
    editor->hover = (struct hover){0};
    memset(editor->follow, 0, sizeof editor->follow);
    editor->cache.key = 0;
    editor->cache.range_count = 0;
    editor->warnings = (struct warnings){0};
    editor->fitted = false;
    editor->look = LOOK_WIGGLY;
    characters_open(editor, document);
    editor->active = first_spline(document);
    editor->active_id = editor->active >= 0 ? document->splines[editor->active].id : 0;
    selection_clear(&editor->hidden);
    selection_clear(&editor->solo);
    editor->seen_first = document->first_frame;
    editor->seen_substeps = document->substeps;
    editor->held_key = 0;
    editor->space_down = false;
    editor->message = (struct message){0};
    editor->playback = (struct playback){.looping = true, .speed = 1};
    for (int s = 0; s < document->spline_count; s++) {
        editor->playback.playing |= spline_start(&document->splines[s]) == WIGGLY_LOOP;
    }
    editor->serial = document->serial;
    editor_reserve(editor, document);
    inspector_reset(editor);
    editor_set_path(editor, document->path ? document->path : "");
}

void editor_follow(struct editor *editor, const struct editor_world *world)
{
    if (editor->serial != world->document->serial) {
        editor_open(editor, world);
    } else {
        arrange_follow(editor, world);
    }
}

void editor_set_path(struct editor *editor, const char *path)
{
    const char *slash = strrchr(path, '/');
    snprintf(editor->path, sizeof editor->path, "%s", path);
    snprintf(editor->title, sizeof editor->title, "%s", path[0] ? (slash ? slash + 1 : path) : "untitled");
}

void editor_set_stage_scale(struct editor *editor, float scale) { editor->stage_scale = scale; }

void editor_set_stats(struct editor *editor, double fps, double solve_us)
{
    editor->fps = fps;
    editor->solve_us = solve_us;
}

struct edit editor_edit_of(enum edit_kind kind, int spline)
{
    return (struct edit){.kind = kind, .spline = spline, .param.track = -1};
}

bool editor_edit(struct editor *editor, const struct editor_world *world, const struct edit *edit)
{
    struct error error = {0};
    if (history_apply(world->history, world->document, edit, &error)) {
        editor_follow(editor, world);
        return true;
    }
    editor_message(editor, true, error.text);
    return false;
}

bool editor_step(struct editor *editor, const struct editor_world *world, const char *label, uint64_t merge,
                 const struct edit *edit)
{
    if (history_is_open(world->history))
        return false; /* a drag is running: its step is not to be mixed with others */
    history_begin(world->history, label, merge);
    bool done = editor_edit(editor, world, edit);
    history_end(world->history);
    return done;
}

void editor_undo(struct editor *editor, const struct editor_world *world)
{
    if (history_is_open(world->history)) return;
    const char *label = history_undo_label(world->history);
    char text[128];
    snprintf(text, sizeof text, label ? "Undone: %s" : "Nothing to undo", label);
    history_undo(world->history, world->document);
    editor_follow(editor, world);
    editor_message(editor, false, text);
}

void editor_redo(struct editor *editor, const struct editor_world *world)
{
    if (history_is_open(world->history)) return;
    const char *label = history_redo_label(world->history);
    char text[128];
    snprintf(text, sizeof text, label ? "Redone: %s" : "Nothing to redo", label);
    history_redo(world->history, world->document);
    editor_follow(editor, world);
    editor_message(editor, false, text);
}

void editor_jump(struct editor *editor, const struct editor_world *world, size_t done)
{
    if (history_is_open(world->history)) return;
    size_t before = history_done(world->history), steps = before > done ? before - done : done - before;
    if (!history_jump(world->history, world->document, done)) return;
    editor_follow(editor, world);
    char text[64];
    snprintf(text, sizeof text, "%s %zu step%s", before > done ? "Undone:" : "Redone:", steps, steps == 1 ? "" : "s");
    editor_message(editor, false, text);
}

void editor_request(struct editor *editor, enum request_kind kind, const char *path)
{
    if (editor->request_count == EDITOR_MAX_REQUESTS) return;
    struct request *request = &editor->requests[editor->request_count++];
    request->kind = kind;
    snprintf(request->path, sizeof request->path, "%s", path ? path : "");
}

void editor_request_figure(struct editor *editor, int number)
{
    int at = editor->request_count;
    editor_request(editor, REQUEST_FIGURE, NULL);
    if (editor->request_count > at) editor->requests[at].number = number;
}

struct request editor_take_request(struct editor *editor)
{
    struct request taken = {.kind = REQUEST_NONE};
    if (editor->request_count == 0) return taken;
    taken = editor->requests[0];
    editor->request_count--;
    memmove(&editor->requests[0], &editor->requests[1], (size_t)editor->request_count * sizeof taken);
    return taken;
}

void editor_answer(struct editor *editor, const struct request *request, bool ok, const char *text)
{
    if (!dialog_answer(editor, request, ok, text) && !ok) editor_message(editor, true, text);
}

void editor_message(struct editor *editor, bool is_error, const char *text)
{
    snprintf(editor->message.text, sizeof editor->message.text, "%s", text);
    editor->message.is_error = is_error;
    editor->message.seconds_left = is_error ? 0 : MESSAGE_SECONDS;
}

struct spline *editor_active_spline(const struct editor *editor, const struct editor_world *world)
{
    bool exists = editor->active >= 0 && editor->active < world->document->spline_count;
    return exists ? &world->document->splines[editor->active] : NULL;
}

void editor_activate(struct editor *editor, const struct editor_world *world, int spline)
{
    if (spline == editor->active || spline < 0 || spline >= world->document->spline_count) return;
    normal_activate(editor, spline);
    editor->active = spline;
    editor->active_id = world->document->splines[spline].id;
    selection_clear(&editor->selection);
    int tail, channel;
    const struct channel *moved = active_channel(editor, world->document, &tail, &channel);
    if (!moved || moved->spline != spline) return;
    editor->inspector.tail = tail;
    editor->inspector.channel = channel;
}

void editor_set_look(struct editor *editor, enum look look)
{
    static const char *const texts[] = {
        [LOOK_WIGGLY] = "Wiggly: one spline, each joint with its own phase",
        [LOOK_STIFF] = "Stiff: the same spline without lag",
        [LOOK_CUBIC] = "Cubic: the same knots as a classical spline",
    };
    editor->look = look;
    editor_message(editor, false, texts[look]);
}

enum look editor_look(const struct editor *editor) { return editor->look; }

bool editor_is_playing(const struct editor *editor) { return editor->playback.playing; }

bool editor_wants_frames(const struct editor *editor)
{
    return editor->playback.playing || editor->drag.kind == DRAG_GRAB || editor->drag.kind == DRAG_PAINT ||
           follow_is_moving(editor) || editor->message.seconds_left > 0 || editor->warnings.search.running;
}

double editor_frame(const struct editor *editor, const struct document *document)
{
    return document->first_frame + editor->playback.position / document->substeps;
}

const struct drawlist *editor_drawlist(const struct editor *editor) { return &editor->list; }

const struct stage_view *editor_stage(const struct editor *editor) { return &editor->stage; }
