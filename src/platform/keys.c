/// Maps GLFW's keys to ours.
#include "platform/surface.h"
#include <GLFW/glfw3.h>

static const int special_keys[GLFW_KEY_LAST + 1] = {
    [GLFW_KEY_SPACE] = KEY_SPACE,     [GLFW_KEY_ESCAPE] = KEY_ESCAPE,
    [GLFW_KEY_ENTER] = KEY_ENTER,     [GLFW_KEY_KP_ENTER] = KEY_ENTER,
    [GLFW_KEY_TAB] = KEY_TAB,         [GLFW_KEY_BACKSPACE] = KEY_BACKSPACE,
    [GLFW_KEY_INSERT] = KEY_INSERT,   [GLFW_KEY_DELETE] = KEY_DELETE,
    [GLFW_KEY_LEFT] = KEY_LEFT,       [GLFW_KEY_RIGHT] = KEY_RIGHT,
    [GLFW_KEY_UP] = KEY_UP,           [GLFW_KEY_DOWN] = KEY_DOWN,
    [GLFW_KEY_PAGE_UP] = KEY_PAGE_UP, [GLFW_KEY_PAGE_DOWN] = KEY_PAGE_DOWN,
    [GLFW_KEY_HOME] = KEY_HOME,       [GLFW_KEY_END] = KEY_END,
};

/// The ASCII character printed on a key, letters in upper case, or KEY_NONE.
static int printed(int glfw_key, int scancode)
{
    const char *name = glfwGetKeyName(glfw_key, scancode);
    if (!name || name[0] <= ' ' || name[0] >= 0x7F || name[1] != '\0') return KEY_NONE;
    return name[0] >= 'a' && name[0] <= 'z' ? name[0] - 'a' + 'A' : name[0];
}

/// Whether the keyboard layout has Latin letters.
static bool is_latin(void)
{
    for (int key = GLFW_KEY_A; key <= GLFW_KEY_Z; key++) {
        int letter = printed(key, 0);
        if (letter >= 'A' && letter <= 'Z') return true;
    }
    return false;
}

int key_translate(int glfw_key, int scancode)
{
    if (glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9) return glfw_key;
    if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12) return KEY_F1 + (glfw_key - GLFW_KEY_F1);
    if (glfw_key >= 0 && glfw_key <= GLFW_KEY_LAST && special_keys[glfw_key]) return special_keys[glfw_key];
    // GLFW numbers keys by US layout.
    bool letter = glfw_key >= GLFW_KEY_A && glfw_key <= GLFW_KEY_Z;
    if (letter && !is_latin()) return glfw_key;
    int key = printed(glfw_key, scancode);
    return key == KEY_NONE && letter ? glfw_key : key;
}

unsigned mods_translate(int glfw_mods)
{
    return (glfw_mods & GLFW_MOD_SHIFT ? (unsigned)MOD_SHIFT : 0u) |
           (glfw_mods & GLFW_MOD_CONTROL ? (unsigned)MOD_CTRL : 0u) |
           (glfw_mods & GLFW_MOD_ALT ? (unsigned)MOD_ALT : 0u) |
           (glfw_mods & GLFW_MOD_SUPER ? (unsigned)MOD_SUPER : 0u);
}
