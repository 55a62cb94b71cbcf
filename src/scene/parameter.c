/// The table of parameters.
#include "scene/parameter.h"
#include <math.h>
#include <string.h>

#define PLACE(member) offsetof(wiggly_desc, member)

const struct parameter_row parameter_rows[PARAMETER_COUNT] = {
    [PARAMETER_MODE] =
        {.name = "mode",
         .hint = "Wiggly: swings, with a free phase. Spring: swings as a damped spring. Cubic: no swing (M)",
         .undo = "Change kind",
         .kind = PARAMETER_CHOICE,
         .modes = IN_ALL,
         .place = PLACE(mode),
         .maximum = WIGGLY_CUBIC,
         .words = {"complex", "real", "cubic"},
         .labels = {"Wiggly", "Spring", "Cubic"}},
    [PARAMETER_FREQUENCY] = {.name = "frequency",
                             .unit = "Hz",
                             .hint = "Swings per second (hold F and press ↑ ↓)",
                             .undo = "Set frequency",
                             .modes = IN_COMPLEX | IN_REAL,
                             .place = PLACE(frequency),
                             .maximum = INFINITY,
                             .usual = 12,
                             .fresh = 1,
                             .step = 0.05},
    [PARAMETER_DAMPING] = {.name = "damping",
                           .hint = "0 rings forever, 1 is critical (hold Z and press ↑ ↓)",
                           .undo = "Set damping",
                           .modes = IN_COMPLEX | IN_REAL,
                           .place = PLACE(damping),
                           .maximum = INFINITY,
                           .complex_maximum = 1,
                           .usual = 3,
                           .fresh = 0.1,
                           .step = 0.01},
    [PARAMETER_BANDWIDTH] = {.name = "bandwidth",
                             .hint = "How freely the swing may change its pace between knots",
                             .undo = "Set bandwidth",
                             .modes = IN_COMPLEX,
                             .place = PLACE(bandwidth),
                             .maximum = 1,
                             .usual = 1,
                             .standard = 0.1,
                             .fresh = 0.1,
                             .step = 0.01},
    [PARAMETER_CALM] = {.name = "calm",
                        .hint = "How much swing at the start costs; 0 is the paper's formula",
                        .undo = "Set calm",
                        .kind = PARAMETER_NUMBER,
                        .modes = IN_COMPLEX | IN_REAL,
                        .place = PLACE(calm),
                        .maximum = 1,
                        .usual = 1,
                        .standard = 1,
                        .fresh = 1,
                        .step = 0.01},
    [PARAMETER_WIND_UP] = {.name = "wind-up",
                           .key = "wind_up",
                           .unit = "frames",
                           .hint = "How long before a knot the motion is pushed; after it, it swings freely",
                           .undo = "Set wind-up",
                           .kind = PARAMETER_NUMBER,
                           .modes = IN_COMPLEX,
                           .place = PLACE(wind_up),
                           .maximum = 100,
                           .usual = 2,
                           .is_quiet = true,
                           .fresh = 0.5,
                           .step = 1},
    [PARAMETER_EQUILIBRIUM] = {.name = "equilibrium",
                               .hint = "The value it settles at",
                               .undo = "Set equilibrium",
                               .modes = IN_ALL,
                               .place = PLACE(equilibrium),
                               .minimum = -INFINITY,
                               .maximum = INFINITY,
                               .step = 0.01},
    [PARAMETER_START] = {.name = "start",
                         .hint = "Free: starts mid-swing. Rest: starts still. Closed: the end meets the start",
                         .undo = "Change start",
                         .kind = PARAMETER_CHOICE,
                         .modes = IN_ALL,
                         .place = PLACE(start),
                         .maximum = WIGGLY_LOOP,
                         .words = {"free", "rest", "loop"},
                         .labels = {"Free", "Rest", "Closed"}},
    [PARAMETER_PASSIVE] = {.name = "passive",
                           .hint = "Swings by itself like a spring, or as the paper's filter does",
                           .undo = "Change what moves by itself",
                           .kind = PARAMETER_CHOICE,
                           .modes = IN_ALL,
                           .place = PLACE(passive),
                           .maximum = WIGGLY_FILTER,
                           .is_quiet = true,
                           .words = {"oscillator", "filter"},
                           .labels = {"Oscillator", "Filter"}},
    [PARAMETER_LOW] = {.name = "low limit",
                       .key = "limits",
                       .hint = "The curve never goes below this",
                       .undo = "Set low limit",
                       .kind = PARAMETER_LIMIT,
                       .modes = IN_ALL,
                       .place = PLACE(low),
                       .minimum = -INFINITY,
                       .maximum = INFINITY,
                       .standard = -INFINITY,
                       .is_quiet = true,
                       .fresh = -INFINITY,
                       .step = 0.01},
    [PARAMETER_HIGH] = {.name = "high limit",
                        .key = "limits",
                        .hint = "The curve never goes above this",
                        .undo = "Set high limit",
                        .kind = PARAMETER_LIMIT,
                        .modes = IN_ALL,
                        .place = PLACE(high),
                        .minimum = -INFINITY,
                        .maximum = INFINITY,
                        .standard = INFINITY,
                        .is_quiet = true,
                        .fresh = INFINITY,
                        .step = 0.01},
    [PARAMETER_VARIATION] = {.name = "variation",
                             .hint = "How far the curve strays between its knots; 1: as far as the farthest knot",
                             .undo = "Set variation",
                             .kind = PARAMETER_NUMBER,
                             .modes = IN_COMPLEX | IN_REAL,
                             .place = PLACE(variation),
                             .maximum = 100,
                             .usual = 1,
                             .is_quiet = true,
                             .step = 0.01},
    [PARAMETER_SEED] = {.name = "seed",
                        .key = "variation",
                        .hint = "Which of the variations: another number is another motion",
                        .undo = "Set seed",
                        .kind = PARAMETER_WHOLE,
                        .modes = IN_COMPLEX | IN_REAL,
                        .place = PLACE(variation_seed),
                        .maximum = 999999,
                        .is_quiet = true,
                        .step = 1},
};

double parameter_maximum(enum parameter parameter, enum wiggly_mode mode)
{
    const struct parameter_row *row = &parameter_rows[parameter];
    return mode == WIGGLY_COMPLEX && row->complex_maximum > 0 ? row->complex_maximum : row->maximum;
}

double parameter_clamped(enum parameter parameter, enum wiggly_mode mode, double value)
{
    return fmax(parameter_rows[parameter].minimum, fmin(parameter_maximum(parameter, mode), value));
}

enum parameter parameter_find(const char *name)
{
    enum parameter p = 0;
    while (p < PARAMETER_COUNT && strcmp(parameter_key(p), name) != 0) p++;
    return p;
}

void parameter_describe(enum parameter parameter, double value, const double *track, wiggly_desc *desc)
{
    void *at = (char *)desc + parameter_rows[parameter].place;
    if (parameter_rows[parameter].kind == PARAMETER_TRACK) {
        *(wiggly_param *)at = (wiggly_param){value, track};
    } else if (parameter_rows[parameter].kind == PARAMETER_CHOICE) {
        *(unsigned *)at = (unsigned)value;
    } else if (parameter_rows[parameter].kind == PARAMETER_WHOLE) {
        *(int *)at = (int)value;
    } else {
        *(double *)at = value;
    }
}
