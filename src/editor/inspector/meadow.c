/// The inspector's section on the meadow: how many reeds, where, how tall, and how they bend.
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"

static void now(const struct inspection *in, int which, struct setting *setting)
{
    const int rig = document_find_rig(in->document, RIG_MEADOW, 0);
    (void)which;
    setting->contents = *in->document->rigs[rig];
    setting->edit = core_edit_of(EDIT_MEADOW, in->core->active);
    setting->edit.rig = rig;
    setting->edit.contents = &setting->contents;
}

static const struct number_row rows[] = {
    {"meadow.count", "reeds", NULL, "How many reeds there are", "Change meadow", WHOLE_AT(contents.meadow.count), 1,
     MEADOW_MAX_REEDS, 1, MEADOW_MAX_REEDS, 1000, 1, 0},
    {"meadow.height", "height", "m", "Of a reed; each is up to 30 % taller or shorter", "Change meadow",
     NUMBER_AT(contents.meadow.height), 0.05, 2, 0.001, INSPECTOR_NO_LIMIT, 0.8, 0.01, 2},
    {"meadow.wide", "width", "m", "The meadow's extent along x", "Change meadow", NUMBER_AT(contents.meadow.area[0]),
     0.5, 10, 0.001, INSPECTOR_NO_LIMIT, 6, 0.1, 1},
    {"meadow.deep", "depth", "m", "The meadow's extent along z", "Change meadow", NUMBER_AT(contents.meadow.area[1]),
     0.5, 10, 0.001, INSPECTOR_NO_LIMIT, 4, 0.1, 1},
    {"meadow.variation", "variation", NULL, "How far each reed goes its own way; 0: all move alike", "Change meadow",
     NUMBER_AT(contents.meadow.variation), 0, 2, 0, 100, 0.5, 0.05, 2},
    {"meadow.lag", "lag", "°", "How much later each joint of a reed swings", "Change meadow",
     NUMBER_AT(contents.meadow.lag), -45, 45, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, 12, 0.5, 1},
    {"meadow.gain", "gain", "°", "How far each of a reed's six joints bends", "Change meadow",
     NUMBER_AT(contents.meadow.gain), -20, 20, -INSPECTOR_NO_LIMIT, INSPECTOR_NO_LIMIT, 6, 0.5, 1},
    {"meadow.seed", "seed", NULL, "Another number plants and moves them otherwise", "Change meadow",
     WHOLE_AT(contents.meadow.seed), 0, 999, 0, 999999, 0, 1, 0},
};

void inspector_meadow(struct inspection *in) { inspector_numbers(in, rows, sizeof rows / sizeof rows[0], now); }
