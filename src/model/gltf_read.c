/// Reads a glTF character: its parts in order, and what they share.
#include "model/gltf_read.h"
#include "base/names.h"
#include "base/need.h"
#include "model/vector.h"
#include <math.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { PIXEL_ROOM = 256 << 20, VERTEX_LIMIT = 1 << 24, NAME_ROOM = 512 };

void gltf_at(struct gltf_reader *r, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->place, sizeof r->place, format, arguments);
    va_end(arguments);
}

bool gltf_bad(struct gltf_reader *r, const char *format, ...)
{
    char text[256];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return fail(r->error, ERROR_INPUT, "%s: %s%s", r->file.path, r->place, text);
}

void *gltf_make(struct gltf_reader *r, size_t count, size_t size)
{
    if (count > r->file.room / size) {
        gltf_bad(r, ": expected no more data than fits a file of this size, got %zu times %zu bytes", count, size);
        return NULL;
    }
    r->file.room -= count * size;
    void *memory = pool_try(&r->gltf->pool, count, size);
    if (!memory) fail_no_memory(r->error, r->file.path);
    return memory;
}

bool gltf_index(struct gltf_reader *r, const json_t *object, const char *key, int limit, int *index)
{
    const json_t *member = json_object_get(object, key);
    json_int_t value = json_is_integer(member) ? json_integer_value(member) : -1;
    *index = -1;
    if (!member) return true;
    if (value < 0 || value >= limit)
        return limit == 0 ? gltf_bad(r, ".%s: expected none, because the file has none", key)
               : !json_is_number(member)
                   ? gltf_bad(r, ".%s: expected a number from 0 to %d, got something else", key, limit - 1)
                   : gltf_bad(r, ".%s: expected a number from 0 to %d, got %.10g", key, limit - 1,
                              json_number_value(member));
    *index = (int)value;
    return true;
}

bool gltf_reals(struct gltf_reader *r, const json_t *object, const char *key, float *numbers, size_t count)
{
    const json_t *array = json_object_get(object, key);
    if (!array) return true;
    if (json_array_size(array) != count)
        return gltf_bad(r, ".%s: expected %zu numbers, got %zu", key, count, json_array_size(array));
    for (size_t i = 0; i < count; i++) {
        const json_t *number = json_array_get(array, i);
        float value = (float)json_number_value(number);
        if (!json_is_number(number) || !isfinite(value))
            return gltf_bad(r, ".%s[%zu]: expected a finite number, got something else", key, i);
        numbers[i] = value;
    }
    return true;
}

char *gltf_text(struct gltf_reader *r, const char *text)
{
    char *copy = pool_try(&r->gltf->pool, strlen(text) + 1, 1);
    if (!copy) fail_no_memory(r->error, r->file.path);
    return copy ? strcpy(copy, text) : NULL;
}

/// The file's own name; NULL: none, or one that nobody could see.
static const char *own_name(const json_t *object)
{
    const char *name = json_string_value(json_object_get(object, "name"));
    return name && !name_is_blank(name) ? name : NULL;
}

char *gltf_name(struct gltf_reader *r, const json_t *object, const char *kind, size_t n)
{
    char made[64];
    const char *name = own_name(object);
    snprintf(made, sizeof made, "%s %zu", kind, n);
    return gltf_text(r, name ? name : made);
}

bool gltf_name_all(struct gltf_reader *r, const json_t *array, const char *kind, bool by_place, void *things,
                   size_t size)
{
    struct names names = {0};
    const json_t *object;
    size_t i, room = 0;
    json_array_foreach(array, i, object) room += NAME_ROOM + 4 * json_string_length(json_object_get(object, "name"));
    bool done = need_has_room(room) || fail_no_memory(r->error, r->file.path);
    for (int pass = 0; pass < 2; pass++) {
        json_array_foreach(array, i, object)
        {
            char **name = (char **)((char *)things + i * size);
            const bool is_first = pass == 0 && own_name(object) && !names_has(&names, own_name(object));
            if (!done || (pass == 0 ? !is_first : *name != NULL)) continue;
            if (by_place) names.number = (int)i + 1;
            char *wanted = gltf_name(r, object, kind, i);
            *name = wanted ? gltf_text(r, names_add(&names, wanted)) : NULL;
            done = *name;
        }
    }
    names_free(&names);
    return done;
}

