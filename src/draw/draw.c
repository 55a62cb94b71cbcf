/// The renderer: draws stage and draw list, only where something changed, and pictures of the stage alone.
#include "draw/draw.h"
#include "base/hash.h"
#include "base/need.h"
#include "base/progress.h"
#include "draw/gl.h"
#include "draw/paint.h"
#include "draw/stage.h"
#include "model/vector.h"
#include "ui/theme.h"
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- framebuffers

/// An offscreen framebuffer.
struct target {
    GLuint framebuffer, color, depth;
    int width, height;
};

static void target_destroy(struct target *target)
{
    glDeleteFramebuffers(1, &target->framebuffer);
    glDeleteRenderbuffers(1, &target->color);
    glDeleteRenderbuffers(1, &target->depth);
    *target = (struct target){0};
}

static void attach(GLuint *buffer, GLenum place, GLenum format, int width, int height)
{
    glGenRenderbuffers(1, buffer);
    glBindRenderbuffer(GL_RENDERBUFFER, *buffer);
    glRenderbufferStorage(GL_RENDERBUFFER, format, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, *buffer);
}

/// Binds a framebuffer of this size; false if the driver cannot create it.
static bool target_bind(struct target *target, int width, int height)
{
    if (target->framebuffer && target->width == width && target->height == height) {
        glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
        return true;
    }
    target_destroy(target);
    glGenFramebuffers(1, &target->framebuffer);
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer);
    attach(&target->color, GL_COLOR_ATTACHMENT0, GL_RGBA8, width, height);
    attach(&target->depth, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, width, height);
    target->width = width;
    target->height = height;
    return glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE;
}

// --- what changed since the last frame
//
// A grid divides the framebuffer, with the stage's viewport on cell borders. A cell's hash combines the hashes of the stage there and of the
// commands that touch the cell, in painter's order. Cells with a changed hash are merged into rectangles.

/// Narrow cells make a moving playhead cheap; more cells cost more hashing.
enum { DAMAGE_SIDE = 128, DAMAGE_RECTANGLES = 8, CELL_MIN = 16, CANDIDATES = 48 };

/// One direction of the grid: cells of equal size, cut at the viewport's edges.
struct damage_axis {
    int size, cell; ///< device pixels
    int cuts[2];
    int count;                  ///< of cells
    int edges[DAMAGE_SIDE + 1]; ///< cell i is [edges[i], edges[i + 1])
};

struct damage {
    uint64_t hashes[2][DAMAGE_SIDE * DAMAGE_SIDE]; ///< this frame's and the last one's, alternating
    int current;
    struct damage_axis columns, rows;
    bool known;                         ///< the last frame's hashes match the screen
    struct area rectangles[CANDIDATES]; ///< in the end at most DAMAGE_RECTANGLES, disjoint, inside the framebuffer
    int count;
};

/// The stage below the list: its viewport, and the part that moves.
struct damage_stage {
    struct area viewport, moving;
    uint64_t hash, moving_hash; ///< of everything outside `moving`; of everything
};

/// Lays out one direction; false if nothing changed.
static bool set_axis(struct damage_axis *axis, int size, int from, int to)
{
    if (size == axis->size && from == axis->cuts[0] && to == axis->cuts[1]) return false;
    // Each cut may add a cell.
    *axis = (struct damage_axis){.size = size, .cuts = {from, to}};
    axis->cell = area_max(CELL_MIN, (size + DAMAGE_SIDE - 3) / (DAMAGE_SIDE - 2));
    for (int edge = 0; edge < size;) {
        axis->edges[axis->count++] = edge;
        int next = (edge / axis->cell + 1) * axis->cell;
        for (int i = 0; i < 2; i++) {
            if (axis->cuts[i] > edge && axis->cuts[i] < next) next = axis->cuts[i];
        }
        edge = next;
    }
    axis->edges[axis->count] = size;
    return true;
}

/// The cell of a device pixel inside the framebuffer. Cuts only add cells before it.
static int cell_of(const struct damage_axis *axis, int pixel)
{
    int index = pixel / axis->cell;
    while (axis->edges[index + 1] <= pixel) index++;
    return index;
}

