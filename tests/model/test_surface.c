/// Meshes of OBJ, PLY, STL and OFF files: what is read of them, what is refused with one sentence, that looks come through to the character's
/// file, and which triangles are across edges.
#include "facts.h"
#include "model/adjacency.h"
#include "model/character.h"
#include "model/gltf.h"
#include "model/surface.h"
#include "temporary.h"
#include <jansson.h>

/// "corners" are the places of the triangles' corners, in their order; "textures" the texture coordinates of each.
static int numbers_of(void *thing, const char *word, const double *given, double *out)
{
    const struct surface *s = thing;
    const struct looks *looks = &s->looks;
    const struct {
        const char *word;
        const uint32_t *at;
        int count;
    } lists[] = {{"indices", s->indices, s->index_count},
                 {"textures", looks->corner, s->index_count},
                 {"material", looks->material, s->index_count / 3}};
    (void)given;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (strcmp(word, lists[i].word) != 0) continue;
        for (int k = 0; lists[i].at && k < lists[i].count; k++) out[k] = lists[i].at[k];
        return lists[i].at ? lists[i].count : 0;
    }
    if (strcmp(word, "vertices") == 0) return take_whole(s->vertex_count, out);
    if (strcmp(word, "materials") == 0) return take_whole(looks->material_count, out);
    if (strcmp(word, "position") == 0) return take_floats(s->position, 3 * s->vertex_count, out);
    if (strcmp(word, "color") == 0) return take_floats(s->color, 3 * s->vertex_count, out);
    if (strcmp(word, "uv") == 0) return take_floats(looks->uv, 2 * looks->uv_count, out);
    for (int t = 0; t < s->index_count / 3; t++) out[t] = looks->joined ? looks->joined[t] : 0;
    if (strcmp(word, "joined") == 0) return s->index_count / 3;
    for (int i = 0; i < s->index_count; i++) take_floats(s->position[s->indices[i]], 3, out + 3 * i);
    return strcmp(word, "corners") == 0 ? 3 * s->index_count : -1;
}

static struct surface read_good(const char *name, const void *bytes, size_t size)
{
    struct surface surface;
    struct error error = {0};
    if (!surface_read(temporary_file(name, bytes, size), &surface, &error)) fail_msg("%s: %s", name, error.text);
    return surface;
}

static void assert_good(const char *name, const void *bytes, size_t size, const char *facts)
{
    struct surface surface = read_good(name, bytes, size);
    assert_facts_of(&surface, numbers_of, name, facts);
    surface_free(&surface);
}

static void assert_refused(const char *name, const void *bytes, size_t size, const char *says)
{
    struct surface surface;
    struct error error = {0};
    if (surface_read(temporary_file(name, bytes, size), &surface, &error))
        fail_msg("%s opened, though '%s'", name, says);
    if (!strstr(error.text, says)) fail_msg("%s: '%s' lacks '%s'", name, error.text, says);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_null(surface.position);
}

#define PLY "ply\nformat ascii 1.0\n"
#define XYZ "property float x\nproperty float y\nproperty float z\n"
#define LIST "property list int int vertex_indices\nend_header\n"
#define FACE "element face 1\n" LIST
#define THREE_OF_PLY "element vertex 3\n" XYZ "element "
#define THREE_PLACES "\n" LIST "0 0 0\n1 0 0\n0 1 0\n"
#define FACES_FIRST "element face 4\nproperty list uchar int vertex_indices\nelement vertex 4\n"
#define FACET(a, b, c) "facet normal 0 0 1\nouter loop\nvertex " a "\nvertex " b "\nvertex " c "\nendloop\nendfacet\n"
#define THREE_OF_OBJ "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define FIVE_OF_OBJ "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\n"

struct file {
    const char *name, *text, *says; ///< facts, or a sentence
};

