/// Meshes in other formats than OBJ: what is read of them, that broken and lying files are refused with one sentence, and that looks come
/// through to the character's file.
#include "model/character.h"
#include "model/gltf.h"
#include "model/surface.h"
#include "near.h"
#include "temporary.h"
#include <jansson.h>

static struct surface read_good(const char *name, const void *bytes, size_t size)
{
    struct surface surface;
    assert_done(surface_read(temporary_file(name, bytes, size), &surface, &error));
    return surface;
}

static void assert_refused(const char *name, const void *bytes, size_t size, const char *says)
{
    struct surface surface;
    assert_refusal(surface_read(temporary_file(name, bytes, size), &surface, &error), says);
    assert_null(surface.position);
}

static void assert_refused_text(const char *name, const char *text, const char *says)
{
    assert_refused(name, text, strlen(text), says);
}

/// Bytes in one order, as they are on any machine.
static size_t put(unsigned char *to, const void *number, size_t size, bool big)
{
    uint64_t bits = 0;
    memcpy(&bits, number, size);
    for (size_t i = 0; i < size; i++) to[i] = (unsigned char)(bits >> 8 * (big ? size - 1 - i : i));
    return size;
}

static const float places[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0.5f}, {0, 1, -2}};

static size_t make_ply(unsigned char *bytes, bool big)
{
    size_t size = (size_t)sprintf((char *)bytes,
                                  "ply\nformat binary_%s_endian 1.0\ncomment x\nelement vertex 4\nproperty float x\n"
                                  "property float y\nproperty float z\nproperty double quality\nproperty uchar red\n"
                                  "property uchar green\nproperty uchar blue\nelement face 1\n"
                                  "property list uchar int vertex_indices\nelement edge 0\nproperty int vertex1\n"
                                  "property int vertex2\nend_header\n", // as some programs say
                                  big ? "big" : "little");
    for (int v = 0; v < 4; v++) {
        const double quality = NAN; // left out, so it may be anything
        const unsigned char color[3] = {255, 0, 255};
        for (int k = 0; k < 3; k++) size += put(bytes + size, &places[v][k], 4, big);
        size += put(bytes + size, &quality, 8, big);
        memcpy(bytes + size, color, 3);
        size += 3;
    }
    bytes[size++] = 4;
    for (int32_t v = 0; v < 4; v++) size += put(bytes + size, &v, 4, big);
    return size;
}

TEST(ply_in_both_byte_orders)
{
    unsigned char bytes[1024];
    for (int big = 0; big < 2; big++) {
        const size_t size = make_ply(bytes, big);
        struct surface s = read_good("a.ply", bytes, size);
        assert_int_equal(s.vertex_count, 4);
        assert_memory_equal(s.position, places, sizeof places);
        assert_near(s.color[3][0], 1, 1e-6);
        assert_near(s.color[3][1], 0, 0);
        const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
        assert_int_equal(s.index_count, 6);
        assert_memory_equal(s.indices, indices, sizeof indices);
        assert_int_equal(s.looks.joined[1], 1); // one quad
        surface_free(&s);
        for (size_t cut = 0; cut < size; cut++) { // every length that is too short
            struct error error = {0};
            assert_false(surface_read(temporary_file("cut.ply", bytes, cut), &s, &error));
        }
    }
}

#define PLY "ply\nformat ascii 1.0\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define FACE "element face 1\nproperty list int int vertex_indices\nend_header\n"

TEST(ply_as_text)
{
    const char *text = PLY "obj_info made by hand\nelement vertex 4\n" XYZ
                           "property float s\nproperty float t\nelement tristrips 1\n"
                           "property list int int vertex_indices\nend_header\n"
                           "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n8 0 1 2 3 -1 0 1 2\n";
    struct surface s = read_good("b.ply", text, strlen(text));
    const uint32_t indices[] = {0, 1, 2, 2, 1, 3, 0, 1, 2};
    assert_int_equal(s.index_count, 9);
    assert_memory_equal(s.indices, indices, sizeof indices);
    surface_free(&s);
    assert_refused_text("c.ply", "plx\n", "c.ply: expected a PLY file");
    assert_refused_text("c.ply", PLY "element vertex 1\nproperty float x\nend_header\n1\n",
                        "vertices with x, y and z");
    assert_refused_text("c.ply",
                        PLY
                        "element vertex 1\n" XYZ
                        "property float red\nproperty float green\nproperty float blue\nend_header\n0 0 0 0 0 1e30\n",
                        "c.ply: vertex 1: expected a colour from 0 to 1, got 1e+30");
    assert_refused_text("c.ply", PLY "element vertex many\n",
                        "c.ply:3: expected the number of an element, got 'many'");
    assert_refused_text("c.ply", PLY "element vertex 2000000000\n" XYZ "end_header\n1 2 3\n",
                        "expected a number, got the end of the file");
    assert_refused_text("c.ply", PLY "element vertex 1\n" XYZ FACE "1 2 3\n2000000000 0 0",
                        "expected a number, got the end of the file");
    assert_refused_text("c.ply", PLY "element vertex 1\n" XYZ FACE "1 2 3\n3 0 0 1",
                        "expected a vertex from 0 to 0, got 1");
}

