/// Finds pinned points by the kind of their rig.
#include "rig/posing_kind.h"
#include <math.h>
#include <string.h>

void pinning_add_channel(const struct channel *channel, int n, int joints, const double way[3], pin_pull c)
{
    const double to_radians = 3.14159265358979323846 / 180.0;
    const double lag = to_radians * angles_lag(&channel->lag, n, joints);
    const double gain = to_radians * angles_at(&channel->gain, n, joints);
    for (int k = 0; k < 3; k++) {
        c[k][0] += way[k] * gain * cos(lag);
        c[k][1] -= way[k] * gain * sin(lag);
    }
}

double pinning_square(const pin_pull c)
{
    double sum = 0;
    for (int k = 0; k < 3; k++) sum += c[k][0] * c[k][0] + c[k][1] * c[k][1];
    return sum;
}

static bool find(void *context, const struct evaluation *evaluation, const struct document *document, int rig,
                 const struct pin *pin, const int *splines, int count, pin_pull *c, struct pin_point *point)
{
    const struct posing posing = {.document = document, .evaluation = evaluation, .models = context};
    if (count > 0) memset(c, 0, (size_t)count * sizeof *c);
    const struct pinning_functions *pins = posing_kinds[document->rigs[rig]->kind]->pins;
    return pins->find(&posing, rig, document_sample(document, pin->frame), pin->point, splines, count, c, point);
}

static void weigh(void *context, const struct document *document, int rig, const int *splines, int count,
                  double *weights)
{
    const struct posing posing = {.document = document, .models = context, .at_rest = true};
    const struct pinning_functions *pins = posing_kinds[document->rigs[rig]->kind]->pins;
    if (pins) pins->weigh(&posing, rig, splines, count, weights);
}

static bool lowest(void *context, const struct evaluation *evaluation, const struct document *document, int rig,
                   double ceiling, double *room, struct low_point *low)
{
    const struct posing posing = {.document = document, .evaluation = evaluation, .models = context};
    return character_lowest(&posing, rig, ceiling, room, low);
}

struct model_source models_source(struct models *models)
{
    return (struct model_source){.find = find,
                                 .weigh = weigh,
                                 .lowest = lowest,
                                 .follow = models ? clip_follow : NULL,
                                 .context = models,
                                 .version = models_version(models)};
}
