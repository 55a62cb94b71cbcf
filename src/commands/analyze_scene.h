/// What `wiggly analyze` writes beside the character: a scene whose splines move it as the simulations did, and a table of the coordinates.
#ifndef COMMANDS_ANALYZE_SCENE_H
#define COMMANDS_ANALYZE_SCENE_H

#include "analysis/component.h"
#include "model/character.h"

/// What is known of a character's coordinate besides what its file holds.
struct analyzed {
    int rank; ///< among those of its motion, from 0
    double fps;
    int frames;
    double complex *series; ///< R, one number a frame
    struct knots knots;
};

/// Writes a scene for the character's file `model`: a spline with the knots of each coordinate, and the character that these drive. As many
/// coordinates as a character in a scene can have, the first of every motion before the second of any.
bool analyze_scene_write(const char *path, const char *model, const struct character *character,
                         const struct analyzed *analyzed, struct error *error);

/// Writes R and the spline's x of every coordinate, a row a frame: CSV with the columns frame, NAME.re, NAME.im, NAME.fit.re, NAME.fit.im.
bool analyze_coordinates_write(const char *path, const struct character *character, const struct analyzed *analyzed,
                               struct error *error);

#endif
