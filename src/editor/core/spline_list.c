/// Adds, removes, reorders and retimes splines.
#include "base/names.h"
#include "editor/core/core.h"
#include "editor/core/rigs.h"
#include "editor/core/selection.h"
#include "scene/order.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

uint32_t spline_list_color(const struct document *document, int spline)
{
    if (spline < 0 || spline >= document->spline_count) return theme()->spline[0];
    int color = document->splines[spline]->color;
    return color < 0 ? theme()->spline[spline % THEME_SPLINE_COLORS] : theme_spline((uint32_t)color);
}

static bool any_solo(const struct core *core)
{
    for (int s = 0; s < core->document->spline_count; s++) {
        if (selection_has(&core->solo, core->document->splines[s]->id)) return true;
    }
    return false;
}

bool spline_list_shows(const struct core *core, int spline)
{
    if (spline < 0 || spline >= core->document->spline_count) return false;
    unsigned id = core->document->splines[spline]->id;
    if (any_solo(core)) return selection_has(&core->solo, id);
    return !selection_has(&core->hidden, id);
}

void spline_list_flip(struct core *core, struct selection *set, int spline)
{
    const unsigned id = core->document->splines[spline]->id;
    selection_set(set, id, !selection_has(set, id));
    core->visibility++;
}

const struct spline *spline_list_seen(const struct core *core)
{
    return spline_list_shows(core, core->active) ? core_active_spline(core) : NULL;
}

static void find_active(struct core *core)
{
    const struct document *document = core->document;
    int found = document_find_spline_id(document, core->active_id);
    if (found < 0) {
        int last = document->spline_count - 1;
        found = core->active > last ? last : core->active < 0 && last >= 0 ? 0 : core->active;
        core->active_id = found >= 0 ? document->splines[found]->id : 0;
        selection_clear(&core->selection);
    }
    core->active = found;
}

void spline_list_refresh(struct core *core)
{
    const struct document *document = core->document;
    const struct spline *active = core_active_spline(core);
    bool same = core->evaluation && core->evaluation->count == document->spline_count;
    if (!same || !active || active->id != core->active_id) {
        find_active(core);
        core->hover = (struct hover){0};
    }
    double frame = core->seen_first + core->playback.position / core->seen_substeps;
    bool moved = core->seen_first != document->first_frame || core->seen_substeps != document->substeps;
    if (moved) core->playback.position = (frame - document->first_frame) * document->substeps;
    core->playback.position = fmax(0, fmin(core->playback.position, document_samples(document) - 1));
    core->seen_first = document->first_frame;
    core->seen_substeps = document->substeps;
    core->pick = (struct bone_pick){0};
}

void spline_list_add(struct core *core)
{
    struct document *document = core->document;
    const double frame = round(core_frame(core));
    const struct knot first = {.frame = fmax(document->first_frame, fmin(frame, document->last_frame))};
    if (core_step(core, "Add spline", 0) && edit_spline_add(document, -1, NULL, &first, &core->error))
        core_activate(core, document->spline_count - 1);
}

void spline_list_copy(struct core *core)
{
    if (!core_active_spline(core) || !core_step(core, "Duplicate spline", 0)) return;
    if (edit_spline_copy(core->document, core->active, &core->error)) core_activate(core, core->active + 1);
}

void spline_list_move(struct core *core, int spline, int to)
{
    if (to == spline || to < 0 || to >= core->document->spline_count) return;
    if (core_step(core, "Reorder splines", 0)) edit_spline_move(core->document, spline, to, &core->error);
}

double spline_list_present(const struct core *core, int spline, enum parameter parameter)
{
    const struct spline *follower = core->document->splines[spline];
    const struct param *param = &follower->parameter[parameter];
    wiggly_value v = evaluation_at(core->evaluation, param->motion ? spline : param->track, core->playback.position);
    double now = param->motion ? v.y : v.y + v.re, value = isfinite(now) ? now : parameter_rows[parameter].standard;
    return parameter_clamped(parameter, spline_mode(follower), value);
}

/// Finds the last reference to a spline. Removing the last one first keeps the others' indices valid. false: none.
static bool last_reference(const struct document *document, int spline, struct reference *last)
{
    bool found = false;
    for (struct reference reference = {0}; reference_next(document, &reference);) {
        if (reference.spline != spline) continue;
        found = true;
        *last = reference;
    }
    return found;
}

