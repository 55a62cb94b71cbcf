/// Objects of a scene file, described by rows: read, printed, checked, compared, copied and freed.
#include "scene/fields.h"
#include "base/file.h"
#include "base/need.h"
#include "scene/document.h"
#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A member of an object, by its place.
static void *inside(void *object, size_t at) { return (char *)object + at; }
static const void *look(const void *object, size_t at) { return (const char *)object + at; }

static int number_count(const struct field *field) { return (int)(field->size / sizeof(double)); }

static bool is_text(const struct field *field)
{
    return field->kind == FIELD_TEXT || field->kind == FIELD_PATH || field->kind == FIELD_MODEL;
}

static const char *text_of(const struct field *field, const void *object)
{
    return *(char *const *)look(object, field->place);
}

static int count_of(const struct field *list, const void *object) { return *(const int *)look(object, list->count); }

static void *element_of(const struct field *list, const void *object, int index)
{
    return *(char *const *)look(object, list->place) + (size_t)index * list->size;
}

static struct paint *paint_of(const struct field *field, const void *object)
{
    return *(struct paint *const *)look(object, field->place);
}

const struct field *fields_find(const struct field *fields, const char *key)
{
    while (fields->key && strcmp(fields->key, key) != 0) fields++;
    return fields->key ? fields : NULL;
}

/// The offset of an object's unknown keys.
static size_t extra_place(const struct field *fields)
{
    while (fields->key) fields++;
    return fields->place;
}

void fields_reset(const struct field *fields, void *object)
{
    for (const struct field *field = fields; field->key; field++) {
        void *at = inside(object, field->place);
        switch (field->kind) {
        case FIELD_NUMBER:
        case FIELD_NUMBERS:
            memcpy(at, field->usual, field->size);
            break;
        case FIELD_WHOLE:
        case FIELD_WORD:
            *(int *)at = (int)field->usual[0];
            break;
        case FIELD_PLACE:
            for (int k = 0; k < 3; k++) ((struct param *)at)[k] = param_number(0);
            break;
        case FIELD_ANGLES:
            ((struct angles *)at)->value[0] = field->usual[0];
            break;
        default:
            break;
        }
    }
}

void list_load(struct reader *reader, const struct value *object, const struct field *field, void *at)
{
    const struct value value = reader_member(object, field->key);
    const int count = reader_objects(reader, value, (int)field->range.maximum);
    if (count <= 0) return;
    *(void **)inside(at, field->place) = need_zeroed((size_t)count, field->size);
    *(int *)inside(at, field->count) = count;
    for (int i = 0; i < count; i++) {
        const struct value element = reader_element(&value, i);
        object_load(reader, &element, field->rows, element_of(field, at, i));
    }
}

void fields_load(struct reader *reader, const struct value *object, const struct field *fields, void *into,
                 json_t **extra)
{
    for (const struct field *field = fields; field->key; field++) {
        const struct value value = reader_member(object, field->key);
        const bool is_read = value.json || field->is_required;
        void *at = inside(into, field->place);
        if (field->load) {
            field->load(reader, object, into);
            continue;
        }
        switch (field->kind) {
        case FIELD_NUMBER:
            if (field->flag != 0) *(bool *)inside(into, field->flag) = value.json != NULL;
            reader_number(reader, value, field->is_required, field->range, at);
            break;
        case FIELD_WHOLE:
            if (!value.json && field->is_required) reader_unexpected(reader, value, "a whole number");
            reader_integer(reader, value, (int)field->range.minimum, (int)field->range.maximum, at);
            break;
        case FIELD_FLAG:
            reader_flag(reader, value, at);
            break;
        case FIELD_NUMBERS: {
            const int count = number_count(field);
            const char *expected = count == 3 ? "[x, y, z]" : "[x, z]";
            const bool good = is_read && reader_array(reader, value, (size_t)count, expected);
            for (int i = 0; good && i < count; i++)
                reader_number(reader, reader_element(&value, i), true, field->range, (double *)at + i);
            break;
        }
        case FIELD_WORD: {
            const int found = is_read ? reader_word(reader, value, field->words) : -1;
            if (found >= 0) *(int *)at = found;
            break;
        }
        case FIELD_TEXT:
            if (is_read) *(char **)at = reader_name(reader, value);
            break;
        case FIELD_PATH:
        case FIELD_MODEL:
            if (is_read) *(char **)at = reader_path(reader, value);
            break;
        case FIELD_SPLINE:
            *(int *)at = reader_spline_name(reader, value);
            break;
        case FIELD_PLACE: {        // each coordinate is a number in metres or follows a spline
            json_t *tracks = NULL; // their unknown keys are kept under the coordinate's name
            const bool good = value.json && reader_array(reader, value, 3, "[x, y, z]");
            for (int k = 0; good && k < 3; k++) {
                reader_put(&tracks, coordinate_name(k),
                           reader_param(reader, reader_element(&value, k), range_any, false, (struct param *)at + k));
            }
            reader_put(extra, value.at.key, tracks);
            break;
        }
        case FIELD_ANGLES:
            load_angles(reader, value, at, extra);
            break;
        case FIELD_LIST:
            list_load(reader, object, field, into);
            break;
        default:
            break;
        }
    }
}

