/// Soft characters: equations 29 and 30, normals, paint, phases as colours, the lowest points; and what is said of models that
/// do not suit their scenes.
#include "model/vector.h"
#include "puppet.h"
#include "rig/import.h"
#include "scene/edit.h"
#include "scene/load.h"
#include "temporary.h"
#include "ui/theme.h"
#include <complex.h>
#include <malloc.h>

/// Every vertex moves in its own way.
static void stir(struct character *character)
{
    for (int k = 0; k < character->coordinate_count; k++) {
        for (int i = 0; i < 3 * character->vertex_count; i++) {
            character->coordinates[k].re[i / 3][i % 3] = sinf((float)(7 * i + 3 * k));
            character->coordinates[k].im[i / 3][i % 3] = cosf((float)(5 * i - 2 * k));
        }
    }
}

/// |z|² A + Re(z² B), where |z| is above `most` with most · (2 |z| − most) in place of |z|².
static double curve_of(const struct coordinate *c, double complex z, int vertex, int axis)
{
    const double r = cabs(z), square = r > c->most ? c->most * (2 * r - c->most) : r * r;
    const double complex b = (double)c->re2[vertex][axis] + I * (double)c->im2[vertex][axis];
    return square * (double)c->sq[vertex][axis] + square * creal(z * z / (r * r) * b);
}

/// D(j) = Re(Σ A_k e^{−j·lag_k} x_k Ñ_{k,j}) and curves, computed as it is written; real parts alone lose what lags. The box is that of all vertices,
/// and it stands on the rig's position.
TEST(positions_are_those_of_equation_30)
{
    struct character character = puppet_character(0.2f, 3);
    stir(&character);
    puppet_curve(&character, 2, 0.3, 0.5); // less than there is
    puppet_curve(&character, 0, 0.3, INFINITY);
    struct imported ball = puppet_imported(&character);
    const struct figure *figure = &ball.figure;
    const struct model_rig rig = {.drives = (struct drive[]){{.name = "c", .amplitude = 0.7, .lag = 40},
                                                             {.name = "not there", .amplitude = 9},
                                                             {.name = "a", .amplitude = -1.5, .lag = -100}},
                                  .drive_count = 3};
    const wiggly_value x[] = {{0.25, 0.6, -0.9}, {1, 1, 1}, {0, -0.3, 0.4}};
    const double complex values[2][2] = {
        {0.25 + cexp(-I * 40 * M_PI / 180) * (0.6 - 0.9 * I), cexp(I * 100 * M_PI / 180) * (-0.3 + 0.4 * I)},
        {0.25 + 0.6, -0.3}};
    for (int stiff = 0; stiff < 2; stiff++) {
        struct rig_pose posed = {
            .kind = RIG_MODEL, .imported = &ball, .model = puppet_pose(&ball, (const float[3]){5, 6, 7})};
        const struct morph *morph = &posed.model.morph;
        gltf_pose_clip(&ball.gltf, -1, 0, &ball.rest);
        pose_character(&rig, figure, x, stiff ? LOOK_STIFF : LOOK_WIGGLY, ball.rest.weights);
        posed.model.morph = figure_morph(figure, ball.rest.weights);
        assert_int_equal(morph->count, 2);
        float lo[3], hi[3];
        double most[3] = {-INFINITY, -INFINITY, -INFINITY}, least[3] = {INFINITY, INFINITY, INFINITY};
        rig_bounds(&posed, lo, hi);
        for (int i = 0; i < figure->character.vertex_count; i++) {
            float p[3], place[3];
            morph_vertex(figure, morph, i, p, NULL);
            figure_vertex(&posed.model, i, place);
            for (int k = 0; k < 3; k++) {
                const struct coordinate *c = &figure->character.coordinates[2],
                                        *a = &figure->character.coordinates[0];
                const double complex sum = 0.7 * values[stiff][0] * ((double)c->re[i][k] + I * (double)c->im[i][k]) -
                                           1.5 * values[stiff][1] * ((double)a->re[i][k] + I * (double)a->im[i][k]);
                const double curves =
                    curve_of(c, 0.7 * values[stiff][0], i, k) + curve_of(a, -1.5 * values[stiff][1], i, k);
                assert_near((double)p[k], (double)figure->character.position[i][k] + creal(sum) + curves, 1e-5);
                assert_near((double)place[k], (double)(p[k] + posed.model.root[12 + k]), 1e-6);
                most[k] = fmax(most[k], (double)p[k]);
                least[k] = fmin(least[k], (double)p[k]);
            }
        }
        for (int k = 0; k < 3; k++) {
            const double at = 5 + k - (k == 1 ? (double)figure->lo[1] : 0);
            assert_near(hi[k], most[k] + at, 1e-6);
            assert_near(lo[k], least[k] + at, 1e-6);
        }
    }
    imported_free(&ball);
}

