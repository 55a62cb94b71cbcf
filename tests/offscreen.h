/// Draws the stage offscreen; the fixture of a group of tests. If that is not possible, `platform` is NULL and tests skip().
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
    platform = platform_offscreen(width, height, 1.0f, &error);
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

/// For files that draw pictures of this size.
#define OFFSCREEN(width, height)                                                                                     \
    static int open_picture(__attribute__((unused)) void **state) { return offscreen_open(width, height); }          \
    TESTS_BETWEEN(open_picture, offscreen_close)

/// Draws a view over the whole picture and reads it back, bottom row first.
static inline void offscreen_draw(const struct stage_view *view, int width, int height, void *pixels)
{
    long bytes = 0;
    stage_upload(renderer, view, &bytes);
    assert_true(bytes > 0);
    stage_draw(renderer, view, 0, 0, width, height);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    assert_int_equal(glGetError(), GL_NO_ERROR);
}

/// Draws only `count` characters, with the box lo … hi in view.
static inline void offscreen_draw_characters(const struct stage_character *characters, int count, const float lo[3],
                                             const float hi[3], int width, int height, void *pixels)
{
    static struct stage_view view;
    const float aspect = (float)width / (float)height;
    struct camera camera = camera_default();
    memset(&view, 0, sizeof view);
    view.viewport = (struct rect){0, 0, (float)width, (float)height};
    view.colors = theme()->stage;
    camera_fit(&camera, lo, hi, aspect, 0);
    camera_matrices(&camera, aspect, view.view, view.projection, view.eye);
    camera_lamp(&camera, view.key_from);
    memcpy(view.characters, characters, (size_t)count * sizeof *characters);
    view.character_count = count;
    offscreen_draw(&view, width, height, pixels);
}

#endif
