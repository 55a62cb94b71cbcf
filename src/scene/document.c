/// Makes, frees and searches documents.
#include "scene/document.h"
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

void spline_reset(struct spline *spline)
{
    spline->color = -1;
    for (int i = 0; i < PARAMETER_COUNT; i++) {
        spline->parameter[i] = param_number(parameter_rows[i].standard);
    }
}

struct document *document_create(void)
{
    struct document *document = calloc(1, sizeof *document);
    if (!document) return NULL;
    document->fps = 24;
    document->substeps = 1;
    document->last_frame = 120;
    document->next_id = document->next_spline_id = 1;
    return document;
}

void document_destroy(struct document *document)
{
    if (!document) return;
    if (document->watched) *document->watched = NULL;
    for (int i = 0; i < document->spline_count; i++) {
        free(document->splines[i].name);
        free(document->splines[i].knots);
    }
    for (int i = 0; i < document->rig_count; i++) rig_release(&document->rigs[i]);
    motion_list_free(&document->motions);
    free(document->path);
    free(document->about);
    free(document->splines);
    free(document->rigs);
    free(document->folder);
    json_decref(document->owned);
    free(document);
}

bool document_set_folder(struct document *document, const char *folder)
{
    char *copy = folder ? strdup(folder) : NULL;
    if (folder && !copy) return false;
    bool moved = true;
    for (int i = 0; i < document->rig_count; i++) moved &= rig_rebase(&document->rigs[i], document->folder, folder);
    moved &= motion_list_rebase(&document->motions, document->folder, folder);
    free(document->folder);
    document->folder = copy;
    return moved;
}

const char *document_keep_text(struct document *document, const char *text)
{
    json_t *string = json_string(text);
    if (!document->owned) document->owned = json_array();
    return json_array_append_new(document->owned, string) == 0 ? json_string_value(string) : NULL;
}

bool document_set_path(struct document *document, const char *path)
{
    char *copy = path && path[0] ? strdup(path) : NULL;
    if (path && path[0] && !copy) return false;
    free(document->path);
    document->path = copy;
    return true;
}

size_t document_bytes(const struct document *document)
{
    size_t bytes = sizeof *document;
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = &document->splines[i];
        bytes += sizeof *spline + (size_t)spline->knot_capacity * sizeof *spline->knots + strlen(spline->name) + 1;
    }
    for (int i = 0; i < document->rig_count; i++) bytes += rig_bytes(&document->rigs[i]);
    return bytes + motion_list_bytes(&document->motions);
}

int document_samples(const struct document *document)
{
    return (document->last_frame - document->first_frame) * document->substeps + 1;
}

static int most_samples(int splines, bool limited)
{
    const int each = limited ? LIMITED_MAX_SAMPLES : SPLINE_MAX_SAMPLES;
    return splines > SCENE_MAX_SAMPLES / each ? SCENE_MAX_SAMPLES / splines : each;
}

bool document_check_samples(int splines, long long samples, bool limited, struct error *error)
{
    if (samples <= most_samples(splines, limited)) return true;
    if (samples > SPLINE_MAX_SAMPLES)
        return fail(error, ERROR_INPUT, "at most %d samples a spline, got %lld", SPLINE_MAX_SAMPLES, samples);
    if (limited && samples > LIMITED_MAX_SAMPLES)
        return fail(error, ERROR_INPUT, "at most %d samples where a spline has a low or high limit, got %lld",
                    LIMITED_MAX_SAMPLES, samples);
    return fail(error, ERROR_INPUT, "at most %d samples over all splines, got %d times %lld", SCENE_MAX_SAMPLES,
                splines, samples);
}

int document_longest(const struct document *document)
{
    return (most_samples(document->spline_count, document_is_limited(document)) - 1) / document->substeps;
}

bool document_is_limited(const struct document *document)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (spline_is_limited(&document->splines[i])) return true;
    }
    return false;
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

int document_last_knot_sample(const struct document *document, const struct spline *spline)
{
    return document_samples(document) - (spline_start(spline) == WIGGLY_LOOP ? 2 : 1);
}

int document_find_spline(const struct document *document, const char *name)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (strcmp(document->splines[i].name, name) == 0) return i;
    }
    return -1;
}

int document_find_spline_id(const struct document *document, unsigned id)
{
    for (int i = 0; i < document->spline_count; i++) {
        if (document->splines[i].id == id) return i;
    }
    return -1;
}

bool document_reserve_rigs(struct document *document, int count)
{
    if (count <= document->rig_capacity) return true;
    struct rig *rigs = realloc(document->rigs, (size_t)count * sizeof *rigs);
    if (!rigs) return false;
    document->rigs = rigs;
    document->rig_capacity = count;
    return true;
}

