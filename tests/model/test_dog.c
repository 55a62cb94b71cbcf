/// The committed dog: whole, small, with joints to hang chains on, and clips that loop and leave the chains to wiggly.
#include "near.h"
#include "temporary.h"

#include "model/gltf.h"

#define DOG "assets/models/dog.glb"
enum { KEYS = 24, LEGS = 4 };

static struct gltf dog;

static int open_dog(void **state)
{
    (void)state;
    struct error error = {0};
    if (gltf_read(DOG, &dog, &error)) return 0;
    print_error("%s\n", error.text);
    return -1;
}

static int close_dog(void **state)
{
    (void)state;
    gltf_free(&dog);
    return 0;
}

static int node(const char *name)
{
    const int found = gltf_find_node(&dog, name);
    if (found < 0) fail_msg("%s has no joint %s", DOG, name);
    return found;
}

TEST(is_small_and_fully_shown)
{
    struct stat file;
    assert_int_equal(stat(DOG, &file), 0);
    assert_true(file.st_size <= 1000000);
    int triangles = 0;
    for (int p = 0; p < dog.meshes[0].part_count; p++) triangles += dog.meshes[0].parts[p].index_count / 3;
    assert_in_range(triangles, 8000, 20000);
    assert_null(dog.not_shown);
    assert_near((double)dog.lo[1], 0.0, 2e-3); // it stands on the ground
}

/// A chain is a row of joints, each the child of the one before.
TEST(has_chains)
{
    static const struct {
        const char *name, *above, *suffix;
        int joints;
    } chains[] = {{"tail", "hips", "", 8}, {"ear", "head", "_L", 4}, {"ear", "head", "_R", 4}};
    for (size_t c = 0; c < sizeof chains / sizeof *chains; c++) {
        int before = node(chains[c].above);
        for (int n = 1; n <= chains[c].joints; n++) {
            char name[32];
            snprintf(name, sizeof name, "%s_%d%s", chains[c].name, n, chains[c].suffix);
            assert_int_equal(dog.nodes[node(name)].parent, before);
            before = node(name);
        }
    }
    static const char *const others[] = {"spine_1",       "chest",        "neck",       "jaw",
                                         "thigh_front_L", "shin_front_R", "foot_back_L"};
    for (size_t n = 0; n < sizeof others / sizeof *others; n++) node(others[n]);
}

TEST(clips_loop)
{
    static const char *const names[] = {"Walk", "Trot", "Idle"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++) {
        const int number = gltf_find_clip(&dog, names[n]);
        assert_true(number >= 0);
        const struct gltf_clip *clip = &dog.clips[number];
        assert_true(clip->channel_count > 0);
        for (int i = 0; i < clip->channel_count; i++) {
            const struct gltf_channel *c = &clip->channels[i];
            const float *last = c->values + (size_t)c->components * (size_t)(c->key_count - 1);
            assert_int_equal(c->interpolation, GLTF_LINEAR);
            assert_memory_equal(c->values, last, sizeof *last * (size_t)c->components);
            for (int k = 1; c->path == GLTF_ROTATION && k < c->key_count; k++) {
                const float *a = c->values + 4 * (k - 1), *b = a + 4;
                assert_true(a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3] > 0.0f); // the short way
            }
            const char *joint = dog.nodes[c->node].name;
            if (strncmp(joint, "tail", 4) == 0 || strncmp(joint, "ear", 3) == 0)
                fail_msg("%s moves %s, which is for splines", names[n], joint);
        }
    }
    assert_near(dog.clips[gltf_find_clip(&dog, "Walk")].last, 1.0, 1e-6);
}

/// In the walk each paw stands for well over half of the time, and all the while moves back at one pace: it would not slip on a
/// moving ground.
TEST(paws_stay_planted)
{
    static const char *const toes[LEGS] = {"toe_front_L", "toe_front_R", "toe_back_L", "toe_back_R"};
    struct gltf_pose pose;
    assert_true(gltf_pose_create(&dog, &pose));
    for (int leg = 0; leg < LEGS; leg++) {
        const int toe = node(toes[leg]);
        float rest, at[KEYS + 1][2];
        gltf_pose_clip(&dog, -1, 0.0, &pose);
        gltf_pose_world(&dog, &pose);
        rest = pose.world[toe][13];
        for (int k = 0; k <= KEYS; k++) {
            gltf_pose_clip(&dog, gltf_find_clip(&dog, "Walk"), (double)k / KEYS, &pose);
            gltf_pose_world(&dog, &pose);
            memcpy(at[k], pose.world[toe] + 13, sizeof at[k]);
        }
        int steps = 0;
        for (int k = 0; k < KEYS; k++) {
            if (fabsf(at[k][0] - rest) > 5e-4f || fabsf(at[k + 1][0] - rest) > 5e-4f) continue;
            assert_near((double)(at[k + 1][1] - at[k][1]), -0.25 / 0.62 / KEYS, 5e-4);
            steps++;
        }
        assert_in_range(steps, KEYS / 2, 17);
    }
    gltf_pose_free(&pose);
}

