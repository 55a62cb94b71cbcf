/// Follow-through without a solve: a spline's response while you move its base by hand.
///
/// Between frames the base moves evenly, so its acceleration is a kick at each frame and x is free between. That is integrated exactly, at any
/// frame rate. The oscillator uses the solver's own step (spline/oscillator.h), with x = q and z = q'. The filter of eq. 25 in continuous time is
/// ẍ − (s₀ + s₁) ẋ + s₀s₁ x = −ÿ, from rest, y being the base. With z = ẋ − s₁ x:
///
///     z += −Δẏ,    x(t) = e^{s₁t} x + φ(t) z,    z(t) = e^{s₀t} z,    φ(t) = (e^{s₀t} − e^{s₁t}) / (s₀ − s₁).
#ifndef RIG_SWING_H
#define RIG_SWING_H

#include "rig/posing.h"
#include "spline/oscillator.h"

/// x in metres of the base's motion, and z; zero is rest.
struct swing {
    double x[2], z[2]; ///< re, im
};

struct swing_filter {
    bool oscillates; ///< else it filters
    oscillator of;
    double s[2][2];  ///< the two poles, 1/s
    double natural;  ///< rad/s
    bool is_complex; ///< else x stays real
    double peak;     ///< largest |x| after a sudden move of the base by 1
};

/// The response of a spline with these parameters at the shown time, with a damping ratio of at least 0.05, so that it comes to rest. false if
/// nothing pulls it back: cubics, frequency 0.
bool swing_filter(const struct spline *spline, const double parameter[PARAMETER_COUNT], struct swing_filter *filter);

/// The base's velocity changes by `kick`, then `dt` seconds pass.
void swing_step(struct swing *swing, const struct swing_filter *filter, double kick, double dt);

/// Whether less than a tenth of a millimetre of swing is left.
bool swing_settled(const struct swing *swing, const struct swing_filter *filter);

/// Follow-through of a tail or chain, taken as straight: where its tip goes as its joints bend.
struct swing_arm {
    int joints;
    double length;          ///< metres
    double direction[2][3]; ///< for AXIS_SIDE and AXIS_UP: unit vectors along which the base moves to bend it so
};

/// For a rig that is a tail or chain; false if its model is missing.
bool swing_arm(const struct posing *posing, int rig, struct swing_arm *arm);

/// Whether a channel, one of `count`, reacts to the base: those of the displacement do or, if an axis has none, all of its channels.
bool swing_hangs(const struct channel *channels, int count, const struct channel *channel);

/// Units of a channel's spline per metre of x. A channel of the displacement uses metres; for others the swing after a sudden move of the base
/// takes the tip about as far as the base went.
double swing_scale(const struct swing_arm *arm, const struct channel *channel, const struct swing_filter *filter);

/// The base's direction of motion, a unit vector, that drives channels of an axis; 0 for a twist.
void swing_direction(const struct swing_arm *arm, enum axis axis, double direction[3]);

#endif
