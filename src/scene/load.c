/// Scene files: reads one and checks it as a whole, and writes one.
#include "scene/load.h"
#include "base/file.h"
#include "base/json.h"
#include "base/need.h"
#include "scene/fields.h"
#include "scene/pins.h"
#include "scene/text.h"
#include "scene/warnings.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

// --- splines

/// Keys that are not parameters.
static const char *const spline_keys[] = {"name", "knots", "color", "folder", "locked", "spring", "friction", NULL};

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
    if (parameter == PARAMETER_VARIATION) { // with the seed, as {"seed", "amount"}
        if (json_is_object(value.json))
            reader_number(reader, reader_member(&value, "amount"), true, range, &param->value);
    } else if (parameter == PARAMETER_SEED) {
        static const char *const keys[] = {"seed", "amount", NULL};
        int seed = (int)param->value;
        if (json_is_object(value.json)) {
            reader_integer(reader, reader_member(&value, "seed"), 0, (int)row->maximum, &seed);
            param->value = seed;
            reader_put(extra, row->key, reader_extra(reader, &value, keys));
        } else {
            reader_unexpected(reader, value, "{\"seed\", \"amount\"}");
        }
    } else if (row->kind == PARAMETER_LIMIT) { // both, as [low, high]
        const bool is_high = parameter == PARAMETER_HIGH;
        if (json_is_array(value.json) && json_array_size(value.json) == 2) {
            const struct value limit = reader_element(&value, is_high);
            if (!json_is_null(limit.json)) reader_number(reader, limit, true, range_any, &param->value);
        } else if (!is_high) {
            reader_array(reader, value, 2, "two numbers, or null for none");
        }
    } else if (row->kind == PARAMETER_TRACK) {
        reader_put(extra, parameter_key(parameter),
                   reader_param(reader, value, range, parameter == PARAMETER_EQUILIBRIUM, param));
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

static int compare_names(const void *a, const void *b)
{
    const struct name_index *left = a, *right = b;
    int names = strcmp(left->name, right->name);
    return names ? names : (left->spline > right->spline) - (left->spline < right->spline);
}

/// Reads the knots and checks them: each inside the frames, alone on its sample and within the spline's limits.
static void load_knots(struct reader *reader, const struct value *object, struct spline *spline)
{
    struct document *document = reader->document;
    const struct value knots = reader_member(object, "knots");
    const int errors = reader->errors;
    const unsigned first_id = document->next_id;
    reader->knot_count += json_array_size(knots.json);
    if (reader->knot_count > SCENE_MAX_KNOTS) {
        reader_fail(reader, &knots.at, "expected at most %d knots over all splines, got more", SCENE_MAX_KNOTS);
        return;
    }
    list_load(reader, object, &knot_list_field, spline);
    for (int i = 0; i < spline->knot_count; i++) spline->knots[i].id = document->next_id++;
    if (reader->errors > errors) return;

    const int placed = reader->has_domain ? spline->knot_count : 0;
    for (int i = 0; i < placed; i++) {
        const struct where at = {.parent = &knots.at, .index = (size_t)i}, frame_at = {.parent = &at, .key = "frame"};
        const int last = document_last_knot_sample(document, spline);
        struct error error;
        if (!document_has_frame(document, spline->knots[i].frame, last, &error))
            reader_fail(reader, &frame_at, "%s", error.text);
    }
    if (placed > 0) qsort(spline->knots, (size_t)placed, sizeof *spline->knots, compare_knots);
    for (int i = 1; i < placed; i++) {
        const struct knot *one = &spline->knots[i - 1], *other = &spline->knots[i];
        if (document_sample(document, one->frame) != document_sample(document, other->frame)) continue;
        const uint32_t first = one->id < other->id ? one->id : other->id, later = one->id + other->id - first;
        const struct where at = {.parent = &knots.at, .index = later - first_id};
        const struct where frame_at = {.parent = &at, .key = "frame"};
        reader_fail(reader, &frame_at, "expected a sample without a knot, got that of knots[%u]", first - first_id);
    }

    const double low = spline->parameter[PARAMETER_LOW].value, high = spline->parameter[PARAMETER_HIGH].value;
    const struct where limits_at = {.parent = &object->at, .key = parameter_key(PARAMETER_LOW)};
    if (!(low < high)) {
        reader_fail(reader, &limits_at, "expected the low limit below the high one, got %.10g and %.10g", low, high);
        return;
    }
    for (int i = 0; i < spline->knot_count; i++) {
        const struct knot *knot = &spline->knots[i];
        if (knot->still) continue;
        const struct where at = {.parent = &knots.at, .index = knot->id - first_id};
        const struct where value_at = {.parent = &at, .key = "value"};
        if (knot->value < low)
            reader_fail(reader, &value_at, "expected at least the low limit, %.10g, got %.10g", low, knot->value);
        if (knot->value > high)
            reader_fail(reader, &value_at, "expected at most the high limit, %.10g, got %.10g", high, knot->value);
    }
}

static void load_splines(struct reader *reader, const struct value *scene)
{
    const struct value splines = reader_member(scene, "splines");
    int count = reader_objects(reader, splines, SOURCE_MAX_OBJECTS);
    if (count <= 0) return;
    struct document *document = reader->document;
    document->splines = need((size_t)count, sizeof *document->splines);
    document->spline_count = count;
    reader->names = need((size_t)count, sizeof *reader->names);
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&splines, i);
        struct spline *spline = document->splines[i] = spline_create();
        spline->id = document->next_id++;
        spline->name = reader_name(reader, reader_member(&object, "name"));
        if (spline->name) reader->names[reader->name_count++] = (struct name_index){spline->name, i};
    }
    qsort(reader->names, (size_t)reader->name_count, sizeof *reader->names, compare_names);
    for (int i = 1; i < reader->name_count; i++) {
        const struct name_index *name = &reader->names[i];
        if (strcmp(name[-1].name, name->name) != 0) continue;
        const struct where spline_at = {.parent = &splines.at, .index = (size_t)name->spline};
        const struct where at = {.parent = &spline_at, .key = "name"};
        reader_fail(reader, &at, "expected a unique name, got \"%s\", the name of splines[%d]", name->name,
                    name[-1].spline);
    }
    for (int i = 0; i < count; i++) {
        const struct value object = reader_element(&splines, i);
        struct spline *spline = document->splines[i];
        const int samples = document_samples(document);
        // the other parameters' limits depend on the mode
        if (load_parameter(reader, &object, spline, PARAMETER_MODE, NULL)) load_spring(reader, &object, spline);
        const char *known[PARAMETER_COUNT + sizeof spline_keys / sizeof *spline_keys];
        for (enum parameter p = 0; p < PARAMETER_COUNT; p++) known[p] = parameter_key(p);
        memcpy(known + PARAMETER_COUNT, spline_keys, sizeof spline_keys);
        json_t *extra = reader_extra(reader, &object, known);
        for (enum parameter p = PARAMETER_MODE + 1; p < PARAMETER_COUNT; p++)
            load_parameter(reader, &object, spline, p, &extra);
        spline->extra = reader_keep(reader, extra);

        const struct value color = reader_member(&object, "color");
        const char *text = json_string_value(color.json);
        if (color.json && !text) reader_unexpected(reader, color, "a colour such as \"#FFB000\"");
        if (text && !color_parse(text, &spline->color))
            reader_fail(reader, &color.at, "expected a colour such as \"#FFB000\", got \"%s\"", text);
        const struct value folder = reader_member(&object, "folder");
        if (folder.json) spline->folder = reader_name(reader, folder);
        reader_flag(reader, reader_member(&object, "locked"), &spline->locked);

        const struct where start_at = {.parent = &object.at, .key = "start"};
        if (spline_start(spline) == WIGGLY_LOOP && reader->has_domain && samples == 1)
            reader_fail(reader, &start_at, "expected more than one frame for a loop, got one");

        // Samples at a limit are held like knots, so a spline with limits costs more.
        const struct where limits_at = {.parent = &object.at, .key = parameter_key(PARAMETER_LOW)};
        struct error error;
        if (reader->has_domain && spline_is_limited(spline) &&
            !document_check_samples(1, ++reader->limited_count, samples, &error))
            reader_fail(reader, &limits_at, "expected %s", error.text);

        load_knots(reader, &object, spline);
    }
}

