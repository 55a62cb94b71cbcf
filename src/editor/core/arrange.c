#include "editor/core/arrange.h"
#include "editor/curves/curves.h"
#include "scene/reference.h"
#include "ui/theme.h"
#include <math.h>
#include <stdlib.h>

uint32_t arrange_color(const struct document *document, int spline)
{
    if (spline < 0 || spline >= document->spline_count) return theme()->spline[0];
    int color = document->splines[spline].color;
    return color < 0 ? theme()->spline[spline % THEME_SPLINE_COLORS] : theme_spline((uint32_t)color);
}

static bool any_solo(const struct editor *editor, const struct document *document)
{
    for (int s = 0; s < document->spline_count; s++) {
        if (selection_has(&editor->solo, document->splines[s].id)) return true;
    }
    return false;
}

bool arrange_shows(const struct editor *editor, const struct document *document, int spline)
{
    if (spline < 0 || spline >= document->spline_count) return false;
    unsigned id = document->splines[spline].id;
    if (any_solo(editor, document)) return selection_has(&editor->solo, id);
    return !selection_has(&editor->hidden, id);
}

const struct spline *arrange_seen(const struct editor *editor, const struct editor_world *world)
{
    return arrange_shows(editor, world->document, editor->active) ? editor_active_spline(editor, world) : NULL;
}

static void find_active(struct editor *editor, const struct document *document)
{
    int found = document_find_spline_id(document, editor->active_id);
    if (found < 0) {
        int last = document->spline_count - 1;
        found = editor->active > last ? last : editor->active < 0 && last >= 0 ? 0 : editor->active;
        editor->active_id = found >= 0 ? document->splines[found].id : 0;
        selection_clear(&editor->selection);
    }
    editor->active = found;
}

void arrange_follow(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    const struct spline *active = editor_active_spline(editor, world);
    bool same = world->evaluation && world->evaluation->count == document->spline_count;
    if (!same || !active || active->id != editor->active_id) {
        find_active(editor, document);
        editor->hover = (struct hover){0};
        editor->cache.key = 0; // it names splines by index
        editor->cache.other_count = editor->cache.count = 0;
    }
    double frame = editor->seen_first + editor->playback.position / editor->seen_substeps;
    bool moved = editor->seen_first != document->first_frame || editor->seen_substeps != document->substeps;
    if (moved) editor->playback.position = (frame - document->first_frame) * document->substeps;
    editor->playback.position = fmax(0, fmin(editor->playback.position, document_samples(document) - 1));
    editor->seen_first = document->first_frame;
    editor->seen_substeps = document->substeps;
    editor_reserve(editor, document);
}

void arrange_add(struct editor *editor, const struct editor_world *world)
{
    const struct document *document = world->document;
    double frame = round(editor_frame(editor, document));
    struct edit edit = editor_edit_of(EDIT_SPLINE_ADD, -1);
    edit.flag = true;
    edit.knot.frame = fmax(document->first_frame, fmin(frame, document->last_frame));
    if (!editor_step(editor, world, "Add spline", 0, &edit)) return;
    editor_activate(editor, world, document->spline_count - 1);
}

void arrange_copy(struct editor *editor, const struct editor_world *world)
{
    struct edit edit = editor_edit_of(EDIT_SPLINE_COPY, editor->active);
    if (!editor_active_spline(editor, world)) return;
    if (editor_step(editor, world, "Duplicate spline", 0, &edit)) editor_activate(editor, world, editor->active + 1);
}

void arrange_move(struct editor *editor, const struct editor_world *world, int spline, int to)
{
    struct edit edit = editor_edit_of(EDIT_SPLINE_MOVE, spline);
    edit.to = to;
    if (to != spline && to >= 0 && to < world->document->spline_count) {
        editor_step(editor, world, "Reorder splines", 0, &edit);
    }
}

void arrange_remove(struct editor *editor, const struct editor_world *world)
{
    if (!editor_active_spline(editor, world)) return;
    if (reference_count(world->document, editor->active) == 0) {
        arrange_remove_now(editor, world);
        return;
    }
    dialog_ask(editor, world, &(struct ask){.kind = ASK_REMOVE});
}

