/// The inspector's section on the meadow: how many reeds, where, how tall, and how they bend.
#include "editor/core/core.h"
#include "editor/inspector/parts.h"

static const struct number_row rows[] = {
    {"meadow.count", "reeds", NULL, "How many reeds there are", "Change meadow", WHOLE_AT(struct meadow_rig, count),
     1, MEADOW_MAX_REEDS, 1, MEADOW_MAX_REEDS, 1000, 1, 0},
    {"meadow.height", "height", "m", "Of a reed; each is up to 30 % taller or shorter", "Change meadow",
     NUMBER_AT(struct meadow_rig, height), 0.05, 2, 0.001, INSPECTOR_NO_LIMIT, 0.8, 0.01, 2},
    {"meadow.wide", "width", "m", "The meadow's extent along x", "Change meadow",
     NUMBER_AT(struct meadow_rig, area[0]), 0.5, 10, 0.001, INSPECTOR_NO_LIMIT, 6, 0.1, 1},
    {"meadow.deep", "depth", "m", "The meadow's extent along z", "Change meadow",
     NUMBER_AT(struct meadow_rig, area[1]), 0.5, 10, 0.001, INSPECTOR_NO_LIMIT, 4, 0.1, 1},
    {"meadow.variation", "variation", NULL, "How far each reed goes its own way; 0: all move alike", "Change meadow",
     NUMBER_AT(struct meadow_rig, variation), 0, 2, 0, 100, 0.5, 0.05, 2},
    {"meadow.lag", "lag", "°", "How much later each joint of a reed swings", "Change meadow",
     NUMBER_AT(struct meadow_rig, lag), -45, 45, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, 12, 0.5, 1},
    {"meadow.gain", "gain", "°", "How far each of a reed's six joints bends", "Change meadow",
     NUMBER_AT(struct meadow_rig, gain), -20, 20, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, 6, 0.5, 1},
    {"meadow.seed", "seed", NULL, "Another number plants and moves them otherwise", "Change meadow",
     WHOLE_AT(struct meadow_rig, seed), 0, 999, 0, 999999, 0, 1, 0},
};

static const void *shown(const struct inspector *in)
{
    return &in->core->document->rigs[document_find_rig(in->core->document, RIG_MEADOW, 0)]->meadow;
}

static bool set(struct inspector *in, int which, double number, struct error *error)
{
    const int rig = document_find_rig(in->core->document, RIG_MEADOW, 0);
    struct rig changed = *in->core->document->rigs[rig];
    number_put(&rows[which], &changed.meadow, number);
    return edit_rig_set(in->core->document, rig, &changed, error);
}

void inspector_meadow(struct inspector *in)
{
    static const struct number_home home = {.of = shown, .set = set};
    inspector_numbers(in, rows, sizeof rows / sizeof rows[0], &home);
}