/// Curves of 0 change no bit; and weights are continuous and once differentiable, also at `most`: small changes of z are what `by` says.
TEST(curves_of_zero_are_none_and_curves_are_smooth)
{
    struct character character = puppet_character(0.2f, 2);
    stir(&character);
    puppet_curve(&character, 1, 0, 0.5);
    struct figure figure = puppet_figure(&character);
    const double z[] = {1.3, -0.7};
    struct morph straight = {0}, curved = {0};
    morph_add(&straight, &figure, 0, z);
    morph_add(&curved, &figure, 1, z);
    for (int p = 0; p < COORDINATE_STRAIGHT; p++)
        memcpy(figure.character.coordinates[1].parts[p], figure.character.coordinates[0].parts[p],
               (size_t)figure.character.vertex_count * sizeof(float[3]));
    for (int i = 0; i < figure.character.vertex_count; i++) {
        float p[2][3];
        morph_vertex(&figure, &straight, i, p[0], NULL);
        morph_vertex(&figure, &curved, i, p[1], NULL);
        assert_memory_equal(p[0], p[1], sizeof p[0]);
    }
    const struct coordinate *c = &figure.character.coordinates[1];
    for (int i = 0; i < 60; i++) {
        static const double sizes[] = {0, 0.2, 0.4999999, 0.5, 0.5000001, 3}, step = 1e-7;
        const double at[] = {sizes[i % 6] * cos(i), sizes[i % 6] * sin(i)};
        double here[COORDINATE_PARTS], there[COORDINATE_PARTS], by[2][COORDINATE_PARTS];
        coordinate_weights(c, at, here, by);
        for (int k = 0; k < 2; k++) {
            for (int sign = -1; sign <= 1; sign += 2) {
                const double moved[] = {at[0] + (k == 0) * sign * step, at[1] + (k == 1) * sign * step};
                coordinate_weights(c, moved, there, NULL);
                for (int p = 0; p < COORDINATE_PARTS; p++)
                    assert_near((there[p] - here[p]) / (sign * step), by[k][p], 1e-6);
            }
        }
    }
    figure_free(&figure);
}

