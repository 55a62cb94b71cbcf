/// OBJ files as they come: every form of a face, polygons, colours, continuations, and what must be refused with its line.
#include "model/surface.h"
#include "near.h"
#include "temporary.h"

static bool read_text(const char *text, struct surface *surface, struct error *error)
{
    return surface_read(temporary_file("form.obj", text, strlen(text)), surface, error);
}

TEST(all_forms_of_a_face)
{
    const char *text = "# a pyramid\r\nmtllib a.mtl\r\no thing\r\n"
                       "v 0 0 0\r\nv 1 0 0\nv 1 1e0 0\nv 0 1 0 1.0\nv .5 .5 \\\n 1\n"
                       "vt 0 0\nvn 0 0 1\ns off\nusemtl m\n"
                       "f 4/1/1 3/1/1 2/1/1 1/1/1\n" // a quad: two triangles
                       "f 1//1 2//1 5//1\nf 2/1 3/1 5/1\n\tf  3 4 -1 # counted backwards\n"
                       "f -2 -5 \\\r\n-1";
    struct surface s;
    assert_done(read_text(text, &s, &error));
    assert_int_equal(s.vertex_count, 5);
    assert_null(s.color);
    const uint32_t indices[] = {3, 2, 1, 3, 1, 0, 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4};
    assert_int_equal(s.index_count, 18);
    assert_memory_equal(s.indices, indices, sizeof indices);
    assert_near(s.position[4][2], 1, 0);
    surface_free(&s);
}

/// Some vertices have a colour: it is sRGB, and the others are white.
TEST(colours_become_linear)
{
    struct surface s;
    assert_done(read_text("v 0 0 0\nv 1 0 0 0.5 1 0\nv 0 1 0\nf 1 2 3\n", &s, &error));
    assert_non_null(s.color);
    assert_near(s.color[0][0], 1, 0);
    assert_near(s.color[1][0], 0.21404114, 1e-6); // the sRGB curve at a half
    assert_near(s.color[1][1], 1, 1e-6);
    assert_near(s.color[1][2], 0, 0);
    assert_near(s.color[2][2], 1, 0);
    surface_free(&s);
}

TEST(what_is_written_reads_back_equal)
{
    float position[3][3] = {{0.1f, -1e-20f, 3.4e38f}, {1.0f / 3, 16777214, 0}, {-0.25f, 7, 1e10f}};
    float color[3][3] = {{0, 1, 0.5f}, {0.001f, 0.2f, 0.9f}, {1, 1, 1}};
    uint32_t indices[] = {2, 0, 1};
    const struct surface out = {
        .position = position, .color = color, .vertex_count = 3, .indices = indices, .index_count = 3};
    struct surface in;
    const char *path = temporary_path("round.obj");
    assert_done(obj_write(path, &out, &error));
    assert_done(surface_read(path, &in, &error));
    assert_int_equal(in.vertex_count, 3);
    assert_memory_equal(in.position, position, sizeof position);
    assert_memory_equal(in.indices, indices, sizeof indices);
    for (int i = 0; i < 9; i++) assert_near(in.color[i / 3][i % 3], color[i / 3][i % 3], 1e-6);
    surface_free(&in);
    assert_refusal(obj_write("/nowhere/a.obj", &out, &error), "/nowhere/a.obj");
}

