/// Writes the scene and the table of coordinates for `wiggly analyze`.
#include "commands/analyze_scene.h"
#include "base/error.h"
#include "base/file.h"
#include "base/need.h"
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
    char *folder = slash ? strndup(path, (size_t)(slash - path) + 1) : need_text(".");
    char *real = folder ? realpath(folder, NULL) : NULL;
    const char *name = slash ? slash + 1 : path;
    char *place = real ? need(strlen(real) + strlen(name) + 2, 1) : NULL;
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

static void add_spline(struct text *text, const struct coordinate *coordinate, const struct analyzed *analyzed,
                       double fps)
{
    const struct knots *knots = &analyzed->knots;
    text_string(text, "{ \"name\": ");
    text_quoted(text, coordinate->name);
    text_string(text, knots->mode == WIGGLY_REAL ? ", \"mode\": \"real\"" : ", \"mode\": \"complex\"");
    add_member(text, ", \"frequency\": ", knots->frequency);
    add_member(text, ", \"damping\": ", knots->damping);
    if (knots->mode == WIGGLY_COMPLEX) add_member(text, ", \"bandwidth\": ", knots->bandwidth);
    text_string(text, ",\n      \"knots\": [");
    for (int i = 0; i < knots->count; i++) {
        double frame = knots->frame[i] * fps / analyzed->fps;
        add_member(text, i > 0 ? ",\n                { \"frame\": " : "{ \"frame\": ", round(frame * 1000) / 1000);
        add_member(text, ", \"value\": ", knots->value[i]);
        if (knots->sloped) add_member(text, ", \"slope\": ", knots->slope[i]);
        text_string(text, " }");
    }
    text_string(text, "] }");
}

/// The coordinates that the scene drives; returns their number.
static int choose(const struct character *character, const struct analyzed *analyzed, int *chosen)
{
    int count = 0;
    for (int rank = 0; rank < character->coordinate_count; rank++) {
        for (int i = 0; i < character->coordinate_count && count < CHARACTER_MAX_DRIVES; i++) {
            if (analyzed[i].rank == rank) chosen[count++] = i;
        }
    }
    return count;
}

static void add_scene(struct text *text, const struct character *character, const struct analyzed *analyzed,
                      const char *from, const char *model)
{
    int chosen[CHARACTER_MAX_DRIVES], count = choose(character, analyzed, chosen);
    double fps = 0, seconds = 0;
    for (int i = 0; i < count; i++) {
        fps = fmax(fps, analyzed[chosen[i]].fps);
        seconds = fmax(seconds, (analyzed[chosen[i]].frames - 1) / analyzed[chosen[i]].fps);
    }
    add_member(text, "{\n  \"wiggly\": 1, \"fps\": ", fps);
    add_member(text, ", \"frames\": [0, ", round(fps * seconds));
    text_string(text, "],\n  \"splines\": [");
    for (int i = 0; i < count; i++) {
        text_string(text, i > 0 ? ",\n    " : "\n    ");
        add_spline(text, &character->coordinates[chosen[i]], &analyzed[chosen[i]], fps);
    }
    text_string(text, "\n  ],\n  \"rigs\": [\n    { \"type\": \"character\", \"name\": \"character\", \"model\": ");
    add_relative(text, from, model);
    text_string(text, ",\n      \"coordinates\": [");
    for (int i = 0; i < count; i++) {
        const char *name = character->coordinates[chosen[i]].name;
        text_string(text, i > 0 ? ",\n        { \"name\": " : "\n        { \"name\": ");
        text_quoted(text, name);
        text_string(text, ", \"spline\": ");
        text_quoted(text, name);
        text_string(text, ", \"amplitude\": 1, \"lag\": 0 }");
    }
    text_string(text, "] }\n  ]\n}\n");
}

bool analyze_scene_write(const char *path, const char *model, const struct character *character,
                         const struct analyzed *analyzed, struct error *error)
{
    struct text text = {0};
    char *from = real_place(path), *to = from ? real_place(model) : NULL;
    bool done;
    if (!to) {
        done = fail(error, ERROR_ENVIRONMENT, "%s: cannot be written: %s", path, strerror(errno));
    } else {
        add_scene(&text, character, analyzed, from, to);
        done = file_write_atomic(path, text.data, text.size, error);
    }
    free(text.data);
    free(from);
    free(to);
    return done;
}

static void write_header(FILE *out, const struct character *character)
{
    static const char *const suffixes[] = {".re", ".im", ".fit.re", ".fit.im"};
    fputs("frame", out);
    for (int i = 0; i < character->coordinate_count; i++) {
        for (int k = 0; k < 4; k++) {
            fputc(',', out);
            print_field(out, character->coordinates[i].name, suffixes[k]);
        }
    }
    fputc('\n', out);
}

/// A motion that has ended leaves its fields empty.
static void write_row(FILE *out, const struct analyzed *analyzed, int count, int frame)
{
    fprintf(out, "%d", frame);
    for (int i = 0; i < count; i++) {
        if (frame >= analyzed[i].frames) {
            fputs(",,,,", out);
            continue;
        }
        double complex r = analyzed[i].series[frame], x = analyzed[i].knots.series[frame];
        fprintf(out, ",%.9g,%.9g,%.9g,%.9g", creal(r), cimag(r), creal(x), cimag(x));
    }
    fputc('\n', out);
}

bool analyze_coordinates_write(const char *path, const struct character *character, const struct analyzed *analyzed,
                               struct error *error)
{
    struct file_output output;
    int frames = 0;
    for (int i = 0; i < character->coordinate_count; i++) {
        if (analyzed[i].frames > frames) frames = analyzed[i].frames;
    }
    if (!file_output_open(&output, path, error)) return false;
    write_header(output.stream, character);
    for (int t = 0; t < frames && !ferror(output.stream); t++)
        write_row(output.stream, analyzed, character->coordinate_count, t);
    return file_output_commit(&output, error);
}
