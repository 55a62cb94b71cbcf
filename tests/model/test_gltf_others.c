/// glTF files that others made, where their packages are: Debian's assimp-testmodels, and the hands and controllers of npm's
/// @webxr-input-profiles/assets, which this test fetches. The numbers to compare with are three.js 0.187's (GLTFLoader, AnimationMixer,
/// getVertexPosition).
#include "gltf_builder.h"
#include <ftw.h>
#include <sys/wait.h>

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

/// Vertices of a node of a file, at a time of its first clip.
static int vertices_of(const char *path, double time, int node, float (*vertices)[3])
{
    struct gltf gltf;
    struct gltf_pose pose;
    assert_done(gltf_read(path, &gltf, &error));
    assert_true(gltf_pose_create(&gltf, &pose));
    gltf_pose_clip(&gltf, gltf.clip_count - 1, time, &pose);
    gltf_pose_world(&gltf, &pose);
    if (node < 0) node = gltf_find_node(&gltf, "l_handMeshNode");
    gltf_pose_vertices(&gltf, &pose, node, vertices, NULL);
    int count = gltf_vertex_count(&gltf, node);
    gltf_pose_free(&pose);
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
    assert_int_equal(vertices_of(MODELS "simple_skin/simple_skin.gltf", 0.7, 0, vertices), 10);
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
    vertices_of(MODELS "glTF-Sample-Models/AnimatedMorphCube-glTF/AnimatedMorphCube.gltf", 1.3, 0, vertices);
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
    assert_int_equal(vertices_of(hand, 0, -1, vertices), 1360);
    assert_extent(vertices, 1360, expected);
}