/// Mixes `hash` into all cells that `area` touches.
static void mark(struct damage *damage, uint64_t *cells, struct area area, uint64_t hash)
{
    struct area inside = area_intersect(area, (struct area){0, 0, damage->columns.size, damage->rows.size});
    if (area_empty(inside)) return;
    int first_column = cell_of(&damage->columns, inside.x0), last_column = cell_of(&damage->columns, inside.x1 - 1);
    int first_row = cell_of(&damage->rows, inside.y0), last_row = cell_of(&damage->rows, inside.y1 - 1);
    for (int row = first_row; row <= last_row; row++) {
        uint64_t *line = cells + row * damage->columns.count;
        for (int column = first_column; column <= last_column; column++) line[column] = hash_word(line[column], hash);
    }
}

static void merge(struct damage *damage, int i, int j)
{
    damage->rectangles[i] = area_union(damage->rectangles[i], damage->rectangles[j]);
    damage->rectangles[j] = damage->rectangles[--damage->count];
}

/// Merges the pair whose union wastes the fewest pixels, if at most `limit`.
static void merge_cheapest(struct damage *damage, long limit)
{
    int best_i = -1, best_j = -1;
    for (int i = 0; i < damage->count; i++) {
        for (int j = i + 1; j < damage->count; j++) {
            const struct area a = damage->rectangles[i], b = damage->rectangles[j];
            const long cost = area_pixels(area_union(a, b)) - area_pixels(a) - area_pixels(b);
            if (cost > limit) continue;
            limit = cost;
            best_i = i;
            best_j = j;
        }
    }
    if (best_i >= 0) merge(damage, best_i, best_j);
}

static const long ANY_WASTE = LONG_MAX;

/// An extra rectangle costs about as much as this many pixels: each traverses the list and changes the scissor.
static const long WORTH_A_RECTANGLE = 4096;

/// Compares a frame of width × height device pixels with the last one and fills `rectangles`, with the whole frame if the last one is
/// unknown. At most one rectangle touches the stage's viewport, because drawing the stage costs the same for any part of it.
static void damage_update(struct damage *damage, int width, int height, float scale, const struct drawlist *list,
                          const struct damage_stage *stage)
{
    const struct area whole = {0, 0, width, height}, viewport = stage->viewport;
    const bool new_columns = set_axis(&damage->columns, width, viewport.x0, viewport.x1);
    const bool new_rows = set_axis(&damage->rows, height, viewport.y0, viewport.y1);
    const int columns = damage->columns.count, rows = damage->rows.count;
    if (new_columns || new_rows) damage->known = false;
    damage->current = 1 - damage->current;
    uint64_t *cells = damage->hashes[damage->current];
    for (int i = 0; i < columns * rows; i++) cells[i] = HASH_START;
    mark(damage, cells, viewport, stage->hash);
    mark(damage, cells, stage->moving, stage->moving_hash);
    for (const struct draw_command *command = list->commands; command < list->commands + list->count; command++)
        mark(damage, cells, area_outer(command->bounds, scale), command->hash);

    // The runs of changed cells in each row.
    struct area *areas = damage->rectangles;
    damage->count = 0;
    if (!damage->known) areas[damage->count++] = whole;
    for (int row = 0; damage->known && row < rows; row++) {
        const uint64_t *now = cells + row * columns;
        const uint64_t *before = damage->hashes[1 - damage->current] + row * columns;
        const int *x = damage->columns.edges, *y = damage->rows.edges;
        for (int to = 0; to < columns;) {
            int from = to;
            while (from < columns && now[from] == before[from]) from++;
            for (to = from; to < columns && now[to] != before[to];) to++;
            if (from == to) continue;
            int above = damage->count - 1; // an equally wide one above it is extended
            while (above >= 0 &&
                   !(areas[above].y1 == y[row] && areas[above].x0 == x[from] && areas[above].x1 == x[to]))
                above--;
            if (above < 0 && damage->count == CANDIDATES) merge_cheapest(damage, ANY_WASTE);
            if (above < 0)
                areas[damage->count++] = (struct area){x[from], y[row], x[to], y[row + 1]};
            else
                areas[above].y1 = y[row + 1];
        }
    }
    for (int count = 0; damage->known && count != damage->count;) {
        count = damage->count;
        for (int i = 0; i < damage->count; i++) { // those that touch, until all are disjoint
            for (int j = i + 1; j < damage->count; j++) {
                if (!area_touches(areas[i], areas[j])) continue;
                merge(damage, i, j);
                i = -1;
                break;
            }
        }
        int on_stage = -1; // all that touch the stage become one
        for (int i = 0; i < damage->count; i++) {
            if (!area_touches(areas[i], area_intersect(viewport, whole))) continue;
            if (on_stage < 0)
                on_stage = i;
            else
                merge(damage, on_stage, i--);
        }
        merge_cheapest(damage, damage->count > DAMAGE_RECTANGLES ? ANY_WASTE : WORTH_A_RECTANGLE);
    }
    damage->known = true;
}

