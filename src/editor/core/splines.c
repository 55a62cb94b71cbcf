/// Edits of splines: their list, timing and parameters, and the frequency that explains their knots.
#include "base/names.h"
#include "editor/core/core.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void core_activate_neighbour(struct core *core, int direction)
{
    int count = core->document->spline_count;
    if (count > 0) core_choose(core, ((core->focus.active + direction) % count + count) % count);
}

bool spline_list_together(const struct document *document, int a, int b)
{
    if (a < 0 || b < 0 || a >= document->spline_count || b >= document->spline_count) return false;
    const char *one = document->splines[a]->folder, *other = document->splines[b]->folder;
    return one && other && strcmp(one, other) == 0;
}

/// Moves one of the chosen splines in an open step.
static void place(struct core *core, int spline, int to, const char *folder)
{
    if (edit_spline_move(core->document, spline, to, &core->step.error))
        edit_spline_folder(core->document, to, folder ? folder : "", &core->step.error);
}

void spline_list_place(struct core *core, int to, const char *folder)
{
    if (to < 0 || to > core->document->spline_count || !core_step(core, "Reorder splines", 0)) return;
    for (int s = to - 1, at = to; s >= 0; s--) { // from above, the last one first
        if (core_is_chosen(core, s)) place(core, s, --at, folder);
    }
    for (int s = to, at = to; s < core->document->spline_count; s++) {
        if (core_is_chosen(core, s)) place(core, s, at++, folder);
    }
}

bool spline_list_acts(const struct core *core, int first, int end, int spline)
{
    const bool among = spline >= first && spline < end;
    return among || (end == first + 1 && core_is_chosen(core, first) && core_is_chosen(core, spline));
}

void spline_list_flip(struct core *core, enum list_change change, int first, int end)
{
    struct selection *set = change == LIST_SOLO ? &core->view.solo : &core->view.hidden;
    const struct spline *of = core->document->splines[first];
    const bool locks = change == LIST_LOCK, on = locks ? !of->locked : !selection_has(set, of->id);
    if (locks && !core_step(core, on ? "Lock" : "Unlock", 0)) return;
    for (int s = 0; s < core->document->spline_count; s++) {
        if (!spline_list_acts(core, first, end, s)) continue;
        const struct spline *spline = core->document->splines[s];
        for (int k = 0; k < spline->knot_count && locks; k++)
            selection_set(&core->focus.selection, spline->knots[k].id, false);
        if (!locks) selection_set(set, spline->id, on);
        if (locks) edit_spline_lock(core->document, s, on, &core->step.error);
    }
    core->view.visibility++;
}

double spline_list_present(const struct core *core, int spline, enum parameter parameter)
{
    const struct spline *follower = core->document->splines[spline];
    const struct param *param = &follower->parameter[parameter];
    wiggly_value v =
        evaluation_at(core->evaluation, param->motion ? spline : param->track, core->view.playback.position);
    double now = param->motion ? v.y : v.y + v.re, value = isfinite(now) ? now : parameter_rows[parameter].standard;
    return parameter_clamped(parameter, spline_mode(follower), value);
}

/// Stops something from following a spline.
static bool release(struct core *core, const struct reference *reference)
{
    struct document *document = core->document;
    const int owner = reference->owner, which = reference->which;
    const wiggly_value now = evaluation_at(core->evaluation, reference->spline, core->view.playback.position);
    if (reference->kind == REFERENCE_TRACK)
        return core_set_parameter(core, owner, (enum parameter)which,
                                  spline_list_present(core, owner, (enum parameter)which));
    if (reference->kind == REFERENCE_CHANNEL)
        return edit_channel(document, (struct channel_place){owner, which}, NULL, &core->step.error);
    if (reference->kind == REFERENCE_DRIVE) return edit_drive(document, owner, which, NULL, &core->step.error);
    struct rig changed = *document->rigs[owner]; // its position
    changed.tail.position[which] = param_number(now.y + now.re);
    return edit_rig_set(document, owner, &changed, &core->step.error);
}

/// The last spline and the last reference go first, so that the indices of the others stay valid.
static void remove_chosen(void *of, int answer)
{
    struct core *core = of;
    (void)answer;
    bool good = core_active_spline(core) && core_step(core, "Delete spline", 0);
    for (int s = core->document->spline_count - 1; s >= 0 && good; s--) {
        if (!core_is_chosen(core, s)) continue;
        while (good && reference_count(core->document, s) > 0) {
            struct reference last = {0};
            for (struct reference reference = {0}; reference_next(core->document, &reference);) {
                if (reference.spline == s) last = reference;
            }
            good = release(core, &last);
        }
        good = good && edit_spline_remove(core->document, s, &core->step.error);
    }
    core_refresh(core); // the rest of this event needs an active spline
}

