/// An EGL surface without a display.
#include "base/need.h"
#include "platform/surface.h"
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <stdlib.h>
#include <string.h>

enum { DEVICES_MAX = 16 };

struct offscreen {
    EGLDisplay display;
    EGLContext context;
    GLuint framebuffer, color, depth;
};

/// epoxy ends the process if a library is missing, so check first.
static bool have_libraries(struct error *error)
{
    static const char *const names[] = {"libEGL.so.1", "libOpenGL.so.0", "libGL.so.1"};
    bool have[3];
    for (int i = 0; i < 3; i++) {
        void *library = dlopen(names[i], RTLD_LAZY | RTLD_LOCAL);
        have[i] = library != NULL;
        if (library) dlclose(library);
    }
    if (!have[0])
        return fail(error, ERROR_ENVIRONMENT, "libEGL.so.1 is missing: install libegl1 and libgl1-mesa-dri");
    if (!have[1] && !have[2]) return fail(error, ERROR_ENVIRONMENT, "libGL.so.1 is missing: install libgl1");
    return true;
}

static bool has_word(const char *words, const char *word)
{
    size_t length = strlen(word);
    for (const char *at = words; at && (at = strstr(at, word)); at += length) {
        bool starts = at == words || at[-1] == ' ', ends = at[length] == ' ' || at[length] == '\0';
        if (starts && ends) return true;
    }
    return false;
}

/// Makes a 3.3 core context without a surface current. Cleans up on failure.
static bool open_display(struct offscreen *offscreen, EGLDisplay display)
{
    static const EGLint config_wishes[] = {EGL_SURFACE_TYPE, EGL_DONT_CARE, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT,
                                           EGL_NONE};
    const EGLint context_wishes[] = {EGL_CONTEXT_FLAGS_KHR,
                                     gl_debug_wanted() ? EGL_CONTEXT_OPENGL_DEBUG_BIT_KHR : 0,
                                     EGL_CONTEXT_MAJOR_VERSION,
                                     3,
                                     EGL_CONTEXT_MINOR_VERSION,
                                     3,
                                     EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                     EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                     EGL_NONE};
    EGLint major = 0, minor = 0, count = 0;
    EGLConfig config = EGL_NO_CONFIG_KHR;
    if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) return false;
    EGLContext context = EGL_NO_CONTEXT;
    if (eglBindAPI(EGL_OPENGL_API) && eglChooseConfig(display, config_wishes, &config, 1, &count) && count > 0) {
        context = eglCreateContext(display, config, EGL_NO_CONTEXT, context_wishes);
    }
    if (context != EGL_NO_CONTEXT && eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
        offscreen->display = display;
        offscreen->context = context;
        return true;
    }
    if (context != EGL_NO_CONTEXT) eglDestroyContext(display, context);
    eglTerminate(display);
    return false;
}

/// Tries all hardware or all software devices.
static bool open_device(struct offscreen *offscreen, const char *client_extensions, bool software)
{
    if (!has_word(client_extensions, "EGL_EXT_platform_device")) return false;
    bool enumerable = has_word(client_extensions, "EGL_EXT_device_base") ||
                      has_word(client_extensions, "EGL_EXT_device_enumeration");
    EGLDeviceEXT devices[DEVICES_MAX];
    EGLint count = 0;
    if (!enumerable || !eglQueryDevicesEXT(DEVICES_MAX, devices, &count)) return false;
    for (EGLint i = 0; i < count; i++) {
        const char *extensions = eglQueryDeviceStringEXT(devices[i], EGL_EXTENSIONS);
        if (has_word(extensions, "EGL_MESA_device_software") != software) continue;
        if (open_display(offscreen, eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL))) return true;
    }
    return false;
}

/// Tries GPUs, then Mesa's surfaceless platform, then its software device.
static bool open_any(struct offscreen *offscreen, struct error *error)
{
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (open_device(offscreen, extensions, false)) return true;
    if (has_word(extensions, "EGL_MESA_platform_surfaceless") &&
        open_display(offscreen, eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, NULL))) {
        return true;
    }
    if (open_device(offscreen, extensions, true)) return true;
    return fail(error, ERROR_ENVIRONMENT,
                "no EGL device gives an OpenGL 3.3 context without a display: install libgl1-mesa-dri");
}

static bool create_framebuffer(struct offscreen *offscreen, int width, int height, struct error *error)
{
    GLint largest = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    if (width < 1 || height < 1 || width > largest || height > largest) {
        return fail(error, ERROR_ENVIRONMENT, "expected a picture of 1 to %d pixels a side, got %d × %d", largest,
                    width, height);
    }
    glGenRenderbuffers(1, &offscreen->color);
    glBindRenderbuffer(GL_RENDERBUFFER, offscreen->color);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glGenRenderbuffers(1, &offscreen->depth);
    glBindRenderbuffer(GL_RENDERBUFFER, offscreen->depth);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glGenFramebuffers(1, &offscreen->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, offscreen->framebuffer);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, offscreen->color);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, offscreen->depth);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return true;
    return fail(error, ERROR_ENVIRONMENT, "the graphics driver makes no framebuffer of %d × %d pixels", width,
                height);
}

struct offscreen *offscreen_create(int width, int height, struct error *error)
{
    if (!have_libraries(error)) return NULL;
    struct offscreen *offscreen = need_zeroed(1, sizeof *offscreen);
    if (!open_any(offscreen, error)) {
        free(offscreen);
        return NULL;
    }
    keep_driver_loaded();
    if (!create_framebuffer(offscreen, width, height, error)) {
        offscreen_destroy(offscreen);
        return NULL;
    }
    return offscreen;
}

void offscreen_destroy(struct offscreen *offscreen)
{
    glDeleteFramebuffers(1, &offscreen->framebuffer);
    glDeleteRenderbuffers(1, &offscreen->color);
    glDeleteRenderbuffers(1, &offscreen->depth);
    eglMakeCurrent(offscreen->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(offscreen->display, offscreen->context);
    eglTerminate(offscreen->display);
    free(offscreen);
}
