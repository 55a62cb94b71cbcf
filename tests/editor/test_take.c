/// A take: the scene that Shift+K kept, shown while K is held; and what the rows of Feel were.
#include "panel_session.h"

#include "base/need.h"
#include "base/progress.h"
#include "ui/theme.h"

static void open_file(struct session *s, const char *path)
{
    char *text;
    size_t size;
    assert_done(file_read(path, 1 << 20, &text, &size, &error));
    panel_open(s, text, 1280, 900);
    free(text);
    s->document->folder = need_text("assets/scenes");
    assert_done(models_update(s->work.models, s->document, &error));
    editor_open(s->editor, &s->world);
    if (playback_of(s->editor)->playing) session_key(s, KEY_SPACE, 0);
    session_move(s, 2, 2);
    session_frame(s);
}

static void open_dog(struct session *s) { open_file(s, "assets/scenes/dog.json"); }

/// What is on the stage at a frame: camera, poses and shadows.
static uint64_t stage_at(struct session *s, double frame)
{
    seek(s->editor, frame);
    session_frame(s);
    return editor_stage(s->editor)->hash;
}

static void hold_k(struct session *s, bool down)
{
    session_hold(s, 'K', down ? ACTION_PRESS : ACTION_RELEASE);
    session_frame(s);
}

/// Tails, chains and characters, at the playhead wherever it is; K shows, and edits nothing.
TEST(k_shows_the_stage_as_it_was)
{
    static const char *const scenes[] = {"assets/scenes/tail.json", "assets/scenes/dog.json",
                                         "assets/scenes/hands.json", "assets/scenes/follow.json"};
    for (size_t i = 0; i < sizeof scenes / sizeof scenes[0]; i++) {
        struct session s;
        open_file(&s, scenes[i]);
        const uint64_t before[] = {stage_at(&s, 20), stage_at(&s, 45)};
        session_key(&s, 'K', MOD_SHIFT);
        inspector_preset(s.editor->inspector, 3);
        const uint64_t now[] = {stage_at(&s, 20), stage_at(&s, 45)};
        const char *saved = session_saved(&s);
        const size_t steps = history_done(s.history);
        for (int k = 0; k < 2; k++) {
            if (now[k] == before[k]) fail_msg("%s does not change", scenes[i]);
            stage_at(&s, k ? 45 : 20);
            hold_k(&s, true);
            if (editor_stage(s.editor)->hash != before[k]) fail_msg("%s is not as before", scenes[i]);
            hold_k(&s, false);
            if (editor_stage(s.editor)->hash != now[k]) fail_msg("%s does not come back", scenes[i]);
        }
        hold_k(&s, true);
        assert_true(stage_at(&s, 20) == before[0]); // scrubbed while it is held
        hold_k(&s, false);
        assert_saved(&s, saved);
        assert_int_equal(history_done(s.history), steps);
        session_close(&s);
    }
}

/// Lines in the plot with this colour, whatever its opacity.
static int count_lines(const struct session *s, uint32_t color)
{
    const struct drawlist *list = drawn_by(s->editor);
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        count += c->kind == DRAW_LINE && c->color >> 8 == color >> 8 && c->count > 100;
    }
    return count;
}

SESSION_TEST(k_shows_the_curves_as_they_were, open_dog(s))
{
    const uint32_t active = theme()->playhead, other = theme()->spline[1];
    session_key(s, 'K', MOD_SHIFT);
    inspector_preset(s->editor->inspector, 1);
    session_frame(s);
    const int before[] = {count_lines(s, active), count_lines(s, other)};
    hold_k(s, true);
    assert_int_equal(count_lines(s, active), before[0] + 1);
    assert_int_equal(count_lines(s, other), before[1] + 1);
    assert_true(session_shows(s, "Before"));
    const long allocated = allocation_count();
    for (int i = 0; i < 20; i++) session_frame(s);
    assert_int_equal(allocation_count(), allocated);
    hold_k(s, false);
    assert_int_equal(count_lines(s, active), before[0]);
    assert_false(session_shows(s, "Before"));
}

static int count_marks(const struct session *s)
{
    const struct drawlist *list = drawn_by(s->editor);
    const float left = layout_of(s->editor)->inspector.x;
    int count = 0;
    for (int i = 0; i < list->count; i++) {
        const struct draw_command *c = &list->commands[i];
        count += c->kind == DRAW_RECT && c->color == theme_fade(theme()->playhead, 0.6f) && c->bounds.x > left;
    }
    return count;
}

/// Rows that have changed have a mark where they were, and while K is held the numbers are those of before.
SESSION_TEST(rows_show_what_they_were, open_dog(s))
{
    static const char *const was[] = {"1.30 Hz", "0.16", "9 frames", "16.0°"};
    static const char *const now[] = {"1.80 Hz", "0.12", "5 frames", "37.1°"};
    session_key(s, 'K', MOD_SHIFT);
    assert_int_equal(count_marks(s), 0);
    panel_click(s, "preset.whip");
    session_move(s, 2, 2);
    session_frame(s);
    for (int held = 0; held < 2; held++) {
        assert_int_equal(count_marks(s), held ? 0 : 4);
        for (int i = 0; i < 4; i++) {
            assert_true(session_shows(s, (held ? was : now)[i]));
            assert_false(session_shows(s, (held ? now : was)[i]));
        }
        hold_k(s, true);
    }
}

/// With other rigs the stage stays as it is, and says so; with another document nothing is kept.
SESSION_TEST(what_k_cannot_show, open_dog(s))
{
    hold_k(s, true);
    assert_said(s->editor, "Nothing is kept yet");
    hold_k(s, false);
    session_key(s, 'K', MOD_SHIFT);
    inspector_add(s->editor->inspector, ADD_TAIL);
    session_frame(s);
    const uint64_t now = stage_at(s, 20);
    hold_k(s, true);
    assert_said(s->editor, "Only the curves");
    assert_true(editor_stage(s->editor)->hash == now);
    hold_k(s, false);
    editor_open(s->editor, &s->world);
    hold_k(s, true);
    assert_said(s->editor, "Nothing is kept yet");
}

/// A drag edits what is now, and is seen.
SESSION_TEST(a_drag_goes_before_k, open_dog(s))
{
    session_key(s, 'K', MOD_SHIFT);
    hold_k(s, true);
    session_pull(s, "knot(tail,1)", 0, 20, 4);
    assert_false(session_shows(s, "Before"));
    session_release(s, BUTTON_LEFT);
    assert_true(session_shows(s, "Before"));
}
