/// Makes, frees and searches documents, visits every reference to a spline in one, and sorts its splines by them.
#include "scene/document.h"
#include "base/need.h"
#include "scene/fields.h"
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

const char *coordinate_name(int index)
{
    static const char *const names[] = {"x", "y", "z"};
    return names[index];
}

/// Call before a document changes.
void document_touch(struct document *document)
{
    static atomic_ullong last;
    document->edits = 1 + atomic_fetch_add(&last, 1);
}

struct document *document_create(void)
{
    struct document *document = need_zeroed(1, sizeof *document);
    document_touch(document);
    document->fps = 24;
    document->substeps = 1;
    document->last_frame = 120;
    document->next_id = 1;
    return document;
}

/// Frees what a document holds.
static void empty(struct document *document)
{
    for (int i = 0; i < document->spline_count; i++) spline_drop(document->splines[i]);
    for (int i = 0; i < document->rig_count; i++) rig_drop(document->rigs[i]);
    free(document->path);
    free(document->about);
    free(document->splines);
    free(document->rigs);
    free(document->folder);
    fields_free(background_fields, &document->background);
    json_decref(document->owned);
}

void document_destroy(struct document *document)
{
    if (!document) return;
    empty(document);
    free(document);
}

static char *copy_text(const char *text) { return text ? need_text(text) : NULL; }

struct document *document_copy(const struct document *document)
{
    struct document *copy = need(1, sizeof *copy);
    *copy = *document;
    copy->path = copy_text(document->path);
    copy->about = copy_text(document->about);
    copy->folder = copy_text(document->folder);
    fields_copy(background_fields, &copy->background);
    copy->splines = need((size_t)document->spline_count + 1, sizeof *copy->splines);
    copy->rigs = need((size_t)document->rig_count + 1, sizeof *copy->rigs);
    for (int i = 0; i < document->spline_count; i++) copy->splines[i] = spline_hold(document->splines[i]);
    for (int i = 0; i < document->rig_count; i++) copy->rigs[i] = rig_hold(document->rigs[i]);
    json_incref(document->owned);
    return copy;
}

void document_become(struct document *document, struct document *other)
{
    empty(document);
    *document = *other;
    document_touch(document);
    free(other);
}

struct spline *spline_create(void)
{
    struct spline *spline = need_zeroed(1, sizeof *spline);
    atomic_init(&spline->holders, 1);
    spline->color = -1;
    for (int i = 0; i < PARAMETER_COUNT; i++) spline->parameter[i] = param_number(parameter_rows[i].standard);
    return spline;
}

struct spline *spline_clone(const struct spline *spline)
{
    struct spline *clone = need(1, sizeof *clone);
    *clone = *spline;
    atomic_init(&clone->holders, 1);
    clone->name = copy_text(spline->name);
    clone->folder = copy_text(spline->folder);
    clone->knots = need((size_t)spline->knot_count + 1, sizeof *clone->knots); // mostly for one more knot
    for (int k = 0; k < spline->knot_count; k++) clone->knots[k] = spline->knots[k];
    motion_hold(clone->parameter[PARAMETER_EQUILIBRIUM].motion);
    return clone;
}

struct spline *spline_hold(struct spline *spline)
{
    atomic_fetch_add(&spline->holders, 1);
    return spline;
}

void spline_drop(struct spline *spline)
{
    if (!spline || atomic_fetch_sub(&spline->holders, 1) > 1) return;
    motion_drop(spline->parameter[PARAMETER_EQUILIBRIUM].motion);
    free(spline->name);
    free(spline->folder);
    free(spline->knots);
    free(spline);
}

struct spline *document_own_spline(struct document *document, int spline)
{
    document_touch(document);
    struct spline **own = &document->splines[spline], *shared = *own;
    if (atomic_load(&shared->holders) > 1) {
        *own = spline_clone(shared);
        spline_drop(shared);
    }
    return *own;
}

struct rig *document_own_rig(struct document *document, int rig)
{
    document_touch(document);
    struct rig **own = &document->rigs[rig], *shared = *own;
    if (atomic_load(&shared->holders) > 1) {
        *own = rig_clone(shared);
        rig_drop(shared);
    }
    return *own;
}

