/// The brush on a character's surface, by mouse and keys: what a stroke changes and what it leaves alone, its undo, its modes, and
/// the distances that it works with.
#include "folder.h"
#include "hands.h"
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

static int make_model(void **state)
{
    if (folder_make(state) != 0) return -1;
    struct character character = make_hand();
    puppet_write(&character, folder_path("hand.glb"));
    return 0;
}

static const struct figure *plain; ///< the character without paint

static const struct paint *paint_of(const struct session *s) { return first_model(s->document)->painted; }

/// With the brush on, unless a test is about how it is taken.
static void open_studio(struct session *s, bool takes_brush)
{
    char scene[700];
    snprintf(scene, sizeof scene,
             "{'wiggly': 1, 'frames': [0, 48], 'splines': [{'name': 's', 'frequency': 1, 'start': 'loop', 'knots': "
             "[<0 1>, <20 -1>]}], 'rigs': [{'type': 'character', 'name': 'hand', 'model': '%s', 'coordinates': "
             "[{'name': 'a', 'spline': 's'}]}]}",
             folder_path("hand.glb"));
    const struct models *models = panel_open_models(s, scene);
    plain = models_figure(models, s->document, 0);
    if (playback_of(s->editor)->playing) hands(s, "key Space");
    camera_of(s->editor)->azimuth = -1.5708f; // from the front
    hands(s, takes_brush ? "wait 1; key Shift+B" : "wait 1");
}

/// The middle of the front of a finger, 3/4 up.
#define LEFT "character(hand,0.2,0.75)"
#define RIGHT "character(hand,0.8,0.75)"

/// Holds the button on the left finger for so many frames.
static void stroke(struct session *s, const char *mods, int frames)
{
    hands(s, "with %s; press " LEFT "; wait %d; release; with; wait 1", mods, frames);
}

static const float *value_of(const struct session *s, int coordinate, int vertex)
{
    return paint_of(s)->values[coordinate * paint_of(s)->vertices + vertex];
}

/// Of the first coordinate's amplitudes (0) or phases (1): the least, the most and the mean.
static void survey(const struct session *s, int which, double found[3])
{
    const int count = paint_of(s)->vertices;
    memset(found, 0, 3 * sizeof *found);
    for (int i = 0; i < count; i++) {
        const double value = (double)value_of(s, 0, i)[which];
        found[0] = fmin(found[0], value);
        found[1] = fmax(found[1], value);
        found[2] += value / count;
    }
}

enum { LEAST, MOST, MEAN };

#define STUDIO_TEST(name) SESSION_TEST(name, open_studio(s, true))

STUDIO_TEST(a_stroke_changes_phase_where_it_is_and_nowhere_else)
{
    double found[3];
    brush_of(s->editor)->radius = 0.2; // 0.19 m: through the air it would reach the other finger
    stroke(s, "", 30);
    for (int i = 0; i < plain->character.vertex_count; i++) {
        const float *p = plain->character.position[i], *value = value_of(s, 0, i);
        assert_near(value[0], 0, 0);
        assert_near(value_of(s, 1, i)[1], 0, 0);
        if (p[0] > 0 || p[1] < 0.4f) assert_near(value[1], 0, 0);
    }
    survey(s, 1, found);
    assert_near(found[LEAST], 0, 0);
    // Half a second at 0.4 of a turn a second, but for what the surface has moved under the pointer meanwhile.
    assert_near(found[MOST], 0.5 * 0.4 * 6.2831853, 0.1);
    assert_int_equal((int)history_count(s->history), 1);
    hands(s, "label Advance phase");
}

