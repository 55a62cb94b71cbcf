/// creature.glb: what is written reads back equal; what other programs write reads too; what is broken is refused.
#include "gltf_builder.h"
#include "model/character.h"

/// A tetrahedron with two coordinates and coloured corners.
static void make_character(struct character *c)
{
    float position[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    float color[4][3] = {{1, 0.5f, 0}, {1, 1, 1}, {0.25f, 0, 1}, {0, 0, 0}};
    uint32_t indices[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    struct surface surface = {.position = memcpy(malloc(sizeof position), position, sizeof position),
                              .color = memcpy(malloc(sizeof color), color, sizeof color),
                              .vertex_count = 4,
                              .indices = memcpy(malloc(sizeof indices), indices, sizeof indices),
                              .index_count = 12};
    assert_true(character_create(c, &surface, 2));
    for (int n = 0; n < 24; n++) {
        c->coordinates[n / 12].re[n / 3 % 4][n % 3] = (float)sin(n);
        c->coordinates[n / 12].im[n / 3 % 4][n % 3] = (float)cos(n);
    }
    c->coordinates[0].name = strdup("up");
    c->coordinates[1].name = strdup("g\xc3\xb6 \"left\"");
    c->coordinates[0].frequency = 1.8 / 0.7;
    c->coordinates[0].damping = 0.04;
    c->coordinates[1].explained = 0.99;
    c->coordinates[1].pca1 = 0.6;
    c->coordinates[1].pca2 = 0.98;
}

static void read_good(const char *path, struct character *c) { assert_done(character_read(path, c, &error)); }

TEST(what_is_written_reads_back_equal)
{
    struct character out, in;
    make_character(&out);
    assert_done(character_write(temporary_path("character.glb"), &out, true, &error));
    read_good(temporary_path("character.glb"), &in);
    assert_int_equal(in.vertex_count, 4);
    assert_int_equal(in.index_count, 12);
    assert_int_equal(in.coordinate_count, 2);
    assert_memory_equal(in.position, out.position, 4 * sizeof *in.position);
    assert_memory_equal(in.normal, out.normal, 4 * sizeof *in.normal);
    assert_memory_equal(in.color, out.color, 4 * sizeof *in.color);
    assert_memory_equal(in.indices, out.indices, 12 * sizeof *in.indices);
    for (int i = 0; i < 2; i++) {
        const struct coordinate *a = &in.coordinates[i], *b = &out.coordinates[i];
        assert_string_equal(a->name, b->name);
        assert_memory_equal(a->re, b->re, 4 * sizeof *a->re);
        assert_memory_equal(a->im, b->im, 4 * sizeof *a->im);
        assert_near(a->frequency, b->frequency, 0);
        assert_near(a->damping, b->damping, 0);
        assert_near(a->explained, b->explained, 0);
        assert_near(a->pca1, b->pca1, 0);
        assert_near(a->pca2, b->pca2, 0);
    }
    character_free(&out);
    character_free(&in);
}

/// The deformation that a viewer makes of the morph targets is Re(z Ñ): the imaginary target is −Im Ñ.
TEST_OF(struct character, c, make_character(c), character_free(c), the_imaginary_target_is_negated)
{
    assert_done(character_write(temporary_path("sign.glb"), c, true, &error));
    FILE *file = fopen(temporary_path("sign.glb"), "rb");
    float last[12];
    fseek(file, -3 * (long)sizeof last,
          SEEK_END); // the last imaginary part, before how it turns normals and as many bytes of indices
    assert_int_equal(fread(last, sizeof last, 1, file), 1);
    fclose(file);
    for (int n = 0; n < 12; n++) assert_near(last[n], -c->coordinates[1].im[n / 3][n % 3], 0);
}

TEST_OF(struct character, c, make_character(c), character_free(c), normals_point_outwards)
{
    for (int i = 0; i < 4; i++) {
        double length = 0, outwards = 0;
        for (int k = 0; k < 3; k++) {
            length += (double)c->normal[i][k] * c->normal[i][k];
            outwards += (double)c->normal[i][k] * (c->position[i][k] - 0.25);
        }
        assert_near(length, 1, 1e-6);
        assert_true(outwards > 0);
    }
}

/// A .glb of this JSON, with ' for ", and these bytes.
static const char *glb(const char *json, const void *bin, size_t bin_size)
{
    static char data[8192];
    return temporary_file("other.glb", data, put_glb(data, json, bin, bin_size));
}

/// What another exporter may write: interleaved positions and byte colours with alpha, short indices, two primitives, a
/// target that is sparse and one that is left out, and other targets between ours.
TEST(a_file_of_another_program)
{
    const struct {
        float position[3];
        uint8_t color[4];
    } vertices[3] = {{{0, 0, 0}, {255, 0, 51, 255}}, {{1, 0, 0}, {0, 0, 0, 255}}, {{0, 0, -1}, {0, 255, 0, 0}}};
    const uint16_t place = 1;
    const float target[3] = {0.5f, 0, 2};
    struct builder b = {0};
    char sparse[256];
    add_view(&b, vertices, sizeof vertices, sizeof *vertices);
    add_accessor(&b, FLOAT, "VEC3", 3, ",'bufferView':0");
    add_accessor(&b, UBYTE, "VEC4", 3, ",'bufferView':0,'byteOffset':12,'normalized':true");
    ADD(&b, USHORT, uint16_t, 1, 2, 1, 0);
    snprintf(sparse, sizeof sparse,
             ",'sparse':{'count':1,'indices':{'bufferView':%d,'componentType':5123},'values':{'bufferView':%d}}",
             add_view(&b, &place, sizeof place, 0), add_view(&b, target, sizeof target, 0));
    add_accessor(&b, FLOAT, "VEC3", 3, sparse);
    struct character c;
    read_good(write_built(&b, "other.gltf",
                          "'nodes':[{'mesh':1}],'meshes':[{'primitives':[{'attributes':{}}]},{'primitives':[{"
                          "'attributes':{'POSITION':0,'COLOR_0':1},'indices':2,'targets':[{},{'POSITION':3},{}]},"
                          "{'attributes':{'POSITION':0},'targets':[{},{},{}]}],"
                          "'extras':{'targetNames':['up.re','up.im','smile']}}]"),
              &c);
    assert_int_equal(c.vertex_count, 6);
    assert_int_equal(c.coordinate_count, 1);
    const uint32_t indices[] = {2, 1, 0, 3, 4, 5};
    assert_int_equal(c.index_count, 6);
    assert_memory_equal(c.indices, indices, sizeof indices);
    assert_near(c.color[0][2], 0.2, 1e-6);
    assert_near(c.color[3][2], 1, 0);
    assert_near(c.normal[0][1], -1, 0); // computed
    assert_string_equal(c.coordinates[0].name, "up");
    assert_near(c.coordinates[0].frequency, 0, 0);
    assert_near(c.coordinates[0].re[1][2], 0, 0);
    assert_near(c.coordinates[0].im[1][2], -2, 0);
    assert_near(c.coordinates[0].im[0][2], 0, 0);
    character_free(&c);
}

/// A mesh whose node is scaled and mirrored, under a parent that turns it by a quarter about y and lifts it.
TEST(a_mesh_stands_where_its_node_puts_it)
{
    struct builder b = {0};
    struct character c;
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    read_good(write_built(&b, "placed.gltf",
                          "'nodes':[{'mesh':0,'scale':[-2,2,2]},{'children':[0],'translation':[0,5,0],"
                          "'rotation':[0,0.7071067811865476,0,0.7071067811865476]}],'meshes':[{'primitives':[{"
                          "'attributes':{'POSITION':0},'targets':[{'POSITION':0},{}]}],"
                          "'extras':{'targetNames':['a.re','a.im']}}]"),
              &c);
    assert_near(c.position[1][1], 5, 1e-6);
    assert_near(c.position[1][2], 2, 1e-6); // x is mirrored to -2, which the quarter turn makes +2 in z
    assert_near(c.position[2][0], 2, 1e-6);
    assert_near(c.coordinates[0].re[2][0], 2, 1e-6);
    assert_near(c.coordinates[0].re[2][1], 0, 1e-6); // not lifted
    assert_int_equal(c.indices[1], 2);               // the mirror turns the triangle round
    assert_near(c.normal[0][1], -1, 1e-6);           // (c - a) x (b - a) of the placed triangle
    character_free(&c);
}

static void assert_refused(const char *path, const char *says)
{
    struct character c;
    assert_refusal(character_read(path, &c, &error), says);
    assert_null(c.position);
}

/// They have no area, and edges from a vertex to itself; what is left keeps its material.
TEST(triangles_that_repeat_a_vertex_are_left_out)
{
#define REPEATS(indices)                                                                                             \
    "'nodes':[{'mesh':0}],'materials':[{'name':'red'}],'meshes':[{'primitives':[{'attributes':{'POSITION':0},"       \
    "'indices':" indices ",'material':0}]}]"
    struct builder b = {0};
    struct character c;
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    ADD(&b, USHORT, uint16_t, 1, 0, 1, 0, 0, 1, 2);
    ADD(&b, USHORT, uint16_t, 1, 0, 1, 0);
    read_good(write_built(&b, "repeats.gltf", REPEATS("1")), &c);
    const uint32_t indices[] = {0, 1, 2};
    assert_int_equal(c.vertex_count, 3);
    assert_int_equal(c.index_count, 3);
    assert_memory_equal(c.indices, indices, sizeof indices);
    assert_int_equal(c.looks.material[0], 0);
    character_free(&c);
    assert_refused(write_built(&b, "repeats.gltf", REPEATS("2")),
                   "expected a mesh of triangles, got triangles without area");
}

#define SHOWS(more) "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':" more
#define PLAIN "}}]}]"
#define SOFT "}}],'extras':{'targetNames':['a.re','a.im','b.re','b.im']}}]"

TEST(bad_files_get_one_sentence)
{
    static const struct {
        const char *members, *says;
    } rows[] = {
        {"'nodes':[{}]", "expected a mesh of triangles, got none"},
        {SHOWS("9") PLAIN, "attributes.POSITION: expected an accessor, got none"},
        {SHOWS("0") PLAIN, "accessors[0]: expected finite numbers, got NaN"},
        {SHOWS("1") PLAIN, "accessors[1]: expected data within the file"},
        {SHOWS("2") PLAIN, "accessors[2]: expected "},
        {SHOWS("3") SOFT, ".attributes.POSITION: expected positions that are in the file, got none"},
        {SHOWS("4") SOFT, "vertices in a file of this size, got 1000000"},
    };
    const float bin[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0};
    struct builder b = {0};
    ADD(&b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, NAN, 0);
    add_accessor(&b, FLOAT, "VEC3", 4, ",'bufferView':0");
    add_accessor(&b, FLOAT, "VEC2", 3, ",'bufferView':7");
    add_accessor(&b, FLOAT, "VEC3", 100000000, "");
    add_accessor(&b, FLOAT, "VEC3", 1000000,
                 ",'sparse':{'count':1,'indices':{'bufferView':0,'componentType':5121},'values':{'bufferView':0}}");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        assert_refused(write_built(&b, "bad.gltf", rows[i].members), rows[i].says);
    assert_refused(glb("{", bin, 0), "JSON, line 1");
    assert_refused(glb("{}", bin, 0), "expected glTF 2.0, got none");
    // numbers that are none do not make room for the others smaller
    assert_refused(glb("{'asset':{'version':'2.0'},'buffers':[{}],'bufferViews':[{'buffer':0,'byteLength':36}],"
                       "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
                       "{'bufferView':0,'componentType':5126,'count':1000000000000000000,'type':'VEC3'}],'nodes':[{"
                       "'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}},{'attributes':{"
                       "'POSITION':1}}]}]}",
                       bin, sizeof bin),
                   "attributes.POSITION: expected an accessor, got none");
    assert_refused("/nowhere.glb", "/nowhere.glb: cannot be opened");
    assert_refused(temporary_file("text.glb", "{\"asset\": {\"version\": \"2.0\"}}", 29),
                   "expected something to show, got no nodes");
    struct character c;
    struct error error;
    make_character(&c);
    assert_true(character_write(temporary_path("cut.glb"), &c, true, &error));
    assert_false(character_write("/nowhere/a.glb", &c, true, &error));
    character_free(&c);
    char whole[8192];
    FILE *file = fopen(temporary_path("cut.glb"), "rb");
    size_t size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    for (size_t cut = 0; cut < size; cut++) { // every length that is too short
        const char *path = temporary_file("cut.glb", whole, cut);
        assert_false(character_read(path, &c, &error));
    }
}

/// Bytes of a good file changed at random: read or refused, never more (the sanitizers watch).
TEST(changed_bytes_do_no_harm)
{
    struct character c;
    struct error error;
    unsigned char whole[8192], changed[8192];
    uint32_t seed = 12345;
    int refused = 0;
    make_character(&c);
    assert_true(character_write(temporary_path("whole.glb"), &c, true, &error));
    character_free(&c);
    FILE *file = fopen(temporary_path("whole.glb"), "rb");
    size_t size = fread(whole, 1, sizeof whole, file);
    fclose(file);
    for (int round = 0; round < 1000; round++) {
        memcpy(changed, whole, size);
        for (int k = 0; k < 3; k++) {
            seed = 1664525u * seed + 1013904223u;
            changed[(seed >> 8) % size] = k == 0 ? '9' : (unsigned char)(seed >> 3);
        }
        if (character_read(temporary_file("changed.glb", changed, size), &c, &error)) {
            for (int i = 0; i < c.index_count; i++) assert_true(c.indices[i] < (uint32_t)c.vertex_count);
            character_free(&c);
        } else {
            refused++;
        }
    }
    assert_in_range(refused, 50, 999);
}