/// Polygons become fans of triangles. A triangle that names a vertex twice has no area and is left out (in a strip it is how it jumps); what is
/// left of its polygon stays a polygon where it is a fan. All vertices stay, because motions refer to them.
static const struct file good[] = {
    {"forms.obj",
     "# a pyramid\r\nmtllib a.mtl\r\no thing\r\nv 0 0 0\r\nv 1 0 0\nv 1 1e0 0\nv 0 1 0 1.0\nv .5 .5 \\\n 1\n"
     "vt 0 0\nvn 0 0 1\ns off\nusemtl m\nf 4/1/1 3/1/1 2/1/1 1/1/1\nf 1//1 2//1 5//1\nf 2/1 3/1 5/1\n"
     "\tf  3 4 -1 # counted backwards\nf -2 -5 \\\r\n-1",
     "vertices 5 position 0 0 0 1 0 0 1 1 0 0 1 0 0.5 0.5 1 color indices 3 2 1 3 1 0 0 1 4 1 2 4 2 3 4 3 0 4 "
     "joined 0 1 0 0 0 0"},
    // colours are sRGB, and a vertex without one is white
    {"colours.obj", "v 0 0 0\nv 1 0 0 0.5 1 0\nv 0 1 0\nf 1 2 3\n", "color 1 1 1 ~0.21404114 ~1 0 1 1 1"},
    {"repeats.obj", FIVE_OF_OBJ "f 1 2 1\nf 1 2 3\nf 2 2 3\nf 3 4 4\n", "vertices 5 indices 0 1 2 joined 0"},
    {"quad.obj", FIVE_OF_OBJ "f 1 2 3 4\nf 1 2 2\n", "vertices 5 indices 0 1 2 0 2 3 joined 0 1"},
    {"own.obj", FIVE_OF_OBJ "f 1 2 3\nf 1 1 3 4\n",
     "vertices 5 indices 0 1 2 0 2 3 joined 0 0"}, // no more of the one before
    {"twice.obj", FIVE_OF_OBJ "f 1 2 3 3 4\n", "vertices 5 indices 0 1 2 0 2 3 joined 0 1"},
    {"seam.obj", FIVE_OF_OBJ "f 1 2 3/1 3/2 4\n",
     "vertices 5 indices 0 1 2 0 2 3 joined 0 0"},                                             // textures do not meet
    {"touch.obj", FIVE_OF_OBJ "f 1 2 3 1 4 5\n", "vertices 5 indices 0 1 2 0 3 4 joined 0 0"}, // at a corner
    {"gap.obj", FIVE_OF_OBJ "f 1 2 3\nf 4 4 4\nf 1 3 4 5\n", "vertices 5 indices 0 1 2 0 2 3 0 3 4 joined 0 0 1"},
    // what a triangle looks like goes with it where others before it are left out, and so does what nothing has that is left
    {"looks.obj", FIVE_OF_OBJ "vt 1 1\nusemtl a\nf 1/1 2/2 1/3\nusemtl b\nf 1/3 2/2 3/1\n",
     "indices 0 1 2 textures 2 1 0 materials 2 material 1"},
    {"no_looks.obj", FIVE_OF_OBJ "f 1/1 2/1 1/1\nf 1 2 3\n", "indices 0 1 2 uv"},
    {"strip.ply",
     PLY "obj_info made by hand\nelement vertex 4\n" XYZ
         "property float s\nproperty float t\nelement tristrips 1\n" LIST
         "0 0 0 0 0\n1 0 0 1 0\n0 1 0 0 1\n1 1 0 1 1\n8 0 1 2 3 -1 0 1 2\n",
     "vertices 4 indices 0 1 2 2 1 3 0 1 2"},
    {"half_textured.ply",
     PLY "element vertex 1\n" XYZ "element vertex 2\n" XYZ "property float s\nproperty float t\n" FACE
         "0 0 0\n1 0 0 1 0\n0 1 0 0 1\n3 0 1 2\n",
     "vertices 3 indices 0 1 2 uv"},
    {"repeats.ply", PLY THREE_OF_PLY "face 2" THREE_PLACES "3 0 1 0\n3 0 1 2\n", "vertices 3 indices 0 1 2"},
    {"strip_repeats.ply", PLY THREE_OF_PLY "tristrips 1" THREE_PLACES "6 0 0 0 1 2 2\n", "vertices 3 indices 0 1 2"},
    {"merged.stl",
     "solid a thing\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 1e0 1 0\nendloop\nendfacet\n"
     "facet normal 0 0 1\n outer loop\n vertex -0 0 0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n"
     "endsolid a thing\n",
     "vertices 4 indices 0 1 2 0 2 3"},
    {"repeats.stl", "solid\n" FACET("0 0 0", "1 0 0", "0 1 0") FACET("0 0 0", "1 0 0", "1 0 0"),
     "vertices 3 indices 0 1 2"},
    {"repeats.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 2 1 2\n3 0 1 2\n", "vertices 3 indices 0 1 2"},
    {"colours.off",
     "COFF # coloured\n4 2 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n1 1 0 0 0 0 255\n0 1 0 0 0 0 255\n"
     "4 0 1 2 3 0.5 0.5 0.5\n3 2 1 0\n",
     "indices 0 1 2 0 2 3 2 1 0 color ~1 0 0 ~1 0 0 0 0 0 0 0 0"},
    {"all.off", // normals, colours from 0 to 1, and textures from below
     "STCNOFF\n3 1 0\n0 0 0 7 7 7 0.5 0 1 1 0.25 0.75\n1 0 0 7 7 7 0 1 0 1 0 0\n0 1 0 7 7 7 0 0 0 1 1 1\n3 0 1 2\n",
     "position 0 0 0 1 0 0 0 1 0 color ~0.21404114 0 ~1 0 ~1 0 0 0 0 uv 0.25 0.25 0 1 1 0"},
};

