/// A smaller picture of the stage, drawn first and then enlarged onto the panel. Private to draw/.
#ifndef DRAW_STAGE_TARGET_H
#define DRAW_STAGE_TARGET_H

#include "draw/area.h"
#include "draw/gl.h"
#include "draw/stage.h"

struct stage_target {
    GLuint framebuffer, color, depth;
    int width, height;
};

void stage_target_destroy(struct stage_target *target);

/// Where the stage goes in a framebuffer of `height` pixels, and how much of it shows.
struct stage_place {
    struct area viewport, visible;
    int height;
};

/// Draws the visible part at `scale` (below 1) of the viewport's pixels and enlarges it. false, with nothing drawn, if the
/// driver cannot make the framebuffer.
bool stage_target_draw(struct stage_target *target, struct stage_renderer *renderer, const struct stage_view *view,
                       struct stage_place place, float scale);

#endif
