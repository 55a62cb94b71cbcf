/// Compiles and links the embedded shaders, fills buffers and textures, and times the GPU.
#include "draw/gl.h"
#include "base/embedded.h"
#include "base/png.h"
#include <stdio.h>
#include <string.h>

static GLuint compile(GLenum kind, const char *name, const char *define)
{
    char path[64], line[64] = "";
    snprintf(path, sizeof path, "shaders/%s", name);
    const struct embedded *source = embedded_find(path);
    GLuint shader = glCreateShader(kind);
    if (define) snprintf(line, sizeof line, "#define %s\n", define);
    const GLchar *texts[] = {GLSL_VERSION, line, (const GLchar *)source->data};
    glShaderSource(shader, 3, texts, NULL);
    glCompileShader(shader);
    return shader;
}

/// Reports the first line of the driver's log; returns false.
static bool refuse(const char *name, const char *what, char *log, struct error *error)
{
    log[strcspn(log, "\r\n")] = '\0';
    return fail(error, ERROR_ENVIRONMENT, "shaders/%s: the graphics driver cannot %s it: %s", name, what,
                *log ? log : "?");
}

static bool is_compiled(GLuint shader, const char *name, struct error *error)
{
    char log[256] = "";
    GLint ok = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &ok);
    if (ok) return true;
    glGetShaderInfoLog(shader, sizeof log, NULL, log);
    return refuse(name, "compile", log, error);
}

GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error)
{
    const GLuint vertex = compile(GL_VERTEX_SHADER, vertex_name, NULL);
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_name, define);
    GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    GLint linked = 0;
    if (is_compiled(vertex, vertex_name, error) && is_compiled(fragment, fragment_name, error)) {
        char log[256] = "";
        glLinkProgram(program);
        glGetProgramiv(program, GL_LINK_STATUS, &linked);
        if (!linked) {
            glGetProgramInfoLog(program, sizeof log, NULL, log);
            refuse(vertex_name, "link", log, error);
        }
    }
    if (!linked) {
        glDeleteProgram(program);
        program = 0;
    }
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return program;
}

GLuint gl_buffer(GLenum target, size_t bytes, const void *data, GLenum usage)
{
    GLuint buffer;
    glGenBuffers(1, &buffer);
    glBindBuffer(target, buffer);
    glBufferData(target, (GLsizeiptr)bytes, data, usage);
    return buffer;
}

void gl_attribute(GLuint index, GLint size, GLenum type, size_t stride, size_t offset)
{
    glEnableVertexAttribArray(index);
    glVertexAttribPointer(index, size, type, type == GL_UNSIGNED_BYTE, (GLsizei)stride, (const void *)offset);
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

void gl_uniform_linear(GLint location, uint32_t color)
{
    float linear[3];
    for (int k = 0; k < 3; k++) linear[k] = srgb_to_linear((float)(color >> (24 - 8 * k) & 0xFFu) / 255);
    glUniform3fv(location, 1, linear);
}

void gl_scissor(struct area area, int height)
{
    glScissor(area.x0, height - area.y1, area.x1 - area.x0, area.y1 - area.y0);
}

void gl_clear(uint32_t color)
{
    glClearColor((float)(color >> 24) / 255, (float)(color >> 16 & 0xFF) / 255, (float)(color >> 8 & 0xFF) / 255,
                 (float)(color & 0xFF) / 255);
    glClear(GL_COLOR_BUFFER_BIT);
}

int gl_largest_texture(void)
{
    GLint largest = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
    return largest;
}

void gpu_timer_create(struct gpu_timer *timer, bool is_software)
{
    *timer = (struct gpu_timer){0};
    GLint bits = 0;
    if (!is_software) glGetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
    timer->usable = bits > 0;
    if (timer->usable) glGenQueries(TIMER_QUERIES, timer->queries);
}

void gpu_timer_destroy(struct gpu_timer *timer)
{
    if (timer->usable) glDeleteQueries(TIMER_QUERIES, timer->queries);
    *timer = (struct gpu_timer){0};
}

void gpu_timer_begin(struct gpu_timer *timer, long frame)
{
    if (!timer->usable || timer->pending == TIMER_QUERIES) return;
    int next = (timer->oldest + timer->pending) % TIMER_QUERIES;
    timer->frames[next] = frame;
    glBeginQuery(GL_TIME_ELAPSED, timer->queries[next]);
    timer->running = true;
}

void gpu_timer_end(struct gpu_timer *timer)
{
    if (!timer->running) return;
    glEndQuery(GL_TIME_ELAPSED);
    timer->running = false;
    timer->pending++;
}

double gpu_timer_take(struct gpu_timer *timer, long *frame)
{
    if (timer->pending == 0) return -1.0;
    GLuint query = timer->queries[timer->oldest];
    GLuint available = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT_AVAILABLE, &available);
    if (!available) return -1.0;
    GLuint64 nanoseconds = 0;
    glGetQueryObjectui64v(query, GL_QUERY_RESULT, &nanoseconds);
    *frame = timer->frames[timer->oldest];
    timer->oldest = (timer->oldest + 1) % TIMER_QUERIES;
    timer->pending--;
    return (double)nanoseconds * 1.0e-3;
}
