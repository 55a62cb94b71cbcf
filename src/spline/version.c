/// The version that a program runs with, which may be a later one than it was compiled with.
#include <wiggly/wiggly.h>

const char *wiggly_version(void) { return WIGGLY_VERSION; }
