/// An adversary's problem as a scene.
#include "adversary.h"

static const struct member {
    const char *key;
    size_t at;
} members[] = {
    {"frequency", offsetof(wiggly_desc, frequency)},
    {"damping", offsetof(wiggly_desc, damping)},
    {"bandwidth", offsetof(wiggly_desc, bandwidth)},
    {"equilibrium", offsetof(wiggly_desc, equilibrium)},
};

/// A cubic with a knot on every sample: its total is the track, to the bit.
static void print_track(FILE *out, const struct adversary_problem *p, int track)
{
    fprintf(out, "{\"name\": \"track%d\", \"mode\": \"cubic\", \"knots\": [", track);
    for (int i = 0; i < p->desc.samples; i++)
        fprintf(out, "%s{\"frame\": %d, \"value\": %.17g}", i ? ", " : "", i, p->tracks[track][i]);
    fprintf(out, "]}, ");
}

static void print_params(FILE *out, const struct adversary_problem *p)
{
    for (size_t m = 0; m < sizeof members / sizeof *members; m++) {
        const wiggly_param *param = (const wiggly_param *)((const char *)&p->desc + members[m].at);
        if (param->track) {
            int track = 0;
            while (p->tracks[track] != param->track) track++;
            fprintf(out, ", \"%s\": {\"spline\": \"track%d\"}", members[m].key, track);
        } else {
            fprintf(out, ", \"%s\": %.17g", members[m].key, param->value);
        }
    }
}

void adversary_print(FILE *out, const struct adversary_problem *p)
{
    static const char *const modes[] = {"complex", "real", "cubic"}, *const starts[] = {"free", "rest", "loop"};
    const wiggly_desc *d = &p->desc;
    fprintf(out, "{\"wiggly\": 1, \"fps\": %.17g, \"frames\": [0, %d], \"splines\": [", p->fps, d->samples - 1);
    for (int t = 0; t < p->tracks_used; t++) print_track(out, p, t);
    fprintf(out,
            "{\"name\": \"problem\", \"mode\": \"%s\", \"start\": \"%s\", \"passive\": \"%s\", \"calm\": %.17g, "
            "\"wind_up\": %.17g",
            modes[d->mode], starts[d->start], d->passive == WIGGLY_FILTER ? "filter" : "oscillator", d->calm,
            d->wind_up);
    print_params(out, p);
    fprintf(out, ", \"knots\": [");
    for (int k = 0; k < d->knot_count; k++) {
        const wiggly_knot *knot = &d->knots[k];
        fprintf(out, "%s{\"frame\": %d", k ? ", " : "", knot->sample);
        if (knot->still) fprintf(out, ", \"still\": true");
        if (!knot->still) fprintf(out, ", \"value\": %.17g", knot->value);
        if (knot->settles) fprintf(out, ", \"settles\": true");
        if (knot->has_phase) fprintf(out, ", \"im\": %.17g", knot->phase);
        if (knot->has_slope) fprintf(out, ", \"slope\": %.17g, \"stiffness\": %.17g", knot->slope, knot->stiffness);
        fprintf(out, "}");
    }
    fprintf(out, "]}]}\n");
}
