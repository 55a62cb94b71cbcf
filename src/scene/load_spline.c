/// Reads the splines of a scene.
#include "base/need.h"
#include "scene/fields.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// Keys that are not parameters.
static const char *const spline_keys[] = {"name", "knots", "color", "spring", "friction", NULL};

/// One of the two limits; null: none.
static void load_limit(struct reader *reader, const struct value limits, int index, double *limit)
{
    const char expected[] = "two numbers, or null for none";
    const size_t count = json_array_size(limits.json);
    if (!json_is_array(limits.json) || count != 2) {
        if (index == 0) reader_array(reader, limits, 2, expected);
        return;
    }
    const struct value value = reader_element(&limits, index);
    if (!json_is_null(value.json)) reader_number(reader, value, true, range_any, limit);
}

/// One of the two numbers of a variation. Its unknown keys are kept under its name among the spline's unknown keys.
static void load_variation(struct reader *reader, const struct value variation, enum parameter parameter,
                           double *number, json_t **extra)
{
    static const char *const keys[] = {"seed", "amount", NULL};
    const struct parameter_row *row = &parameter_rows[parameter];
    if (!json_is_object(variation.json)) {
        if (parameter == PARAMETER_SEED) reader_unexpected(reader, variation, "{\"seed\", \"amount\"}");
        return;
    }
    const struct range range = {row->minimum, row->maximum, false};
    if (parameter == PARAMETER_VARIATION) {
        reader_number(reader, reader_member(&variation, "amount"), true, range, number);
        return;
    }
    int seed = 0;
    const struct value value = reader_member(&variation, "seed");
    if (value.json && reader_integer(reader, value, 0, (int)row->maximum, &seed)) *number = seed;
    reader_put(extra, row->key, reader_extra(reader, &variation, keys));
}

/// false if a word is not one of the choices.
static bool load_parameter(struct reader *reader, const struct value *object, struct spline *spline,
                           enum parameter parameter, json_t **extra)
{
    struct param *param = &spline->parameter[parameter];
    const struct parameter_row *row = &parameter_rows[parameter];
    const struct value value = reader_member(object, parameter_key(parameter));
    struct range range = {row->minimum, parameter_maximum(parameter, spline_mode(spline)), false};
    if (!value.json) return true;
    if (row->kind == PARAMETER_CHOICE) {
        int word = reader_word(reader, value, row->words);
        if (word >= 0) param->value = word;
        return word >= 0;
    }
    if (parameter == PARAMETER_VARIATION || parameter == PARAMETER_SEED) {
        load_variation(reader, value, parameter, &param->value, extra);
    } else if (row->kind == PARAMETER_LIMIT) {
        load_limit(reader, value, parameter == PARAMETER_HIGH, &param->value);
    } else if (row->kind == PARAMETER_TRACK) {
        reader_param(reader, value, range, parameter_key(parameter), parameter == PARAMETER_EQUILIBRIUM, param,
                     extra);
    } else {
        reader_number(reader, value, true, range, &param->value);
    }
    return true;
}

/// The paper's spring and friction (eq. 12), not for Wiggly splines; they are converted to frequency and damping.
static void load_spring(struct reader *reader, const struct value *object, struct spline *spline)
{
    const struct value k = reader_member(object, "spring"), gamma = reader_member(object, "friction");
    const struct value first = k.json ? k : gamma;
    const struct range range = {0, INFINITY, false};
    double spring = 0, friction = 0;
    if (!first.json) return;
    if (json_object_get(object->json, "frequency") || json_object_get(object->json, "damping")) {
        reader_fail(reader, &first.at, "expected either spring and friction or frequency and damping, got both");
    } else if (spline_mode(spline) == WIGGLY_COMPLEX) {
        reader_fail(reader, &first.at, "expected frequency and damping in a Wiggly spline, got %s", first.at.key);
    }
    if (!reader_number(reader, k, false, range, &spring) || !reader_number(reader, gamma, false, range, &friction))
        return;
    wiggly_from_spring(spring, friction, &spline->parameter[PARAMETER_FREQUENCY].value,
                       &spline->parameter[PARAMETER_DAMPING].value);
}

/// A still knot may have no slope and no phase.
static void load_still(struct reader *reader, const struct value *object, void *at)
{
    static const char *const held[] = {"settles", "value", "im", "slope", "stiffness"};
    struct knot *knot = at;
    reader_flag(reader, reader_member(object, "still"), &knot->still);
    if (knot->still) knot->value = NAN;
    for (int i = 0; knot->still && i < 5; i++) {
        const struct value value = reader_member(object, held[i]);
        if (value.json) reader_fail(reader, &value.at, "expected none beside \"still\"");
    }
}

