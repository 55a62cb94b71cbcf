/// From GLFW's keys to ours. Private to platform/.
#ifndef PLATFORM_KEYS_H
#define PLATFORM_KEYS_H

/// Letters and punctuation go by what is printed on the key; digits, arrows and the rest go by place, as do letters if the
/// layout has no Latin ones. KEY_NONE for keys without a meaning here.
int key_translate(int glfw_key, int scancode);

/// GLFW's modifier bits as ours.
unsigned mods_translate(int glfw_mods);

#endif
