/// The brush on a character's surface, by mouse and keys: what a stroke changes and what it leaves alone, its undo, its modes, and
/// the distances that it works with.
#include "folder.h"
#include "panel_session.h"
#include "puppet.h"
#include "timing/framelog.h"

/// Two fingers of 0.8 m, 7 cm apart through the air, on one palm.
static float hand_distance(const float p[3])
{
    float nearest = INFINITY;
    for (int side = -1; side <= 1; side += 2) {
        const float x = p[0] - 0.125f * (float)side, y = p[1] - fmaxf(0.15f, fminf(0.9f, p[1]));
        nearest = fminf(nearest, sqrtf(x * x + y * y + p[2] * p[2]) - 0.09f);
    }
    const float x = p[0] - fmaxf(-0.125f, fminf(0.125f, p[0])), y = p[1] - 0.15f;
    return fminf(nearest, sqrtf(x * x + y * y + p[2] * p[2]) - 0.09f);
}

static struct character make_hand(void)
{
    const struct solid hand = {hand_distance, puppet_paint};
    const float lo[3] = {-0.3f, 0, -0.15f}, hi[3] = {0.3f, 1.05f, 0.15f};
    struct character character = puppet_solid(&hand, lo, hi, 0.025f, 2);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[0].re[i][0] = 0.05f;
        character.coordinates[0].im[i][1] = 0.02f;
        character.coordinates[1].im[i][2] = 0.05f;
    }
    return character;
}

static const char *model(void) { return folder_path("hand.glb"); }

static int make_model(void **state)
{
    if (folder_make(state) != 0) return -1;
    struct character character = make_hand();
    puppet_write(&character, model());
    return 0;
}

struct studio {
    struct session session;
    struct models *models;
    const struct figure *plain;
};

static struct character_rig *rig_of(const struct studio *s) { return document_character(s->session.document, 0); }

static void frame(struct studio *s)
{
    models_follow(s->models, s->session.document);
    session_frame(&s->session);
}

static void frames(struct studio *s, int count)
{
    for (int i = 0; i < count; i++) frame(s);
}

static void studio_open(struct studio *s)
{
    char scene[700];
    snprintf(scene, sizeof scene,
             "{\"wiggly\": 1, \"frames\": [0, 48], \"splines\": [{\"name\": \"s\", \"frequency\": 1, \"start\": "
             "\"loop\", \"knots\": [{\"frame\": 0, \"value\": 1}, {\"frame\": 20, \"value\": -1}]}], \"rigs\": ["
             "{\"type\": \"character\", \"name\": \"hand\", \"model\": \"%s\", \"coordinates\": [{\"name\": \"a\", "
             "\"spline\": \"s\"}]}]}",
             model());
    s->models = panel_open_models(&s->session, scene);
    if (playback_of(s->session.editor)->playing) session_key(&s->session, KEY_SPACE, 0);
    s->plain = models_figure(s->models, 0);
    camera_of(s->session.editor)->azimuth = -1.5708f; // from the front
    frame(s);
}

/// The middle of the front of a finger, 3/4 up.
static const char left_finger[] = "character(hand,0.2,0.75)", right_finger[] = "character(hand,0.8,0.75)";

/// Holds the button at a target for so many frames.
static void hold(struct studio *s, const char *target, unsigned mods, int count)
{
    s->session.mods = mods;
    session_point(&s->session, target);
    session_press(&s->session, BUTTON_LEFT, 1);
    frames(s, count);
    session_release(&s->session, BUTTON_LEFT);
    s->session.mods = 0;
    frame(s);
}

static const float *value_of(const struct studio *s, int coordinate, int vertex)
{
    return rig_of(s)->painted->values[coordinate * rig_of(s)->painted->vertices + vertex];
}

#define STUDIO_TEST(name) TEST_OF(struct studio, s, studio_open(s), session_close(&s->session), name)

