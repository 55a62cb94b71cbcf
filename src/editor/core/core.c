/// The state that all panels share: opening a document, undo steps, messages, the active spline, and the selected knots.
#include "editor/core/core.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/names.h"
#include "base/need.h"
#include "maths/maths.h"
#include "scene/warnings.h"
#include "ui/theme.h"
#include <ctype.h>
#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void core_open(struct core *core)
{
    const struct document *document = core->document;
    take_keep(core, false);
    selection_clear(&core->focus.selection);
    selection_clear(&core->view.hidden);
    selection_clear(&core->view.solo);
    selection_clear(&core->view.folded);
    core->input.drag = (struct drag){0};
    core->input.hover = (struct hover){0};
    core->step.edited = (struct edited){0};
    core->view.look = LOOK_WIGGLY;
    core->view.refit_stage = core->view.refit_curves = true;
    core->focus.brush.on = false;
    core->focus.bone.any = false;
    core->focus.pin = 0;
    core->focus.pick = (struct bone_pick){0};

    // The first spline that moves something, with its rig as the limb, else the first.
    core->focus.limb = 0;
    core->focus.active = document->spline_count > 0 ? 0 : -1;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        for (int r = -1; !core->focus.limb && (r = document_next_rig(document, (enum rig_kind)kind, r)) >= 0;) {
            if (rig_input_count(document->rigs[r]) == 0) continue;
            core->focus.limb = document->rigs[r]->id;
            core->focus.active = rig_input(document->rigs[r], 0);
        }
    }
    core->focus.active_id = core->focus.active >= 0 ? document->splines[core->focus.active]->id : 0;
    core->input.held_key = 0;
    core->input.space_down = false;
    core->message = (struct message){0};
    core->serial = document->serial;

    int phases = -1;
    for (int r = -1; phases < 0 && (r = document_next_rig(document, RIG_MODEL, r)) >= 0;)
        phases = document->rigs[r]->model.phases;
    core->view.on[SWITCH_PHASE_MAP] = phases >= 0;
    core->view.shows_poles = core->view.on[SWITCH_PHASE] = false;
    core->focus.characters = (struct character_view){.axis = phases >= 0 ? phases : 1};

    // Scenes that loop, have a clip or a description play. Auto-key is on if a body is animated.
    core->view.seen_first = document->first_frame;
    core->view.seen_substeps = document->substeps;
    core->view.on[SWITCH_LOOP] = true;
    core->view.playback =
        (struct playback){.speed = 1, .playing = document->about != NULL, .range = {-INFINITY, INFINITY}};
    for (int s = 0; s < document->spline_count; s++)
        core->view.playback.playing |= spline_start(document->splines[s]) == WIGGLY_LOOP;
    core->view.on[SWITCH_AUTO_KEY] = false;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        core->view.playback.playing |= rig->kind == RIG_MODEL && rig->model.clip;
        for (int k = 0; k < 3 && rig->kind == RIG_TAIL; k++)
            core->view.on[SWITCH_AUTO_KEY] |= rig->tail.position[k].track >= 0;
    }
    if (core->app.still) core->view.playback.playing = false;
}

static const double MESSAGE_SECONDS = 5;

const char *core_path(const struct core *core) { return core->document->path ? core->document->path : ""; }

const char *core_title(const struct core *core)
{
    return core->document->path ? path_name(core->document->path) : "untitled";
}

void core_edited(struct core *core, int spline)
{
    struct edited *edited = &core->step.edited;
    if (spline < 0) edited->selection = true;
    for (int i = 0; i < edited->count; i++) {
        if (edited->spline[i] == spline) return;
    }
    if (spline >= 0 && edited->count < CORE_MAX_EDITED) edited->spline[edited->count++] = spline;
}

/// What belongs to an undo step beside its edits.
struct seen {
    unsigned active_id, limb, pin;
    struct bone_selection bone;
    struct plotted plot;
    struct camera camera;
    struct selection selection; ///< in `bits`
    uint64_t bits[];
};

