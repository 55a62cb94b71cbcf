/// An imported character on the GPU. Private to the stage's files of draw/.
#ifndef DRAW_MODEL_BUFFERS_H
#define DRAW_MODEL_BUFFERS_H

#include "draw/gl.h"
#include "draw/skirt.h"
#include "model/gltf.h"

enum { MATRICES_A_ROW = 64, FLOATS_A_ROW = MATRICES_A_ROW * 3 * 4 }; ///< as in stage_model.vert

/// One part of a mesh as one node shows it.
struct model_shape {
    int node, part;
    GLuint vertex_array;
    GLuint morphed; ///< positions and normals that follow the weights; 0: it has no morph targets
};

/// All zero is none.
struct model_buffers {
    uint64_t id;                ///< of the model that is in it, 0: none
    GLuint *vertices, *indices; ///< of each part of each mesh, in their order
    int part_count;
    GLuint *pictures; ///< of each image
    GLuint white;     ///< for materials without one
    int image_count;
    GLuint *samplers; ///< of each material
    int material_count;
    struct model_shape *shapes;
    int shape_count;
    float *weights; ///< that the morphed parts show
    int *first;     ///< of each node: its mesh's first matrix
    float *rows;    ///< of all matrices, as the texture has them
    GLuint matrices;
    int row_count;
    struct model_skirt skirt;
};

/// Uploads a model; returns the bytes.
long model_buffers_create(struct model_buffers *buffers, const struct gltf *gltf);
void model_buffers_free(struct model_buffers *buffers);

/// Uploads a pose: matrices to the world and, where their weights have changed, morphed parts; returns the bytes. Allocates nothing.
long model_buffers_pose(struct model_buffers *buffers, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16]);

#endif
