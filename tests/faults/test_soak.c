/// The app left alone for long, and used: after it has warmed up, no frame leaves anything behind on the heap.
#include "blind.h"

#include "questions.h"
#include "timing/framelog.h"
#include <malloc.h>

enum { WARM_UP = 600 };

/// Bytes that are taken and not given back, by whomever.
static size_t heap_bytes(void)
{
    const struct mallinfo2 info = mallinfo2();
    return info.uordblks + info.hblkhd;
}

static void play(struct blind *b, int frame) { (void)b, (void)frame; }

/// Over everything, slowly: what is under the pointer lights up, and tooltips come and go.
static void point(struct blind *b, int frame)
{
    const float x = (float)(frame * 37 % 1280), y = (float)(frame / 5 * 23 % 720);
    if (frame % 40 == 0) blind_pointer(b, x, y);
    if (frame % 90 == 0)
        blind_send(b, (struct event){.kind = EVENT_WHEEL, .dy = frame % 180 ? 1 : -1, .x = x, .y = y});
}

/// A knot is dragged for a while and put back with Esc, again and again.
static void drag(struct blind *b, int frame)
{
    static float x, y;
    if (frame % 50 == 0) {
        char target[64];
        snprintf(target, sizeof target, "knot(%s,0)", b->app.work.document->splines[0]->name);
        assert_done(editor_target(b->app.work.editor, target, &x, &y, &error));
        blind_pointer(b, x, y);
        blind_button(b, BUTTON_LEFT, ACTION_PRESS, x, y);
    }
    blind_pointer(b, x + 1, y + (float)(frame % 50));
    if (frame % 50 == 48) blind_send_key(b, KEY_ESCAPE, 0);
    if (frame % 50 == 49) blind_button(b, BUTTON_LEFT, ACTION_RELEASE, x, y);
}

/// Dialogs and help are opened and closed.
static void look_up(struct blind *b, int frame)
{
    if (frame % 20 == 0) blind_send_key(b, KEY_F1, 0);
    if (frame % 40 == 10) blind_send_key(b, 'S', MOD_CTRL | MOD_SHIFT);
    if (frame % 20 == 8 || frame % 40 == 18) blind_send_key(b, KEY_ESCAPE, 0);
}

TEST(no_frame_leaves_anything_behind)
{
    static const struct {
        const char *what;
        void (*act)(struct blind *b, int frame);
        bool allocates;
    } rows[] = {
        {"playing", play, false}, {"pointing", point, false}, {"dragging", drag, true}, {"help", look_up, true}};
    for (int i = 0; i < 4; i++) {
        size_t before = 0;
        long allocations = 0;
        struct blind b;
        blind_open(&b, NULL);
        blind_frame(&b); // from then on the view shows every knot
        for (int frame = 0; frame < WARM_UP + quick_or_all(400, 2000); frame++) {
            if (frame == WARM_UP) before = heap_bytes(), allocations = allocation_count();
            rows[i].act(&b, frame);
            blind_frame(&b);
        }
        if ((!rows[i].allocates && allocation_count() != allocations) || heap_bytes() > before)
            fail_msg("%s: %ld allocations, %ld bytes more", rows[i].what, allocation_count() - allocations,
                     (long)heap_bytes() - (long)before);
        blind_close(&b);
    }
}