/// What is selected and in sight now. The caller frees it.
static struct seen *see(const struct core *core)
{
    const struct selection *selection = &core->focus.selection;
    struct seen *seen = need_zeroed(1, sizeof *seen + selection->capacity / 8);
    seen->active_id = core->focus.active_id;
    seen->limb = core->focus.limb;
    seen->pin = core->focus.pin;
    seen->bone = core->focus.bone;
    seen->plot = core->view.plot;
    seen->camera = core->view.camera;
    seen->selection = (struct selection){seen->bits, selection->capacity};
    if (selection->bits) memcpy(seen->bits, selection->bits, selection->capacity / 8);
    return seen;
}

/// After undo or redo: selects and shows what belonged to the step.
static void see_again(struct core *core, bool undone)
{
    const struct seen *seen = history_seen(core->history, undone);
    if (seen) core->focus.active_id = seen->active_id;
    core_refresh(core);
    if (!seen) return;
    core->focus.limb = seen->limb;
    core->focus.pin = seen->pin;
    core->focus.bone = seen->bone;
    core->view.plot = seen->plot;
    core->view.camera = seen->camera;
    core->view.returned = true;
    selection_copy(&core->focus.selection, &seen->selection);
}

void core_end(struct core *core)
{
    if (history_end(core->history)) {
        history_see(core->history, core->step.seen, see(core));
    } else {
        free(core->step.seen);
    }
    core->step.seen = NULL;
}

static void originals_add(struct originals *originals, int spline, const struct knot *knot)
{
    if (originals->count == originals->capacity) {
        originals->capacity = 2 * originals->capacity + 64;
        originals->list = need_more(originals->list, (size_t)originals->capacity, sizeof *originals->list);
    }
    originals->list[originals->count++] = (struct original){.spline = spline, .knot = *knot};
}

bool core_step(struct core *core, const char *label, uint64_t merge)
{
    core_close(core);
    if (history_is_open(core->history)) return false;
    history_begin(core->history, label, merge);
    core->step.seen = see(core);
    core->step.ends = true;
    core->step.error = (struct error){0};
    core->message = (struct message){0};

    // The phases that core_keep_following() gives back.
    const struct document *document = core->document;
    core->step.pressed.count = 0;
    if (!core->view.on[SWITCH_KEEP] || !evaluation_is_of(core->evaluation, document)) return true;
    for (int s = 0; s < document->spline_count; s++) {
        const struct spline *spline = document->splines[s];
        for (int k = 0; k < spline->knot_count && spline_winds_up(document, s); k++) {
            struct knot knot = spline->knots[k];
            if (knot_holds(&knot) != HOLDS_VALUE) continue;
            knot.phase = evaluation_at(core->evaluation, s, document_sample(document, knot.frame)).im;
            originals_add(&core->step.pressed, s, &knot);
        }
    }
    return true;
}

void core_close(struct core *core)
{
    if (!core->step.ends) return;
    core->step.ends = false;
    if (core->step.error.kind == ERROR_NONE) {
        core_keep_following(core);
    } else {
        history_restart(core->history);
    }
    core_end(core);
    core_settle(core);
}

void core_settle(struct core *core)
{
    core_refresh(core);
    if (core->step.error.kind == ERROR_NONE) return;
    core_message(core, true, "%s", core->step.error.text);
    core->step.error = (struct error){0};
    selection_drop_from(&core->focus.selection, core->document->next_id); // the knot the drag had inserted
}

bool core_set_parameter(struct core *core, int spline, enum parameter parameter, double value)
{
    const struct param param = param_number(value);
    return edit_parameter(core->document, spline, parameter, &param, &core->step.error);
}

bool core_check_lock(const struct core *core, int spline, struct error *error)
{
    const struct spline *of = core->document->splines[spline];
    return !of->locked || fail(error, ERROR_INPUT, "%.200s is locked: open its lock in the list first.", of->name);
}