// --- the scene

enum { FORMAT_VERSION = 2 };

static const char *const scene_keys[] = {"wiggly",  "about", "fps",      "substeps",   "frames",
                                         "splines", "rigs",  "recovers", "background", NULL};

const struct field background_fields[] = {
    {FIELD("file", FIELD_PATH, struct background_file, file), .is_required = true},
    {FIELD("offset", FIELD_WHOLE, struct background_file, offset),
     .range = {-SCENE_MAX_FRAME, SCENE_MAX_FRAME, false}, .is_quiet = true},
    FIELD_END(struct background_file),
};

/// Reads fps, substeps and frames, and checks the number of samples over all splines.
static void load_domain(struct reader *reader, const struct value *scene)
{
    struct document *document = reader->document;
    const struct value range = reader_member(scene, "frames");
    struct range fps_range = {0, SCENE_MAX_FPS, true};
    int frames[2] = {0, 0};
    bool good = reader_number(reader, reader_member(scene, "fps"), false, fps_range, &document->fps);
    good &= reader_integer(reader, reader_member(scene, "substeps"), 1, SCENE_MAX_SUBSTEPS, &document->substeps);
    const bool is_pair = reader_array(reader, range, 2, "[first, last]");
    bool has_frames = is_pair;
    for (int i = 0; i < 2 && is_pair; i++)
        has_frames &=
            reader_integer(reader, reader_element(&range, i), -SCENE_MAX_FRAME, SCENE_MAX_FRAME, &frames[i]);
    if (has_frames && frames[1] < frames[0])
        has_frames = reader_fail(reader, &range.at, "expected the last frame not before the first, got [%d, %d]",
                                 frames[0], frames[1]);
    if (!good || !has_frames) return;
    long long samples = ((long long)frames[1] - frames[0]) * document->substeps + 1;
    size_t splines = json_array_size(json_object_get(scene->json, "splines"));
    struct error error;
    if (!document_check_samples(splines < INT_MAX ? (int)splines : INT_MAX, 0, samples, &error)) {
        reader_fail(reader, &range.at, "expected %s", error.text);
        return;
    }
    document->first_frame = frames[0];
    document->last_frame = frames[1];
    reader->has_domain = true;
}

