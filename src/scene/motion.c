/// Has the motions that equilibria follow read for every sample.
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
                       const struct model_source *source)
{
    const int model = document_find_model(document, motion->model, motion->by_file);
    const int chain = motion->chain ? document_find_chain(document, motion->chain) : -1;
    uint64_t hash = hash_text(HASH_START, motion->joint);
    hash = hash_word(hash_number(hash, document->fps), (uint64_t)document->substeps);
    hash = hash_word(hash_word(hash, (uint64_t)document->first_frame), (uint64_t)document->last_frame);
    hash = hash_word(hash, (uint64_t)motion->of);
    hash = hash_word(hash_word(hash, source->follow ? 1 : 0), source->version);
    if (model >= 0) hash = hash_model(hash, &document->rigs[model]->model);
    if (chain >= 0) hash = hash_chain(hash, &document->rigs[chain]->chain);
    return hash | 1;
}

static void read(struct baked *baked, const struct document *document, const struct joint_motion *motion,
                 const struct model_source *source)
{
    const int count = document_samples(document);
    bool good = source->follow && source->follow(source->context, document, motion, baked->raw);
    for (int i = 0; good && i < count; i++) good = isfinite(baked->raw[i]);
    for (int i = 0; !good && i < count; i++) baked->raw[i] = 0;
}

void motions_bake(struct evaluation *evaluation, const struct document *document)
{
    const int count = evaluation->samples;
    for (int s = 0; s < document->spline_count; s++) {
        const struct param *param = &document->splines[s]->parameter[PARAMETER_EQUILIBRIUM];
        struct baked *baked = &evaluation->storage->state[s].baked;
        if (!param->motion) continue;
        const uint64_t key = key_of(document, param->motion, &evaluation->models);
        if (key == baked->key && param->gain == baked->gain) continue;
        if (!baked->raw) {
            baked->raw = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->raw);
            baked->samples = pool_take(&evaluation->storage->pool, (size_t)count, sizeof *baked->samples);
        }
        if (key != baked->key) read(baked, document, param->motion, &evaluation->models);
        for (int i = 0; i < count; i++) baked->samples[i] = param->gain * baked->raw[i];
        baked->key = key;
        baked->gain = param->gain;
        baked->is_new = true;
    }
}