bool core_put_knot(struct core *core, int spline, const struct knot *knot)
{
    if (!core_check_lock(core, spline, &core->step.error)) return false;
    return knot->id == 0 ? edit_knot_insert(core->document, spline, knot, &core->step.error)
                         : edit_knot_set(core->document, spline, knot, &core->step.error);
}

double core_parameter_at(const struct core *core, const struct spline *spline, enum parameter parameter, int sample)
{
    const struct param *param = &spline->parameter[parameter];
    const wiggly_value track = evaluation_at(core->evaluation, param->track, sample);
    return parameter_clamped(parameter, spline_mode(spline), param->track < 0 ? param->value : track.y + track.re);
}

struct knot core_knot_at(const struct document *document, int spline, int sample)
{
    const struct spline *edited = document->splines[spline];
    const int at = spline_find_knot(document, edited, sample);
    struct knot knot = {.frame = document_frame(document, sample), .stiffness = KNOT_DEFAULT_STIFFNESS};
    if (at >= 0) knot = edited->knots[at];
    knot.still = false;
    return knot;
}

void core_refresh(struct core *core)
{
    const struct document *document = core->document;
    const struct spline *active = core_active_spline(core);
    if (core->serial != document->serial) {
        core_open(core);
        return;
    }

    const bool same = core->evaluation && core->evaluation->count == document->spline_count;
    if (!same || !active || active->id != core->focus.active_id) {
        int found = document_find_spline_id(document, core->focus.active_id);
        if (found < 0) {
            const int last = document->spline_count - 1;
            found = core->focus.active > last ? last : core->focus.active < 0 && last >= 0 ? 0 : core->focus.active;
            core->focus.active_id = found >= 0 ? document->splines[found]->id : 0;
            selection_clear(&core->focus.selection);
        }
        core->focus.active = found;
        core->input.hover = (struct hover){0};
    }

    const double frame = core->view.seen_first + core->view.playback.position / core->view.seen_substeps;
    const bool moved =
        core->view.seen_first != document->first_frame || core->view.seen_substeps != document->substeps;
    if (moved) core->view.playback.position = (frame - document->first_frame) * document->substeps;
    core->view.playback.position = fmax(0, fmin(core->view.playback.position, document_samples(document) - 1));
    core->view.seen_first = document->first_frame;
    core->view.seen_substeps = document->substeps;
    core->focus.pick = (struct bone_pick){0};
}

void core_undo(struct core *core, int direction)
{
    struct history *history = core->history;
    const bool undoes = direction < 0;
    if (history_is_open(history)) return;
    const char *label = history_label(history, history_done(history) - undoes);
    if (label) core_message(core, false, "%s: %s", undoes ? "Undone" : "Redone", label);
    if (!label) core_message(core, false, "Nothing to %s", undoes ? "undo" : "redo");
    (undoes ? history_undo : history_redo)(history);
    see_again(core, undoes);
}

void core_jump(struct core *core, size_t done)
{
    if (history_is_open(core->history)) return;
    size_t before = history_done(core->history), steps = before > done ? before - done : done - before;
    if (!history_jump(core->history, done)) return;
    see_again(core, before > done);
    core_message(core, false, "%s %zu step%s", before > done ? "Undone:" : "Redone:", steps, steps == 1 ? "" : "s");
}

void core_request(struct core *core, const struct request *request)
{
    core_close(core);
    if (core->app.carry_out) core->app.carry_out(core->app.user, request);
}

struct question *core_ask(struct core *core, const struct answer *answers, int count,
                          void (*answered)(void *core, int answer))
{
    core->question = (struct question){.answers = answers, .count = count, .of = core, .answered = answered};
    return &core->question;
}

void core_drop_home(const struct core *core, char *text)
{
    const char *home = core->app.in_page ? getenv("HOME") : NULL;
    const size_t length = home ? strlen(home) : 0;
    if (length == 0) return;
    for (char *at = text; (at = strstr(at, home));) {
        const size_t drop = length + (at[length] == '/');
        memmove(at, at + drop, strlen(at + drop) + 1);
    }
}

