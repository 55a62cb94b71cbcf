/// The dog's eyes with lids, nose, tongue, and collar with tag.
#include "model/vector.h"
#include "models/dog.h"
#include "models/mesh.h"
#include <assert.h>
#include <math.h>

#define LID 0x8C5231u
#define EYE_RADIUS 0.044f
#define LASHES 0x2B1D18u
enum { AROUND = 24, RINGS = 5 };

/// A frame for round parts; `axis` points outwards.
struct frame {
    vec3s middle, across, up, axis;
};

static struct frame frame_towards(vec3s middle, vec3s axis, vec3s up)
{
    struct frame f = {.middle = middle, .axis = glms_vec3_normalize(axis)};
    f.across = glms_vec3_normalize(glms_vec3_cross(up, f.axis));
    f.up = glms_vec3_cross(f.axis, f.across);
    return f;
}

static vec3s in_frame(const struct frame *f, float across, float up, float out)
{
    return glms_vec3_muladds(f->axis, out, glms_vec3_muladds(f->up, up, glms_vec3_scale(f->across, across)));
}

static struct mesh *start(struct dog_pieces *pieces, enum dog_material material, int joint)
{
    assert(pieces->count < DOG_MAX_PIECES);
    struct dog_piece *piece = &pieces->pieces[pieces->count++];
    *piece = (struct dog_piece){.material = material, .joint = joint};
    return &piece->mesh;
}

static uint32_t put(struct mesh *mesh, vec3s position, vec3s normal, uint32_t color)
{
    struct vertex vertex = {0};
    memcpy(vertex.position, position.raw, sizeof vertex.position);
    memcpy(vertex.normal, glms_vec3_normalize(normal).raw, sizeof vertex.normal);
    coat_linear(color, vertex.color);
    return mesh_vertex(mesh, &vertex);
}

/// Quads between rows of `columns` vertices, starting at vertex `first`.
static void weave(struct mesh *mesh, uint32_t first, int rows, int columns)
{
    for (int r = 0; r + 1 < rows; r++) {
        for (int c = 0; c + 1 < columns; c++) {
            const uint32_t a = first + (uint32_t)(r * columns + c), b = a + (uint32_t)columns;
            mesh_triangle(mesh, a, b, b + 1);
            mesh_triangle(mesh, a, b + 1, a + 1);
        }
    }
}

/// Flips triangles from an index on.
static void turn_over(struct mesh *mesh, int first_index)
{
    for (int i = first_index; i < mesh->index_count; i += 3) {
        const uint32_t swapped = mesh->indices[i + 1];
        mesh->indices[i + 1] = mesh->indices[i + 2];
        mesh->indices[i + 2] = swapped;
    }
}

/// The part of an ellipsoid `inner` to `outer` radians from its axis.
static void cap(struct mesh *mesh, const struct frame *f, const float radius[3], float inner, float outer, int rings)
{
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (int r = 0; r <= rings; r++) {
        const float tilt = inner + (outer - inner) * (float)r / (float)rings;
        for (int c = 0; c <= AROUND; c++) {
            const float turn = 2.0f * GLM_PIf * (float)c / AROUND;
            const float q[3] = {sinf(tilt) * cosf(turn), sinf(tilt) * sinf(turn), cosf(tilt)};
            const vec3s at = in_frame(f, radius[0] * q[0], radius[1] * q[1], radius[2] * q[2]);
            put(mesh, glms_vec3_add(f->middle, at), in_frame(f, q[0] / radius[0], q[1] / radius[1], q[2] / radius[2]),
                0xFFFFFFu);
        }
    }
    weave(mesh, first, rings + 1, AROUND + 1);
}

/// A cap of the eyeball about a direction off its axis.
static void ball_cap(struct mesh *mesh, const struct frame *eye, float across, float up, float radius, float inner,
                     float outer, int rings)
{
    const struct frame f = frame_towards(eye->middle, in_frame(eye, across, up, 1.0f), eye->up);
    cap(mesh, &f, (const float[3]){radius, radius, radius}, inner, outer, rings);
}

