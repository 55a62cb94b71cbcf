/// The renderer: draws stage and draw list, only where something changed.
#include "draw/draw.h"
#include "base/hash.h"
#include "base/need.h"
#include "base/progress.h"
#include "draw/damage.h"
#include "draw/gl.h"
#include "draw/paint.h"
#include "draw/stage.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct draw {
    struct batch batch;
    struct stage_renderer *stage;
    struct stage_target stage_target;
    struct atlas atlas;
    GLuint atlas_texture;
    struct line_scratch scratch;
    struct damage damage;
    struct gpu_timer timer;
};

static bool is_software(const char *renderer)
{
    return strstr(renderer, "llvmpipe") || strstr(renderer, "softpipe") || strstr(renderer, "Software");
}

static bool is_reduced(float stage_scale) { return stage_scale > 0.0f && stage_scale < 1.0f; }

/// Rasterises the fonts for `scale` and uploads them; on failure keeps the old ones.
static bool load_atlas(struct draw *draw, float scale, struct error *error)
{
    struct atlas atlas;
    if (!atlas_build(scale, &atlas, error)) return false;
    const int largest = gl_largest_texture();
    if (atlas.width > largest || atlas.height > largest) {
        fail(error, ERROR_ENVIRONMENT, "the fonts need a texture of %d × %d, this OpenGL driver takes %d",
             atlas.width, atlas.height, largest);
        atlas_free(&atlas);
        return false;
    }
    atlas_free(&draw->atlas);
    draw->atlas = atlas;
    if (!draw->atlas_texture) glGenTextures(1, &draw->atlas_texture);
    glBindTexture(GL_TEXTURE_2D, draw->atlas_texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE, atlas.coverage);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    damage_forget(&draw->damage);
    return true;
}

struct draw *draw_create(float scale, struct error *error)
{
    struct draw *draw = need_zeroed(1, sizeof *draw);
    bool ok = batch_create(&draw->batch, error) && load_atlas(draw, scale, error);
    if (ok) draw->stage = stage_renderer_create(error);
    if (!draw->stage) {
        draw_destroy(draw);
        return NULL;
    }
    gpu_timer_create(&draw->timer, is_software(draw_renderer_name()));
    return draw;
}

void draw_destroy(struct draw *draw)
{
    if (!draw) return;
    gpu_timer_destroy(&draw->timer);
    stage_target_destroy(&draw->stage_target);
    if (draw->stage) stage_renderer_destroy(draw->stage);
    if (draw->atlas_texture) glDeleteTextures(1, &draw->atlas_texture);
    atlas_free(&draw->atlas);
    batch_destroy(&draw->batch);
    free(draw);
}

/// Draws the part of the stage in `visible`.
static void draw_stage(struct draw *draw, const struct draw_input *input, struct area viewport, struct area visible)
{
    const struct stage_place place = {viewport, visible, input->height};
    const float scale = input->stage_scale;
    if (is_reduced(scale) && stage_target_draw(&draw->stage_target, draw->stage, input->stage, place, scale)) return;
    int width = viewport.x1 - viewport.x0, height = viewport.y1 - viewport.y0;
    gl_scissor(visible, input->height);
    stage_draw(draw->stage, input->stage, viewport.x0, input->height - viewport.y1, width, height);
}

/// The bottom layer of a rectangle: panel colour, and the stage in its viewport.
static void draw_below(struct draw *draw, const struct draw_input *input, struct area area, struct area viewport)
{
    struct area on_stage = area_intersect(area, viewport);
    glEnable(GL_SCISSOR_TEST);
    if (!area_contains(viewport, area)) {
        gl_scissor(area, input->height);
        gl_clear(theme()->panel | 0xFF);
    }
    if (area_empty(on_stage)) return;
    draw_stage(draw, input, viewport, on_stage);
}