// --- frames

struct draw {
    struct batch batch;
    struct stage_renderer *stage;
    struct target target; ///< for a stage at a lower resolution
    struct atlas atlas;
    GLuint atlas_texture;
    struct damage damage;
    struct gpu_timer timer;
};

static bool is_reduced(float stage_scale) { return stage_scale > 0.0f && stage_scale < 1.0f; }

/// Rasterises the fonts for `scale` and uploads them; on failure keeps the old ones.
static bool load_atlas(struct draw *draw, float scale, struct error *error)
{
    struct atlas atlas;
    if (!atlas_build(scale, &atlas, error)) return false;
    const int largest = gl_largest_texture();
    if (atlas.width > largest || atlas.height > largest) {
        fail(error, ERROR_ENVIRONMENT, "the fonts need a texture of %d × %d, this OpenGL driver takes %d",
             atlas.width, atlas.height, largest);
        atlas_free(&atlas);
        return false;
    }
    atlas_free(&draw->atlas);
    draw->atlas = atlas;
    if (!draw->atlas_texture) glGenTextures(1, &draw->atlas_texture);
    glBindTexture(GL_TEXTURE_2D, draw->atlas_texture);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R8, atlas.width, atlas.height, 0, GL_RED, GL_UNSIGNED_BYTE, atlas.coverage);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    draw->damage.known = false;
    return true;
}

struct draw *draw_create(float scale, struct error *error)
{
    struct draw *draw = need_zeroed(1, sizeof *draw);
    bool ok = batch_create(&draw->batch, error) && load_atlas(draw, scale, error);
    if (ok) draw->stage = stage_renderer_create(error);
    if (!draw->stage) {
        draw_destroy(draw);
        return NULL;
    }
    const char *name = draw_renderer_name();
    gpu_timer_create(&draw->timer, strstr(name, "llvmpipe") || strstr(name, "softpipe") || strstr(name, "Software"));
    return draw;
}

void draw_destroy(struct draw *draw)
{
    if (!draw) return;
    gpu_timer_destroy(&draw->timer);
    target_destroy(&draw->target);
    stage_renderer_destroy(draw->stage);
    glDeleteTextures(1, &draw->atlas_texture);
    atlas_free(&draw->atlas);
    batch_destroy(&draw->batch);
    free(draw);
}

/// The bottom layer of a rectangle: panel colour, and the stage in its viewport.
static void draw_below(struct draw *draw, const struct draw_input *input, struct area area, struct area viewport)
{
    struct area on_stage = area_intersect(area, viewport);
    glEnable(GL_SCISSOR_TEST);
    if (!area_contains(viewport, area)) {
        gl_scissor(area, input->height);
        gl_clear(theme()->panel | 0xFF);
    }
    if (area_empty(on_stage)) return;
    if (is_reduced(input->stage_scale)) { // drawn smaller, and enlarged
        const float scale = input->stage_scale;
        const int x = viewport.x0, y = viewport.y0;
        const int width = area_max(1, (int)lroundf((float)(viewport.x1 - x) * scale));
        const int height = area_max(1, (int)lroundf((float)(viewport.y1 - y) * scale));
        GLint screen = 0;
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &screen);
        const bool drawn = target_bind(&draw->target, width, height); // else the driver cannot create it
        if (drawn) {
            // The pixels of the small picture from which the visible part is interpolated.
            const struct area needed = {
                (int)floorf((float)(on_stage.x0 - x) * scale) - 1, (int)floorf((float)(on_stage.y0 - y) * scale) - 1,
                (int)ceilf((float)(on_stage.x1 - x) * scale) + 1, (int)ceilf((float)(on_stage.y1 - y) * scale) + 1};
            gl_scissor(area_intersect(needed, (struct area){0, 0, width, height}), height);
            stage_draw(draw->stage, input->stage, 0, 0, width, height, false);
            glBindFramebuffer(GL_DRAW_FRAMEBUFFER, (GLuint)screen);
            gl_scissor(on_stage, input->height);
            glBlitFramebuffer(0, 0, width, height, x, input->height - viewport.y1, viewport.x1, input->height - y,
                              GL_COLOR_BUFFER_BIT, GL_LINEAR);
        }
        glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)screen);
        if (drawn) return;
    }
    gl_scissor(on_stage, input->height);
    stage_draw(draw->stage, input->stage, viewport.x0, input->height - viewport.y1, viewport.x1 - viewport.x0,
               viewport.y1 - viewport.y0, false);
}

