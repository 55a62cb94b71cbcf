/// Creates surfaces, among them an EGL one without a display, collects the OpenGL driver's messages, and works around graphics drivers.
#include "platform/platform.h"
#include "base/hash.h"
#include "base/need.h"
#include "platform/surface.h"
#include <dlfcn.h>
#include <epoxy/egl.h>
#include <epoxy/gl.h>
#include <link.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the driver's messages (--gl-debug)

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
    // Performance hints and low severity are printed but not counted.
    const bool is_mild = type == GL_DEBUG_TYPE_OTHER && severity == GL_DEBUG_SEVERITY_LOW;
    messages.complaints += type != GL_DEBUG_TYPE_PERFORMANCE && !is_mild;
    if (is_new(text, size)) fprintf(stderr, "OpenGL, %s %u: %.*s\n", kind_of(type), id, (int)size, text);
}

void platform_debug_gl(void) { messages.wanted = true; }

bool gl_debug_wanted(void) { return messages.wanted; }

/// Listens to the current context if wanted. false if its driver has no debug output.
static bool gl_debug_start(struct error *error)
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

// --- an EGL surface without a display

#ifdef __SANITIZE_ADDRESS__
/// Keeps a loaded Mesa library in memory.
static int pin_library(struct dl_phdr_info *info, size_t size, void *context)
{
    (void)size;
    (void)context;
    if (strstr(info->dlpi_name, "_dri.so")) dlopen(info->dlpi_name, RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
    return 0;
}

// Mesa's driver leaks a few blocks when unloaded. While it stays loaded, the leak checker finds pointers to them, or names to suppress.
static void keep_driver_loaded(void) { dl_iterate_phdr(pin_library, NULL); }
#else
static void keep_driver_loaded(void) {}
#endif

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

static void offscreen_destroy(struct offscreen *offscreen)
{
    glDeleteFramebuffers(1, &offscreen->framebuffer);
    glDeleteRenderbuffers(1, &offscreen->color);
    glDeleteRenderbuffers(1, &offscreen->depth);
    eglMakeCurrent(offscreen->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(offscreen->display, offscreen->context);
    eglTerminate(offscreen->display);
    free(offscreen);
}

static struct offscreen *offscreen_create(int width, int height, struct error *error)
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

// --- the platform

static struct platform *create_platform(void)
{
    struct platform *platform = need_zeroed(1, sizeof *platform);
#ifdef __GLIBC__
    // Software drivers allocate and free triangle memory every frame. The C library keeps it, which saves a tenth of the CPU time.
    mallopt(M_MMAP_THRESHOLD, 32 << 20); // the largest allowed
    mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
    return platform;
}

struct platform *platform_window(int width, int height, const char *title, int vsync, struct error *error)
{
    struct platform *platform = create_platform();
    platform->window = window_create(width, height, title, vsync, &platform->queue, error);
    if (!platform->window) {
        free(platform);
        return NULL;
    }
    keep_driver_loaded();
    if (!gl_debug_start(error)) {
        platform_destroy(platform);
        return NULL;
    }
    return platform;
}

struct platform *platform_blind(int width, int height, float scale)
{
    struct platform *platform = create_platform();
    platform->size = (struct surface_size){width, height, scale};
    return platform;
}

struct platform *platform_offscreen(int width, int height, float scale, struct error *error)
{
    struct platform *platform = platform_blind(width, height, scale);
    platform->offscreen = offscreen_create(width, height, error);
    if (!platform->offscreen) {
        free(platform);
        return NULL;
    }
    platform->keeps = true;
    if (gl_debug_start(error)) return platform;
    platform_destroy(platform);
    return NULL;
}

void platform_destroy(struct platform *platform)
{
    if (!platform) return;
    if (platform->window) window_destroy(platform->window);
    if (platform->offscreen) offscreen_destroy(platform->offscreen);
    free(platform->clipboard);
    free(platform);
}

void platform_run(struct platform *platform, bool (*frame)(void *), void *user)
{
    (void)platform;
    while (frame(user)) continue;
}

bool platform_in_page(void) { return false; }

void platform_describe(struct platform *platform, const char *text) { (void)platform, (void)text; }

void platform_share(struct platform *platform, const char *scene) { (void)platform, (void)scene; }

void platform_choose_file(struct platform *platform) { (void)platform; }

bool platform_fetches(const char *path)
{
    (void)path;
    return false;
}

bool platform_keeps(const struct platform *platform) { return platform->keeps; }