STUDIO_TEST(a_stroke_changes_phase_where_it_is_and_nowhere_else)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    brush_of(s->session.editor)->radius = 0.2; // 0.19 m: through the air it would reach the other finger
    hold(s, left_finger, 0, 30);
    assert_non_null(rig_of(s)->painted);
    float most = 0;
    for (int i = 0; i < s->plain->character.vertex_count; i++) {
        const float *p = s->plain->character.position[i], *value = value_of(s, 0, i);
        assert_true(value[1] >= 0);
        assert_near((double)value[0], 0, 0);
        assert_near((double)value_of(s, 1, i)[1], 0, 0);
        if (p[0] > 0 || p[1] < 0.4f) assert_near((double)value[1], 0, 0);
        most = fmaxf(most, value[1]);
    }
    // Half a second at 0.4 of a turn a second, but for what the surface has moved under the pointer meanwhile.
    assert_near((double)most, 0.5 * 0.4 * 6.2831853, 0.1);
    assert_int_equal((int)history_count(s->session.history), 1);
    assert_string_equal(history_undo_label(s->session.history), "Advance phase");
}

STUDIO_TEST(undo_and_redo_are_exact)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    hold(s, left_finger, 0, 10);
    const size_t size = 2 * (size_t)s->plain->character.vertex_count * sizeof(float[2]);
    float *once = malloc(size), *twice = malloc(size);
    assert_true(once && twice);
    memcpy(once, rig_of(s)->painted->values, size);
    session_point(&s->session, left_finger);
    session_press(&s->session, BUTTON_LEFT, 1);
    for (int i = 0; i < 10; i++) {
        session_move(&s->session, s->session.x, s->session.y + 8);
        frame(s);
    }
    session_release(&s->session, BUTTON_LEFT);
    memcpy(twice, rig_of(s)->painted->values, size);
    assert_true(memcmp(once, twice, size) != 0);
    session_key(&s->session, 'Z', MOD_CTRL);
    assert_memory_equal(rig_of(s)->painted->values, once, size);
    session_key(&s->session, 'Z', MOD_CTRL);
    assert_null(rig_of(s)->painted);
    frame(s);
    assert_memory_equal(models_figure(s->models, 0)->character.coordinates[0].re,
                        s->plain->character.coordinates[0].re,
                        (size_t)s->plain->character.vertex_count * sizeof(float[3]));
    session_key(&s->session, 'Y', MOD_CTRL);
    session_key(&s->session, 'Y', MOD_CTRL);
    assert_memory_equal(rig_of(s)->painted->values, twice, size);
    session_point(&s->session, left_finger);
    session_press(&s->session, BUTTON_LEFT, 1);
    frames(s, 5);
    session_key(&s->session, KEY_ESCAPE, 0); // takes the stroke back, and the brush stays
    assert_memory_equal(rig_of(s)->painted->values, twice, size);
    assert_true(brush_of(s->session.editor)->on);
    assert_int_equal((int)history_count(s->session.history), 2);
    free(once);
    free(twice);
}

/// Only the press, which makes room for the stroke, may allocate.
STUDIO_TEST(a_stroke_allocates_nothing_as_it_goes_on)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    hold(s, right_finger, 0, 3);
    session_key(&s->session, KEY_SPACE, 0); // playing, as one paints
    session_point(&s->session, left_finger);
    session_press(&s->session, BUTTON_LEFT, 1);
    frames(s, 2);
    const long before = allocation_count();
    for (int i = 0; i < 20; i++) {
        session_move(&s->session, s->session.x, s->session.y + 6);
        frame(s);
    }
    assert_int_equal(allocation_count() - before, 0);
    session_release(&s->session, BUTTON_LEFT);
}

static double mean_lead(const struct studio *s)
{
    double sum = 0;
    for (int i = 0; i < rig_of(s)->painted->vertices; i++) sum += (double)value_of(s, 0, i)[1];
    return sum / rig_of(s)->painted->vertices;
}