/// Nothing sinks into the ground, between keys either.
TEST(stays_above_the_ground)
{
    struct gltf_pose pose;
    const int body = node("dog"), count = gltf_vertex_count(&dog, body);
    float(*positions)[3] = malloc((size_t)count * sizeof *positions);
    assert_true(positions && gltf_pose_create(&dog, &pose));
    for (int clip = 0; clip < dog.clip_count; clip++) {
        for (int sample = 0; sample < 16; sample++) {
            gltf_pose_clip(&dog, clip, dog.clips[clip].last * sample / 16, &pose);
            gltf_pose_world(&dog, &pose);
            gltf_pose_vertices(&dog, &pose, body, positions, NULL);
            for (int v = 0; v < count; v++) {
                if (positions[v][1] < -0.003f)
                    fail_msg("%s, sample %d: %g m", dog.clips[clip].name, sample, (double)positions[v][1]);
            }
        }
    }
    gltf_pose_free(&pose);
    free(positions);
}

/// What a model looks like however it is cut into triangles: sums of places, normals, colours and joints' weights over its area.
enum { PER_CORNER = 10, SUMS = PER_CORNER + 64 };

static void add_corner(const struct gltf_part *part, uint32_t v, double area, double *sums)
{
    const float *p = part->position[v], *n = part->normal[v];
    sums[0] += area;
    for (int k = 0; k < 3; k++) {
        sums[1 + k] += area * (double)p[k];
        sums[4 + k] += area * (double)(n[k] * p[k]); // the normals' own sum is nothing
        sums[7 + k] += area * (part->color ? (double)(part->color[v][k] * (1.0f + fabsf(p[k]))) : 1.0);
    }
    for (int i = 0; part->joints && i < GLTF_INFLUENCES; i++) {
        assert_in_range(part->joints[v][i], 0, SUMS - PER_CORNER - 1);
        sums[PER_CORNER + part->joints[v][i]] += area * (double)part->weights[v][i];
    }
}

static void add_part(const struct gltf_part *part, double *sums)
{
    for (int i = 0; i < part->index_count; i += 3) {
        const uint32_t *corner = part->indices + i;
        double edge[2][3];
        for (int e = 0; e < 2; e++) {
            for (int k = 0; k < 3; k++)
                edge[e][k] = (double)(part->position[corner[e + 1]][k] - part->position[corner[0]][k]);
        }
        const double x = edge[0][1] * edge[1][2] - edge[0][2] * edge[1][1],
                     y = edge[0][2] * edge[1][0] - edge[0][0] * edge[1][2],
                     z = edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0];
        for (int c = 0; c < 3; c++) add_corner(part, corner[c], sqrt(x * x + y * y + z * z) / 6, sums);
    }
}

/// The tool still makes the file that is committed, but for another machine's rounding.
TEST(is_what_its_tool_makes)
{
    char path[512], command[1100];
    const char *build = getenv("B");
    struct gltf made;
    if (!is_thorough()) skip();
    snprintf(path, sizeof path, "%s", temporary_path("made.glb"));
    snprintf(command, sizeof command, "%s/dog_glb '%s' >/dev/null", build ? build : "build", path);
    assert_int_equal(system(command), 0);
    assert_done(gltf_read(path, &made, &error));
    assert_int_equal(made.node_count, dog.node_count);
    for (int n = 0; n < dog.node_count; n++) {
        assert_string_equal(made.nodes[n].name, dog.nodes[n].name);
        assert_int_equal(made.nodes[n].parent, dog.nodes[n].parent);
        for (int k = 0; k < 3; k++)
            assert_near(made.nodes[n].place.translation[k], dog.nodes[n].place.translation[k], 1e-5);
    }
    assert_int_equal(made.meshes[0].part_count, dog.meshes[0].part_count);
    for (int p = 0; p < dog.meshes[0].part_count; p++) {
        double sums[2][SUMS] = {{0}};
        add_part(&dog.meshes[0].parts[p], sums[0]);
        add_part(&made.meshes[0].parts[p], sums[1]);
        for (int s = 0; s < SUMS; s++) assert_near(sums[1][s] / sums[0][0], sums[0][s] / sums[0][0], 5e-4);
        for (int c = 0; c < 4; c++) assert_near(made.materials[p].color[c], dog.materials[p].color[c], 1e-5);
    }
    assert_int_equal(made.clip_count, dog.clip_count);
    for (int c = 0; c < dog.clip_count; c++) {
        assert_int_equal(made.clips[c].channel_count, dog.clips[c].channel_count);
        for (int i = 0; i < dog.clips[c].channel_count; i++) {
            const struct gltf_channel *is = &made.clips[c].channels[i], *was = &dog.clips[c].channels[i];
            assert_int_equal(is->key_count * is->components, was->key_count * was->components);
            for (int k = 0; k < was->key_count * was->components; k++)
                assert_near(is->values[k], was->values[k], 1e-5);
        }
    }
    gltf_free(&made);
}

TESTS_BETWEEN(open_dog, close_dog)
