/// Steps a spline's response while you move its base by hand.
#include "rig/swing.h"
#include "maths/maths.h"
#include "rig/strand.h"
#include "spline/poles.h"
#include <math.h>

static const double STILL = 1e-4; ///< metres of swing that are invisible
static const double RADIANS = 0.017453292519943295;

static cplx pole(const struct swing_filter *filter, int k) { return (cplx){filter->s[k][0], filter->s[k][1]}; }

/// φ(t); for equal poles the limit t·e^{st}.
static cplx response(const struct swing_filter *filter, double t)
{
    const cplx apart = cplx_sub(pole(filter, 0), pole(filter, 1));
    const cplx first = cplx_exp(cplx_scale(t, pole(filter, 0)));
    if (cplx_norm(apart) * t * t < 1e-12) return cplx_scale(t, first);
    const cplx rise = cplx_sub(first, cplx_exp(cplx_scale(t, pole(filter, 1))));
    return cplx_scale(1 / cplx_norm(apart), cplx_mul(rise, cplx_conj(apart)));
}

bool swing_filter(const struct spline *spline, const double parameter[PARAMETER_COUNT], struct swing_filter *filter)
{
    wiggly_desc desc = wiggly_default_desc();
    for (enum parameter p = 0; p < PARAMETER_COUNT; p++) parameter_describe(p, parameter[p], NULL, &desc);
    desc.mode = spline_mode(spline);
    const poles at = poles_at(&desc, 0, LEAST_DAMPING);
    *filter = (struct swing_filter){.s = {{at.s[0].re, at.s[0].im}, {at.s[1].re, at.s[1].im}},
                                    .oscillates = desc.passive == WIGGLY_OSCILLATOR,
                                    .of = {at.decay, at.natural * at.natural},
                                    .natural = at.natural,
                                    .is_complex = spline_mode(spline) == WIGGLY_COMPLEX};
    if (!(at.natural > 0)) return false;

    // The response to a step of the base is φ̇, at most about ω_n φ. Two complex poles at −σ + j(ω ± β) ring up together:
    // |φ| = e^{−σt} sin(βt)/β is largest at t = atan(β/σ)/β, and or, where they coincide, at 1/σ. A damped spring stays below 1/ω_n.
    const double sigma = -filter->s[0][0], beta = 0.5 * fabs(filter->s[0][1] - filter->s[1][1]);
    const double t = beta > 1e-6 * sigma ? maths_atan2(beta, sigma) / beta : 1 / sigma;
    const bool rings = filter->is_complex && !filter->oscillates;
    filter->peak = rings ? fmax(1, filter->natural * sqrt(cplx_norm(response(filter, t)))) : 1;
    return true;
}

void swing_step(struct swing *swing, const struct swing_filter *filter, double kick, double dt)
{
    if (filter->oscillates) { // the imaginary part is at the end of the step, before the next kick
        const step_matrix m = oscillator_step(filter->of, dt);
        const double q = swing->x[0], v = swing->z[0] - kick, turn = oscillator_turn(filter->of, INFINITY);
        swing->x[0] = m.q_q * q + m.q_v * v;
        swing->z[0] = m.v_q * q + m.v_v * v;
        swing->x[1] = filter->is_complex ? turn * (swing->z[0] + filter->of.d * swing->x[0]) : 0;
        swing->z[1] = 0;
        return;
    }
    const cplx x = {swing->x[0], swing->x[1]}, z = {swing->z[0] - kick, swing->z[1]};
    const cplx later =
        cplx_add(cplx_mul(cplx_exp(cplx_scale(dt, pole(filter, 1))), x), cplx_mul(response(filter, dt), z));
    const cplx kept = cplx_mul(cplx_exp(cplx_scale(dt, pole(filter, 0))), z);
    swing->x[0] = later.re;
    swing->x[1] = filter->is_complex ? later.im : 0;
    swing->z[0] = kept.re;
    swing->z[1] = kept.im;
}

bool swing_settled(const struct swing *swing, const struct swing_filter *filter)
{
    const double to_come = maths_hypot(swing->z[0], swing->z[1]) * filter->peak / filter->natural;
    return maths_hypot(swing->x[0], swing->x[1]) + to_come < STILL;
}

bool swing_hangs(const struct channel *channels, int count, const struct channel *channel)
{
    if (channel->of == PART_DISPLACEMENT) return true;
    if (!axis_bends(channel->axis)) return false;
    for (int c = 0; c < count; c++) {
        if (channels[c].axis == channel->axis && channels[c].of == PART_DISPLACEMENT) return false;
    }
    return true;
}

double swing_scale(const struct swing_arm *arm, const struct channel *channel, const struct swing_filter *filter)
{
    if (channel->of == PART_DISPLACEMENT) return 1;
    double sum = 0; // each joint turns everything after it
    for (int n = 0; n < arm->joints; n++)
        sum += RADIANS * angles_at(&channel->gain, n, arm->joints) * (1 - (double)n / arm->joints);
    const double metres = sum * arm->length; // that a straight tail's tip moves per unit of the channel's spline
    return fabs(metres) > 1e-6 ? 1 / (metres * filter->peak) : 0;
}

bool swing_arm(const struct posing *posing, int rig, struct swing_arm *arm)
{
    const struct posing still = {.document = posing->document, .models = posing->models, .at_rest = true};
    struct strand strand;
    struct path path;
    if (!path_find(&still, rig, 0, &path)) return false;
    if (!strand_find(&still, rig_body(still.document, rig), rig, &strand)) return false;
    const struct path_node *base = &path.nodes[path.first];
    *arm = (struct swing_arm){.joints = strand.joints, .length = path_length(&path, strand.joints)};
    path_arms(&path, strand.joints - 1);
    for (enum axis axis = AXIS_SIDE; axis <= AXIS_UP; axis++) {
        double turned[3][3], *way = arm->direction[axis];
        const wiggly_value values[RIG_MAX_INPUTS] = {{0}};
        strand_turned_axes(&strand, values, 0, turned);
        path_way(base, turned[axis], way);
        const double length = maths_hypot(maths_hypot(way[0], way[1]), way[2]);
        for (int k = 0; k < 3; k++) way[k] = length > 0 ? strand_sign(&strand, axis) * way[k] / length : 0;
    }
    return true;
}

void swing_direction(const struct swing_arm *arm, enum axis axis, double direction[3])
{
    const bool is_side = axis == AXIS_SIDE || axis == AXIS_LOOK;
    for (int k = 0; k < 3; k++)
        direction[k] = axis == AXIS_TWIST ? 0 : arm->direction[is_side ? AXIS_SIDE : AXIS_UP][k];
}