/// A deformation that is linear in space has the cofactors of 1 + Re(z M) everywhere: stretched, sheared and squeezed. A file's targets turn
/// normals likewise, where it is small. The same where it is curved.
TEST(normals_follow_the_deformation)
{
    static const float re[3][3] = {{0.5f, 0.3f, 0}, {0, 0.8f, -0.2f}, {0.1f, 0, -0.4f}};
    static const float im[3][3] = {{0, -0.4f, 0.2f}, {0.3f, 0, 0}, {0, 0.5f, 0.1f}};
    struct character character = puppet_character(0.04f, 1);
    for (int i = 0; i < 9 * character.vertex_count; i++) {
        const int v = i / 9, r = i % 9 / 3, c = i % 3;
        character.coordinates[0].re[v][r] += re[r][c] * character.position[v][c];
        character.coordinates[0].im[v][r] += im[r][c] * character.position[v][c];
    }
    assert_true(character_curve(&character, 0));
    struct coordinate *curved = character.coordinates;
    curved->most = INFINITY;
    for (int i = 0; i < 9 * character.vertex_count; i++) {
        const int v = i / 9, r = i % 9 / 3, c = i % 3;
        curved->sq[v][r] += 0.5f * im[c][r] * character.position[v][c];
        curved->re2[v][r] += 0.5f * re[c][r] * character.position[v][c];
        curved->im2[v][r] -= 0.25f * im[r][c] * character.position[v][c];
    }
    struct figure figure = puppet_figure(&character);
    const char *path = temporary_path("normals.glb");
    struct gltf gltf;
    struct gltf_pose pose;
    assert_done(character_write(path, &figure.character, true, &error));
    assert_done(gltf_read(path, &gltf, &error));
    assert_true(gltf_pose_create(&gltf, &pose));
    assert_int_equal(gltf_vertex_count(&gltf, 0), figure.character.vertex_count);
    float(*posed)[3] = malloc(2 * (size_t)figure.character.vertex_count * sizeof *posed);
    float(*normals)[3] = posed + figure.character.vertex_count;
    for (int small = 0; small < 2; small++) { // targets of a file are exact to first order
        const float size = small ? 0.02f : 1, square = size * size;
        struct morph morph = {0};
        morph_add(&morph, &figure, 0, (const double[2]){0.8 * (double)size, -0.6 * (double)size});
        mat3 m, cofactors; // columns
        for (int i = 0; i < 9; i++)
            m[i % 3][i / 3] = (float)(i % 4 == 0) + size * (0.8f * re[i / 3][i % 3] + 0.6f * im[i / 3][i % 3]) +
                              square * (0.5f * im[i % 3][i / 3] + 0.28f * 0.5f * re[i % 3][i / 3] -
                                        0.96f * 0.25f * im[i / 3][i % 3]);
        glm_mat3_inv(m, cofactors);
        glm_mat3_transpose(cofactors); // but for the determinant, which is positive
        for (int k = 0; k < COORDINATE_PARTS; k++) pose.weights[k] = (k == 4 ? -1 : 1) * morph.weight[0][k];
        gltf_pose_vertices(&gltf, &pose, 0, posed, normals);
        for (int i = 0; i < figure.character.vertex_count; i++) {
            float p[3], n[3];
            vec3 expected;
            morph_vertex(&figure, &morph, i, p, n);
            glm_mat3_mulv(cofactors, figure.character.normal[i], expected);
            glm_vec3_normalize(expected);
            assert_near(glm_vec3_dot(expected, n), 1.0, 0.002); // 3.6°
            for (int k = 0; k < 3; k++) assert_near(posed[i][k], p[k], 1e-6);
            for (int k = 0; k < 3 && small; k++) assert_near(normals[i][k], expected[k], 0.003);
        }
    }
    free(posed);
    gltf_pose_free(&pose);
    gltf_free(&gltf);
    figure_free(&figure);
}

/// Vertices at one place and with one normal share their neighbours; where a triangle has two of them, they are no neighbours of themselves.
TEST(a_triangle_between_vertices_at_one_place)
{
    const float position[4][3] = {{0}, {0}, {1, 0, 0}, {0}};
    const uint32_t indices[] = {0, 1, 2, 1, 3, 0};
    struct surface surface = {.position = memcpy(malloc(sizeof position), position, sizeof position),
                              .vertex_count = 4,
                              .indices = memcpy(malloc(sizeof indices), indices, sizeof indices),
                              .index_count = 6};
    struct character character;
    struct figure figure;
    assert_true(character_create(&character, &surface, 0));
    mallopt(M_PERTURB, 0x5a); // what nobody has written is no vertex
    figure_create(&figure, &character);
    mallopt(M_PERTURB, 0);
    for (int v = 0; v < 4; v++) {
        assert_int_equal(figure.edges.first[v + 1] - figure.edges.first[v], 3);
        for (int e = figure.edges.first[v]; e < figure.edges.first[v + 1]; e++)
            assert_true(figure.edges.other[e] < 4 && figure.edges.other[e] != (uint32_t)v);
    }
    figure_free(&figure);
}

TEST(a_figure_knows_where_it_stands)
{
    struct character character = puppet_character(0.05f, 2);
    for (int i = 0; i < character.vertex_count; i++) {
        character.coordinates[1].re[i][2] = 3 * character.position[i][1];
        character.coordinates[1].im[i][2] = 4 * character.position[i][1];
    }
    struct figure figure = puppet_figure(&character);
    assert_near((double)figure.lo[1], 0, 0.01);
    assert_near((double)figure.hi[1], 1, 0.01);
    assert_true(figure.soles[0].radius > 0 && figure.soles[0].radius < 0.5f);
    assert_near((double)figure.largest[1][2], 5, 0.05);
    assert_near((double)figure.largest[0][2], 0, 0);
    assert_int_equal(figure_find(&figure, "b"), 1);
    assert_int_equal(figure_find(&figure, "c"), -1);
    figure_free(&figure);
}