double arrange_present(const struct editor *editor, const struct editor_world *world, int spline,
                       enum parameter parameter)
{
    const struct spline *follower = &world->document->splines[spline];
    wiggly_value v = curves_solved(world, follower->parameter[parameter].track, editor->playback.position);
    double value = isfinite(v.y + v.re) ? v.y + v.re : parameter_rows[parameter].standard;
    return parameter_clamped(parameter, spline_mode(follower), value);
}

/// Finds the last place that follows a spline, so that letting go of it moves no other place.
struct search {
    int spline;
    bool found;
    struct reference reference;
};

static void find_reference(const struct reference *reference, void *context)
{
    struct search *search = context;
    if (*reference->spline != search->spline) return;
    search->found = true;
    search->reference = *reference;
}

/// The edit after which a place does not follow the active spline any more.
static struct edit release_edit(const struct editor *editor, const struct editor_world *world,
                                const struct reference *reference)
{
    struct edit edit = editor_edit_of(EDIT_PARAMETER, reference->owner);
    wiggly_value v = curves_solved(world, editor->active, editor->playback.position);
    edit.rig = reference->owner;
    switch (reference->kind) {
    case REFERENCE_TRACK:
        edit.parameter = (enum parameter)reference->which;
        edit.param.value = arrange_present(editor, world, reference->owner, edit.parameter);
        break;
    case REFERENCE_POSITION:
        edit.kind = EDIT_POSITION;
        edit.coordinate = reference->which;
        edit.param.value = v.y + v.re;
        break;
    case REFERENCE_CHANNEL:
        edit.kind = EDIT_CHANNEL_REMOVE;
        edit.channel = reference->which;
        break;
    case REFERENCE_DRIVE:
        edit.kind = EDIT_DRIVE_REMOVE;
        edit.channel = reference->which;
        break;
    }
    return edit;
}

void arrange_remove_now(struct editor *editor, const struct editor_world *world)
{
    if (!editor_active_spline(editor, world) || history_is_open(world->history)) return;
    bool good = true;
    history_begin(world->history, "Delete spline", 0);
    for (struct search search = {.found = true}; good && search.found;) {
        search = (struct search){.spline = editor->active};
        reference_each(world->document, find_reference, &search);
        if (!search.found) break;
        struct edit release = release_edit(editor, world, &search.reference);
        good = editor_edit(editor, world, &release);
    }
    struct edit edit = editor_edit_of(EDIT_SPLINE_REMOVE, editor->active);
    good = good && editor_edit(editor, world, &edit);
    if (!good) history_restart(world->history, world->document);
    history_end(world->history);
    arrange_follow(editor, world);
}

static int knot_count(const struct document *document)
{
    int count = 0;
    for (int s = 0; s < document->spline_count; s++) count += document->splines[s].knot_count;
    return count;
}

void arrange_fps(struct editor *editor, const struct editor_world *world, double fps)
{
    struct edit edit = editor_edit_of(EDIT_FPS, -1);
    edit.number = fps;
    if (fps == world->document->fps) return;
    if (knot_count(world->document) == 0 || !(fps > 0 && fps <= SCENE_MAX_FPS)) {
        editor_step(editor, world, "Set frames per second", 0, &edit);
    } else {
        dialog_ask(editor, world, &(struct ask){.kind = ASK_FPS, .number = fps});
    }
}

int arrange_outside(const struct document *document, int first, int last)
{
    struct document moved = *document;
    int count = 0;
    moved.first_frame = first;
    moved.last_frame = last;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = &document->splines[s];
        int end = document_last_knot_sample(&moved, spline);
        for (int k = 0; k < spline->knot_count; k++) {
            int sample = document_sample(&moved, spline->knots[k].frame);
            count += sample < 0 || sample > end;
        }
    }
    return count;
}

void arrange_range(struct editor *editor, const struct editor_world *world, int first, int last)
{
    struct edit edit = editor_edit_of(EDIT_RANGE, -1);
    edit.first = first;
    edit.last = last;
    bool possible = last >= first && last <= SCENE_MAX_FRAME && first >= -SCENE_MAX_FRAME;
    if (possible && arrange_outside(world->document, first, last) > 0) {
        dialog_ask(editor, world, &(struct ask){.kind = ASK_RANGE, .first = first, .last = last});
    } else {
        editor_step(editor, world, "Set range", 0, &edit);
    }
}