static void validate_scene(struct reader *reader, const struct where *scene_at)
{
    const struct document *document = reader->document;
    const struct where splines_at = {.parent = scene_at, .key = "splines"};
    const struct where rigs_at = {.parent = scene_at, .key = "rigs"};
    struct order_cycle cycle;
    struct error error;
    if (!scene_has_order(document, &cycle)) {
        const struct spline *spline = document->splines[cycle.spline];
        const struct where spline_at = {.parent = &splines_at, .index = (size_t)cycle.spline};
        const struct where at = {.parent = &spline_at, .key = parameter_key(cycle.parameter)};
        const int leader = spline->parameter[cycle.parameter].track;
        reader_fail(reader, &at, "expected tracks without a cycle, got \"%s\", which follows \"%s\" itself",
                    document->splines[leader]->name, spline->name);
    }
    if (!document_check_joints(document, &error)) reader_fail(reader, &rigs_at, "expected %s", error.text);

    const double limit = 0.5 / document_step(document);
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = document->splines[i];
        const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
        const struct param *bandwidth = &spline->parameter[PARAMETER_BANDWIDTH];
        const bool is_wide = spline_mode(spline) == WIGGLY_COMPLEX && bandwidth->track < 0;
        const double highest = frequency->value * (1 + (is_wide ? bandwidth->value : 0));
        if (spline_mode(spline) == WIGGLY_CUBIC || frequency->track >= 0 || highest <= limit) continue;
        const struct where spline_at = {.parent = &splines_at, .index = (size_t)i};
        const struct where at = {.parent = &spline_at, .key = "frequency"};
        reader_warn(reader, &at, "%.4g Hz is above half the sample rate, %.4g Hz: it aliases", highest, limit);
    }
    if (!reader->has_domain) return;

    for (int i = 0; i < document->spline_count; i++) { // slopes and phases without effect; of phases once per spline
        const struct spline *spline = document->splines[i];
        const struct where spline_at = {.parent = &splines_at, .index = (size_t)i};
        const struct where knots_at = {.parent = &spline_at, .key = "knots"};
        unsigned first = UINT_MAX; // the id of the first knot in the file; the others follow one by one
        for (int k = 0; k < spline->knot_count; k++)
            first = spline->knots[k].id < first ? spline->knots[k].id : first;
        const int pose = spline_idle_pose(spline);
        for (int k = 0; k < spline->knot_count; k++) {
            const struct where at = {.parent = &knots_at, .index = spline->knots[k].id - first};
            const struct where im_at = {.parent = &at, .key = "im"}, slope_at = {.parent = &at, .key = "slope"};
            const char *why = knot_idle_slope(document, i, k);
            if (k == pose)
                reader_warn(reader, &im_at,
                            "the pose holds only its value, because only Wiggly splines have a phase");
            if (why) reader_warn(reader, &slope_at, "slope has no effect: %s", why);
        }
    }

    struct pin_trouble trouble;
    if (reader->errors > 0 || pins_check(document, &trouble)) return;
    const struct rig *rig = document->rigs[trouble.rig];
    size_t index = 0; // of the pin in the file: ids rise there, while rig->pins is in order of frames
    for (int i = 0; trouble.pin >= 0 && i < rig->pin_count; i++) index += rig->pins[i].id < rig->pins[trouble.pin].id;
    const struct where rig_at = {.parent = &rigs_at, .index = (size_t)reader->places[trouble.rig]};
    const struct where pins_at = {.parent = &rig_at, .key = trouble.pin >= 0 ? "pins" : trouble.member};
    const struct where at = {.parent = &pins_at, .index = index};
    const struct where member_at = {.parent = &at, .key = trouble.member};
    reader_fail(reader, trouble.pin >= 0 ? &member_at : &pins_at, "%s", trouble.error.text);
}

