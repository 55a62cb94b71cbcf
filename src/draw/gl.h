/// OpenGL, and helpers for all of draw/.
#ifndef DRAW_GL_H
#define DRAW_GL_H

#include "base/error.h"
#include "ui/drawlist.h"
#include <epoxy/gl.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>

// --- rectangles of whole device pixels from the top left

/// Pixels [x0, x1) × [y0, y1).
struct area {
    int x0, y0, x1, y1;
};

static inline int area_max(int a, int b) { return a > b ? a : b; }
static inline int area_min(int a, int b) { return a < b ? a : b; }

static inline bool area_empty(struct area a) { return a.x1 <= a.x0 || a.y1 <= a.y0; }

static inline long area_pixels(struct area a) { return area_empty(a) ? 0 : (long)(a.x1 - a.x0) * (a.y1 - a.y0); }

static inline struct area area_intersect(struct area a, struct area b)
{
    return (struct area){area_max(a.x0, b.x0), area_max(a.y0, b.y0), area_min(a.x1, b.x1), area_min(a.y1, b.y1)};
}

static inline struct area area_union(struct area a, struct area b)
{
    return (struct area){area_min(a.x0, b.x0), area_min(a.y0, b.y0), area_max(a.x1, b.x1), area_max(a.y1, b.y1)};
}

static inline bool area_touches(struct area a, struct area b) { return !area_empty(area_intersect(a, b)); }

static inline bool area_contains(struct area a, struct area b)
{
    return b.x0 >= a.x0 && b.y0 >= a.y0 && b.x1 <= a.x1 && b.y1 <= a.y1;
}

/// Converts a finite device coordinate without overflow.
static inline int area_whole(float device) { return (int)fminf(fmaxf(device, -1.0e6f), 1.0e6f); }

/// All pixels that touch a logical rectangle.
static inline struct area area_outer(struct rect r, float scale)
{
    return (struct area){area_whole(floorf(r.x * scale)), area_whole(floorf(r.y * scale)),
                         area_whole(ceilf((r.x + r.w) * scale)), area_whole(ceilf((r.y + r.h) * scale))};
}

/// A logical rectangle rounded to pixel edges, for clips and viewports.
static inline struct area area_rounded(struct rect r, float scale)
{
    return (struct area){area_whole(roundf(r.x * scale)), area_whole(roundf(r.y * scale)),
                         area_whole(roundf((r.x + r.w) * scale)), area_whole(roundf((r.y + r.h) * scale))};
}

// --- OpenGL

/// The line that begins every shader. OpenGL ES has one of its own.
#ifndef GLSL_VERSION
#define GLSL_VERSION "#version 330 core\n"
#endif

/// Compiles and links the embedded shaders "shaders/<vertex_name>" and "shaders/<fragment_name>", the latter with the macro `define` (or
/// NULL). Returns 0 with the driver's first error message on failure.
GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error);

/// A buffer with `bytes` of data (NULL: none yet), bound to the target.
GLuint gl_buffer(GLenum target, size_t bytes, const void *data, GLenum usage);

/// An attribute of the bound vertex array and buffer: `size` floats, or bytes normalised to 0 … 1.
void gl_attribute(GLuint index, GLint size, GLenum type, size_t stride, size_t offset);

/// Side of the largest texture, in texels.
int gl_largest_texture(void);

/// A repeating sRGB texture with opacity.
GLuint gl_picture(const unsigned char *pixels, int width, int height);

/// Calls glScissor for an area counted from the top of a framebuffer of `height` pixels.
void gl_scissor(struct area area, int height);

/// Clears to a colour 0xRRGGBBAA.
void gl_clear(uint32_t color);

// GPU timing.

enum { TIMER_QUERIES = 4 };

/// GL_TIME_ELAPSED of the last frames. Results are read when available, some frames late.
struct gpu_timer {
    GLuint queries[TIMER_QUERIES];
    long frames[TIMER_QUERIES]; ///< frames of the queries
    int oldest, pending;
    bool usable, running;
};

/// Software renderers get no timer: they draw at the flush, outside the queries.
void gpu_timer_create(struct gpu_timer *timer, bool is_software);
void gpu_timer_destroy(struct gpu_timer *timer);

/// Starts timing a frame, unless four results are still pending.
void gpu_timer_begin(struct gpu_timer *timer, long frame);
void gpu_timer_end(struct gpu_timer *timer);

/// Microseconds and number of the oldest frame finished since the last call; negative if none.
double gpu_timer_take(struct gpu_timer *timer, long *frame);

#endif
