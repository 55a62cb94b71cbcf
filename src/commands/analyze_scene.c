/// Writes the scene for `wiggly analyze --scene`.
#include "commands/analyze_scene.h"
#include "base/file.h"
#include "scene/document.h"
#include "scene/text.h"
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// A file's real path: its folder without symbolic links, "/", its name. NULL with errno set.
static char *real_place(const char *path)
{
    const char *slash = strrchr(path, '/');
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : strdup(".");
    char *real = folder ? realpath(folder, NULL) : NULL;
    const char *name = slash ? slash + 1 : path;
    char *place = real ? malloc(strlen(real) + strlen(name) + 2) : NULL;
    if (place) sprintf(place, "%s/%s", strcmp(real, "/") == 0 ? "" : real, name);
    free(folder);
    free(real);
    return place;
}

/// `to` as a scene at `from` names it. Both are real paths.
static void add_relative(struct text *text, const char *from, const char *to)
{
    size_t common = 0;
    for (size_t i = 0; from[i] && from[i] == to[i]; i++) {
        if (from[i] == '/') common = i + 1;
    }
    char relative[PATH_MAX] = "";
    for (const char *c = from + common; *c; c++) {
        if (*c == '/') strncat(relative, "../", sizeof relative - strlen(relative) - 1);
    }
    strncat(relative, to + common, sizeof relative - strlen(relative) - 1);
    text_quoted(text, relative);
}

static void add_member(struct text *text, const char *before, double value)
{
    text_string(text, before);
    text_number(text, value);
}

static double rounded(double value) { return round(value * 1000) / 1000; }

/// A loop of ten periods with a knot every two and a half: over longer gaps the swing would beat at this bandwidth.
static void add_spline(struct text *text, const struct coordinate *first, int frames)
{
    static const double values[] = {1, -0.6, 0.8, -0.4};
    enum { KNOTS = sizeof values / sizeof values[0] };
    text_string(text, "    { \"name\": \"swing\", \"mode\": \"complex\"");
    add_member(text, ", \"frequency\": ", rounded(first->frequency));
    add_member(text, ", \"damping\": ", rounded(first->damping));
    text_string(text, ", \"bandwidth\": 0.1, \"start\": \"loop\",\n      \"knots\": [");
    for (int i = 0; i < KNOTS; i++) {
        add_member(text, i > 0 ? ",\n                { \"frame\": " : "{ \"frame\": ", frames * i / KNOTS);
        add_member(text, ", \"value\": ", values[i]);
        text_string(text, " }");
    }
    text_string(text, "] }\n");
}

static void add_scene(struct text *text, const struct character *character, int modes, const char *from,
                      const char *model)
{
    const struct coordinate *first = &character->coordinates[0];
    double fps = 24, seconds = first->frequency > 0 ? fmin(10 / first->frequency, 60) : 4;
    while (fps < 8 * first->frequency && fps < 50000) fps *= 2;
    int frames = (int)(fps * seconds);
    add_member(text, "{\n  \"wiggly\": 1, \"fps\": ", fps);
    add_member(text, ", \"frames\": [0, ", frames);
    text_string(text, "],\n  \"splines\": [\n");
    add_spline(text, first, frames);
    text_string(text, "  ],\n  \"rigs\": [\n    { \"type\": \"character\", \"name\": \"character\", \"model\": ");
    add_relative(text, from, model);
    text_string(text, ",\n      \"coordinates\": [");
    for (int i = 0, drives = 0; i < character->coordinate_count && drives < CHARACTER_MAX_DRIVES; i += modes) {
        text_string(text, drives++ > 0 ? ",\n        { \"name\": " : "\n        { \"name\": ");
        text_quoted(text, character->coordinates[i].name);
        text_string(text, ", \"spline\": \"swing\", \"amplitude\": 1, \"lag\": 0 }");
    }
    text_string(text, "] }\n  ]\n}\n");
}

bool analyze_scene_write(const char *path, const char *model, const struct character *character, int modes,
                         struct error *error)
{
    struct text text = {0};
    char *from = real_place(path), *to = from ? real_place(model) : NULL;
    bool done;
    if (!to) {
        done = fail(error, ERROR_ENVIRONMENT, "%s: cannot be written: %s", path, strerror(errno));
    } else {
        add_scene(&text, character, modes, from, to);
        done = text.no_memory ? fail_no_memory(error, path) : file_write_atomic(path, text.data, text.size, error);
    }
    free(text.data);
    free(from);
    free(to);
    return done;
}