void document_insert_spline(struct document *document, int at, struct spline *spline)
{
    const int count = document->spline_count++;
    document_touch(document);
    document->splines = need_more(document->splines, (size_t)count + 1, sizeof *document->splines);
    for (int i = count; i > at; i--) document->splines[i] = document->splines[i - 1];
    document->splines[at] = spline;
}

void document_add_rig(struct document *document, struct rig *rig)
{
    document_touch(document);
    document->rigs = need_more(document->rigs, (size_t)document->rig_count + 1, sizeof *document->rigs);
    document->rigs[document->rig_count++] = rig;
}

void document_remove_spline(struct document *document, int at)
{
    document_touch(document);
    spline_drop(document->splines[at]);
    document->spline_count--;
    for (int i = at; i < document->spline_count; i++) document->splines[i] = document->splines[i + 1];
}

void document_remove_rig(struct document *document, int at)
{
    document_touch(document);
    rig_drop(document->rigs[at]);
    document->rig_count--;
    for (int i = at; i < document->rig_count; i++) document->rigs[i] = document->rigs[i + 1];
}

void document_set_path(struct document *document, const char *path)
{
    char *copy = path && path[0] ? need_text(path) : NULL;
    free(document->path);
    document->path = copy;
}

bool document_model_path(const struct document *document, int rig, char path[PATH_LIMIT])
{
    const struct rig *of = document->rigs[rig];
    return of->kind == RIG_MODEL && of->model.model && path_resolve(document->folder, of->model.model, path);
}

bool document_background_path(const struct document *document, char path[PATH_LIMIT])
{
    return document->background.file && path_resolve(document->folder, document->background.file, path);
}

void document_note_models(const struct document *document)
{
    char path[PATH_LIMIT];
    for (int r = 0; r < document->rig_count; r++) {
        if (document_model_path(document, r, path)) file_note_read(path, "a model of the scene");
    }
    if (document_background_path(document, path)) file_note_read(path, "the background of the scene");
}

size_t document_bytes_beside(const struct document *document, const struct document *other)
{
    size_t bytes = sizeof *document + (size_t)document->spline_count * sizeof *document->splines +
                   (size_t)document->rig_count * sizeof *document->rigs;
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = document->splines[i];
        const int there = other ? document_find_spline_id(other, spline->id) : -1;
        if (there >= 0 && other->splines[there] == spline) continue;
        bytes += sizeof *spline + (size_t)spline->knot_count * sizeof *spline->knots + strlen(spline->name) + 1;
        if (spline->folder) bytes += strlen(spline->folder) + 1;
    }
    for (int i = 0; i < document->rig_count; i++) {
        const struct rig *rig = document->rigs[i];
        const struct rig *there = NULL;
        for (int k = 0; other && k < other->rig_count && !there; k++) {
            if (other->rigs[k]->id == rig->id) there = other->rigs[k];
        }
        if (there != rig) bytes += rig_bytes(rig, there);
    }
    return bytes;
}

int document_samples(const struct document *document)
{
    return (document->last_frame - document->first_frame) * document->substeps + 1;
}

static int most_samples(int splines, int limited)
{
    int most = limited > 0 ? LIMITED_MAX_SAMPLES : SPLINE_MAX_SAMPLES;
    if (limited > SCENE_MAX_LIMITED / most) most = SCENE_MAX_LIMITED / limited;
    return splines > SCENE_MAX_SAMPLES / most ? SCENE_MAX_SAMPLES / splines : most;
}