int document_next_rig(const struct document *document, enum rig_kind kind, int from)
{
    for (int i = from; i < document->rig_count; i++) {
        if (document->rigs[i].kind == kind) return i;
    }
    return -1;
}

int document_find_rig(const struct document *document, enum rig_kind kind, int n)
{
    int found = n < 0 ? -1 : document_next_rig(document, kind, 0);
    for (; n > 0 && found >= 0; n--) found = document_next_rig(document, kind, found + 1);
    return found;
}

int document_count_rigs(const struct document *document, enum rig_kind kind)
{
    int count = 0;
    for (int i = 0; i < document->rig_count; i++) count += document->rigs[i].kind == kind;
    return count;
}

int document_rig_number(const struct document *document, int rig)
{
    int number = 0;
    for (int i = 0; i < rig; i++) number += document->rigs[i].kind == document->rigs[rig].kind;
    return number;
}

struct tail *document_tail(const struct document *document, int n)
{
    int found = document_find_rig(document, RIG_TAIL, n);
    return found >= 0 ? &document->rigs[found].tail : NULL;
}

struct character_rig *document_character(const struct document *document, int n)
{
    int found = document_find_rig(document, RIG_CHARACTER, n);
    return found >= 0 ? &document->rigs[found].character : NULL;
}

int document_find_model(const struct document *document, const char *text, bool by_file)
{
    int rig = document_next_rig(document, RIG_MODEL, 0);
    for (; rig >= 0; rig = document_next_rig(document, RIG_MODEL, rig + 1)) {
        const char *own = by_file ? document->rigs[rig].model.model : document->rigs[rig].name;
        if (own && strcmp(own, text) == 0) break;
    }
    return rig;
}

bool document_follows(const struct document *document, int spline, int rig)
{
    const struct joint_motion *motion = document->splines[spline].parameter[PARAMETER_EQUILIBRIUM].motion;
    if (!motion) return false;
    if (document->rigs[rig].kind == RIG_MODEL)
        return document_find_model(document, motion->model, motion->by_file) == rig;
    return motion->chain && document_find_chain(document, motion->chain) == rig;
}

int document_find_chain(const struct document *document, const char *name)
{
    int rig = document_next_rig(document, RIG_CHAIN, 0);
    for (; rig >= 0; rig = document_next_rig(document, RIG_CHAIN, rig + 1)) {
        if (document->rigs[rig].name && strcmp(document->rigs[rig].name, name) == 0) break;
    }
    return rig;
}

int spline_find_knot(const struct document *document, const struct spline *spline, int sample)
{
    int at = spline_lower_bound(document, spline, sample);
    if (at == spline->knot_count || document_sample(document, spline->knots[at].frame) != sample) return -1;
    return at;
}

static bool is_before(const struct document *document, const struct spline *spline, int knot, int sample)
{
    return document_sample(document, spline->knots[knot].frame) < sample;
}

/// The first knot on a sample or after it, of those from `low` on; `high` where all before that lie before the sample.
static int bisect(const struct document *document, const struct spline *spline, int low, int high, int sample)
{
    while (low < high) {
        const int middle = low + (high - low) / 2;
        if (is_before(document, spline, middle, sample))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int spline_lower_bound(const struct document *document, const struct spline *spline, int sample)
{
    return bisect(document, spline, 0, spline->knot_count, sample);
}

int spline_lower_bound_near(const struct document *document, const struct spline *spline, int guess, int sample)
{
    int low = guess < spline->knot_count ? guess : spline->knot_count, high = low, step = 1;
    while (low > 0 && !is_before(document, spline, low - 1, sample)) {
        high = low - 1;
        low = low > step ? low - step : 0;
        step *= 2;
    }
    while (high < spline->knot_count && is_before(document, spline, high, sample)) {
        low = high + 1;
        high = spline->knot_count - high > step ? high + step : spline->knot_count;
        step *= 2;
    }
    return bisect(document, spline, low, high, sample);
}

bool spline_is_limited(const struct spline *spline)
{
    return isfinite(spline->parameter[PARAMETER_LOW].value) || isfinite(spline->parameter[PARAMETER_HIGH].value);
}

void spline_values(const struct spline *spline, int first, int end, double range[2])
{
    range[0] = range[1] = spline->knots[first].value;
    for (int k = first + 1; k < end; k++) {
        const double value = spline->knots[k].value;
        range[0] = value < range[0] ? value : range[0];
        range[1] = value > range[1] ? value : range[1];
    }
}

int spline_find_id(const struct spline *spline, unsigned id)
{
    // Loaded knots have ids in a row: from where it would be if all had, outwards.
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