/// Escape takes the stroke back, and the brush stays.
STUDIO_TEST(undo_and_redo_are_exact)
{
    const size_t size = 2 * (size_t)plain->character.vertex_count * sizeof(float[2]);
    float *once = malloc(size), *twice = malloc(size);
    assert_true(once && twice);
    stroke(s, "", 10);
    memcpy(once, paint_of(s)->values, size);
    hands(s, "carry " LEFT " 0 80 10");
    memcpy(twice, paint_of(s)->values, size);
    assert_true(memcmp(once, twice, size) != 0);
    hands(s, "key Ctrl+Z");
    assert_memory_equal(paint_of(s)->values, once, size);
    hands(s, "key Ctrl+Z");
    assert_null(paint_of(s));
    hands(s, "wait 1");
    assert_memory_equal(models_figure(s->work.models, s->document, 0)->character.coordinates[0].re,
                        plain->character.coordinates[0].re, (size_t)plain->character.vertex_count * sizeof(float[3]));
    hands(s, "key 2*Ctrl+Shift+Z");
    assert_memory_equal(paint_of(s)->values, twice, size);
    hands(s, "press " LEFT "; wait 5; key Escape");
    assert_memory_equal(paint_of(s)->values, twice, size);
    assert_true(brush_of(s->editor)->on);
    assert_int_equal((int)history_count(s->history), 2);
    free(once);
    free(twice);
}

/// Only the press, which makes room for the stroke, may allocate. Playing, as one paints.
STUDIO_TEST(a_stroke_allocates_nothing_as_it_goes_on)
{
    hands(s, "press " RIGHT "; wait 3; release; wait 1; key Space; press " LEFT "; wait 2");
    const long before = allocation_count();
    session_drag(s, 0, 120, 20);
    assert_int_equal(allocation_count() - before, 0);
}

SESSION_TEST(modes_and_modifiers_do_what_they_say, open_studio(s, false))
{
    double delayed[3], found[3];
    hands(s, "click paint.on");
    assert_true(brush_of(s->editor)->on);
    stroke(s, "Ctrl", 10);
    hands(s, "label Delay phase");
    survey(s, 1, delayed);
    assert_true(delayed[MEAN] < -1e-3);
    hands(s, "click phase.delay");
    stroke(s, "Ctrl", 10);
    hands(s, "label Advance phase");
    survey(s, 1, found);
    assert_true(fabs(found[MEAN]) < -0.1 * delayed[MEAN]); // all but what the surface moved meanwhile
    hands(s, "click swing.less");
    brush_of(s->editor)->strength = 1;
    for (int i = 0; i < 6; i++) stroke(s, "", 90);
    hands(s, "click erase.all; label Less amplitude");
    survey(s, 0, found);
    assert_near(exp(found[LEAST]), 0.01, 1e-4); // never turned round
    const double lessened = found[MEAN];
    stroke(s, "", 100);
    survey(s, 0, found);
    assert_true(found[MEAN] > 0.5 * lessened); // erased, but for what the surface has moved
    hands(s, "click paint.clean");
    assert_true(paint_is_plain(paint_of(s)));
    hands(s, "label Remove paint; key Ctrl+Z");
    assert_false(paint_is_plain(paint_of(s)));
}

/// Soft at the rim: half way out a moment of the brush does about half of what it does in the middle, near the rim hardly anything.
STUDIO_TEST(a_dab_fades_towards_its_rim)
{
    brush_of(s->editor)->radius = 0.2;
    stroke(s, "", 3);
    const struct reach *reach = &s->editor->stage->painting.work.reach;
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
    double found[3];
    brush_of(s->editor)->strength = 1;
    stroke(s, "", 120);
    survey(s, 1, found);
    assert_near(found[MOST], 1.5707963, 0.02);
    stroke(s, "", 120);
    survey(s, 1, found);
    assert_true(found[MOST] > 2 && found[MOST] < 3.1416); // the surface has moved under the pointer
    hands(s, "click swing.more");
    stroke(s, "Ctrl", 120);
    survey(s, 0, found);
    assert_near(exp(found[LEAST]), 0.25, 0.02);
}