bool document_check_samples(int splines, int limited, long long samples, struct error *error)
{
    if (samples <= most_samples(splines, limited)) return true;
    if (samples > SPLINE_MAX_SAMPLES)
        return fail(error, ERROR_INPUT, "at most %d samples a spline, got %lld", SPLINE_MAX_SAMPLES, samples);
    if (limited > 0 && samples > LIMITED_MAX_SAMPLES)
        return fail(error, ERROR_INPUT, "at most %d samples where a spline has a low or high limit, got %lld",
                    LIMITED_MAX_SAMPLES, samples);
    if (limited * samples > SCENE_MAX_LIMITED)
        return fail(error, ERROR_INPUT,
                    "at most %d samples over all splines with a low or high limit, got %d times %lld",
                    SCENE_MAX_LIMITED, limited, samples);
    return fail(error, ERROR_INPUT, "at most %d samples over all splines, got %d times %lld", SCENE_MAX_SAMPLES,
                splines, samples);
}

bool document_check_joints(const struct document *document, struct error *error)
{
    int sum = 0;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        if (rig->kind == RIG_TAIL) sum += rig->tail.joints * (1 + rig->tail.channel_count);
    }
    return sum <= SCENE_MAX_JOINTS ||
           fail(error, ERROR_INPUT, "at most %d joints over all tails, counted once and for each channel, got %d",
                SCENE_MAX_JOINTS, sum);
}

int document_longest(const struct document *document)
{
    return (most_samples(document->spline_count, document_count_limited(document)) - 1) / document->substeps;
}

bool document_loops(const struct document *document)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (spline_start(document->splines[i]) == WIGGLY_LOOP) return true;
    }
    return false;
}

int document_count_limited(const struct document *document)
{
    int count = 0;
    for (int i = 0; i < document->spline_count; i++) count += spline_is_limited(document->splines[i]);
    return count;
}

double document_step(const struct document *document) { return 1 / (document->fps * document->substeps); }

int document_sample(const struct document *document, double frame)
{
    double sample = floor((frame - document->first_frame) * document->substeps + 0.5);
    if (sample > INT_MAX / 2) return INT_MAX / 2;
    if (sample < -(INT_MAX / 2)) return -(INT_MAX / 2);
    return (int)sample;
}

double document_frame(const struct document *document, int sample)
{
    return document->first_frame + (double)sample / document->substeps;
}

double document_delay(const struct document *document, int rig)
{
    return document->rigs[rig]->offset * document->substeps;
}

int document_last_knot_sample(const struct document *document, const struct spline *spline)
{
    return document_samples(document) - (spline_start(spline) == WIGGLY_LOOP ? 2 : 1);
}

bool document_has_frame(const struct document *document, double frame, int last, struct error *error)
{
    const int sample = document_sample(document, frame);
    if (sample >= 0 && sample <= last) return true;
    if (sample < 0 || sample >= document_samples(document))
        return fail(error, ERROR_INPUT, "expected a frame from %d to %d, got %.10g", document->first_frame,
                    document->last_frame, frame);
    return fail(error, ERROR_INPUT,
                "expected a frame before %d, because the last frame of a loop repeats the first, got %.10g",
                document->last_frame, frame);
}

int document_find_spline(const struct document *document, const char *name)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (strcmp(document->splines[i]->name, name) == 0) return i;
    }
    return -1;
}

bool document_has_spline(const struct document *document, int spline, struct error *error)
{
    return (spline >= 0 && spline < document->spline_count) || fail(error, ERROR_INPUT, "there is no such spline");
}

int document_find_spline_id(const struct document *document, unsigned id)
{
    const unsigned guess = id - 1; // loaded splines have these ids
    if (guess < (unsigned)document->spline_count && document->splines[guess]->id == id) return (int)guess;
    for (int i = 0; i < document->spline_count; i++) {
        if (document->splines[i]->id == id) return i;
    }
    return -1;
}

int document_next_rig(const struct document *document, enum rig_kind kind, int before)
{
    for (int i = before + 1; i < document->rig_count; i++) {
        if (document->rigs[i]->kind == kind) return i;
    }
    return -1;
}

int document_find_rig(const struct document *document, enum rig_kind kind, int n)
{
    for (int r = -1; n >= 0 && (r = document_next_rig(document, kind, r)) >= 0; n--)
        if (n == 0) return r;
    return -1;
}

int document_count_rigs(const struct document *document, enum rig_kind kind)
{
    int count = 0;
    for (int i = 0; i < document->rig_count; i++) count += document->rigs[i]->kind == kind;
    return count;
}

