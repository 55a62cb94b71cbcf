/// Compiles and links the embedded shaders, fills buffers and textures, and times the GPU.
#include "draw/gl.h"
#include "base/embedded.h"
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

/// Whether a shader is compiled or a program is linked, else the first line of the driver's log is the error.
static bool is_made(GLuint object, bool links, const char *name, struct error *error)
{
    char log[256] = "";
    GLint made = 0;
    if (links)
        glGetProgramiv(object, GL_LINK_STATUS, &made);
    else
        glGetShaderiv(object, GL_COMPILE_STATUS, &made);
    if (made) return true;
    if (links)
        glGetProgramInfoLog(object, sizeof log, NULL, log);
    else
        glGetShaderInfoLog(object, sizeof log, NULL, log);
    log[strcspn(log, "\r\n")] = '\0';
    return fail(error, ERROR_ENVIRONMENT, "shaders/%s: the graphics driver cannot %s it: %s", name,
                links ? "link" : "compile", *log ? log : "?");
}

GLuint gl_program(const char *vertex_name, const char *fragment_name, const char *define, struct error *error)
{
    const GLuint vertex = compile(GL_VERTEX_SHADER, vertex_name, NULL);
    const GLuint fragment = compile(GL_FRAGMENT_SHADER, fragment_name, define);
    const GLuint program = glCreateProgram();
    glAttachShader(program, vertex);
    glAttachShader(program, fragment);
    bool made = is_made(vertex, false, vertex_name, error) && is_made(fragment, false, fragment_name, error);
    if (made) glLinkProgram(program);
    made = made && is_made(program, true, vertex_name, error);
    if (!made) glDeleteProgram(program);
    glDeleteShader(vertex);
    glDeleteShader(fragment);
    return made ? program : 0;
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
