/// The inspector's section on the meadow: how many reeds, where, how tall, and how they bend.
#include "editor/core/core.h"
#include "editor/inspector/inspection.h"
#include <math.h>

enum { NUMBERS = 8 };

static const struct ui_number rows[NUMBERS] = {
    {.name = "meadow.count",
     .label = "reeds",
     .hint = "How many reeds there are",
     .minimum = 1,
     .maximum = MEADOW_MAX_REEDS,
     .lowest = 1,
     .highest = MEADOW_MAX_REEDS,
     .fallback = 1000,
     .step = 1},
    {.name = "meadow.height",
     .label = "height",
     .unit = "m",
     .hint = "Of a reed; each is up to 30 % taller or shorter",
     .minimum = 0.05,
     .maximum = 2,
     .lowest = 0.001,
     .highest = INSPECTOR_NO_LIMIT,
     .fallback = 0.8,
     .step = 0.01,
     .decimals = 2},
    {.name = "meadow.wide",
     .label = "width",
     .unit = "m",
     .hint = "The meadow's extent along x",
     .minimum = 0.5,
     .maximum = 10,
     .lowest = 0.001,
     .highest = INSPECTOR_NO_LIMIT,
     .fallback = 6,
     .step = 0.1,
     .decimals = 1},
    {.name = "meadow.deep",
     .label = "depth",
     .unit = "m",
     .hint = "The meadow's extent along z",
     .minimum = 0.5,
     .maximum = 10,
     .lowest = 0.001,
     .highest = INSPECTOR_NO_LIMIT,
     .fallback = 4,
     .step = 0.1,
     .decimals = 1},
    {.name = "meadow.variation",
     .label = "variation",
     .hint = "How far each reed goes its own way; 0: all move alike",
     .minimum = 0,
     .maximum = 2,
     .lowest = 0,
     .highest = 100,
     .fallback = 0.5,
     .step = 0.05,
     .decimals = 2},
    {.name = "meadow.lag",
     .label = "lag",
     .unit = "°",
     .hint = "How much later each joint of a reed swings",
     .minimum = -45,
     .maximum = 45,
     .lowest = -INSPECTOR_NO_LIMIT,
     .highest = INSPECTOR_NO_LIMIT,
     .fallback = 12,
     .step = 0.5,
     .decimals = 1},
    {.name = "meadow.gain",
     .label = "gain",
     .unit = "°",
     .hint = "How far each of a reed's six joints bends",
     .minimum = -20,
     .maximum = 20,
     .lowest = -INSPECTOR_NO_LIMIT,
     .highest = INSPECTOR_NO_LIMIT,
     .fallback = 6,
     .step = 0.5,
     .decimals = 1},
    {.name = "meadow.seed",
     .label = "seed",
     .hint = "Another number plants and moves them otherwise",
     .minimum = 0,
     .maximum = 999,
     .lowest = 0,
     .highest = 999999,
     .fallback = 0,
     .step = 1},
};

void inspector_meadow(struct inspection *in)
{
    const int rig = document_find_rig(in->document, RIG_MEADOW, 0);
    struct rig contents = in->document->rigs[rig];
    struct meadow_rig *of = &contents.meadow;
    double count = of->count, seed = of->seed;
    double *const numbers[NUMBERS] = {&count,         &of->height, &of->area[0], &of->area[1],
                                      &of->variation, &of->lag,    &of->gain,    &seed};
    struct edit edit = core_edit_of(EDIT_MEADOW, in->core->active);
    edit.rig = rig;
    edit.contents = &contents;
    for (int n = 0; n < NUMBERS; n++) {
        const enum ui_change change = ui_value(in->ui, ui_row(in->ui, UI_ROW), &rows[n], numbers[n]);
        of->count = (int)round(count), of->seed = (int)round(seed);
        inspector_change(in, change, "Change meadow", rows[n].name, &edit);
    }
}
