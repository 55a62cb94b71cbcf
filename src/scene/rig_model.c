/// Imported characters as a kind of rig.
#include "scene/rig_kind.h"
#include <math.h>

static const struct field fields[] = {
    {FIELD("model", FIELD_PATH, model.model)},
    {FIELD("clip", FIELD_TEXT, model.clip), .is_optional = true},
    {FIELD("position", FIELD_NUMBERS, model.position), .range = FIELD_ANY},
    {FIELD("scale", FIELD_NUMBER, model.scale), .range = FIELD_POSITIVE},
    {FIELD("turn", FIELD_NUMBER, model.turn), .range = FIELD_ANY},
    {.key = NULL},
};

static void reset(struct rig *rig) { rig->model.scale = 1; }

const struct rig_functions model_functions = {
    .word = "model", .fields = fields, .title = offsetof(struct rig, model.model), .reset = reset};