/// A new resolution changes every pixel of the stage, and enlarging spreads motion to neighbours.
static struct damage_stage describe_stage(const struct draw_input *input)
{
    static const float seam = 3.0f; ///< device pixels that soft outlines may reach outwards, rounded up
    if (!input->stage) return (struct damage_stage){0};
    struct damage_stage stage = {.viewport = area_rounded(input->stage->viewport, input->scale),
                                 .hash = stage_backdrop_hash(input->stage),
                                 .moving_hash = input->stage->hash};
    const float scale = is_reduced(input->stage_scale) ? input->stage_scale : 1.0f;
    stage.moving = stage_extent(input->stage, stage.viewport, (int)ceilf(seam / scale));
    stage.hash = hash_bytes(stage.hash, &scale, sizeof scale);
    return stage;
}

static bool any_touches(const struct damage *damage, struct area viewport)
{
    for (int i = 0; i < damage->count; i++) {
        if (area_touches(damage->rectangles[i], viewport)) return true;
    }
    return false;
}

static void draw_damage(struct draw *draw, const struct draw_input *input, struct area viewport,
                        struct draw_cost *cost)
{
    const struct damage *damage = &draw->damage;
    double start = clock_now();
    if (input->stage && any_touches(damage, viewport)) stage_upload(draw->stage, input->stage, &cost->uploaded_bytes);
    cost->upload_us = 1e6 * (clock_now() - start);

    gpu_timer_begin(&draw->timer, input->frame);
    struct batch *batch = &draw->batch;
    struct painter painter = {batch, &draw->scratch, &draw->atlas, input->scale};
    for (int i = 0; i < damage->count; i++) {
        draw_below(draw, input, damage->rectangles[i], viewport);
        cost->pixels += area_pixels(damage->rectangles[i]);
    }
    batch_begin(batch, input->width, input->height, draw->atlas_texture, draw->atlas.width, draw->atlas.height);
    for (int i = 0; i < damage->count; i++) paint_list(&painter, input->list, damage->rectangles[i]);
    batch_flush(batch);
    glDisable(GL_SCISSOR_TEST);
    gpu_timer_end(&draw->timer);

    cost->rectangles = damage->count;
    cost->uploaded_bytes += batch->uploaded_bytes;
    cost->upload_us += batch->upload_us;
    cost->draw_us = 1e6 * (clock_now() - start) - cost->upload_us;
}

void draw_frame(struct draw *draw, const struct draw_input *input, struct draw_cost *cost)
{
    *cost = (struct draw_cost){0};
    cost->gpu_us = gpu_timer_take(&draw->timer, &cost->gpu_frame);
    double start = clock_now();
    // If the driver takes no larger texture, the old glyphs remain, less sharp.
    if (input->scale != draw->atlas.scale) load_atlas(draw, input->scale, NULL);
    if (!input->keeps) damage_forget(&draw->damage);
    const struct damage_stage stage = describe_stage(input);
    damage_update(&draw->damage, input->width, input->height, input->scale, input->list, &stage);
    double compared = 1e6 * (clock_now() - start);
    if (draw->damage.count > 0) draw_damage(draw, input, stage.viewport, cost);
    cost->draw_us += compared;
}

void draw_read(int width, int height, unsigned char *rgba)
{
    size_t stride = (size_t)width * 4;
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    for (int top = 0, bottom = height - 1; top < bottom; top++, bottom--) {
        unsigned char *a = rgba + (size_t)top * stride, *b = rgba + (size_t)bottom * stride;
        for (size_t i = 0; i < stride; i++) {
            unsigned char keep = a[i];
            a[i] = b[i];
            b[i] = keep;
        }
    }
    for (size_t i = 3; i < stride * (size_t)height; i += 4) rgba[i] = 255;
}

const char *draw_renderer_name(void)
{
    static char name[256];
    const char *renderer = (const char *)glGetString(GL_RENDERER), *version = (const char *)glGetString(GL_VERSION);
    snprintf(name, sizeof name, "%s, OpenGL %s", renderer ? renderer : "unknown", version ? version : "unknown");
    return name;
}
