/// What a person sees on the stage, drawn offscreen; and the skin that is drawn there.
#include "model/fox.h"
#include "models/fox_maker.h"
#include "offscreen.h"
#include "posed_tail.h"

enum { WIDTH = 1000, HEIGHT = 400, JOINTS = 24 };

static struct stage_view view;
static struct pose posed;
static struct models *models; ///< of its fox
static struct rig_pose fox;
static unsigned char pixels[HEIGHT][WIDTH][4]; ///< bottom row first

/// A tail lifted in a curve to the right side of its animal, its camera and its shadows.
static void arrange(double side)
{
    static struct channel channel;
    struct tail tail = {.joints = JOINTS,
                        .length = 1.6,
                        .position = {{0.0, -1}, {FOX_BASE_HEIGHT, -1}, {0.0, -1}},
                        .channels = &channel,
                        .channel_count = 1};
    tail.rest.value[0] = 2.0;
    channel = (struct channel){.axis = AXIS_SIDE};
    channel.gain.value[0] = side;
    memset(&view, 0, sizeof view);
    view.colors = theme()->stage;
    if (!models) models = models_create();
    pose_tail_in(models, &tail, &(wiggly_value){.y = 1.0}, LOOK_WIGGLY, &posed, &fox);
    struct stage_model *shown = &view.models[view.model_count++];
    *shown = (struct stage_model){.gltf = &fox.model.imported->gltf,
                                  .pose = fox.model.pose,
                                  .ground = fox.model.ground,
                                  .dusk = 0.35f * posed.scale};
    memcpy(shown->root, fox.model.root, sizeof shown->root);
    rig_bounds(&fox, shown->lo, shown->hi);
    view.has_tail = true;
    float lo[3], hi[3];
    struct camera camera = camera_default();
    pose_bounds(&posed, lo, hi);
    camera_fit(&camera, lo, hi, (float)WIDTH / HEIGHT, 0);
    camera_matrices(&camera, (float)WIDTH / HEIGHT, view.view, view.projection, view.eye);
    camera_lamp(&camera, view.key_from);
    view.blob_count = pose_blobs(&posed, view.key_from, view.blobs, STAGE_MAX_BLOBS);
}

static void draw(void) { offscreen_draw(&view, WIDTH, HEIGHT, pixels); }

/// The pixel where a point of the world is seen.
static const unsigned char *pixel_of(const float world[3])
{
    const float whole[4] = {0.0f, 0.0f, WIDTH, HEIGHT};
    float screen[2];
    assert_true(camera_project(view.view, view.projection, whole, world, screen));
    assert_true(screen[0] >= 0.0f && screen[0] < WIDTH && screen[1] > 0.0f && screen[1] <= HEIGHT);
    return pixels[(int)(HEIGHT - screen[1])][(int)screen[0]];
}

static int brightness(const unsigned char *pixel) { return pixel[0] + pixel[1] + pixel[2]; }

static bool is_fur(const unsigned char *pixel) { return pixel[0] > 60 && pixel[0] > pixel[2] + 25; }

TEST(the_tail_is_drawn_where_its_joints_are)
{
    if (!platform) skip();
    for (int side = -3; side <= 3; side += 2) {
        arrange(side);
        draw();
        int fur = 0;
        for (int n = 2; n < JOINTS - 4; n++) fur += is_fur(pixel_of(posed.matrix[n] + 12));
        assert_true(fur >= JOINTS - 8); // a dark band may miss
        const unsigned char *tip = pixel_of(posed.matrix[JOINTS - 1] + 12);
        assert_true(brightness(tip) > 300 && abs(tip[0] - tip[2]) < 60); // the white tip
    }
}

