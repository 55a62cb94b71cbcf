/// Uploads imported characters and their poses.
#include "draw/model_buffers.h"
#include "base/need.h"
#include <stdlib.h>
#include <string.h>

const struct gltf_material *model_material(const struct gltf *gltf, const struct gltf_part *part)
{
    static const struct gltf_material plain = {.color = {1, 1, 1, 1}, .image = -1};
    return part->material < 0 ? &plain : &gltf->materials[part->material];
}

static long upload_pictures(struct model_buffers *buffers, const struct gltf *gltf)
{
    const int largest = gl_largest_texture();
    long bytes = 0;
    buffers->white = gl_white();
    for (int i = 0; i < gltf->image_count; i++) {
        const struct gltf_image *image = &gltf->images[i];
        if (!image->pixels || image->width > largest || image->height > largest) continue;
        buffers->pictures[i] = gl_picture(image->pixels, image->width, image->height);
        bytes += 4L * image->width * image->height;
    }
    buffers->image_count = gltf->image_count;
    return bytes;
}

static void create_samplers(struct model_buffers *buffers, const struct gltf *gltf)
{
    glGenSamplers(gltf->material_count, buffers->samplers);
    for (int m = 0; m < gltf->material_count; m++) {
        const struct gltf_sampler *sampler = &gltf->materials[m].sampler;
        const GLuint made = buffers->samplers[m];
        glSamplerParameteri(made, GL_TEXTURE_WRAP_S, sampler->wrap[0]);
        glSamplerParameteri(made, GL_TEXTURE_WRAP_T, sampler->wrap[1]);
        glSamplerParameteri(made, GL_TEXTURE_MIN_FILTER, sampler->far);
        glSamplerParameteri(made, GL_TEXTURE_MAG_FILTER, sampler->near);
    }
    buffers->material_count = gltf->material_count;
}

static void look_at(const struct gltf *gltf, const struct gltf_part *part, int vertex, struct surface_look *look)
{
    if (part->mark) {
        const float *mark = part->mark[vertex], *place = part->position[vertex];
        *look = (struct surface_look){{place[0], place[1], place[2], part->fur[vertex][0]},
                                      {mark[0], mark[1]},
                                      {mark[2], part->fur[vertex][1]}};
        return;
    }
    memcpy(look->color, model_material(gltf, part)->color, sizeof look->color);
    for (int k = 0; part->color && k < 4; k++) look->color[k] *= part->color[vertex][k];
    if (part->uv) memcpy(look->uv, part->uv[vertex], sizeof look->uv);
}

/// The shapes of one node, and what their vertices look like.
static void add_shapes(struct model_buffers *buffers, const struct gltf *gltf, int node)
{
    const struct gltf_mesh *mesh = &gltf->meshes[gltf->nodes[node].mesh];
    struct surface_look *look = buffers->looks + buffers->surface.first_vertex[node];
    int first = buffers->surface.first_index[node];
    for (int p = 0; p < mesh->part_count; p++) {
        const struct gltf_part *part = &mesh->parts[p];
        buffers->shapes[buffers->shape_count++] = (struct model_shape){node, p, first};
        for (int v = 0; v < part->vertex_count; v++) look_at(gltf, part, v, look++);
        first += part->index_count;
    }
}

static void make_looks(struct model_buffers *buffers, const struct gltf *gltf)
{
    int shapes = 0;
    for (int n = 0; n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh >= 0) shapes += gltf->meshes[gltf->nodes[n].mesh].part_count;
    }
    buffers->looks = need_zeroed((size_t)buffers->surface.vertex_count + 1, sizeof *buffers->looks);
    buffers->shapes = need_zeroed((size_t)shapes + 1, sizeof *buffers->shapes);
    for (int n = 0; buffers->surface.indices && n < gltf->node_count; n++) {
        if (gltf->nodes[n].mesh >= 0) add_shapes(buffers, gltf, n);
    }
}

static long upload_surface(struct model_buffers *buffers)
{
    const struct model_surface *surface = &buffers->surface;
    const size_t bytes = (size_t)surface->index_count * sizeof *surface->indices;
    stage_surface_create(&buffers->drawn, surface->vertex_count, buffers->looks);
    glBindVertexArray(buffers->drawn.vertex_array);
    glGenBuffers(1, &buffers->indices);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers->indices);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, (GLsizeiptr)bytes, surface->indices, GL_STATIC_DRAW);
    glBindVertexArray(0);
    return (long)((size_t)surface->vertex_count * sizeof *buffers->looks + bytes);
}

long model_buffers_create(struct model_buffers *buffers, const struct gltf *gltf)
{
    *buffers = (struct model_buffers){.id = gltf->id};
    buffers->pictures = need_zeroed((size_t)gltf->image_count + 1, sizeof *buffers->pictures);
    buffers->samplers = need_zeroed((size_t)gltf->material_count + 1, sizeof *buffers->samplers);
    model_surface_create(&buffers->surface, gltf);
    make_looks(buffers, gltf);
    create_samplers(buffers, gltf);
    return upload_pictures(buffers, gltf) + upload_surface(buffers);
}

void model_buffers_free(struct model_buffers *buffers)
{
    stage_surface_free(&buffers->drawn);
    glDeleteBuffers(1, &buffers->indices);
    glDeleteTextures(buffers->image_count, buffers->pictures);
    glDeleteTextures(1, &buffers->white);
    glDeleteSamplers(buffers->material_count, buffers->samplers);
    free(buffers->looks);
    free(buffers->shapes);
    free(buffers->pictures);
    free(buffers->samplers);
    model_surface_free(&buffers->surface);
    *buffers = (struct model_buffers){0};
}

long model_buffers_pose(const struct model_buffers *buffers, const struct gltf *gltf, const struct gltf_pose *pose,
                        const float root[16], const float eye[3])
{
    const struct model_surface *surface = &buffers->surface;
    model_surface_pose(surface, gltf, pose, root, eye);
    return stage_surface_move(&buffers->drawn, (const float(*)[3])surface->place, (const float(*)[3])surface->normal);
}
