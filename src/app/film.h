/// Draws pictures and films of the stage offscreen. ffmpeg encodes .mp4 and .webm.
#ifndef APP_FILM_H
#define APP_FILM_H

#include "export/export.h"
#include "rig/import.h"
#include <sys/types.h>

/// Writes a film completely or not at all, of numbered pictures but for those it has replaced; needs no display. A .png path with %d in it (walk-%04d.png) names a sequence, and several
/// pictures in walk.png are numbered. Call with solved splines and loaded models.
bool film_write(const struct opened *opened, const char *path, const struct export_options *options,
                struct export_report *report, struct error *error);

struct film;

/// Does the same in steps, for a program with an OpenGL context and other work. Keep scene and path until film_close(). NULL with an error.
struct film *film_open(const struct opened *opened, const char *path, const struct export_options *options,
                       struct error *error);

enum film_state { FILM_RUNS, FILM_DONE, FILM_FAILED };

/// Writes at most one picture, if the options' proceed() agrees. Without `wait` it waits neither for the graphics driver nor for ffmpeg.
enum film_state film_step(struct film *film, bool wait, struct error *error);

/// Size, number and names of the files; call after FILM_DONE.
void film_report(const struct film *film, struct export_report *report);
/// Leaves no files unless done. NULL is fine.
void film_close(struct film *film);

// Where the pictures go: to ffmpeg, into a .gif or into numbered files. Private to film.c and its tests.

/// Size, rate and length of a film.
struct film_shape {
    int width, height; ///< pixels; a picture has four bytes per pixel
    double rate;       ///< pictures per second
    long count;
    char *const *coding; ///< for ffmpeg, one of the lists below
};

struct film_file;

/// No film appears under its name before finish() returns FILM_DONE; numbered pictures appear one by one.
struct film_file_kind {
    /// Of a file that has its path and shape.
    bool (*open)(struct film_file *file, struct error *error);
    /// Takes the next picture. FILM_RUNS: call again with the same one (only without `wait`, or after a signal).
    enum film_state (*put)(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error);
    /// Call after the last picture. FILM_RUNS while still writing. `*bytes`: size of the files.
    enum film_state (*finish)(struct film_file *file, bool wait, off_t *bytes, struct error *error);
};

extern const struct film_file_kind film_ffmpeg, film_gif, film_png;

/// NULL with an error. Keep `path` until film_file_close().
struct film_file *film_file_open(const struct film_file_kind *kind, const char *path, const struct film_shape *shape,
                                 struct error *error);
/// Deletes unfinished files, and all numbered pictures of an unfinished film.
void film_file_close(struct film_file *file);

/// Arguments for ffmpeg, NULL-terminated.
extern char *const film_mp4[], *const film_webm[], *const film_webm_alpha[];

#endif
