/// What one round asks of a pin: where its point is to go, and how strictly. Private to src/scene.
#ifndef SCENE_PIN_AIM_H
#define SCENE_PIN_AIM_H

#include "scene/pin_source.h"

/// How far splines move a point: |c| over all of a pin's pulls.
double pin_ease(const wiggly_pin *pin);

/// Sets where x is to take a point that is at `from`, where Σ Re(c x) is `passed`; `ease` is pin_ease() without pins. A tail's or chain's is
/// taken only part of its way where it is far or hard to move, and its conditions (also in `pulls`, which are the pin's) are weighed so
/// that what hardly moves it, as the motion is without pins, gives way. All of it is continuous in `to` and `from`.
void pin_aim(const struct pin_point *from, double ease, const double to[3], const double passed[3], wiggly_pin *pin,
             wiggly_pull *pulls);

#endif
