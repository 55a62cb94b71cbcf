/// The editor's internals, for tests of state that is not visible.
#ifndef TESTS_INSIDE_H
#define TESTS_INSIDE_H

#include "editor/core/core.h"
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/curves/state.h"
#include "editor/dialogs/dialogs.h"
#include "editor/dialogs/state.h"
#include "editor/editor.h"
#include "editor/inspector/inspector.h"
#include "editor/inspector/state.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include "editor/transport/transport.h"

#endif
