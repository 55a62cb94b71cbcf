/// The stage panel: mouse, time, each frame's poses and overlays, and the texts on them.
#include "editor/stage/stage.h"
#include "base/hash.h"
#include "base/need.h"
#include "editor/core/core.h"
#include "editor/stage/state.h"
#include "maths/maths.h"
#include "ui/font.h"
#include "ui/theme.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { BELOW = 14, HEIGHT = 20, PAD = 6, DOT = 8 }; ///< pixels; BELOW: from the feet to the name

static const float FEET = -0.5f; ///< z of the paws from the tail's root, metres, bind size

void stage_scrim(struct core *core, struct rect box)
{
    drawlist_rounded(&core->list, box, fminf(6, box.h / 4), theme_fade(theme()->panel, 0.9f));
}

void stage_note(struct core *core, float x, float y, enum font font, uint32_t color, const char *text)
{
    stage_scrim(core, (struct rect){x - 4, y - 12, font_width(font, THEME_TEXT_SMALL, text) + 8, 16});
    drawlist_text(&core->list, x, y, font, THEME_TEXT_SMALL, color, text);
}

enum { MARGIN = 16, CAPTION_AROUND = 8, TOP = 10, WIDEST = 960, LINE = 18, MAX_LINES = 4, MAX_TITLE = 256 };

/// A description in lines: the title up to the first full stop, then the rest.
struct caption {
    char line[MAX_LINES][MAX_TITLE + 1];
    int count;
    float width; ///< of the widest line
};

static struct caption caption_of(struct rect place, const struct document *document)
{
    struct caption caption = {.count = 1};
    const float room = fminf(WIDEST, place.w - 2 * MARGIN);
    const char *stop = strstr(document->about, ". "), *rest = stop ? stop + 2 : "";
    const size_t length = stop ? (size_t)(stop - document->about) : strlen(document->about);
    snprintf(caption.line[0], sizeof caption.line[0], "%.*s", (int)length, document->about);
    caption.width = fminf(font_width(FONT_LABEL_BOLD, THEME_TEXT_NORMAL, caption.line[0]), room);
    while (caption.count < MAX_LINES && *rest) {
        char *line = caption.line[caption.count++];
        const char *from = rest;
        const size_t taken = font_take_line(THEME_TEXT_NORMAL, room, &rest);
        snprintf(line, sizeof caption.line[0], "%.*s", (int)taken, from);
        caption.width = fmaxf(caption.width, font_width(FONT_LABEL, THEME_TEXT_NORMAL, line));
    }
    return caption;
}

float caption_height(struct rect place, const struct document *document)
{
    return document->about ? (float)(MARGIN + LINE * caption_of(place, document).count) : 0;
}

void stage_show_caption(struct core *core, float bottom)
{
    const struct rect place = core->view.layout.stage;
    const float x = place.x + MARGIN, y = place.y + MARGIN + TOP;
    if (!core->document->about || y >= bottom) return;
    const struct caption caption = caption_of(place, core->document);
    const int count = (int)fminf((float)caption.count, ceilf((bottom - y) / LINE));
    const struct rect box = {x - CAPTION_AROUND, y - TOP - CAPTION_AROUND, caption.width + 2 * CAPTION_AROUND,
                             LINE * (float)count + CAPTION_AROUND};
    struct rect clip = drawlist_push_clip(&core->list, place);
    stage_scrim(core, box);
    drawlist_text_fit(&core->list, x, y, caption.width, FONT_LABEL_BOLD, THEME_TEXT_NORMAL, theme()->text,
                      caption.line[0]);
    for (int i = 1; i < count; i++)
        drawlist_text(&core->list, x, y + LINE * (float)i, FONT_LABEL, THEME_TEXT_NORMAL, theme()->text_dim,
                      caption.line[i]);
    drawlist_set_clip(&core->list, clip);
}

struct stage *stage_create(const struct core *core)
{
    struct stage *stage = need_zeroed(1, sizeof *stage);
    stage->core = core;
    return stage;
}

void stage_destroy(struct stage *stage)
{
    pool_free(&stage->painting.work.pool);
    free(stage->skin.posed);
    free(stage);
}

void stage_open(struct stage *stage)
{
    memset(stage->inertia, 0, sizeof stage->inertia);
    stage->strand_count = stage->tail_count = stage->bone_count = 0;
}