void draw_frame(struct draw *draw, const struct draw_input *input, struct draw_cost *cost)
{
    static const float seam = 3.0f; ///< device pixels that soft outlines may reach outwards, rounded up
    struct damage *damage = &draw->damage;
    struct batch *batch = &draw->batch;
    *cost = (struct draw_cost){0};
    cost->gpu_us = gpu_timer_take(&draw->timer, &cost->gpu_frame);
    double start = clock_now();
    // If the driver takes no larger texture, the old glyphs remain, less sharp.
    if (input->scale != draw->atlas.scale) load_atlas(draw, input->scale, NULL);
    if (!input->keeps) damage->known = false;

    struct damage_stage stage = {.hash = 0};
    if (input->stage) {
        // A new resolution changes every pixel of the stage, and enlarging spreads motion to neighbours.
        const float scale = is_reduced(input->stage_scale) ? input->stage_scale : 1.0f;
        stage.viewport = area_rounded(input->stage->viewport, input->scale);
        stage.hash = stage_backdrop_hash(input->stage);
        stage.hash = hash_bytes(stage.hash, &scale, sizeof scale);
        stage.moving_hash = input->stage->hash;
        stage.moving = stage_extent(input->stage, stage.viewport, (int)ceilf(seam / scale));
    }
    damage_update(damage, input->width, input->height, input->scale, input->list, &stage);
    cost->draw_us = 1e6 * (clock_now() - start);
    if (damage->count == 0) return;

    start = clock_now();
    int changed = 0; // the first rectangle on the stage
    while (changed < damage->count && !area_touches(damage->rectangles[changed], stage.viewport)) changed++;
    if (input->stage && changed < damage->count) stage_upload(draw->stage, input->stage, &cost->uploaded_bytes);
    cost->upload_us = 1e6 * (clock_now() - start);

    gpu_timer_begin(&draw->timer, input->frame);
    for (int i = 0; i < damage->count; i++) {
        draw_below(draw, input, damage->rectangles[i], stage.viewport);
        cost->pixels += area_pixels(damage->rectangles[i]);
    }
    batch_begin(batch, input->width, input->height, input->scale, &draw->atlas, draw->atlas_texture);
    for (int i = 0; i < damage->count; i++) paint_list(batch, input->list, damage->rectangles[i]);
    batch_flush(batch);
    glDisable(GL_SCISSOR_TEST);
    gpu_timer_end(&draw->timer);

    cost->rectangles = damage->count;
    cost->uploaded_bytes += batch->uploaded_bytes;
    cost->upload_us += batch->upload_us;
    cost->draw_us += 1e6 * (clock_now() - start) - cost->upload_us;
}

void draw_read(int width, int height, unsigned char *rgba)
{
    size_t stride = (size_t)width * 4;
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, rgba);
    for (int top = 0, bottom = height - 1; top < bottom; top++, bottom--) {
        unsigned char *a = rgba + (size_t)top * stride, *b = rgba + (size_t)bottom * stride;
        for (size_t i = 0; i < stride; i++) {
            unsigned char keep = a[i];
            a[i] = b[i];
            b[i] = keep;
        }
    }
    for (size_t i = 3; i < stride * (size_t)height; i += 4) rgba[i] = 255;
}

const char *draw_renderer_name(void)
{
    static char name[256];
    const char *renderer = (const char *)glGetString(GL_RENDERER), *version = (const char *)glGetString(GL_VERSION);
    snprintf(name, sizeof name, "%s, OpenGL %s", renderer ? renderer : "unknown", version ? version : "unknown");
    return name;
}

// --- pictures of the stage, drawn at twice their size; 2 × 2 pixels are averaged into one

enum { FINE = 2 }; ///< drawn pixels per side of a picture's pixel

struct picture {
    int width, height;
    struct stage_renderer *stage;
    struct target target;
    GLuint buffer; ///< receives what is drawn
    GLsync fence;  ///< after that
    bool transparent;
    unsigned char *drawn, *pixels; ///< as drawn, bottom row first; the picture
};