const json_t *gltf_array(const struct gltf_reader *r, const char *key) { return json_object_get(r->file.json, key); }

/// Whether a list of names separated by ", " contains this one.
static bool listed(const char *list, const char *name)
{
    size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)); at++) {
        bool begins = at == list || at[-1] == ' ', ends = at[length] == ',' || at[length] == '\0';
        if (begins && ends) return true;
    }
    return false;
}

bool gltf_not_shown(struct gltf_reader *r, const char *format, ...)
{
    char name[128];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(name, sizeof name, format, arguments);
    va_end(arguments);
    if (listed(r->gltf->not_shown, name)) return true;
    size_t end = r->not_shown_end, length = strlen(name);
    char *longer = realloc(r->gltf->not_shown, end + length + 3);
    if (!longer) return fail_no_memory(r->error, r->file.path);
    r->gltf->not_shown = longer;
    r->not_shown_end = end + (size_t)sprintf(longer + end, "%s%s", end ? ", " : "", name);
    return true;
}

static bool check_version(struct gltf_reader *r)
{
    const json_t *asset = json_object_get(r->file.json, "asset");
    const char *version = json_string_value(json_object_get(asset, "minVersion"));
    if (!version) version = json_string_value(json_object_get(asset, "version"));
    gltf_at(r, "asset");
    if (version && strncmp(version, "2.", 2) == 0 &&
        (!json_object_get(asset, "minVersion") || !strcmp(version, "2.0")))
        return true;
    return gltf_bad(r, ".version: expected glTF 2.0, got %.20s", version ? version : "none");
}

static bool check_arrays(struct gltf_reader *r)
{
    static const char *const keys[] = {"accessors", "animations", "buffers",  "bufferViews", "extensionsRequired",
                                       "images",    "materials",  "meshes",   "nodes",       "extensionsUsed",
                                       "scenes",    "skins",      "textures", "cameras",     "samplers"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        const json_t *member = json_object_get(r->file.json, keys[i]);
        gltf_at(r, "%s", keys[i]);
        if (member && !json_is_array(member)) return gltf_bad(r, ": expected an array, got something else");
        if (json_array_size(member) > INT32_MAX / 2) return gltf_bad(r, ": expected fewer");
    }
    return true;
}

/// Extensions that are shown, and those without which a mesh is unreadable.
static bool is_shown(const char *extension)
{
    return !strcmp(extension, "KHR_mesh_quantization") || !strcmp(extension, "KHR_texture_transform") ||
           !strcmp(extension, GLTF_POLYGONS);
}

static bool check_required(struct gltf_reader *r)
{
    size_t i;
    const json_t *extension;
    json_array_foreach(gltf_array(r, "extensionsRequired"), i, extension)
    {
        const char *name = json_string_value(extension);
        gltf_at(r, "extensionsRequired[%zu]", i);
        const char *package = name ? glb_missing_codec(name) : NULL;
        if (package)
            return gltf_bad(
                r, ": expected meshes that are not compressed, got %.60s; export without compression%s%s%s", name,
                *package ? ", or install " : "", package, *package ? " and build wiggly again" : "");
    }
    return true;
}

static bool check_used(struct gltf_reader *r)
{
    size_t i;
    const json_t *extension;
    json_array_foreach(gltf_array(r, "extensionsUsed"), i, extension)
    {
        const char *name = json_string_value(extension);
        if (name && !is_shown(name) && !gltf_not_shown(r, "%.100s", name)) return false;
    }
    return json_array_size(gltf_array(r, "cameras")) == 0 || gltf_not_shown(r, "cameras");
}