static const struct file bad[] = {
    {"1.obj", "v 0 0\n", "1.obj:1: expected three coordinates of a vertex, got nothing"},
    {"2.obj", "v 0 0 0\nv 0 0 x1\n", "2.obj:2: expected a finite number, got 'x1'"},
    {"3.obj", "v 0 0 nan\n", "3.obj:1: expected a finite number, got 'nan'"},
    {"4.obj", "v 0 0 0\nv 0 0 0 1e30 0 0\n", "4.obj:2: expected a colour from 0 to 1, got 1e+30"},
    {"5.obj", "v 0 0 1e99\n", "5.obj:1: expected a finite number, got '1e99'"},
    {"6.obj", THREE_OF_OBJ "f 1 2\n", "6.obj:4: expected a face of three corners or more, got 2"},
    {"7.obj", "v 0 0 0\nv 1 0 0\n\\\n\nf 1 2 3\n", "7.obj:5: expected a vertex from 1 to 2, got '3'"},
    {"8.obj", "v 0 0 0\nf 0 1 1\n", "8.obj:2: expected the number of a vertex, got '0'"},
    {"9.obj", "v 0 0 0\nf 1 -2 1\n", "9.obj:2: expected the number of a vertex, got '-2'"},
    {"10.obj", "v 0 0 0\nf 1 1x 1\n", "10.obj:2: expected the number of a vertex, got '1x'"},
    {"11.obj", "v 0 0 0\nf 1 99999999999999999999 1\n",
     "11.obj:2: expected the number of a vertex, got '99999999999999999999'"},
    {"12.obj", "", "expected an OBJ file with vertices, got none"},
    {"13.obj", "v 0 0 0\n", "expected an OBJ file with faces, got none"},
    {"14.obj", "v 0 0 0\nv 1 0 0\nf 1 2 1\n",
     "expected an OBJ file with faces of three different vertices, got others alone"},
    {"1.ply", "plx\n", "1.ply: expected a PLY file"},
    {"2.ply", PLY "element vertex 1\nproperty float x\nend_header\n1\n", "vertices with x, y and z"},
    {"3.ply",
     PLY "element vertex 1\n" XYZ "property float red\nproperty float green\nproperty float blue\nend_header\n"
         "0 0 0 0 0 1e30\n",
     "3.ply: vertex 1: expected a colour from 0 to 1, got 1e+30"},
    {"4.ply", PLY "element vertex many\n", "4.ply:3: expected the number of an element, got 'many'"},
    {"5.ply", PLY "element vertex 2000000000\n" XYZ "end_header\n1 2 3\n",
     "expected a number, got the end of the file"},
    {"6.ply", PLY "element vertex 1\n" XYZ FACE "1 2 3\n2000000000 0 0",
     "expected a number, got the end of the file"},
    {"7.ply", PLY "element vertex 1\n" XYZ FACE "1 2 3\n3 0 0 1", "expected a vertex from 0 to 0, got 1"},
    {"8.ply", PLY FACES_FIRST XYZ "end_header\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n0 0 0\n",
     "got the end of the file"},
    {"9.ply", PLY FACES_FIRST XYZ "end_header\n3 0 1 4\n", "expected a vertex from 0 to 3, got 4"},
    {"10.ply", PLY THREE_OF_PLY "face 1" THREE_PLACES "3 0 1 0\n",
     "faces of three different vertices, got others alone"},
    {"11.ply", PLY THREE_OF_PLY "tristrips 1" THREE_PLACES "4 0 1 1 0\n",
     "faces of three different vertices, got others alone"},
    {"1.stl", "solid\nvertex 1 2", "1.stl:2: expected three coordinates of a vertex, got the end"},
    {"2.stl", "solid\nvertex 1 2 3\nendfacet\n", "expected a facet of three vertices, got 1"},
    {"3.stl", "solid\nnonsense\n", "3.stl:2: expected a facet, got 'nonsense'"},
    {"4.stl", "", "expected an STL file"},
    {"5.stl", "solid\n" FACET("0 0 0", "1 0 0", "1 0 0"), "faces of three different vertices, got others alone"},
    {"1.off", "OFF\n2000000000 1 0\n0 0 0\n", "expected a coordinate of a vertex, got the end of the file"},
    {"2.off", "OFF\n1 1 0\n0 0 0\n2000000000 0 0", "got the end of the file"},
    {"3.off", "OFF\n1 1 0\n0 0 0\n3 0 0 1", "3.off:4: expected the number of a vertex, from 0, got '1'"},
    {"4.off", "COFF\n1 1 0\n0 0 0 1e30 0 0 1\n", "4.off:3: expected a colour from 0 to 1, or to 255, got 1e+30"},
    {"5.off", "OFFAL\n", "5.off:1: expected OFF"},
    {"6.off", "OFF BINARY\n", "expected an OFF file as text"},
    {"7.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 2 1 2\n", "faces of three different vertices, got others alone"},
};

