/// What the document makes of a body that was dragged and let go: knots at the playhead, or another place for the whole shot.
#include "editor/core/core.h"
#include "editor/stage/base.h"
#include "editor/stage/hold.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double RESOLUTION = 1e-3; ///< metres that the document gets

/// What is said afterwards, and what held a knot.
struct report {
    char text[512], why[STOPPED_SIZE];
    size_t length;
};

static void say(struct report *report, const char *text)
{
    report->length +=
        (size_t)snprintf(report->text + report->length, sizeof report->text - report->length, "%s", text);
    if (report->length >= sizeof report->text) report->length = sizeof report->text - 1;
}

/// A name, after a comma where it is not the first.
static void say_name(struct report *report, bool is_first, const char *name)
{
    if (!is_first) say(report, ", ");
    say(report, name);
}

/// The sample of the playhead, or the last one where a spline has knots.
static int sample_of(const struct core *core, const struct document *document, int spline)
{
    const int sample = document_sample(document, round(core_frame(core, document)));
    const int last = document_last_knot_sample(document, &document->splines[spline]);
    return sample > last ? last : sample < 0 ? 0 : sample;
}

/// A knot at the playhead. A coordinate that was a number gets a spline, which begins where the body was. The spline by which the
/// tail swings with that from now on where it did not, else -1.
static int key_coordinate(const struct stage *stage, struct core *core, const struct editor_world *world,
                          int coordinate, double by, char why[STOPPED_SIZE])
{
    const struct document *document = world->document;
    const int tail = stage->hold.tail;
    const bool is_new = document_tail(document, tail)->position[coordinate].track < 0;
    const int spline = base_spline(stage, core, world, coordinate);
    if (spline < 0) return -1;
    const int sample = sample_of(core, document, spline);
    const double before = base_value(world, tail, coordinate, sample);
    if (!is_new) {
        struct edit edit = core_knot_edit(document, spline, sample);
        edit.knot.value = core_round(before + by, RESOLUTION);
        core_hold(&document->splines[spline], &edit.knot, why);
        core_edit(core, world, &edit);
        core_edited(core, spline);
        return -1;
    }
    if (sample > 1) base_put_knot(core, world, spline, 0, before, true, why);
    base_put_knot(core, world, spline, sample, before + by, true, why);
    base_follow(stage, core, world, coordinate, spline);
    const int swings = base_hang_channels(stage, core, world, coordinate, spline);
    core_edited(core, spline);
    return swings;
}

static void key_body(struct stage *stage, struct core *core, const struct editor_world *world, const double offset[3])
{
    struct report report = {.length = 0};
    char frame[64];
    bool is_first = true;
    int swings = -1;
    base_begin(stage, world);
    say(&report, "Keyed ");
    for (int k = 0; k < 3; k++) {
        if (offset[k] == 0) continue;
        const int made = key_coordinate(stage, core, world, k, offset[k], report.why);
        if (made >= 0) swings = made;
        const int track = document_tail(world->document, stage->hold.tail)->position[k].track;
        if (track < 0) continue;
        say_name(&report, is_first, world->document->splines[track].name);
        is_first = false;
    }
    snprintf(frame, sizeof frame, " at frame %.0f.", round(core_frame(core, world->document)));
    say(&report, frame);
    core_add_stopped(report.why, report.text, sizeof report.text);
    base_say_channel(world, swings, report.text, sizeof report.text);
    if (!is_first) core_message(core, false, report.text);
}

/// How far of a way all knots of a spline can go within its limits, and the knot that stops them, or NULL.
static double room_for(const struct spline *spline, double by, const struct knot **stops)
{
    double room = by;
    *stops = NULL;
    for (int i = 0; i < spline->knot_count; i++) {
        const double value = spline->knots[i].value, within = spline_within(spline, value + by);
        if (within == value + by || fabs(within - value) >= fabs(room)) continue;
        room = within - value;
        *stops = &spline->knots[i];
    }
    return room;
}

