/// Compressed meshes: what is read of them is what went in, and a file that claims or says something else is refused in little memory.
/// The files are of gltf-transform's (tests/others/pack.mjs). Where a library is missing, the program says which.
#include "base/file.h"
#include "gltf_builder.h"
#include "model/glb.h"
#include "model/vector.h"
#include <sys/resource.h>

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

/// A strip of 5 × 5 vertices at (x, y, x y), whose normals say so, in any order.
static void assert_strip(const struct gltf *gltf)
{
    enum { COUNT = 25 };
    float place[COUNT][3], normal[COUNT][3];
    struct gltf_pose pose;
    const int node = gltf_find_node(gltf, "strip");
    const struct gltf_part *part = gltf->meshes[0].parts;
    int seen = 0;
    assert_int_equal(gltf_vertex_count(gltf, node), COUNT);
    assert_int_equal(part->index_count, 32 * 3);
    assert_true(gltf_pose_create(gltf, &pose));
    gltf_pose_vertices(gltf, &pose, node, place, normal);
    for (int n = 0; n < COUNT; n++) {
        const double x = (double)place[n][0], y = (double)place[n][1], length = sqrt(x * x + y * y + 1);
        assert_near((double)place[n][2], x * y, 1e-3);
        assert_near((double)normal[n][0], -y / length, 0.02);
        assert_near((double)normal[n][1], -x / length, 0.02);
        assert_near(4 * x, round(4 * x), 4e-3);
        seen |= 1 << (int)(round(4 * x) + 5 * round(4 * y));
    }
    assert_int_equal(seen, (1 << COUNT) - 1);
    for (int i = 0; i < part->index_count; i += 3) {
        const uint32_t *corner = part->indices + i;
        assert_true(triangle_normal(place[corner[0]], place[corner[1]], place[corner[2]]).z > 0);
    }
    gltf_pose_clip(gltf, 0, 1, &pose);
    gltf_pose_world(gltf, &pose);
    gltf_pose_vertices(gltf, &pose, node, place, NULL);
    assert_near((double)pose.world[gltf_find_node(gltf, "root")][0], 0.28, 1e-3); // a turn by (0, 0, 0.6, 0.8)
    gltf_pose_free(&pose);
}

TEST(meshes_are_decompressed)
{
    for (int which = 0; which < 2; which++) {
        size_t size;
        struct gltf gltf;
        char *data = packed(which, &size);
        if (!data) continue;
        assert_done(gltf_read_bytes(names[which], data, size, &gltf, &error));
        assert_strip(&gltf);
        assert_null(gltf.not_shown);
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
