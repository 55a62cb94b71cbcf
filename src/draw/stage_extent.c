/// Finds the screen area of moving rigs.
#include "base/hash.h"
#include "draw/stage.h"
#include <math.h>

/// A growing box in normalised device coordinates.
struct extent {
    mat4s clip_from_world;
    float lo[2], hi[2];
    bool is_everywhere; ///< something is too close to the camera to project
};

float stage_lowest_ground(const struct stage_view *view)
{
    float lowest = INFINITY;
    for (int c = 0; c < view->character_count; c++) lowest = fminf(lowest, view->characters[c].position[1]);
    for (int m = 0; m < view->model_count; m++) lowest = fminf(lowest, view->models[m].ground);
    return lowest < INFINITY ? lowest : 0.0f;
}

uint64_t stage_backdrop_hash(const struct stage_view *view)
{
    const float ground = stage_lowest_ground(view);
    return hash_bytes(stage_scenery_hash(view), &ground, sizeof ground);
}

static void add_point(struct extent *extent, const float world[3])
{
    static const float nearest = 1.0e-3f; ///< metres
    const vec4s point = {{world[0], world[1], world[2], 1.0f}};
    const vec4s clip = glms_mat4_mulv(extent->clip_from_world, point);
    if (!(clip.w > nearest)) {
        extent->is_everywhere = true;
        return;
    }
    for (int k = 0; k < 2; k++) {
        extent->lo[k] = fminf(extent->lo[k], clip.raw[k] / clip.w);
        extent->hi[k] = fmaxf(extent->hi[k], clip.raw[k] / clip.w);
    }
}

static void add_box(struct extent *extent, const float lo[3], const float hi[3])
{
    for (int corner = 0; corner < 8; corner++) {
        const float world[3] = {corner & 1 ? hi[0] : lo[0], corner & 2 ? hi[1] : lo[1], corner & 4 ? hi[2] : lo[2]};
        add_point(extent, world);
    }
}

static void add_blob(struct extent *extent, const struct shadow_blob *blob, float ground)
{
    const float lo[3] = {blob->x - blob->radius, ground, blob->z - blob->radius};
    const float hi[3] = {blob->x + blob->radius, ground, blob->z + blob->radius};
    add_box(extent, lo, hi);
}

/// The box at rest, grown by the amplitudes.
static void add_character(struct extent *extent, const struct stage_character *shown)
{
    const struct figure *figure = shown->figure;
    float lo[3], hi[3];
    for (int k = 0; k < 3; k++) {
        float reach = 0.0f;
        for (int d = 0; d < shown->morph.count; d++) {
            const float *weight = shown->morph.weight[d];
            reach += hypotf(weight[0], weight[1]) * figure->largest[shown->morph.coordinate[d]][k];
        }
        const float place = shown->position[k] - (k == 1 ? figure->lo[1] : 0.0f);
        lo[k] = place + figure->lo[k] - reach;
        hi[k] = place + figure->hi[k] + reach;
    }
    add_box(extent, lo, hi);
}

struct area stage_extent(const struct stage_view *view, struct area viewport, int margin)
{
    struct extent extent = {
        .clip_from_world = stage_clip_from_world(view), .lo = {INFINITY, INFINITY}, .hi = {-INFINITY, -INFINITY}};
    const float ground = stage_lowest_ground(view);
    for (int c = 0; c < view->character_count; c++) add_character(&extent, &view->characters[c]);
    for (int m = 0; m < view->model_count; m++) add_box(&extent, view->models[m].lo, view->models[m].hi);
    for (int b = 0; b < view->blob_count; b++) add_blob(&extent, &view->blobs[b], ground);
    if (extent.is_everywhere) return viewport;
    if (!(extent.lo[0] <= extent.hi[0])) return (struct area){0};
    const float w = 0.5f * (float)(viewport.x1 - viewport.x0), h = 0.5f * (float)(viewport.y1 - viewport.y0);
    const struct area area = {
        viewport.x0 + area_whole(floorf((1.0f + extent.lo[0]) * w)) - margin,
        viewport.y0 + area_whole(floorf((1.0f - extent.hi[1]) * h)) - margin,
        viewport.x0 + area_whole(ceilf((1.0f + extent.hi[0]) * w)) + margin,
        viewport.y0 + area_whole(ceilf((1.0f - extent.lo[1]) * h)) + margin,
    };
    return area_intersect(area, viewport);
}