TEST(files_are_read_or_refused)
{
    struct surface s;
    for (size_t i = 0; i < sizeof good / sizeof *good; i++)
        assert_good(good[i].name, good[i].text, strlen(good[i].text), good[i].says);
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
        assert_refused(bad[i].name, bad[i].text, strlen(bad[i].text), bad[i].says);
    assert_refused("nul.obj", "v 0\0 0", 6, "got binary data");
    assert_refusal(surface_read("/nowhere.obj", &s, &error), "/nowhere.obj: cannot be opened");
}

/// Ways in which programs write the same tetrahedron. Its merged vertices come in the order of the file, its faces in theirs.
TEST(the_same_mesh_in_many_ways)
{
#define MARK "\xEF\xBB\xBF"
#define PLACES "0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
#define FACES "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n"
#define OBJ "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
#define STL(solid, facet, outer, v, endloop, endfacet, endsolid)                                                     \
    solid " a facet\n" STL_OF(facet, outer, v, "0 0 0 ", "0 1 0 ", "1 0 0 ", endloop, endfacet)                      \
        STL_OF(facet, outer, v, "0 0 0 ", "1 0 0 ", "0 0 1 ", endloop, endfacet)                                     \
            STL_OF(facet, outer, v, "1 0 0 ", "0 1 0 ", "0 0 1 ", endloop, endfacet)                                 \
                STL_OF(facet, outer, v, "0 0 0 ", "0 0 1 ", "0 1 0 ", endloop, endfacet) endsolid " a facet\n"
#define STL_OF(facet, outer, v, a, b, c, endloop, endfacet) facet " 0 0 nan " outer v a v b v c endloop endfacet
#define PLAIN_STL STL("solid", "facet normal", "\nouter loop\n", "vertex ", "\nendloop", "\nendfacet\n", "endsolid")
    static const struct {
        const char *name, *text;
    } ways[] = {
        {"a.obj", OBJ},
        {"mark.obj", MARK OBJ},
        {"mark.off", MARK "OFF\n4 4 6\n" PLACES FACES},
        {"joined.off", "OFF4 4 6\n" PLACES FACES},
        {"two.off", "OFF\n4 4\n" PLACES FACES},
        {"two_joined.off", "OFF4 4 # no edges\n" PLACES FACES},
        {"lines.off", "OFF\n4\n4\n6\n" PLACES FACES},
        {"lower.off", "off\n4 4 6\n" PLACES FACES},
        {"faces_first.ply", PLY FACES_FIRST XYZ "end_header\n" FACES PLACES},
        {"mark.ply", MARK PLY "element vertex 4\n" XYZ
                              "element face 4\nproperty list uchar int vertex_indices\nend_header\n" PLACES FACES},
        {"a.stl", PLAIN_STL},
        {"mark.stl", MARK PLAIN_STL},
        {"upper.stl",
         STL("SOLID", "FACET NORMAL", "\nOUTER LOOP\n", "VERTEX ", "\nENDLOOP", "\nENDFACET\n", "ENDSOLID")},
        {"two_words.stl",
         STL("Solid", "facet normal", "\nouter loop\n", "vertex ", "\nend loop", "\nend facet\n", "end solid")},
        {"one_line.stl",
         STL("solid", " facet normal", " outer loop ", "vertex ", " endloop", " endfacet ", "endsolid")},
    };
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++)
        assert_good(ways[i].name, ways[i].text, strlen(ways[i].text),
                    "vertices 4 corners 0 0 0 0 1 0 1 0 0 0 0 0 1 0 0 0 0 1 1 0 0 0 1 0 0 0 1 0 0 0 0 0 1 0 1 0");
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
#define TWO_TRIANGLES "vertices 4 position 0 0 0 1 0 0 1 1 0.5 0 1 -2 indices 0 1 2 0 2 3 "