void object_load(struct reader *reader, const struct value *object, const struct field *fields, void *at)
{
    const char *known[FIELDS_MOST + 1] = {NULL};
    int count = 0;
    for (; fields[count].key; count++) known[count] = fields[count].key;
    assert(count <= FIELDS_MOST);
    json_t *extra = reader_extra(reader, object, known);
    fields_reset(fields, at);
    fields_load(reader, object, fields, at, &extra);
    *(json_t **)inside(at, extra_place(fields)) = reader_keep(reader, extra);
}

void list_print(struct members *members, const struct document *document, const struct field *field,
                const void *object, const char *folder)
{
    struct text *text = members->text;
    const int count = count_of(field, object);
    if (count == 0 && field->is_quiet) return;
    member(members, field->key);
    for (int i = 0; i < count; i++) {
        struct members own = {text, "{ ", ", ", false};
        text_string(text, i > 0 ? ",\n        " : "[\n        ");
        fields_print(&own, document, field->rows, element_of(field, object, i), folder);
        text_string(text, " }");
    }
    text_string(text, count > 0 ? "\n      ]" : "[]");
}

/// Whether a field is not printed, because it has its default or is missing.
static bool is_left_out(const struct field *field, const void *object)
{
    const void *at = look(object, field->place);
    if (field->kind == FIELD_NUMBER && field->flag != 0) return !*(const bool *)look(object, field->flag);
    if (!field->is_quiet || field->kind == FIELD_LIST) return false;
    if (field->kind == FIELD_FLAG) return !*(const bool *)at;
    return (field->kind == FIELD_NUMBER ? *(const double *)at : *(const int *)at) == field->usual[0];
}

/// Whether a model is called by its name; else by its file.
static bool is_name(const struct document *document, const char *model)
{
    const int rig = document_find_model(document, model);
    const char *name = rig >= 0 ? document->rigs[rig]->name : NULL;
    return name && strcmp(name, model) == 0;
}

void fields_print(struct members *members, const struct document *document, const struct field *fields,
                  const void *object, const char *folder)
{
    json_t *extra = *(json_t *const *)look(object, extra_place(fields)), *value;
    struct text *text = members->text;
    const char *key;
    for (const struct field *field = fields; field->key; field++) {
        const void *at = look(object, field->place);
        if (field->print) {
            field->print(members, document, object, folder);
            continue;
        }
        if (is_left_out(field, object)) continue;
        switch (field->kind) {
        case FIELD_NUMBER:
            member_number(members, field->key, *(const double *)at);
            break;
        case FIELD_WHOLE:
            member_number(members, field->key, *(const int *)at);
            break;
        case FIELD_FLAG:
            member(members, field->key);
            text_string(text, *(const bool *)at ? "true" : "false");
            break;
        case FIELD_NUMBERS:
            member(members, field->key);
            text_numbers(text, at, number_count(field));
            break;
        case FIELD_WORD:
            member_string(members, field->key, field->words[*(const int *)at]);
            break;
        case FIELD_TEXT:
            if (*(char *const *)at) member_string(members, field->key, *(char *const *)at);
            break;
        case FIELD_PATH:
            member_path(members, field->key, document, *(char *const *)at, folder);
            break;
        case FIELD_MODEL:
            member_path(members, field->key, is_name(document, text_of(field, object)) ? NULL : document,
                        text_of(field, object), folder);
            break;
        case FIELD_SPLINE:
            member_string(members, field->key, document->splines[*(const int *)at]->name);
            break;
        case FIELD_PLACE:
            member(members, field->key);
            for (int k = 0; k < 3; k++) {
                text_string(text, k > 0 ? ", " : "[");
                print_param(text, document, (const struct param *)at + k, json_object_get(extra, field->key),
                            coordinate_name(k), folder);
            }
            text_string(text, "]");
            break;
        case FIELD_ANGLES:
            print_angles(members, field->key, at, extra);
            break;
        case FIELD_LIST:
            list_print(members, document, field, object, folder);
            break;
        default:
            break;
        }
    }
    json_object_foreach(extra, key, value)
    {
        if (fields_find(fields, key)) continue; // unknown keys of a track or ramp
        member(members, key);
        text_json(text, value);
    }
}

