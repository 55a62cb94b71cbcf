/// The dog of assets/models/dog.glb, made without any drawing: skeleton, skin, face and clips. Metres, y up; it stands on y = 0 and looks
/// towards +z, so its left is +x.
#ifndef MODELS_DOG_H
#define MODELS_DOG_H

#include "models/mesh.h"
#include <stdbool.h>

enum {
    DOG_MAX_JOINTS = 64,
    DOG_TAIL_JOINTS = 8,
    DOG_EAR_JOINTS = 4,
    DOG_LEG_JOINTS = 4,
    DOG_INFLUENCES = 4,
    DOG_FPS = 24,
};

/// A joint in the model's space at rest. Its y axis lies along its bone; the roll about it differs between chains, as in most rigs.
struct dog_joint {
    char name[20];
    int parent; ///< −1: the root node
    float position[3], tip[3];
    float rotation[4]; ///< unit quaternion x y z w
};

/// Parents come before their children.
struct dog_skeleton {
    struct dog_joint joints[DOG_MAX_JOINTS];
    int count;
};

/// Points of the tail from root to tip, and of the left ear.
extern const float dog_tail[DOG_TAIL_JOINTS + 1][3], dog_ear[DOG_EAR_JOINTS + 1][3];

/// Decimates a mesh, but keeps its vertices and their data. Writes at most `triangles` triangles (more if the surface would fold or open) to
/// `indices`, which has room for all of the character's. Vertices collapse onto neighbours, starting with those that change shape and colour
/// least.
struct character;
void decimate(const struct character *character, int triangles, uint32_t *indices, int *index_count);

void dog_skeleton_make(struct dog_skeleton *skeleton);

/// Index of a joint, which must exist.
int dog_joint(const struct dog_skeleton *skeleton, const char *name);

/// Joints of a vertex, strongest first; the weights sum to 1.
struct dog_influences {
    int joint[DOG_INFLUENCES];
    float weight[DOG_INFLUENCES];
};

/// The joints of a point of the coat: near ones on the limbs at that point.
void dog_influences(const struct dog_skeleton *skeleton, const float p[3], struct dog_influences *influences);

/// Limbs: solids that follow a chain of joints.
enum dog_limb_number {
    DOG_TRUNK,
    DOG_HEAD,
    DOG_JAW,
    DOG_TAIL,
    DOG_EAR_LEFT,
    DOG_EAR_RIGHT,
    DOG_FIRST_LEG,
    DOG_LIMBS = DOG_FIRST_LEG + 4
};

/// Distance to one limb.
float dog_limb_distance(int limb, const float p[3]);

/// A limb's chain of joints. `blend`: metres over which it shares vertices with its neighbours; `bend`: the share of a bone over which each
/// joint bends.
struct dog_limb {
    const char *joints[DOG_TAIL_JOINTS + 1]; ///< ends with NULL
    float blend, bend;
};
extern const struct dog_limb dog_limbs[DOG_LIMBS];

/// Makes the coat with about `triangles` triangles.
void dog_coat(int triangles, struct mesh *mesh);

enum dog_material {
    DOG_COAT,
    DOG_WHITE,
    DOG_IRIS,
    DOG_DARK,
    DOG_GLINT,
    DOG_TONGUE,
    DOG_COLLAR,
    DOG_TAG,
    DOG_MATERIALS
};

/// A part of one material. `joint`: the joint of the whole part; −1: joints per vertex by dog_influences().
struct dog_piece {
    enum dog_material material;
    int joint;
    struct mesh mesh;
};

enum { DOG_MAX_PIECES = 20 };
struct dog_pieces {
    struct dog_piece pieces[DOG_MAX_PIECES];
    int count;
    float tag_middle[3], tag_radius; ///< place of its picture
};

/// Eyes, lids, nose, collar and tag.
void dog_face(const struct dog_skeleton *skeleton, struct dog_pieces *pieces);

/// A looping clip; the last key equals the first.
struct dog_clip {
    const char *name;
    int frames;
};
enum { DOG_CLIPS = 3 };
extern const struct dog_clip dog_clips[DOG_CLIPS];

/// Joints relative to their parents at one time of a clip.
struct dog_pose {
    float rotation[DOG_MAX_JOINTS][4];
    float hips[3];
};

/// The pose at 0 … 1 of a clip. Ends the program if a leg does not reach its paw, an error in the clip.
void dog_pose(const struct dog_skeleton *skeleton, int clip, float time, struct dog_pose *pose);

#endif
