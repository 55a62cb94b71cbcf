/// Chains on the stage: their character shows them; here they are what can be held.
#include "editor/core/bones.h"
#include "editor/stage/bones.h"
#include "editor/stage/rigs.h"
#include "editor/stage/strand.h"

/// The points of a chain of a character that is shown.
static void add_strand(struct stage *stage, const struct editor_world *world, int rig, int model,
                       const struct chain_bones *bones)
{
    const struct stage_view *view = &stage->view;
    const int number = document_rig_number(world->document, model);
    const struct gltf_pose *pose = models_pose(world->models, number, true);
    for (int m = 0; m < view->model_count; m++) {
        if (view->models[m].pose != pose) continue;
        struct rig_pose posed = {.kind = RIG_CHAIN};
        chain_points(models_imported(world->models, number), bones, pose, view->models[m].root, &posed.chain);
        strand_add(stage, rig, &posed);
    }
}

static void pose(struct stage *stage, const struct core *core, const struct editor_world *world, int rig, int n)
{
    const struct chain *chain = &world->document->rigs[rig].chain;
    const int model = document_find_model(world->document, chain->model, chain->by_file);
    const struct imported *shown = model >= 0 ? bones_character(world, model) : NULL;
    struct chain_bones bones;
    (void)n;
    if (!shown || !chain_find(&shown->gltf, chain->from, chain->to, &bones, NULL)) return;
    bones_mark(stage, core, world->document, rig, model, &bones);
    add_strand(stage, world, rig, model, &bones);
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
