/// The parameters of a spline, one row each: all that the file, the edits, the solver's description and the editor know of one.
///
/// A new one is a constant here, in the place where it is saved, and its row in parameter.c; beside that the solver's own
/// member of wiggly_desc and what it does there.
#ifndef SCENE_PARAMETER_H
#define SCENE_PARAMETER_H

#include "scene/param.h"
#include <wiggly/wiggly.h>

/// In the order in which they are saved and shown.
enum parameter {
    PARAMETER_MODE,
    PARAMETER_FREQUENCY,
    PARAMETER_DAMPING,
    PARAMETER_BANDWIDTH,
    PARAMETER_SPRING,
    PARAMETER_FRICTION,
    PARAMETER_CALM,
    PARAMETER_EQUILIBRIUM,
    PARAMETER_START,
    PARAMETER_COUNT
};

enum parameter_kind {
    PARAMETER_TRACK,  ///< a number or a track: a wiggly_param of the description
    PARAMETER_NUMBER, ///< a number only: a double
    PARAMETER_CHOICE, ///< one of several words: an enum
};

/// Of two pairs that say the same a spline has one.
enum parameter_pair { PAIR_NONE, PAIR_RATIO, PAIR_SPRING };

enum {
    IN_COMPLEX = 1 << WIGGLY_COMPLEX,
    IN_REAL = 1 << WIGGLY_REAL,
    IN_CUBIC = 1 << WIGGLY_CUBIC,
    IN_ALL = IN_COMPLEX | IN_REAL | IN_CUBIC,
};

enum { PARAMETER_MAX_WORDS = 3 };

struct parameter_row {
    const char *name; ///< in the file and on screen
    const char *unit; ///< or NULL
    const char *hint, *undo;
    const char *letter; ///< held while arrows change it, or NULL
    enum parameter_kind kind;
    enum parameter_pair pair;
    unsigned modes;          ///< in which it counts: IN_COMPLEX | …
    size_t place;            ///< in wiggly_desc
    double minimum, maximum; ///< of a constant
    double complex_maximum;  ///< in complex mode, or 0: the same
    double usual; ///< where a slider ends, or 0: it has none; no frequency's goes beyond half the sample rate
    bool is_frequency;
    double standard; ///< where a file says nothing
    double fresh;    ///< of a new spline
    double step;     ///< of arrow keys
    int decimals;
    const char *words[PARAMETER_MAX_WORDS + 1]; ///< of a choice, in the file
    const char *labels[PARAMETER_MAX_WORDS];    ///< on screen
};

extern const struct parameter_row parameter_rows[PARAMETER_COUNT];

double parameter_maximum(enum parameter parameter, enum wiggly_mode mode);

/// A value put into the range of constants in that mode.
double parameter_clamped(enum parameter parameter, enum wiggly_mode mode, double value);

/// The parameter with that key of a file, or that is changed while that letter is held; PARAMETER_COUNT where there is none.
enum parameter parameter_find(const char *name);
enum parameter parameter_of_letter(int letter);

/// Writes a parameter into its place.
void parameter_describe(enum parameter parameter, double value, const double *track, wiggly_desc *desc);

#endif
