/// Checks a loaded document as a whole: cycles, limits, aliasing, pins.
#include "scene/order.h"
#include "scene/pins.h"
#include "scene/reader.h"
#include <math.h>

static void check_cycles(struct reader *reader, const struct where *splines_at)
{
    struct order_cycle cycle;
    const struct document *document = reader->document;
    if (scene_has_order(document, &cycle)) return;
    const struct spline *spline = document->splines[cycle.spline];
    struct where spline_at = {.parent = splines_at, .index = (size_t)cycle.spline};
    struct where at = {.parent = &spline_at, .key = parameter_rows[cycle.parameter].name};
    int leader = spline->parameter[cycle.parameter].track;
    reader_fail(reader, &at, "expected tracks without a cycle, got \"%s\", which follows \"%s\" itself",
                document->splines[leader]->name, spline->name);
}

/// The highest frequency in Hz at which a spline with constant parameters can ring; 0 for tracks.
static double highest_frequency(const struct spline *spline)
{
    const struct param *frequency = &spline->parameter[PARAMETER_FREQUENCY];
    const struct param *bandwidth = &spline->parameter[PARAMETER_BANDWIDTH];
    if (spline_mode(spline) == WIGGLY_CUBIC || frequency->track >= 0) return 0;
    double widening = spline_mode(spline) == WIGGLY_COMPLEX && bandwidth->track < 0 ? bandwidth->value : 0;
    return frequency->value * (1 + widening);
}

static void check_aliasing(struct reader *reader, const struct where *splines_at)
{
    const struct document *document = reader->document;
    double limit = 0.5 / document_step(document);
    for (int i = 0; i < document->spline_count; i++) {
        double highest = highest_frequency(document->splines[i]);
        if (highest <= limit) continue;
        struct where spline_at = {.parent = splines_at, .index = (size_t)i};
        struct where at = {.parent = &spline_at, .key = "frequency"};
        reader_warn(reader, &at, "%.4g Hz is above half the sample rate, %.4g Hz: it aliases", highest, limit);
    }
}

/// Where a pin is in its file, in which ids rise: the index of a rig's pin in order of frames is another.
static size_t index_in_file(const struct rig *rig, int pin)
{
    size_t index = 0;
    for (int i = 0; i < rig->pin_count; i++) index += rig->pins[i].id < rig->pins[pin].id;
    return index;
}

static void check_pins(struct reader *reader, const struct where *scene_at)
{
    struct pin_trouble trouble;
    const struct document *document = reader->document;
    if (pins_check(document, &trouble) && pins_check_order(document, &trouble)) return;
    const struct rig *rig = document->rigs[trouble.rig];
    const struct where rigs_at = {.parent = scene_at, .key = "rigs"};
    const struct where rig_at = {.parent = &rigs_at, .index = (size_t)trouble.rig};
    const struct where pins_at = {.parent = &rig_at, .key = trouble.pin >= 0 ? "pins" : trouble.member};
    const struct where at = {.parent = &pins_at, .index = trouble.pin >= 0 ? index_in_file(rig, trouble.pin) : 0};
    const struct where member_at = {.parent = &at, .key = trouble.member};
    reader_fail(reader, trouble.pin >= 0 ? &member_at : &pins_at, "%s", trouble.error.text);
}

void validate_scene(struct reader *reader, const struct where *scene_at)
{
    struct where splines_at = {.parent = scene_at, .key = "splines"};
    check_cycles(reader, &splines_at);
    check_aliasing(reader, &splines_at);
    if (reader->has_domain && !reader->failed) check_pins(reader, scene_at);
}
