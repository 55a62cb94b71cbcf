/// Poses a character's surface on the CPU, which the picture leaves to the GPU, and points at it.
#include "editor/stage/skin.h"
#include "base/hash.h"
#include "rig/pick.h"
#include <stdlib.h>

void skin_free(struct skin *skin)
{
    free(skin->posed);
    *skin = (struct skin){0};
}

void skin_reserve(struct stage *stage)
{
    struct skin *skin = &stage->skin;
    int most = 0;
    for (int c = 0; c < stage->view.character_count; c++) {
        const int count = stage->view.characters[c].figure->character.vertex_count;
        most = count > most ? count : most;
    }
    if (most <= skin->capacity) return;
    skin_free(skin);
    skin->posed = malloc((size_t)most * sizeof *skin->posed);
    skin->capacity = skin->posed ? most : 0;
}

bool skin_pose(struct stage *stage, int character)
{
    const struct stage_view *view = &stage->view;
    struct skin *skin = &stage->skin;
    for (int c = 0; c < view->character_count; c++) {
        const struct stage_character *shown = &view->characters[c];
        if (shown->rig != character || shown->is_twin) continue;
        if (shown->figure->character.vertex_count > skin->capacity) return false;
        const uint64_t hash = hash_word(hash_word(view->hash, shown->figure->id), (uint64_t)character);
        if (skin->hash != hash) morph_places(shown->figure, &shown->morph, shown->position, skin->posed);
        skin->hash = hash;
        return true;
    }
    return false;
}

bool skin_spot(const struct stage *stage, const struct figure *figure, float x, float y, struct surface_spot *spot)
{
    const struct stage_view *view = &stage->view;
    const float viewport[4] = {view->viewport.x, view->viewport.y, view->viewport.w, view->viewport.h};
    float direction[3];
    camera_ray(view->view, view->projection, viewport, (const float[2]){x, y}, direction);
    return pick_ray(figure, (const float(*)[3])stage->skin.posed, view->eye, direction, spot);
}