/// A lid: a shell around the eye from angle `from` (its dark rim) to `to`, radians upwards about the eye's horizontal axis.
static void lid(struct mesh *mesh, const struct frame *eye, float radius, float from, float to)
{
    enum { ROWS = 10, RIM = 3 }; // the rim's edge on the eyeball, its outer edge, its end
    const uint32_t first = (uint32_t)mesh->vertex_count;
    const float sign = to > from ? 1.0f : -1.0f, rim_end = from + 0.11f * sign;
    for (int r = 0; r < ROWS; r++) {
        const float angle =
            r < RIM - 1 ? from : rim_end + (to - rim_end) * (float)(r < RIM ? 0 : r - RIM) / (ROWS - RIM - 1);
        const float reach = r == 0 ? radius - 0.006f : radius;
        for (int c = 0; c <= AROUND; c++) {
            const float polar = GLM_PIf * (float)c / AROUND;
            const vec3s out = in_frame(eye, cosf(polar), sinf(polar) * sinf(angle), sinf(polar) * cosf(angle));
            const vec3s edge = in_frame(eye, 0.0f, -sign * cosf(angle), sign * sinf(angle));
            put(mesh, glms_vec3_muladds(out, reach, eye->middle), r == 0 ? edge : out, r < RIM ? LASHES : LID);
        }
    }
    const int from_index = mesh->index_count;
    weave(mesh, first, ROWS, AROUND + 1);
    if (sign < 0.0f) turn_over(mesh, from_index);
}

/// The lids' frame: across is the hinge, the lid's bone.
static struct frame socket_of(const struct dog_joint *joint, float side)
{
    struct frame f = {.middle = vec3_from(joint->position)};
    const vec3s outwards = glms_vec3_sub(vec3_from(joint->tip), f.middle);
    f.across = glms_vec3_scale(glms_vec3_normalize(outwards), side);
    f.axis = glms_vec3_normalize(glms_vec3_cross(f.across, (vec3s){{0, 1, 0}}));
    f.up = glms_vec3_cross(f.axis, f.across);
    return f;
}

static void eyes(const struct dog_skeleton *skeleton, struct dog_pieces *pieces)
{
    for (int side = 1; side >= -1; side -= 2) {
        const float s = (float)side, r = EYE_RADIUS;
        const int eye_joint = dog_joint(skeleton, side > 0 ? "eye_L" : "eye_R");
        const int lid_joint = dog_joint(skeleton, side > 0 ? "lid_L" : "lid_R");
        const vec3s middle = vec3_from(skeleton->joints[eye_joint].position), up = {{0, 1, 0}};
        const struct frame gaze = frame_towards(middle, (vec3s){{s * 0.20f, 0.0f, 1.0f}}, up);
        const struct frame socket = socket_of(&skeleton->joints[lid_joint], s);
        ball_cap(start(pieces, DOG_WHITE, eye_joint), &gaze, 0, 0, r, 0.76f, 2.2f, RINGS);
        ball_cap(start(pieces, DOG_IRIS, eye_joint), &gaze, 0, 0, r, 0.52f, 0.76f, 2);
        ball_cap(start(pieces, DOG_DARK, eye_joint), &gaze, 0, 0, r, 0.0f, 0.52f, 4);
        struct mesh *glint = start(pieces, DOG_GLINT, eye_joint);
        ball_cap(glint, &gaze, -0.24f, 0.30f, r + 0.0008f, 0.0f, 0.15f, 2);
        ball_cap(glint, &gaze, 0.22f, -0.24f, r + 0.0008f, 0.0f, 0.07f, 1);
        struct mesh *lids = start(pieces, DOG_COAT, lid_joint);
        lid(lids, &socket, r + 0.0035f, 0.86f, 4.0f);
        lid(start(pieces, DOG_COAT, dog_joint(skeleton, "head")), &socket, r + 0.0025f, -0.72f, -2.4f);
    }
}

