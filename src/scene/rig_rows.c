/// Kinds of rig that are all rows: imported characters, chains on them, and meadows.
#include "scene/rig_kind.h"
#include <math.h>

static const struct field model_fields[] = {
    {FIELD("model", FIELD_PATH, model.model)},
    {FIELD("clip", FIELD_TEXT, model.clip), .is_optional = true},
    {FIELD("position", FIELD_NUMBERS, model.position), .range = FIELD_ANY},
    {FIELD("scale", FIELD_NUMBER, model.scale), .range = FIELD_POSITIVE},
    {FIELD("turn", FIELD_NUMBER, model.turn), .range = FIELD_ANY},
    {.key = NULL},
};

static void reset_model(struct rig *rig) { rig->model.scale = 1; }

const struct rig_functions model_functions = {
    .word = "model", .fields = model_fields, .title = offsetof(struct rig, model.model), .reset = reset_model};

static const char *const axes[] = {"side", "up", "twist", NULL};

static void print_model(struct members *members, const struct document *document, const struct rig *rig,
                        const char *folder)
{
    if (rig->chain.by_file) {
        member_path(members, "model", document, rig->chain.model, folder);
    } else {
        member_string(members, "model", rig->chain.model);
    }
}

static void load_all_channels(struct reader *reader, const struct value *object, struct rig *rig)
{
    load_channels(reader, object, axes, JOINTS_UNKNOWN, rig);
}

static const struct field chain_fields[] = {
    {FIELD("model", FIELD_TEXT, chain.model), .print = print_model},
    {FIELD("from", FIELD_TEXT, chain.from)},
    {FIELD("to", FIELD_TEXT, chain.to)},
    {FIELD("turn", FIELD_NUMBER, chain.turn), .range = FIELD_ANY},
    {FIELD("mirror", FIELD_FLAG, chain.mirror)},
    {"channels", .load = load_all_channels, .print = print_channels},
    {.key = NULL},
};

static void resolve(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct chain *chain = &rig->chain;
    const struct where at = {.parent = &object->at, .key = "model"};
    if (!chain->model) return;
    chain->by_file = document_find_model(reader->document, chain->model, false) < 0;
    if (!chain->by_file || document_find_model(reader->document, chain->model, true) >= 0) return;
    reader_fail(reader, &at, "expected the name or file of a model rig, got \"%s\"", chain->model);
}

const struct rig_functions chain_functions = {.word = "chain",
                                              .fields = chain_fields,
                                              .title = offsetof(struct rig, chain.from),
                                              .pin_key = "joint",
                                              .is_bent = true,
                                              .resolve = resolve};

static const struct field meadow_fields[] = {
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

static void reset_meadow(struct rig *rig)
{
    rig->meadow =
        (struct meadow_rig){.count = 1000, .area = {6, 4}, .height = 0.8, .variation = 0.5, .lag = 12, .gain = 6};
}

const struct rig_functions meadow_functions = {
    .word = "meadow", .fields = meadow_fields, .is_named = true, .reset = reset_meadow};
