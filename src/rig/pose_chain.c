/// Poses a chain: the bones of an imported character that it bends.
#include "model/vector.h"
#include "rig/chain_bones.h"
#include "rig/posing_kind.h"

static bool pose(const struct posing *posing, int rig, double position, const wiggly_value *values,
                 const struct by_hand *by_hand, struct rig_pose *posed)
{
    const struct chain *chain = &posing->document->rigs[rig]->chain;
    const int model = document_find_model(posing->document, chain->model, chain->by_file);
    struct chain_bones bones;
    struct rig_pose whole;
    (void)values;
    if (model < 0 || !posing_model(posing, model, position, rig, by_hand, &whole)) return false;
    if (!chain_find(&whole.model.imported->gltf, chain->from, chain->to, &bones, NULL)) return false;
    posed->chain.imported = whole.model.imported;
    posed->chain.pose = whole.model.pose;
    chain_points(whole.model.imported, &bones, whole.model.pose, whole.model.root, &posed->chain);
    return true;
}

static void bounds(const struct rig_pose *posed, float lo[3], float hi[3])
{
    const struct chain_pose *chain = &posed->chain;
    vec3s low = vec3_from(chain->point[0]), high = low;
    for (int n = 1; n < chain->count; n++) {
        low = glms_vec3_minv(low, vec3_from(chain->point[n]));
        high = glms_vec3_maxv(high, vec3_from(chain->point[n]));
    }
    memcpy(lo, low.raw, sizeof low.raw);
    memcpy(hi, high.raw, sizeof high.raw);
}

const struct posing_functions chain_posing = {pose, bounds};
