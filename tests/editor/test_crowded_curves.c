/// Curves whose swings are finer than a pixel column, and the marks of knots that are.
#include "five_knots.h"
#include "panel_session.h"

/// Opens a scene of one spline with a knot every `gap` frames, whose values come again and again.
static void open_crowded(struct session *s, int knots, int gap, const int *values, int period)
{
    static char scene[400000];
    char *end = scene + sprintf(scene, "{\"wiggly\":1,\"frames\":[0,%d],\"splines\":[{\"name\":\"sway\",\"knots\":[",
                                knots * gap);
    for (int i = 0; i < knots; i++)
        end += sprintf(end, "%s{\"frame\":%d,\"value\":%d}", i ? "," : "", gap * i, values[i % period]);
    strcpy(end, "]}]}");
    session_open(s, scene);
}

/// 2,400 knots on 900 pixels, three of them a swing: some are marked, and each can still be clicked.
TEST(of_crowded_knots_some_are_marked_and_each_is_hit)
{
    static const int values[] = {0, 1, 2};
    struct session s;
    open_crowded(&s, 2400, 1, values, 3);
    int diamonds = 0;
    const struct drawlist *list = drawn_by(s.editor);
    for (int i = 0; i < list->count; i++) diamonds += list->commands[i].kind == DRAW_CONVEX;
    assert_true(diamonds < 150);
    assert_true(diamonds > 50);
    for (int k = 1000; k < 1003; k++) {
        char target[32];
        snprintf(target, sizeof target, "knot(sway,%d)", k);
        session_click(&s, target);
        assert_int_equal(selection_single(selection_of(s.editor), spline(&s, 0)), k);
    }
    session_close(&s);
}

/// Swings finer than a pixel are drawn as the band that they fill, also where a swing takes two columns, half a swing each; and a
/// curve that can be followed stays a line.
TEST(swings_finer_than_a_column_are_a_band)
{
    static const int values[] = {-1, -1, 1, 1};
    struct session s;
    open_crowded(&s, 3200, 2, values, 4);
    const struct rect plot = layout_of(s.editor)->plot;
    for (double frames = 6400; frames > 3200; frames *= 0.97) {
        s.editor->curves->view = (struct plotted){0, frames, -2, 2};
        session_frame(&s);
        const struct drawlist *list = drawn_by(s.editor);
        const struct draw_command *band = NULL;
        for (int i = 0; i < list->count; i++) {
            if (list->commands[i].kind == DRAW_BAND && list->commands[i].width > 2.4f) band = &list->commands[i];
        }
        if (!band) fail_msg("no band with %g frames in sight", frames);
        const float *xy = list->points + 2 * band->first;
        const float apart = (xy[2 * band->count - 2] - xy[0]) / (float)(band->count - 1);
        for (int c = 2; c + 3 < band->count; c++) {
            const float high = fminf(xy[2 * c + 1], xy[2 * c + 3]), low = fmaxf(xy[2 * c + 1], xy[2 * c + 3]);
            if (high > plot.y + plot.h / 4 + 1 || low < plot.y + 3 * plot.h / 4 - 1)
                fail_msg("column %d with %g frames in sight is %g to %g", c, frames, high, low);
            assert_near(xy[2 * c + 2] - xy[2 * c], apart, 1e-3);
        }
    }
    s.editor->curves->view = (struct plotted){0, 240, -2, 2};
    session_frame(&s);
    const struct drawlist *list = drawn_by(s.editor);
    for (int i = 0; i < list->count; i++) assert_int_not_equal(list->commands[i].kind, DRAW_BAND);
    session_close(&s);
}