/// A triangle that names a vertex twice has no area: it is left out, and what is left of its polygon stays a polygon where it is a fan.
TEST(triangles_that_repeat_a_vertex_are_left_out)
{
    static const struct {
        const char *faces;
        int index_count;
        uint32_t indices[9];
        uint8_t joined[3];
    } cases[] = {
        {"f 1 2 1\nf 1 2 3\nf 2 2 3\nf 3 4 4\n", 3, {0, 1, 2}, {0}},
        {"f 1 2 3 4\nf 1 2 2\n", 6, {0, 1, 2, 0, 2, 3}, {0, 1}},
        {"f 1 2 3\nf 1 1 3 4\n", 6, {0, 1, 2, 0, 2, 3}, {0, 0}}, // a polygon of its own, not more of the one before
        {"f 1 2 3 3 4\n", 6, {0, 1, 2, 0, 2, 3}, {0, 1}},
        {"f 1 2 3/1 3/2 4\n", 6, {0, 1, 2, 0, 2, 3}, {0, 0}}, // whose textures do not meet
        {"f 1 2 3 1 4 5\n", 6, {0, 1, 2, 0, 3, 4}, {0, 0}},   // two that touch at a corner
        {"f 1 2 3\nf 4 4 4\nf 1 3 4 5\n", 9, {0, 1, 2, 0, 2, 3, 0, 3, 4}, {0, 0, 1}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[256];
        struct surface s;
        snprintf(text, sizeof text, "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\n%s",
                 cases[i].faces);
        assert_done(read_text(text, &s, &error));
        assert_int_equal(s.index_count, cases[i].index_count);
        assert_memory_equal(s.indices, cases[i].indices, (size_t)s.index_count * sizeof *s.indices);
        for (int t = 0; t < s.index_count / 3; t++)
            assert_int_equal(s.looks.joined ? s.looks.joined[t] : 0, cases[i].joined[t]);
        assert_int_equal(s.vertex_count, 5); // which are what motions refer to
        surface_free(&s);
    }
}

/// What a triangle looks like goes with it where others before it are left out.
TEST(looks_stay_with_their_triangles)
{
    struct surface s;
    assert_done(read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 1/3\n"
                          "usemtl b\nf 1/3 2/2 3/1\n",
                          &s, &error));
    const uint32_t corners[] = {2, 1, 0};
    assert_int_equal(s.index_count, 3);
    assert_memory_equal(s.looks.corner, corners, sizeof corners);
    assert_string_equal(s.looks.materials[s.looks.material[0]].name, "b");
    surface_free(&s);
    assert_done(read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nf 1/1 2/1 1/1\nf 1 2 3\n", &s, &error));
    assert_null(s.looks.uv); // which nothing has that is left
    surface_free(&s);
}

/// Names that are Latin-1 are UTF-8 from then on, because they go into JSON.
TEST(names_of_materials_are_utf8)
{
    struct surface s;
    assert_done(
        read_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl caf\xe9\nf 1 2 3\nusemtl x\nf 1 2 3\nusemtl caf\xe9\nf 3 2 1\n",
                  &s, &error));
    assert_int_equal(s.looks.material_count, 2);
    assert_string_equal(s.looks.materials[s.looks.material[2]].name, "caf\xef\xbf\xbd");
    surface_free(&s);
}

TEST(bad_files_get_one_sentence)
{
    const struct {
        const char *text, *says;
    } cases[] = {
        {"v 0 0\n", "form.obj:1: expected three coordinates of a vertex, got nothing"},
        {"v 0 0 0\nv 0 0 x1\n", "form.obj:2: expected a finite number, got 'x1'"},
        {"v 0 0 nan\n", "form.obj:1: expected a finite number, got 'nan'"},
        {"v 0 0 0\nv 0 0 0 1e30 0 0\n", "form.obj:2: expected a colour from 0 to 1, got 1e+30"},
        {"v 0 0 1e99\n", "form.obj:1: expected a finite number, got '1e99'"},
        {"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\n", "form.obj:4: expected a face of three corners or more, got 2"},
        {"v 0 0 0\nv 1 0 0\n\\\n\nf 1 2 3\n", "form.obj:5: expected a vertex from 1 to 2, got '3'"},
        {"v 0 0 0\nf 0 1 1\n", "form.obj:2: expected the number of a vertex, got '0'"},
        {"v 0 0 0\nf 1 -2 1\n", "form.obj:2: expected the number of a vertex, got '-2'"},
        {"v 0 0 0\nf 1 1x 1\n", "form.obj:2: expected the number of a vertex, got '1x'"},
        {"v 0 0 0\nf 1 99999999999999999999 1\n",
         "form.obj:2: expected the number of a vertex, got '99999999999999999999'"},
        {"", "expected an OBJ file with vertices, got none"},
        {"v 0 0 0\n", "expected an OBJ file with faces, got none"},
        {"v 0 0 0\nv 1 0 0\nf 1 2 1\n",
         "expected an OBJ file with faces of three different vertices, got others alone"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct surface s;
        struct error error = {0};
        assert_false(read_text(cases[i].text, &s, &error));
        if (!strstr(error.text, cases[i].says)) fail_msg("'%s' lacks '%s'", error.text, cases[i].says);
        assert_int_equal(error.kind, ERROR_INPUT);
        assert_null(s.position);
    }
    struct surface s;
    assert_refusal(surface_read(temporary_file("form.obj", "v 0\0 0", 6), &s, &error), "got binary data");
    assert_refusal(surface_read("/nowhere.obj", &s, &error), "/nowhere.obj: cannot be opened");
}
