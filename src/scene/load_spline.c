/// Reads the splines of a scene.
#include "scene/color.h"
#include "scene/reader.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Beside the parameters.
static const char *const spline_keys[] = {"name", "knots", "color", NULL};
static const char *const knot_keys[] = {"frame", "value", "slope", "stiffness", NULL};

/// One spline of the file while it is read.
struct part {
    const struct where *at;
    json_t *object;
    struct spline *spline;
};

/// false where a word is none of those it may be.
static bool load_parameter(struct reader *reader, const struct part *part, enum parameter parameter, json_t **extra)
{
    struct where at;
    struct param *param = &part->spline->parameter[parameter];
    const struct parameter_row *row = &parameter_rows[parameter];
    json_t *value = reader_member(part->at, part->object, row->name, &at);
    struct range range = {row->minimum, parameter_maximum(parameter, spline_mode(part->spline)), false};
    if (!value) return true;
    if (row->kind == PARAMETER_CHOICE) {
        int word = reader_word(reader, &at, value, row->words, -1);
        if (word >= 0) param->value = word;
        return word >= 0;
    }
    if (row->kind == PARAMETER_TRACK) {
        reader_param(reader, &at, value, range, at.key, param, extra);
    } else {
        reader_number(reader, &at, value, true, range, &param->value);
    }
    return true;
}

/// The paper's pair stands in place of frequency and damping, outside complex mode.
static void load_spring(struct reader *reader, const struct part *part)
{
    bool ratios = json_object_get(part->object, "frequency") || json_object_get(part->object, "damping");
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        struct where at;
        const char *name = parameter_rows[p].name;
        if (parameter_rows[p].pair != PAIR_SPRING || !reader_member(part->at, part->object, name, &at)) continue;
        part->spline->spring_friction = true;
        if (ratios) {
            reader_fail(reader, &at, "expected either spring and friction or frequency and damping, got both");
        } else if (spline_mode(part->spline) == WIGGLY_COMPLEX) {
            reader_fail(reader, &at, "expected frequency and damping in complex mode, got %s", name);
        }
    }
}

bool reader_knot(struct reader *reader, const struct where *at, json_t *object, struct knot *knot)
{
    struct where frame_at, value_at, slope_at, stiffness_at;
    const json_t *frame = reader_member(at, object, "frame", &frame_at);
    const json_t *value = reader_member(at, object, "value", &value_at);
    const json_t *slope = reader_member(at, object, "slope", &slope_at);
    const json_t *stiffness = reader_member(at, object, "stiffness", &stiffness_at);
    struct range positive = {0, INFINITY, true};
    *knot = (struct knot){.stiffness = KNOT_DEFAULT_STIFFNESS, .has_slope = slope, .id = reader->document->next_id++};
    bool good = reader_number(reader, &frame_at, frame, true, range_any, &knot->frame);
    good &= reader_number(reader, &value_at, value, true, range_any, &knot->value);
    good &= reader_number(reader, &slope_at, slope, false, range_any, &knot->slope);
    good &= reader_number(reader, &stiffness_at, stiffness, false, positive, &knot->stiffness);
    knot->extra = reader_keep(reader, reader_extra(reader, at, object, knot_keys));
    return good;
}

/// By sample, then as in the file (ids rise in the file's order).
static int compare_knots(const void *a, const void *b, void *document)
{
    const struct knot *left = a, *right = b;
    int l = document_sample(document, left->frame), r = document_sample(document, right->frame);
    if (l != r) return l < r ? -1 : 1;
    return left->id < right->id ? -1 : left->id > right->id;
}

static void check_domain(struct reader *reader, const struct where *at, const struct spline *spline, double frame)
{
    const struct document *document = reader->document;
    int sample = document_sample(document, frame), last = document_samples(document) - 1;
    struct where frame_at = {.parent = at, .key = "frame"};
    if (sample < 0 || sample > last) {
        reader_fail(reader, &frame_at, "expected a frame from %d to %d, got %.10g", document->first_frame,
                    document->last_frame, frame);
    } else if (sample > document_last_knot_sample(document, spline)) {
        reader_fail(reader, &frame_at,
                    "expected a frame before %d, because the last frame of a loop repeats the first, got %.10g",
                    document->last_frame, frame);
    }
}

/// Whether the other sample that a knot's slope is measured to (eq. 9) is fixed too.
static bool slope_is_fixed(const struct document *document, const struct spline *spline, int at)
{
    int sample = document_sample(document, spline->knots[at].frame), samples = document_samples(document);
    int other = sample + 1;
    if (spline_start(spline) == WIGGLY_LOOP) {
        other %= samples > 1 ? samples - 1 : 1;
    } else if (other == samples) {
        other = sample - 1;
    }
    return other != sample && spline_find_knot(document, spline, other) >= 0;
}

/// Sorts the knots and checks what they are to each other. `first_id` is that of the file's first one.
static void check_knots(struct reader *reader, const struct where *knots_at, struct spline *spline, unsigned first_id)
{
    struct document *document = reader->document;
    for (int i = 0; i < spline->knot_count; i++) {
        struct where at = {.parent = knots_at, .index = (size_t)i};
        check_domain(reader, &at, spline, spline->knots[i].frame);
    }
    qsort_r(spline->knots, (size_t)spline->knot_count, sizeof *spline->knots, compare_knots, document);
    for (int i = 0; i < spline->knot_count; i++) {
        const struct knot *knot = &spline->knots[i], *before = i > 0 ? knot - 1 : NULL;
        struct where at = {.parent = knots_at, .index = knot->id - first_id};
        struct where frame_at = {.parent = &at, .key = "frame"}, slope_at = {.parent = &at, .key = "slope"};
        if (before && document_sample(document, before->frame) == document_sample(document, knot->frame)) {
            reader_fail(reader, &frame_at, "expected a sample of its own, got that of knots[%u]",
                        before->id - first_id);
        } else if (knot->has_slope && slope_is_fixed(document, spline, i)) {
            reader_warn(reader, &slope_at, "slope has no effect: the next sample is a knot too");
        }
    }
}

