/// A copy that is taken in pieces while edits go on is of the moment when it was begun.
#include "near.h"

#include "scene/snapshot.h"
#include "world.h"
#include <limits.h>
#include <stdlib.h>
#include <string.h>

enum { LAST = 60 };

static const char other[] = "{\"frames\": [0, 60], \"splines\": [{\"name\": \"x\", \"knots\": []}], \"rigs\": []}";

static int pick(int count) { return count > 0 ? rand() % count : 0; }

/// Any edit; some are refused. Those of knots are the most, by far.
static struct edit any_edit(const struct document *document)
{
    const int s = pick(document->spline_count), k = pick(document->splines[s].knot_count);
    const struct knot *knots = document->splines[s].knots;
    struct edit edit = {.spline = s, .rig = -1};
    switch (rand() % 32) {
    case 0:
        return edit_range(0, LAST - rand() % 3);
    case 1:
        edit.kind = EDIT_SPLINE_COPY;
        return edit;
    case 2:
        edit.kind = document->spline_count > 3 ? EDIT_SPLINE_REMOVE : EDIT_SPLINE_MOVE;
        edit.to = pick(document->spline_count);
        return edit;
    case 3:
        return edit_number(s, PARAMETER_FREQUENCY, 1 + rand() % 5);
    case 4:
        edit.kind = EDIT_SPLINE_NAME;
        edit.text = rand() % 2 ? "a longer name than before" : "b";
        return edit;
    case 5:
        edit.kind = EDIT_DOCUMENT;
        edit.document = scene_parse("other", other, sizeof other - 1, NULL, NULL);
        assert_non_null(edit.document);
        return edit;
    default:
        break;
    }
    if (document->splines[s].knot_count < LAST / 2 && rand() % 2) return edit_insert(s, rand() % LAST, rand());
    if (document->splines[s].knot_count == 0) return edit_insert(s, rand() % LAST, 1);
    edit.kind = rand() % 3 ? EDIT_KNOT_SET : EDIT_KNOT_REMOVE;
    edit.knot = knots[k];
    edit.knot.frame = rand() % LAST;
    edit.knot.value = rand() % 100;
    return edit;
}

/// A step as a click makes one, or as a drag does: taken back and made anew; or undo, or redo.
static void edit_somehow(struct world *world)
{
    if (history_is_open(world->history)) {
        if (rand() % 2) history_restart(world->history, world->document);
        for (int i = rand() % 3; i > 0; i--) world_apply(world, any_edit(world->document));
        if (rand() % 3 == 0) history_end(world->history);
        return;
    }
    switch (rand() % 8) {
    case 0:
    case 1:
        history_undo(world->history, world->document);
        break;
    case 2:
        history_redo(world->history, world->document);
        break;
    default:
        history_begin(world->history, "Edit", 0);
        world_apply(world, any_edit(world->document));
        break;
    }
}

static void assert_copy(struct snapshot *snapshot, const char *expected)
{
    static char *text;
    static size_t capacity;
    size_t size;
    assert_true(snapshot_print(snapshot, &text, &capacity, &size));
    assert_int_equal(size, strlen(expected));
    assert_memory_equal(text, expected, size);
    free(text);
    text = NULL;
    capacity = 0;
}

static void test_edits_meanwhile(void **state)
{
    (void)state;
    struct world world;
    struct snapshot *snapshot = snapshot_create();
    int interleaved = 0;
    srand(5);
    world_open(&world);
    for (int i = 0; i < 3000; i++) {
        assert_true(snapshot_begin(snapshot, world.document, world.document->folder));
        char *expected = world_print(&world);
        bool whole = false;
        while (!whole) {
            const bool was_running = snapshot_is_running(snapshot);
            for (int edits = rand() % 4; edits > 0; edits--) edit_somehow(&world);
            interleaved += was_running && snapshot_is_running(snapshot);
            whole = !snapshot_is_running(snapshot) || snapshot_continue(snapshot, 1 + rand() % 9);
        }
        assert_copy(snapshot, expected);
        free(expected);
        for (int edits = rand() % 20; edits > 0; edits--) edit_somehow(&world);
    }
    assert_true(interleaved > 3000);
    if (history_is_open(world.history)) history_end(world.history);
    snapshot_destroy(snapshot);
    world_close(&world);
}

/// A document that goes takes nothing along that the copy still needs, or that needs the copy.
static void test_given_up(void **state)
{
    (void)state;
    struct world world;
    struct snapshot *snapshot = snapshot_create();
    world_open(&world);
    assert_true(snapshot_begin(snapshot, world.document, NULL));
    assert_false(snapshot_continue(snapshot, 1));
    world_close(&world);
    assert_false(snapshot_is_running(snapshot));
    assert_false(snapshot_continue(snapshot, 1));
    world_open(&world);
    assert_true(snapshot_begin(snapshot, world.document, world.document->folder));
    snapshot_finish(snapshot);
    char *expected = world_print(&world);
    world_close(&world);
    assert_copy(snapshot, expected);
    free(expected);
    world_open(&world);
    assert_true(snapshot_begin(snapshot, world.document, NULL));
    snapshot_destroy(snapshot);
    world_must(&world, edit_insert(SWAY, 5, 5));
    world_close(&world);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_edits_meanwhile),
        cmocka_unit_test(test_given_up),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
