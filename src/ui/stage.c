/// What is to be seen on the stage: telling whether it changed.
#include "ui/stage.h"
#include "base/hash.h"

uint64_t stage_scenery_hash(const struct stage_view *view)
{
    uint64_t hash = hash_bytes(HASH_START, &view->viewport, sizeof view->viewport);
    hash = hash_bytes(hash, view->view, sizeof view->view);
    hash = hash_bytes(hash, view->projection, sizeof view->projection);
    hash = hash_bytes(hash, view->middle, sizeof view->middle);
    hash = hash_bytes(hash, view->key_from, sizeof view->key_from);
    return hash_bytes(hash, &view->colors, sizeof view->colors);
}
