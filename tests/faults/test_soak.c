/// The app left alone for long, and used: after it has warmed up, no frame leaves anything behind on the heap.
#include "blind.h"

#include "questions.h"
#include "timing/framelog.h"
#include <malloc.h>

enum { WARM_UP = 600 };

static struct blind blind;

/// Bytes that are taken and not given back, by whomever.
static size_t heap_bytes(void)
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static void button(enum event_action action, float x, float y)
{
    blind_send(&blind, (struct event){.kind = EVENT_BUTTON, .action = action, .clicks = 1, .x = x, .y = y});
}

static void nothing(int frame) { (void)frame; }

/// Over everything, slowly: what is under the pointer lights up, and tooltips come and go.
static void point_around(int frame)
{
    const float x = (float)(frame * 37 % 1280), y = (float)(frame / 5 * 23 % 720);
    if (frame % 40 == 0) blind_send(&blind, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
    if (frame % 90 == 0)
        blind_send(&blind, (struct event){.kind = EVENT_WHEEL, .dy = frame % 180 ? 1 : -1, .x = x, .y = y});
}

/// A knot dragged for a while and put back with Esc, again and again.
static void drag_and_give_up(int frame)
{
    static float x, y;
    struct app *app = &blind.app;
    if (frame % 50 == 0) {
        char target[64];
        snprintf(target, sizeof target, "knot(%s,0)", app->work.document->splines[0]->name);
        if (!editor_target(app->work.editor, target, &x, &y, NULL)) fail_msg("no %s", target);
        blind_send(&blind, (struct event){.kind = EVENT_POINTER, .x = x, .y = y});
        button(ACTION_PRESS, x, y);
    }
    blind_send(&blind, (struct event){.kind = EVENT_POINTER, .x = x + 1, .y = y + (float)(frame % 50)});
    if (frame % 50 == 48) blind_send_key(&blind, KEY_ESCAPE, 0);
    if (frame % 50 == 49) button(ACTION_RELEASE, x, y);
}

/// Dialogs and help that are opened and closed.
static void open_and_close(int frame)
{
    if (frame % 20 == 0) blind_send_key(&blind, KEY_F1, 0);
    if (frame % 20 == 8) blind_send_key(&blind, KEY_ESCAPE, 0);
    if (frame % 40 == 10) blind_send_key(&blind, 'S', MOD_CTRL | MOD_SHIFT);
    if (frame % 40 == 18) blind_send_key(&blind, KEY_ESCAPE, 0);
}

static void leaves_nothing(void (*act)(int frame), bool allocates)
{
    size_t before = 0;
    long allocations = 0;
    blind_open(&blind, NULL);
    blind_frame(&blind); // from then on the view shows every knot
    for (int frame = 0; frame < WARM_UP + quick_or_all(400, 2000); frame++) {
        if (frame == WARM_UP) before = heap_bytes(), allocations = allocation_count();
        act(frame);
        blind_frame(&blind);
    }
    if (!allocates) assert_int_equal(allocation_count(), allocations);
    assert_in_range(heap_bytes(), 0, before);
    blind_close(&blind);
}

TEST(playing) { leaves_nothing(nothing, false); }

TEST(pointing) { leaves_nothing(point_around, false); }

TEST(dragging) { leaves_nothing(drag_and_give_up, true); }

TEST(looking) { leaves_nothing(open_and_close, true); }
