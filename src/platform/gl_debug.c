/// Collects the OpenGL driver's debug messages.
#include "base/hash.h"
#include "platform/platform.h"
#include "platform/surface.h"
#include <epoxy/gl.h>
#include <stdio.h>
#include <string.h>

enum { SEEN_MAX = 64 };

/// Global, because the driver can call back at any time; the process has one context.
static struct {
    uint64_t seen[SEEN_MAX];
    int seen_count, complaints;
    bool wanted;
} messages;

static const char *kind_of(GLenum type)
{
    static const char *const kinds[] = {"error", "deprecated", "undefined", "portability", "performance"};
    const GLenum kind = type - GL_DEBUG_TYPE_ERROR; // GL's numbers are in this order
    return kind < sizeof kinds / sizeof *kinds ? kinds[kind] : "other";
}

/// Performance hints and low severity are printed but not counted.
static bool is_complaint(GLenum type, GLenum severity)
{
    if (type == GL_DEBUG_TYPE_PERFORMANCE) return false;
    return type != GL_DEBUG_TYPE_OTHER || severity != GL_DEBUG_SEVERITY_LOW;
}

static bool is_new(const char *text, size_t length)
{
    const uint64_t hash = hash_bytes(HASH_START, text, length);
    for (int i = 0; i < messages.seen_count; i++) {
        if (messages.seen[i] == hash) return false;
    }
    if (messages.seen_count < SEEN_MAX) messages.seen[messages.seen_count++] = hash;
    return true;
}

static void APIENTRY on_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                                const GLchar *text, const void *user)
{
    (void)source;
    (void)user;
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    const size_t size = length < 0 ? strlen(text) : (size_t)length;
    messages.complaints += is_complaint(type, severity);
    if (is_new(text, size)) fprintf(stderr, "OpenGL, %s %u: %.*s\n", kind_of(type), id, (int)size, text);
}

void platform_debug_gl(void) { messages.wanted = true; }

bool gl_debug_wanted(void) { return messages.wanted; }

bool gl_debug_start(struct error *error)
{
    if (!messages.wanted) return true;
    if (epoxy_gl_version() < 43 && !epoxy_has_gl_extension("GL_KHR_debug"))
        return fail(error, ERROR_ENVIRONMENT, "--gl-debug: this OpenGL driver has no GL_KHR_debug");
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS); // so that a debugger stops at the offending call
    glDebugMessageCallback(on_message, NULL);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_TRUE);
    return true;
}

int platform_gl_complaints(void) { return messages.complaints; }
