/// Uploads characters, their pictures and their poses.
#include "draw/posed.h"
#include <stdlib.h>

enum { PIXEL_ROOM = 256 << 20 };

void posed_look_attributes(size_t stride, size_t offset)
{
    gl_attribute(POSED_COLOR, 4, GL_FLOAT, stride, offset + offsetof(struct posed_look, color));
    gl_attribute(POSED_UV, 2, GL_FLOAT, stride, offset + offsetof(struct posed_look, uv));
    gl_attribute(POSED_PHASE, 2, GL_FLOAT, stride, offset + offsetof(struct posed_look, phase));
    gl_attribute(POSED_COVER, 1, GL_FLOAT, stride, offset + offsetof(struct posed_look, cover));
}

long posed_upload(struct posed *mesh)
{
    const size_t vertices = (size_t)mesh->vertex_count, stride = sizeof *mesh->looks;
    const size_t bytes = (size_t)mesh->index_count * sizeof *mesh->indices;
    glGenVertexArrays(1, &mesh->vertex_array);
    glBindVertexArray(mesh->vertex_array);
    mesh->moving_buffer = gl_buffer(GL_ARRAY_BUFFER, 2 * vertices * sizeof *mesh->place, NULL, GL_STREAM_DRAW);
    gl_attribute(POSED_PLACE, 3, GL_FLOAT, 0, 0);
    gl_attribute(POSED_NORMAL, 3, GL_FLOAT, 0, vertices * sizeof *mesh->place);
    mesh->look_buffer = gl_buffer(GL_ARRAY_BUFFER, vertices * stride, mesh->looks, GL_STATIC_DRAW);
    posed_look_attributes(stride, 0);
    mesh->index_buffer = gl_buffer(GL_ELEMENT_ARRAY_BUFFER, bytes, mesh->indices, GL_STATIC_DRAW);
    glBindVertexArray(0);
    return (long)(vertices * stride + bytes);
}

long posed_upload_looks(const struct posed *mesh)
{
    const size_t bytes = (size_t)mesh->vertex_count * sizeof *mesh->looks;
    glBindBuffer(GL_ARRAY_BUFFER, mesh->look_buffer);
    glBufferData(GL_ARRAY_BUFFER, (GLsizeiptr)bytes, mesh->looks, GL_STATIC_DRAW);
    return (long)bytes;
}

long posed_upload_places(const struct posed *mesh)
{
    const GLsizeiptr half = (GLsizeiptr)((size_t)mesh->vertex_count * sizeof *mesh->place);
    glBindBuffer(GL_ARRAY_BUFFER, mesh->moving_buffer);
    glBufferData(GL_ARRAY_BUFFER, 2 * half, NULL, GL_STREAM_DRAW);
    glBufferSubData(GL_ARRAY_BUFFER, 0, half, mesh->place);
    glBufferSubData(GL_ARRAY_BUFFER, half, half, mesh->normal);
    return 2 * (long)half;
}

static long upload_picture(GLuint *picture, const struct gltf_image *image)
{
    const int largest = gl_largest_texture();
    if (!image->pixels || image->width > largest || image->height > largest) return 0;
    *picture = gl_picture(image->pixels, image->width, image->height);
    return 4L * image->width * image->height;
}

static GLuint sampler_of(const struct gltf_sampler *sampler)
{
    GLuint made;
    glGenSamplers(1, &made);
    glSamplerParameteri(made, GL_TEXTURE_WRAP_S, sampler->wrap[0]);
    glSamplerParameteri(made, GL_TEXTURE_WRAP_T, sampler->wrap[1]);
    glSamplerParameteri(made, GL_TEXTURE_MIN_FILTER, sampler->far);
    glSamplerParameteri(made, GL_TEXTURE_MAG_FILTER, sampler->near);
    return made;
}

long posed_upload_gltf_pictures(struct posed *mesh, const struct gltf *gltf)
{
    long bytes = 0;
    mesh->picture_count = gltf->image_count;
    mesh->sampler_count = gltf->material_count;
    mesh->pictures = pool_take(&mesh->pool, (size_t)gltf->image_count, sizeof *mesh->pictures);
    mesh->samplers = pool_take(&mesh->pool, (size_t)gltf->material_count, sizeof *mesh->samplers);
    for (int i = 0; i < gltf->image_count; i++) bytes += upload_picture(&mesh->pictures[i], &gltf->images[i]);
    for (int m = 0; m < gltf->material_count; m++) mesh->samplers[m] = sampler_of(&gltf->materials[m].sampler);
    for (int p = 0; p < mesh->part_count; p++) {
        struct posed_part *part = &mesh->parts[p];
        if (part->material < 0) continue;
        const int image = gltf->materials[part->material].image;
        part->picture = image >= 0 ? mesh->pictures[image] : 0;
        part->sampler = mesh->samplers[part->material];
    }
    return bytes;
}

/// The first material with the same picture.
static int same_picture(const struct looks *looks, int m)
{
    const struct looks_material *own = &looks->materials[m], *other = looks->materials;
    while (!other->image || other->image_size != own->image_size ||
           memcmp(other->image, own->image, own->image_size) != 0)
        other++;
    return (int)(other - looks->materials);
}

long posed_upload_figure_pictures(struct posed *mesh, const struct looks *looks)
{
    size_t room = PIXEL_ROOM;
    long bytes = 0;
    mesh->picture_count = looks->material_count;
    mesh->pictures = pool_take(&mesh->pool, (size_t)looks->material_count, sizeof *mesh->pictures);
    for (int p = 0; p < mesh->part_count; p++) {
        struct posed_part *part = &mesh->parts[p];
        if (part->material < 0 || !looks->materials[part->material].image) continue;
        const int first = same_picture(looks, part->material);
        const struct looks_material *material = &looks->materials[first];
        struct gltf_image image = {0};
        if (!mesh->pictures[first] && gltf_decode_image(material->image, material->image_size, room, &image, NULL)) {
            bytes += upload_picture(&mesh->pictures[first], &image);
            room -= 4 * (size_t)image.width * (size_t)image.height;
            free(image.pixels);
        }
        part->picture = mesh->pictures[first];
    }
    return bytes;
}

void posed_delete(struct posed *mesh)
{
    glDeleteVertexArrays(1, &mesh->vertex_array);
    glDeleteBuffers(3, (const GLuint[]){mesh->moving_buffer, mesh->look_buffer, mesh->index_buffer});
    glDeleteTextures(mesh->picture_count, mesh->pictures);
    glDeleteSamplers(mesh->sampler_count, mesh->samplers);
    posed_free(mesh);
}