const struct stage_view *stage_seen(const struct stage *stage) { return &stage->view; }

static const float TURN_STEP = 0.08f; ///< per notch sideways, radians
static const double ZOOM_STEP = 0.12; ///< per wheel notch, as a power of e

struct hover stage_hover(struct stage *stage, const struct core *core, float x, float y)
{
    const struct hover bone = bone_hover(stage, core, x, y);
    struct hover found = {.thing = NULL};
    float nearest = STRAND_REACH;
    for (int s = 0; s < stage->tail_count; s++) { // chains are found by their bones
        const struct shown_strand *tail = &stage->strands[s];
        strand_nearer(stage, tail->rig, &tail->pose, (const float[2]){x, y}, &nearest, &found);
    }
    // An edit in the same frame may have removed it.
    if (!tail_drag_holds(core->document, found.rig, found.joint)) found.thing = NULL;
    if (bone.thing && (!found.thing || maths_hypotf(bone.x - x, bone.y - y) < maths_hypotf(found.x - x, found.y - y)))
        found = bone;
    const bool holds = !core->focus.brush.on && core->focus.pick.use == BONE_SELECTED;
    if (holds && core->input.mods & MOD_CTRL && is_strand(&found)) found = strand_end(stage, &found);
    if (holds && !found.thing) found = floors_hover(stage, x, y);
    if (!found.thing) found = body_hover(stage, core->view.playback.position, x, y);
    const struct hover pin = holds ? pins_hover(stage, core, &found, x, y) : found;
    return pin.thing ? pin : found;
}

static bool is_on_rig(const struct hover *hover)
{
    return is_strand(hover) || hover->thing == &thing_body || hover->thing == &thing_point;
}

void stage_click(void *room, struct core *core, bool keep)
{
    const struct stage *stage = room;
    const bool menu = core->input.drag.button == BUTTON_RIGHT && is_on_rig(&stage->pressed);
    if (core->input.drag.moved || (core->input.drag.button != BUTTON_LEFT && !menu) || !keep) return;
    const struct hover *pressed = &stage->pressed;
    const struct document *document = core->document;
    const bool shows = is_on_rig(pressed) && core->focus.pick.use == BONE_SELECTED;
    const bool is_there = pressed->model < document->rig_count && document->rigs[pressed->model]->kind == RIG_MODEL;
    if ((pressed->thing == &thing_bone || pressed->thing == &thing_chain) && is_there) {
        bones_clicked(core, pressed->model, pressed->node);
    } else if (core->focus.pick.use == BONE_SELECTED) {
        core->focus.bone.any = false;
    }
    if (shows) core->show_clicked(core->inspector, pressed->rig);
}

static const float ORBIT_SPEED = 0.008f; ///< radians per pixel

static void orbit_stage(void *room, struct core *core)
{
    (void)room;
    camera_orbit(&core->view.camera, -(float)core->input.drag.moved_x * ORBIT_SPEED,
                 (float)core->input.drag.moved_y * ORBIT_SPEED);
}

static void pan_stage(void *room, struct core *core)
{
    (void)room;
    camera_pan(&core->view.camera, (float)core->input.drag.moved_x, (float)core->input.drag.moved_y,
               core->view.layout.stage.h);
}

static const struct drag_owner panning = {.cursor = CURSOR_MOVE, .move = pan_stage, .end = stage_click};
static const struct drag_owner orbiting = {.cursor = CURSOR_ARROW, .move = orbit_stage, .end = stage_click};

static const double MOMENT = 0.35, STEP = 1.0 / 60; ///< seconds; per STEP a tail moves less than its grab distance