/// Stops something from following the active spline.
static bool release(struct core *core, const struct reference *reference)
{
    struct document *document = core->document;
    const int owner = reference->owner, which = reference->which;
    const wiggly_value now = evaluation_at(core->evaluation, core->active, core->playback.position);
    switch (reference->kind) {
    case REFERENCE_TRACK: {
        const enum parameter parameter = (enum parameter)which;
        return core_set_parameter(core, owner, parameter, spline_list_present(core, owner, parameter));
    }
    case REFERENCE_POSITION: {
        struct rig changed = *document->rigs[owner];
        changed.tail.position[which] = param_number(now.y + now.re);
        return edit_rig_set(document, owner, &changed, &core->error);
    }
    case REFERENCE_CHANNEL:
        return edit_channel_remove(document, (struct channel_place){owner, which}, &core->error);
    case REFERENCE_DRIVE:
        return edit_drive_remove(document, owner, which, &core->error);
    }
    return false;
}

static void remove_active(void *dialogs, struct core *core, int answer)
{
    (void)dialogs;
    (void)answer;
    if (!core_active_spline(core) || !core_step(core, "Delete spline", 0)) return;
    struct reference reference;
    bool good = true;
    while (good && last_reference(core->document, core->active, &reference)) {
        good = release(core, &reference);
    }
    if (good) edit_spline_remove(core->document, core->active, &core->error);
    core_refresh(core); // the rest of this event needs an active spline
}

void spline_list_remove(struct core *core)
{
    static const struct answer answers[] = {{"dialog.delete", "Delete", 'D'}, {"dialog.cancel", "Cancel", 'C'}};
    const struct spline *active = core_active_spline(core);
    if (!active) return;
    const int count = reference_count(core->document, core->active);
    if (count == 0) {
        remove_active(NULL, core, 0);
        return;
    }
    struct question *question = core_ask(core, answers, 2, remove_active);
    snprintf(question->title, sizeof question->title, "%.*s is used in %d place%s", name_fit(active->name, 200),
             active->name, count, count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note,
             "Parameters that follow it keep their value at the playhead. Channels that it drives are deleted.");
}

static void set_fps(struct core *core, double fps, bool keeps_seconds)
{
    if (core_step(core, "Set frames per second", 0)) edit_fps(core->document, fps, keeps_seconds, &core->error);
}

static void answer_fps(void *dialogs, struct core *core, int answer)
{
    (void)dialogs;
    set_fps(core, core->subject.fps, answer == 1);
}

void spline_list_fps(struct core *core, double fps)
{
    static const struct answer answers[] = {{"dialog.frames", "Keep frames", 'F'},
                                            {"dialog.seconds", "Keep seconds", 'S'},
                                            {"dialog.cancel", "Cancel", 'C'}};
    const double before = core->document->fps;
    if (fps == before) return;
    if (!rigs_have_knots(core->document) || !(fps > 0 && fps <= SCENE_MAX_FPS)) {
        set_fps(core, fps, false);
        return;
    }
    struct question *question = core_ask(core, answers, 3, answer_fps);
    core->subject.fps = fps;
    snprintf(question->title, sizeof question->title, "%g frames per second instead of %g", fps, before);
    snprintf(
        question->note, sizeof question->note,
        "Keep frames: knots stay on their frames, and everything plays %s. Keep seconds: knots and range move to "
        "new frames and the timing stays.",
        fps > before ? "faster" : "slower");
}

static void set_range(struct core *core, int first, int last, enum range_fit fit)
{
    if (core_step(core, "Set range", 0)) edit_range(core->document, first, last, fit, &core->error);
}

static int count_outside(const struct document *document, int first, int last)
{
    struct document moved = *document;
    int count = 0;
    moved.first_frame = first;
    moved.last_frame = last;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        int end = document_last_knot_sample(&moved, spline);
        for (int k = 0; k < spline->knot_count; k++) {
            int sample = document_sample(&moved, spline->knots[k].frame);
            count += sample < 0 || sample > end;
        }
    }
    return count;
}

static void answer_range(void *dialogs, struct core *core, int answer)
{
    (void)dialogs;
    set_range(core, core->subject.first, core->subject.last, answer == 0 ? RANGE_MOVE : RANGE_TRIM);
}

void spline_list_range(struct core *core, int first, int last)
{
    static const struct answer answers[] = {
        {"dialog.move", "Move", 'M'}, {"dialog.trim", "Trim", 'T'}, {"dialog.cancel", "Cancel", 'C'}};
    const bool possible = last >= first && last <= SCENE_MAX_FRAME && first >= -SCENE_MAX_FRAME &&
                          (long long)last - first <= document_longest(core->document);
    const int count = possible ? count_outside(core->document, first, last) : 0;
    if (count == 0) {
        set_range(core, first, last, RANGE_REFUSE);
        return;
    }
    struct question *question = core_ask(core, answers, 3, answer_range);
    core->subject.first = first;
    core->subject.last = last;
    snprintf(question->title, sizeof question->title, "%d knot%s would fall outside frames %d to %d", count,
             count == 1 ? "" : "s", first, last);
    snprintf(question->note, sizeof question->note,
             "Move shifts them to the nearest free frames inside. Trim deletes them.");
}
