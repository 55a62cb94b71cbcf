/// Where the pictures of a film go: to ffmpeg or into numbered files. Private to src/app.
#ifndef APP_FILM_FILE_H
#define APP_FILM_FILE_H

#include "app/film.h"
#include <sys/types.h>

/// Size, rate and length of a film.
struct film_shape {
    int width, height; ///< pixels, each picture of four bytes a pixel
    double rate;       ///< a second
    long count;
    char *const *coding; ///< a film's, below; NULL: pictures
};

struct film_file;

/// No file appears under the film's name before finish() says FILM_DONE.
struct film_file_kind {
    /// NULL with a sentence. `path` must live as long.
    struct film_file *(*open)(const char *path, const struct film_shape *shape, struct error *error);
    /// Takes the next picture: FILM_RUNS if it has to be handed over again, which happens only without `wait` or by a signal.
    enum film_state (*put)(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error);
    /// After the last picture: FILM_RUNS while it goes on. `*bytes` is the size of what was written.
    enum film_state (*finish)(struct film_file *file, bool wait, off_t *bytes, struct error *error);
    /// Leaves nothing behind if it is not finished.
    void (*close)(struct film_file *file);
};

extern const struct film_file_kind film_ffmpeg, film_png;

/// The arguments of ffmpeg, NULL-terminated.
extern char *const film_mp4[], *const film_webm[], *const film_webm_alpha[], *const film_gif[];

#endif
