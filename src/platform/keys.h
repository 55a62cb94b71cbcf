/// From GLFW's keys to ours. Private to platform/.
#ifndef PLATFORM_KEYS_H
#define PLATFORM_KEYS_H

/// The key by what is printed on it for letters and punctuation, by its place for digits, arrows and the rest, and for
/// letters where the layout has no Latin ones; KEY_NONE for keys that mean nothing to the program.
int key_translate(int glfw_key, int scancode);

/// GLFW's modifier bits as ours.
unsigned mods_translate(int glfw_mods);

#endif