int document_rig_number(const struct document *document, int rig)
{
    int number = 0;
    for (int i = 0; i < rig; i++) number += document->rigs[i]->kind == document->rigs[rig]->kind;
    return number;
}

struct tail *document_tail(const struct document *document, int n)
{
    int found = document_find_rig(document, RIG_TAIL, n);
    return found >= 0 ? &document->rigs[found]->tail : NULL;
}

int document_find_model(const struct document *document, const char *text)
{
    int by_file = -1;
    for (int r = -1; (r = document_next_rig(document, RIG_MODEL, r)) >= 0;) {
        const struct rig *rig = document->rigs[r];
        if (rig->name && strcmp(rig->name, text) == 0) return r;
        if (by_file < 0 && rig->model.model && strcmp(rig->model.model, text) == 0) by_file = r;
    }
    return by_file;
}

int document_next_chain(const struct document *document, int model, int before)
{
    for (int r = before; (r = document_next_rig(document, RIG_CHAIN, r)) >= 0;) {
        const struct chain *chain = &document->rigs[r]->chain;
        if (document_find_model(document, chain->model) == model) return r;
    }
    return -1;
}

bool document_follows(const struct document *document, int spline, int rig)
{
    const struct joint_motion *motion = document->splines[spline]->parameter[PARAMETER_EQUILIBRIUM].motion;
    if (!motion) return false;
    if (document->rigs[rig]->kind == RIG_MODEL) return document_find_model(document, motion->model) == rig;
    return motion->chain && document_find_chain(document, motion->chain) == rig;
}

int document_find_chain(const struct document *document, const char *name)
{
    for (int rig = -1; (rig = document_next_rig(document, RIG_CHAIN, rig)) >= 0;) {
        if (document->rigs[rig]->name && strcmp(document->rigs[rig]->name, name) == 0) return rig;
    }
    return -1;
}

int spline_find_knot(const struct document *document, const struct spline *spline, int sample)
{
    int at = spline_lower_bound(document, spline, sample);
    if (at == spline->knot_count || document_sample(document, spline->knots[at].frame) != sample) return -1;
    return at;
}