static size_t make_stl(unsigned char *bytes, uint32_t count)
{
    size_t size = 80;
    memset(bytes, 0, 80);
    memcpy(bytes, "solid but binary", 16);
    size += put(bytes + size, &count, 4, false);
    for (int t = 0; t < 2; t++) {
        static const int corners[2][3] = {{0, 1, 2}, {0, 2, 3}};
        memset(bytes + size, 0, 12);
        size += 12;
        for (int n = 0; n < 9; n++) size += put(bytes + size, &places[corners[t][n / 3]][n % 3], 4, false);
        size += 2;
    }
    return size;
}

TEST(stl_merges_corners)
{
    unsigned char bytes[512] = {0};
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    struct surface s = read_good("a.stl", bytes, make_stl(bytes, 2));
    assert_int_equal(s.vertex_count, 4);
    assert_memory_equal(s.position, places, sizeof places);
    assert_memory_equal(s.indices, indices, sizeof indices);
    surface_free(&s);
    bytes[0] = 'x';
    assert_refused("cut.stl", bytes, 150, "expected 184 bytes for 2 facets, got 150: the file is cut off");
    const size_t size = make_stl(bytes, 4000000000u);
    bytes[0] = 'x';
    assert_refused("lie.stl", bytes, size, "the file is cut off");
    const char *text =
        "solid a thing\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1e0 1 0\nendloop\n"
        "endfacet\nfacet normal 0 0 1\n outer loop\n vertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\n"
        "endfacet\nendsolid a thing\n";
    s = read_good("b.stl", text, strlen(text));
    assert_int_equal(s.vertex_count, 4);
    assert_memory_equal(s.indices, indices, sizeof indices);
    surface_free(&s);
    assert_refused_text("c.stl", "solid\nvertex 1 2", "c.stl:2: expected three coordinates of a vertex, got the end");
    assert_refused_text("c.stl", "solid\nvertex 1 2 3\nendfacet\n", "expected a facet of three vertices, got 1");
    assert_refused_text("c.stl", "solid\nnonsense\n", "c.stl:2: expected a facet, got 'nonsense'");
    assert_refused_text("c.stl", "", "expected an STL file");
}

TEST(off_with_colours)
{
    const char *text =
        "COFF # coloured\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n1 1 0 0 0 0 255\n0 1 0 0 0 0 255\n"
        "4 0 1 2 3 0.5 0.5 0.5\n3 2 1 0\n";
    struct surface s = read_good("a.off", text, strlen(text));
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3, 2, 1, 0};
    assert_int_equal(s.index_count, 9);
    assert_memory_equal(s.indices, indices, sizeof indices);
    assert_near(s.color[0][0], 1, 1e-6);
    assert_near(s.color[2][0], 0, 0);
    surface_free(&s);
    assert_refused_text("b.off", "OFF\n2000000000 1 0\n0 0 0\n",
                        "expected a coordinate of a vertex, got the end of the file");
    assert_refused_text("b.off", "OFF\n1 1 0\n0 0 0\n2000000000 0 0", "got the end of the file");
    assert_refused_text("b.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1",
                        "b.off:4: expected the number of a vertex, from 0, got '1'");
    assert_refused_text("b.off", "COFF\n1 1 0\n0 0 0 1e30 0 0 1\n",
                        "b.off:3: expected a colour from 0 to 1, or to 255, got 1e+30");
    assert_refused_text("b.off", "OFFAL\n", "b.off:1: expected OFF");
    assert_refused_text("b.off", "OFF BINARY\n", "expected an OFF file as text");
}

