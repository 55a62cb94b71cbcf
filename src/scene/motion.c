/// Has the motions that equilibria follow read for every sample.
#include "scene/motion.h"
#include "base/hash.h"
#include "scene/storage.h"
#include "scene/text.h"
#include <math.h>
#include <string.h>

static uint64_t hash_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text ? text : "", text_size(text));
}

static uint64_t hash_number(uint64_t hash, double number) { return hash_bytes(hash, &number, sizeof number); }

static uint64_t hash_model(uint64_t hash, const struct model_rig *model)
{
    hash = hash_text(hash_text(hash, model->model), model->clip);
    return hash_number(hash_number(hash, model->scale), model->turn);
}

static uint64_t hash_chain(uint64_t hash, const struct chain *chain)
{
    hash = hash_text(hash_text(hash_text(hash, chain->model), chain->from), chain->to);
    return hash_word(hash_number(hash, chain->turn), chain->mirror);
}

/// Of all that the samples depend on; never 0.
static uint64_t key_of(const struct document *document, const struct joint_motion *motion,
                       const struct motion_source *source)
{
    const int model = document_find_model(document, motion->model, motion->by_file);
    const int chain = motion->chain ? document_find_chain(document, motion->chain) : -1;
    uint64_t hash = hash_text(HASH_START, motion->joint);
    hash = hash_word(hash_number(hash, document->fps), (uint64_t)document->substeps);
    hash = hash_word(hash_word(hash, (uint64_t)document->first_frame), (uint64_t)document->last_frame);
    hash = hash_word(hash, (uint64_t)motion->of);
    hash = hash_word(hash_word(hash, source->read ? 1 : 0), source->version);
    if (model >= 0) hash = hash_model(hash, &document->rigs[model]->model);
    if (chain >= 0) hash = hash_chain(hash, &document->rigs[chain]->chain);
    return hash | 1;
}

static void read(struct baked *baked, const struct document *document, const struct joint_motion *motion,
                 const struct motion_source *source)
{
    const int count = document_samples(document);
    bool good = source->read && source->read(source->context, document, motion, baked->raw);
    for (int i = 0; good && i < count; i++) good = isfinite(baked->raw[i]);
    for (int i = 0; !good && i < count; i++) baked->raw[i] = 0;
}

bool motions_bake(struct evaluation *evaluation, const struct document *document, const struct motion_source *source)
{
    struct storage *storage = evaluation->storage;
    const int count = document_samples(document);
    bool any = false;
    for (int s = 0; s < document->spline_count; s++) {
        const struct param *param = &document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        struct baked *baked = &storage->state[s].baked;
        if (!param->motion || baked->capacity < count) continue;
        const uint64_t key = key_of(document, param->motion, source);
        if (key == baked->key && param->gain == baked->gain) continue;
        if (key != baked->key) read(baked, document, param->motion, source);
        for (int i = 0; i < count; i++) baked->samples[i] = param->gain * baked->raw[i];
        baked->key = key;
        baked->gain = param->gain;
        baked->is_new = any = true;
    }
    return any;
}

void motions_copy(struct evaluation *evaluation, const struct evaluation *from)
{
    if (evaluation->count != from->count || evaluation->samples != from->samples) return;
    const size_t size = (size_t)from->samples * sizeof(double);
    for (int s = 0; s < from->count; s++) {
        struct baked *to = &evaluation->storage->state[s].baked;
        const struct baked *old = &from->storage->state[s].baked;
        if (to->capacity < from->samples || old->capacity < from->samples || old->key == 0) continue;
        memcpy(to->raw, old->raw, size);
        memcpy(to->samples, old->samples, size);
        to->key = old->key;
        to->gain = old->gain;
    }
}

const double *motions_samples(const struct evaluation *evaluation, int spline)
{
    const struct baked *baked = &evaluation->storage->state[spline].baked;
    return baked->key != 0 ? baked->samples : NULL;
}