STUDIO_TEST(modes_and_modifiers_do_what_they_say)
{
    panel_click(&s->session, "paint.on");
    assert_true(brush_of(s->session.editor)->on);
    hold(s, left_finger, MOD_CTRL, 10);
    assert_string_equal(history_undo_label(s->session.history), "Delay phase");
    const double delayed = mean_lead(s);
    assert_true(delayed < -1e-3);
    panel_click(&s->session, "phase.delay");
    hold(s, left_finger, MOD_CTRL, 10);
    assert_string_equal(history_undo_label(s->session.history), "Advance phase");
    assert_true(fabs(mean_lead(s)) < -0.1 * delayed); // all but what the surface moved meanwhile
    panel_click(&s->session, "swing.less");
    brush_of(s->session.editor)->strength = 1;
    for (int stroke = 0; stroke < 6; stroke++) hold(s, left_finger, 0, 90);
    panel_click(&s->session, "erase.all");
    assert_string_equal(history_undo_label(s->session.history), "Less amplitude");
    float least = 0;
    for (int i = 0; i < rig_of(s)->painted->vertices; i++) {
        const float swell = value_of(s, 0, i)[0];
        assert_true(expf(swell) > 0); // never turned round
        least = fminf(least, swell);
    }
    assert_near((double)expf(least), 0.01, 1e-4);
    hold(s, left_finger, 0, 100);
    panel_click(&s->session, "paint.clean");
    assert_true(paint_is_plain(rig_of(s)->painted));
    assert_string_equal(history_undo_label(s->session.history), "Remove paint");
    session_key(&s->session, 'Z', MOD_CTRL);
    assert_false(paint_is_plain(rig_of(s)->painted));
}

/// Soft at the rim: half way out a moment of the brush does about half of what it does in the middle, near the rim hardly anything.
STUDIO_TEST(a_dab_fades_towards_its_rim)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    brush_of(s->session.editor)->radius = 0.2;
    hold(s, left_finger, 0, 3);
    const struct reach *reach = &s->session.editor->stage->painting.work.reach;
    float most = 0, radius = 0;
    for (int i = 0; i < reach->count; i++) {
        const int vertex = reach->vertices[i];
        const float done = value_of(s, 0, vertex)[1];
        most = fmaxf(most, done);
        if (done > 0) radius = fmaxf(radius, reach->distance[vertex]);
    }
    double sum[2] = {0}; // over what lies half way out, and near the rim
    int count[2] = {0};
    for (int i = 0; i < reach->count; i++) {
        const float away = reach->distance[reach->vertices[i]] / radius;
        const bool is_half_way = away > 0.45f && away < 0.55f;
        if (!is_half_way && !(away > 0.9f && away <= 1)) continue;
        sum[!is_half_way] += (double)(value_of(s, 0, reach->vertices[i])[1] / most);
        count[!is_half_way]++;
    }
    assert_near(sum[0] / count[0], 0.52, 0.12);
    assert_near(sum[1] / count[1], 0, 0.04);
}

/// However long a stroke is held, phases in its reach differ by a quarter of a turn at most, and amplitudes by a factor of four; another
/// stroke goes on from there.
STUDIO_TEST(a_long_stroke_saturates)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    brush_of(s->session.editor)->strength = 1;
    for (int stroke = 1; stroke <= 2; stroke++) {
        hold(s, left_finger, 0, 120);
        float most = 0;
        for (int i = 0; i < s->plain->character.vertex_count; i++) most = fmaxf(most, value_of(s, 0, i)[1]);
        if (stroke == 1) assert_near((double)most, 1.5707963, 0.02);
        if (stroke == 2) assert_true(most > 2 && most < 3.1416f); // the surface has moved under the pointer
    }
    panel_click(&s->session, "swing.more");
    hold(s, left_finger, MOD_CTRL, 120);
    float least = 0;
    for (int i = 0; i < s->plain->character.vertex_count; i++) least = fminf(least, value_of(s, 0, i)[0]);
    assert_near((double)expf(least), 0.25, 0.02);
}