/// Ways in which programs write the same tetrahedron. Its merged vertices come in the order of the file, its faces in theirs.
TEST(the_same_mesh_in_many_ways)
{
#define MARK "\xEF\xBB\xBF"
#define PLACES "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
#define FACES "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
#define OBJ "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
#define OFF_COUNTS(head, counts) head counts PLACES FACES
#define FACES_FIRST "element face 4\nproperty list uchar int vertex_indices\nelement vertex 4\n"
#define STL(solid, facet, outer, v, endloop, endfacet, endsolid)                                                     \
    solid " a facet\n" STL_OF(facet, outer, v, "0 0 0 ", "0 1 0 ", "1 0 0 ", endloop, endfacet)                      \
        STL_OF(facet, outer, v, "0 0 0 ", "1 0 0 ", "0 0 1 ", endloop, endfacet)                                     \
            STL_OF(facet, outer, v, "1 0 0 ", "0 1 0 ", "0 0 1 ", endloop, endfacet)                                 \
                STL_OF(facet, outer, v, "0 0 0 ", "0 0 1 ", "0 1 0 ", endloop, endfacet) endsolid " a facet\n"
#define STL_OF(facet, outer, v, a, b, c, endloop, endfacet) facet " 0 0 nan " outer v a v b v c endloop endfacet
    static const struct {
        const char *name, *text;
    } ways[] = {
        {"a.obj", OBJ},
        {"mark.obj", MARK OBJ},
        {"mark.off", MARK OFF_COUNTS("OFF\n", "4 4 6\n")},
        {"joined.off", OFF_COUNTS("OFF", "4 4 6\n")},
        {"two.off", OFF_COUNTS("OFF\n", "4 4\n")},
        {"two_joined.off", OFF_COUNTS("OFF", "4 4 # no edges\n")},
        {"lines.off", OFF_COUNTS("OFF\n", "4\n4\n6\n")},
        {"lower.off", OFF_COUNTS("off\n", "4 4 6\n")},
        {"faces_first.ply", PLY FACES_FIRST XYZ "end_header\n" FACES PLACES},
        {"mark.ply", MARK PLY "element vertex 4\n" XYZ
                              "element face 4\nproperty list uchar int vertex_indices\nend_header\n" PLACES FACES},
        {"a.stl", STL("solid", "facet normal", "\nouter loop\n", "vertex ", "\nendloop", "\nendfacet\n", "endsolid")},
        {"mark.stl",
         MARK STL("solid", "facet normal", "\nouter loop\n", "vertex ", "\nendloop", "\nendfacet\n", "endsolid")},
        {"upper.stl",
         STL("SOLID", "FACET NORMAL", "\nOUTER LOOP\n", "VERTEX ", "\nENDLOOP", "\nENDFACET\n", "ENDSOLID")},
        {"two_words.stl",
         STL("Solid", "facet normal", "\nouter loop\n", "vertex ", "\nend loop", "\nend facet\n", "end solid")},
        {"one_line.stl",
         STL("solid", " facet normal", " outer loop ", "vertex ", " endloop", " endfacet ", "endsolid")},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        static const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
        static const float places_of[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
        struct surface s = read_good(ways[i].name, ways[i].text, strlen(ways[i].text));
        assert_int_equal(s.vertex_count, 4);
        assert_int_equal(s.index_count, 12);
        for (int n = 0; n < 12; n++)
            assert_memory_equal(s.position[s.indices[n]], places_of[faces[n / 3][n % 3]], 12);
        surface_free(&s);
    }
    assert_refused_text("short.ply", PLY FACES_FIRST XYZ "end_header\n" FACES "0 0 0\n", "got the end of the file");
    assert_refused_text("far.ply", PLY FACES_FIRST XYZ "end_header\n3 0 1 4\n",
                        "expected a vertex from 0 to 3, got 4");
}

/// Triangles that name a vertex twice are left out; in a strip they are how it jumps. A mesh of nothing else is refused.
TEST(triangles_that_repeat_a_vertex_are_left_out)
{
#define THREE_OF_PLY "element vertex 3\n" XYZ "element "
#define LISTS_OF_PLY "\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n"
#define FACET(a, b, c) "facet normal 0 0 1\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet\n"
    static const struct {
        const char *name, *good, *bad;
    } cases[] = {
        {"r.ply", PLY THREE_OF_PLY "face 2" LISTS_OF_PLY "3 0 1 0\n3 0 1 2\n",
         PLY THREE_OF_PLY "face 1" LISTS_OF_PLY "3 0 1 0\n"},
        {"t.ply", PLY THREE_OF_PLY "tristrips 1" LISTS_OF_PLY "6 0 0 0 1 2 2\n",
         PLY THREE_OF_PLY "tristrips 1" LISTS_OF_PLY "4 0 1 1 0\n"},
        {"r.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 2 1 2\n3 0 1 2\n",
         "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 2 1 2\n"},
        {"r.stl", "solid\n" FACET("0 0 0", "1 0 0", "0 1 0") FACET("0 0 0", "1 0 0", "1 0 0"),
         "solid\n" FACET("0 0 0", "1 0 0", "1 0 0")},
    };
    const uint32_t indices[] = {0, 1, 2};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct surface s = read_good(cases[i].name, cases[i].good, strlen(cases[i].good));
        assert_int_equal(s.vertex_count, 3);
        assert_int_equal(s.index_count, 3);
        assert_memory_equal(s.indices, indices, sizeof indices);
        surface_free(&s);
        assert_refused_text(cases[i].name, cases[i].bad, "faces of three different vertices, got others alone");
    }
}

