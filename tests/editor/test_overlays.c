/// Onion skin and motion arc: what they show, and that they follow an edit in its own frame.
#include "editor/stage/state.h"
#include "panel_session.h"

#include "ui/theme.h"

static const char scene[] =
    "{\"frames\": [0, 96], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"damping\": 0.1, \"knots\": ["
    "{\"frame\": 4, \"value\": 0}, {\"frame\": 14, \"value\": 1}, {\"frame\": 24, \"value\": -1}, {\"frame\": 34, "
    "\"value\": 1}, {\"frame\": 44, \"value\": -1}, {\"frame\": 54, \"value\": 1}, {\"frame\": 64, \"value\": 0}, "
    "{\"frame\": 74, \"value\": 1}, {\"frame\": 84, \"value\": 0}]}],"
    "\"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"position\": [0, 0.26, 0], \"channels\": [{\"spline\": "
    "\"sway\"}]}]}";

enum { MAX_FOUND = 400 };

struct found {
    const struct draw_command *command[MAX_FOUND];
    int count;
};

/// The commands of a kind and colour (whatever its opacity) on the stage.
static struct found find(const struct session *s, enum draw_kind kind, uint32_t color)
{
    struct found found = {.count = 0};
    const struct drawlist *list = drawn_by(s->editor);
    const struct rect *stage = &layout_of(s->editor)->stage;
    for (int i = 0; i < list->count && found.count < MAX_FOUND; i++) {
        const struct draw_command *command = &list->commands[i];
        bool inside =
            command->clip.y + command->clip.h <= stage->y + stage->h && command->clip.x < stage->x + stage->w;
        if (command->kind == kind && command->color >> 8 == color >> 8 && inside) {
            found.command[found.count++] = command;
        }
    }
    return found;
}

static void middle_of(const struct session *s, const struct draw_command *command, float xy[2])
{
    const float *points = drawn_by(s->editor)->points + 2 * command->first;
    xy[0] = xy[1] = 0;
    for (int i = 0; i < command->count; i++) {
        xy[0] += points[2 * i] / (float)command->count;
        xy[1] += points[2 * i + 1] / (float)command->count;
    }
}

SESSION_TEST(test_onion_shows_the_nearest_knots, session_open(s, scene))
{
    uint32_t color = theme()->spline[0];
    assert_int_equal(find(s, DRAW_LINE, color).count, 0);
    session_key(s, KEY_F4, 0); // no ghost besides
    session_key(s, 'O', 0);
    struct found skins = find(s, DRAW_LINE, color);
    assert_int_equal(skins.count, 8); // of nine knots, the ninth is the farthest
    const struct draw_command *nearest = skins.command[7], *farthest = skins.command[0];
    assert_true((nearest->color & 0xFF) > (farthest->color & 0xFF));
    uint64_t before = nearest->hash;
    session_click(s, "knot(sway,0)");
    session_key(s, KEY_UP, MOD_ALT);
    skins = find(s, DRAW_LINE, color);
    assert_int_equal(skins.count, 8);
    assert_true(skins.command[7]->hash != before); // in the frame of the nudge
    session_key(s, KEY_DELETE, 0);
    session_key(s, 'A', MOD_CTRL);
    session_key(s, KEY_DELETE, 0);
    assert_int_equal(find(s, DRAW_LINE, color).count, 0);
    session_key(s, 'O', 0);
    assert_false(is_on(s->editor, SWITCH_ONION));
}

/// A mark a frame, where the tip will be; the range's ends are the arc's.
SESSION_TEST(test_arc_is_where_the_tip_goes, session_open(s, scene))
{
    session_key(s, 'O', MOD_SHIFT);
    struct found marks = find(s, DRAW_RECT, theme()->playhead);
    assert_in_range(marks.count, 44, 49); // two seconds ahead of the first frame, less what has faded
    for (int step = 1; step <= 3; step++) {
        float expected[2], tip[2];
        middle_of(s, find(s, DRAW_RECT, theme()->playhead).command[step], expected);
        assert_true(isfinite(expected[0]));
        for (int i = 0; i < step; i++) session_key(s, KEY_RIGHT, 0);
        session_where(s, "tail(tail,1)", tip);
        assert_near(tip[0], expected[0], 0.1);
        assert_near(tip[1], expected[1], 0.1);
        session_key(s, KEY_LEFT, MOD_SHIFT);
    }
}

SESSION_TEST(test_arc_follows_an_edit_at_once, session_open(s, scene))
{
    session_key(s, 'O', MOD_SHIFT);
    float before[2], after[2], again[2];
    middle_of(s, find(s, DRAW_RECT, theme()->playhead).command[14], before);
    session_click(s, "knot(sway,1)");
    session_key(s, KEY_UP, MOD_ALT | MOD_SHIFT);
    middle_of(s, find(s, DRAW_RECT, theme()->playhead).command[14], after);
    assert_true(hypotf(after[0] - before[0], after[1] - before[1]) > 2);
    session_key(s, 'Z', MOD_CTRL);
    middle_of(s, find(s, DRAW_RECT, theme()->playhead).command[14], again);
    assert_near(again[0], before[0], 1e-4);
    assert_near(again[1], before[1], 1e-4);
}

/// Both stay as they are when another document comes, and neither minds one without tails.
SESSION_TEST(test_overlays_outlive_documents,
             session_open(s, "{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\"}]}"))
{
    session_key(s, 'O', 0);
    session_key(s, 'O', MOD_SHIFT);
    editor_open(s->editor, &s->world);
    session_frame(s);
    assert_true(is_on(s->editor, SWITCH_ONION));
    assert_true(is_on(s->editor, SWITCH_TRAIL));
}