void place_within(const struct stage *stage, const struct core *core, const struct editor_world *world,
                  double offset[3])
{
    const struct document *document = world->document;
    const struct tail *tail = document_tail(document, stage->hold.tail);
    const bool keys = core->auto_key || stage->record.running || record_has_motion(stage);
    for (int k = 0; tail && k < 3; k++) {
        const int track = tail->position[k].track;
        if (offset[k] == 0 || track < 0) continue;
        const struct spline *spline = &document->splines[track];
        if (keys) {
            const double before = base_value(world, stage->hold.tail, k, sample_of(core, document, track));
            offset[k] = spline_within(spline, before + offset[k]) - before;
        } else {
            const struct knot *stops;
            offset[k] = room_for(spline, offset[k], &stops);
        }
    }
}

/// All knots of a spline, so that what follows it moves as it did, elsewhere: all by as much as each can go. How far that was.
static double shift_spline(struct core *core, const struct editor_world *world, int spline, double way,
                           char why[STOPPED_SIZE])
{
    const int count = world->document->splines[spline].knot_count;
    const struct knot *stops;
    const double by = room_for(&world->document->splines[spline], way, &stops);
    if (stops) {
        struct knot moved = *stops;
        moved.value += way;
        core_hold(&world->document->splines[spline], &moved, why);
    }
    if (by == 0) return 0;
    for (int i = 0; i < count; i++) {
        struct edit edit = core_edit_of(EDIT_KNOT_SET, spline);
        edit.knot = world->document->splines[spline].knots[i];
        edit.knot.value =
            spline_within(&world->document->splines[spline], core_round(edit.knot.value + by, RESOLUTION));
        core_edit(core, world, &edit);
    }
    core_edited(core, spline);
    return by;
}

/// A height that is a number says where the ground is, which stays. How far the coordinate went.
static double shift_coordinate(struct core *core, const struct editor_world *world, int tail, int coordinate,
                               double by, char why[STOPPED_SIZE])
{
    const struct param *param = &document_tail(world->document, tail)->position[coordinate];
    if (param->track >= 0) return shift_spline(core, world, param->track, by, why);
    if (coordinate == 1) return 0;
    struct edit edit = core_edit_of(EDIT_POSITION, 0);
    edit.rig = document_find_rig(world->document, RIG_TAIL, tail);
    edit.coordinate = coordinate;
    edit.param.value = core_round(param->value + by, RESOLUTION);
    core_edit(core, world, &edit);
    return by;
}

static void shift_body(struct stage *stage, struct core *core, const struct editor_world *world,
                       const double offset[3])
{
    struct report report = {.length = 0};
    bool is_first = true;
    say(&report, "Moved for the whole shot: ");
    for (int k = 0; k < 3; k++) {
        char part[32];
        if (offset[k] == 0) continue;
        const double by = shift_coordinate(core, world, stage->hold.tail, k, offset[k], report.why);
        if (by == 0) continue;
        snprintf(part, sizeof part, "%s %+.2f m", coordinate_name(k), by);
        say_name(&report, is_first, part);
        is_first = false;
    }
    if (is_first && report.why[0]) {
        core_stopped(core, report.why);
    } else if (is_first) {
        core_message(core, false, "It sits on the ground again: auto-key (Shift+A) or R keeps a height.");
    } else {
        say(&report, report.why[0] ? "." : ". Auto-key (Shift+A) sets knots instead.");
        core_add_stopped(report.why, report.text, sizeof report.text);
        core_message(core, false, report.text);
    }
}

void place_body(struct stage *stage, struct core *core, const struct editor_world *world, const double offset[3])
{
    if (core->auto_key) {
        key_body(stage, core, world, offset);
    } else {
        shift_body(stage, core, world, offset);
    }
    sway_land(stage, stage->hold.tail);
}
