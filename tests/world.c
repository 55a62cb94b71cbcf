/// A small document, and makers of edits.
#include "world.h"
#include "near.h"
#include <stdlib.h>

static const char scene_text[] =
    "{\"frames\": [0, 48], \"splines\": ["
    "{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"knots\": [{\"frame\": 0, \"value\": 0, \"tag\": 1}, "
    "{\"frame\": 12, \"value\": 1, \"slope\": 0}, {\"frame\": 30, \"value\": -1}]},"
    "{\"name\": \"pluck\", \"mode\": \"real\", \"spring\": 40, \"friction\": 1, \"start\": \"rest\"},"
    "{\"name\": \"loop\", \"start\": \"loop\", \"equilibrium\": {\"spline\": \"sway\"}, \"knots\": [{\"frame\": 3, "
    "\"value\": 2}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 3, \"channels\": [{\"spline\": \"sway\"}, "
    "{\"spline\": \"loop\", \"axis\": \"up\", \"gain\": [1, 2, 3]}]}]}";

void world_open(struct world *world)
{
    *world = (struct world){0};
    world->document = scene_parse("scene.json", scene_text, sizeof scene_text - 1, NULL, &world->error);
    if (!world->document) fail_msg("%s", world->error.text);
    world->history = history_create(world->document);
    assert_non_null(world->history);
}

void world_close(struct world *world)
{
    history_destroy(world->history);
    document_destroy(world->document);
}

char *world_print(const struct world *world)
{
    size_t size;
    char *text = scene_print(world->document, &size);
    assert_non_null(text);
    return text;
}

void assert_document(const struct world *world, const char *expected)
{
    char *text = world_print(world);
    assert_string_equal(text, expected);
    free(text);
}

bool world_apply(struct world *world, struct edit edit)
{
    return history_apply(world->history, world->document, &edit, &world->error);
}

bool world_step(struct world *world, struct edit edit)
{
    history_begin(world->history, "Step", 0);
    bool applied = world_apply(world, edit);
    history_end(world->history);
    return applied;
}

void world_must(struct world *world, struct edit edit)
{
    if (!world_step(world, edit)) fail_msg("%s", world->error.text);
}

void assert_refused(struct world *world, struct edit edit, const char *sentence)
{
    char *before = world_print(world);
    const char *label = history_undo_label(world->history);
    assert_false(world_step(world, edit));
    assert_int_equal(world->error.kind, ERROR_INPUT);
    assert_string_equal(world->error.text, sentence);
    assert_document(world, before);
    assert_ptr_equal(history_undo_label(world->history), label);
    free(before);
}

void assert_reversible(struct world *world, struct edit edit)
{
    char *before = world_print(world);
    world_must(world, edit);
    char *after = world_print(world);
    assert_string_not_equal(before, after);
    assert_true(history_undo(world->history));
    assert_document(world, before);
    assert_true(history_redo(world->history));
    assert_document(world, after);
    free(before);
    free(after);
}

struct edit edit_insert(int spline, double frame, double value)
{
    return (struct edit){.kind = EDIT_KNOT_INSERT,
                         .spline = spline,
                         .knot = {.frame = frame, .value = value, .stiffness = KNOT_DEFAULT_STIFFNESS}};
}

struct edit edit_move(const struct world *world, int spline, int knot, double frame, double value)
{
    struct edit edit = {
        .kind = EDIT_KNOT_SET, .spline = spline, .knot = world->document->splines[spline]->knots[knot]};
    edit.knot.frame = frame;
    edit.knot.value = value;
    return edit;
}

struct edit edit_number(int spline, enum parameter parameter, double value)
{
    return (struct edit){
        .kind = EDIT_PARAMETER, .spline = spline, .parameter = parameter, .param = param_number(value)};
}

struct edit edit_track(int spline, enum parameter parameter, int track)
{
    return (struct edit){
        .kind = EDIT_PARAMETER, .spline = spline, .parameter = parameter, .param = param_track(track)};
}

struct edit edit_mode(int spline, enum wiggly_mode mode)
{
    return (struct edit){
        .kind = EDIT_PARAMETER, .spline = spline, .parameter = PARAMETER_MODE, .param = param_number(mode)};
}

struct edit edit_start(int spline, enum wiggly_start start)
{
    return (struct edit){
        .kind = EDIT_PARAMETER, .spline = spline, .parameter = PARAMETER_START, .param = param_number(start)};
}

struct edit range_edit(int first, int last)
{
    return (struct edit){.kind = EDIT_RANGE, .first = first, .last = last};
}

int world_undo_all(struct world *world)
{
    int count = 0;
    while (history_undo(world->history)) count++;
    return count;
}