TEST(where_nothing_is_the_background_is_dark_and_even)
{
    if (!platform) skip();
    arrange(1.0);
    draw();
    for (int x = 0; x < WIDTH; x++) {
        const unsigned char *top = pixels[HEIGHT - 1][x];
        assert_near(top[0], 0x1B, 2.0);
        assert_near(top[1], 0x20, 2.0);
        assert_near(top[2], 0x28, 2.0);
    }
}

TEST(the_ground_is_darker_under_the_animal)
{
    if (!platform) skip();
    arrange(1.0);
    const float beside[3] = {0.32f, 0.0f, -0.25f}; // on the near side of the body, nothing in front
    draw();
    const int shadowed = brightness(pixel_of(beside));
    view.blob_count = 0;
    draw();
    const int lit = brightness(pixel_of(beside));
    assert_false(is_fur(pixel_of(beside)));
    assert_true(shadowed < lit - 12);
}

/// Without multisampling: coming from the left, edges of the animal cross rows of pixels at any fraction of a pixel, so
/// that the first pixel that differs from the background is as often weak as strong.
TEST(silhouettes_are_soft)
{
    if (!platform) skip();
    arrange(0.0);
    draw();
    int rows = 0, shares[4] = {0};
    for (int y = HEIGHT / 2; y < HEIGHT; y++) {
        const int background = brightness(pixels[y][0]);
        int x = 1;
        while (x < WIDTH - 3 && brightness(pixels[y][x]) < background + 8) x++;
        const int whole = brightness(pixels[y][x + 2]) - background;
        if (x == WIDTH - 3 || whole < 100) continue;
        const int share = 4 * (brightness(pixels[y][x]) - background) / whole;
        shares[share < 0 ? 0 : share > 3 ? 3 : share]++;
        rows++;
    }
    assert_true(rows > 100);
    for (int quarter = 0; quarter < 4; quarter++) assert_true(shares[quarter] > rows / 16);
}

struct skinned {
    float world[3], normal[3];
};

/// Bind-space vertices in, world positions and normals out: as the stage draws them, on a coat of their own.
static void skin(const struct vertex *vertices, int count, struct skinned *out)
{
    struct gltf own;
    fox_create(FOX_LEVELS - 1, JOINTS, &own);
    struct gltf_part *coat = &own.meshes->parts[0];
    const size_t whole = (size_t)gltf_vertex_count(&own, own.node_count - 1);
    float(*place)[3] = calloc(whole, sizeof *place), (*normal)[3] = calloc(whole, sizeof *normal);
    assert_true(place && normal && count <= coat->vertex_count);
    for (int i = 0; i < count; i++) {
        memcpy(coat->position[i], vertices[i].position, sizeof coat->position[i]);
        memcpy(coat->normal[i], vertices[i].normal, sizeof coat->normal[i]);
        memset(coat->along[i], 0, sizeof coat->along[i]);
        coat->fur[i][0] = vertices[i].bend;
    }
    coat->vertex_count = count;
    fox_hang(coat, JOINTS);
    gltf_pose_vertices(&own, fox.model.pose, own.node_count - 1, place, normal);
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) out[i].world[k] = fox.model.root[0] * place[i][k] + fox.model.root[12 + k];
        memcpy(out[i].normal, normal[i], sizeof *normal);
    }
    free(place);
    free(normal);
    gltf_free(&own);
}