void core_message(struct core *core, bool is_error, const char *format, ...)
{
    char text[2 * sizeof core->message.text];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    core_drop_home(core, text);
    snprintf(core->message.text, sizeof core->message.text, "%.*s", name_fit(text, sizeof core->message.text - 1),
             text);
    core->message.is_error = is_error;
    core->message.seconds_left = is_error ? 0 : MESSAGE_SECONDS;
    core->unshown = true;
}

void core_hold(const struct spline *spline, struct knot *knot, char why[STOPPED_SIZE])
{
    if (knot->still) return;
    const double within = spline_within(spline, knot->value);
    if (within != knot->value)
        snprintf(why, STOPPED_SIZE, "held by the limit %.4g of %.*s at frame %.6g", within,
                 name_fit(spline->name, 24), spline->name, knot->frame);
    knot->value = within;
}

double core_knot_value(const struct core *core, int spline, const struct knot *knot)
{
    if (!knot->still) return knot->value;
    const wiggly_value here = evaluation_at(core->evaluation, spline, document_sample(core->document, knot->frame));
    return here.y + here.re;
}

void core_add_stopped(const char *why, char *text, size_t size)
{
    const size_t length = strlen(text);
    if (why[0]) snprintf(text + length, size - length, "%s%c%s.", length ? " " : "", toupper(why[0]), why + 1);
}

void core_stopped(struct core *core, const char *why)
{
    core_message(core, false, "%c%s.", toupper(why[0]), why + 1);
}

struct spline *core_active_spline(const struct core *core)
{
    bool exists = core->focus.active >= 0 && core->focus.active < core->document->spline_count;
    return exists ? core->document->splines[core->focus.active] : NULL;
}

void core_turn_to(struct core *core, int spline)
{
    if (spline == core->focus.active || spline < 0 || spline >= core->document->spline_count) return;
    core->focus.active = spline;
    core->focus.active_id = core->document->splines[spline]->id;
}

void core_activate(struct core *core, int spline)
{
    if (spline == core->focus.active || spline < 0 || spline >= core->document->spline_count) return;
    selection_clear(&core->focus.selection);
    core_turn_to(core, spline);
}

void core_choose(struct core *core, int spline)
{
    core->focus.limb = 0;
    core_activate(core, spline);
}

bool core_is_chosen(const struct core *core, int spline)
{
    const unsigned id = core->document->splines[spline]->id;
    return id == core->focus.active_id || selection_has(&core->focus.selection, id);
}

int core_chosen_count(const struct core *core)
{
    int count = 0;
    for (int s = 0; s < core->document->spline_count; s++) count += core_is_chosen(core, s);
    return count;
}

wiggly_desc core_describe(const struct core *core, int spline, bool cubic, wiggly_knot **knots)
{
    struct evaluation evaluation = *core->evaluation;
    evaluation.cubic = cubic;
    *knots = need((size_t)core->document->splines[spline]->knot_count, sizeof **knots);
    return evaluation_describe(&evaluation, core->document, spline, *knots);
}

double core_round(double value, double resolution)
{
    if (!isfinite(resolution)) return value;
    int exponent = maths_decade(resolution);
    double power = maths_power_of_ten(abs(exponent));
    double rounded = exponent < 0 ? round(value * power) / power : round(value / power) * power;
    return isfinite(rounded) && fabs(value) < 1e15 * resolution ? rounded : value;
}

uint32_t spline_list_color(const struct document *document, int spline)
{
    if (spline < 0 || spline >= document->spline_count) return theme()->spline[0];
    int color = document->splines[spline]->color;
    return color < 0 ? theme()->spline[spline % THEME_SPLINE_COLORS] : theme_spline((uint32_t)color);
}

