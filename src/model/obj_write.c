/// Writes OBJ surfaces.
#include "base/file.h"
#include "base/png.h"
#include "model/obj.h"
#include "model/surface_readers.h"
#include <stdio.h>
#include <string.h>

static void write_vertices(FILE *out, const struct surface *s)
{
    for (int i = 0; i < s->vertex_count; i++) {
        const float *p = s->position[i];
        fprintf(out, "v %.9g %.9g %.9g", (double)p[0], (double)p[1], (double)p[2]);
        for (int k = 0; s->color && k < 3; k++) fprintf(out, " %.9g", (double)srgb_from_linear(s->color[i][k]));
        fputc('\n', out);
    }
    for (int i = 0; i < s->looks.uv_count; i++)
        fprintf(out, "vt %.9g %.9g\n", (double)s->looks.uv[i][0], 1 - (double)s->looks.uv[i][1]);
}

static void write_corner(FILE *out, const struct surface *s, int index)
{
    fprintf(out, " %u", s->indices[index] + 1);
    if (s->looks.corner && s->looks.corner[index] != LOOKS_NONE) fprintf(out, "/%u", s->looks.corner[index] + 1);
}

/// A backslash at the end of a line would join it to the next one.
static void write_use(FILE *out, const char *material)
{
    const size_t length = strlen(material);
    fprintf(out, "usemtl %s%s\n", material, length > 0 && material[length - 1] == '\\' ? " " : "");
}

/// A polygon is a fan: each triangle that goes on with it adds its last corner.
static void write_faces(FILE *out, const struct surface *s)
{
    const struct looks *looks = &s->looks;
    uint32_t material = LOOKS_NONE;
    for (int i = 0; i + 2 < s->index_count; i += 3) {
        const uint32_t own = looks->material ? looks->material[i / 3] : LOOKS_NONE;
        if (own != material && own != LOOKS_NONE) write_use(out, looks->materials[own].name);
        material = own;
        fputs("f", out);
        for (int k = 0; k < 3; k++) write_corner(out, s, i + k);
        for (; looks->joined && i + 5 < s->index_count && looks->joined[i / 3 + 1]; i += 3)
            write_corner(out, s, i + 5);
        fputc('\n', out);
    }
}

bool obj_write(const char *path, const struct surface *surface, struct error *error)
{
    struct file_output output;
    char library[MTL_NAME];
    if (surface->looks.material && !mtl_write(path, &surface->looks, library, error)) return false;
    if (!file_output_open(&output, path, error)) return false;
    if (surface->looks.material) fprintf(output.stream, "mtllib %s\n", library);
    write_vertices(output.stream, surface);
    write_faces(output.stream, surface);
    return file_output_commit(&output, error);
}
