/// Meadows as a kind of rig: loading, printing and references.
#include "scene/rig_kind.h"
#include <math.h>

static const char *const meadow_keys[] = {"type",   "name",      "spline", "count", "seed", "area",
                                          "height", "variation", "lag",    "gain",  NULL};

static void load(struct reader *reader, const struct value *object, struct rig *rig)
{
    struct meadow_rig *meadow = &rig->meadow;
    const struct range positive = {0, INFINITY, true}, from_0 = {0, 100, false};
    const struct value area = reader_member(object, "area");
    *meadow =
        (struct meadow_rig){.count = 1000, .area = {6, 4}, .height = 0.8, .variation = 0.5, .lag = 12, .gain = 6};
    rig->name = reader_name(reader, reader_member(object, "name"));
    meadow->spline = reader_spline_name(reader, reader_member(object, "spline"));
    reader_integer(reader, reader_member(object, "count"), 1, MEADOW_MAX_REEDS, &meadow->count);
    reader_integer(reader, reader_member(object, "seed"), 0, 999999, &meadow->seed);
    if (area.json && reader_array(reader, area, 2, "[x, z]")) {
        for (int k = 0; k < 2; k++) reader_number(reader, reader_element(&area, k), true, positive, &meadow->area[k]);
    }
    reader_number(reader, reader_member(object, "height"), false, positive, &meadow->height);
    reader_number(reader, reader_member(object, "variation"), false, from_0, &meadow->variation);
    reader_number(reader, reader_member(object, "lag"), false, range_any, &meadow->lag);
    reader_number(reader, reader_member(object, "gain"), false, range_any, &meadow->gain);
    rig->extra = reader_keep(reader, reader_extra(reader, object, meadow_keys));
}

static void print(struct members *members, const struct document *document, const struct rig *rig, const char *folder)
{
    const struct meadow_rig *meadow = &rig->meadow;
    (void)folder;
    member_string(members, "spline", document->splines[meadow->spline]->name);
    member_number(members, "count", meadow->count);
    member_number(members, "seed", meadow->seed);
    member(members, "area");
    text_numbers(members->text, meadow->area, 2);
    member_number(members, "height", meadow->height);
    member_number(members, "variation", meadow->variation);
    member_number(members, "lag", meadow->lag);
    member_number(members, "gain", meadow->gain);
}

static int input_count(const struct rig *rig)
{
    (void)rig;
    return 1;
}

static int input(const struct rig *rig, int index)
{
    (void)index;
    return rig->meadow.spline;
}

static void references(const struct rig *rig, int index, reference_visitor *visit, void *context)
{
    visit(&(struct reference){REFERENCE_MEADOW, index, 0, rig->meadow.spline}, context);
}

static void set_reference(struct rig *rig, const struct reference *reference, int spline)
{
    (void)reference;
    rig->meadow.spline = spline;
}

const struct rig_functions meadow_functions = {.word = "meadow",
                                               .load = load,
                                               .print = print,
                                               .input_count = input_count,
                                               .input = input,
                                               .references = references,
                                               .set_reference = set_reference};