bool spline_list_shows(const struct core *core, int spline)
{
    const struct document *document = core->document;
    if (spline < 0 || spline >= document->spline_count) return false;
    const unsigned id = document->splines[spline]->id;
    int solo = 0;
    while (solo < document->spline_count && !selection_has(&core->view.solo, document->splines[solo]->id)) solo++;
    return solo < document->spline_count ? selection_has(&core->view.solo, id)
                                         : !selection_has(&core->view.hidden, id);
}

const struct spline *spline_list_seen(const struct core *core)
{
    return spline_list_shows(core, core->focus.active) ? core_active_spline(core) : NULL;
}

// --- the selected knots: one bit per id, so that lookups are cheap in drags of thousands

bool selection_has(const struct selection *selection, unsigned id)
{
    return id < selection->capacity && (selection->bits[id / 64] >> (id % 64) & 1u);
}

/// Ids are consecutive, so this reserves some more.
static void selection_reserve(struct selection *selection, unsigned end)
{
    if (end <= selection->capacity) return;
    const unsigned capacity = (end / 512 + 2) * 512;
    selection->bits = need_more(selection->bits, capacity / 64, sizeof *selection->bits);
    memset((char *)selection->bits + selection->capacity / 8, 0, (capacity - selection->capacity) / 8);
    selection->capacity = capacity;
}

void selection_set(struct selection *selection, unsigned id, bool selected)
{
    if (selected) selection_reserve(selection, id + 1);
    if (id >= selection->capacity) return;
    uint64_t *word = &selection->bits[id / 64];
    const uint64_t bit = UINT64_C(1) << (id % 64);
    *word = selected ? *word | bit : *word & ~bit;
}

void selection_clear(struct selection *selection)
{
    if (selection->bits) memset(selection->bits, 0, selection->capacity / 8);
}

void selection_drop_from(struct selection *selection, unsigned id)
{
    for (; id < selection->capacity; id++) selection_set(selection, id, false);
}

int selection_count(const struct selection *selection, const struct spline *spline)
{
    int count = 0;
    for (int k = 0; spline && k < spline->knot_count; k++) count += selection_has(selection, spline->knots[k].id);
    return count;
}

int selection_single(const struct selection *selection, const struct spline *spline)
{
    int found = -1;
    for (int k = 0; spline && k < spline->knot_count; k++) {
        if (!selection_has(selection, spline->knots[k].id)) continue;
        if (found >= 0) return -1;
        found = k;
    }
    return found;
}

void selection_copy(struct selection *to, const struct selection *from)
{
    selection_reserve(to, from->capacity);
    selection_clear(to);
    if (from->capacity > 0) memcpy(to->bits, from->bits, from->capacity / 8);
}

/// Locked knots are not edited, and hidden ones only if they are the active spline's.
static bool is_edited(const struct core *core, int spline)
{
    return !core->document->splines[spline]->locked &&
           (spline == core->focus.active || spline_list_shows(core, spline));
}

bool selected_next(const struct core *core, struct knot_place *at)
{
    if (at->spline < 0) *at = (struct knot_place){0, -1};
    for (; at->spline < core->document->spline_count; at->spline++, at->knot = -1) {
        const struct spline *spline = core->document->splines[at->spline];
        bool open = at->knot >= 0 || is_edited(core, at->spline);
        while (open && ++at->knot < spline->knot_count) {
            if (selection_has(&core->focus.selection, spline->knots[at->knot].id)) return true;
        }
    }
    return false;
}

int selected_count(const struct core *core)
{
    int count = 0;
    for (struct knot_place at = SELECTED_START; selected_next(core, &at);) count++;
    return count;
}

void selected_activate(struct core *core)
{
    struct knot_place first = SELECTED_START;
    if (selection_count(&core->focus.selection, core_active_spline(core)) > 0) return;
    if (selected_next(core, &first)) core_turn_to(core, first.spline);
}

