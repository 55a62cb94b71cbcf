/// Draws the stage offscreen; the fixture of a file of tests. If that is not possible, `platform` is NULL and tests skip().
#ifndef TESTS_OFFSCREEN_H
#define TESTS_OFFSCREEN_H

#include "draw/gl.h"
#include "draw/stage.h"
#include "near.h"
#include "platform/platform.h"
#include "rig/camera.h"
#include "ui/theme.h"

static struct platform *platform;
static struct stage_renderer *renderer;

static inline int offscreen_open(int width, int height)
{
    struct error error = {0};
    platform = platform_offscreen(width, height, 1, &error);
    if (!platform) {
        print_message("skip - no offscreen drawing here: %s\n", error.text);
        return 0;
    }
    renderer = stage_renderer_create(&error);
    if (!renderer) print_error("%s\n", error.text);
    return renderer ? 0 : -1;
}

static inline int offscreen_close(void **state)
{
    (void)state;
    if (!platform) return 0;
    stage_renderer_destroy(renderer);
    platform_destroy(platform);
    return 0;
}

/// A picture, bottom row first. No larger than the one that is open.
struct shot {
    int width, height;
    unsigned char pixel[1000 * 400][4];
};

/// Draws a view over a picture of this size and reads it back.
static inline void offscreen_draw(const struct stage_view *view, int width, int height, void *pixels)
{
    long bytes = 0;
    stage_upload(renderer, view, &bytes);
    assert_true(bytes > 0);
    stage_draw(renderer, view, 0, 0, width, height, false);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

static inline void shoot(const struct stage_view *view, struct shot *shot)
{
    offscreen_draw(view, shot->width, shot->height, shot->pixel);
}

/// An empty stage that looks at the box lo … hi.
static inline void look_at(struct stage_view *view, const float lo[3], const float hi[3], const struct shot *shot)
{
    const float aspect = (float)shot->width / (float)shot->height;
    struct camera camera = camera_default();
    memset(view, 0, sizeof *view);
    view->viewport = (struct rect){0, 0, (float)shot->width, (float)shot->height};
    view->colors = theme()->stage;
    camera_fit(&camera, lo, hi, aspect, 0);
    camera_matrices(&camera, aspect, view->view, view->projection, view->eye);
    camera_lamp(&camera, view->key_from);
}

static inline const unsigned char *pixel_at(const struct shot *shot, int x, int y)
{
    return shot->pixel[y * shot->width + x];
}

/// Pixels that differ by more than `tolerance` in any colour.
static inline int differing(const struct shot *a, const struct shot *b, int tolerance)
{
    int count = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        bool differs = false;
        for (int k = 0; k < 3; k++) differs |= abs(a->pixel[i][k] - b->pixel[i][k]) > tolerance;
        count += differs;
    }
    return count;
}

#endif