void stage_press(struct stage *stage, struct core *core, const struct event *event)
{
    const bool pans = event->button == BUTTON_MIDDLE || (event->button == BUTTON_LEFT && core->input.space_down);
    if (pans) {
        core->input.space_used = core->input.space_down;
        drag_begin(core, &panning, stage, NULL, event);
        return;
    }
    if (brush_press(stage, core, event)) return;
    stage->pointed.hash = 0; // forces a new search, because everything may have moved
    struct hover hover = stage_hover(stage, core, event->x, event->y);
    const bool holds = event->button == BUTTON_LEFT && core->focus.pick.use == BONE_SELECTED;

    // While it plays, a press aims at what was just visible: the tail, chain or body there within the last MOMENT.
    const struct document *document = core->document;
    double range[2];
    playback_range(core, range);
    const double first = core_position(document, range[0]), last = core_position(document, range[1]);
    for (double ago = STEP; holds && core->view.playback.playing && ago <= MOMENT && !hover.thing; ago += STEP) {
        float nearest = STRAND_REACH;
        const double back = ago * document->fps * document->substeps * core->view.playback.speed;
        double position = core->view.playback.position - back;
        if (position < first && core->view.on[SWITCH_LOOP]) position = last - (first - position);
        position = fmax(position, first);
        for (int s = 0; s < stage->strand_count; s++) {
            const int rig = stage->strands[s].rig;
            struct rig_pose posed;
            if (!strand_pose(stage, rig, position, NULL, &posed)) continue;
            strand_nearer(stage, rig, &posed.strand, (const float[2]){event->x, event->y}, &nearest, &hover);
        }
        if (hover.thing && document->rigs[hover.rig]->kind == RIG_CHAIN) hover.thing = &thing_chain;
        if (!hover.thing) hover = body_hover(stage, position, event->x, event->y);
    }
    stage->pressed = hover;
    if (holds && is_on_rig(&hover)) core->focus.limb = core->document->rigs[hover.rig]->id;
    if (event->button == BUTTON_LEFT && hover.thing != &thing_pin) core->focus.pin = 0;
    if (holds && hover.thing) {
        hover.thing->press(stage, core, &hover, event);
    } else {
        drag_begin(core, &orbiting, stage, NULL, event);
    }
}

static bool find_stage(void *room, const struct core *core, const struct target *target, float xy[2])
{
    const struct rect *stage = &core->view.layout.stage;
    (void)room;
    xy[0] = stage->x + stage->w * (float)target->number[0];
    xy[1] = stage->y + stage->h * (float)target->number[1];
    return true;
}

static bool find_pointer(void *room, const struct core *core, const struct target *target, float xy[2])
{
    (void)room;
    xy[0] = core->input.pointer_x + core->view.layout.stage.h * (float)target->number[0];
    xy[1] = core->input.pointer_y + core->view.layout.stage.h * (float)target->number[1];
    return true;
}

/// stage(0.5,0.5): shares of its size. pointer(0.1,0): relative to the pointer, in heights of the stage.
static const struct thing somewhere = {.name = "stage", .numbers = 2, .find = find_stage},
                          beside = {.name = "pointer", .numbers = 2, .find = find_pointer};

const struct thing *const stage_things[] = {&thing_tail, &thing_chain, &thing_bone, &thing_body, &thing_point,
                                            &thing_pin,  &thing_floor, &somewhere,  &beside,     NULL};

static const double RADIUS_LEAST = 0.01, RADIUS_MOST = 0.5, STRENGTH_LEAST = 0.02;
static const double BRUSH_STEP = 0.15; ///< per wheel notch, as a power of e

void stage_wheel(struct core *core, const struct event *event)
{
    // Ctrl changes the brush's radius, Shift its strength.
    struct brush *brush = &core->focus.brush;
    const double factor = maths_exp(BRUSH_STEP * fmin(fmax(event->dy, -20), 20));
    if (brush->on && event->mods & MOD_CTRL) {
        brush->radius = fmin(fmax(brush->radius * factor, RADIUS_LEAST), RADIUS_MOST);
        core_message(core, false, "Brush: radius %.0f %% of the character's height.", 100 * brush->radius);
        return;
    }
    if (brush->on && event->mods & MOD_SHIFT) {
        brush->strength = fmin(fmax(brush->strength * factor, STRENGTH_LEAST), 1);
        core_message(core, false, "Brush: strength %.0f %%.", 100 * brush->strength);
        return;
    }
    const struct rect *r = &core->view.layout.stage;
    const float before = core->view.camera.distance;
    camera_zoom(&core->view.camera, (float)maths_exp(-ZOOM_STEP * fmin(fmax(event->dy, -20), 20)));
    const float share = 1 - before / core->view.camera.distance; // the place under the pointer stays there
    camera_pan(&core->view.camera, share * (event->x - r->x - r->w / 2), share * (event->y - r->y - r->h / 2), r->h);
    camera_orbit(&core->view.camera, TURN_STEP * (float)fmin(fmax(event->dx, -20), 20), 0);
}

