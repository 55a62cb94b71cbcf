/// The names of keys.
#include "ui/event.h"
#include <stddef.h>
#include <string.h>

static const char *const special_names[KEY_COUNT - KEY_ESCAPE] = {
    [KEY_ESCAPE - KEY_ESCAPE] = "Escape",  [KEY_ENTER - KEY_ESCAPE] = "Enter",
    [KEY_TAB - KEY_ESCAPE] = "Tab",        [KEY_BACKSPACE - KEY_ESCAPE] = "Backspace",
    [KEY_INSERT - KEY_ESCAPE] = "Insert",  [KEY_DELETE - KEY_ESCAPE] = "Delete",
    [KEY_LEFT - KEY_ESCAPE] = "Left",      [KEY_RIGHT - KEY_ESCAPE] = "Right",
    [KEY_UP - KEY_ESCAPE] = "Up",          [KEY_DOWN - KEY_ESCAPE] = "Down",
    [KEY_PAGE_UP - KEY_ESCAPE] = "PageUp", [KEY_PAGE_DOWN - KEY_ESCAPE] = "PageDown",
    [KEY_HOME - KEY_ESCAPE] = "Home",      [KEY_END - KEY_ESCAPE] = "End",
    [KEY_F1 - KEY_ESCAPE] = "F1",          [KEY_F2 - KEY_ESCAPE] = "F2",
    [KEY_F3 - KEY_ESCAPE] = "F3",          [KEY_F4 - KEY_ESCAPE] = "F4",
    [KEY_F5 - KEY_ESCAPE] = "F5",          [KEY_F6 - KEY_ESCAPE] = "F6",
    [KEY_F7 - KEY_ESCAPE] = "F7",          [KEY_F8 - KEY_ESCAPE] = "F8",
    [KEY_F9 - KEY_ESCAPE] = "F9",          [KEY_F10 - KEY_ESCAPE] = "F10",
    [KEY_F11 - KEY_ESCAPE] = "F11",        [KEY_F12 - KEY_ESCAPE] = "F12",
};

/// The names of keys whose name is their character: upper-case letters, digits, punctuation.
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
    if (name[0] >= '!' && name[0] <= '`' && name[1] == '\0') return name[0];
    if (strcmp(name, "Space") == 0) return KEY_SPACE;
    for (int key = KEY_ESCAPE; key < KEY_COUNT; key++) {
        if (strcmp(special_names[key - KEY_ESCAPE], name) == 0) return key;
    }
    return KEY_NONE;
}
