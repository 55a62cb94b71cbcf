/// What paint makes of a figure.
#include "puppet.h"
#include "rig/posing.h"

/// Paint on a figure is e^{a + jψ} at each vertex; normals follow as if the model had been made so.
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
    struct figure plain = puppet_figure(&character), expected = puppet_figure(&made);
    struct painted *painted = painted_create(&plain);
    const struct morph morph = {1, {0}, {{0.7f, -0.6f}}};
    assert_non_null(painted);
    painted_update(painted, (const float(*)[2])paint);
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

/// A version tells whether anything has changed.
TEST(changes_are_noted)
{
    struct character character = puppet_character(0.06f, 2);
    struct figure plain = puppet_figure(&character);
    struct painted *painted = painted_create(&plain);
    const int vertices = plain.character.vertex_count;
    float(*paint)[2] = calloc(2 * (size_t)vertices, sizeof *paint);
    const uint64_t before = painted->figure.version;
    painted_update(painted, (const float(*)[2])paint);
    assert_true(painted->figure.version == before);
    paint[vertices + 5][1] = 0.5f;
    painted_update(painted, (const float(*)[2])paint);
    assert_true(painted->figure.version > before);
    painted_destroy(painted);
    figure_free(&plain);
    free(paint);
}
