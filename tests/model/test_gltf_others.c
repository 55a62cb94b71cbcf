/// glTF files that others made. Compressed meshes of gltf-transform's (tests/others/pack.mjs): what is read of them is what went in, and what
/// claims or says something else is refused in little memory. And where their packages are, Debian's assimp-testmodels, and the hands and
/// controllers of npm's @webxr-input-profiles/assets, which this test fetches: the numbers to compare with are three.js 0.187's (GLTFLoader,
/// AnimationMixer, getVertexPosition).
#include "base/file.h"
#include "gltf_builder.h"
#include "model/glb.h"
#include "model/vector.h"
#include <ftw.h>
#include <sys/resource.h>
#include <sys/wait.h>

/// Vertices of a node of a file (NULL: the only one with a mesh), at a time of its last clip.
static int pose_node(const struct gltf *gltf, const char *name, double time, float (*vertices)[3],
                     float (*normals)[3])
{
    struct gltf_pose pose;
    const int node = name ? gltf_find_node(gltf, name) : 0;
    assert_true(node >= 0 && gltf_pose_create(gltf, &pose));
    gltf_pose_clip(gltf, gltf->clip_count - 1, time, &pose);
    gltf_pose_world(gltf, &pose);
    gltf_pose_vertices(gltf, &pose, node, vertices, normals);
    gltf_pose_free(&pose);
    return gltf_vertex_count(gltf, node);
}

// --- compressed

static const char *const names[] = {"draco", "meshopt"};
static const char *const extensions[] = {"KHR_draco_mesh_compression", "EXT_meshopt_compression"};

/// The file, which the caller frees; NULL where the library is missing, as the sentence says then.
static char *packed(int which, size_t *size)
{
    char path[64], *data;
    struct gltf gltf;
    const char *package = glb_missing_codec(extensions[which]);
    snprintf(path, sizeof path, "tests/fuzz/seeds/gltf/%s.glb", names[which]);
    assert_done(file_read(path, 1 << 20, &data, size, &error));
    if (!package) return data;
    assert_refusal(gltf_read(path, &gltf, &error), "expected meshes that are not compressed, got ");
    assert_refusal(gltf_read(path, &gltf, &error), package);
    print_message("skip - %s is not installed\n", package);
    free(data);
    return NULL;
}

/// A strip of 5 × 5 vertices at (x, y, x y), whose normals say so, in any order. A clip bends it.
TEST(meshes_are_decompressed)
{
    enum { COUNT = 25 };
    for (int which = 0; which < 2; which++) {
        float place[COUNT][3], normal[COUNT][3], bent[COUNT][3];
        size_t size;
        struct gltf gltf;
        int seen = 0;
        char *data = packed(which, &size);
        if (!data) continue;
        assert_done(gltf_read_bytes(names[which], data, size, &gltf, &error));
        assert_null(gltf.not_shown);
        const struct gltf_part *part = gltf.meshes[0].parts;
        assert_int_equal(part->index_count, 32 * 3);
        assert_int_equal(pose_node(&gltf, "strip", 0, place, normal), COUNT);
        pose_node(&gltf, "strip", 1, bent, NULL);
        for (int n = 0; n < COUNT; n++) {
            const double x = (double)place[n][0], y = (double)place[n][1], length = sqrt(x * x + y * y + 1);
            assert_near((double)place[n][2], x * y, 1e-3);
            assert_near((double)normal[n][0], -y / length, 0.02);
            assert_near((double)normal[n][1], -x / length, 0.02);
            assert_near(4 * x, round(4 * x), 4e-3);
            seen |= 1 << (int)(round(4 * x) + 5 * round(4 * y));
            if (y < 0.1) assert_near(bent[n][0], 0.28 * x - 0.96 * y, 2e-3); // its root turns by (0, 0, 0.6, 0.8)
        }
        assert_int_equal(seen, (1 << COUNT) - 1);
        for (int i = 0; i < part->index_count; i += 3) {
            const uint32_t *corner = part->indices + i;
            assert_true(triangle_normal(place[corner[0]], place[corner[1]], place[corner[2]]).z > 0);
        }
        gltf_free(&gltf);
    }
}

/// Puts a text of the same length in the place of another.
static void replace(char *data, size_t size, const char *from, const char *to)
{
    char *at = memmem(data, size, from, strlen(from));
    assert_non_null(at);
    assert_int_equal(strlen(from), strlen(to));
    memcpy(at, to, strlen(to));
}