int spline_lower_bound(const struct document *document, const struct spline *spline, int sample)
{
    int low = 0, high = spline->knot_count;
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (document_sample(document, spline->knots[middle].frame) < sample)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

bool spline_is_limited(const struct spline *spline)
{
    return isfinite(spline->parameter[PARAMETER_LOW].value) || isfinite(spline->parameter[PARAMETER_HIGH].value);
}

void spline_values(const struct spline *spline, int first, int end, double range[2])
{
    bool any = false;
    range[0] = range[1] = 0;
    for (int k = first; k < end; k++) {
        const double value = spline->knots[k].value;
        if (spline->knots[k].still) continue;
        range[0] = !any || value < range[0] ? value : range[0];
        range[1] = !any || value > range[1] ? value : range[1];
        any = true;
    }
}

bool spline_settles(const struct spline *spline)
{
    int valued = 0, settling = 0;
    for (int k = 0; k < spline->knot_count; k++) {
        valued += !spline->knots[k].still;
        settling += spline->knots[k].settles;
    }
    return valued > 0 && settling == valued;
}

int spline_find_id(const struct spline *spline, unsigned id)
{
    // Loaded knots have consecutive ids: search outwards from where the knot would then be.
    const int end = spline->knot_count;
    if (end == 0) return -1;
    const double guess = (double)id - (double)spline->knots[0].id;
    const int place = (int)fmin(fmax(guess, 0), end - 1);
    for (int left = place, right = place + 1; left >= 0 || right < end; left--, right++) {
        if (left >= 0 && spline->knots[left].id == id) return left;
        if (right < end && spline->knots[right].id == id) return right;
    }
    return -1;
}

double spline_within(const struct spline *spline, double value)
{
    return fmin(fmax(value, spline->parameter[PARAMETER_LOW].value), spline->parameter[PARAMETER_HIGH].value);
}

// --- references to splines, and the order in which to solve them

enum { UNSEEN = 0, DONE = PARAMETER_COUNT + 2 }; ///< of order_space.next; between them 1 + the next parameter

bool spline_uses(const struct spline *spline, enum parameter parameter, bool cubic)
{
    enum wiggly_mode mode = cubic ? WIGGLY_CUBIC : spline_mode(spline);
    return parameter_rows[parameter].modes >> mode & 1;
}

bool scene_order(const struct document *document, struct order_space space, int *order, struct order_cycle *cycle)
{
    int ordered = 0;
    if (document->spline_count > 0) memset(space.next, UNSEEN, (size_t)document->spline_count);
    for (int root = 0; root < document->spline_count; root++) {
        // A search depth first; not recursive, because a chain of tracks may be as long as the scene.
        if (space.next[root] != UNSEEN) continue;
        int depth = 0;
        space.stack[0] = root;
        space.next[root] = 1;
        while (depth >= 0) {
            int spline = space.stack[depth];
            int parameter = space.next[spline] - 1;
            if (parameter == PARAMETER_COUNT) {
                space.next[spline] = DONE;
                order[ordered++] = spline;
                depth--;
                continue;
            }
            space.next[spline]++;
            int leader = document->splines[spline]->parameter[parameter].track;
            if (leader < 0 || space.next[leader] == DONE) continue;
            if (space.next[leader] != UNSEEN) {
                *cycle = (struct order_cycle){spline, (enum parameter)parameter};
                return false;
            }
            space.next[leader] = 1;
            space.stack[++depth] = leader;
        }
    }
    return true;
}

bool scene_has_order(const struct document *document, struct order_cycle *cycle)
{
    size_t count = (size_t)document->spline_count;
    struct order_space space = {need(count, sizeof *space.stack), need(count, 1)};
    int *order = need(count, sizeof *order);
    const bool found = scene_order(document, space, order, cycle);
    free(order);
    free(space.next);
    free(space.stack);
    return found;
}

void scene_followers(const struct document *document, int spline, bool *followers, int count)
{
    for (int s = 0; s < count; s++) followers[s] = s == spline;
    for (bool more = true; more;) {
        more = false;
        for (int s = 0; s < count; s++) {
            for (int p = 0; p < PARAMETER_COUNT && !followers[s]; p++) {
                const int track = document->splines[s]->parameter[p].track;
                if (track >= 0 && track < count && followers[track]) followers[s] = more = true;
            }
        }
    }
}

bool reference_next(const struct document *document, struct reference *reference)
{
    if (reference->kind == REFERENCE_TRACK) {
        for (; reference->owner < document->spline_count; reference->owner++, reference->number = 0) {
            while (reference->number < PARAMETER_COUNT) {
                reference->which = reference->number++;
                reference->spline = document->splines[reference->owner]->parameter[reference->which].track;
                if (reference->spline >= 0) return true;
            }
        }
        *reference = (struct reference){.kind = REFERENCE_CHANNEL};
    }
    for (; reference->owner < document->rig_count; reference->owner++, reference->number = 0) {
        struct rig *rig = document->rigs[reference->owner];
        const int inputs = rig_input_count(rig);
        for (const int *spline; (spline = rig_spline(rig, reference->number));) {
            const int n = reference->number++;
            const enum reference_kind of_input = rig->kind == RIG_MODEL ? REFERENCE_DRIVE : REFERENCE_CHANNEL;
            reference->kind = n < inputs ? of_input : REFERENCE_POSITION;
            reference->which = n < inputs ? n : n - inputs;
            reference->spline = *spline;
            if (*spline >= 0) return true;
        }
    }
    return false;
}

void reference_set(struct document *document, const struct reference *reference, int spline)
{
    if (reference->kind == REFERENCE_TRACK) {
        document_own_spline(document, reference->owner)->parameter[reference->which].track = spline;
        return;
    }
    *rig_spline(document_own_rig(document, reference->owner), reference->number - 1) = spline;
}

int reference_count(const struct document *document, int spline)
{
    int count = 0;
    for (struct reference reference = {0}; reference_next(document, &reference);) count += reference.spline == spline;
    return count;
}