/// Sum over all edges of the finger's middle of how much Ñ' differs in phase and in the logarithm of amplitude.
static void variation(const struct studio *s, double sum[2])
{
    const struct figure *figure = models_figure(s->models, 0);
    const struct coordinate *c = &figure->character.coordinates[0];
    sum[0] = sum[1] = 0;
    for (int i = 0; i < figure->character.vertex_count; i++) {
        const float *p = figure->character.position[i];
        if (p[0] > 0 || fabsf(p[1] - 0.72f) > 0.06f || p[2] < 0) continue;
        for (int e = figure->edges.first[i]; e < figure->edges.first[i + 1]; e++) {
            const uint32_t j = figure->edges.other[e];
            const double a[2] = {(double)c->re[i][0], (double)c->im[i][0]};
            const double b[2] = {(double)c->re[j][0], (double)c->im[j][0]};
            sum[0] += fabs(atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]));
            sum[1] += fabs(log(hypot(a[0], a[1]) / hypot(b[0], b[1])));
        }
    }
}

/// Random paint, phases all around the circle's seam.
static void make_rough(struct studio *s)
{
    const int count = s->plain->character.vertex_count;
    int *vertices = malloc((size_t)count * sizeof *vertices);
    float(*values)[2] = malloc((size_t)count * sizeof *values);
    uint32_t seed = 4711;
    assert_true(vertices && values);
    for (int i = 0; i < count; i++) {
        vertices[i] = i;
        for (int k = 0; k < 2; k++) {
            seed = 1664525u * seed + 1013904223u;
            values[i][k] = (float)(seed >> 8) / 16777216.0f - 0.5f;
        }
        values[i][1] += 3.14159265f;
    }
    const struct dab dab = {0, count, vertices, (const float(*)[2])values};
    history_begin(s->session.history, "Rough", 0);
    assert_done(edit_paint_new(s->session.document, 0, 2, count, &error));
    assert_done(edit_paint(s->session.document, 0, &dab, &error));
    history_end(s->session.history);
    free(vertices);
    free(values);
}

STUDIO_TEST(smoothing_reduces_variation)
{
    make_rough(s);
    frame(s);
    double rough[2], even[2], calm[2];
    variation(s, rough);
    session_key(&s->session, 'B', MOD_SHIFT);
    brush_of(s->session.editor)->radius = 0.25;
    hold(s, left_finger, MOD_SHIFT, 30); // advance, with Shift
    assert_string_equal(history_undo_label(s->session.history), "Smooth phase");
    variation(s, even);
    assert_true(even[0] < 0.3 * rough[0]);
    assert_near(even[1], rough[1], 1e-3 * rough[1]); // amplitudes stay
    panel_click(&s->session, "swing.smooth");
    hold(s, left_finger, 0, 30);
    variation(s, calm);
    assert_true(calm[1] < 0.3 * rough[1]);
    assert_near(calm[0], even[0], 1e-3 * rough[0]);
}

/// A drag of the brush's numbers is no edit, so that no undo step restores them.
STUDIO_TEST(esc_takes_back_the_brushs_radius_and_strength)
{
    static const char *const names[] = {"radius", "strength"};
    const struct brush *brush = brush_of(s->session.editor);
    session_key(&s->session, 'B', MOD_SHIFT);
    for (int i = 0; i < 2; i++) {
        const struct brush before = *brush;
        panel_drag(&s->session, names[i], 49);
        assert_near(i == 0 ? brush->radius : brush->strength, 0.49, 0.01);
        session_key(&s->session, KEY_ESCAPE, 0);
        panel_release(&s->session);
        assert_near(brush->radius, before.radius, 0);
        assert_near(brush->strength, before.strength, 0);
        assert_true(brush->on);
    }
}