/// Deletes the chosen splines; asks if something follows them.
static void ask_remove(struct core *core, const struct spline *active)
{
    static const struct answer answers[] = {{"dialog.delete", "Delete", 'D'}, {"dialog.cancel", "Cancel", 'C'}};
    int count = 0;
    for (int s = 0; s < core->document->spline_count; s++)
        count += core_is_chosen(core, s) ? reference_count(core->document, s) : 0;
    if (count == 0) {
        remove_chosen(core, 0);
        return;
    }
    struct question *question = core_ask(core, answers, 2, remove_chosen);
    snprintf(question->title, sizeof question->title, "%.*s %s used in %d place%s", name_fit(active->name, 200),
             active->name, core_chosen_count(core) > 1 ? "and others are" : "is", count, count == 1 ? "" : "s");
    snprintf(question->note, sizeof question->note,
             "Parameters that follow keep their value at the playhead. Channels that are driven are deleted.");
}

void spline_list_change(struct core *core, int change)
{
    struct document *document = core->document;
    const struct spline *spline = core_active_spline(core);
    const int active = core->focus.active;
    if (change == LIST_ADD) {
        const double frame = round(core_frame(core));
        const struct knot first = {.frame = fmax(document->first_frame, fmin(frame, document->last_frame))};
        if (core_step(core, "Add spline", 0) && edit_spline_add(document, -1, NULL, &first, &core->step.error))
            core_activate(core, document->spline_count - 1);
    }
    if (!spline) return;
    if (change == LIST_COPY && core_step(core, "Duplicate", 0)) { // after them; the copies are chosen
        struct selection copies = {0};
        for (int s = document->spline_count - 1; s >= 0; s--) {
            if (core_is_chosen(core, s) && edit_spline_copy(document, s, &core->step.error))
                selection_set(&copies, document->splines[s + 1]->id, true);
        }
        selection_copy(&core->focus.selection, &copies);
        free(copies.bits);
        core_turn_to(core, document_find_spline_id(document, core->focus.active_id) + 1);
    }
    if (change == LIST_REMOVE) ask_remove(core, spline);
    if (change == LIST_UP || change == LIST_DOWN) { // by a row, into a folder if they come to lie within
        const int by = change == LIST_UP ? -1 : 1;
        int at = by < 0 ? 0 : document->spline_count - 1; // the first of them, or the last
        while (!core_is_chosen(core, at)) at -= by;
        const int next = at + by, to = by < 0 ? next : next + 1;
        const bool within = spline_list_together(document, at, next) || spline_list_together(document, to - 1, to);
        if (next >= 0 && next < document->spline_count)
            spline_list_place(core, to, within ? document->splines[next]->folder : NULL);
    }
    if (change == LIST_FOLDER) { // one called like the first of them; or if that is in one, behind it
        int first = 0, to;
        while (!core_is_chosen(core, first)) first++;
        for (to = first; spline_list_together(document, first, to);) to++;
        spline_list_place(core, to, to > first ? NULL : document->splines[first]->name);
    }
    if (change == LIST_SOLO || change == LIST_HIDE || change == LIST_LOCK)
        spline_list_flip(core, (enum list_change)change, active, active + 1);
}

static void answer_fps(void *of, int answer)
{
    struct core *core = of;
    if (core_step(core, "Set frames per second", 0))
        edit_fps(core->document, core->subject.fps, answer == 1, &core->step.error);
}

void spline_list_fps(struct core *core, double fps)
{
    static const struct answer answers[] = {{"dialog.frames", "Keep frames", 'F'},
                                            {"dialog.seconds", "Keep seconds", 'S'},
                                            {"dialog.cancel", "Cancel", 'C'}};
    const double before = core->document->fps;
    if (fps == before) return;
    core->subject.fps = fps;
    if (!rigs_have_knots(core->document) || !(fps > 0 && fps <= SCENE_MAX_FPS)) {
        answer_fps(core, 0);
        return;
    }
    struct question *question = core_ask(core, answers, 3, answer_fps);
    snprintf(question->title, sizeof question->title, "%g frames per second instead of %g", fps, before);
    snprintf(
        question->note, sizeof question->note,
        "Keep frames: knots stay on their frames, and everything plays %s. Keep seconds: knots and range move to "
        "new frames and the timing stays.",
        fps > before ? "faster" : "slower");
}