static size_t make_ply(unsigned char *bytes, bool big)
{
    size_t size = (size_t)sprintf((char *)bytes,
                                  "ply\nformat binary_%s_endian 1.0\ncomment x\nelement vertex 4\n" XYZ
                                  "property double quality\nproperty uchar red\n"
                                  "property uchar green\nproperty uchar blue\nelement face 1\n"
                                  "property list uchar int vertex_indices\nelement edge 0\nproperty int vertex1\n"
                                  "property int vertex2\nend_header\n", // as some programs say
                                  big ? "big" : "little");
    for (int v = 0; v < 4; v++) {
        const double quality = NAN; // left out, so it may be anything
        for (int k = 0; k < 3; k++) size += put(bytes + size, &places[v][k], 4, big);
        size += put(bytes + size, &quality, 8, big);
        memcpy(bytes + size, (const unsigned char[]){255, 0, 255}, 3);
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
        struct surface s;
        assert_good("a.ply", bytes, size, TWO_TRIANGLES "joined 0 1 color ~1 0 ~1 ~1 0 ~1 ~1 0 ~1 ~1 0 ~1");
        for (size_t cut = 0; cut < size; cut++) { // every length that is too short
            struct error error = {0};
            assert_false(surface_read(temporary_file("cut.ply", bytes, cut), &s, &error));
        }
    }
}

