/// creature.glb: what is written reads back equal; what other programs write reads too; what is broken is refused.
#include "base/file.h"
#include "facts.h"
#include "gltf_builder.h"
#include "model/character.h"

struct view {
    const struct character *character;
    int coordinate; ///< that "re" and "im" are of
};

static int numbers_of(void *thing, const char *word, const double *given, double *out)
{
    struct view *v = thing;
    const struct character *c = v->character;
    const int n = 3 * c->vertex_count;
    const struct coordinate *coordinate = c->coordinate_count ? &c->coordinates[v->coordinate] : NULL;
    if (strcmp(word, "coordinate") == 0) {
        v->coordinate = (int)given[0];
        return FACTS_LOOKED;
    }
    if (strcmp(word, "vertices") == 0) return take_whole(c->vertex_count, out);
    if (strcmp(word, "coordinates") == 0) return take_whole(c->coordinate_count, out);
    if (strcmp(word, "material") == 0) return take_whole(c->looks.material[0], out);
    if (strcmp(word, "position") == 0) return take_floats(c->position, n, out);
    if (strcmp(word, "normal") == 0) return take_floats(c->normal, n, out);
    if (strcmp(word, "color") == 0) return take_floats(c->color, n, out);
    if (strcmp(word, "re") == 0) return take_floats(coordinate->re, n, out);
    if (strcmp(word, "im") == 0) return take_floats(coordinate->im, n, out);
    for (int i = 0; i < c->index_count; i++) out[i] = c->indices[i];
    return strcmp(word, "indices") == 0 ? c->index_count : -1;
}

