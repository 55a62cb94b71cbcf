/// A take: the scene as it was kept (Shift+K), to compare with (hold K).
#include "editor/core/core.h"
#include <string.h>

void take_keep(struct core *core, int keep)
{
    struct take *take = &core->take;
    evaluation_free(&take->evaluation);
    document_destroy(take->document);
    *take = (struct take){.look = core->look};
    core_message(core, false, keep ? "Kept as before. Hold K to see it." : "Before is forgotten.");
    if (!keep) return;
    take->document = document_copy(core->document);
    if (core->evaluation) take->evaluation.solver = core->evaluation->solver;
    if (core->evaluation) take->evaluation.models = core->evaluation->models;
    evaluation_update(&take->evaluation, take->document, core->look == LOOK_CUBIC);
}

bool take_is_shown(const struct core *core)
{
    return core->take.document && core->held_key == 'K' && !core->drag.owner && !history_is_open(core->history);
}

/// Whether a rig is posed as before: its bones are the same ones.
static bool is_same(const struct rig *now, const struct rig *before)
{
    if (now->id != before->id || now->kind != before->kind) return false;
    if (now->kind == RIG_CHARACTER) return strcmp(now->character.model, before->character.model) == 0;
    return now->kind != RIG_TAIL || now->tail.joints == before->tail.joints;
}

bool take_is_posed(const struct core *core)
{
    const struct document *now = core->document, *before = core->take.document;
    if (!take_is_shown(core) || now->rig_count != before->rig_count) return false;
    if (now->first_frame != before->first_frame || now->substeps != before->substeps) return false;
    int r = 0;
    while (r < now->rig_count && is_same(now->rigs[r], before->rigs[r])) r++;
    return r == now->rig_count && (!core->models || models_suit(core->models, before));
}

int take_spline(const struct core *core, int spline)
{
    const struct take *take = &core->take;
    return take->document ? document_find_spline_id(take->document, core->document->splines[spline]->id) : -1;
}

const struct rig *take_rig(const struct core *core, int rig)
{
    const struct document *before = core->take.document;
    for (int r = 0; before && r < before->rig_count; r++) {
        if (is_same(core->document->rigs[rig], before->rigs[r])) return before->rigs[r];
    }
    return NULL;
}

void take_explain(struct core *core)
{
    if (!core->take.document) {
        core_message(core, false, "Nothing is kept yet: Shift+K keeps the scene as before.");
    } else if (take_is_shown(core) && !take_is_posed(core)) {
        core_message(core, false, "Only the curves show before: the rigs or frames have changed since.");
    }
}
