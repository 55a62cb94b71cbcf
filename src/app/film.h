/// Pictures and films of a scene: the stage alone, drawn offscreen frame by frame. Films go through ffmpeg.
#ifndef APP_FILM_H
#define APP_FILM_H

#include "export/export.h"
#include "rig/opened.h"

#define FILM_ENDINGS ".mp4, .webm, .gif and .png"

/// Whether a file of that name is a film or a picture.
bool film_knows(const char *path);

/// Draws a film and writes it whole or not at all; needs no display. A .png name with %d in it, as walk-%04d.png, names a sequence;
/// walk.png is short for that if there are several pictures. The splines must be solved and the models read.
bool film_write(const struct opened *opened, const char *path, const struct export_options *options,
                struct export_report *report, struct error *error);

struct film;

/// The same in steps, for a program that has an OpenGL context and other things to do. Scene and path must live as long; NULL with a
/// sentence.
struct film *film_open(const struct opened *opened, const char *path, const struct export_options *options,
                       struct error *error);

enum film_state { FILM_RUNS, FILM_DONE, FILM_FAILED };

/// Draws at most one picture. Where `wait` is false, it does not wait for ffmpeg either.
enum film_state film_step(struct film *film, bool wait, struct error *error);

/// How many pictures are done, and of how many.
void film_progress(const struct film *film, long *done, long *total);
/// Size, number and names of the written files; after FILM_DONE.
void film_report(const struct film *film, struct export_report *report);
/// If it is not done, nothing is left behind. NULL is fine.
void film_close(struct film *film);

#endif
