/// Reads and writes materials of OBJ files.
#include "base/file.h"
#include "model/surface_readers.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TEXT_LIMIT = 16 << 20 };

const char *looks_image_kind(const unsigned char *bytes, size_t size)
{
    if (size > 8 && memcmp(bytes, "\x89PNG\r\n\x1a\n", 8) == 0) return "png";
    return size > 3 && memcmp(bytes, "\xFF\xD8\xFF", 3) == 0 ? "jpeg" : NULL;
}

static void note(struct looks *looks, const char *name)
{
    if (!looks->left_out) looks->left_out = strdup(name);
}

/// A file named from the folder of another one; '\\' separates folders too.
static bool read_beside(const char *path, const char *name, size_t limit, char **data, size_t *size)
{
    char folder[PATH_LIMIT], plain[PATH_LIMIT], place[PATH_LIMIT];
    if (snprintf(plain, sizeof plain, "%s", name) >= (int)sizeof plain || !path_folder(path, folder)) return false;
    for (char *c = plain; *c; c++) {
        if (*c == '\\') *c = '/';
    }
    return path_resolve(folder, plain, place) && file_read(place, limit, data, size, NULL);
}

/// What is left of a map's line behind its options, each of which has numbers or on/off behind it.
static const char *map_name(const char *at)
{
    while (*at == '-' && strchr(at, ' ')) {
        at += strcspn(at, " \t");
        for (at += strspn(at, " \t"); *at;) {
            const size_t length = strcspn(at, " \t");
            const bool word = strncmp(at, "on", length) == 0 || strncmp(at, "off", length) == 0;
            char *end;
            strtod(at, &end);
            if (!word && end != at + length) break;
            at += length;
            at += strspn(at, " \t");
        }
    }
    return at;
}

static void read_image(const char *path, const char *value, struct looks *looks, struct looks_material *material)
{
    const char *name = map_name(value);
    char *data = NULL;
    size_t size = 0;
    const size_t room = LOOKS_IMAGES_LIMIT - looks_image_bytes(looks);
    if (material->image) return;
    if (!read_beside(path, name, room, &data, &size) || !looks_image_kind((unsigned char *)data, size)) {
        free(data);
        note(looks, name);
        return;
    }
    material->image = (unsigned char *)data;
    material->image_size = size;
}

static bool in_range(const char *text, float *value)
{
    const float number = strtof(text, NULL);
    if (!(number >= 0 && number <= 1)) return false;
    *value = number;
    return true;
}

static void read_line(const char *path, char *line, struct surface_builder *b, uint32_t *current)
{
    struct looks *looks = &b->surface->looks;
    char *word = line + strspn(line, " \t"), *value = word + strcspn(word, " \t\r");
    if (*value) *value++ = '\0';
    value += strspn(value, " \t");
    for (size_t length = strlen(value); length > 0 && strchr(" \t\r", value[length - 1]);) value[--length] = '\0';
    if (strcmp(word, "newmtl") == 0) *current = builder_material(b, value);
    if (*current == LOOKS_NONE) return;
    struct looks_material *material = &looks->materials[*current];
    if (strcmp(word, "Kd") == 0) {
        char *at = value;
        for (int k = 0; k < 3; k++) in_range(at, &material->color[k]), strtof(at, &at);
    } else if (strcmp(word, "d") == 0) {
        in_range(value, &material->color[3]);
    } else if (strcmp(word, "Tr") == 0 && in_range(value, &material->color[3])) {
        material->color[3] = 1 - material->color[3];
    } else if (strcmp(word, "map_Kd") == 0) {
        read_image(path, value, looks, material);
    }
}

void mtl_read(const char *obj_path, const char *name, struct surface_builder *builder)
{
    uint32_t current = LOOKS_NONE;
    char *text = NULL;
    size_t size;
    if (!read_beside(obj_path, name, TEXT_LIMIT, &text, &size)) {
        note(&builder->surface->looks, name);
        return;
    }
    for (char *line = text; *line;) {
        char *end = line + strcspn(line, "\n"), *next = *end ? end + 1 : end;
        *end = '\0';
        line[strcspn(line, "#")] = '\0';
        read_line(obj_path, line, builder, &current);
        line = next;
    }
    free(text);
}

/// "folder/up.rest.obj" → "folder/up.rest" and the ending; false where that is too long.
static bool name_beside(const char *obj_path, const char *ending, char path[PATH_LIMIT])
{
    const int stem = (int)strlen(obj_path) - (path_has_end(obj_path, ".obj") ? 4 : 0);
    return snprintf(path, PATH_LIMIT, "%.*s%s", stem, obj_path, ending) < PATH_LIMIT;
}

static const char *name_in_folder(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

static bool write_materials(FILE *out, const char *obj_path, const struct looks *looks, struct error *error)
{
    for (int m = 0; m < looks->material_count; m++) {
        const struct looks_material *material = &looks->materials[m];
        const float *c = material->color;
        fprintf(out, "newmtl %s\nKd %.9g %.9g %.9g\nd %.9g\n", material->name, (double)c[0], (double)c[1],
                (double)c[2], (double)c[3]);
        if (!material->image) continue;
        char ending[32], path[PATH_LIMIT];
        const char *kind = looks_image_kind(material->image, material->image_size);
        snprintf(ending, sizeof ending, "-%d.%s", m + 1, kind && *kind == 'j' ? "jpg" : "png");
        if (!name_beside(obj_path, ending, path))
            return fail(error, ERROR_INPUT, "%s: the name is too long", obj_path);
        if (!file_write_atomic(path, material->image, material->image_size, error)) return false;
        fprintf(out, "map_Kd %s\n", name_in_folder(path));
    }
    return true;
}

bool mtl_write(const char *obj_path, const struct looks *looks, char name[MTL_NAME], struct error *error)
{
    char path[PATH_LIMIT];
    struct file_output output;
    if (!name_beside(obj_path, ".mtl", path) || snprintf(name, MTL_NAME, "%s", name_in_folder(path)) >= MTL_NAME)
        return fail(error, ERROR_INPUT, "%s: the name is too long", obj_path);
    if (!file_output_open(&output, path, error)) return false;
    if (write_materials(output.stream, obj_path, looks, error)) return file_output_commit(&output, error);
    file_output_discard(&output);
    return false;
}
