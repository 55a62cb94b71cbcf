/* Only what the headers declare leaves the library; everything else is compiled with -fvisibility=hidden. */
#pragma GCC visibility push(default)
#include <wiggly/more.h>
#pragma GCC visibility pop
