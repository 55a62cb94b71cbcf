/// Input events from a window, a replay or a test. Positions are logical pixels from the top left.
#ifndef UI_EVENT_H
#define UI_EVENT_H

#include <stdbool.h>
#include <stdint.h>

enum mouse_cursor { CURSOR_ARROW, CURSOR_HAND, CURSOR_HORIZONTAL, CURSOR_VERTICAL, CURSOR_MOVE, CURSOR_TEXT };

enum event_kind {
    EVENT_KEY,     ///< key, action, mods
    EVENT_TEXT,    ///< codepoint
    EVENT_POINTER, ///< x, y, mods
    EVENT_BUTTON,  ///< button, action, mods, x, y, clicks
    EVENT_WHEEL,   ///< dx, dy, mods, x, y
    EVENT_SIZE,    ///< x, y: new logical size; scale
    EVENT_DROP,    ///< path
    EVENT_PASTE,   ///< text of the clipboard, as requested
    EVENT_CLOSE,   ///< the window's close button
    EVENT_EXPOSE,  ///< the window's content was lost
    EVENT_FOCUS,   ///< the window got the keyboard focus
};

enum event_action { ACTION_RELEASE, ACTION_PRESS, ACTION_REPEAT };

enum event_mods { MOD_SHIFT = 1, MOD_CTRL = 2, MOD_ALT = 4, MOD_SUPER = 8 };

enum event_button { BUTTON_LEFT, BUTTON_RIGHT, BUTTON_MIDDLE };

/// Letters and digits are their upper-case ASCII code, punctuation is its ASCII code. Up to KEY_END as GLFW numbers them.
enum key {
    KEY_NONE = 0,
    KEY_SPACE = ' ',
    KEY_ESCAPE = 256,
    KEY_ENTER,
    KEY_TAB,
    KEY_BACKSPACE,
    KEY_INSERT,
    KEY_DELETE,
    KEY_RIGHT,
    KEY_LEFT,
    KEY_DOWN,
    KEY_UP,
    KEY_PAGE_UP,
    KEY_PAGE_DOWN,
    KEY_HOME,
    KEY_END,
    KEY_F1,
    KEY_F2,
    KEY_F3,
    KEY_F4,
    KEY_F5,
    KEY_F6,
    KEY_F7,
    KEY_F8,
    KEY_F9,
    KEY_F10,
    KEY_F11,
    KEY_F12,
    KEY_COUNT
};

struct event {
    enum event_kind kind;
    int key;                  ///< enum key
    enum event_action action; ///< of key and button
    unsigned mods;            ///< enum event_mods
    enum event_button button;
    int clicks;  ///< 2 for the second press of a double-click
    bool finger; ///< of pointer and button: less exact than a mouse
    uint32_t codepoint;
    float x, y, dx, dy;
    float scale;      ///< device pixels per logical pixel
    double time;      ///< arrival, in seconds
    const char *path; ///< EVENT_DROP: valid during the frame
    const char *text; ///< EVENT_PASTE: UTF-8, valid during the call
};

/// Names for replays: "A", "Left", "F1", ","; KEY_NONE or NULL if there is none.
const char *key_name(int key);
int key_from_name(const char *name);

#endif
