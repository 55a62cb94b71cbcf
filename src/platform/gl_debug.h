/// What the graphics driver has to say (--gl-debug). Private to platform/.
#ifndef PLATFORM_GL_DEBUG_H
#define PLATFORM_GL_DEBUG_H

#include "base/error.h"

/// Whether platform_debug_gl() was called: contexts are then made for debugging.
bool gl_debug_wanted(void);

/// Where that is wanted, listens to the current context. false where its driver has nothing to say.
bool gl_debug_start(struct error *error);

#endif
