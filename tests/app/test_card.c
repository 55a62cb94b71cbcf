/// The card for newcomers stands beside what a scene shows, or in a band above it, on every size of stage.
#include "blind.h"
#include "questions.h"
#include "shown.h"

#include "editor/stage/state.h"

enum { STEPS = 12, REACH = 6, LINE = 16 };

static const char *const scenes[] = {"character", "compositing", "figure7", "hands", "up-down"};

static void open_scene(struct blind *b, const char *scene)
{
    char path[64];
    snprintf(path, sizeof path, "assets/scenes/%s.json", scene);
    blind_open(b, path);
}

static void open_welcome(struct blind *b, float width)
{
    app_resize(&b->app, width, roundf(width * 9 / 16), 1);
    b->app.work.editor->core.view.refit_stage = true; // as in a window of that size
    welcome(b->app.work.editor);
    for (int i = 0; i < 2; i++) blind_frame(b);
}

/// Between the first word and the last one.
static struct rect words(const struct editor *editor)
{
    const struct draw_command *first = shown_text(editor, "Drag the character"), *last = shown_text(editor, "Got it");
    assert_true(first && last && first->y <= last->y);
    return (struct rect){first->x - REACH, first->y - LINE, last->x + 40 - first->x, last->y - first->y + LINE};
}

static bool covers_a_character(const struct editor *editor, struct rect card)
{
    for (int i = 0; i <= STEPS * STEPS; i++) {
        struct target target = {.number = {i % STEPS / (double)STEPS, i / STEPS / (double)STEPS}};
        for (target.nth = 0; target.nth < 2; target.nth++) {
            float xy[2];
            if (find_character(editor->stage, &editor->core, &target, xy) && rect_contains(card, xy[0], xy[1]))
                return true;
        }
    }
    return false;
}

TEST(it_covers_no_character)
{
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        struct blind b;
        open_scene(&b, scenes[i]);
        for (float width = 640; width <= 1280; width += 80) {
            open_welcome(&b, width);
            const struct editor *editor = b.app.work.editor;
            const struct rect card = words(editor), stage = layout_of(editor)->stage;
            if (covers_a_character(editor, card)) fail_msg("%s at %g", scenes[i], (double)width);
            assert_true(card.x >= stage.x && card.x + card.w <= stage.x + stage.w);
            assert_true(card.y >= stage.y && card.y + card.h <= stage.y + stage.h);
        }
        blind_close(&b);
    }
}

/// A click on it, upright at the right hand or in a band, takes it away; the description comes back where a band was.
TEST(a_click_on_it_takes_it_away)
{
    for (float width = 640; width <= 1280; width += 640) {
        struct blind b;
        open_scene(&b, "compositing");
        open_welcome(&b, width);
        const struct editor *editor = b.app.work.editor;
        const struct rect card = words(editor);
        const bool is_band = width < 1000;
        assert_true(is_band == !shown_text(editor, "Compositing"));
        for (int i = 0; i < 2; i++)
            blind_send(&b, (struct event){.kind = EVENT_BUTTON,
                                          .button = BUTTON_LEFT,
                                          .action = i ? ACTION_RELEASE : ACTION_PRESS,
                                          .clicks = 1,
                                          .x = card.x + card.w / 2,
                                          .y = card.y + card.h / 2});
        blind_frame(&b);
        assert_false(is_welcoming(editor));
        assert_non_null(shown_text(editor, "Compositing"));
        blind_close(&b);
    }
}
