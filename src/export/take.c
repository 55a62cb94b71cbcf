/// Poses rigs at the times that are exported.
#include "export/take.h"
#include <math.h>

double take_frame(const struct take *take, double key) { return take->first + key * take->spacing; }

double take_seconds(const struct take *take, double key) { return key * take->spacing / take->posing->document->fps; }

/// In samples. A key that is meant to fall on a sample must not miss it by rounding: the last of a loop is the first.
static double position_of(const struct take *take, double key)
{
    const struct document *document = take->posing->document;
    const double position = (take_frame(take, key) - document->first_frame) * document->substeps;
    return fabs(position - round(position)) < 1e-6 ? round(position) : position;
}

bool take_pose(const struct take *take, int rig, double key, struct rig_pose *pose, struct error *error)
{
    if (rig_pose(take->posing, rig, position_of(take, key), NULL, pose)) return true;
    return fail(error, ERROR_INPUT, "rigs[%d]: its model could not be read", rig);
}

wiggly_value take_value(const struct take *take, int spline, double key)
{
    return evaluation_at(take->posing->evaluation, spline, position_of(take, key));
}

bool take_is_inside(const struct take *take, double key)
{
    const double position = position_of(take, key);
    return position >= 0 && position <= document_samples(take->posing->document) - 1;
}

bool take_proceed(struct take *take, struct error *error)
{
    take->done++;
    if (!take->proceed || take->proceed(take->user, take->done, take->total)) return true;
    return fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
}