static void load_scene(struct reader *reader, json_t *json)
{
    const struct value scene = {.json = json};
    if (!json_is_object(json)) {
        reader_unexpected(reader, scene, "an object");
        return;
    }
    const struct value format = reader_member(&scene, "wiggly"), about = reader_member(&scene, "about");
    const struct value background = reader_member(&scene, "background");
    int version = FORMAT_VERSION;
    if (!reader_integer(reader, format, 1, 1000000, &version)) return;
    if (version > FORMAT_VERSION) {
        reader_fail(reader, &format.at, "expected version %d, got %d: this file was made by a newer wiggly",
                    FORMAT_VERSION, version);
        return;
    }
    if (about.json && !json_is_string(about.json)) reader_unexpected(reader, about, "a string");
    if (json_string_length(about.json) > 0) reader->document->about = need_text(json_string_value(about.json));
    load_domain(reader, &scene);
    load_splines(reader, &scene);
    load_rigs(reader, &scene);
    resolve_motions(reader, &scene);
    if (background.json && !json_is_object(background.json))
        reader_unexpected(reader, background, "an object");
    else if (background.json)
        object_load(reader, &background, background_fields, &reader->document->background);
    json_t *extra = reader_extra(reader, &scene, scene_keys);
    reader_put(&extra, "rigs", json_incref(reader->meadows));
    reader->document->extra = reader_keep(reader, extra);
    if (reader->errors == 0) validate_scene(reader, &scene.at);
}

/// `text` must be followed by a NUL.
static struct document *parse_document(const char *name, const char *text, size_t size, struct problems *problems,
                                       struct error *error)
{
    const size_t mark = file_text_mark(text);
    struct reader reader = {
        .source = {.name = name, .text = text + mark, .size = size - mark}, .problems = problems, .error = error};
    reader.document = document_create();
    json_t *scene = reader_parse(&reader);
    if (scene) load_scene(&reader, scene);
    json_decref(scene);
    free(reader.names);
    if (reader.errors == 0) return reader.document;
    document_destroy(reader.document);
    return NULL;
}

