/// Chains on the stage: their character shows them.
#include "editor/stage/rigs.h"

static void pose(struct stage *stage, const struct core *core, const struct editor_world *world, int rig, int n)
{
    (void)stage, (void)core, (void)world, (void)rig, (void)n;
}

static bool bounds(const struct stage *stage, const struct core *core, const struct editor_world *world, int rig,
                   int n, float lo[3], float hi[3])
{
    (void)stage, (void)core, (void)world, (void)rig, (void)n, (void)lo, (void)hi;
    return false;
}

static uint64_t hash(uint64_t sum, const struct stage_view *view)
{
    (void)view;
    return sum;
}

const struct stage_kind stage_chains = {pose, bounds, hash};