/// Oklab of a linear colour, from the definition.
static void oklab_of(const float rgb[3], double lab[3])
{
    static const double to_lms[3][3] = {{0.4122214708, 0.5363325363, 0.0514459929},
                                        {0.2119034982, 0.6806995451, 0.1073969566},
                                        {0.0883024619, 0.2817188376, 0.6299787005}};
    static const double to_lab[3][3] = {{0.2104542553, 0.7936177850, -0.0040720468},
                                        {1.9779984951, -2.4285922050, 0.4505937099},
                                        {0.0259040371, 0.7827717662, -0.8086757660}};
    double lms[3];
    for (int r = 0; r < 3; r++) {
        lms[r] = 0;
        for (int c = 0; c < 3; c++) lms[r] += to_lms[r][c] * (double)rgb[c];
        lms[r] = cbrt(lms[r]);
    }
    for (int r = 0; r < 3; r++) lab[r] = to_lab[r][0] * lms[0] + to_lab[r][1] * lms[1] + to_lab[r][2] * lms[2];
}

TEST(the_phase_map_is_even_and_cyclic)
{
    double before[3] = {0};
    for (int i = 0; i <= 360; i++) {
        const float angle = (float)(i * M_PI / 180);
        float rgb[3];
        double lab[3];
        phase_color_linear(cosf(angle), sinf(angle), rgb);
        for (int k = 0; k < 3; k++) assert_true(rgb[k] >= 0.0f && rgb[k] <= 1.0f);
        oklab_of(rgb, lab);
        assert_near(lab[0], 0.70 + 0.22 * cos((double)angle - 65 * M_PI / 180), 1e-4);
        assert_near(remainder(atan2(lab[2], lab[1]) - (double)angle - M_PI / 2, 2 * M_PI), 0, 1e-3);
        const double step = hypot(lab[1] - before[1], lab[2] - before[2]);
        if (i > 0) assert_near(step, 0.10 * 2 * sin(M_PI / 360), 1e-4);
        memcpy(before, lab, sizeof before);
    }
    const uint32_t still = phase_color(0, 0);
    assert_int_equal(still >> 24, still >> 16 & 0xFF);
    assert_int_equal(still >> 24, still >> 8 & 0xFF);
}

// --- paint

/// Paint on a figure is e^{a + jψ} at each vertex; normals follow as if the model had been made so. A version tells whether anything has changed.
TEST(paint_turns_and_scales_coordinates)
{
    struct character character = puppet_character(0.1f, 1), made = puppet_character(0.1f, 1);
    const int vertices = character.vertex_count;
    float(*paint)[2] = calloc((size_t)vertices, sizeof *paint);
    for (int i = 0; i < vertices; i++) {
        const float *p = character.position[i];
        paint[i][0] = 0.4f * p[0];
        paint[i][1] = p[1] > 0.5f ? p[1] - 0.5f : 0;
        for (int k = 0; k < 3; k++) {
            character.coordinates[0].re[i][k] = 0.2f * p[(k + 1) % 3];
            character.coordinates[0].im[i][k] = -0.1f * p[k];
        }
        const float size = expf(paint[i][0]), c = size * cosf(paint[i][1]), s = size * sinf(paint[i][1]);
        for (int k = 0; k < 3; k++) {
            const float re = character.coordinates[0].re[i][k], im = character.coordinates[0].im[i][k];
            made.coordinates[0].re[i][k] = c * re - s * im;
            made.coordinates[0].im[i][k] = s * re + c * im;
        }
    }
    puppet_curve(&character, 0, 0.1, 0.5);
    assert_true(character_curve(&made, 0));
    made.coordinates[0].most = 0.5;
    for (int i = 0; i < 3 * vertices; i++) { // |z|² A and z² B with z e^{a + jψ} for z
        const int v = i / 3, k = i % 3;
        const struct coordinate *from = character.coordinates, *to = made.coordinates;
        const float size = expf(2 * paint[v][0]), c = size * cosf(2 * paint[v][1]), s = size * sinf(2 * paint[v][1]);
        to->sq[v][k] = size * from->sq[v][k];
        to->re2[v][k] = c * from->re2[v][k] - s * from->im2[v][k];
        to->im2[v][k] = s * from->re2[v][k] + c * from->im2[v][k];
    }
    struct figure plain = puppet_figure(&character), expected = puppet_figure(&made);
    struct painted *painted = painted_create(&plain);
    struct morph morph = {0};
    morph_add(&morph, &plain, 0, (const double[2]){0.7, -0.6});
    assert_non_null(painted);
    for (int turn = 0; turn < 3; turn++) { // none, some, the same
        const uint64_t before = painted->figure.version;
        painted_update(painted, turn ? (const float(*)[2])paint : NULL);
        assert_int_equal(painted->figure.version > before, turn == 1);
    }
    for (int i = 0; i < vertices; i++) {
        float p[3], n[3], q[3], m[3];
        morph_vertex(&painted->figure, &morph, i, p, n);
        morph_vertex(&expected, &morph, i, q, m);
        for (int k = 0; k < 3; k++) {
            assert_near((double)p[k], (double)q[k], 1e-5);
            assert_near((double)n[k], (double)m[k], 1e-4);
        }
    }
    painted_update(painted, NULL);
    assert_memory_equal(painted->figure.character.coordinates[0].re, plain.character.coordinates[0].re,
                        (size_t)vertices * sizeof(float[3]));
    assert_memory_equal(painted->figure.slopes, plain.slopes, (size_t)vertices * sizeof *plain.slopes);
    painted_destroy(painted);
    figure_free(&plain);
    figure_free(&expected);
    free(paint);
}