struct document *scene_load(const char *path, struct problems *problems, struct error *error)
{
    char *text;
    size_t size;
    struct reader outside = {.problems = problems, .error = error}; // problems of the file itself, without a line
    struct error trouble;
    if (!file_read(path, SOURCE_MAX_BYTES, &text, &size, &trouble)) {
        reader_report(&outside, true, &trouble);
        return NULL;
    }
    struct document *document = parse_document(path, text, size, problems, error);
    free(text);
    if (!document) return NULL;
    char folder[PATH_LIMIT]; // in which the paths in the document start
    if (!path_folder(path, folder)) {
        fail(&trouble, ERROR_ENVIRONMENT, "%s: the path is too long", path);
        reader_report(&outside, true, &trouble);
        document_destroy(document);
        return NULL;
    }
    document->folder = need_text(folder);
    return document;
}

struct scene_origin scene_read_origin(const char *path)
{
    struct scene_origin origin = {0};
    char *text;
    size_t size;
    if (!file_read(path, SOURCE_MAX_BYTES, &text, &size, NULL)) return origin;
    json_t *scene = json_read(text, size, 0, &(json_error_t){0}), *recovers = json_object_get(scene, "recovers");
    const char *file = json_string_value(json_object_get(recovers, "file"));
    const char *content = json_string_value(json_object_get(recovers, "content"));
    if (file && content) {
        char *whole = need_text(file);
        text_read_path(whole);
        if (strlen(whole) < PATH_LIMIT) {
            strcpy(origin.path, whole);
            origin.content = strtoull(content, NULL, 16);
        }
        free(whole);
    }
    json_decref(scene);
    free(text);
    return origin;
}

struct document *scene_parse(const char *name, const char *text, size_t size, struct problems *problems,
                             struct error *error)
{
    char *copy = need(size + 1, 1);
    memcpy(copy, text, size);
    copy[size] = '\0';
    struct document *document = parse_document(name, copy, size, problems, error);
    free(copy);
    return document;
}

bool scene_read_paint(struct document *document, struct error *error)
{
    struct error first = {0};
    for (int i = -1; (i = document_next_rig(document, RIG_MODEL, i)) >= 0;) {
        const struct model_rig *model = &document->rigs[i]->model;
        if (!model->paint_file || model->painted) continue;
        struct error trouble = {0};
        char path[PATH_LIMIT];
        struct paint *paint = NULL;
        if (path_resolve(document->folder, model->paint_file, path)) {
            paint = paint_read(path, &trouble);
        } else {
            fail(&trouble, ERROR_INPUT, "%s: the path is too long", model->paint_file);
        }
        if (paint) document_own_rig(document, i)->model.painted = paint;
        if (first.kind == ERROR_NONE) first = trouble;
    }
    if (first.kind != ERROR_NONE && error) *error = first;
    return first.kind == ERROR_NONE;
}

// --- writing

static bool is_parameter(const char *key) { return parameter_find(key) != PARAMETER_COUNT; }

static void print_spline(struct text *text, const struct document *document, const struct spline *spline,
                         const char *folder)
{
    struct members members = {text, "    {\n      ", ",\n      ", false};
    member_string(&members, "name", spline->name);
    if (spline->color >= 0) {
        char color[COLOR_TEXT_SIZE];
        color_print(spline->color, color);
        member_string(&members, "color", color);
    }
    if (spline->folder) member_string(&members, "folder", spline->folder);
    if (spline->locked) member(&members, "locked");
    if (spline->locked) text_string(text, "true");
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) {
        const char *name = parameter_key(p);
        const double value = spline->parameter[p].value;
        if (p == PARAMETER_LOW) { // "limits": [low, high], if there are any; null: none
            const double limits[] = {value, spline->parameter[PARAMETER_HIGH].value};
            const bool is_limited = isfinite(limits[0]) || isfinite(limits[1]);
            if (is_limited) member(&members, name);
            for (int i = 0; is_limited && i < 2; i++) {
                text_string(text, i == 0 ? "[" : ", ");
                if (isfinite(limits[i]))
                    text_number(text, limits[i]);
                else
                    text_string(text, "null");
            }
            if (is_limited) text_string(text, "]");
        }
        if (p == PARAMETER_VARIATION) { // { "seed", "amount" }, if there is one
            const double seed = spline->parameter[PARAMETER_SEED].value;
            json_t *extra = json_object_get(spline->extra, name);
            if (value == 0 && seed == 0 && !extra) continue;
            struct members pair = {text, "{ ", ", ", false};
            member(&members, name);
            member_number(&pair, "seed", seed);
            member_number(&pair, "amount", value);
            members_extra(&pair, extra, NULL);
            text_string(text, " }");
        }

        // Values that differ from the default are printed even if the mode does not use them, because another mode may.
        const struct param *param = &spline->parameter[p];
        const struct parameter_row *row = &parameter_rows[p];
        const bool is_usual = !param_follows(param) && value == row->standard;
        if (row->kind == PARAMETER_LIMIT || p == PARAMETER_VARIATION || p == PARAMETER_SEED) continue;
        if (is_usual && (row->is_quiet || !spline_uses(spline, p, false))) continue;
        if (row->kind == PARAMETER_CHOICE) {
            member_string(&members, name, row->words[(int)value]);
            continue;
        }
        member(&members, name);
        print_param(text, document, param, spline->extra, name, folder);
    }
    list_print(&members, document, &knot_list_field, spline, folder);
    members_extra(&members, spline->extra, is_parameter);
    text_string(text, "\n    }");
}

