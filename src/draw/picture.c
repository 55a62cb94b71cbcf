/// Draws pictures of the stage at twice their size and averages 2 × 2 pixels into one.
#include "base/need.h"
#include "draw/draw.h"
#include "draw/stage.h"
#include <stdlib.h>

enum { FINE = 2 }; ///< drawn pixels per side of a picture's pixel

struct picture {
    int width, height;
    struct stage_renderer *stage;
    struct stage_target target;
    GLuint buffer; ///< receives what is drawn
    GLsync fence;  ///< after that
    bool transparent;
    unsigned char *drawn, *pixels; ///< as drawn, bottom row first; the picture
};

static bool create_target(struct picture *picture, struct error *error)
{
    GLint largest = 0, before = 0;
    const int width = FINE * picture->width, height = FINE * picture->height;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (picture->width < 1 || picture->height < 1 || width > largest || height > largest)
        return fail(error, ERROR_ENVIRONMENT, "expected a picture of 1 to %d pixels a side, got %d × %d",
                    largest / FINE, picture->width, picture->height);
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &before);
    const bool complete = stage_target_bind(&picture->target, width, height);
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)before);
    return complete || fail(error, ERROR_ENVIRONMENT, "the graphics driver makes no framebuffer of %d × %d pixels",
                            width, height);
}

struct picture *picture_create(int width, int height, struct error *error)
{
    struct picture *picture = need_zeroed(1, sizeof *picture);
    picture->width = width;
    picture->height = height;
    if ((picture->stage = stage_renderer_create(error)) && create_target(picture, error)) {
        const size_t bytes = 4 * (size_t)width * (size_t)height;
        picture->buffer = gl_buffer(GL_PIXEL_PACK_BUFFER, FINE * FINE * bytes, NULL, GL_STREAM_READ);
        glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
        picture->drawn = need(FINE * FINE, bytes);
        picture->pixels = need(bytes, 1);
        return picture;
    }
    picture_destroy(picture);
    return NULL;
}

void picture_destroy(struct picture *picture)
{
    if (!picture) return;
    stage_renderer_destroy(picture->stage);
    stage_target_destroy(&picture->target);
    glDeleteBuffers(1, &picture->buffer);
    if (picture->fence) glDeleteSync(picture->fence);
    free(picture->drawn);
    free(picture->pixels);
    free(picture);
}

void picture_draw(struct picture *picture, const struct stage_view *view, bool transparent)
{
    const int width = FINE * picture->width, height = FINE * picture->height;
    GLint before = 0;
    long bytes = 0;
    picture->transparent = transparent;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &before);
    stage_target_bind(&picture->target, width, height);
    glDisable(GL_SCISSOR_TEST);
    stage_upload(picture->stage, view, &bytes);
    if (transparent) {
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        stage_draw_rigs(picture->stage, view, width, height);
    } else {
        stage_draw(picture->stage, view, 0, 0, width, height);
    }
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, picture->buffer);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (picture->fence) glDeleteSync(picture->fence);
    picture->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)before);
}

static void average_row(const unsigned char *below, const unsigned char *above, int width, unsigned char *row)
{
    for (int x = 0; x < width; x++, below += 8, above += 8, row += 4) {
        for (int k = 0; k < 3; k++)
            row[k] = (unsigned char)((below[k] + below[k + 4] + above[k] + above[k + 4] + 2) / 4);
        row[3] = 255;
    }
}

/// Weights colours by coverage, so that edges do not darken towards the transparent background.
static void weigh_row(const unsigned char *below, const unsigned char *above, int width, unsigned char *row)
{
    for (int x = 0; x < width; x++, below += 8, above += 8, row += 4) {
        const int covered = below[3] + below[7] + above[3] + above[7];
        for (int k = 0; k < 3; k++) {
            const int sum =
                below[k] * below[3] + below[k + 4] * below[7] + above[k] * above[3] + above[k + 4] * above[7];
            row[k] = (unsigned char)(covered > 0 ? (sum + covered / 2) / covered : 0);
        }
        row[3] = (unsigned char)((covered + 2) / 4);
    }
}

const unsigned char *picture_take(struct picture *picture, bool wait)
{
    if (!wait && glClientWaitSync(picture->fence, 0, 0) == GL_TIMEOUT_EXPIRED) return NULL;
    const size_t stride = 4 * FINE * (size_t)picture->width;
    glBindBuffer(GL_PIXEL_PACK_BUFFER, picture->buffer);
    glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, (GLsizeiptr)(FINE * (size_t)picture->height * stride),
                       picture->drawn);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (int y = 0; y < picture->height; y++) {
        const unsigned char *below = picture->drawn + FINE * (size_t)(picture->height - 1 - y) * stride;
        unsigned char *row = picture->pixels + 4 * (size_t)y * (size_t)picture->width;
        if (picture->transparent) {
            weigh_row(below, below + stride, picture->width, row);
        } else {
            average_row(below, below + stride, picture->width, row);
        }
    }
    return picture->pixels;
}
