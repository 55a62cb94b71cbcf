/// A small document, and edits of it.
#include "world.h"

static const char scene_text[] =
    "{\"frames\": [0, 48], \"splines\": ["
    "{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0, \"tag\": 1}, "
    "{\"frame\": 12, \"value\": 1, \"slope\": 0}, {\"frame\": 30, \"value\": -1}]},"
    "{\"name\": \"pluck\", \"mode\": \"real\", \"spring\": 40, \"friction\": 1, \"start\": \"rest\"},"
    "{\"name\": \"loop\", \"start\": \"loop\", \"equilibrium\": {\"spline\": \"sway\"}, \"knots\": [{\"frame\": 3, "
    "\"value\": 2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 3, \"channels\": [{\"spline\": \"sway\"}, "
    "{\"spline\": \"loop\", \"axis\": \"up\", \"gain\": [1, 2, 3]}]}]}";

void world_open(struct world *world) { world_open_scene(world, scene_text); }

void world_open_scene(struct world *world, const char *scene)
{
    *world = (struct world){0};
    world->document = document_of_text(scene);
    world->history = history_create(world->document);
    assert_non_null(world->history);
}

void world_close(struct world *world)
{
    while (world->printed_count > 0) free(world->printed[--world->printed_count]);
    free(world->printed);
    history_destroy(world->history);
    document_destroy(world->document);
}

const char *world_print(struct world *world)
{
    const size_t count = (size_t)++world->printed_count;
    world->printed = realloc(world->printed, count * sizeof *world->printed);
    assert_non_null(world->printed);
    return world->printed[count - 1] = text_of_document(world->document);
}

void assert_document(const struct world *world, const char *expected) { assert_prints(world->document, expected); }

struct document *world_edit(struct world *world)
{
    if (history_is_open(world->history)) return world->document;
    world->before = document_copy(world->document);
    world->label = history_undo_label(world->history);
    history_begin(world->history, "Step", 0);
    return world->document;
}

/// Closes the step; the text of what was there before it, if that is wanted.
static char *end_step(struct world *world, bool wanted)
{
    char *text = wanted ? text_of_document(world->before) : NULL;
    history_end(world->history);
    document_destroy(world->before);
    world->before = NULL;
    return text;
}

bool world_step(struct world *world, bool done)
{
    end_step(world, false);
    return done;
}

void world_must(struct world *world, bool done)
{
    if (!world_step(world, done)) fail_msg("%s", world->error.text);
}

void assert_refused(struct world *world, bool done, const char *sentence)
{
    char *before = end_step(world, true);
    assert_false(done);
    assert_int_equal(world->error.kind, ERROR_INPUT);
    assert_string_equal(world->error.text, sentence);
    assert_document(world, before);
    assert_ptr_equal(history_undo_label(world->history), world->label);
    free(before);
}

void assert_reversible(struct world *world, bool done)
{
    char *before = end_step(world, true);
    if (!done) fail_msg("%s", world->error.text);
    char *after = text_of_document(world->document);
    assert_string_not_equal(before, after);
    assert_true(history_undo(world->history));
    assert_document(world, before);
    assert_true(history_redo(world->history));
    assert_document(world, after);
    free(before);
    free(after);
}

bool edit_insert(struct world *world, int spline, double frame, double value)
{
    const struct knot knot = {.frame = frame, .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS};
    return edit_knot_insert(world_edit(world), spline, &knot, &world->error);
}

bool edit_move(struct world *world, int spline, int knot, double frame, double value)
{
    struct knot moved = world->document->splines[spline]->knots[knot];
    moved.frame = frame;
    moved.value = value;
    return edit_knot_set(world_edit(world), spline, &moved, &world->error);
}

static bool set(struct world *world, int spline, enum parameter parameter, struct param param)
{
    return edit_parameter(world_edit(world), spline, parameter, &param, &world->error);
}

bool edit_number(struct world *world, int spline, enum parameter parameter, double value)
{
    return set(world, spline, parameter, param_number(value));
}

bool edit_track(struct world *world, int spline, enum parameter parameter, int track)
{
    return set(world, spline, parameter, param_track(track));
}

bool edit_mode(struct world *world, int spline, enum wiggly_mode mode)
{
    return edit_number(world, spline, PARAMETER_MODE, mode);
}

bool edit_start(struct world *world, int spline, enum wiggly_start start)
{
    return edit_number(world, spline, PARAMETER_START, start);
}

bool edit_frames(struct world *world, int first, int last)
{
    return edit_range(world_edit(world), first, last, RANGE_REFUSE, &world->error);
}

bool edit_bend(struct world *world, int rig, int channel, int spline, int axis, int of)
{
    struct document *document = world_edit(world);
    struct channel changed = {.spline = 0};
    int count;
    const struct channel *channels = rig_channels(document->rigs[rig], &count);
    if (channel < count) changed = channels[channel];
    if (spline >= 0) changed.spline = spline;
    if (axis >= 0) changed.axis = (enum axis)axis;
    if (of >= 0) changed.of = (enum channel_part)of;
    return edit_channel(document, (struct channel_place){rig, channel}, &changed, &world->error);
}

int world_undo_all(struct world *world)
{
    int count = 0;
    while (history_undo(world->history)) count++;
    return count;
}