struct posing stage_posing(const struct core *core)
{
    return (struct posing){
        .document = core->document, .evaluation = core->evaluation, .models = core->models, .look = core->view.look};
}

static bool project(const struct stage *stage, struct rect r, const float point[3], float xy[2])
{
    const float viewport[4] = {r.x, r.y, r.w, r.h};
    return camera_project(stage->view.view, stage->view.projection, viewport, point, xy);
}

bool stage_project_point(const struct stage *stage, const float point[3], float xy[2])
{
    return project(stage, stage->core->view.layout.stage, point, xy);
}

void stage_ray(const struct stage *stage, float x, float y, float direction[3])
{
    const struct rect *r = &stage->view.viewport;
    const float viewport[4] = {r->x, r->y, r->w, r->h};
    camera_ray(stage->view.view, stage->view.projection, viewport, (const float[2]){x, y}, direction);
}

bool stage_project_box(const struct stage *stage, struct rect r, const float lo[3], const float hi[3],
                       struct rect *around)
{
    float least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY}, xy[2];
    bool all = true;
    for (int corner = 0; corner < 8; corner++) {
        const float point[3] = {(corner & 1 ? hi : lo)[0], (corner & 2 ? hi : lo)[1], (corner & 4 ? hi : lo)[2]};
        const bool seen = project(stage, r, point, xy);
        all &= seen;
        for (int k = 0; k < 2 && seen; k++) {
            least[k] = fminf(least[k], xy[k]);
            most[k] = fmaxf(most[k], xy[k]);
        }
    }
    *around = (struct rect){least[0], least[1], most[0] - least[0], most[1] - least[1]};
    return all;
}

double stage_pixels_per_metre(const struct stage *stage, const float place[3])
{
    const float depth = camera_depth(stage->view.view, stage->view.eye, place);
    return 0.5 * (double)(stage->core->view.layout.stage.h * stage->view.projection[5] / fmaxf(depth, 0.1f));
}

static const double LEAST_AXIS = 0.3; ///< pixels; axes that look shorter move as slowly as one of this length

double stage_along(double across, double up, const struct drag *drag)
{
    return (drag->moved_x * across - drag->moved_y * up) / fmax(across * across + up * up, LEAST_AXIS * LEAST_AXIS);
}

/// Initial azimuth in radians. A character, facing +z, is seen slightly from the side. Animals are seen
/// FROM_BEHIND off straight behind, which shows tail and ears.
static const float AZIMUTH = -1.13f, FROM_BEHIND = 0.87f;

/// In the order of posing and drawing.
static const struct {
    void (*pose)(struct stage *stage, const struct core *core, int rig);
    int bound_steps; ///< number of samples for the bounding box of its motion; 0: it has none
} kinds[RIG_KINDS] = {
    [RIG_TAIL] = {stage_pose_tail, 120}, [RIG_MODEL] = {stage_pose_model, 60}, [RIG_CHAIN] = {stage_pose_chain, 0}};

struct rect stage_figure(const struct stage *stage, const struct core *core)
{
    const struct rect *place = &core->view.layout.stage, *figure = &stage->figure;
    return (struct rect){place->x + place->w / 2 + figure->x * place->h, place->y + (figure->y + 0.5f) * place->h,
                         figure->w * place->h, figure->h * place->h};
}