static void answer_range(void *of, int answer)
{
    static const enum range_fit fits[] = {RANGE_MOVE, RANGE_TRIM, RANGE_REFUSE};
    struct core *core = of;
    const struct subject *subject = &core->subject;
    if (core_step(core, "Set range", 0))
        edit_range(core->document, subject->first, subject->last, fits[answer], &core->step.error);
}

void spline_list_range(struct core *core, int first, int last)
{
    static const struct answer answers[] = {
        {"dialog.move", "Move", 'M'}, {"dialog.trim", "Trim", 'T'}, {"dialog.cancel", "Cancel", 'C'}};
    const bool possible = last >= first && last <= SCENE_MAX_FRAME && first >= -SCENE_MAX_FRAME &&
                          (long long)last - first <= document_longest(core->document);
    struct document moved = *core->document;
    moved.first_frame = first;
    moved.last_frame = last;
    int count = 0; // of knots outside
    for (int s = 0; s < moved.spline_count && possible; s++) {
        const struct spline *spline = moved.splines[s];
        const int end = document_last_knot_sample(&moved, spline);
        for (int k = 0; k < spline->knot_count; k++) {
            const int sample = document_sample(&moved, spline->knots[k].frame);
            count += sample < 0 || sample > end;
        }
    }
    core->subject.first = first;
    core->subject.last = last;
    if (count == 0) {
        answer_range(core, 2);
        return;
    }
    struct question *question = core_ask(core, answers, 3, answer_range);
    snprintf(question->title, sizeof question->title, "%d knot%s would fall outside frames %d to %d", count,
             count == 1 ? "" : "s", first, last);
    snprintf(question->note, sizeof question->note,
             "Move shifts them to the nearest free frames inside. Trim deletes them.");
}

// --- the limb that Feel acts on: its splines' frequency, damping and wind-up and its channels' lag change together

int core_limb(const struct core *core)
{
    const struct document *document = core->document;
    if (core->focus.limb == 0 && core_chosen_count(core) > 1) return LIMB_ROWS;
    for (int r = 0; core->focus.limb != 0 && r < document->rig_count; r++) {
        if (document->rigs[r]->id == core->focus.limb)
            return rig_is_moved(document->rigs[r], core->focus.active) ? r : LIMB_NONE;
    }
    return LIMB_NONE;
}

bool core_is_felt(const struct core *core, int limb, int spline)
{
    if (limb == LIMB_ROWS) return core_is_chosen(core, spline);
    return limb >= 0 && rig_is_moved(core->document->rigs[limb], spline);
}

double core_in_step(double other, double before, double now)
{
    if (before == 0) return other == 0 ? now : other;
    return round(other * (now / before) * 1e6) / 1e6;
}

bool core_set_felt(struct core *core, int limb, enum parameter parameter, double value, bool alike,
                   struct error *error)
{
    struct document *document = core->document;
    const struct param before = core_active_spline(core)->parameter[parameter];
    const bool is_shared =
        parameter == PARAMETER_FREQUENCY || parameter == PARAMETER_DAMPING || parameter == PARAMETER_WIND_UP;
    bool done = true;
    for (int s = 0; s < document->spline_count && done; s++) {
        const struct spline *spline = document->splines[s];
        const bool is_active = s == core->focus.active;
        const bool changes =
            is_active || (is_shared && core_is_felt(core, limb, s) && spline_uses(spline, parameter, false));
        if (param_follows(&spline->parameter[parameter]) || !changes) continue;
        double next = value;
        if (!is_active && !alike && !param_follows(&before))
            next = core_in_step(spline->parameter[parameter].value, before.value, value);
        const struct param param = param_number(parameter_clamped(parameter, spline_mode(spline), next));
        done = edit_parameter(document, s, parameter, &param, error);
    }
    return done;
}