static bool fail_range(const struct field *field, struct error *error)
{
    const struct range range = field->range;
    if (isfinite(range.maximum))
        return fail(error, ERROR_INPUT, "the %s must be from %g to %g", field->key, range.minimum, range.maximum);
    if (range.above) return fail(error, ERROR_INPUT, "the %s must be above %g and finite", field->key, range.minimum);
    return fail(error, ERROR_INPUT, "the %s must be finite", field->key);
}

bool has_model(const struct document *document, const char *text, struct error *error)
{
    return document_find_model(document, text) >= 0 ||
           fail(error, ERROR_INPUT, "expected the name or file of a model rig, got \"%s\"", text);
}

bool fields_check(const struct document *document, int joints, const struct field *fields, void *object,
                  struct error *error)
{
    for (const struct field *field = fields; field->key; field++) {
        void *at = inside(object, field->place);
        const char *text = is_text(field) ? text_of(field, object) : NULL;
        struct param *params = at;
        double *numbers = at;
        bool good = true;
        switch (field->kind) {
        case FIELD_NUMBER:
        case FIELD_NUMBERS:
            for (int i = 0; good && i < number_count(field); i++) {
                good = isfinite(numbers[i]) && range_has(field->range, numbers[i]);
                numbers[i] += 0.0;
            }
            if (!good) return fail_range(field, error);
            break;
        case FIELD_WHOLE:
            if (!range_has(field->range, *(int *)at)) return fail_range(field, error);
            break;
        case FIELD_WORD: {
            const int word = *(int *)at;
            char words[WORDS_TEXT];
            good = field->is_quiet && word == (int)field->usual[0];
            for (int i = 0; field->words[i]; i++) good |= i == word && field->words[i][0];
            if (!good)
                return fail(error, ERROR_INPUT, "the %s must be %s", field->key, list_words(field->words, words));
            break;
        }
        case FIELD_TEXT:
        case FIELD_PATH:
            if (!field->is_apart && !(text ? text[0] != '\0' : !field->is_required))
                return fail(error, ERROR_INPUT, "\"%s\" must not be empty", field->key);
            break;
        case FIELD_MODEL:
            good = has_model(document, text ? text : "", error);
            break;
        case FIELD_SPLINE:
            good = document_has_spline(document, *(int *)at, error);
            break;
        case FIELD_PLACE:
            for (int k = 0; k < 3; k++) {
                if (params[k].motion) return fail(error, ERROR_INPUT, "only an equilibrium follows a joint");
                if (params[k].track >= document->spline_count)
                    return fail(error, ERROR_INPUT, "there is no spline to follow");
                if (!isfinite(params[k].value)) return fail(error, ERROR_INPUT, "the %s must be finite", field->key);
                params[k].value += 0.0;
            }
            break;
        case FIELD_ANGLES:
            good = check_angles(joints, at, error);
            break;
        case FIELD_LIST: {
            const int count = count_of(field, object), most = (int)field->range.maximum;
            if (count > most) return fail(error, ERROR_INPUT, "at most %d %s fit", most, field->key);
            for (int i = 0; good && i < count; i++)
                good = fields_check(document, joints, field->rows, element_of(field, object, i), error);
            break;
        }
        default:
            break;
        }
        if (!good) return false;
    }
    return true;
}