// --- scenes and their models

/// A scene in which two splines swing; `rigs` has %s for a model's path.
static struct document *scene_of(const char *rigs, const char *model)
{
    char text[2048];
    struct document *document;
    const int size = snprintf(text, sizeof text,
                              "{\"wiggly\": 1, \"frames\": [0, 60], \"substeps\": 3, \"splines\": [{\"name\": \"s\", "
                              "\"knots\": [{\"frame\": 0,"
                              " \"value\": 0.3}, {\"frame\": 4, \"value\": -0.4}]}, {\"name\": \"t\", "
                              "\"equilibrium\": 0.2, \"start\": \"rest\","
                              " \"frequency\": 3, \"knots\": [{\"frame\": 3, \"value\": 0.6}]}], \"rigs\": [");
    snprintf(text + size, sizeof text - (size_t)size, rigs, model, model);
    strcat(text, "]}");
    assert_done(document = scene_parse("scene.json", text, strlen(text), NULL, &error));
    return document;
}

#define DRIVEN(coordinates)                                                                                          \
    "{\"type\": \"character\", \"model\": \"%s\", \"position\": [1, 0.1, 2], \"coordinates\": [" coordinates "]}"
#define A_AND_B                                                                                                      \
    "{\"name\": \"a\", \"spline\": \"s\", \"lag\": 30}, {\"name\": \"b\", \"spline\": \"t\", \"amplitude\": 0.5}"

static const char *write_ball(const char *name, float cell, int coordinates, int curved)
{
    struct character ball = puppet_character(cell, coordinates);
    stir(&ball);
    for (int k = 0; k < curved; k++) puppet_curve(&ball, k, 0.5, 0.3);
    for (int k = 0; k < coordinates; k++) {
        ball.coordinates[k].frequency = 1.23456;
        ball.coordinates[k].damping = 0.0712345;
    }
    const char *path = temporary_path(name);
    puppet_write(&ball, path);
    return path;
}

/// Returns the height of the lowest vertex, and that is the one that it is said to be. A pin at a vertex is where that is drawn.
static double check_vertices(const struct posing *posing, int sample, int lowest)
{
    struct rig_pose posed;
    double least = INFINITY, own = NAN;
    assert_true(rig_pose(posing, 0, sample, &posed));
    for (int v = 0; v < posed.model.figure->character.vertex_count; v++) {
        float at[3];
        figure_vertex(&posed.model, v, at);
        least = fmin(least, (double)at[1]);
        if (v == lowest) own = (double)at[1];
        if (v != sample) continue;
        const struct pin pin = {.frame = sample / 3.0, .point = v};
        const struct pin_query query = {.pin = &pin};
        const struct model_source source = posing->evaluation->models;
        struct pin_point point;
        assert_true(source.find(source.context, posing->evaluation, posing->document, &query, NULL, &point));
        for (int k = 0; k < 3; k++) assert_near(point.at[k], at[k], 1e-5);
    }
    assert_near(own, least, 1e-5);
    return least;
}

