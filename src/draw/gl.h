/// OpenGL, and helpers that all files of draw/ need.
#ifndef DRAW_GL_H
#define DRAW_GL_H

#include "base/error.h"
#include <epoxy/gl.h>
#include <stddef.h>
#include <stdint.h>

/// Compiles and links the embedded shaders "shaders/<vertex_name>" and "shaders/<fragment_name>", in which `define` (NULL: nothing)
/// is defined. On failure 0, with the compiler's first complaint as a sentence.
GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error);

/// Where a program keeps a uniform.
struct gl_uniform {
    GLint *location;
    const char *name;
};

/// Finds `count` of them; −1: the program has none of that name.
void gl_find_uniforms(GLuint program, const struct gl_uniform *uniforms, size_t count);

/// Side of the largest texture, texels.
int gl_largest_texture(void);

/// A texture of sRGB pixels with opacity, which repeats; and one that is a white pixel.
GLuint gl_picture(const unsigned char *pixels, int width, int height);
GLuint gl_white(void);

/// Sets a vec3 of the program in use to a colour 0xRRGGBBAA (sRGB), made linear.
void gl_uniform_linear(GLint location, uint32_t color);

#endif