/// Two quads of two materials, one textured, with a seam between them: vertices 1 and 2 have two texture coordinates each.
TEST(looks_come_through)
{
    static const unsigned char png[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0};
    const char *mtl = "newmtl red one\nKd 1 0.5 0\nnewmtl wood\nKd 1 1 1\nmap_Kd -s 1 1 1 wood grain.png\n";
    const char *text =
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red one\nf 1/1 2/2 3/3 4/4\nusemtl wood\nf 2/1 5/2 6/3 3/4\n";
    temporary_file("m.mtl", mtl, strlen(mtl));
    temporary_file("wood grain.png", png, sizeof png);
    struct surface s = read_good("m.obj", text, strlen(text)), again;
    assert_done(obj_write(temporary_path("m.rest.obj"), &s, &error));
    assert_done(surface_read(temporary_path("m.rest.obj"), &again, &error));
    assert_memory_equal(again.looks.uv, s.looks.uv, 4 * sizeof *s.looks.uv);
    assert_memory_equal(again.looks.corner, s.looks.corner, 12 * sizeof *s.looks.corner);
    assert_memory_equal(again.looks.joined, s.looks.joined, 4);
    assert_memory_equal(again.looks.material, s.looks.material, 4 * sizeof *s.looks.material);
    assert_int_equal(again.looks.material_count, 2);
    assert_string_equal(again.looks.materials[0].name, "red one");
    assert_near(again.looks.materials[0].color[1], 0.5, 0);
    assert_int_equal(again.looks.materials[1].image_size, sizeof png);
    assert_null(again.looks.left_out);
    struct character character, read;
    assert_true(character_create(&character, &again, 1));
    character.coordinates[0].name = strdup("up");
    character.coordinates[0].re[2][1] = 3;
    assert_done(character_write(temporary_path("m.glb"), &character, true, &error));
    assert_done(character_read(temporary_path("m.glb"), &read, &error));
    assert_int_equal(read.vertex_count, 6 + 2);
    assert_memory_equal(read.position, s.position, 6 * sizeof *s.position); // first those of the mesh, in its order
    assert_near(read.coordinates[0].re[2][1], 3, 0);
    int moved = 0;
    for (int i = 6; i < 8; i++) moved += read.coordinates[0].re[i][1] == 3;
    assert_int_equal(moved, 1); // and its copy at the seam
    struct gltf gltf;
    assert_done(gltf_read(temporary_path("m.glb"), &gltf, &error));
    assert_int_equal(gltf.meshes[0].part_count, 2);
    assert_string_equal(gltf.materials[0].name, "red one");
    assert_near(gltf.materials[0].color[1], 0.5, 0);
    assert_non_null(gltf.meshes[0].parts[0].targets[0].normal);
    assert_near(gltf.meshes[0].parts[1].uv[1][0], 1, 0);
    gltf_free(&gltf);
    character_free(&character);
    character_free(&read);
    surface_free(&s);
    surface_free(&again);
}

