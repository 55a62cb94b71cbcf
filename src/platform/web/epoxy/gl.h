/// In place of libepoxy's header: OpenGL ES 3.0, which WebGL 2 is, and what else draw/ names.
#ifndef WEB_EPOXY_GL_H
#define WEB_EPOXY_GL_H

#include <GLES3/gl3.h>

#define GLSL_VERSION "#version 300 es\nprecision highp float;\n"

#define glDepthRange glDepthRangef

/// Which WebGL 2 has beyond OpenGL ES.
void glGetBufferSubData(GLenum target, GLintptr offset, GLsizeiptr size, void *data);

// Queries of the GPU's time need an extension, which is not asked for: no counter has bits, so none is used.
#define GL_TIME_ELAPSED 0x88BF
#define GL_QUERY_COUNTER_BITS 0x8864
#define glGetQueryiv(target, name, value) ((void)(value))
static inline void glGetQueryObjectui64v(GLuint query, GLenum name, GLuint64 *value)
{
    (void)query;
    (void)name;
    *value = 0;
}

#endif