void stage_fit(struct stage *stage, struct core *core)
{
    float lo[3] = {INFINITY, INFINITY, INFINITY}, hi[3] = {-INFINITY, -INFINITY, -INFINITY};
    const struct document *document = core->document;
    const double last = document_samples(document) - 1;
    bool seen[RIG_KINDS] = {false}, any = false;
    for (int r = 0; r < document->rig_count; r++) { // the box around each rig's motion over the scene
        const int steps = kinds[document->rigs[r]->kind].bound_steps;
        const struct posing posing = stage_posing_by_hand(stage);
        for (int step = 0; steps > 0 && step <= steps; step++) {
            struct rig_pose posed;
            float low[3], high[3];
            if (!rig_pose(&posing, r, last * step / steps, &posed)) break;
            const float aside = models_aside(core, r);
            rig_bounds(&posed, low, high);
            for (int k = 0; k < 3; k++) {
                lo[k] = fminf(lo[k], low[k] - (k == 0 ? aside : 0.0f));
                hi[k] = fmaxf(hi[k], high[k] + (k == 0 ? aside : 0.0f));
            }
            seen[document->rigs[r]->kind] = any = true;
        }
    }
    core->view.camera = camera_default();
    if (seen[RIG_MODEL] && !seen[RIG_TAIL]) { // as the first one stands
        const int rig = document_next_rig(document, RIG_MODEL, -1);
        const struct imported *first = models_imported(core->models, document, rig);
        float back[2];
        core->view.camera.azimuth =
            first && imported_back(first, back) ? maths_atan2f(-back[1], back[0]) - FROM_BEHIND : AZIMUTH;
    }
    camera_lamp(&core->view.camera, stage->view.key_from); // fixed while the camera orbits
    stage->figure = (struct rect){0};
    if (!any) return;
    for (int k = 0; k < 2; k++) stage->view.middle[k] = 0.5f * (lo[2 * k] + hi[2 * k]);
    const struct rect place = core->view.layout.stage;
    const float caption = core->view.plain ? 0 : caption_height(place, document);
    camera_fit(&core->view.camera, lo, hi, place.w / place.h, caption / place.h);

    // Where the motion is in the picture, from the stage's middle in stage heights.
    const struct rect unit = {-0.5f * place.w / place.h, -0.5f, place.w / place.h, 1};
    struct stage_view *view = &stage->view;
    camera_matrices(&core->view.camera, unit.w, view->view, view->projection, view->eye);
    stage_project_box(stage, unit, lo, hi, &stage->figure);
}

void stage_pose(struct stage *stage, struct core *core, bool covered)
{
    if (core->view.refit_stage) stage_fit(stage, core);
    core->view.refit_stage = false;
    struct stage_view *view = &stage->view;
    const struct document *document = core->document;
    stage->tail_count = view->model_count = view->blob_count = 0;
    stage->strand_count = stage->bone_count = 0;
    for (int kind = 0; kind < RIG_KINDS; kind++) {
        for (int rig = -1; (rig = document_next_rig(document, (enum rig_kind)kind, rig)) >= 0;)
            kinds[kind].pose(stage, core, rig);
    }
    view->has_tail = stage->tail_count > 0;
    view->viewport = core->view.layout.stage;
    view->colors = theme()->stage;
    view->behind = background_at(models_background(core->models), core_frame(core), &view->behind_id);
    camera_reshape(&core->view.camera, view->viewport.w / view->viewport.h);
    camera_matrices(&core->view.camera, view->viewport.w / view->viewport.h, view->view, view->projection, view->eye);
    view->hash = stage_scenery_hash(view);
    for (int m = 0; m < view->model_count; m++) {
        const struct stage_model *shown = &view->models[m];
        const struct model_pose *posed = &shown->posed;
        const struct gltf *gltf = posed->gltf;
        const struct figure *figure = posed->figure;
        const struct morph *morph = &posed->morph;
        const int looks[] = {shown->map_coordinate, shown->map_axis};
        uint64_t sum = hash_word(view->hash, gltf->id);
        sum = hash_word(hash_word(sum, figure ? figure->id : 0), figure ? figure->version : 0);
        sum = hash_bytes(sum, looks, sizeof looks);
        sum = hash_bytes(sum, morph->coordinate, (size_t)morph->count * sizeof *morph->coordinate);
        sum = hash_bytes(sum, morph->weight, (size_t)morph->count * sizeof *morph->weight);
        sum = hash_bytes(sum, posed->root, sizeof posed->root);
        sum = hash_bytes(sum, posed->pose->world, (size_t)gltf->node_count * sizeof *posed->pose->world);
        view->hash = hash_bytes(sum, posed->pose->weights, (size_t)gltf->weight_count * sizeof *posed->pose->weights);
    }
    view->hash = hash_bytes(view->hash, view->blobs, (size_t)view->blob_count * sizeof view->blobs[0]);

    // Memory for the largest surface, in which it can be posed.
    struct skin *skin = &stage->skin;
    int most = 0;
    for (int m = 0; m < view->model_count; m++) {
        const struct figure *figure = view->models[m].posed.figure;
        if (figure && figure->character.vertex_count > most) most = figure->character.vertex_count;
    }
    for (int t = 0; t < stage->tail_count; t++) {
        if (stage->strands[t].model < 0) continue;
        const struct gltf *fox = view->models[stage->strands[t].model].posed.gltf;
        const int count = gltf_vertex_count(fox, fox->node_count - 1);
        if (count > most) most = count;
    }
    if (most > skin->capacity) {
        free(skin->posed);
        *skin = (struct skin){.capacity = most, .posed = need((size_t)most, sizeof *skin->posed)};
    }
    brush_pose(stage, core, covered);
}

