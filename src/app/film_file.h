/// Where a film's pictures go: to ffmpeg, into a .gif or into numbered files. Private to src/app.
#ifndef APP_FILM_FILE_H
#define APP_FILM_FILE_H

#include "app/film.h"
#include <sys/types.h>

/// Size, rate and length of a film.
struct film_shape {
    int width, height; ///< pixels; a picture has four bytes per pixel
    double rate;       ///< pictures per second
    long count;
    char *const *coding; ///< for ffmpeg, one of the lists below
};

struct film_file;

/// No file appears under the film's name before finish() returns FILM_DONE.
struct film_file_kind {
    /// NULL with an error. Keep `path` until close().
    struct film_file *(*open)(const char *path, const struct film_shape *shape, struct error *error);
    /// Takes the next picture. FILM_RUNS: call again with the same one (only without `wait`, or after a signal).
    enum film_state (*put)(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error);
    /// Call after the last picture. FILM_RUNS while still writing. `*bytes`: size of the files.
    enum film_state (*finish)(struct film_file *file, bool wait, off_t *bytes, struct error *error);
    /// Deletes unfinished files.
    void (*close)(struct film_file *file);
};

extern const struct film_file_kind film_ffmpeg, film_gif, film_png;

/// Arguments for ffmpeg, NULL-terminated.
extern char *const film_mp4[], *const film_webm[], *const film_webm_alpha[];

#endif
