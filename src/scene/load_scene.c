/// Loads a scene from a file or from text, and checks it as a whole: cycles, limits, aliasing, pins.
#include "base/file.h"
#include "base/json.h"
#include "base/need.h"
#include "scene/load.h"
#include "scene/order.h"
#include "scene/pins.h"
#include "scene/reader.h"
#include "scene/text.h"
#include "scene/warnings.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { FORMAT_VERSION = 2 };

static const char *const scene_keys[] = {"wiggly",  "about", "fps",      "substeps", "frames",
                                         "splines", "rigs",  "recovers", NULL};

/// Rewords jansson's "X expected near Y" or "Z near Y".
static void compose_syntax(const char *text, char *sentence, size_t size)
{
    const char *near = strstr(text, " near ");
    const char *expected = strstr(text, " expected near ");
    if (expected) {
        snprintf(sentence, size, "expected %.*s, got %s", (int)(expected - text), text, near + 6);
    } else if (near) {
        snprintf(sentence, size, "expected valid JSON, got %s (%.*s)", near + 6, (int)(near - text), text);
    } else {
        snprintf(sentence, size, "expected valid JSON, got the end of the file (%s)", text);
    }
}

static void fail_syntax(struct reader *reader, const json_error_t *syntax)
{
    char path[PATH_TEXT_SIZE], sentence[JSON_ERROR_TEXT_LENGTH + 64];
    const char *near = strstr(syntax->text, " near ");
    const char *what = near ? near + 6 : "the end of the file";
    switch (json_error_code(syntax)) {
    case json_error_duplicate_key:
        snprintf(sentence, sizeof sentence, "expected each key once, got %s again", what);
        break;
    case json_error_null_character:
        snprintf(sentence, sizeof sentence, "expected a string without \\u0000, got %s", what);
        break;
    case json_error_numeric_overflow:
        snprintf(sentence, sizeof sentence, "expected a number that fits a double, got %s", what);
        break;
    case json_error_invalid_utf8:
        snprintf(sentence, sizeof sentence, "expected UTF-8, got something else (%s)", syntax->text);
        break;
    case json_error_out_of_memory:
        need_failed();
    default:
        compose_syntax(syntax->text, sentence, sizeof sentence);
    }
    source_path_at(&reader->source, (size_t)syntax->position, path);
    struct error error;
    fail(&error, ERROR_INPUT, "%s:%d: %s: %s", reader->source.name, syntax->line, path, sentence);
    reader_report(reader, &error);
}

static bool load_version(struct reader *reader, const struct value *scene)
{
    const struct value value = reader_member(scene, "wiggly");
    int version = FORMAT_VERSION;
    if (!reader_integer(reader, value, 1, 1000000, &version)) return false;
    if (version <= FORMAT_VERSION) return true;
    return reader_fail(reader, &value.at, "expected version %d, got %d: this file was made by a newer wiggly",
                       FORMAT_VERSION, version);
}

/// An empty text is the same as none.
static void load_about(struct reader *reader, const struct value *scene)
{
    const struct value value = reader_member(scene, "about");
    if (!value.json) return;
    if (!json_is_string(value.json)) {
        reader_unexpected(reader, value, "a string");
    } else if (json_string_length(value.json) > 0) {
        reader->document->about = need_text(json_string_value(value.json));
    }
}

static bool load_frames(struct reader *reader, struct value value, int frames[2])
{
    if (!reader_array(reader, value, 2, "[first, last]")) return false;
    bool good = true;
    for (int i = 0; i < 2; i++) {
        good &= reader_integer(reader, reader_element(&value, i), -SCENE_MAX_FRAME, SCENE_MAX_FRAME, &frames[i]);
    }
    if (good && frames[1] < frames[0]) {
        return reader_fail(reader, &value.at, "expected the last frame not before the first, got [%d, %d]", frames[0],
                           frames[1]);
    }
    return good;
}