void stage_ring(struct core *core, const float xy[2])
{
    drawlist_circle(&core->list, xy, 6.5f, 1.5f, theme()->playhead);
}

void stage_show(struct stage *stage, struct core *core)
{
    const struct stage_view *view = &stage->view;
    struct rect clip = drawlist_push_clip(&core->list, view->viewport);
    if (stage->tail_count == 0 && view->model_count == 0) {
        const bool is_missing = document_find_rig(core->document, RIG_MODEL, 0) >= 0;
        const char *text = is_missing ? "wiggly could not read this scene's character. Its curves are below."
                           : core->focus.active < 0 ? "This scene is empty."
                                                    : "This scene has no tail. Its curves are below.";
        float room = view->viewport.w - 16, width = font_width(FONT_LABEL, THEME_TEXT_NORMAL, text);
        float x = view->viewport.x + 8 + fmaxf(room - width, 0) / 2;
        drawlist_text_fit(&core->list, x, view->viewport.y + view->viewport.h / 2, room, FONT_LABEL,
                          THEME_TEXT_NORMAL, theme()->text_dim, text);
    }
    overlays_show(stage, core);
    characters_show(stage, core);

    // Names of several tails, but for those that would overlap others or whose tail's feet are behind the eye.
    const struct rect r = core->view.layout.stage;
    struct rect shown[STAGE_MAX_TAILS];
    int count = 0;
    for (int t = 0; t < stage->tail_count && stage->tail_count > 1; t++) {
        const struct rig *rig = core->document->rigs[stage->strands[t].rig];
        const int spline = rig->tail.channel_count > 0 ? rig->tail.channels[0].spline : -1;
        const uint32_t color = spline >= 0 ? spline_list_color(core->document, spline) : theme()->text_dim;
        const struct pose *pose = &stage->strands[t].pose;
        const float *base = pose->matrix[0] + 12;
        const float feet[3] = {base[0], pose->ground, base[2] + FEET * pose->scale};
        float xy[2];
        bool free = true;
        if (!stage_project_point(stage, feet, xy)) continue;
        struct rect place = {.w = ceilf(font_width(FONT_LABEL, THEME_TEXT_NORMAL, rig->name)) + DOT + 3 * PAD,
                             .h = HEIGHT};
        place.x = roundf(fmaxf(fminf(xy[0] - place.w / 2, r.x + r.w - place.w), r.x));
        place.y = roundf(fminf(xy[1] + BELOW, r.y + r.h - HEIGHT));
        for (int i = 0; i < count && free; i++) {
            const struct rect both = rect_intersect(place, shown[i]);
            free = both.w <= 0 || both.h <= 0;
        }
        if (!free) continue;
        const struct rect dot = {place.x + PAD, place.y + (HEIGHT - DOT) / 2.0f, DOT, DOT};
        drawlist_rounded(&core->list, place, HEIGHT / 2.0f, theme()->panel);
        drawlist_rounded(&core->list, dot, 2, color);
        drawlist_text(&core->list, dot.x + DOT + PAD, place.y + HEIGHT - PAD, FONT_LABEL, THEME_TEXT_NORMAL,
                      theme()->text, rig->name);
        shown[count++] = place;
    }
    brush_show(stage, core);
    body_show(stage, core);
    bones_show(stage, core);
    if (!core->input.drag.owner && is_strand(&core->input.hover))
        stage_ring(core, (float[2]){core->input.hover.x, core->input.hover.y});
    drag_show(stage, core);
    pins_show(stage, core);
    drawlist_set_clip(&core->list, clip);
}