SESSION_TEST(test_the_ghost_is_the_pose_at_the_knot_in_hand, session_open(s, scene))
{
    const uint32_t color = theme()->spline[0];
    session_pull(s, "knot(sway,2)", 0, 20, 2);
    struct found ghost = find(s, DRAW_LINE, color);
    assert_int_equal(ghost.count, 1);
    const uint64_t before = ghost.command[0]->hash;
    session_drag(s, 0, 20, 1);
    ghost = find(s, DRAW_LINE, color);
    assert_int_equal(ghost.count, 1);
    assert_true(ghost.command[0]->hash != before); // as the curve is in this frame
    session_release(s, BUTTON_LEFT);
    assert_int_equal(find(s, DRAW_LINE, color).count, 0);
    session_key(s, KEY_UP, MOD_ALT); // and for a moment after a nudge
    assert_int_equal(find(s, DRAW_LINE, color).count, 1);
    for (int i = 0; i < 90; i++) session_frame(s);
    assert_int_equal(find(s, DRAW_LINE, color).count, 0);
    session_key(s, KEY_F4, 0);
    session_pull(s, "knot(sway,2)", 0, 20, 2);
    assert_int_equal(find(s, DRAW_LINE, color).count, 0);
    session_release(s, BUTTON_LEFT);
}

static float turn(const float a[2], const float b[2], const float c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// How often a line crosses itself.
static int crossings(const struct session *s, const struct draw_command *command)
{
    const float(*p)[2] = (const float(*)[2])(drawn_by(s->editor)->points + 2 * command->first);
    int count = 0;
    for (int i = 0; i + 1 < command->count; i++) {
        for (int k = i + 2; k + 1 < command->count; k++) {
            count += turn(p[i], p[i + 1], p[k]) * turn(p[i], p[i + 1], p[k + 1]) < 0 &&
                     turn(p[k], p[k + 1], p[i]) * turn(p[k], p[k + 1], p[i + 1]) < 0;
        }
    }
    return count;
}

SESSION_TEST(test_outlines_do_not_fold_from_any_side, session_open(s, scene))
{
    session_key(s, KEY_F4, 0);
    session_key(s, 'O', 0);
    for (int a = 0; a < 24; a++) {
        camera_of(s->editor)->azimuth = 6.2831853f * (float)a / 24;
        session_frame(s);
        const struct found skins = find(s, DRAW_LINE, theme()->spline[0]);
        assert_int_equal(skins.count, 8);
        for (int i = 0; i < skins.count; i++) assert_int_equal(crossings(s, skins.command[i]), 0);
    }
}

static void open_bear(struct session *s)
{
    panel_open_models(
        s, "{\"frames\": [0, 96], \"splines\": [{\"name\": \"swing\", \"knots\": [{\"frame\": 0, \"value\": 0},"
           "{\"frame\": 40, \"value\": 1}]}], \"rigs\": [{\"type\": \"character\", \"name\": \"bear\", \"model\": "
           "\"assets/models/creature.glb\", \"coordinates\": [{\"name\": \"side\", \"spline\": \"swing\"}]}]}");
    session_frame(s);
}

/// How far the coordinates move a vertex, squared.
static float way_of(const struct character *c, int vertex)
{
    float way = 0;
    for (int i = 0; i < c->coordinate_count; i++) {
        for (int k = 0; k < 3; k++) {
            const float re = c->coordinates[i].re[vertex][k], im = c->coordinates[i].im[vertex][k];
            way += re * re + im * im;
        }
    }
    return way;
}

/// Onion skin and motion arc are not for tails alone: a scene of a soft character shows its outlines, and where it moves most.
SESSION_TEST(test_a_character_has_skins_and_an_arc, open_bear(s))
{
    assert_int_equal(find(s, DRAW_LINE, theme()->spline[0]).count, 0);
    session_key(s, 'O', 0);
    assert_true(find(s, DRAW_LINE, theme()->spline[0]).count >= 2); // of two knots
    assert_int_equal(find(s, DRAW_RECT, theme()->playhead).count, 0);
    session_key(s, 'O', MOD_SHIFT);
    assert_in_range(find(s, DRAW_RECT, theme()->playhead).count, 44, 49);
    const struct character *bear = &models_figure(s->world.models, 0)->character;
    const int point = overlay_point(s->editor->stage, &s->editor->core).at;
    for (int i = 0; i < bear->vertex_count; i++) assert_true(way_of(bear, i) <= way_of(bear, point) + 1e-6f);
    panel_click(s, "onion");
    panel_click(s, "trail");
    assert_int_equal(find(s, DRAW_LINE, theme()->spline[0]).count, 0);
    assert_int_equal(find(s, DRAW_RECT, theme()->playhead).count, 0);
}

/// At the height of the character: from its ears, above the middle of its head, to its feet.
SESSION_TEST(test_a_character_has_a_ghost, open_bear(s))
{
    const uint32_t color = theme()->spline[0];
    session_pull(s, "knot(swing,1)", 0, 8, 2);
    const struct found ghost = find(s, DRAW_LINE, color);
    assert_true(ghost.count >= 1);
    const float *points = drawn_by(s->editor)->points + 2 * ghost.command[0]->first;
    float low = INFINITY, high = -INFINITY;
    for (int i = 0; i < ghost.command[0]->count; i++) {
        low = fminf(low, points[2 * i + 1]);
        high = fmaxf(high, points[2 * i + 1]);
    }
    float head[2], foot[2];
    session_release(s, BUTTON_LEFT);
    session_click(s, "ruler(40)");
    session_frame(s);
    session_where(s, "character(bear,0.5,1)", head);
    session_where(s, "character(bear,0.4,0)", foot);
    assert_in_range((int)(head[1] - low), 0, 60);
    assert_near(high, foot[1], 60);
}