/// Reads fps, substeps and frames, and checks the number of samples over all splines.
static void load_domain(struct reader *reader, const struct value *scene)
{
    struct document *document = reader->document;
    const struct value range = reader_member(scene, "frames");
    struct range fps_range = {0, SCENE_MAX_FPS, true};
    int frames[2];
    bool good = reader_number(reader, reader_member(scene, "fps"), false, fps_range, &document->fps);
    good &= reader_integer(reader, reader_member(scene, "substeps"), 1, SCENE_MAX_SUBSTEPS, &document->substeps);
    good &= load_frames(reader, range, frames);
    if (!good) return;
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

static void check_cycles(struct reader *reader, const struct where *splines_at)
{
    struct order_cycle cycle;
    const struct document *document = reader->document;
    if (scene_has_order(document, &cycle)) return;
    const struct spline *spline = document->splines[cycle.spline];
    struct where spline_at = {.parent = splines_at, .index = (size_t)cycle.spline};
    struct where at = {.parent = &spline_at, .key = parameter_key(cycle.parameter)};
    int leader = spline->parameter[cycle.parameter].track;
    reader_fail(reader, &at, "expected tracks without a cycle, got \"%s\", which follows \"%s\" itself",
                document->splines[leader]->name, spline->name);
}

/// The highest frequency of a spline with constant parameters, Hz; 0 if the frequency follows another spline.
static double highest_frequency(const struct spline *spline)
{
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    const struct param *bandwidth = &spline->parameter[PARAMETER_BANDWIDTH];
    if (spline_mode(spline) == WIGGLY_CUBIC || frequency->track >= 0) return 0;
    double widening = spline_mode(spline) == WIGGLY_COMPLEX && bandwidth->track < 0 ? bandwidth->value : 0;
    return frequency->value * (1 + widening);
}

static void check_aliasing(struct reader *reader, const struct where *splines_at)
{
    const struct document *document = reader->document;
    double limit = 0.5 / document_step(document);
    for (int i = 0; i < document->spline_count; i++) {
        double highest = highest_frequency(document->splines[i]);
        if (highest <= limit) continue;
        struct where spline_at = {.parent = splines_at, .index = (size_t)i};
        struct where at = {.parent = &spline_at, .key = "frequency"};
        reader_warn(reader, &at, "%.4g Hz is above half the sample rate, %.4g Hz: it aliases", highest, limit);
    }
}

/// The id of the first knot in the file; the others follow one by one.
static unsigned first_id(const struct spline *spline)
{
    unsigned first = UINT_MAX;
    for (int k = 0; k < spline->knot_count; k++) first = spline->knots[k].id < first ? spline->knots[k].id : first;
    return first;
}

/// Warns of slopes and phases without effect, of phases once per spline.
static void check_idle(struct reader *reader, const struct where *splines_at)
{
    const struct document *document = reader->document;
    for (int i = 0; i < document->spline_count; i++) {
        const struct spline *spline = document->splines[i];
        const struct where spline_at = {.parent = splines_at, .index = (size_t)i};
        const struct where knots_at = {.parent = &spline_at, .key = "knots"};
        const unsigned first = first_id(spline);
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
}

/// A pin's index in the file: ids rise there, while rig->pins is in order of frames.
static size_t index_in_file(const struct rig *rig, int pin)
{
    size_t index = 0;
    for (int i = 0; i < rig->pin_count; i++) index += rig->pins[i].id < rig->pins[pin].id;
    return index;
}

static void check_pins(struct reader *reader, const struct where *scene_at)
{
    struct pin_trouble trouble;
    const struct document *document = reader->document;
    if (pins_check(document, &trouble) && pins_check_order(document, &trouble)) return;
    const struct rig *rig = document->rigs[trouble.rig];
    const struct where rigs_at = {.parent = scene_at, .key = "rigs"};
    const struct where rig_at = {.parent = &rigs_at, .index = (size_t)reader->places[trouble.rig]};
    const struct where pins_at = {.parent = &rig_at, .key = trouble.pin >= 0 ? "pins" : trouble.member};
    const struct where at = {.parent = &pins_at, .index = trouble.pin >= 0 ? index_in_file(rig, trouble.pin) : 0};
    const struct where member_at = {.parent = &at, .key = trouble.member};
    reader_fail(reader, trouble.pin >= 0 ? &member_at : &pins_at, "%s", trouble.error.text);
}

static void validate_scene(struct reader *reader, const struct where *scene_at)
{
    struct where splines_at = {.parent = scene_at, .key = "splines"};
    const struct where rigs_at = {.parent = scene_at, .key = "rigs"};
    struct error error;
    check_cycles(reader, &splines_at);
    if (!document_check_joints(reader->document, &error)) reader_fail(reader, &rigs_at, "expected %s", error.text);
    check_aliasing(reader, &splines_at);
    if (reader->has_domain) check_idle(reader, &splines_at);
    if (reader->has_domain && reader->errors == 0) check_pins(reader, scene_at);
}

static void load_scene(struct reader *reader, json_t *json)
{
    const struct value scene = {.json = json};
    if (!json_is_object(json)) {
        reader_unexpected(reader, scene, "an object");
        return;
    }
    if (!load_version(reader, &scene)) return;
    load_about(reader, &scene);
    load_domain(reader, &scene);
    load_splines(reader, &scene);
    load_rigs(reader, &scene);
    resolve_motions(reader, &scene);
    json_t *extra = reader_extra(reader, &scene, scene_keys);
    reader_put(&extra, "rigs", json_incref(reader->meadows));
    reader->document->extra = reader_keep(reader, extra);
    if (reader->errors == 0) validate_scene(reader, &scene.at);
}

/// Keeps whole numbers as integers, so that unknown keys stay exact, unless one is too large.
static json_t *parse_json(const struct source *source, json_error_t *syntax)
{
    json_t *json = json_read(source->text, source->size, JSON_REJECT_DUPLICATES, syntax);
    if (json || json_error_code(syntax) != json_error_numeric_overflow) return json;
    return json_read(source->text, source->size, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, syntax);
}

json_t *reader_parse(struct reader *reader)
{
    struct error error;
    json_error_t syntax;
    if (!source_check_limits(&reader->source, &error)) {
        reader_report(reader, &error);
        return NULL;
    }
    json_t *json = parse_json(&reader->source, &syntax);
    if (!json) fail_syntax(reader, &syntax);
    return json;
}

static void parse(struct reader *reader)
{
    json_t *scene = reader_parse(reader);
    if (!scene) return;
    load_scene(reader, scene);
    json_decref(scene);
    free(reader->names);
}

/// `text` must be followed by a NUL.
static struct document *parse_document(const char *name, const char *text, size_t size, struct problems *problems,
                                       struct error *error)
{
    const size_t mark = file_text_mark(text);
    struct reader reader = {
        .source = {.name = name, .text = text + mark, .size = size - mark}, .problems = problems, .error = error};
    reader.document = document_create();
    parse(&reader);
    if (reader.errors == 0) return reader.document;
    document_destroy(reader.document);
    return NULL;
}

/// Makes paths in the document relative to its file's folder.
static bool set_folder(struct document *document, const char *path, struct error *error)
{
    char folder[PATH_LIMIT];
    if (!path_folder(path, folder)) return fail(error, ERROR_ENVIRONMENT, "%s: the path is too long", path);
    document->folder = need_text(folder);
    return true;
}

struct document *scene_load(const char *path, struct problems *problems, struct error *error)
{
    char *text;
    size_t size;
    struct reader outside = {.problems = problems, .error = error}; // problems of the file itself, without a line
    struct error trouble;
    if (!file_read(path, SOURCE_MAX_BYTES, &text, &size, &trouble)) {
        reader_report(&outside, &trouble);
        return NULL;
    }
    struct document *document = parse_document(path, text, size, problems, error);
    free(text);
    if (!document || set_folder(document, path, &trouble)) return document;
    reader_report(&outside, &trouble);
    document_destroy(document);
    return NULL;
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
