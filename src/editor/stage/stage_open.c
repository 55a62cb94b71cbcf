/// The stage's beginning and end.
#include "editor/stage/brush.h"
#include "editor/stage/stage.h"
#include "editor/stage/state.h"
#include <stdlib.h>
#include <string.h>

struct stage *stage_create(void)
{
    struct stage *stage = calloc(1, sizeof *stage);
    if (stage) stage->camera = camera_default();
    return stage;
}

void stage_destroy(struct stage *stage)
{
    if (!stage) return;
    brush_free(&stage->painting);
    free(stage);
}

void stage_open(struct stage *stage) { memset(stage->follow, 0, sizeof stage->follow); }

const struct stage_view *stage_seen(const struct stage *stage) { return &stage->view; }