static size_t make_stl(unsigned char *bytes, const char *title, uint32_t count)
{
    static const int corners[] = {0, 1, 2, 0, 2, 3};
    size_t size = 80;
    memset(bytes, 0, 512);
    strcpy((char *)bytes, title);
    size += put(bytes + size, &count, 4, false);
    for (int c = 0; c < 6; c++) {
        if (c % 3 == 0) size += 12;
        for (int k = 0; k < 3; k++) size += put(bytes + size, &places[corners[c]][k], 4, false);
        if (c % 3 == 2) size += 2;
    }
    return size;
}

TEST(binary_stl)
{
    unsigned char bytes[512];
    assert_good("a.stl", bytes, make_stl(bytes, "solid but binary", 2), TWO_TRIANGLES);
    make_stl(bytes, "xolid", 2);
    assert_refused("cut.stl", bytes, 150, "expected 184 bytes for 2 facets, got 150: the file is cut off");
    assert_refused("lie.stl", bytes, make_stl(bytes, "xolid", 4000000000u), "the file is cut off");
}

/// A triangle after `elements` of nothing, its vertices with `properties` of no meaning and one colour.
static const char *print_ply(int elements, int properties, double red)
{
    static char text[4096];
    char *at = stpcpy(text, PLY);
    for (int i = 0; i < elements; i++) at += sprintf(at, "element more 0\n");
    at = stpcpy(at, "element vertex 3\n" XYZ "property float red\nproperty float green\nproperty float blue\n");
    for (int i = 0; i < properties; i++) at += sprintf(at, "property float p%d\n", i);
    at = stpcpy(at, FACE);
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
    static const struct {
        int elements, properties;
        double red;
        const char *says; ///< NULL: it is read
    } rows[] = {{14, 58, 1000, NULL},
                {15, 0, 0, "expected at most 16 elements"},
                {0, 59, 0, "expected at most 64 properties"},
                {0, 0, 1001, "expected a colour from 0 to 1, got 1001"},
                {0, 0, -1001, "expected a colour from 0 to 1, got -1001"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const char *text = print_ply(rows[i].elements, rows[i].properties, rows[i].red);
        if (rows[i].says)
            assert_refused("limit.ply", text, strlen(text), rows[i].says);
        else
            assert_good("limit.ply", text, strlen(text), "indices 0 1 2");
    }
}

// --- looks, and what is written

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
    assert_memory_equal(in.position, position, sizeof position);
    assert_facts_of(&in, numbers_of, "round.obj",
                    "vertices 3 indices 2 0 1 color ~0 ~1 ~0.5 ~0.001 ~0.2 ~0.9 ~1 ~1 ~1");
    surface_free(&in);
    assert_refusal(obj_write("/nowhere/a.obj", &out, &error), "/nowhere/a.obj");
}

/// An OBJ with its materials beside it has these facts, and still has them when it was written and read again; returns that.
static struct surface read_twice(const char *name, const char *text, const char *materials, const char *mtl,
                                 const char *facts)
{
    char again[64];
    snprintf(again, sizeof again, "again_%s", name);
    temporary_file(materials, mtl, strlen(mtl));
    struct surface first = read_good(name, text, strlen(text)), second;
    assert_facts_of(&first, numbers_of, name, facts);
    assert_done(obj_write(temporary_path(again), &first, &error));
    assert_done(surface_read(temporary_path(again), &second, &error));
    assert_facts_of(&second, numbers_of, again, facts);
    for (int m = 0; m < first.looks.material_count; m++)
        assert_string_equal(second.looks.materials[m].name, first.looks.materials[m].name);
    surface_free(&first);
    return second;
}