bool core_set_lag(struct core *core, int limb, struct channel_place at, const struct angles *lag, struct error *error)
{
    struct document *document = core->document;
    int count;
    const double before = angles_largest(&rig_channels(document->rigs[at.rig], &count)[at.channel].lag);
    bool done = edit_angles(document, at, ANGLE_LAG, lag, error);
    for (int r = 0; r < document->rig_count; r++) {
        const struct channel *channels = rig_channels(document->rigs[r], &count);
        for (int c = 0; c < count && done; c++, channels = rig_channels(document->rigs[r], &count)) {
            const bool felt = limb == LIMB_ROWS ? core_is_chosen(core, channels[c].spline) : r == limb && r == at.rig;
            struct angles other = channels[c].lag;
            if (!felt || (r == at.rig && c == at.channel) || rig_point_input(document->rigs[r], c) < 0) continue;
            angles_scale(&other, core_in_step(angles_largest(&other), before, angles_largest(lag)));
            done = edit_angles(document, (struct channel_place){r, c}, ANGLE_LAG, &other, error);
        }
    }
    return done;
}

// --- parameters by keys, and finding the frequency

enum { NUDGE_PARAMETER = 100 }; ///< kind for core_merge_key()

const struct channel *core_active_channel(const struct core *core, int *rig, int *channel)
{
    const struct channel *first = NULL;
    const int limb = core_limb(core);
    for (int r = core->document->rig_count - 1; r >= 0; r--) {
        int count;
        const struct channel *channels = rig_channels(core->document->rigs[r], &count);
        for (int c = count - 1; c >= 0; c--) {
            const struct channel *candidate = &channels[c];
            const bool suits = first && first->spline == core->focus.active;
            if (suits && (candidate->spline != core->focus.active || (*rig == limb && r != limb))) continue;
            first = candidate;
            *rig = r;
            *channel = c;
        }
    }
    return first;
}

static void nudge_lag(struct core *core, double degrees)
{
    int rig = -1, channel = -1;
    const struct channel *active = core_active_channel(core, &rig, &channel);
    if (!active) {
        core_message(core, false, "This scene has no tail to lag.");
        return;
    }
    struct angles lag = active->lag;
    const int joints = bones_joints(core, rig);
    for (int i = 0; i < angles_count(&lag); i++) {
        double behind = lag.form == ANGLES_ONE ? 1 : lag.form == ANGLES_EACH ? i : lag.ramp[i].at * (joints - 1);
        angles_set_number(&lag, i, angles_number(&lag, i) + behind * degrees);
    }
    const struct channel_place at = {rig, channel};
    const uint64_t kind = NUDGE_PARAMETER + PARAMETER_COUNT + (uint64_t)(rig * 4096 + channel);
    if (core_step(core, "Change lag", core_merge_key(core, kind)))
        core_set_lag(core, core_limb(core), at, &lag, &core->step.error);
}

/// Of the largest value.
static const double FRESH_ROOM = 0.15;

double core_slider_end(const struct document *document, const struct spline *spline, enum parameter parameter)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    double most = fmin(row->usual, parameter_maximum(parameter, spline_mode(spline)));
    return parameter == PARAMETER_FREQUENCY ? fmin(most, document->fps * document->substeps / 2) : most;
}

double core_fresh_limit(const struct spline *spline, enum parameter parameter)
{
    const bool is_high = parameter == PARAMETER_HIGH;
    double edge = 0, largest = -1;
    for (int k = 0; k < spline->knot_count; k++) {
        const double value = spline->knots[k].value;
        if (spline->knots[k].still) continue;
        if (largest < 0 || (is_high ? value > edge : value < edge)) edge = value;
        largest = fmax(largest, fabs(value));
    }
    const double room = largest > 0 ? FRESH_ROOM * largest : 1;
    return is_high ? ceil(100 * (edge + room) - 1e-6) / 100 : floor(100 * (edge - room) + 1e-6) / 100;
}

void core_nudge_parameter(struct core *core, int direction)
{
    const struct spline *spline = core_active_spline(core);
    if (core->input.held_key == 0) return;
    core->input.held_used = true;
    if (core->input.held_key == 'L') nudge_lag(core, 0.5 * direction);
    const enum parameter parameter = core->input.held_key == 'F' ? PARAMETER_FREQUENCY : PARAMETER_DAMPING;
    if (!spline || (core->input.held_key != 'F' && core->input.held_key != 'Z')) return;
    if (spline_mode(spline) == WIGGLY_CUBIC) {
        core_message(core, false, "A cubic does not swing. Press M to change the kind.");
        return;
    }
    const double step = parameter_rows[parameter].step * direction;
    const struct param *before = &spline->parameter[parameter];
    if (before->track >= 0) {
        core_message(core, false, "The %s follows the spline \"%.*s\".", parameter_rows[parameter].name,
                     name_fit(core->document->splines[before->track]->name, 60),
                     core->document->splines[before->track]->name);
        return;
    }
    struct param param = *before;
    param.value = round((param.value + step) * 1e6) / 1e6; /* 0.30000000000000004 is no number to save */
    const double most = fmax(core_slider_end(core->document, spline, parameter), before->value);
    param.value = fmin(fmax(param.value, parameter_rows[parameter].minimum), most);
    if (param.value == before->value) return;
    if (core_step(core, "Change parameter", core_merge_key(core, NUDGE_PARAMETER + parameter)))
        core_set_felt(core, core_limb(core), parameter, param.value, false, &core->step.error);
}

