/// Pins in the document: read, saved byte by byte, edited, undone, and kept such that the saved file loads.

#include "scene/pins.h"
#include "world.h"

enum { SIDE, UP, BASE };

static const char pinned_text[] =
    "{\"frames\": [0, 48], \"splines\": [{\"name\": \"side\", \"frequency\": 1, \"knots\": [{\"frame\": 0, "
    "\"value\": 0}]},{\"name\": \"up\", \"frequency\": 2, \"equilibrium\": {\"spline\": \"base\"}},{\"name\": "
    "\"base\", \"mode\": \"cubic\"}],\"rigs\": [{\"type\": \"tail\", \"name\": \"t\", \"joints\": 12, \"position\": "
    "[0, {\"spline\": \"base\"}, 0],\"channels\": [{\"spline\": \"side\"}, {\"spline\": \"up\", \"axis\": "
    "\"up\"}],\"pins\": [{\"frame\": 30, \"joint\": 11, \"to\": [0, 1, 0.5], \"why\": \"grip\"},{\"frame\": 12.25, "
    "\"joint\": 5, \"to\": [0.25, 0, 1]}]},{\"type\": \"tail\", \"name\": \"free\"}]}";

#define PINNED_TEST(name) WORLD_TEST(name, world_open_scene(world, pinned_text))

PINNED_TEST(test_saves_what_it_reads)
{
    const struct rig *rig = world->document->rigs[0];
    assert_int_equal(rig->pin_count, 2);
    assert_near(rig->pins[0].frame, 12.25, 0);
    assert_int_equal(rig->pins[1].point, 11);
    assert_near(rig->pins[1].to[2], 0.5, 0);
    const char *text = world_print(world);
    assert_non_null(strstr(text, "\"pins\": [\n        { \"frame\": 12.25, \"joint\": 5, \"to\": [0.25, 0, 1] },\n"
                                 "        { \"frame\": 30, \"joint\": 11, \"to\": [0, 1, 0.5], \"why\": \"grip\" }"));
    assert_loads_again(world->document);
}

PINNED_TEST(test_every_edit_is_undone)
{
    const char *before = world_print(world);
    assert_reversible(world, edit_pin_add(world_edit(world), 0,
                                          &(struct pin){.frame = 20, .point = 3, .to = {1, 2, 3}}, &world->error));
    assert_int_equal(world->document->rigs[0]->pin_count, 3);
    struct pin moved = world->document->rigs[0]->pins[1];
    moved.frame = 40; // past the other
    moved.to[1] = -2;
    assert_reversible(world, edit_pin_set(world_edit(world), 0, &moved, &world->error));
    assert_int_equal(world->document->rigs[0]->pins[2].id, moved.id);
    assert_reversible(world,
                      edit_pin_remove(world_edit(world), 0, world->document->rigs[0]->pins[0].id, &world->error));
    assert_reversible(world, edit_joints(world_edit(world), 0, 24, &world->error));
    assert_int_equal(world->document->rigs[0]->pins[0].point, 23);
    assert_reversible(world, edit_fps(world_edit(world), 48, true, &world->error));
    assert_near(world->document->rigs[0]->pins[1].frame, 80, 0);
    assert_reversible(world, edit_tail_add(world_edit(world), 0, 0, &world->error));
    assert_int_equal(world->document->rigs[2]->pin_count, 0);
    assert_reversible(world, edit_range(world_edit(world), 0, 70, RANGE_MOVE, &world->error));
    assert_near(world->document->rigs[0]->pins[1].frame, 70, 0);
    assert_reversible(world, edit_range(world_edit(world), 0, 65, RANGE_TRIM, &world->error));
    assert_int_equal(world->document->rigs[0]->pin_count, 1);
    world_undo_all(world);
    assert_document(world, before);
}

PINNED_TEST(test_what_would_not_load_is_refused)
{
    struct pin pin = world->document->rigs[0]->pins[1];
    assert_refused(world, edit_pin_add(world_edit(world), 0, &pin, &world->error),
                   "t: pins: expected one pin per point and sample, got another at frame 30");
    pin.frame = 49;
    assert_refused(world, edit_pin_set(world_edit(world), 0, &pin, &world->error),
                   "t: pins: expected a frame from 0 to 48, got 49");
    pin.to[1] = NAN;
    assert_refused(world, edit_pin_set(world_edit(world), 0, &pin, &world->error), "t: a pin: the to must be finite");
    pin = (struct pin){.frame = 2, .point = 12};
    assert_refused(world, edit_pin_add(world_edit(world), 0, &pin, &world->error),
                   "t: pins: expected a whole number from 0 to 11, got 12");
    assert_refused(world, edit_pin_remove(world_edit(world), 0, pin.id, &world->error),
                   "t: this pin no longer exists");
    assert_refused(world, edit_mode(world, SIDE, WIGGLY_CUBIC),
                   "t: pins: expected splines with a swing of their own, got \"side\", which is cubic");
    assert_refused(world, edit_number(world, UP, PARAMETER_FREQUENCY, 0),
                   "t: pins: expected splines with a swing of their own, got \"up\", whose frequency is 0");
    assert_refused(world, edit_number(world, UP, PARAMETER_CALM, 0),
                   "t: pins: expected splines with a swing of their own, got \"up\", whose calm is 0");
    assert_refused(world, edit_track(world, UP, PARAMETER_EQUILIBRIUM, SIDE),
                   "t: pins: expected splines that do not follow each other, got \"up\", which follows \"side\"");
    assert_refused(world, edit_track(world, BASE, PARAMETER_EQUILIBRIUM, SIDE),
                   "t: pins: expected splines without a cycle, got \"up\", which follows \"base\"");
    assert_refused(world, edit_bend(world, 0, 1, BASE, -1, -1),
                   "t: pins: expected splines with a swing of their own, got \"base\", which is cubic");
    assert_refused(world, edit_frames(world, 0, 20), "t: pins: expected a frame from 0 to 20, got 30");
    pin.frame = 48;
    pin.point = 1;
    world_must(world, edit_pin_add(world_edit(world), 0, &pin, &world->error));
    assert_refused(world, edit_start(world, UP, WIGGLY_LOOP),
                   "t: pins: expected a frame before 48, because the last frame of a loop repeats the first, got 48");
}
