/// Looks up angles along the joints of a tail or chain.
#include "scene/angles.h"

static double ramp_at(const struct angles *angles, double place)
{
    const struct ramp_point *ramp = angles->ramp;
    int next = 0;
    while (next < angles->count && ramp[next].at < place) next++;
    if (next == 0) return ramp[0].angle;
    if (next == angles->count) return ramp[next - 1].angle;
    const struct ramp_point *before = &ramp[next - 1], *after = &ramp[next];
    return before->angle + (after->angle - before->angle) * ((place - before->at) / (after->at - before->at));
}

double angles_at(const struct angles *angles, int joint, int joints)
{
    switch (angles->form) {
    case ANGLES_EACH:
        return angles->value[joint < angles->count ? joint : angles->count - 1];
    case ANGLES_RAMP:
        return ramp_at(angles, joints > 1 ? (double)joint / (joints - 1) : 0);
    default:
        return angles->value[0];
    }
}

double angles_lag(const struct angles *lag, int joint, int joints)
{
    return lag->form == ANGLES_ONE ? joint * lag->value[0] : angles_at(lag, joint, joints);
}

int angles_count(const struct angles *angles) { return angles->form == ANGLES_ONE ? 1 : angles->count; }

double angles_number(const struct angles *angles, int index)
{
    return angles->form == ANGLES_RAMP ? angles->ramp[index].angle : angles->value[index];
}

void angles_set_number(struct angles *angles, int index, double degrees)
{
    if (angles->form == ANGLES_RAMP) {
        angles->ramp[index].angle = degrees;
    } else {
        angles->value[index] = degrees;
    }
}