/// Sum over all edges of the finger's middle of how much Ñ' differs in phase and in the logarithm of amplitude.
static void variation(const struct session *s, double sum[2])
{
    const struct figure *figure = models_figure(s->work.models, s->document, 0);
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
static void make_rough(struct session *s)
{
    const int count = plain->character.vertex_count;
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
    history_begin(s->history, "Rough", 0);
    assert_done(edit_paint_new(s->document, 0, 2, count, &error));
    assert_done(edit_paint(s->document, 0, &dab, &error));
    history_end(s->history);
    free(vertices);
    free(values);
}

STUDIO_TEST(smoothing_reduces_variation)
{
    double rough[2], even[2], calm[2];
    make_rough(s);
    session_frame(s);
    variation(s, rough);
    brush_of(s->editor)->radius = 0.25;
    stroke(s, "Shift", 30); // advance, with Shift
    hands(s, "label Smooth phase");
    variation(s, even);
    assert_true(even[0] < 0.3 * rough[0]);
    assert_near(even[1], rough[1], 1e-3 * rough[1]); // amplitudes stay
    hands(s, "click swing.smooth");
    stroke(s, "", 30);
    variation(s, calm);
    assert_true(calm[1] < 0.3 * rough[1]);
    assert_near(calm[0], even[0], 1e-3 * rough[0]);
}

/// A drag of the brush's numbers is no edit, so that no undo step restores them.
STUDIO_TEST(esc_takes_back_the_brushs_radius_and_strength)
{
    const struct brush *brush = brush_of(s->editor), before = *brush;
    hands(s, "slide radius 49");
    assert_near(brush->radius, 0.49, 0.01);
    hands(s, "key Escape; release");
    assert_near(brush->radius, before.radius, 0);
    hands(s, "slide strength 49");
    assert_near(brush->strength, 0.49, 0.01);
    hands(s, "key Escape; release");
    assert_near(brush->strength, before.strength, 0);
    assert_true(brush->on);
}

SESSION_TEST(the_map_is_shown_and_the_rest_of_the_stage_still_turns, open_studio(s, false))
{
    const struct stage *stage = s->editor->stage;
    const struct camera *camera = camera_of(s->editor);
    const struct brush *brush = brush_of(s->editor);
    assert_int_equal(stage->view.models[0].map_coordinate, -1);
    hands(s, "key Shift+B; wait 1");
    assert_int_equal(stage->view.models[0].map_coordinate, 0);
    assert_int_equal(stage->view.models[0].map_axis, 0); // it moves along x most
    hands(s, "hover " LEFT);
    assert_true(stage->painting.covers);
    const double radius = brush->radius, strength = brush->strength;
    const float distance = camera->distance, azimuth = camera->azimuth;
    hands(s, "with Ctrl; wheel 1; with Shift; wheel -1; with");
    assert_true(brush->radius > radius && brush->strength < strength);
    assert_near(camera->distance, distance, 0);
    hands(s, "carry stage(0.95,0.5) -40 0");
    assert_true(camera->azimuth != azimuth);
    assert_int_equal((int)history_count(s->history), 0);
    hands(s, "key Escape; wait 1");
    assert_false(brush->on);
    assert_int_equal(stage->view.models[0].map_coordinate, -1);
}

/// A press that is released before a frame came paints all the same; paint for another model is left alone.
STUDIO_TEST(a_click_paints_and_foreign_paint_is_left_alone)
{
    double found[3];
    hands(s, "click " LEFT);
    survey(s, 1, found);
    assert_true(found[MEAN] > 0);
    history_begin(s->history, "Foreign", 0);
    assert_done(edit_paint_new(s->document, 0, 5, 7, &error));
    history_end(s->history);
    const uint64_t version = paint_of(s)->version;
    session_frame(s);
    stroke(s, "", 5);
    assert_int_equal(paint_of(s)->version, version);
    assert_int_equal((int)history_count(s->history), 2);
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