static bool is_rigs(const char *key) { return strcmp(key, "rigs") == 0; }

char *scene_print(const struct document *document, const char *folder, const struct scene_origin *origin,
                  size_t *size)
{
    struct text text = {0};
    struct members members = {&text, "{\n  ", ",\n  ", false};
    const double frames[] = {document->first_frame, document->last_frame};
    int version = 1; // the format's that the document needs: 2 only for paint
    for (int i = -1; (i = document_next_rig(document, RIG_MODEL, i)) >= 0;) {
        const struct paint *paint = document->rigs[i]->model.painted;
        if (paint && !paint_is_plain(paint)) version = 2;
    }
    member_number(&members, "wiggly", version);
    if (document->about) member_string(&members, "about", document->about);
    member_number(&members, "fps", document->fps);
    member_number(&members, "substeps", document->substeps);
    member(&members, "frames");
    text_numbers(&text, frames, 2);
    if (document->background.file) {
        struct members own = {&text, "{ ", ", ", false};
        member(&members, "background");
        fields_print(&own, document, background_fields, &document->background, folder);
        text_string(&text, " }");
    }
    member(&members, "splines");
    for (int i = 0; i < document->spline_count; i++) {
        text_string(&text, i > 0 ? ",\n" : "[\n");
        print_spline(&text, document, document->splines[i], folder);
    }
    text_string(&text, document->spline_count > 0 ? "\n  ]" : "[]");
    member(&members, "rigs");
    print_rigs(&text, document, folder);
    members_extra(&members, document->extra, is_rigs);

    char absolute[PATH_LIMIT], content[32]; // absolute, because the working folder may differ next time
    if (origin && origin->path[0] && path_resolve(NULL, origin->path, absolute)) {
        struct members pair = {&text, "{ ", ", ", false};
        snprintf(content, sizeof content, "%016llx", (unsigned long long)origin->content);
        member(&members, "recovers");
        member_path(&pair, "file", NULL, absolute, NULL);
        member_string(&pair, "content", content);
        text_string(&text, " }");
    }
    text_string(&text, "\n}\n");
    *size = text.size;
    text_bytes(&text, "", 1);
    return text.data;
}

bool scene_save_for(const struct document *document, const char *path, const struct scene_origin *origin,
                    struct error *error)
{
    struct file_output output;
    char folder[PATH_LIMIT];
    size_t size;
    if (!path_folder(path, folder)) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", path);
    char *text = scene_print(document, folder, origin, &size);
    const bool opened = file_output_open(&output, path, error);
    if (opened && origin) fchmod(fileno(output.stream), 0600); // readable by this user alone
    if (opened) fwrite(text, 1, size, output.stream);
    free(text);
    return opened && file_output_commit(&output, error);
}

bool scene_save(const struct document *document, const char *path, struct error *error)
{
    return scene_save_for(document, path, NULL, error);
}

uint64_t scene_hash(const struct document *document)
{
    uint64_t hash = 0xcbf29ce484222325u; // FNV-1a's offset basis
    size_t size;
    char *text = scene_print(document, document->folder, NULL, &size);
    for (size_t i = 0; i < size; i++) hash = (hash ^ (unsigned char)text[i]) * 0x100000001b3u;
    free(text);
    return hash;
}
