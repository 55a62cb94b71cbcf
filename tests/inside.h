/// The editor's internals, for tests of state that is not visible.
#ifndef TESTS_INSIDE_H
#define TESTS_INSIDE_H

#include "near.h"

#include "editor/core/core.h"
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

/// No two widgets have had one id.
static inline void assert_ids(const struct editor *editor)
{
    const struct ui *uis[] = {&editor->inspector->ui, &editor->dialogs->dialog.ui};
    for (int i = 0; i < 2; i++) {
        const struct ui_stop *twice = &uis[i]->twice;
        if (twice->id)
            fail_msg("the widget at %g, %g has another one's id", (double)twice->rect.x, (double)twice->rect.y);
    }
}

#endif