static void load_value(struct reader *reader, const struct value *object, void *at)
{
    struct knot *knot = at;
    const struct range any = FIELD_ANY;
    if (!knot->still) reader_number(reader, reader_member(object, "value"), true, any, &knot->value);
}

static void print_value(struct members *members, const struct document *document, const void *at, const char *folder)
{
    const struct knot *knot = at;
    (void)document, (void)folder;
    if (!knot->still) member_number(members, "value", knot->value);
}

const struct field knot_fields[] = {
    {FIELD("frame", FIELD_NUMBER, struct knot, frame), .range = FIELD_ANY, .is_required = true},
    {FIELD("still", FIELD_FLAG, struct knot, still), .is_quiet = true, .load = load_still},
    {FIELD("settles", FIELD_FLAG, struct knot, settles), .is_quiet = true},
    {FIELD("value", FIELD_NUMBER, struct knot, value), .range = FIELD_ANY, .load = load_value, .print = print_value},
    {FIELD("im", FIELD_NUMBER, struct knot, phase), .range = FIELD_ANY, .flag = offsetof(struct knot, has_phase)},
    {FIELD("slope", FIELD_NUMBER, struct knot, slope), .range = FIELD_ANY, .flag = offsetof(struct knot, has_slope)},
    {FIELD("stiffness", FIELD_NUMBER, struct knot, stiffness), .range = FIELD_POSITIVE,
     .usual = {KNOT_DEFAULT_STIFFNESS}, .is_quiet = true},
    FIELD_END(struct knot),
};

const struct field knot_list_field = {
    FIELD_LIST_OF("knots", struct spline, knots, knot_count, knot_fields, SCENE_MAX_KNOTS)};

/// By frame, then in file order, in which ids rise.
static int compare_knots(const void *a, const void *b)
{
    const struct knot *left = a, *right = b;
    if (left->frame != right->frame) return left->frame < right->frame ? -1 : 1;
    return left->id < right->id ? -1 : left->id > right->id;
}

static void check_domain(struct reader *reader, const struct where *at, const struct spline *spline, double frame)
{
    const struct where frame_at = {.parent = at, .key = "frame"};
    const int last = document_last_knot_sample(reader->document, spline);
    struct error error;
    if (!document_has_frame(reader->document, frame, last, &error)) reader_fail(reader, &frame_at, "%s", error.text);
}

/// Sorts the knots and checks them against each other. `first_id` is the id of the first one in the file.
static void check_knots(struct reader *reader, const struct where *knots_at, struct spline *spline, unsigned first_id)
{
    struct document *document = reader->document;
    for (int i = 0; i < spline->knot_count; i++) {
        struct where at = {.parent = knots_at, .index = (size_t)i};
        check_domain(reader, &at, spline, spline->knots[i].frame);
    }
    qsort(spline->knots, (size_t)spline->knot_count, sizeof *spline->knots, compare_knots);
    for (int i = 1; i < spline->knot_count; i++) {
        const struct knot *one = &spline->knots[i - 1], *other = &spline->knots[i];
        if (document_sample(document, one->frame) != document_sample(document, other->frame)) continue;
        const uint32_t first = one->id < other->id ? one->id : other->id, later = one->id + other->id - first;
        struct where at = {.parent = knots_at, .index = later - first_id};
        struct where frame_at = {.parent = &at, .key = "frame"};
        reader_fail(reader, &frame_at, "expected a sample without a knot, got that of knots[%u]", first - first_id);
    }
}

/// The low limit must be below the high one, and every knot within.
static void check_limits(struct reader *reader, const struct where *spline_at, const struct where *knots_at,
                         const struct spline *spline, unsigned first_id)
{
    const double low = spline->parameter[PARAMETER_LOW].value, high = spline->parameter[PARAMETER_HIGH].value;
    struct where limits_at = {.parent = spline_at, .key = parameter_key(PARAMETER_LOW)};
    if (!(low < high)) {
        reader_fail(reader, &limits_at, "expected the low limit below the high one, got %.10g and %.10g", low, high);
        return;
    }
    for (int i = 0; i < spline->knot_count; i++) {
        const struct knot *knot = &spline->knots[i];
        if (knot->still) continue;
        struct where at = {.parent = knots_at, .index = knot->id - first_id};
        struct where value_at = {.parent = &at, .key = "value"};
        if (knot->value < low)
            reader_fail(reader, &value_at, "expected at least the low limit, %.10g, got %.10g", low, knot->value);
        if (knot->value > high)
            reader_fail(reader, &value_at, "expected at most the high limit, %.10g, got %.10g", high, knot->value);
    }
}

