/// The paper's Figure 7 and the scenes with the character: what the committed model shows, and that every scene finds it.
#include "documents.h"

#include "rig/posing.h"
#include "scene/load.h"
#include <complex.h>

struct scene {
    struct document *document;
    struct models *models;
    const struct figure *figure;
};

static struct scene open_scene(const char *path)
{
    struct scene scene;
    scene.document = document_of_file(path);
    scene.models = models_create();
    assert_done(models_update(scene.models, scene.document, &error));
    scene.figure = models_figure(scene.models, 0);
    return scene;
}

static void close_scene(struct scene *scene)
{
    models_destroy(scene->models);
    document_destroy(scene->document);
}

/// Degrees by which a part leads x in its movement along an axis: the argument of the sum over its vertices.
static double lead(const struct figure *figure, const char *name, int axis, const float lo[3], const float hi[3])
{
    const struct coordinate *c = &figure->character.coordinates[figure_find(figure, name)];
    double complex sum = 0;
    for (int i = 0; i < figure->character.vertex_count; i++) {
        const float *p = figure->character.position[i];
        bool inside = true;
        for (int k = 0; k < 3; k++) inside = inside && lo[k] <= p[k] && p[k] <= hi[k];
        if (inside) sum += (double)c->re[i][axis] + I * (double)c->im[i][axis];
    }
    assert_true(cabs(sum) > 0);
    return carg(sum) * 180 / M_PI;
}

static const float head[2][3] = {{-0.3f, 1.2f, -1}, {0.3f, 2, 1}};
static const float left_hand[2][3] = {{0.6f, 0, -1}, {1, 2, 1}}, right_hand[2][3] = {{-1, 0, -1}, {-0.6f, 2, 1}};

#define FIGURE7_TEST(name)                                                                                           \
    TEST_OF(struct scene, scene, *scene = open_scene("assets/scenes/figure7.json"), close_scene(scene), name)

/// "The phase varies smoothly over the character, with the motion of the arms and hands being delayed significantly
/// compared to the body."
FIGURE7_TEST(hands_follow_the_body)
{
    const double body = lead(scene->figure, "up", 1, head[0], head[1]);
    const double left = lead(scene->figure, "up", 1, left_hand[0], left_hand[1]);
    const double right = lead(scene->figure, "up", 1, right_hand[0], right_hand[1]);
    assert_true(fabs(body) < 20);
    assert_true(body - left > 35 && body - left < 120);
    assert_true(fabs(left - right) < 15);
    assert_int_equal(document_character(scene->document, 0)->phases, 1);
}

/// Over no edge of the mesh does the movement turn by more than a few degrees where there is any to speak of.
FIGURE7_TEST(phases_are_smooth)
{
    const struct character *character = &scene->figure->character;
    const struct coordinate *up = &character->coordinates[figure_find(scene->figure, "up")];
    const double least = 0.1 * (double)scene->figure->largest[figure_find(scene->figure, "up")][1];
    for (int i = 0; i < character->index_count; i++) {
        const uint32_t a = character->indices[i], b = character->indices[i % 3 == 2 ? i - 2 : i + 1];
        const double complex from = (double)up->re[a][1] + I * (double)up->im[a][1];
        const double complex to = (double)up->re[b][1] + I * (double)up->im[b][1];
        if (cabs(from) < least || cabs(to) < least) continue;
        assert_true(fabs(carg(to / from)) * 180 / M_PI < 20);
    }
}

/// Eq. 30: one spline of nine knots moves both coordinates, one a quarter of a swing behind the other.
TEST_OF(struct scene, scene, *scene = open_scene("assets/scenes/character.json"), close_scene(scene),
        two_coordinates_follow_one_spline_of_nine_knots)
{
    const struct character_rig *rig = document_character(scene->document, 0);
    assert_int_equal(scene->document->spline_count, 1);
    assert_int_equal(scene->document->splines[0]->knot_count, 9);
    assert_int_equal(rig->drive_count, 2);
    assert_int_equal(rig->drives[0].spline, rig->drives[1].spline);
    assert_near(rig->drives[1].lag - rig->drives[0].lag, 90, 0);
}

/// Feet stay where they are, whatever the spline does, and the character stays in one piece: within reach of where it rests.
TEST(it_stands_on_its_feet)
{
    static const char *const paths[] = {"assets/scenes/figure7.json", "assets/scenes/up-down.json",
                                        "assets/scenes/side-to-side.json", "assets/scenes/character.json",
                                        "assets/scenes/compositing.json"};
    for (size_t s = 0; s < sizeof paths / sizeof *paths; s++) {
        struct scene scene = open_scene(paths[s]);
        struct evaluation evaluation = {0};
        const struct posing posing = {.document = scene.document, .evaluation = &evaluation, .models = scene.models};
        evaluation_update(&evaluation, scene.document, false);
        for (int i = 0; i < evaluation.samples; i++) {
            struct rig_pose pose;
            float lo[3], hi[3];
            assert_true(rig_pose(&posing, 0, i, NULL, &pose));
            rig_bounds(&pose, lo, hi);
            const float x = pose.character.position[0], y = pose.character.position[1];
            assert_near((double)lo[1], (double)y, 0.02);
            assert_true(hi[1] < y + 2.0f && hi[1] > y + 1.1f && hi[0] < x + 1.4f && lo[0] > x - 1.4f);
        }
        evaluation_free(&evaluation);
        close_scene(&scene);
    }
}

/// Of the mesh, each vertex moved by Re(z Ñ).
static double volume_at(const struct character *c, const struct coordinate *n, double complex z)
{
    double sum = 0;
    for (int i = 0; i < c->index_count; i += 3) {
        double p[3][3];
        for (int k = 0; k < 9; k++) {
            const uint32_t v = c->indices[i + k / 3];
            p[k / 3][k % 3] = (double)c->position[v][k % 3] + creal(z) * (double)n->re[v][k % 3] -
                              cimag(z) * (double)n->im[v][k % 3];
        }
        for (int k = 0; k < 3; k++) {
            const int l = (k + 1) % 3, m = (k + 2) % 3;
            sum += p[0][k] * (p[1][l] * p[2][m] - p[1][m] * p[2][l]) / 6;
        }
    }
    return sum;
}

/// Flesh keeps its volume: at amplitude 1 to 5 % in every phase, of every coordinate that the model has.
FIGURE7_TEST(it_keeps_its_volume)
{
    enum { PHASES = 36 };
    const struct character *c = &scene->figure->character;
    assert_int_equal(c->coordinate_count, 6);
    for (int k = 0; k < c->coordinate_count; k++) {
        const struct coordinate *n = &c->coordinates[k];
        const double rest = volume_at(c, n, 0);
        double least = 0, most = 0;
        for (int i = 0; i < PHASES; i++) {
            double change = volume_at(c, n, cexp(2 * M_PI * I * i / PHASES)) / rest - 1;
            least = fmin(least, change);
            most = fmax(most, change);
        }
        if (least < -0.05 || most > 0.05) fail_msg("%s: %.3f … %.3f of the volume", n->name, least, most);
    }
}
