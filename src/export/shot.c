/// Poses rigs at the times that are exported.
#include "export/shot.h"
#include <math.h>

double shot_frame(const struct shot *shot, double key) { return shot->first + key * shot->spacing; }

double shot_seconds(const struct shot *shot, double key) { return key * shot->spacing / shot->posing->document->fps; }

/// In samples. A key that is meant to fall on a sample must not miss it by rounding: the last of a loop is the first.
static double position_of(const struct shot *shot, double key)
{
    const struct document *document = shot->posing->document;
    const double position = (shot_frame(shot, key) - document->first_frame) * document->substeps;
    return fabs(position - round(position)) < 1e-6 ? round(position) : position;
}

bool shot_pose(const struct shot *shot, int rig, double key, struct rig_pose *pose, struct error *error)
{
    if (rig_pose(shot->posing, rig, position_of(shot, key), NULL, pose)) return true;
    return fail(error, ERROR_INPUT, "rigs[%d]: its model could not be read", rig);
}

wiggly_value shot_value(const struct shot *shot, int spline, double key)
{
    return evaluation_at(shot->posing->evaluation, spline, position_of(shot, key));
}

bool shot_is_inside(const struct shot *shot, double key)
{
    const double position = position_of(shot, key);
    return position >= 0 && position <= document_samples(shot->posing->document) - 1;
}

bool shot_proceed(struct shot *shot, struct error *error)
{
    shot->done++;
    if (!shot->proceed || shot->proceed(shot->user, shot->done, shot->total)) return true;
    return fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
}
