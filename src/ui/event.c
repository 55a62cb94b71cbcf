/// The names of keys.
#include "ui/event.h"
#include <stddef.h>
#include <string.h>

/// From KEY_ESCAPE on.
static const char *const special_names[] = {"Escape", "Enter", "Tab", "Backspace", "Insert",   "Delete", "Right",
                                            "Left",   "Down",  "Up",  "PageUp",    "PageDown", "Home",   "End",
                                            "F1",     "F2",    "F3",  "F4",        "F5",       "F6",     "F7",
                                            "F8",     "F9",    "F10", "F11",       "F12"};

_Static_assert(sizeof special_names / sizeof *special_names == KEY_COUNT - KEY_ESCAPE, "each has a name");

/// Names of keys that are a character: upper-case letters, digits, punctuation.
static const char printed_names[] = "!\0\"\0#\0$\0%\0&\0'\0(\0)\0*\0+\0,\0-\0.\0/\0"
                                    "0\0001\0002\0003\0004\0005\0006\0007\0008\0009\0:\0;\0<\0=\0>\0?\0@\0"
                                    "A\0B\0C\0D\0E\0F\0G\0H\0I\0J\0K\0L\0M\0N\0O\0P\0Q\0R\0S\0T\0U\0V\0W\0X\0Y\0Z\0"
                                    "[\0\\\0]\0^\0_\0`\0";

const char *key_name(int key)
{
    if (key == KEY_SPACE) return "Space";
    if (key >= '!' && key <= '`') return &printed_names[(key - '!') * 2];
    if (key >= KEY_ESCAPE && key < KEY_COUNT) return special_names[key - KEY_ESCAPE];
    return NULL;
}

int key_from_name(const char *name)
{
    if (strcmp(name, "Space") == 0) return KEY_SPACE;
    for (int key = '!'; key < KEY_COUNT; key++) {
        const char *own = key_name(key);
        if (own && strcmp(own, name) == 0) return key;
    }
    return KEY_NONE;
}
