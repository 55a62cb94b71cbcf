/// The graphics driver's messages (--gl-debug). Private to platform/.
#ifndef PLATFORM_GL_DEBUG_H
#define PLATFORM_GL_DEBUG_H

#include "base/error.h"

/// Whether platform_debug_gl() was called: contexts are then made for debugging.
bool gl_debug_wanted(void);

/// If wanted, listens to the current context. false if its driver has no debug output.
bool gl_debug_start(struct error *error);

#endif
