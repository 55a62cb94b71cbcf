/// The curves panel's beginning and end, and what it hears of core.
#include "editor/core/selection.h"
#include "editor/curves/curves.h"
#include "editor/curves/state.h"
#include <stdlib.h>

struct curves *curves_create(void)
{
    struct curves *curves = calloc(1, sizeof *curves);
    if (curves) curves->view = (struct view){0, 120, -1, 1};
    return curves;
}

void curves_destroy(struct curves *curves)
{
    if (!curves) return;
    free(curves->before_box.bits);
    free(curves);
}

void curves_open(struct curves *curves)
{
    curves->cache.key = 0;
    curves->cache.range_count = 0;
    curves->warnings = (struct warnings){0};
}

bool curves_reserve(struct curves *curves, const struct core *core)
{
    unsigned ids = core->selection.capacity;
    return curves->before_box.capacity >= ids || selection_reserve(&curves->before_box, ids);
}

void curves_forget(struct curves *curves)
{
    curves->cache.key = 0;
    curves->cache.other_count = curves->cache.count = 0;
}

bool curves_wants_frames(const struct curves *curves) { return curves->warnings.search.running; }

const char *curves_hint(const struct curves *curves, const struct core *core)
{
    return core->drag.kind == DRAG_SCALE ? curves->scaling.sentence : NULL;
}
