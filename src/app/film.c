/// Films a scene: chooses frames and size, and draws the pictures.
#include "app/film.h"
#include "app/film_file.h"
#include "base/file.h"
#include "base/need.h"
#include "draw/draw.h"
#include "editor/editor.h"
#include "platform/platform.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PICTURES = 10000000, MAX_SIDE = 8192 };

static const struct film_format {
    const char *ending;
    const struct film_file_kind *kind;
    char *const *coding, *const *alpha; ///< ffmpeg's arguments (film_file.h); with transparency
    int width, height;                  ///< defaults
    double most_rate;                   ///< pictures per second that players show
    bool is_even;                       ///< only even sizes
    bool has_alpha;
    bool repeats; ///< players loop it
} formats[] = {
    {".mp4", &film_ffmpeg, film_mp4, NULL, 1280, 720, INFINITY, .is_even = true},
    {".webm", &film_ffmpeg, film_webm, film_webm_alpha, 1280, 720, INFINITY, .is_even = true, .has_alpha = true},
    {".gif", &film_gif, NULL, NULL, 640, 360, 50, .repeats = true},
    {".png", &film_png, NULL, NULL, 1280, 720, INFINITY, .has_alpha = true},
};

enum { FORMATS = sizeof formats / sizeof *formats };

struct film {
    const struct film_format *format;
    const char *path;
    const struct film_file_kind *kind;
    struct film_shape shape;
    bool transparent;
    double first, spacing,
        period; ///< frames: the first picture's, the step, and the loop's length (0: no loop)
    struct editor *editor;
    struct picture *picture;
    struct film_file *file;
    const unsigned char *pixels; ///< drawn but not yet written, else NULL
    long drawn, done;            ///< pictures
    off_t bytes;
};

static const struct film_format *find_format(const char *path)
{
    for (int f = 0; f < FORMATS; f++) {
        if (path_has_end(path, formats[f].ending)) return &formats[f];
    }
    return NULL;
}

static const struct film_format *find_ending(const char *ending)
{
    for (int f = 0; f < FORMATS; f++) {
        if (strcmp(formats[f].ending, ending) == 0) return &formats[f];
    }
    return NULL;
}

bool film_knows(const char *path) { return find_format(path) != NULL; }

/// A browser has no ffmpeg, and would make a download of each picture of many.
bool film_can(const char *ending)
{
    const struct film_format *format = find_ending(ending);
    return !format || !platform_in_page() || format->kind == &film_gif;
}

/// Whether the scene's end meets its start, by a spline or an imported clip.
static bool loops(const struct document *document)
{
    return document_loops(document) || document_find_rig(document, RIG_MODEL, 0) >= 0;
}

/// Of a film from start to end, or of `rounds` of a loop, whose end is its start.
static double count_pictures(double steps, int rounds)
{
    return rounds > 0 && steps > 0 ? fmax(1, round(rounds * steps)) : floor(steps + 1e-6) + 1;
}

double film_pictures(const char *ending, const struct document *document, double first, double last, double *rate)
{
    const struct film_format *format = find_ending(ending);
    *rate = fmin(document->fps, format->most_rate);
    return count_pictures((last - first) / document->fps * *rate, format->repeats && loops(document));
}

static bool choose_frames(struct film *film, const struct document *document, const struct export_options *options,
                          struct error *error)
{
    const double first = options->has_frames ? options->first : document->first_frame;
    const double last = options->has_frames ? options->last : document->last_frame;
    const bool in_rounds = options->loops > 0 || (film->format->repeats && loops(document));
    const int rounds = options->loops > 0 ? options->loops : 1;
    if (!(first <= last) || first < document->first_frame || last > document->last_frame)
        return fail(error, ERROR_INPUT, "--frames: expected frames from %d to %d in this order, got %g:%g",
                    document->first_frame, document->last_frame, first, last);
    if (options->loops > 0 && !loops(document))
        return fail(error, ERROR_INPUT, "--loops: nothing in this scene loops: its end does not meet its start");
    const double most = film->format->most_rate;
    if (options->rate > most)
        return fail(error, ERROR_INPUT, "--fps: expected at most %g pictures a second in a %s file, got %g", most,
                    film->format->ending, options->rate);
    film->shape.rate = options->rate > 0 ? options->rate : fmin(document->fps, most);
    film->first = first;
    film->spacing = document->fps / film->shape.rate;
    film->period = in_rounds ? last - first : 0;
    const double count = count_pictures((last - first) / film->spacing, in_rounds ? rounds : 0);
    if (count > MAX_PICTURES)
        return fail(error, ERROR_INPUT, "expected at most %d pictures, got %.0f: choose fewer frames or loops",
                    MAX_PICTURES, count);
    film->shape.count = (long)count;
    return true;
}