TEST(wrong_claims_are_refused)
{
    static const struct {
        int file;
        const char *from, *to, *says;
    } cases[] = {
        {0, "\"bufferView\":2,\"attributes\":{\"POSITION\":0", "\"bufferView\":9,\"attributes\":{\"POSITION\":0",
         "a Draco mesh"},
        {0, "\"bufferView\":2,\"attributes\":{\"POSITION\":0", "\"bufferView\":0,\"attributes\":{\"POSITION\":0",
         "a Draco mesh"},
        {0, "\"JOINTS_0\":2,", "\"JOINTS_0\":8,", "a Draco mesh"},
        {0, "\"indices\":0", "\"indices\":9", "a Draco mesh"},
        {0, "\"type\":\"VEC3\",\"componentType\":5126,\"count\":25}",
         "\"type\":\"VEC3\",\"componentType\":5124,\"count\":25}", "a Draco mesh"},
        {1, "\"byteStride\":2,\"count\":96", "\"byteStride\":2,\"count\":95", "bufferViews[2]"},
        {1, "\"byteStride\":2,\"count\":96", "\"byteStride\":9,\"count\":96", "bufferViews[2]"},
        {1, "\"byteStride\":4,\"count\":25", "\"byteStride\":4,\"count\":99", "bufferViews[3]"},
        {1, "\"filter\":\"OCTAHEDRAL\",\"byteStride\":4,\"count\":25",
         "\"byteStride\":256,\"count\":2000000000            ", "bufferViews[3]"},
        {1, "TRIANGLES", "QUADRANTS", "bufferViews[2]"},
        {1, "QUATERNION", "QUATERNARY", "bufferViews[1]"},
        {1, "\"buffer\":0,\"byteOffset\":152,\"byteLength\":95", "\"buffer\":1,\"byteOffset\":152,\"byteLength\":95",
         "bufferViews[3]"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        size_t size;
        struct gltf gltf;
        char *data = packed(cases[i].file, &size);
        if (!data) continue;
        replace(data, size, cases[i].from, cases[i].to);
        assert_refusal(gltf_read_bytes("claims.glb", data, size, &gltf, &error), cases[i].says);
    }
}

/// Draco's header may claim any number of faces and vertices: its library would take gigabytes for these.
TEST(a_claim_of_a_huge_mesh_takes_little_memory)
{
    static const char claim[] = "\xff\xff\xff\x1f\xff\xff\xff\x1f\0\xff\xff\xff\x1f";
    size_t size;
    struct gltf gltf;
    struct rusage before, after;
    char *data = packed(0, &size);
    if (!data) return;
    memcpy((char *)memmem(data, size, "DRACO", 5) + 12, claim, sizeof claim);
    getrusage(RUSAGE_SELF, &before);
    assert_refusal(gltf_read_bytes("claims.glb", data, size, &gltf, &error), "a Draco mesh");
    getrusage(RUSAGE_SELF, &after);
    assert_in_range(after.ru_maxrss - before.ru_maxrss, 0, 100 << 10); // KiB
}

/// Every byte that is compressed is changed: the file is read or refused (the sanitizers watch).
TEST(changed_bytes_do_no_harm)
{
    for (int which = 0; which < 2; which++) {
        size_t size, start;
        int refused = 0;
        char *data = packed(which, &size);
        if (!data) continue;
        start = 20 + *(uint32_t *)(void *)(data + 12) + 8;
        for (size_t at = start; at < size; at++) {
            struct gltf gltf;
            struct error error = {0};
            char *changed = malloc(size + 1);
            memcpy(changed, data, size);
            changed[at] = (char)(at % 3 == 0 ? ~changed[at] : at % 3 == 1 ? changed[at] + 1 : 0xFF);
            const bool opened = gltf_read_bytes("changed.glb", changed, size, &gltf, &error);
            refused += !opened;
            if (opened) gltf_free(&gltf);
        }
        assert_in_range(refused, 10, size - start - 10);
        free(data);
    }
}

// --- of packages

#define MODELS "/usr/share/assimp/models/glTF2/"

static bool there(const char *folder, const char *why)
{
    if (access(folder, R_OK) == 0) return true;
    print_message("skip - %s\n", why);
    return false;
}

/// What of assimp's models is wrong on purpose, or compressed where Draco's library is missing.
static bool is_bad(const char *path)
{
    static const char *const bad[] = {"BoxWithInfinites", "IndexOutOfRange", "MissingBin", "RecursiveNodes",
                                      "SchemaFailures",   "TestNoRootNode",  "draco",      "wrongTypes"};
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        if (strstr(path, bad[i])) return true;
    }
    return false;
}

static int met, opened; ///< files; make test opens every third

