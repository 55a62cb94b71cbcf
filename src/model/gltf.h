/// A character: the parts of a glTF 2.0 file that wiggly shows, and its poses.
///
/// Units and axes are the file's: metres, y up, right-handed. Matrices are column-major. Nothing here is changed after reading.
#ifndef MODEL_GLTF_H
#define MODEL_GLTF_H

#include "base/need.h"
#include "model/surface.h"
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { GLTF_INFLUENCES = 8 };

/// Our extension: successive triangles of a primitive that begin with the same vertex are one polygon, a fan. Viewers may ignore it.
#define GLTF_POLYGONS "FB_ngon_encoding"

/// Translation, rotation (unit quaternion x y z w) and scale of a node against its parent.
struct gltf_place {
    float translation[3], rotation[4], scale[3];
};

struct gltf_node {
    char *name;              ///< "node 7" where the file has none; no two are alike
    int parent;              ///< −1: a root
    int child;               ///< the first node below it; −1: none
    int next;                ///< the next node below its parent; −1: none, and of a root
    struct gltf_place place; ///< at rest
    float matrix[16];        ///< replaces `place` if `has_matrix`
    bool has_matrix;         ///< it is sheared or flat; clips and chains do not move the node
    int mesh, skin;          ///< −1: none
    int first_weight;        ///< of its mesh's morph targets, in gltf_pose.weights
};

struct gltf_skin {
    int *joints; ///< nodes
    int joint_count;
    int first_joint; ///< in gltf_pose.joints
    float (*inverse_bind)[16];
};

/// How a texture is sampled outside its picture and between pixels, in the numbers that glTF shares with OpenGL.
enum gltf_reading {
    GLTF_REPEATED = 10497,
    GLTF_MIRRORED = 33648,
    GLTF_CLAMPED = 33071,
    GLTF_READ_NEAREST = 9728,
    GLTF_READ_LINEAR = 9729,
    GLTF_READ_SMALLER = 9984, ///< the first of four that read smaller copies of the picture where it is far
    GLTF_READ_BETWEEN = 9987, ///< the last: linear in all ways
};

struct gltf_sampler {
    int wrap[2];   ///< across and down
    int far, near; ///< if it is smaller, or larger, than on the screen
};

struct gltf_material {
    char *name;                  ///< "material 2" where the file has none
    float color[4];              ///< base colour, linear, with opacity
    int image;                   ///< its texture, −1: none
    struct gltf_sampler sampler; ///< of that
    float cutoff;                ///< alpha below it is not drawn; 0: all is
    bool blended, double_sided;
    bool shines; ///< one `metallic` and `roughness` for all of it; else a picture says them, or nothing
    double metallic, roughness;
};

/// A picture, as the file has it and decoded: sRGB with opacity, 8 bits each, top row first.
struct gltf_image {
    char *name;           ///< NULL: none
    unsigned char *bytes; ///< PNG or JPEG
    size_t size;
    int width, height;
    unsigned char *pixels; ///< NULL after gltf_read_stored(), whose `bytes` may be of any kind
};

/// How far a morph target takes each vertex; NULL where it leaves positions or normals alone.
struct gltf_target {
    float (*position)[3], (*normal)[3];
};

/// Triangles of one material (glTF's primitive).
struct gltf_part {
    int vertex_count;
    float (*position)[3], (*normal)[3];  ///< normals may be NULL: its triangles are flat
    float (*uv)[2];                      ///< NULL: none
    float (*color)[4];                   ///< linear, NULL: white
    uint16_t (*joints)[GLTF_INFLUENCES]; ///< into the skin's joints; NULL: not skinned
    float (*weights)[GLTF_INFLUENCES];   ///< their sum is 1
    float (*along)[GLTF_INFLUENCES]; ///< how weights change along the mesh's z, per metre, for normals; NULL: little
    float (*mark)[3];                ///< _MARK: a coat's markings; NULL: it has no coat
    float (*fur)[2];                 ///< _FUR: how far it follows a tail, and how much light reaches it, 0 … 1
    uint32_t *indices;
    int index_count;
    struct gltf_target *targets; ///< as many as the mesh has
    int material;                ///< −1: plain white
    int primitive;               ///< its number in the mesh of the file
    bool has_polygons;           ///< GLTF_POLYGONS
    bool shared; ///< it has the vertices of the mesh's first part; and `uv`, unless materials differ in that
};

