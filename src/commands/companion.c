/// Opens meshes, and reads and writes the file beside a simulated motion.
#include "commands/companion.h"
#include "base/file.h"
#include "base/json.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { FILE_LIMIT = 1 << 16 };

bool companion_path(const char *motion, const char *end, char path[COMPANION_PATH])
{
    const char *dot = strrchr(path_name(motion), '.');
    const int stem = (int)(dot ? dot - motion : (long)strlen(motion));
    return snprintf(path, COMPANION_PATH, "%.*s%s", stem, motion, end) < COMPANION_PATH;
}

bool companion_write(const char *motion, const struct companion *c, struct error *error)
{
    char path[COMPANION_PATH];
    struct file_output output;
    if (!companion_path(motion, ".simulation.json", path) || !file_output_open(&output, path, error)) return false;
    json_t *object = json_pack("{si si si sf s[fff] sf ss sb}", "simulation", 1, "frames", c->frames, "vertices",
                               c->vertices, "fps", c->fps, "shake", c->shake[0], c->shake[1], c->shake[2], "from",
                               c->from, "pin", c->pin, "world", c->world);
    json_dumpf(object, output.stream, JSON_INDENT(2) | JSON_REAL_PRECISION(9));
    fputc('\n', output.stream);
    json_decref(object);
    return file_output_commit(&output, error);
}

bool companion_read(const char *motion, int frames, int vertices, struct companion *c, struct error *error)
{
    char path[COMPANION_PATH], *text;
    size_t size;
    *c = (struct companion){0};
    if (!companion_path(motion, ".simulation.json", path) || access(path, F_OK) != 0) return true;
    if (!file_read_text(path, FILE_LIMIT, &text, &size, error)) return false;

    json_error_t wrong;
    const char *pin = "";
    int world = 0;
    json_t *object = json_read(text, size, 0, &wrong);
    bool done =
        object && json_unpack_ex(object, &wrong, 0, "{si si sF s[FFF] sF ss sb}", "frames", &c->frames, "vertices",
                                 &c->vertices, "fps", &c->fps, "shake", &c->shake[0], &c->shake[1], &c->shake[2],
                                 "from", &c->from, "pin", &pin, "world", &world) == 0;
    double square = 0;
    for (int k = 0; k < 3; k++) square += c->shake[k] * c->shake[k];
    const bool is_sound = c->fps > 0 && c->from >= 0 && isfinite(c->fps) && isfinite(c->from) &&
                          fabs(square - 1) < 1e-3 && strlen(pin) < sizeof c->pin;
    if (!done)
        fail(error, ERROR_INPUT, "%s: expected what wiggly simulate writes: %s", path, wrong.text);
    else if (!is_sound)
        done = fail(error, ERROR_INPUT, "%s: expected what wiggly simulate writes, got a number out of range", path);
    else
        strcpy(c->pin, pin);
    c->world = world;
    json_decref(object);
    free(text);
    if (done && (c->frames != frames || c->vertices != vertices)) {
        print_line(stderr, "%s: warning: ignored, as it describes another motion (%d frames of %d vertices)", path,
                   c->frames, c->vertices);
        *c = (struct companion){0};
    }
    return done;
}

bool open_mesh(const char *path, const struct mesh_options *options, struct surface *surface, struct error *error)
{
    // z up becomes y up as in Blender's exporters: x stays, y becomes −z. x up: z stays, x becomes y, y becomes −x.
    static const struct {
        int from[3], sign[3]; // for each of our axes
    } turns[] = {{{1, 0, 2}, {-1, 1, 1}}, {{0, 1, 2}, {1, 1, 1}}, {{0, 2, 1}, {1, 1, -1}}};
    const int up = options->up ? options->up - 1 : 1;
    bool done = surface_read(path, surface, error);
    for (int i = 0; done && i < surface->vertex_count; i++) {
        const float *p = surface->position[i];
        float placed[3];
        for (int c = 0; c < 3; c++)
            placed[c] = (float)((double)p[turns[up].from[c]] * turns[up].sign[c] * options->scale);
        done = (isfinite(placed[0]) && isfinite(placed[1]) && isfinite(placed[2])) ||
               fail(error, ERROR_INPUT, "%s: expected a size that --scale keeps finite, got an infinite one", path);
        memcpy(surface->position[i], placed, sizeof placed);
    }
    if (!done) {
        surface_free(surface);
        return false;
    }
    uint8_t *used = surface_used_vertices(surface);
    int stray = surface->vertex_count;
    for (int i = 0; i < surface->vertex_count; i++) stray -= used[i];
    if (stray > 0) {
        print_line(stderr, "%s: warning: %d %s of no triangle: left where they are", path, stray,
                   stray == 1 ? "vertex is part" : "vertices are part");
    }
    if (surface->looks.left_out)
        print_line(stderr, "%s: warning: %s cannot be read and is left out", path, surface->looks.left_out);
    free(used);
    return true;
}
