/// How the base of a shaken body moves: a displacement over time along one direction.
#ifndef SIMULATION_DRIVE_H
#define SIMULATION_DRIVE_H

#include "base/error.h"
#include <stdbool.h>

enum drive_kind {
    DRIVE_NONE,
    DRIVE_SINE,  ///< one frequency, swelling over its first two periods
    DRIVE_BURST, ///< three periods under a smooth window, then stillness
    DRIVE_SWEEP, ///< from half the frequency to twice it, swelling and fading for a tenth of the time each
    DRIVE_TRACK, ///< a track from a file
};

struct drive {
    enum drive_kind kind;
    double direction[3]; ///< of length 1
    double size;         ///< the largest displacement, m; for a track, the factor it is multiplied by
    double frequency;    ///< Hz
    double seconds;      ///< length of the whole motion; a sweep takes this long
    int count;           ///< of the track's samples
    double *time;        ///< s, ascending
    double *value;
    double *curvature; ///< second derivatives of the natural cubic spline at the samples
};

/// Reads a track, one "seconds,displacement" a line; headings and blank lines are skipped. Sets kind and samples.
bool drive_read_track(struct drive *drive, const char *path, struct error *error);
void drive_free(struct drive *drive);

/// Displacement from the start along the direction, m. All kinds have continuous velocities.
double drive_place(const struct drive *drive, double time);

/// Its second derivative, m/s².
double drive_acceleration(const struct drive *drive, double time);

/// The second at which the drive ends; infinite if it never ends.
double drive_end(const struct drive *drive);

#endif