/// Its vertices that are not those of the mesh's first part.
static inline int gltf_own_vertices(const struct gltf_part *part) { return part->shared ? 0 : part->vertex_count; }

/// Whether the triangle at index `i` goes on with the polygon of the one before.
static inline bool gltf_joins(const struct gltf_part *part, int i)
{
    const uint32_t *corner = part->indices + i;
    return part->has_polygons && i > 0 && corner[0] == corner[-3] && corner[1] == corner[-1];
}

struct gltf_mesh {
    char *name;
    struct gltf_part *parts;
    int part_count;
    int target_count;
    float *weights;        ///< of its targets at rest
    char **target_names;   ///< gltf_target_name()
    struct json_t *extras; ///< what other programs say of it in the file; NULL: nothing
};

enum gltf_path { GLTF_TRANSLATION, GLTF_ROTATION, GLTF_SCALE, GLTF_WEIGHTS };
enum gltf_interpolation { GLTF_STEP, GLTF_LINEAR, GLTF_CUBIC };

struct gltf_channel {
    int node;
    enum gltf_path path;
    enum gltf_interpolation interpolation;
    bool travels;              ///< it carries the character on, steadily, in a clip that loops
    int key_count, components; ///< components: 3, 4 or the mesh's targets
    float *times;              ///< seconds, ascending
    float *values; ///< `components` a key; three times as many for GLTF_CUBIC: tangent in, value, tangent out
};

/// Numbers from one key to the next.
static inline int gltf_stride(const struct gltf_channel *channel)
{
    return channel->components * (channel->interpolation == GLTF_CUBIC ? 3 : 1);
}

struct gltf_clip {
    char *name;         ///< "clip 2" where the file has none; no two are alike
    double first, last; ///< seconds, of its first and last key
    bool loops;         ///< it ends as it begins, but for where it has travelled
    double gap;         ///< if it loops: seconds from the last key to the first again; 0: both are the same
    struct gltf_channel *channels;
    int channel_count;
};

struct gltf {
    struct pool pool; ///< where all of it is but `extras`, the bytes of images, and `not_shown`
    char *path;
    struct gltf_node *nodes;
    int *order; ///< all nodes, parents before children
    int node_count;
    struct gltf_skin *skins;
    int skin_count;
    struct gltf_mesh *meshes;
    int mesh_count;
    struct gltf_material *materials;
    int material_count;
    struct gltf_image *images;
    int image_count;
    struct gltf_clip *clips;
    int clip_count;
    int weight_count;   ///< morph weights of all nodes together
    float *weights;     ///< those at rest
    int joint_count;    ///< joints of all skins together
    float lo[3], hi[3]; ///< the box around it at rest
    char *not_shown;    ///< names of things in the file that are not shown, comma separated; NULL: all is shown
    size_t room;        ///< bytes that may still be allocated, so that a small file cannot claim all memory
    uint64_t id;        ///< tells it from any other that was read in this process; never 0
};

/// Reads a .glb or .gltf (with its files or data URIs). Memory is bounded by a small multiple of the sizes of the files, whatever they claim.
/// Errors name file, place, what was expected and what was found; on error nothing is left to free.
bool gltf_read(const char *path, struct gltf *gltf, struct error *error);

/// The same with targets that leave normals alone and pictures that are not decoded.
bool gltf_read_stored(const char *path, struct gltf *gltf, struct error *error);

/// The same as gltf_read() for a file's bytes, which it takes over; they must have room for a NUL at the end. `path` is for messages.
bool gltf_read_bytes(const char *path, char *data, size_t size, struct gltf *gltf, struct error *error);
void gltf_free(struct gltf *gltf);

/// A number for gltf.id.
uint64_t gltf_new_id(void);

