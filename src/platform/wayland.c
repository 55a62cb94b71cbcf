/// Asks a Wayland compositor what GLFW does not report.
#include "platform/surface.h"
#include <poll.h>
#include <stdint.h>
#include <string.h>

struct wl_display;
struct wl_proxy;
struct wl_interface;

enum { DISPLAY_GET_REGISTRY = 1, REGISTRY_BIND = 0, SEAT_POINTER = 1 }; // of the protocol

/// What we need of the client library, which GLFW has loaded if it uses it.
struct library {
    struct wl_display *display;
    int (*get_fd)(struct wl_display *);
    int (*get_error)(struct wl_display *);
    int (*roundtrip)(struct wl_display *);
    struct wl_proxy *(*make)(struct wl_proxy *, uint32_t, const struct wl_interface *, ...);
    struct wl_proxy *(*make_versioned)(struct wl_proxy *, uint32_t, const struct wl_interface *, uint32_t, ...);
    int (*listen)(struct wl_proxy *, void (**)(void), void *);
    void (*destroy)(struct wl_proxy *);
    const struct wl_interface *registry, *seat;
};

/// false if it is no Wayland window.
static bool load(struct library *library)
{
    struct wl_display *(*get_display)(void);
    if (!symbol_find("glfwGetWaylandDisplay", &get_display)) return false;
    library->display = get_display();
    return library->display && symbol_find("wl_display_get_fd", &library->get_fd) &&
           symbol_find("wl_display_get_error", &library->get_error);
}

static bool load_all(struct library *library)
{
    return symbol_find("wl_display_roundtrip", &library->roundtrip) &&
           symbol_find("wl_proxy_marshal_constructor", &library->make) &&
           symbol_find("wl_proxy_marshal_constructor_versioned", &library->make_versioned) &&
           symbol_find("wl_proxy_add_listener", &library->listen) &&
           symbol_find("wl_proxy_destroy", &library->destroy) &&
           symbol_find("wl_registry_interface", &library->registry) &&
           symbol_find("wl_seat_interface", &library->seat);
}

bool wayland_is_lost(void)
{
    struct library library;
    if (!load(&library)) return false;
    // The library notices a dead compositor only when it reads, and GLFW no longer reads then.
    struct pollfd end = {.fd = library.get_fd(library.display)};
    return library.get_error(library.display) != 0 ||
           (poll(&end, 1, 0) > 0 && (end.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0);
}

enum { SEATS_MAX = 8 };

struct search {
    const struct library *library;
    struct wl_proxy *seats[SEATS_MAX];
    int count;
    bool found;
};

static void on_capabilities(void *user, struct wl_proxy *seat, uint32_t capabilities)
{
    struct search *search = user;
    (void)seat;
    if (capabilities & SEAT_POINTER) search->found = true;
}

static void on_global(void *user, struct wl_proxy *registry, uint32_t name, const char *interface, uint32_t version)
{
    static void (*listener[])(void) = {(void (*)(void))on_capabilities, NULL};
    struct search *search = user;
    const struct library *library = search->library;
    (void)version;
    if (strcmp(interface, "wl_seat") != 0 || search->count == SEATS_MAX) return;
    struct wl_proxy *seat =
        library->make_versioned(registry, REGISTRY_BIND, library->seat, 1, name, interface, 1, NULL);
    if (!seat) return;
    search->seats[search->count++] = seat;
    library->listen(seat, listener, search);
}

static void on_global_removed(void *user, struct wl_proxy *registry, uint32_t name)
{
    (void)user;
    (void)registry;
    (void)name;
}

bool wayland_allows_cursors(void)
{
    static void (*listener[])(void) = {(void (*)(void))on_global, (void (*)(void))on_global_removed};
    struct library library;
    if (!load(&library)) return true;
    if (!load_all(&library)) return false;
    struct search search = {.library = &library};
    struct wl_proxy *registry =
        library.make((struct wl_proxy *)library.display, DISPLAY_GET_REGISTRY, library.registry, NULL);
    if (!registry) return false;
    library.listen(registry, listener, &search);
    library.roundtrip(library.display); // the seats
    library.roundtrip(library.display); // their pointers
    for (int i = 0; i < search.count; i++) library.destroy(search.seats[i]);
    library.destroy(registry);
    return search.found;
}