void core_collect(struct core *core, bool later)
{
    struct originals *originals = &core->step.originals;
    originals->count = 0;
    for (int s = 0; s < core->document->spline_count; s++) {
        const struct spline *spline = core->document->splines[s];
        bool begun = false;
        if (!is_edited(core, s)) continue;
        for (int k = 0; k < spline->knot_count; k++) {
            bool selected = selection_has(&core->focus.selection, spline->knots[k].id);
            begun |= selected;
            if (!selected && !(later && begun)) continue;
            originals_add(originals, s, &spline->knots[k]);
            originals->list[originals->count - 1].value = core_knot_value(core, s, &spline->knots[k]);
        }
    }
}

/// The original of a spline's knot at a sample, or NULL. They are sorted.
static const struct original *find_original(const struct originals *originals, const struct document *document,
                                            int spline, int sample)
{
    int low = 0, high = originals->count;
    while (low < high) {
        const int middle = (low + high) / 2;
        const struct original *at = &originals->list[middle];
        const int there = document_sample(document, at->knot.frame);
        if (at->spline == spline && there == sample) return at;
        if (at->spline < spline || (at->spline == spline && there < sample)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return NULL;
}

enum room originals_room(const struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE])
{
    const struct document *document = core->document;
    const struct originals *originals = &core->step.originals;
    enum room room = ROOM_FREE;
    double stopped = 0;
    for (int i = 0, before = 0; i < originals->count && room != ROOM_OUTSIDE; i++) {
        const struct original *original = &originals->list[i];
        const struct spline *spline = document->splines[original->spline];
        const double frame = rule(core, how, original).frame;
        const int sample = document_sample(document, frame);
        const bool meets = i > 0 && originals->list[i - 1].spline == original->spline && sample == before;
        const bool outside = sample < 0 || sample > document_last_knot_sample(document, spline);
        const bool taken = spline_find_knot(document, spline, sample) >= 0 &&
                           !find_original(originals, document, original->spline, sample);
        if (room == ROOM_FREE) stopped = frame;
        if (meets || taken) room = ROOM_OCCUPIED;
        if (outside) room = ROOM_OUTSIDE;
        before = sample;
    }
    if (room == ROOM_OUTSIDE) snprintf(why, STOPPED_SIZE, "a knot would leave the range");
    if (room == ROOM_OCCUPIED) snprintf(why, STOPPED_SIZE, "a knot would land on another on frame %g", stopped);
    return room;
}

bool originals_put(struct core *core, knot_rule *rule, const void *how, char why[STOPPED_SIZE])
{
    const struct originals *originals = &core->step.originals;
    const struct original *list = originals->list;
    int pair = 1; // of a spline
    while (pair < originals->count && list[pair].spline != list[pair - 1].spline) pair++;
    const bool reversed =
        pair < originals->count && rule(core, how, &list[pair]).frame < rule(core, how, &list[pair - 1]).frame;

    // To avoid collisions, knots moving right go first, the last one first. If the order is reversed, all are removed before.
    bool done = true;
    for (int i = 0; i < 2 * originals->count && done; i++) {
        const bool first = i < originals->count;
        const int at = first ? originals->count - 1 - i : i - originals->count;
        const struct original *original = &list[at];
        struct knot knot = rule(core, how, original);
        if (reversed && first) {
            done = edit_knot_remove(core->document, original->spline, knot.id, &core->step.error);
        } else if (reversed || first == (knot.frame > original->knot.frame)) {
            core_hold(core->document->splines[original->spline], &knot, why);
            done = (reversed ? edit_knot_insert : edit_knot_set)(core->document, original->spline, &knot,
                                                                 &core->step.error);
        }
    }
    return done;
}

uint64_t core_merge_key(const struct core *core, uint64_t kind)
{
    uint64_t key = hash_bytes(HASH_START, &kind, sizeof kind);
    key = hash_bytes(key, &core->focus.active, sizeof core->focus.active);
    key = hash_bytes(key, core->focus.selection.bits, core->focus.selection.capacity / 8);
    return key ? key : 1;
}

// --- keeping what follows an edit: a spline that winds up and whose knots an open step has changed gets a pose at the next free knot, so that from
// there on it is what it was (docs/mathematics.md, Wind-up). The rule compares the knots with those before the step, so any number of edits, in any
// order, gives the same. Settling knots move the equilibrium of all that follows, which no pose can keep.

/// The phase of a knot of spline `old` when the step began; NULL if it is not known, or was not free.
static const double *phase_of(const struct core *core, int old, const struct knot *knot)
{
    const struct document *document = history_before(core->history);
    const struct original *at =
        find_original(&core->step.pressed, document, old, document_sample(document, knot->frame));
    return at && at->knot.id == knot->id ? &at->knot.phase : NULL;
}

/// Whether a curve through either knot is the same: they are equal, or one is the other with the phase it had.
static bool is_same_knot(const struct core *core, int old, const struct knot *was, const struct knot *is)
{
    if (was->id != is->id || was->frame != is->frame || was->still != is->still || was->settles != is->settles)
        return false;
    if (is->still || was->value != is->value) return is->still;
    if (is->has_phase && !was->has_phase) {
        const double *phase = phase_of(core, old, was);
        return phase && is->phase == *phase;
    }
    if (was->has_phase || is->has_phase) return was->has_phase && is->has_phase && was->phase == is->phase;
    return was->has_slope == is->has_slope &&
           (!is->has_slope || (was->slope == is->slope && was->stiffness == is->stiffness));
}

/// Makes a free knot of a spline, `old` before the step, a pose with the phase it had.
static void keep_phase(struct core *core, int old, int of, const struct knot *knot)
{
    const double *phase = knot_holds(knot) == HOLDS_VALUE ? phase_of(core, old, knot) : NULL;
    struct knot pose = *knot;
    if (!phase) return;
    pose.has_phase = true;
    pose.phase = *phase;
    pose.has_slope = false; // its phase has it
    core_put_knot(core, of, &pose);
}

/// Goes through the knots before and after the step in order of time, in a loop twice. The first knot after a change that stayed is held. In a loop
/// that had no pose the phase of the first knot comes from the whole round, so that knot is held, too.
static void keep_spline(struct core *core, int old, int of)
{
    const struct document *document = core->document, *earlier = history_before(core->history);
    const struct spline *before = earlier->splines[old];
    const bool loops = spline_start(document->splines[of]) == WIGGLY_LOOP;
    bool changes = false, changed = false, is_free = loops;
    for (int k = 0; k < before->knot_count; k++) is_free &= knot_holds(&before->knots[k]) == HOLDS_VALUE;
    for (int round = 0; round < (loops ? 2 : 1); round++) {
        for (int b = 0, a = 0; b < before->knot_count || a < document->splines[of]->knot_count;) {
            const struct spline *after = document->splines[of];
            const struct knot *was = b < before->knot_count ? &before->knots[b] : NULL;
            const struct knot *is = a < after->knot_count ? &after->knots[a] : NULL;
            const int then = was ? document_sample(earlier, was->frame) : INT_MAX;
            const int now = is ? document_sample(document, is->frame) : INT_MAX;
            const bool stayed = then == now && is_same_knot(core, old, was, is);
            b += then <= now;
            a += now <= then;
            if (stayed) {
                if (changed || (changes && is_free && a == 1)) keep_phase(core, old, of, is);
                changed = false;
            } else if (!(then <= now && was->settles) && !(now <= then && is->settles)) {
                changes = changed = true;
            }
        }
    }
}

void core_keep_following(struct core *core)
{
    const struct document *document = core->document, *before = history_before(core->history);
    const bool swings = core->input.drag.owner && core->input.mods & MOD_ALT;
    if (!core->view.on[SWITCH_KEEP] || swings || core->step.pressed.count == 0) return;
    for (int s = 0; s < document->spline_count; s++) {
        const int old = document_find_spline_id(before, document->splines[s]->id);
        if (old < 0 || before->splines[old] == document->splines[s] || !spline_winds_up(document, s)) continue;
        keep_spline(core, old, s);
    }
}