bool fields_equal(const struct field *fields, const void *a, const void *b)
{
    bool same = true;
    for (const struct field *field = fields; same && field->key; field++) {
        const void *left = look(a, field->place), *right = look(b, field->place);
        if (field->is_apart) continue;
        if (field->flag != 0) same = *(const bool *)look(a, field->flag) == *(const bool *)look(b, field->flag);
        if (is_text(field)) {
            const char *one = text_of(field, a), *other = text_of(field, b);
            same = same && (one == other || (one && other && strcmp(one, other) == 0)); // NULL is only itself
        } else if (field->kind == FIELD_LIST) {
            same = same && count_of(field, a) == count_of(field, b);
            for (int i = 0; same && i < count_of(field, a); i++)
                same = fields_equal(field->rows, element_of(field, a, i), element_of(field, b, i));
        } else if (field->kind == FIELD_PLACE) {
            const struct param *one = left, *other = right;
            for (int k = 0; k < 3; k++) same &= one[k].track == other[k].track && one[k].value == other[k].value;
        } else if (field->kind == FIELD_ANGLES) {
            same = same && angles_equal(left, right);
        } else {
            same = same && memcmp(left, right, field->size) == 0;
        }
    }
    return same;
}

void fields_copy(const struct field *fields, void *copy)
{
    for (const struct field *field = fields; field->key; field++) {
        const char *text = is_text(field) ? text_of(field, copy) : NULL;
        if (text) *(char **)inside(copy, field->place) = need_text(text);
        if (field->kind == FIELD_PAINT) paint_hold(paint_of(field, copy));
        if (field->kind != FIELD_LIST) continue;
        const int count = count_of(field, copy);
        void **list = inside(copy, field->place), *shared = *list;
        *list = need((size_t)count + 1, field->size);
        if (count > 0) memcpy(*list, shared, (size_t)count * field->size);
        for (int i = 0; i < count; i++) fields_copy(field->rows, element_of(field, copy, i));
    }
}

void fields_free(const struct field *fields, void *object)
{
    for (const struct field *field = fields; field->key; field++) {
        const bool is_list = field->kind == FIELD_LIST;
        for (int i = 0; is_list && i < count_of(field, object); i++)
            fields_free(field->rows, element_of(field, object, i));
        if (field->kind == FIELD_PAINT) paint_drop(paint_of(field, object));
        if (is_text(field) || is_list) free(*(void **)inside(object, field->place));
    }
}

size_t fields_bytes(const struct field *fields, const void *object, const void *other)
{
    size_t bytes = 0;
    for (const struct field *field = fields; field->key; field++) {
        if (is_text(field)) bytes += text_size(text_of(field, object));
        if (field->kind == FIELD_LIST) bytes += (size_t)count_of(field, object) * field->size;
        if (field->kind != FIELD_PAINT || (other && paint_of(field, other) == paint_of(field, object))) continue;
        bytes += paint_bytes(paint_of(field, object));
    }
    return bytes;
}

// --- printing, key by key

void member(struct members *members, const char *key)
{
    text_string(members->text, members->any ? members->separator : members->open);
    text_quoted(members->text, key);
    text_string(members->text, ": ");
    members->any = true;
}

void member_number(struct members *members, const char *key, double value)
{
    member(members, key);
    text_number(members->text, value);
}

void member_string(struct members *members, const char *key, const char *string)
{
    member(members, key);
    text_quoted(members->text, string);
}

void member_path(struct members *members, const char *key, const struct document *document, const char *path,
                 const char *folder)
{
    char moved[PATH_LIMIT];
    member(members, key);
    text_path(members->text, document && path_rebase(path, document->folder, folder, moved) ? moved : path);
}

void members_extra(struct members *members, json_t *extra, bool (*skips)(const char *key))
{
    const char *key;
    json_t *value;
    json_object_foreach(extra, key, value)
    {
        if (skips && skips(key)) continue;
        member(members, key);
        text_json(members->text, value);
    }
}