/// Two quads of two materials, one textured, with a seam between them: vertices 1 and 2 have two texture coordinates each.
TEST(looks_come_through)
{
    static const unsigned char png[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0};
    temporary_file("wood grain.png", png, sizeof png);
    struct surface s = read_twice(
        "m.obj",
        "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\n"
        "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl red one\nf 1/1 2/2 3/3 4/4\nusemtl wood\nf 2/1 5/2 6/3 3/4\n",
        "m.mtl", "newmtl red one\nKd 1 0.5 0\nnewmtl wood\nKd 1 1 1\nmap_Kd -s 1 1 1 wood grain.png\n",
        "uv 0 1 1 1 1 0 0 0 textures 0 1 2 0 2 3 0 1 2 0 2 3 joined 0 1 0 1 materials 2 material 0 0 1 1");
    assert_string_equal(s.looks.materials[0].name, "red one");
    assert_near(s.looks.materials[0].color[1], 0.5, 0);
    assert_int_equal(s.looks.materials[1].image_size, sizeof png);
    assert_null(s.looks.left_out);
    float position[6][3];
    memcpy(position, s.position, sizeof position);
    struct character character, read;
    assert_true(character_create(&character, &s, 1));
    character.coordinates[0].name = strdup("up");
    character.coordinates[0].re[2][1] = 3;
    assert_done(character_write(temporary_path("m.glb"), &character, true, &error));
    assert_done(character_read(temporary_path("m.glb"), &read, &error));
    assert_int_equal(read.vertex_count, 6 + 2);
    assert_memory_equal(read.position, position, sizeof position); // first those of the mesh, in its order
    assert_near(read.coordinates[0].re[2][1], 3, 0);
    assert_near(read.coordinates[0].re[6][1] + read.coordinates[0].re[7][1], 3, 0); // and its copy at the seam
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
}

/// A name may end in blanks in one of the two files, and in a backslash, which at the end of a line would join it to the next. One in Latin-1
/// is UTF-8 from then on, because it goes into JSON.
TEST(names_of_materials_come_through)
{
    struct surface s = read_twice(
        "n.obj", "mtllib n.mtl\n" THREE_OF_OBJ "usemtl red\nf 1 2 3\nusemtl back\\ \nf 1 3 2\n", "n.mtl",
        "newmtl red \t\r\nKd 1 0.5 0\nnewmtl back\\\nKd 0 0 1\n", "indices 0 1 2 0 2 1 materials 2 material 0 1");
    assert_string_equal(s.looks.materials[0].name, "red");
    assert_near(s.looks.materials[0].color[1], 0.5, 0);
    assert_string_equal(s.looks.materials[1].name, "back\\");
    assert_near(s.looks.materials[1].color[0], 0, 0);
    surface_free(&s);
    s = read_twice("l.obj", THREE_OF_OBJ "usemtl caf\xe9\nf 1 2 3\nusemtl x\nf 1 2 3\nusemtl caf\xe9\nf 3 2 1\n",
                   "l.mtl", "", "materials 2 material 0 1 0");
    assert_string_equal(s.looks.materials[0].name, "caf\xef\xbf\xbd");
    surface_free(&s);
}

/// With memory for only so many calls of the JSON library, the file is written whole or not at all.
static long calls_left;
static void *stingy(size_t size) { return calls_left-- > 0 ? malloc(size) : NULL; }

