/// Finds the rectangles that changed since the last frame.
#include "draw/damage.h"
#include "base/hash.h"
#include <limits.h>

/// Narrow cells make a moving playhead cheap; more cells cost more hashing.
enum { CELL_MIN = 16, CANDIDATES = 48 };

/// Rectangles being merged, in device pixels.
struct pile {
    struct area areas[CANDIDATES];
    int count;
};

void damage_forget(struct damage *damage) { damage->known = false; }

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

/// The cell of a device pixel inside the framebuffer.
static int cell_of(const struct damage_axis *axis, int pixel)
{
    int index = pixel / axis->cell;
    for (int i = 0; i < 2; i++) {
        int cut = axis->cuts[i];
        bool counts = cut > 0 && cut < axis->size && cut % axis->cell != 0 && (i == 0 || cut != axis->cuts[0]);
        if (counts && pixel >= cut) index++;
    }
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

static void hash_cells(struct damage *damage, float scale, const struct drawlist *list,
                       const struct damage_stage *stage)
{
    uint64_t *cells = damage->hashes[damage->current];
    for (int i = 0; i < damage->columns.count * damage->rows.count; i++) cells[i] = HASH_START;
    mark(damage, cells, stage->viewport, stage->hash);
    mark(damage, cells, stage->moving, stage->moving_hash);
    for (int i = 0; i < list->count; i++) {
        mark(damage, cells, area_outer(list->commands[i].bounds, scale), list->commands[i].hash);
    }
}

/// Pixels that a union would redraw without need.
static long waste(struct area a, struct area b)
{
    return area_pixels(area_union(a, b)) - area_pixels(a) - area_pixels(b);
}

static void merge(struct pile *pile, int i, int j)
{
    pile->areas[i] = area_union(pile->areas[i], pile->areas[j]);
    pile->areas[j] = pile->areas[--pile->count];
}

/// Merges the pair whose union wastes the fewest pixels, if at most `limit`.
static bool merge_cheapest(struct pile *pile, long limit)
{
    int best_i = -1, best_j = -1;
    for (int i = 0; i < pile->count; i++) {
        for (int j = i + 1; j < pile->count; j++) {
            long cost = waste(pile->areas[i], pile->areas[j]);
            if (cost > limit) continue;
            limit = cost;
            best_i = i;
            best_j = j;
        }
    }
    if (best_i < 0) return false;
    merge(pile, best_i, best_j);
    return true;
}

static const long ANY_WASTE = LONG_MAX;

/// The next run of changed cells of a row from `column` on: [*from, *to). false at the end of the row.
static bool next_run(const struct damage *damage, int row, int column, int *from, int *to)
{
    int columns = damage->columns.count;
    const uint64_t *now = damage->hashes[damage->current] + row * columns;
    const uint64_t *before = damage->hashes[1 - damage->current] + row * columns;
    while (column < columns && now[column] == before[column]) column++;
    *from = column;
    while (column < columns && now[column] != before[column]) column++;
    *to = column;
    return *to > *from;
}

/// Adds a run, or extends an equally wide one above it.
static void add_run(struct pile *pile, struct area run)
{
    for (int i = pile->count - 1; i >= 0; i--) {
        struct area *above = &pile->areas[i];
        if (above->y1 != run.y0 || above->x0 != run.x0 || above->x1 != run.x1) continue;
        above->y1 = run.y1;
        return;
    }
    if (pile->count == CANDIDATES) merge_cheapest(pile, ANY_WASTE);
    pile->areas[pile->count++] = run;
}

/// All changed cells as rectangles.
static void gather(const struct damage *damage, struct pile *pile)
{
    const int *x = damage->columns.edges, *y = damage->rows.edges;
    for (int row = 0; row < damage->rows.count; row++) {
        int from, to;
        for (int column = 0; next_run(damage, row, column, &from, &to); column = to) {
            add_run(pile, (struct area){x[from], y[row], x[to], y[row + 1]});
        }
    }
}

/// Merges rectangles that touch until all are disjoint.
static void make_disjoint(struct pile *pile)
{
    for (int i = 0; i < pile->count; i++) {
        for (int j = i + 1; j < pile->count; j++) {
            if (!area_touches(pile->areas[i], pile->areas[j])) continue;
            merge(pile, i, j);
            i = -1;
            break;
        }
    }
}

/// Merges all rectangles that touch the stage into one.
static void join_on_stage(struct pile *pile, struct area viewport)
{
    int first = -1;
    for (int i = 0; i < pile->count; i++) {
        if (!area_touches(pile->areas[i], viewport)) continue;
        if (first < 0) {
            first = i;
        } else {
            merge(pile, first, i);
            i--;
        }
    }
}

/// An extra rectangle costs about as much as this many pixels: each traverses the list and changes the scissor.
static const long WORTH_A_RECTANGLE = 4096;

static void reduce(struct pile *pile, struct area viewport)
{
    int before;
    do {
        before = pile->count;
        make_disjoint(pile);
        join_on_stage(pile, viewport);
        merge_cheapest(pile, pile->count > DAMAGE_RECTANGLES ? ANY_WASTE : WORTH_A_RECTANGLE);
    } while (pile->count != before);
}

void damage_update(struct damage *damage, int width, int height, float scale, const struct drawlist *list,
                   const struct damage_stage *stage)
{
    const struct area viewport = stage->viewport;
    bool new_columns = set_axis(&damage->columns, width, viewport.x0, viewport.x1);
    bool new_rows = set_axis(&damage->rows, height, viewport.y0, viewport.y1);
    if (new_columns || new_rows) damage->known = false;
    damage->current = 1 - damage->current;
    hash_cells(damage, scale, list, stage);
    struct area whole = {0, 0, width, height};
    struct pile pile = {.count = 0};
    if (damage->known) {
        gather(damage, &pile);
        reduce(&pile, area_intersect(viewport, whole));
    } else {
        pile.areas[pile.count++] = whole;
    }
    damage->count = pile.count;
    for (int i = 0; i < pile.count; i++) damage->rectangles[i] = area_intersect(pile.areas[i], whole);
    damage->known = true;
}