void text_numbers(struct text *text, const double *values, int count)
{
    text_string(text, "[");
    for (int i = 0; i < count; i++) {
        if (i > 0) text_string(text, ", ");
        text_number(text, values[i]);
    }
    text_string(text, "]");
}

void print_param(struct text *text, const struct document *document, const struct param *param, json_t *extras,
                 const char *key, const char *folder)
{
    if (!param_follows(param)) {
        text_number(text, param->value);
        return;
    }
    struct members track = {text, "{ ", ", ", false};
    if (param->motion) {
        fields_print(&track, document, motion_fields, param->motion, folder);
    } else {
        member_string(&track, "spline", document->splines[param->track]->name);
        members_extra(&track, json_object_get(extras, key), NULL);
    }
    text_string(text, " }");
}

// --- the joint that a spline follows: { "model": "walk", "joint": "hips", "of": "turn", "gain": 1 }

const char *const motion_words[] = {[MOTION_TURN] = "turn",
                                    [MOTION_ACROSS] = "across",
                                    [MOTION_UP] = "up",
                                    [MOTION_BASE] = "base",
                                    [MOTION_KINDS] = NULL};

const struct field motion_fields[] = {
    {FIELD("model", FIELD_MODEL, struct joint_motion, model), .is_required = true},
    {FIELD("joint", FIELD_TEXT, struct joint_motion, joint), .is_required = true},
    {FIELD("of", FIELD_WORD, struct joint_motion, of), .words = motion_words, .is_required = true},
    {FIELD("gain", FIELD_NUMBER, struct joint_motion, gain), .range = FIELD_ANY, .usual = {1}},
    {FIELD("chain", FIELD_TEXT, struct joint_motion, chain)},
    FIELD_END(struct joint_motion),
};

bool motion_equals(const struct joint_motion *a, const struct joint_motion *b)
{
    return a == b || (a && b && fields_equal(motion_fields, a, b));
}

struct joint_motion *motion_create(const struct joint_motion *motion)
{
    struct joint_motion *copy = need(1, sizeof *copy);
    *copy = *motion;
    atomic_init(&copy->holders, 1);
    fields_copy(motion_fields, copy);
    return copy;
}

void motion_hold(struct joint_motion *motion)
{
    if (motion) atomic_fetch_add(&motion->holders, 1);
}

void motion_drop(struct joint_motion *motion)
{
    if (!motion || atomic_fetch_sub(&motion->holders, 1) > 1) return;
    fields_free(motion_fields, motion);
    free(motion);
}

static bool has_chain(const struct document *document, const struct joint_motion *motion, struct error *error)
{
    return !motion->chain || document_find_chain(document, motion->chain) >= 0 ||
           fail(error, ERROR_INPUT, "expected the name of a chain, got \"%s\"", motion->chain);
}

bool motion_check(const struct document *document, struct joint_motion *motion, struct error *error)
{
    return fields_check(document, JOINTS_UNKNOWN, motion_fields, motion, error) && has_chain(document, motion, error);
}

void motion_load(struct reader *reader, const struct value *object, struct param *param)
{
    const int errors = reader->errors;
    struct joint_motion *motion = need_zeroed(1, sizeof *motion);
    atomic_init(&motion->holders, 1);
    object_load(reader, object, motion_fields, motion);
    if (reader->errors == errors)
        *param = (struct param){.track = -1, .motion = motion};
    else
        motion_drop(motion);
}

void resolve_motions(struct reader *reader, const struct value *scene)
{
    const struct document *document = reader->document;
    const struct value splines = reader_member(scene, "splines");
    for (int s = 0; s < document->spline_count; s++) {
        const struct joint_motion *motion = document->splines[s]->parameter[PARAMETER_EQUILIBRIUM].motion;
        const struct value spline = reader_element(&splines, s);
        const struct value object = reader_member(&spline, parameter_rows[PARAMETER_EQUILIBRIUM].name);
        const struct value model = reader_member(&object, "model"), chain = reader_member(&object, "chain");
        struct error error;
        if (!motion) continue;
        if (!has_model(document, motion->model, &error)) reader_fail(reader, &model.at, "%s", error.text);
        if (!has_chain(document, motion, &error)) reader_fail(reader, &chain.at, "%s", error.text);
    }
}