/// A tetrahedron with two coordinates and coloured corners.
static void make_character(struct character *c)
{
    static const float position[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    static const float color[4][3] = {{1, 0.5f, 0}, {1, 1, 1}, {0.25f, 0, 1}, {0, 0, 0}};
    static const uint32_t indices[] = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
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
    assert_true(character_curve(c, 0));
    c->coordinates[0].most = 1.25;
    for (int n = 0; n < 36; n++) c->coordinates[0].parts[2 + n / 12][n / 3 % 4][n % 3] = (float)sin(3 * n);
    c->coordinates[0].name = strdup("up");
    c->coordinates[1].name = strdup("g\xc3\xb6 \"left\"");
    c->coordinates[0].frequency = 1.8 / 0.7;
    c->coordinates[0].damping = 0.04;
    c->coordinates[1].explained = 0.99;
    c->coordinates[1].pca1 = 0.6;
    c->coordinates[1].pca2 = 0.98;
}

#define CHARACTER_TEST(name) TEST_OF(struct character, c, make_character(c), character_free(c), name)

/// The bytes of its file, which the caller frees.
static char *bytes_of(const struct character *c, size_t *size)
{
    char *bytes;
    assert_done(character_write(temporary_path("character.glb"), c, true, &error));
    assert_done(file_read(temporary_path("character.glb"), 1 << 20, &bytes, size, &error));
    return bytes;
}

/// The deformation that a viewer makes of the morph targets is Re(z Ñ): the imaginary target is −Im Ñ. Normals point outwards.
CHARACTER_TEST(what_is_written_reads_back_equal)
{
    struct character in;
    size_t size;
    char *bytes = bytes_of(c, &size);
    float last[12]; // the last imaginary part, before how it turns normals and as many bytes of indices
    memcpy(last, bytes + size - 3 * sizeof last, sizeof last);
    for (int n = 0; n < 12; n++) assert_near(last[n], -c->coordinates[1].im[n / 3][n % 3], 0);
    free(bytes);
    assert_done(character_read(temporary_path("character.glb"), &in, &error));
    assert_int_equal(in.vertex_count, 4);
    assert_int_equal(in.index_count, 12);
    assert_int_equal(in.coordinate_count, 2);
    assert_memory_equal(in.position, c->position, 4 * sizeof *in.position);
    assert_memory_equal(in.normal, c->normal, 4 * sizeof *in.normal);
    assert_memory_equal(in.color, c->color, 4 * sizeof *in.color);
    assert_memory_equal(in.indices, c->indices, 12 * sizeof *in.indices);
    for (int i = 0; i < 2; i++) {
        const struct coordinate *a = &in.coordinates[i], *b = &c->coordinates[i];
        const double is[] = {a->frequency, a->damping, a->explained, a->pca1, a->pca2, i == 0 ? a->most : 0};
        const double was[] = {b->frequency, b->damping, b->explained, b->pca1, b->pca2, i == 0 ? 1.25 : 0};
        assert_string_equal(a->name, b->name);
        assert_int_equal(coordinate_parts(a), i == 0 ? COORDINATE_PARTS : COORDINATE_STRAIGHT);
        for (int p = 0; p < coordinate_parts(a); p++)
            assert_memory_equal(a->parts[p], b->parts[p], 4 * sizeof *a->re);
        for (int k = 0; k < 6; k++) assert_near(is[k], was[k], 0);
    }
    for (int i = 0; i < 4; i++) {
        double length = 0, outwards = 0;
        for (int k = 0; k < 3; k++) {
            length += (double)c->normal[i][k] * c->normal[i][k];
            outwards += (double)c->normal[i][k] * (c->position[i][k] - 0.25);
        }
        assert_near(length, 1, 1e-6);
        assert_true(outwards > 0);
    }
    assert_refusal(character_write("/nowhere/a.glb", c, true, &error), "/nowhere/a.glb");
    character_free(&in);
}

#define SPARSE(component, index, value)                                                                              \
    ",'sparse':{'count':1,'indices':{'bufferView':" index ",'componentType':" component                              \
    "},'values':{'bufferView':" value "}}"

/// Accessors: 0 a triangle; 1 two triangles, one without area, 2 one without; 3 and 4 places and colours with alpha in turn, 5 short indices, 6
/// a move of vertex 1; 7 with a NaN, 8 and 9 beyond what is there, 10 and 11 more than the file has.
static void add_all(struct builder *b)
{
    const struct {
        float position[3];
        uint8_t color[4];
    } vertices[3] = {{{0, 0, 0}, {255, 0, 51, 255}}, {{1, 0, 0}, {0, 0, 0, 255}}, {{0, 0, -1}, {0, 255, 0, 0}}};
    const uint16_t place = 1;
    const float target[3] = {0.5f, 0, 2};
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    ADD(b, USHORT, uint16_t, 1, 0, 1, 0, 0, 1, 2);
    ADD(b, USHORT, uint16_t, 1, 0, 1, 0);
    assert_int_equal(add_view(b, vertices, sizeof vertices, sizeof *vertices), 3);
    add_accessor(b, FLOAT, "VEC3", 3, ",'bufferView':3");
    add_accessor(b, UBYTE, "VEC4", 3, ",'bufferView':3,'byteOffset':12,'normalized':true");
    ADD(b, USHORT, uint16_t, 1, 2, 1, 0);
    assert_int_equal(add_view(b, &place, sizeof place, 0), 5);
    assert_int_equal(add_view(b, target, sizeof target, 0), 6);
    add_accessor(b, FLOAT, "VEC3", 3, SPARSE("5123", "5", "6"));
    ADD(b, FLOAT, float, 3, 0, 0, 0, 1, 0, 0, 0, NAN, 0);
    add_accessor(b, FLOAT, "VEC3", 4, ",'bufferView':0");
    add_accessor(b, FLOAT, "VEC2", 3, ",'bufferView':70");
    add_accessor(b, FLOAT, "VEC3", 100000000, "");
    add_accessor(b, FLOAT, "VEC3", 1000000, SPARSE("5121", "5", "6"));
}

#define SHOWS(more) "'nodes':[{'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':" more
#define PLAIN "}}]}]"
#define SOFT "}}],'extras':{'targetNames':['a.re','a.im','b.re','b.im']}}]"
#define REPEATS(indices) "'materials':[{'name':'red'}]," SHOWS("0},'indices':" indices ",'material':0}]}]")

TEST(files_of_other_programs)
{
    static const struct {
        const char *name, *members, *facts; ///< name: of the first coordinate
    } good[] = {
        // two primitives, a target that is sparse and one that is left out, and other targets between ours
        {"up",
         "'nodes':[{'mesh':1}],'meshes':[{'primitives':[{'attributes':{}}]},{'primitives':[{'attributes':{'POSITION':"
         "3,"
         "'COLOR_0':4},'indices':5,'targets':[{},{'POSITION':6},{}]},{'attributes':{'POSITION':3},'targets':[{},{},{}"
         "]}],"
         "'extras':{'targetNames':['up.re','up.im','smile']}}]",
         "vertices 6 coordinates 1 indices 2 1 0 3 4 5 color 1 0 ~0.2 0 0 0 0 1 0 1 1 1 1 1 1 1 1 1 "
         "normal 0 -1 0 0 -1 0 0 -1 0 0 1 0 0 1 0 0 1 0 re 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0 "
         "im 0 0 0 -0.5 0 -2 0 0 0 0 0 0 0 0 0 0 0 0"},
        // scaled and mirrored, below a parent that turns by a quarter about y and lifts; moves are not lifted, triangles turn round
        {"a",
         "'nodes':[{'mesh':0,'scale':[-2,2,2]},{'children':[0],'translation':[0,5,0],'rotation':[0,0."
         "7071067811865476,0,"
         "0.7071067811865476]}],'meshes':[{'primitives':[{'attributes':{'POSITION':0},'targets':[{'POSITION':0},{}]}]"
         ","
         "'extras':{'targetNames':['a.re','a.im']}}]",
         "position 0 5 0 ~0 5 ~2 ~2 5 ~0 re 0 0 0 ~0 0 ~2 ~2 0 ~0 indices 0 2 1 "
         "normal ~0 ~-1 ~0 ~0 ~-1 ~0 ~0 ~-1 ~0"},
        // without area, and with edges from a vertex to itself; what is left keeps its material
        {"", REPEATS("1"), "vertices 3 indices 0 1 2 material 0"},
    };
    static const struct {
        const char *members, *says;
    } bad[] = {
        {REPEATS("2"), "expected a mesh of triangles, got triangles without area"},
        {"'nodes':[{}]", "expected a mesh of triangles, got none"},
        {SHOWS("99") PLAIN, "attributes.POSITION: expected an accessor, got none"},
        {SHOWS("7") PLAIN, "accessors[7]: expected finite numbers, got NaN"},
        {SHOWS("8") PLAIN, "accessors[8]: expected data within the file"},
        {SHOWS("9") PLAIN, "accessors[9]: expected "},
        {SHOWS("10") SOFT, ".attributes.POSITION: expected positions that are in the file, got none"},
        {SHOWS("11") SOFT, "vertices in a file of this size, got 1000000"},
    };
    struct builder b = {0};
    add_all(&b);
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        struct character c;
        assert_done(character_read(write_built(&b, "good.gltf", good[i].members), &c, &error));
        assert_facts_of(&(struct view){&c, 0}, numbers_of, good[i].facts, good[i].facts);
        assert_string_equal(c.coordinate_count ? c.coordinates[0].name : "", good[i].name);
        assert_near(c.coordinate_count ? c.coordinates[0].frequency : 0, 0, 0);
        character_free(&c);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        struct character c;
        assert_refusal(character_read(write_built(&b, "bad.gltf", bad[i].members), &c, &error), bad[i].says);
        assert_null(c.position);
    }
}

