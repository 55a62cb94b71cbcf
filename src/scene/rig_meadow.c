/// Meadows as a kind of rig.
#include "scene/rig_kind.h"
#include <math.h>

static const struct field fields[] = {
    {FIELD("spline", FIELD_SPLINE, meadow.spline)},
    {FIELD("count", FIELD_WHOLE, meadow.count), .range = {1, MEADOW_MAX_REEDS, false}},
    {FIELD("seed", FIELD_WHOLE, meadow.seed), .range = {0, 999999, false}},
    {FIELD("area", FIELD_NUMBERS, meadow.area), .range = FIELD_POSITIVE},
    {FIELD("height", FIELD_NUMBER, meadow.height), .range = FIELD_POSITIVE},
    {FIELD("variation", FIELD_NUMBER, meadow.variation), .range = {0, 100, false}},
    {FIELD("lag", FIELD_NUMBER, meadow.lag), .range = FIELD_ANY},
    {FIELD("gain", FIELD_NUMBER, meadow.gain), .range = FIELD_ANY},
    {.key = NULL},
};

static void reset(struct rig *rig)
{
    rig->meadow =
        (struct meadow_rig){.count = 1000, .area = {6, 4}, .height = 0.8, .variation = 0.5, .lag = 12, .gain = 6};
}

const struct rig_functions meadow_functions = {.word = "meadow", .fields = fields, .is_named = true, .reset = reset};
