/// Hashes what moves the points of rigs.
#include "scene/rig_key.h"
#include "base/hash.h"
#include "scene/text.h"

static uint64_t add_text(uint64_t hash, const char *text)
{
    return hash_bytes(hash, text ? text : "", text_size(text));
}

static uint64_t add_number(uint64_t hash, double number) { return hash_bytes(hash, &number, sizeof number); }

static uint64_t add_angles(uint64_t hash, const struct angles *angles)
{
    const int numbers = angles_count(angles) * (angles->form == ANGLES_RAMP ? 2 : 1);
    hash = hash_word(hash, (uint64_t)angles->form);
    return hash_bytes(hash, angles->value, (size_t)numbers * sizeof *angles->value);
}

static uint64_t add_channels(uint64_t hash, const struct rig *rig)
{
    int count;
    const struct channel *channels = rig_channels(rig, &count);
    for (int c = 0; c < count; c++) {
        const struct channel *channel = &channels[c];
        hash = hash_word(hash_word(hash, (uint64_t)channel->spline), (uint64_t)channel->axis << 8 | channel->of);
        hash = add_angles(add_angles(hash, &channel->lag), &channel->gain);
    }
    return hash;
}

static uint64_t add_tail(uint64_t hash, const struct tail *tail)
{
    hash = add_number(hash_word(hash, (uint64_t)tail->joints), tail->length);
    for (int k = 0; k < 3; k++)
        hash = add_number(hash_word(hash, (uint64_t)tail->position[k].track), tail->position[k].value);
    return add_angles(hash, &tail->rest);
}

static uint64_t add_character(uint64_t hash, const struct character_rig *character)
{
    hash = hash_bytes(add_text(hash, character->model), character->position, sizeof character->position);
    if (character->has_floor) hash = add_number(hash, character->floor);
    hash = hash_word(hash, character->painted ? character->painted->version : 0);
    for (int k = 0; k < character->drive_count; k++) {
        const struct drive *drive = &character->drives[k];
        hash = hash_word(add_text(hash, drive->name), (uint64_t)drive->spline);
        hash = add_number(add_number(hash, drive->amplitude), drive->lag);
    }
    return hash;
}

static uint64_t add_model(uint64_t hash, const struct model_rig *model)
{
    hash = hash_bytes(add_text(add_text(hash, model->model), model->clip), model->position, sizeof model->position);
    return add_number(add_number(hash, model->scale), model->turn);
}

static uint64_t add_chain(uint64_t hash, const struct chain *chain)
{
    hash = add_text(add_text(add_text(hash, chain->model), chain->from), chain->to);
    return hash_word(add_number(hash, chain->turn), chain->mirror);
}

uint64_t rigs_key(const struct document *document)
{
    uint64_t hash = hash_word(HASH_START, (uint64_t)document->substeps);
    hash = hash_word(add_number(hash, document->fps), (uint64_t)document->first_frame);
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        hash = add_text(hash_word(hash, (uint64_t)rig->kind), rig->name);
        if (rig->kind == RIG_TAIL) hash = add_tail(hash, &rig->tail);
        if (rig->kind == RIG_CHARACTER) hash = add_character(hash, &rig->character);
        if (rig->kind == RIG_MODEL) hash = add_model(hash, &rig->model);
        if (rig->kind == RIG_CHAIN) hash = add_chain(hash, &rig->chain);
        hash = add_channels(hash, rig);
    }
    return hash | 1;
}

uint64_t pins_key(const struct document *document)
{
    uint64_t hash = HASH_START;
    for (int r = 0; r < document->rig_count; r++) {
        const struct rig *rig = document->rigs[r];
        hash = hash_word(hash, (uint64_t)rig->pin_count);
        for (int i = 0; i < rig->pin_count; i++) {
            const struct pin *pin = &rig->pins[i];
            hash = hash_word(add_number(hash, pin->frame), (uint64_t)pin->point);
            hash = hash_bytes(hash, pin->to, sizeof pin->to);
        }
    }
    return hash | 1;
}