TEST(bad_containers)
{
    // in the last one numbers that are none do not make room for the others smaller
    static const struct {
        const char *json, *says;
    } bad[] = {
        {"{", "JSON, line 1"},
        {"{}", "expected glTF 2.0, got none"},
        {"{'asset':{'version':'2.0'},'buffers':[{}],'bufferViews':[{'buffer':0,'byteLength':36}],"
         "'accessors':[{'bufferView':0,'componentType':5126,'count':3,'type':'VEC3'},"
         "{'bufferView':0,'componentType':5126,'count':1000000000000000000,'type':'VEC3'}],'nodes':[{"
         "'mesh':0}],'meshes':[{'primitives':[{'attributes':{'POSITION':0}},{'attributes':{'POSITION':1}}]}]}",
         "attributes.POSITION: expected an accessor, got none"},
    };
    const float bin[9] = {0, 0, 0, 1, 0, 0, 0, 0, 0};
    static char data[8192];
    struct character c;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        const size_t size = put_glb(data, bad[i].json, bin, i == 2 ? sizeof bin : 0);
        assert_refusal(character_read(temporary_file("bad.glb", data, size), &c, &error), bad[i].says);
    }
    assert_refusal(character_read("/nowhere.glb", &c, &error), "/nowhere.glb: cannot be opened");
    assert_refusal(character_read(temporary_file("text.glb", "{\"asset\": {\"version\": \"2.0\"}}", 29), &c, &error),
                   "expected something to show, got no nodes");
}

/// Every length that is too short, and bytes of a good file changed at random: read or refused, never more (the sanitizers watch).
CHARACTER_TEST(changed_bytes_do_no_harm)
{
    struct character read;
    size_t size;
    char *whole = bytes_of(c, &size), *changed = malloc(size);
    uint32_t seed = 12345;
    int refused = 0;
    for (size_t cut = 0; cut < size; cut++)
        assert_false(character_read(temporary_file("cut.glb", whole, cut), &read, NULL));
    for (int round = 0; round < 1000; round++) {
        memcpy(changed, whole, size);
        for (int k = 0; k < 3; k++) {
            seed = 1664525u * seed + 1013904223u;
            changed[(seed >> 8) % size] = (char)(k == 0 ? '9' : (unsigned char)(seed >> 3));
        }
        if (character_read(temporary_file("changed.glb", changed, size), &read, NULL)) {
            for (int i = 0; i < read.index_count; i++) assert_true(read.indices[i] < (uint32_t)read.vertex_count);
            character_free(&read);
        } else {
            refused++;
        }
    }
    assert_in_range(refused, 50, 999);
    free(whole);
    free(changed);
}
