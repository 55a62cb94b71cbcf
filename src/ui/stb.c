/// The implementation of stb_truetype, in a file of its own: it does not pass our warnings.
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#define STB_TRUETYPE_IMPLEMENTATION
#include <stb/stb_truetype.h>