void core_cycle_mode(struct core *core)
{
    const struct spline *spline = core_active_spline(core);
    if (spline && core_step(core, parameter_rows[PARAMETER_MODE].undo, 0))
        core_set_parameter(core, core->focus.active, PARAMETER_MODE, (spline_mode(spline) + 1) % (WIGGLY_CUBIC + 1));
}

void core_pose_to_pose(struct core *core, int limb)
{
    const struct spline *spline = core_active_spline(core);
    const bool settles = spline && !spline_settles(spline);
    if (!spline || !core_step(core, settles ? "Pose to pose" : "Settle off", 0)) return;
    for (int s = 0; s < core->document->spline_count; s++) {
        if (s != core->focus.active && !core_is_felt(core, limb, s)) continue;
        edit_spline_settles(core->document, s, settles, &core->step.error);
    }
    core_edited(core, -1);
}

void core_toggle_pose_to_pose(struct core *core) { core_pose_to_pose(core, core_limb(core)); }

void core_find_frequency(struct core *core)
{
    const struct spline *spline = core_active_spline(core);
    if (!spline || !evaluation_is_of(core->evaluation, core->document)) return;
    const struct param *p = spline->parameter;
    const bool follows = p[PARAMETER_FREQUENCY].track >= 0 || p[PARAMETER_DAMPING].track >= 0;
    const char *reason = NULL;
    if (spline->knot_count < WIGGLY_FEWEST_EXPLAINED) reason = "Four knots or more are needed to find a frequency.";
    if (follows) reason = "Frequency or damping follows another spline. Give it a number first.";
    if (spline_mode(spline) == WIGGLY_CUBIC) reason = "A cubic does not swing. Press M to change the kind.";
    wiggly_explanation found[2] = {{0}};
    wiggly_knot *knots;
    const wiggly_desc desc = core_describe(core, core->focus.active, false, &knots);
    const int count = reason ? 0 : wiggly_explain(&desc, found);
    free(knots);
    if (count <= 0) {
        core_message(core, false, "%s", reason ? reason : "These knots do not swing: no frequency explains them.");
        return;
    }
    double rounded[2][2]; // frequency and damping, as in files
    for (int i = 0; i < count; i++) {
        rounded[i][0] = round(found[i].frequency * 100) / 100;
        rounded[i][1] = round(found[i].damping * 1000) / 1000;
    }
    const bool is_set = p[PARAMETER_FREQUENCY].value == rounded[0][0] && p[PARAMETER_DAMPING].value == rounded[0][1];
    const int active = core->focus.active, chosen = count == 2 && is_set ? 1 : 0;
    if (!core_step(core, "Find frequency", 0) ||
        !core_set_parameter(core, active, PARAMETER_FREQUENCY, rounded[chosen][0]) ||
        !core_set_parameter(core, active, PARAMETER_DAMPING, rounded[chosen][1]))
        return;
    core_edited(core, core->focus.active);
    core_message(core, false,
                 count == 1 ? "%s: %.2f Hz, damping %.3g. There is no runner-up."
                            : "%s: %.2f Hz, damping %.3g. Shift+F again for the %s: %.2f Hz.",
                 chosen ? "Runner-up" : "Best", found[chosen].frequency, found[chosen].damping,
                 chosen ? "best" : "runner-up", found[1 - chosen].frequency);
}

void core_close_curves(struct core *core)
{
    struct document *document = core->document;
    int count = 0;
    if (!core_step(core, "Close all curves", 0)) return;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        if (spline_start(spline) == WIGGLY_LOOP) continue;
        const int knot = spline_find_knot(document, spline, document_samples(document) - 1);
        if (knot >= 0 && !edit_knot_remove(document, s, spline->knots[knot].id, &core->step.error)) return;
        if (!core_set_parameter(core, s, PARAMETER_START, WIGGLY_LOOP)) return;
        count++;
    }
    core_message(core, false, "Closed %d curve%s: the end now meets the start.", count, count == 1 ? "" : "s");
}
