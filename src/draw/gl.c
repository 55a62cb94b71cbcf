/// Compiles and links the shaders built into the program.
#include "draw/gl.h"
#include "base/embedded.h"
#include "base/png.h"
#include <stdio.h>
#include <string.h>

/// The compiler's log may have many lines; the first says what is wrong.
static void first_line(char *log)
{
    log[strcspn(log, "\r\n")] = '\0';
    if (!*log) snprintf(log, 2, "?");
}

static GLuint compile(GLenum kind, const char *name, const char *define, struct error *error)
{
    char path[64];
    snprintf(path, sizeof path, "shaders/%s", name);
    const struct embedded *source = embedded_find(path);
    if (!source) {
        fail(error, ERROR_ENVIRONMENT, "%s: expected a shader built into the program, got none", path);
        return 0;
    }
    GLuint shader = glCreateShader(kind);
    char line[64] = "";
    if (define) snprintf(line, sizeof line, "#define %s\n", define);
    const GLchar *text = (const GLchar *)source->data;
    const GLint first = (GLint)strcspn(text, "\n") + 1; // "#version …" comes before all else
    const GLchar *texts[] = {text, line, text + first};
    const GLint lengths[] = {first, (GLint)strlen(line), (GLint)source->size - first};
    glShaderSource(shader, 3, texts, lengths);
    glCompileShader(shader);
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return shader;
    char log[256] = "";
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    first_line(log);
    glDeleteShader(shader);
    fail(error, ERROR_ENVIRONMENT, "%s: the graphics driver cannot compile it: %s", path, log);
    return 0;
}

static GLuint link_program(GLuint vertex, GLuint fragment, const char *name, struct error *error)
{
    GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    glLinkProgram(program);
    GLint ok = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok) return program;
    char log[256] = "";
    glGetProgramInfoLog(program, sizeof log, NULL, log);
    first_line(log);
    glDeleteProgram(program);
    fail(error, ERROR_ENVIRONMENT, "shaders/%s: the graphics driver cannot link it: %s", name, log);
    return 0;
}

GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error)
{
    GLuint vertex = compile(GL_VERTEX_SHADER, vertex_name, define, error);
    GLuint fragment = vertex ? compile(GL_FRAGMENT_SHADER, fragment_name, define, error) : 0;
    GLuint program = fragment ? link_program(vertex, fragment, vertex_name, error) : 0;
    if (vertex) glDeleteShader(vertex);
    if (fragment) glDeleteShader(fragment);
    return program;
}

GLuint gl_picture(const unsigned char *pixels, int width, int height)
{
    GLuint texture;
    glGenTextures(1, &texture);
    glBindTexture(GL_TEXTURE_2D, texture);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    glGenerateMipmap(GL_TEXTURE_2D);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
    return texture;
}

GLuint gl_white(void)
{
    static const unsigned char white[4] = {255, 255, 255, 255};
    return gl_picture(white, 1, 1);
}

void gl_uniform_linear(GLint location, uint32_t color)
{
    float linear[3];
    for (int k = 0; k < 3; k++) linear[k] = srgb_to_linear((float)(color >> (24 - 8 * k) & 0xFFu) / 255);
    glUniform3fv(location, 1, linear);
}

void gl_find_uniforms(GLuint program, const struct gl_uniform *uniforms, size_t count)
{
    for (size_t i = 0; i < count; i++) *uniforms[i].location = glGetUniformLocation(program, uniforms[i].name);
}

int gl_largest_texture(void)
{
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    return largest;
}