TEST(nothing_is_written_where_memory_is_short)
{
    struct surface s = read_good("square.obj", FIVE_OF_OBJ "f 1 2 3 4\n", strlen(FIVE_OF_OBJ "f 1 2 3 4\n"));
    struct character c, read;
    assert_true(character_create(&c, &s, 1));
    c.coordinates[0].name = strdup("up");
    bool written = false;
    long calls = 0;
    for (; !written && calls < 100000; calls++) {
        const char *path = temporary_path("short.glb");
        remove(path);
        calls_left = calls;
        json_set_alloc_funcs(stingy, free);
        written = character_write(path, &c, true, NULL);
        json_set_alloc_funcs(malloc, free);
        if (!written) assert_int_equal(access(path, F_OK), -1);
    }
    assert_true(written && calls > 100);
    assert_done(character_read(temporary_path("short.glb"), &read, &error));
    assert_int_equal(read.coordinate_count, 1);
    character_free(&read);
    character_free(&c);
}

// --- which triangles are across edges, and where a mesh ends: outlines are softened there, and nowhere else

static const float square[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
static const float split[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1.7e-7f, 0, 0}, {1, 1, 0}, {0, 1, 0}};

TEST(triangles_across_edges)
{
    enum { NONE = NEIGHBOUR_NONE, ANY = -9 };
    static const struct {
        const char *what;
        const float (*position)[3];
        int vertices, count;
        uint32_t indices[12];
        int neighbours[12];
    } rows[] = {
        {"a sheet ends at its border", square, 4, 6, {0, 1, 2, 0, 2, 3}, {NONE, NONE, 1, 0, NONE, NONE}},
        {"vertices at one place are one", split, 6, 6, {0, 1, 2, 3, 4, 5}, {NONE, NONE, 1, 0, NONE, NONE}},
        // the diagonal leads to the other front, not to its own back; the border leads round to the back
        {"sheets back to back go on in themselves",
         square,
         4,
         12,
         {0, 1, 2, 0, 2, 1, 0, 2, 3, 0, 3, 2},
         {1, 1, 2, 3, 0, 0, 0, 3, 3, 2, 2, 1}},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        int found[12];
        neighbours_find(rows[r].position, rows[r].vertices, rows[r].indices, rows[r].count, found);
        for (int i = 0; i < rows[r].count; i++)
            if (found[i] != rows[r].neighbours[i])
                fail_msg("%s: edge %d leads to %d, expected %d", rows[r].what, i, found[i], rows[r].neighbours[i]);
    }
}

/// A fan of more triangles than are looked at, around its middle.
TEST(large_fans_are_whole)
{
    enum { MANY = 500 };
    static float position[MANY + 1][3];
    static uint32_t indices[3 * MANY];
    static int neighbours[3 * MANY];
    for (int i = 0; i < MANY; i++) {
        position[i + 1][0] = cosf(6.2831853f * (float)i / MANY);
        position[i + 1][1] = sinf(6.2831853f * (float)i / MANY);
        indices[3 * i + 1] = (uint32_t)i + 1;
        indices[3 * i + 2] = (uint32_t)(i + 1) % MANY + 1;
    }
    neighbours_find((const float(*)[3])position, MANY + 1, indices, 3 * MANY, neighbours);
    for (int i = 0; i < MANY; i++) assert_int_equal(neighbours[3 * i + 2], (i + 1) % MANY);
}

/// The later of two triangles ends where materials or colours change, the earlier one goes on.
TEST(looks_cut)
{
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    static const float red[3] = {1, 0, 0}, blue[3] = {0, 0, 1};
    const uint32_t looks[] = {neighbours_look(0, red), neighbours_look(1, red), neighbours_look(0, blue)};
    for (int o = 0; o < 3; o++) {
        const uint32_t look[6] = {looks[0], looks[0], looks[0], looks[o], looks[o], looks[o]};
        int neighbours[6];
        neighbours_find(square, 4, indices, 6, neighbours);
        neighbours_cut(square, indices, look, 6, neighbours);
        assert_int_equal(neighbours[3], o ? NEIGHBOUR_CUT : 0);
        assert_int_equal(neighbours[2], 1);
    }
}