static void find_lowest(int curved)
{
    const double ceilings[] = {9, -0.05, -9};
    struct document *document = scene_of(DRIVEN(A_AND_B), write_ball("low.glb", 0.1f, 2, curved));
    struct models *models = models_create();
    struct evaluation evaluation = {.models = models_source(models)};
    assert_done(models_update(models, document, &error));
    evaluation_update(&evaluation, document, false);
    const struct model_source source = models_source(models);
    const struct posing posing = {.document = document, .evaluation = &evaluation, .models = models};
    const int samples = evaluation.samples;
    double *room = malloc((size_t)LOW_POINT_ROOM * (size_t)low_point_samples(samples) * sizeof *room);
    double *least = malloc((size_t)samples * sizeof *least);
    struct low_point *low = malloc((size_t)samples * sizeof *low);
    for (int c = 0; c < 3; c++) {
        int below = 0;
        assert_true(source.lowest(source.context, &evaluation, document, 0, ceilings[c], room, low));
        for (int i = 0; i < samples; i++) {
            below += low[i].vertex >= 0;
            if (c == 0) least[i] = check_vertices(&posing, i, low[i].vertex);
            assert_near(low[i].height, fmin(least[i], ceilings[c]), 1e-5);
        }
        assert_int_equal(below == samples, c == 0);
        assert_int_equal(below == 0, c == 2);
    }
    free(room);
    free(least);
    free(low);
    evaluation_free(&evaluation);
    models_destroy(models);
    document_destroy(document);
}

/// At each sample the lowest vertex is the lowest of all, but none above the ceiling; with one, two or no curved coordinates.
TEST(the_lowest_vertex_of_each_sample)
{
    for (int curved = 0; curved <= 2; curved++) find_lowest(curved);
}

/// The scene stays as it is, the first of all troubles is said in a sentence, and what can be read is there.
TEST(models_that_do_not_suit_their_scene)
{
#define MODEL(name, more)                                                                                            \
    "{\"type\": \"model\", \"name\": \"" name "\", \"model\": \"assets/models/dog.glb\"" more "}"
#define CHAIN(from, to, more)                                                                                        \
    "{\"type\": \"chain\", \"model\": \"dog\", \"from\": \"" from "\", \"to\": \"" to "\", \"channels\": []" more "}"
    static const struct {
        const char *rigs, *says; ///< "": nothing
        bool has_figure;
    } rows[] = {
        {DRIVEN(A_AND_B), "", true},
        {DRIVEN("{\"name\": \"z\", \"spline\": \"s\"}"),
         "ball.glb: expected a coordinate called \"z\", got others, such as a", true},
        {"{\"type\": \"character\", \"model\": \"/nowhere/at-all.glb\", \"coordinates\": []}", "/nowhere/at-all.glb",
         false},
        {"{\"type\": \"character\", \"model\": \"tests/rig/test_morph.c\", \"coordinates\": []}",
         "test_morph.c: ", false},
        {DRIVEN(A_AND_B) ", {\"type\": \"model\", \"model\": \"/nowhere/dog.glb\"}", "/nowhere/dog.glb", true},
        {DRIVEN(A_AND_B) ", " MODEL("dog", ", \"clip\": \"Run\""),
         "dog.glb: expected a clip called \"Run\", got others, such as Walk", true},
        {DRIVEN(A_AND_B) ", " MODEL("dog", ", \"clip\": \"Walk\"") ", " CHAIN("tail_1", "tail_8", ""), "", true},
        {MODEL("dog", ", \"pins\": [{\"frame\": 3, \"vertex\": 5, \"to\": [0, 0, 0]}]"),
         "dog.glb: expected a soft mesh for its pins, got none", false},
        {MODEL("dog", ", \"floor\": -0.1"), "dog.glb: expected a soft mesh for its floor, got none", false},
        {DRIVEN(A_AND_B) ", " MODEL("dog", "") ", " CHAIN("tail_1", "wing", ""), "expected a bone called \"wing\"",
         true},
        {MODEL("dog", "") ", " CHAIN("tail_1", "tail_8",
                                     ", \"pins\": [{\"frame\": 2.5, \"joint\": 8, \"to\": [0, 0, 0]}]"),
         "tail_1: expected a joint from 0 to 7 in the pin at frame 2.5, got 8", false},
        {MODEL("dog", "") ", " CHAIN("tail_1", "tail_8",
                                     ", \"pins\": [{\"frame\": 2.5, \"joint\": 7, \"to\": [0, 0, 0]}]"),
         "", false},
    };
    const char *ball = write_ball("ball.glb", 0.2f, 2, 0);
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        struct document *document = scene_of(rows[r].rigs, ball);
        struct models *models = models_create();
        struct error error = {0};
        const bool suits = models_update(models, document, &error);
        if (suits != !rows[r].says[0] || !strstr(error.text, rows[r].says))
            fail_msg("'%s', expected '%s'", error.text, rows[r].says);
        assert_int_equal(models_figure(models, document, 0) != NULL, rows[r].has_figure);
        for (int i = 1; i < document->rig_count; i++) assert_null(models_figure(models, document, i));
        models_destroy(models);
        document_destroy(document);
    }
    assert_null(models_figure(NULL, NULL, 0));
}

