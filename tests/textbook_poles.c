/// Poles of the textbook's spline.
#include "textbook_parts.h"

real textbook_param(wiggly_param param, int sample) { return param.track ? param.track[sample] : param.value; }

static real not_negative(wiggly_param param, int sample) { return fmaxq(textbook_param(param, sample), 0); }

struct textbook_poles textbook_poles_at(const wiggly_desc *desc, int sample, real floor)
{
    struct textbook_poles at = {0};
    number j = 1.0Qi;
    if (desc->mode == WIGGLY_CUBIC) return at;
    real w = 2 * M_PIq * not_negative(desc->frequency, sample), zeta = not_negative(desc->damping, sample);
    zeta = fmaxq(zeta, floor);
    if (desc->mode == WIGGLY_COMPLEX) zeta = fminq(zeta, 1);
    at.natural = w;
    at.d = zeta * w;
    at.k = w * w;
    at.turn = zeta < 1 ? w * sqrtq(1 - zeta * zeta) : 0;
    at.p = -at.d + j * at.turn;
    number apart = zeta < 1 ? j * at.turn : (number)(w * sqrtq(zeta * zeta - 1));
    number middle = -at.d;
    if (desc->mode == WIGGLY_COMPLEX) {
        middle = at.p;
        apart = j * w * fminq(not_negative(desc->bandwidth, sample), 1);
    }
    at.s[0] = middle + apart;
    at.s[1] = middle - apart;
    return at;
}

void textbook_fill_poles(const wiggly_desc *desc, real floor, bool loop, struct textbook_poles *at)
{
    bool varies = desc->frequency.track || desc->damping.track || desc->bandwidth.track;
    for (int i = 0; i < desc->samples; i++) {
        int j = loop ? i % (desc->samples - 1) : i;
        at[i] = i > 0 && !varies ? at[0] : textbook_poles_at(desc, j, floor);
    }
}

struct textbook_speed textbook_speed_of(const struct textbook_poles *at, real h)
{
    number l0 = cexpq(at->s[0] * h), l1 = cexpq(at->s[1] * h);
    bool is_double = at->s[0] == at->s[1];
    struct textbook_speed speed = {.Q = is_double ? 1 / (h * l0) : (at->s[0] - at->s[1]) / (l0 - l1)};
    speed.P = at->s[0] - speed.Q * l0;
    return speed;
}