/// Whether it is a soft character: character_read() finds coordinates in it.
bool gltf_is_soft(const struct gltf *gltf);

/// The name of a morph target, from the places where exporters put it; NULL: none.
const char *gltf_target_name(const struct gltf_mesh *mesh, int target);
/// The same, or "target_3"; the memory is the pool's.
char *gltf_target_label(const struct gltf_mesh *mesh, int target, struct pool *pool);

/// Decodes a PNG or JPEG into at most `most` bytes of pixels, which the caller frees. False with a sentence that names no file.
bool gltf_decode_image(const unsigned char *bytes, size_t size, size_t most, struct gltf_image *image,
                       struct error *error);

/// Finds each node's child and next from all parents.
void gltf_link_nodes(struct gltf *gltf);

/// The node, or the clip, with that name, or −1. NULL is no clip's name.
int gltf_find_node(const struct gltf *gltf, const char *name);
int gltf_find_clip(const struct gltf *gltf, const char *name);

/// Where everything is at one time. Memory is made once for a model and reused.
struct gltf_pose {
    struct pool pool;         ///< of what follows
    struct gltf_place *place; ///< of each node against its parent
    float (*world)[16];       ///< of each node, in the model's space
    float (*joints)[16];      ///< what skinning multiplies vertices by, of all skins (gltf_skin.first_joint)
    float *weights;           ///< of the morph targets of all nodes (gltf_node.first_weight)
};

bool gltf_pose_create(const struct gltf *gltf, struct gltf_pose *pose);
void gltf_pose_free(struct gltf_pose *pose);

/// Places and weights at rest (clip −1) or at a clip's time in seconds, held before the first and after the last key. Leaves `world`
/// alone. Allocates nothing.
void gltf_pose_clip(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose);

/// The same within a loop: after its last key a clip goes on to its first, for `gap` seconds.
void gltf_pose_loop(const struct gltf *gltf, int clip, double time, struct gltf_pose *pose);

/// A channel's value at a time: `components` numbers.
void gltf_channel_at(const struct gltf_channel *channel, double time, float *out);

/// World and joint matrices from places. Allocates nothing.
void gltf_pose_world(const struct gltf *gltf, struct gltf_pose *pose);

/// The matrix Σ wⱼ Jⱼ of a vertex.
void gltf_blend(const float (*joints)[16], const uint16_t *joint, const float *weights, float matrix[16]);

/// Turns a normal by a matrix, whatever its scale; a mirror turns it round, with the triangles. Its length is 1 then.
void gltf_turn_normal(const float matrix[16], float normal[3]);

/// Positions of all vertices of one node's mesh in the model's space, part after part, morphed and skinned: the reference for what the
/// stage draws and what is exported. `normals` may be NULL. Allocates nothing.
void gltf_pose_vertices(const struct gltf *gltf, const struct gltf_pose *pose, int node, float (*positions)[3],
                        float (*normals)[3]);

/// Vertices of one node's mesh; 0 without one.
int gltf_vertex_count(const struct gltf *gltf, int node);

// --- the box around a posed character, from boxes of the vertices that follow each joint, without posing vertices

/// The vertices that follow a joint of a mesh's skin, or a whole mesh without skin.
struct gltf_box {
    int node;            ///< that shows the mesh
    int joint;           ///< of its skin, −1: none
    float lo[3], hi[3];  ///< of these vertices in the mesh's own space, without morphs
    float (*ways)[2][3]; ///< of each morph target: the least and the most that it moves them
};

struct gltf_bounds {
    struct gltf_box *boxes;
    int count;
};

/// False if memory is short. The memory is the character's.
bool gltf_bounds_create(struct gltf *gltf, struct gltf_bounds *bounds);

/// The box of all nodes but one (−1: all) in the model's space; it may be a little too large, never too small.
/// Without any it is upside down. Allocates nothing.
void gltf_bounds_at(const struct gltf_bounds *bounds, const struct gltf *gltf, const struct gltf_pose *pose, int but,
                    float lo[3], float hi[3]);

#endif