static void cross(const float a[3], const float b[3], float out[3])
{
    for (int k = 0; k < 3; k++) out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static float normalise(float v[3])
{
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
    for (int k = 0; k < 3; k++) v[k] /= length;
    return length;
}

enum { PLACES = 60 };

/// For PLACES points of the tail's skin: the vertex itself, then one beside it along each of two tangents.
static void skin_places(struct vertex places[3 * PLACES])
{
    const float step = 1e-3f;
    struct mesh mesh = {0};
    mesh_fox_tail(100, 40, &mesh);
    for (int p = 0; p < PLACES; p++) {
        const struct vertex *vertex = &mesh.vertices[(15 + p) * 40 + p * 7 % 40];
        float around[3] = {-vertex->normal[1], vertex->normal[0], 0.0f}, along[3];
        normalise(around);
        cross(vertex->normal, around, along);
        for (int corner = 0; corner < 3; corner++) {
            const float *tangent = corner == 1 ? around : along;
            places[3 * p + corner] = *vertex;
            for (int k = 0; k < 3; k++) places[3 * p + corner].position[k] += corner ? step * tangent[k] : 0.0f;
        }
    }
    mesh_free(&mesh);
}

/// The normal of the skin is that of its surface, by finite differences.
TEST(normals_are_right_under_bending)
{
    static struct vertex places[3 * PLACES];
    static struct skinned out[3 * PLACES];
    skin_places(places);
    for (int side = 0; side <= 12; side += 6) { // degrees a joint
        arrange(side);
        skin(places, 3 * PLACES, out);
        for (int p = 0; p < PLACES; p++) {
            const struct skinned *at = &out[3 * p];
            float u[3], v[3], n[3];
            for (int k = 0; k < 3; k++) {
                u[k] = at[1].world[k] - at[0].world[k];
                v[k] = at[2].world[k] - at[0].world[k];
            }
            cross(u, v, n);
            normalise(n);
            for (int k = 0; k < 3; k++) assert_near(at[0].normal[k], n[k], 0.02);
        }
    }
}

/// Files have room for four influences a vertex, whose sum is 1, however many joints the tail has.
TEST(influences_fit_files)
{
    static const int joints[] = {1, 2, 3, 24, 256};
    for (size_t n = 0; n < sizeof joints / sizeof *joints; n++) {
        struct gltf own;
        fox_create(1, joints[n], &own);
        for (int p = 0; p < own.meshes->part_count; p++) {
            const struct gltf_part *part = &own.meshes->parts[p];
            for (int v = 0; v < part->vertex_count; v++) {
                float sum = 0.0f;
                for (int k = 0; k < 4; k++) sum += part->weights[v][k];
                assert_near(sum, 1.0, 1e-6);
                for (int k = 0; k < 4; k++) assert_true(part->joints[v][k] < own.joint_count);
            }
        }
        gltf_free(&own);
    }
}

/// However tight a bend, places are finite and normals unit vectors: the picture has no holes and no sparks.
TEST(extreme_bends_stay_finite)
{
    static struct vertex places[3 * PLACES];
    static struct skinned out[3 * PLACES];
    skin_places(places);
    static const double sides[] = {45.0, 90.0, 179.0, 180.0, 5000.0}; // degrees a joint
    for (size_t s = 0; s < sizeof sides / sizeof *sides; s++) {
        arrange(sides[s]);
        skin(places, 3 * PLACES, out);
        for (int p = 0; p < 3 * PLACES; p++) {
            float normal[3] = {out[p].normal[0], out[p].normal[1], out[p].normal[2]};
            assert_near(normalise(normal), 1.0, 1e-3);
            for (int k = 0; k < 3; k++) assert_near(out[p].world[k], 0.0, 3.0);
        }
    }
}

/// A straight tail is where it was made; a bent one keeps to its chain of joints.
TEST(skin_follows_the_joints)
{
    static struct vertex axis[JOINTS];
    static struct skinned out[JOINTS];
    for (int n = 0; n < JOINTS; n++) {
        axis[n] = (struct vertex){.position = {0, 0, 1.6f * (float)n / JOINTS}, .normal = {1, 0, 0}, .bend = 1.0f};
    }
    for (int side = 0; side <= 8; side += 8) {
        arrange(side);
        skin(axis, JOINTS, out);
        for (int n = 0; n < JOINTS; n++) {
            const float *joint = posed.matrix[n] + 12;
            for (int k = 0; k < 3; k++) assert_near(out[n].world[k], joint[k], 0.015);
        }
    }
}

OFFSCREEN(WIDTH, HEIGHT)
