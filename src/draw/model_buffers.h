/// An imported character on the GPU. Private to the stage's files of draw/.
#ifndef DRAW_MODEL_BUFFERS_H
#define DRAW_MODEL_BUFFERS_H

#include "draw/gl.h"
#include "draw/model_surface.h"

/// One part of a mesh as one node shows it.
struct model_shape {
    int node, part;
    int first; ///< of the surface's indices
};

/// All zero is none.
struct model_buffers {
    uint64_t id; ///< of the model that is in it, 0: none
    long used;   ///< the picture that showed it last
    struct model_surface surface;
    struct surface_look *looks; ///< of the surface's vertices
    struct stage_surface drawn;
    struct model_shape *shapes;
    int shape_count;
    GLuint indices;
    GLuint *pictures; ///< of each image
    GLuint white;     ///< for materials without one
    int image_count;
    GLuint *samplers; ///< of each material
    int material_count;
};

/// A part's material; plain white where it has none.
const struct gltf_material *model_material(const struct gltf *gltf, const struct gltf_part *part);

/// Uploads a model; returns the bytes.
long model_buffers_create(struct model_buffers *buffers, const struct gltf *gltf);
void model_buffers_free(struct model_buffers *buffers);

/// Poses the surface and uploads it; returns the bytes. Allocates nothing.
long model_buffers_pose(const struct model_buffers *buffers, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16], const float eye[3]);

#endif