static void nose(const struct dog_skeleton *skeleton, struct dog_pieces *pieces)
{
    const int head = dog_joint(skeleton, "head");
    const struct frame f = frame_towards((vec3s){{0, 0.732f, 0.556f}}, (vec3s){{0, 0.25f, 1.0f}}, (vec3s){{0, 1, 0}});
    cap(start(pieces, DOG_DARK, head), &f, (const float[3]){0.031f, 0.023f, 0.020f}, 0.0f, GLM_PIf, 9);
    const struct frame shine = frame_towards(f.middle, (vec3s){{-0.25f, 0.95f, 0.75f}}, (vec3s){{0, 1, 0}});
    cap(start(pieces, DOG_GLINT, head), &shine, (const float[3]){0.0255f, 0.0255f, 0.0225f}, 0.0f, 0.22f, 2);
}

/// Out of the mouth and over the lip.
static void tongue(const struct dog_skeleton *skeleton, struct dog_pieces *pieces)
{
    struct mesh *mesh = start(pieces, DOG_TONGUE, dog_joint(skeleton, "jaw"));
    const struct frame f = frame_towards((vec3s){{0, 0.652f, 0.480f}}, (vec3s){{0, -0.16f, 1}}, (vec3s){{0, 1, 0}});
    cap(mesh, &f, (const float[3]){0.026f, 0.010f, 0.060f}, 0.0f, GLM_PIf, 10);
    for (int v = 0; v < mesh->vertex_count; v++) {
        // It hangs lower further out.
        float *p = mesh->vertices[v].position;
        const float out = fmaxf(p[2] - 0.495f, 0.0f);
        p[1] -= 16.0f * out * out;
    }
}

/// A band around the neck.
static void collar(const struct frame *f, float radius, struct mesh *mesh)
{
    enum { TURNS = 48, SECTION = 12 };
    const uint32_t first = (uint32_t)mesh->vertex_count;
    for (int r = 0; r <= SECTION; r++) {
        const float b = 2.0f * GLM_PIf * (float)r / SECTION;
        for (int c = 0; c <= TURNS; c++) {
            const float a = 2.0f * GLM_PIf * (float)c / TURNS, out = radius + 0.009f * cosf(b);
            const vec3s at = in_frame(f, out * cosf(a), out * sinf(a), 0.015f * sinf(b));
            put(mesh, glms_vec3_add(f->middle, at),
                in_frame(f, cosf(b) * cosf(a) / 0.009f, cosf(b) * sinf(a) / 0.009f, sinf(b) / 0.015f), 0xFFFFFFu);
        }
    }
    weave(mesh, first, SECTION + 1, TURNS + 1);
    turn_over(mesh, 0);
}

static void collar_and_tag(const struct dog_skeleton *skeleton, struct dog_pieces *pieces)
{
    const struct frame f =
        frame_towards((vec3s){{0, 0.588f, 0.233f}}, (vec3s){{0, 0.88f, 0.475f}}, (vec3s){{0, 0, -1}});
    collar(&f, 0.095f, start(pieces, DOG_COLLAR, -1));
    const struct frame tag = frame_towards((vec3s){{0, 0.525f, 0.332f}}, (vec3s){{0, 0.18f, 1}}, (vec3s){{0, 1, 0}});
    cap(start(pieces, DOG_TAG, dog_joint(skeleton, "neck")), &tag, (const float[3]){0.026f, 0.026f, 0.005f}, 0.0f,
        GLM_PIf, 8);
    memcpy(pieces->tag_middle, tag.middle.raw, sizeof pieces->tag_middle);
    pieces->tag_radius = 0.026f;
}

void dog_face(const struct dog_skeleton *skeleton, struct dog_pieces *pieces)
{
    eyes(skeleton, pieces);
    nose(skeleton, pieces);
    tongue(skeleton, pieces);
    collar_and_tag(skeleton, pieces);
}
