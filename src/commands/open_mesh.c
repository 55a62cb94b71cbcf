/// Reads meshes, turns them upright, scales them, and reports what was left out.
#include "commands/open_mesh.h"
#include "base/error.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// z up becomes y up as in Blender's exporters: x stays, y becomes −z. x up: z stays, x becomes y, y becomes −x.
static bool place(const struct mesh_options *options, struct surface *surface)
{
    static const struct {
        int from[3], sign[3]; // for each of our axes
    } turns[] = {{{1, 0, 2}, {-1, 1, 1}}, {{0, 1, 2}, {1, 1, 1}}, {{0, 2, 1}, {1, 1, -1}}};
    const int up = options->up ? options->up - 1 : 1;
    for (int i = 0; i < surface->vertex_count; i++) {
        const float *p = surface->position[i];
        float placed[3];
        for (int c = 0; c < 3; c++) {
            placed[c] = (float)((double)p[turns[up].from[c]] * turns[up].sign[c] * options->scale);
            if (!isfinite(placed[c])) return false;
        }
        memcpy(surface->position[i], placed, sizeof placed);
    }
    return true;
}

static void warn(const char *path, const struct surface *surface)
{
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
}

bool open_mesh(const char *path, const struct mesh_options *options, struct surface *surface, struct error *error)
{
    bool done = surface_read(path, surface, error);
    if (done && !place(options, surface))
        done = fail(error, ERROR_INPUT, "%s: expected a size that --scale keeps finite, got an infinite one", path);
    if (done)
        warn(path, surface);
    else
        surface_free(surface);
    return done;
}