static int open_one(const char *path, const struct stat *about, int type, struct FTW *place)
{
    struct gltf gltf;
    struct error error = {0};
    const char *dot = strrchr(path, '.');
    (void)about, (void)place;
    if (type != FTW_F || !dot || (strcmp(dot, ".glb") != 0 && strcmp(dot, ".gltf") != 0)) return 0;
    if (met++ % quick_or_all(3, 1) != 0) return 0;
    if (gltf_read(path, &gltf, &error)) {
        opened++;
        gltf_free(&gltf);
    } else {
        assert_non_null(strstr(error.text, path));
        if (!is_bad(path)) fail_msg("%s", error.text);
    }
    return 0;
}

static void open_all(const char *folder, int least)
{
    met = opened = 0;
    assert_int_equal(nftw(folder, open_one, 16, FTW_PHYS), 0);
    print_message("%d files of %s opened\n", opened, folder);
    assert_true(met >= least && opened >= least / quick_or_all(3, 1));
}

TEST(every_model_of_assimp_opens)
{
    if (there(MODELS, "assimp-testmodels is not installed")) open_all(MODELS, 30);
}

static int vertices_of(const char *path, double time, const char *node, float (*vertices)[3])
{
    struct gltf gltf;
    assert_done(gltf_read(path, &gltf, &error));
    const int count = pose_node(&gltf, node, time, vertices, NULL);
    gltf_free(&gltf);
    return count;
}

/// The lowest coordinates, the highest and their means.
static void assert_extent(float (*vertices)[3], int count, const double expected[3][3])
{
    for (int k = 0; k < 3; k++) {
        double lo = INFINITY, hi = -INFINITY, sum = 0;
        for (int i = 0; i < count; i++) {
            double x = (double)vertices[i][k];
            lo = fmin(lo, x);
            hi = fmax(hi, x);
            sum += x;
        }
        assert_near(lo, expected[0][k], 2e-6);
        assert_near(hi, expected[1][k], 2e-6);
        assert_near(sum / count, expected[2][k], 2e-6);
    }
}

TEST(a_skin_moves_as_in_three_js)
{
    const double strip[10][2] = {{-0.5, 0},
                                 {0.5, 0},
                                 {-0.320314, 0.456882},
                                 {0.543118, 0.679686},
                                 {-0.363432, 0.777196},
                                 {0.363432, 1.222804},
                                 {-0.629353, 0.960941},
                                 {-0.039059, 1.629353},
                                 {-1.118079, 1.008118},
                                 {-0.664353, 1.899334}};
    float vertices[24][3];
    if (!there(MODELS "simple_skin", "assimp-testmodels is not installed")) return;
    assert_int_equal(vertices_of(MODELS "simple_skin/simple_skin.gltf", 0.7, NULL, vertices), 10);
    for (int i = 0; i < 10; i++) {
        assert_near(vertices[i][0], strip[i][0],
                    2e-4); // its quaternions have three digits, and three.js leaves them at that
        assert_near(vertices[i][1], strip[i][1], 2e-4);
        assert_near(vertices[i][2], 0, 0);
    }
}

TEST(morph_targets_move_as_in_three_js)
{
    const double expected[3][3] = {{-1, -1, -1}, {1, 1, -0.718533}, {0, 0, -0.859267}};
    float vertices[24][3];
    if (!there(MODELS "glTF-Sample-Models", "assimp-testmodels is not installed")) return;
    vertices_of(MODELS "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 1.3, NULL, vertices);
    assert_extent(vertices, 24, expected);
}

/// Fetched once into the build folder.
static bool fetch_profiles(char *folder, size_t size)
{
    const char *build = getenv("B");
    char command[1024];
    snprintf(folder, size, "%s/gltf-others/node_modules/@webxr-input-profiles/assets/dist/profiles",
             build ? build : "build");
    snprintf(command, sizeof command, "timeout 60 tools/npm/fetch.sh '%s/gltf-others' profiles",
             build ? build : "build");
    const int status = system(command);
    assert_false(WIFEXITED(status) && WEXITSTATUS(status) == 3); // another package
    return there(folder, "there are no models of @webxr-input-profiles/assets");
}

TEST(hands_and_controllers_open)
{
    const double expected[3][3] = {
        {-0.056579, -0.133697, -0.079510}, {0.020442, 0.078344, 0.066395}, {-0.021134, -0.036206, 0.006453}};
    static float vertices[1360][3];
    char folder[512], hand[600];
    if (!fetch_profiles(folder, sizeof folder)) return;
    open_all(folder, 60);
    snprintf(hand, sizeof hand, "%s/generic-hand/left.glb", folder);
    assert_int_equal(vertices_of(hand, 0, "l_handMeshNode", vertices), 1360);
    assert_extent(vertices, 1360, expected);
}