/// A model is read once, and again when its file was written anew. Paint on the second of two characters moves that one alone; paint for
/// another model is said and left.
TEST(models_follow_files_and_paint)
{
    struct document *document = scene_of(DRIVEN(A_AND_B) ", " DRIVEN(A_AND_B), write_ball("twins.glb", 0.2f, 2, 0));
    struct models *models = models_create();
    assert_done(models_update(models, document, &error));
    assert_true(models_suit(models, document));
    const struct figure *plain = models_figure(models, document, 0);
    const int vertices = plain->character.vertex_count;
    const uint64_t id = plain->id;
    assert_ptr_equal(models_figure(models, document, 1), plain);
    assert_true(edit_paint_new(document, 1, 2, vertices, NULL));
    struct paint *paint = document->rigs[1]->model.painted;
    for (int i = 0; i < 2 * vertices; i++) paint->values[i][0] = logf(3);
    models_follow(models, document);
    assert_ptr_equal(models_figure(models, document, 0), plain);
    const struct figure *painted = models_figure(models, document, 1);
    assert_near(painted->character.coordinates[1].re[7][1], 3 * plain->character.coordinates[1].re[7][1], 1e-5);
    paint->values[vertices + 7][0] = 0;
    models_follow(models, document);
    assert_near(painted->character.coordinates[1].re[7][1], 3 * plain->character.coordinates[1].re[7][1], 1e-5);
    paint->version++;
    models_follow(models, document);
    assert_near(painted->character.coordinates[1].re[7][1], plain->character.coordinates[1].re[7][1], 1e-5);
    assert_done(models_update(models, document, &error));
    assert_true(models_figure(models, document, 0)->id == id);
    write_ball("twins.glb", 0.1f, 2, 0);
    assert_refusal(models_update(models, document, &error), "paint: expected paint for the 2 coordinates of ");
    assert_true(models_figure(models, document, 0)->id != id &&
                models_figure(models, document, 0)->character.vertex_count > vertices);
    models_follow(models, document);
    assert_ptr_equal(models_figure(models, document, 1), models_figure(models, document, 0));
    models_destroy(models);
    document_destroy(document);
}

/// With its first coordinate's frequency and damping, by numbers that one would write, and a knot so that it swings at once.
TEST(a_soft_character_opens_as_a_scene)
{
    struct document *document;
    assert_done(document = import_scene(write_ball("soft.glb", 0.2f, 2, 0), &error));
    const struct model_rig *rig = &document->rigs[0]->model;
    assert_int_equal(document->spline_count, 1);
    const struct spline *spline = document->splines[0];
    assert_near(spline->parameter[PARAMETER_FREQUENCY].value, 1.23, 1e-12);
    assert_near(spline->parameter[PARAMETER_DAMPING].value, 0.071, 1e-12);
    assert_int_equal(spline->knot_count, 1);
    assert_near(spline->knots[0].value, 0.5, 0);
    assert_int_equal(rig->drive_count, 1);
    assert_string_equal(rig->drives[0].name, "a");
    assert_near(rig->drives[0].amplitude, DRIVE_DEFAULT_AMPLITUDE, 0);
    document_destroy(document);
}