static void load_knots(struct reader *reader, const struct part *part)
{
    struct where at;
    const json_t *knots = reader_member(part->at, part->object, "knots", &at);
    int count = reader_objects(reader, &at, knots, SCENE_MAX_KNOTS);
    if (count <= 0) return;
    reader->knot_count += count;
    if (reader->knot_count > SCENE_MAX_KNOTS) {
        reader_fail(reader, &at, "expected at most %d knots over all splines, got more", SCENE_MAX_KNOTS);
        return;
    }
    struct spline *spline = part->spline;
    spline->knots = calloc((size_t)count, sizeof *spline->knots);
    if (!spline->knots) {
        reader_no_memory(reader);
        return;
    }
    spline->knot_count = spline->knot_capacity = count;
    unsigned first_id = reader->document->next_id;
    bool good = true;
    for (int i = 0; i < count; i++) {
        struct where knot_at = {.parent = &at, .index = (size_t)i};
        good &= reader_knot(reader, &knot_at, json_array_get(knots, (size_t)i), &spline->knots[i]);
    }
    if (good && reader->has_domain) check_knots(reader, &at, spline, first_id);
}

static void check_loop(struct reader *reader, const struct part *part)
{
    struct where at = {.parent = part->at, .key = "start"};
    if (spline_start(part->spline) == WIGGLY_LOOP && reader->has_domain && document_samples(reader->document) == 1) {
        reader_fail(reader, &at, "expected more than one frame for a loop, got one");
    }
}

static void load_color(struct reader *reader, const struct part *part)
{
    struct where at;
    const json_t *value = reader_member(part->at, part->object, "color", &at);
    const char *text = json_string_value(value);
    if (!value || (text && color_parse(text, &part->spline->color))) return;
    if (text) {
        reader_fail(reader, &at, "expected a colour such as \"#FFB000\", got \"%s\"", text);
    } else {
        reader_unexpected(reader, &at, "a colour such as \"#FFB000\"", value);
    }
}

static json_t *load_extra(struct reader *reader, const struct part *part)
{
    const char *known[PARAMETER_COUNT + sizeof spline_keys / sizeof *spline_keys];
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) known[p] = parameter_rows[p].name;
    memcpy(known + PARAMETER_COUNT, spline_keys, sizeof spline_keys);
    return reader_extra(reader, part->at, part->object, known);
}

static void load_spline(struct reader *reader, const struct where *at, json_t *object, struct spline *spline)
{
    struct part part = {at, object, spline};
    if (load_parameter(reader, &part, PARAMETER_MODE, NULL)) load_spring(reader, &part); // limits go by the mode
    json_t *extra = load_extra(reader, &part);
    for (enum parameter p = PARAMETER_MODE + 1; p < PARAMETER_COUNT; p++) load_parameter(reader, &part, p, &extra);
    spline->extra = reader_keep(reader, extra);
    load_color(reader, &part);
    check_loop(reader, &part);
    load_knots(reader, &part);
}

static int compare_names(const void *a, const void *b)
{
    const struct name_index *left = a, *right = b;
    int names = strcmp(left->name, right->name);
    return names ? names : (left->spline > right->spline) - (left->spline < right->spline);
}

static void index_names(struct reader *reader, const struct where *splines_at)
{
    const struct document *document = reader->document;
    reader->names = calloc((size_t)document->spline_count, sizeof *reader->names);
    if (!reader->names) {
        reader_no_memory(reader);
        return;
    }
    for (int i = 0; i < document->spline_count; i++) {
        const char *name = document->splines[i].name;
        if (name) reader->names[reader->name_count++] = (struct name_index){name, i};
    }
    qsort(reader->names, (size_t)reader->name_count, sizeof *reader->names, compare_names);
    for (int i = 1; i < reader->name_count; i++) {
        const struct name_index *name = &reader->names[i];
        if (strcmp(name[-1].name, name->name) != 0) continue;
        struct where spline_at = {.parent = splines_at, .index = (size_t)name->spline};
        struct where at = {.parent = &spline_at, .key = "name"};
        reader_fail(reader, &at, "expected a name of its own, got \"%s\" as splines[%d] has", name->name,
                    name[-1].spline);
    }
}

void load_splines(struct reader *reader, const struct where *scene_at, const json_t *scene)
{
    struct where splines_at, name_at;
    const json_t *splines = reader_member(scene_at, scene, "splines", &splines_at);
    int count = reader_objects(reader, &splines_at, splines, SOURCE_MAX_OBJECTS);
    if (count <= 0) return;
    struct document *document = reader->document;
    document->splines = calloc((size_t)count, sizeof *document->splines);
    if (!document->splines) {
        reader_no_memory(reader);
        return;
    }
    document->spline_count = document->spline_capacity = count;
    for (int i = 0; i < count; i++) {
        struct where at = {.parent = &splines_at, .index = (size_t)i};
        const json_t *name = reader_member(&at, json_array_get(splines, (size_t)i), "name", &name_at);
        spline_reset(&document->splines[i]);
        document->splines[i].id = document->next_spline_id++;
        document->splines[i].name = reader_name(reader, &name_at, name);
    }
    index_names(reader, &splines_at);
    for (int i = 0; i < count; i++) {
        struct where at = {.parent = &splines_at, .index = (size_t)i};
        load_spline(reader, &at, json_array_get(splines, (size_t)i), &document->splines[i]);
    }
}