static void load_knots(struct reader *reader, const struct value *object, struct spline *spline)
{
    const struct value knots = reader_member(object, "knots");
    const int errors = reader->errors;
    const unsigned first_id = reader->document->next_id;
    reader->knot_count += json_array_size(knots.json);
    if (reader->knot_count > SCENE_MAX_KNOTS) {
        reader_fail(reader, &knots.at, "expected at most %d knots over all splines, got more", SCENE_MAX_KNOTS);
        return;
    }
    list_load(reader, object, &knot_list_field, spline);
    spline->knot_capacity = spline->knot_count;
    for (int i = 0; i < spline->knot_count; i++) spline->knots[i].id = reader->document->next_id++;
    if (reader->errors > errors) return;
    if (reader->has_domain && spline->knot_count > 0) check_knots(reader, &knots.at, spline, first_id);
    check_limits(reader, &object->at, &knots.at, spline, first_id);
}

static void check_loop(struct reader *reader, const struct where *spline_at, const struct spline *spline)
{
    struct where at = {.parent = spline_at, .key = "start"};
    if (spline_start(spline) == WIGGLY_LOOP && reader->has_domain && document_samples(reader->document) == 1) {
        reader_fail(reader, &at, "expected more than one frame for a loop, got one");
    }
}

/// Samples at a limit are held like knots, so a spline with limits costs more.
static void check_length(struct reader *reader, const struct where *spline_at, const struct spline *spline)
{
    struct where at = {.parent = spline_at, .key = parameter_key(PARAMETER_LOW)};
    struct error error;
    if (!reader->has_domain || !spline_is_limited(spline)) return;
    if (!document_check_samples(1, ++reader->limited_count, document_samples(reader->document), &error))
        reader_fail(reader, &at, "expected %s", error.text);
}

static void load_color(struct reader *reader, struct value value, int *color)
{
    const char *text = json_string_value(value.json);
    if (!value.json || (text && color_parse(text, color))) return;
    if (text) {
        reader_fail(reader, &value.at, "expected a colour such as \"#FFB000\", got \"%s\"", text);
    } else {
        reader_unexpected(reader, value, "a colour such as \"#FFB000\"");
    }
}

static json_t *load_extra(struct reader *reader, const struct value *object)
{
    const char *known[PARAMETER_COUNT + sizeof spline_keys / sizeof *spline_keys];
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) known[p] = parameter_key(p);
    memcpy(known + PARAMETER_COUNT, spline_keys, sizeof spline_keys);
    return reader_extra(reader, object, known);
}

static void load_spline(struct reader *reader, struct value object, struct spline *spline)
{
    // the other parameters' limits depend on the mode
    if (load_parameter(reader, &object, spline, PARAMETER_MODE, NULL)) load_spring(reader, &object, spline);
    json_t *extra = load_extra(reader, &object);
    for (enum parameter p = PARAMETER_MODE + 1; p < PARAMETER_COUNT; p++) {
        load_parameter(reader, &object, spline, p, &extra);
    }
    spline->extra = reader_keep(reader, extra);
    load_color(reader, reader_member(&object, "color"), &spline->color);
    check_loop(reader, &object.at, spline);
    check_length(reader, &object.at, spline);
    load_knots(reader, &object, spline);
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
    reader->names = need((size_t)document->spline_count, sizeof *reader->names);
    for (int i = 0; i < document->spline_count; i++) {
        const char *name = document->splines[i]->name;
        if (name) reader->names[reader->name_count++] = (struct name_index){name, i};
    }
    qsort(reader->names, (size_t)reader->name_count, sizeof *reader->names, compare_names);
    for (int i = 1; i < reader->name_count; i++) {
        const struct name_index *name = &reader->names[i];
        if (strcmp(name[-1].name, name->name) != 0) continue;
        struct where spline_at = {.parent = splines_at, .index = (size_t)name->spline};
        struct where at = {.parent = &spline_at, .key = "name"};
        reader_fail(reader, &at, "expected a unique name, got \"%s\", the name of splines[%d]", name->name,
                    name[-1].spline);
    }
}

void load_splines(struct reader *reader, const struct value *scene)
{
    const struct value splines = reader_member(scene, "splines");
    int count = reader_objects(reader, splines, SOURCE_MAX_OBJECTS);
    if (count <= 0) return;
    struct document *document = reader->document;
    document->splines = need((size_t)count, sizeof *document->splines);
    document->spline_count = count;
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&splines, i);
        document->splines[i] = spline_create();
        document->splines[i]->id = document->next_id++;
        document->splines[i]->name = reader_name(reader, reader_member(&object, "name"));
    }
    index_names(reader, &splines.at);
    for (int i = 0; i < count; i++) load_spline(reader, reader_element(&splines, i), document->splines[i]);
}