struct picture *picture_create(int width, int height, struct error *error)
{
    struct picture *picture = need_zeroed(1, sizeof *picture);
    picture->width = width;
    picture->height = height;
    picture->stage = stage_renderer_create(error);
    GLint largest = 0, before = 0;
    glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &largest);
    bool done = picture->stage;
    if (done && (width < 1 || height < 1 || FINE * width > largest || FINE * height > largest))
        done = fail(error, ERROR_ENVIRONMENT, "expected a picture of 1 to %d pixels a side, got %d × %d",
                    largest / FINE, width, height);
    if (done) {
        glGetIntegerv(GL_FRAMEBUFFER_BINDING, &before);
        done = target_bind(&picture->target, FINE * width, FINE * height) ||
               fail(error, ERROR_ENVIRONMENT, "the graphics driver makes no framebuffer of %d × %d pixels",
                    FINE * width, FINE * height);
        glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)before);
    }
    if (!done) {
        picture_destroy(picture);
        return NULL;
    }
    const size_t bytes = 4 * (size_t)width * (size_t)height;
    picture->buffer = gl_buffer(GL_PIXEL_PACK_BUFFER, FINE * FINE * bytes, NULL, GL_STREAM_READ);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    picture->drawn = need(FINE * FINE, bytes);
    picture->pixels = need(bytes, 1);
    return picture;
}

void picture_destroy(struct picture *picture)
{
    if (!picture) return;
    stage_renderer_destroy(picture->stage);
    target_destroy(&picture->target);
    glDeleteBuffers(1, &picture->buffer);
    if (picture->fence) glDeleteSync(picture->fence);
    free(picture->drawn);
    free(picture->pixels);
    free(picture);
}

void picture_draw(struct picture *picture, const struct stage_view *view, bool transparent)
{
    const int width = FINE * picture->width, height = FINE * picture->height;
    GLint before = 0;
    long bytes = 0;
    picture->transparent = transparent;
    glGetIntegerv(GL_FRAMEBUFFER_BINDING, &before);
    target_bind(&picture->target, width, height);
    glDisable(GL_SCISSOR_TEST);
    stage_upload(picture->stage, view, &bytes);
    if (transparent) {
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
    }
    stage_draw(picture->stage, view, 0, 0, width, height, transparent);
    glPixelStorei(GL_PACK_ALIGNMENT, 4);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, picture->buffer);
    glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, NULL);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    if (picture->fence) glDeleteSync(picture->fence);
    picture->fence = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    glFlush();
    glBindFramebuffer(GL_FRAMEBUFFER, (GLuint)before);
}

const unsigned char *picture_take(struct picture *picture, bool wait)
{
    if (!wait && glClientWaitSync(picture->fence, 0, 0) == GL_TIMEOUT_EXPIRED) return NULL;
    const size_t stride = 4 * FINE * (size_t)picture->width;
    glBindBuffer(GL_PIXEL_PACK_BUFFER, picture->buffer);
    glGetBufferSubData(GL_PIXEL_PACK_BUFFER, 0, (GLsizeiptr)(FINE * (size_t)picture->height * stride),
                       picture->drawn);
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    for (int y = 0; y < picture->height; y++) {
        const unsigned char *a = picture->drawn + FINE * (size_t)(picture->height - 1 - y) * stride, *b = a + stride;
        unsigned char *row = picture->pixels + 4 * (size_t)y * (size_t)picture->width;
        for (int x = 0; x < picture->width; x++, a += 8, b += 8, row += 4) {
            // Coverage weights colours, so that edges do not darken towards a transparent background.
            const int covered = picture->transparent ? a[3] + a[7] + b[3] + b[7] : 4 * 255;
            for (int k = 0; k < 3; k++) {
                if (picture->transparent) {
                    const int sum = a[k] * a[3] + a[k + 4] * a[7] + b[k] * b[3] + b[k + 4] * b[7];
                    row[k] = (unsigned char)(covered > 0 ? (sum + covered / 2) / covered : 0);
                } else {
                    row[k] = (unsigned char)((a[k] + a[k + 4] + b[k] + b[k + 4] + 2) / 4);
                }
            }
            row[3] = (unsigned char)((covered + 2) / 4);
        }
    }
    return picture->pixels;
}
