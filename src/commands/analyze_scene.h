/// The files `wiggly analyze` writes beside the character: a scene that repeats the simulated motions, and a table of the coordinates.
#ifndef COMMANDS_ANALYZE_SCENE_H
#define COMMANDS_ANALYZE_SCENE_H

#include "analysis/analysis.h"
#include "model/character.h"

/// Analysis results of a coordinate that its file does not hold.
struct analyzed {
    int rank; ///< rank within its motion, from 0
    double fps;
    int frames;
    double complex *series; ///< R, one value per frame
    struct knots knots;
};

/// Writes a scene for the character file `model`, with one spline per coordinate, as many coordinates as a scene allows. The first
/// coordinate of every motion comes before the second of any.
bool analyze_scene_write(const char *path, const char *model, const struct character *character,
                         const struct analyzed *analyzed, struct error *error);

/// Writes R and the spline's x of every coordinate, one row per frame, as CSV: frame, NAME.re, NAME.im, NAME.fit.re, NAME.fit.im.
bool analyze_coordinates_write(const char *path, const struct character *character, const struct analyzed *analyzed,
                               struct error *error);

#endif
