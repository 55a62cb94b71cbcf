/// Functions of libraries that GLFW may have loaded: looking them up saves the program dependencies of its own. Private to
/// platform/.
#ifndef PLATFORM_SYMBOL_H
#define PLATFORM_SYMBOL_H

#include <dlfcn.h>
#include <stdbool.h>
#include <string.h>

/// Puts the symbol's address into a pointer; false if nothing of that name is loaded.
static inline bool symbol_find(const char *name, void *pointer)
{
    void *symbol = dlsym(RTLD_DEFAULT, name);
    if (symbol) memcpy(pointer, &symbol, sizeof symbol);
    return symbol != NULL;
}

#endif