/// A name may end in blanks in one of the two files, and in a backslash, which at the end of a line would join it to the next.
TEST(names_of_materials_come_through)
{
    const char *mtl = "newmtl red \t\r\nKd 1 0.5 0\nnewmtl back\\\nKd 0 0 1\n";
    const char *text = "mtllib n.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nusemtl back\\ \nf 1 3 2\n";
    temporary_file("n.mtl", mtl, strlen(mtl));
    struct surface s = read_good("n.obj", text, strlen(text)), again;
    assert_done(obj_write(temporary_path("n.rest.obj"), &s, &error));
    assert_done(surface_read(temporary_path("n.rest.obj"), &again, &error));
    const struct surface *const both[] = {&s, &again};
    for (int i = 0; i < 2; i++) {
        const struct looks *looks = &both[i]->looks;
        assert_int_equal(both[i]->index_count, 6);
        assert_int_equal(looks->material_count, 2);
        assert_string_equal(looks->materials[looks->material[0]].name, "red");
        assert_near(looks->materials[looks->material[0]].color[1], 0.5, 0);
        assert_string_equal(looks->materials[looks->material[1]].name, "back\\");
        assert_near(looks->materials[looks->material[1]].color[0], 0, 0);
    }
    surface_free(&s);
    surface_free(&again);
}

/// With memory for only so many calls of the JSON library, the file is written whole or not at all.
static long calls_left;
static void *stingy(size_t size) { return calls_left-- > 0 ? malloc(size) : NULL; }

TEST(nothing_is_written_where_memory_is_short)
{
    const uint32_t indices[] = {0, 1, 2, 0, 2, 3};
    struct surface s = {.position = memcpy(malloc(sizeof places), places, sizeof places),
                        .vertex_count = 4,
                        .indices = memcpy(malloc(sizeof indices), indices, sizeof indices),
                        .index_count = 6};
    struct character c;
    struct error error;
    assert_true(character_create(&c, &s, 1));
    c.coordinates[0].name = strdup("up");
    int refused = 0;
    for (long calls = 0; calls < 100000; calls++) {
        const char *path = temporary_path("short.glb");
        remove(path);
        calls_left = calls;
        json_set_alloc_funcs(stingy, free);
        const bool written = character_write(path, &c, true, &error);
        json_set_alloc_funcs(malloc, free);
        if (written) {
            struct character read;
            if (!character_read(path, &read, &error)) fail_msg("after %ld calls: %s", calls, error.text);
            assert_int_equal(read.coordinate_count, 1);
            character_free(&read);
            break;
        }
        assert_int_equal(access(path, F_OK), -1);
        refused++;
    }
    assert_true(refused > 100);
    character_free(&c);
}

/// A triangle after `elements` of nothing, its vertices with `properties` of no meaning and one colour.
static const char *print_ply(int elements, int properties, double red)
{
    static char text[4096];
    char *at = stpcpy(text, "ply\nformat ascii 1.0\n");
    for (int i = 0; i < elements; i++) at += sprintf(at, "element more 0\n");
    at = stpcpy(at, "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float red\n"
                    "property float green\nproperty float blue\n");
    for (int i = 0; i < properties; i++) at += sprintf(at, "property float p%d\n", i);
    at = stpcpy(at, "element face 1\nproperty list int int vertex_indices\nend_header\n");
    for (int v = 0; v < 3; v++) {
        at += sprintf(at, "%d %d 0 %g 0 0", v == 1, v == 2, red);
        for (int i = 0; i < properties; i++) at = stpcpy(at, " 7");
        at = stpcpy(at, "\n");
    }
    stpcpy(at, "3 0 1 2\n");
    return text;
}

TEST(limits_of_a_ply)
{
    const char *most = print_ply(14, 58, 1000);
    struct surface surface = read_good("most.ply", most, strlen(most));
    assert_int_equal(surface.index_count, 3);
    assert_true(surface.color[0][0] > 1000);
    surface_free(&surface);
    assert_refused_text("elements.ply", print_ply(15, 0, 0), "expected at most 16 elements");
    assert_refused_text("properties.ply", print_ply(0, 59, 0), "expected at most 64 properties");
    assert_refused_text("bright.ply", print_ply(0, 0, 1001), "expected a colour from 0 to 1, got 1001");
    assert_refused_text("dark.ply", print_ply(0, 0, -1001), "expected a colour from 0 to 1, got -1001");
}