static bool choose_shape(struct film *film, const struct export_options *options, struct error *error)
{
    struct film_shape *shape = &film->shape;
    shape->width = options->size[0] > 0 ? options->size[0] : film->format->width;
    shape->height = options->size[1] > 0 ? options->size[1] : film->format->height;
    if (film->format->is_even) {
        shape->width = (shape->width + 1) / 2 * 2;
        shape->height = (shape->height + 1) / 2 * 2;
    }
    if (shape->width > MAX_SIDE || shape->height > MAX_SIDE)
        return fail(error, ERROR_INPUT, "--size: expected at most %d pixels a side, got %d × %d", MAX_SIDE,
                    shape->width, shape->height);
    film->transparent = options->transparent;
    shape->coding = film->transparent ? film->format->alpha : film->format->coding;
    return !options->transparent || film->format->has_alpha ||
           fail(error, ERROR_USAGE, "--transparent: a %s file has no transparency: .webm and .png have",
                film->format->ending);
}

struct film *film_open(const struct opened *opened, const char *path, const struct export_options *options,
                       struct error *error)
{
    struct film *film = need_zeroed(1, sizeof *film);
    film->format = find_format(path);
    film->kind = film->format->kind;
    film->path = path;
    film->editor = editor_create();
    if (file_check_place(path, error) && choose_shape(film, options, error) &&
        choose_frames(film, opened->document, options, error) &&
        (film->picture = picture_create(film->shape.width, film->shape.height, error)) &&
        (film->file = film->kind->open(path, &film->shape, error))) {
        editor_open(film->editor, &(struct editor_world){.document = opened->document,
                                                         .evaluation = &opened->evaluation,
                                                         .models = opened->models});
        return film;
    }
    film_close(film);
    return NULL;
}

static void draw_next(struct film *film)
{
    const double since = (double)film->drawn++ * film->spacing;
    const double frame = film->first + (film->period > 0 ? fmod(since, film->period) : since);
    editor_pose_alone(film->editor, frame, (float)film->shape.width, (float)film->shape.height);
    picture_draw(film->picture, editor_stage(film->editor), film->transparent);
}

enum film_state film_step(struct film *film, bool wait, struct error *error)
{
    if (film->done == film->shape.count) return film->kind->finish(film->file, wait, &film->bytes, error);
    if (!film->pixels) {
        if (film->drawn == film->done) draw_next(film);
        film->pixels = picture_take(film->picture, wait);
        if (!film->pixels) return FILM_RUNS;
        if (film->drawn < film->shape.count) draw_next(film); // while this one is written
    }
    enum film_state state = film->kind->put(film->file, film->pixels, wait, error);
    if (state != FILM_DONE) return state;
    film->pixels = NULL;
    film->done++;
    return FILM_RUNS;
}

void film_progress(const struct film *film, long *done, long *total)
{
    *done = film->done;
    *total = film->shape.count;
}

/// The names of the files if they differ from the path.
static const char *print_names(const struct film *film, char text[64])
{
    const char *name = path_name(film->path);
    const bool numbered = film->kind == &film_png && film->shape.count > 1 && !strchr(name, '%');
    text[0] = '\0';
    if (numbered) snprintf(text, 64, ", as %.*s-0001.png and so on", (int)fmin(30, (double)strlen(name) - 4), name);
    return text;
}

void film_report(const struct film *film, struct export_report *report)
{
    const double megabytes = (double)film->bytes / 1e6;
    char names[64];
    *report = (struct export_report){.note = ""};
    snprintf(report->text, sizeof report->text, "%ld picture%s of %d × %d, %g a second, %.*f MB%s", film->shape.count,
             film->shape.count == 1 ? "" : "s", film->shape.width, film->shape.height, film->shape.rate,
             megabytes < 1 ? 2 : 1, megabytes, print_names(film, names));
}

void film_close(struct film *film)
{
    if (!film) return;
    if (film->file) film->kind->close(film->file);
    picture_destroy(film->picture);
    editor_destroy(film->editor);
    free(film);
}

static bool run(struct film *film, const struct export_options *options, struct error *error)
{
    for (;;) {
        enum film_state state = film_step(film, true, error);
        if (state != FILM_RUNS) return state == FILM_DONE;
        if (options->proceed && !options->proceed(options->user, film->done > 0 ? film->done : 1, film->shape.count))
            return fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
    }
}

bool film_write(const struct opened *opened, const char *path, const struct export_options *options,
                struct export_report *report, struct error *error)
{
    struct platform *platform = platform_offscreen(1, 1, 1, error);
    if (!platform) return false;
    struct film *film = film_open(opened, path, options, error);
    bool done = film && run(film, options, error);
    if (done) film_report(film, report);
    film_close(film);
    platform_destroy(platform);
    return done;
}