/// Nodes may show a mesh several times.
static bool check_vertices(struct gltf_reader *r)
{
    const size_t limit = r->file.room < VERTEX_LIMIT ? r->file.room : VERTEX_LIMIT;
    size_t total = 0;
    for (int n = 0; n < r->gltf->node_count; n++) total += (size_t)gltf_vertex_count(r->gltf, n);
    return total <= limit ||
           fail(r->error, ERROR_INPUT, "%s: nodes: expected at most %zu vertices together%s, got %zu", r->file.path,
                limit, limit < VERTEX_LIMIT ? " in a file of this size" : "", total);
}

static void widen(struct gltf *gltf, const float at[3])
{
    for (int k = 0; k < 3; k++) {
        gltf->lo[k] = fminf(gltf->lo[k], at[k]);
        gltf->hi[k] = fmaxf(gltf->hi[k], at[k]);
    }
}

/// The box of all vertices at rest or, without vertices, of the nodes.
static bool measure(struct gltf_reader *r)
{
    struct gltf *gltf = r->gltf;
    struct gltf_pose pose;
    int most = 0;
    for (int i = 0; i < gltf->node_count; i++) {
        int count = gltf_vertex_count(gltf, i);
        if (count > most) most = count;
    }
    float(*positions)[3] = malloc(((size_t)most + 1) * sizeof *positions);
    if (!positions || !gltf_pose_create(gltf, &pose)) {
        free(positions);
        return fail_no_memory(r->error, r->file.path);
    }
    glm_vec3_fill(gltf->lo, INFINITY);
    glm_vec3_fill(gltf->hi, -INFINITY);
    for (int i = 0; i < gltf->node_count; i++) {
        int count = gltf_vertex_count(gltf, i);
        gltf_pose_vertices(gltf, &pose, i, positions, NULL);
        for (int n = 0; n < count; n++) widen(gltf, positions[n]);
    }
    for (int i = 0; most == 0 && i < gltf->node_count; i++) widen(gltf, pose.world[i] + 12);
    gltf_pose_free(&pose);
    free(positions);
    for (int k = 0; k < 3; k++) {
        if (!isfinite(gltf->lo[k]) || !isfinite(gltf->hi[k]))
            return fail(r->error, ERROR_INPUT, "%s: expected a size that can be shown, got an infinite one",
                        gltf->path);
    }
    return true;
}

uint64_t gltf_new_id(void)
{
    static atomic_uint_fast64_t last;
    return atomic_fetch_add(&last, 1) + 1;
}

static bool read_all(struct gltf_reader *r)
{
    if (!check_version(r) || !check_arrays(r) || !check_required(r)) return false;
    if (!glb_read_buffers(&r->file, r->error) || !check_used(r)) return false;
    r->pixel_room = PIXEL_ROOM + r->file.room;
    r->gltf->path = gltf_text(r, r->file.path);
    r->gltf->id = gltf_new_id();
    return r->gltf->path && gltf_read_materials(r) && gltf_read_meshes(r) && gltf_read_nodes(r) &&
           check_vertices(r) && gltf_read_skins(r) && gltf_read_clips(r) && measure(r);
}

/// Reads the opened file, if it is open, and closes it.
static bool read_open(struct gltf_reader *r, bool is_open)
{
    *r->gltf = (struct gltf){0};
    const bool done = is_open && read_all(r);
    r->gltf->room = r->file.room;
    glb_close(&r->file);
    if (!done) gltf_free(r->gltf);
    return done;
}

bool gltf_read(const char *path, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error};
    return read_open(&r, glb_open(&r.file, path, error));
}

bool gltf_read_stored(const char *path, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error, .stored = true};
    return read_open(&r, glb_open(&r.file, path, error));
}

bool gltf_read_bytes(const char *path, char *data, size_t size, struct gltf *gltf, struct error *error)
{
    struct gltf_reader r = {.gltf = gltf, .error = error};
    return read_open(&r, glb_open_bytes(&r.file, path, data, size, error));
}
