/// OpenGL, and helpers that all files of draw/ need.
#ifndef DRAW_GL_H
#define DRAW_GL_H

#include "base/error.h"
#include <epoxy/gl.h>
#include <stddef.h>
#include <stdint.h>

/// Compiles and links the embedded shaders "shaders/<vertex_name>" and "shaders/<fragment_name>", the latter with `define` defined
/// (NULL: nothing). On failure 0, with the driver's first complaint as a sentence.
GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error);

/// A buffer with `bytes` of data (NULL: none yet), bound to the target.
GLuint gl_buffer(GLenum target, size_t bytes, const void *data, GLenum usage);

/// An attribute of the vertex array and the buffer that are bound: `size` floats, or bytes that stand for 0 … 1.
void gl_attribute(GLuint index, GLint size, GLenum type, size_t stride, size_t offset);

/// Side of the largest texture, texels.
int gl_largest_texture(void);

/// A texture of sRGB pixels with opacity, which repeats.
GLuint gl_picture(const unsigned char *pixels, int width, int height);

/// Sets a vec3 of the program in use to a colour 0xRRGGBBAA (sRGB), made linear.
void gl_uniform_linear(GLint location, uint32_t color);

// How long the GPU draws.

enum { TIMER_QUERIES = 4 };

/// GL_TIME_ELAPSED of the last frames: results are read some frames late, once they are there, and never waited for.
struct gpu_timer {
    GLuint queries[TIMER_QUERIES];
    long frames[TIMER_QUERIES]; ///< that the queries belong to
    int oldest, pending;
    bool usable, running;
};

/// Software renderers draw at the flush, not between the queries: their numbers would mislead, so they have no timer.
void gpu_timer_create(struct gpu_timer *timer, bool is_software);
void gpu_timer_destroy(struct gpu_timer *timer);

/// Starts timing a frame, unless the results of four earlier ones are still pending.
void gpu_timer_begin(struct gpu_timer *timer, long frame);
void gpu_timer_end(struct gpu_timer *timer);

/// Microseconds of the oldest frame that has come back since the last call, and its number; negative where there is none.
double gpu_timer_take(struct gpu_timer *timer, long *frame);

#endif
