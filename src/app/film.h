/// Draws pictures and films of the stage offscreen. ffmpeg encodes .mp4 and .webm.
#ifndef APP_FILM_H
#define APP_FILM_H

#include "export/export.h"
#include "rig/import.h"

#define FILM_ENDINGS ".mp4, .webm, .gif and .png"

/// Whether a path names a film or a picture.
bool film_knows(const char *path);

/// false for the ending of a film that cannot be made here: in a browser only a .gif can.
bool film_can(const char *ending);

/// How many pictures a film of these frames has, and how many `rate` a second, unless options say otherwise.
double film_pictures(const char *ending, const struct document *document, double first, double last, double *rate);

/// Writes a film completely or not at all; needs no display. A .png path with %d in it (walk-%04d.png) names a sequence, and several
/// pictures in walk.png are numbered. Call with solved splines and loaded models.
bool film_write(const struct opened *opened, const char *path, const struct export_options *options,
                struct export_report *report, struct error *error);

struct film;

/// Does the same in steps, for a program with an OpenGL context and other work. Keep scene and path until film_close(). NULL with an error.
struct film *film_open(const struct opened *opened, const char *path, const struct export_options *options,
                       struct error *error);

enum film_state { FILM_RUNS, FILM_DONE, FILM_FAILED };

/// Writes at most one picture. Without `wait` it waits neither for the graphics driver nor for ffmpeg.
enum film_state film_step(struct film *film, bool wait, struct error *error);

/// Pictures done, and their total.
void film_progress(const struct film *film, long *done, long *total);
/// Size, number and names of the files; call after FILM_DONE.
void film_report(const struct film *film, struct export_report *report);
/// Leaves no files unless done. NULL is fine.
void film_close(struct film *film);

#endif
