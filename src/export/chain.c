/// A chain as a form: its channels. The character that it moves is exported as a whole (model.c).
#include "export/form.h"

static void columns(const struct take *take, int rig, const struct rig_pose *pose, double key, form_column *column,
                    void *user)
{
    const struct chain *chain = &take->posing->document->rigs[rig].chain;
    form_channels(take, rig, chain->channels, chain->channel_count, pose->chain.count - 1, key, column, user);
}

const struct form_kind chain_form = {.columns = columns};