STUDIO_TEST(the_map_is_shown_and_the_rest_of_the_stage_still_turns)
{
    struct editor *editor = s->session.editor;
    assert_int_equal(editor->stage->view.characters[0].map_coordinate, -1);
    session_key(&s->session, 'B', MOD_SHIFT);
    frame(s);
    assert_int_equal(editor->stage->view.characters[0].map_coordinate, 0);
    assert_int_equal(editor->stage->view.characters[0].map_axis, 0); // it moves along x most
    session_point(&s->session, left_finger);
    frame(s);
    assert_true(editor->stage->painting.covers);
    const double radius = brush_of(editor)->radius, strength = brush_of(editor)->strength;
    const float distance = camera_of(editor)->distance;
    s->session.mods = MOD_CTRL;
    session_wheel(&s->session, 1);
    s->session.mods = MOD_SHIFT;
    session_wheel(&s->session, -1);
    s->session.mods = 0;
    assert_true(brush_of(editor)->radius > radius && brush_of(editor)->strength < strength);
    assert_near((double)camera_of(editor)->distance, (double)distance, 0);
    const float azimuth = camera_of(editor)->azimuth;
    session_point(&s->session, "stage(0.95,0.5)");
    session_press(&s->session, BUTTON_LEFT, 1);
    session_drag(&s->session, -40, 0, 4);
    session_release(&s->session, BUTTON_LEFT);
    assert_true(camera_of(editor)->azimuth != azimuth);
    assert_int_equal((int)history_count(s->session.history), 0);
    session_key(&s->session, KEY_ESCAPE, 0);
    frame(s);
    assert_false(brush_of(editor)->on);
    assert_int_equal(editor->stage->view.characters[0].map_coordinate, -1);
}

/// A press that is released before a frame came paints all the same; paint for another model is left alone.
STUDIO_TEST(a_click_paints_and_foreign_paint_is_left_alone)
{
    session_key(&s->session, 'B', MOD_SHIFT);
    session_point(&s->session, left_finger);
    session_click_here(&s->session, 1);
    assert_true(mean_lead(s) > 0);
    history_begin(s->session.history, "Foreign", 0);
    assert_done(edit_paint_new(s->session.document, 0, 5, 7, &error));
    history_end(s->session.history);
    const uint64_t version = rig_of(s)->painted->version;
    frame(s);
    hold(s, left_finger, 0, 5);
    assert_int_equal(rig_of(s)->painted->version, version);
    assert_int_equal((int)history_count(s->session.history), 2);
}

/// On a ball the way over the surface is radius times angle.
TEST(distances_follow_the_surface)
{
    struct character ball = puppet_character(0.05f, 0);
    struct figure figure = puppet_figure(&ball);
    struct reach reach;
    struct pool pool = {0};
    reach_create(&reach, &pool, figure.character.vertex_count);
    const uint32_t *corner = figure.character.indices;
    const struct surface_spot spot = {{corner[0], corner[1], corner[2]}, {1, 0, 0}};
    for (int round = 0; round < 2; round++) { // nothing is left of the first one
        reach_find(&reach, &figure, &spot, 1, round == 0 ? 2.0f : 0.4f);
        const float *from = figure.character.position[corner[0]];
        int within = 0;
        for (int i = 0; i < figure.character.vertex_count; i++) {
            const float *p = figure.character.position[i];
            const float cosine = 4 * ((p[0] * from[0] + p[2] * from[2]) + (p[1] - 0.5f) * (from[1] - 0.5f));
            const float way = 0.5f * acosf(fmaxf(-1, fminf(1, cosine)));
            if (way > 0.05f && way < 0.35f) assert_near((double)reach.distance[i], (double)way, 0.1 * (double)way);
            if (round == 1 && way > 0.5f) assert_true(reach.distance[i] == INFINITY);
            within += reach.distance[i] < INFINITY;
        }
        assert_int_equal(within, reach.count);
        assert_true(round == 1 || within == figure.character.vertex_count);
    }
    pool_free(&pool);
    figure_free(&figure);
}

TESTS_BETWEEN(make_model, folder_remove)
