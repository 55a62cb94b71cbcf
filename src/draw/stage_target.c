/// Offscreen framebuffers; draws the stage at a lower resolution and enlarges it.
#include "draw/stage.h"

void stage_target_destroy(struct stage_target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteRenderbuffers(1, &target->color);
    glDeleteRenderbuffers(1, &target->depth);
    *target = (struct stage_target){0};
}

static void attach(GLuint *buffer, GLenum place, GLenum format, int width, int height)
{
    glGenRenderbuffers(1, buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, *buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, *buffer);
}

bool stage_target_bind(struct stage_target *target, int width, int height)
{
    if (target->framebuffer && target->width == width && target->height == height) {
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
        return true;
    }
    stage_target_destroy(target);
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    attach(&target->color, GL_COLOR_ATTACHMENT0, GL_RGBA8, width, height);
    attach(&target->depth, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, width, height);
    target->width = width;
    target->height = height;
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

/// The pixels of the small picture from which `visible` is interpolated.
static struct area needed(struct stage_place place, float scale, int width, int height)
{
    struct area v = place.visible;
    int x = place.viewport.x0, y = place.viewport.y0;
    struct area area = {(int)floorf((float)(v.x0 - x) * scale) - 1, (int)floorf((float)(v.y0 - y) * scale) - 1,
                        (int)ceilf((float)(v.x1 - x) * scale) + 1, (int)ceilf((float)(v.y1 - y) * scale) + 1};
    return area_intersect(area, (struct area){0, 0, width, height});
}

bool stage_target_draw(struct stage_target *target, struct stage_renderer *renderer, const struct stage_view *view,
                       struct stage_place place, float scale)
{
    const struct area to = place.viewport;
    const int width = area_max(1, (int)lroundf((float)(to.x1 - to.x0) * scale));
    const int height = area_max(1, (int)lroundf((float)(to.y1 - to.y0) * scale));
    GLint screen = 0;
    glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &screen);
    bool drawn = stage_target_bind(target, width, height);
    if (drawn) {
        gl_scissor(needed(place, scale, width, height), height);
        stage_draw(renderer, view, 0, 0, width, height);
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)screen);
        gl_scissor(place.visible, place.height);
        glBlitFramebuffer(0, 0, width, height, to.x0, place.height - to.y1, to.x1, place.height - to.y0,
                          GL_COLOR_BUFFER_BIT, GL_LINEAR);
    }
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)screen);
    return drawn;
}
