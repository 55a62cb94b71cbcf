/// Few colors for a picture: the box of colors that spreads most is cut at its mean until there are enough boxes
/// (a kin of median cut). Three quarters of each error are diffused as by Floyd and Steinberg; more would build up and make specks.
#include "app/film_palette.h"
#include "base/need.h"
#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/// Colors are counted in cells of 4 × 4 × 4.
enum { CELL_BITS = 6, CELLS = 1 << 3 * CELL_BITS, SHIFT = 8 - CELL_BITS };

/// How much the eye sees of each channel.
static const int WEIGHT[3] = {2, 4, 3};

/// The pixels of a cell.
struct cell {
    uint32_t count, sum[3];
};

/// A color that occurs, and how often.
struct color {
    float count, value[3];
};

struct box {
    int first, count; ///< of the colors
    float mean[3], spread;
    int widest; ///< the channel that spreads most
};

struct palette_maker {
    struct cell *cells;
    struct color *colors;
    int *errors; ///< of this row of pixels and the next, with one more at both ends, in sixteenths
};

struct palette_maker *palette_maker_create(int width, int height)
{
    struct palette_maker *maker = need_zeroed(1, sizeof *maker);
    const size_t pixels = (size_t)width * (size_t)height;
    maker->cells = need(CELLS, sizeof *maker->cells);
    maker->colors = need(pixels < CELLS ? pixels : CELLS, sizeof *maker->colors);
    maker->errors = need(2 * 3 * ((size_t)width + 2), sizeof *maker->errors);
    return maker;
}

void palette_maker_destroy(struct palette_maker *maker)
{
    if (!maker) return;
    free(maker->cells);
    free(maker->colors);
    free(maker->errors);
    free(maker);
}

static int count_colors(struct palette_maker *maker, const struct palette_picture *picture)
{
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    int count = 0;
    memset(maker->cells, 0, CELLS * sizeof *maker->cells);
    for (size_t i = 0; i < pixels; i++) {
        if (!picture->drawn[i]) continue;
        const unsigned char *p = picture->pixels + 4 * i;
        struct cell *cell =
            &maker->cells[(p[0] >> SHIFT) << 2 * CELL_BITS | (p[1] >> SHIFT) << CELL_BITS | p[2] >> SHIFT];
        cell->count++;
        for (int c = 0; c < 3; c++) cell->sum[c] += p[c];
    }
    for (int i = 0; i < CELLS; i++) {
        const struct cell *cell = &maker->cells[i];
        if (!cell->count) continue;
        struct color *color = &maker->colors[count++];
        color->count = (float)cell->count;
        for (int c = 0; c < 3; c++) color->value[c] = (float)cell->sum[c] / color->count;
    }
    return count;
}

static struct box measure(const struct color *colors, int first, int count)
{
    struct box box = {first, count, {0}, 0, 0};
    float pixels = 0, widest = 0;
    for (int i = first; i < first + count; i++) {
        pixels += colors[i].count;
        for (int c = 0; c < 3; c++) box.mean[c] += colors[i].count * colors[i].value[c];
    }
    for (int c = 0; c < 3; c++) {
        float spread = 0;
        box.mean[c] /= pixels;
        for (int i = first; i < first + count; i++) {
            const float off = colors[i].value[c] - box.mean[c];
            spread += colors[i].count * off * off;
        }
        spread *= (float)WEIGHT[c];
        box.spread += spread;
        if (spread <= widest) continue;
        widest = spread;
        box.widest = c;
    }
    return box;
}

/// Moves the colors below the mean to the front. Returns how many.
static int cut(struct color *colors, const struct box *box)
{
    int below = 0;
    for (int i = 0; i < box->count; i++) {
        struct color *color = &colors[box->first + i], *place = &colors[box->first + below];
        if (color->value[box->widest] >= box->mean[box->widest]) continue;
        const struct color moved = *color;
        *color = *place;
        *place = moved;
        below++;
    }
    return below;
}

static int by_green(const void *a, const void *b)
{
    const unsigned char *x = a, *y = b;
    return x[1] != y[1] ? x[1] - y[1] : x[0] != y[0] ? x[0] - y[0] : x[2] - y[2];
}

void palette_choose(struct palette_maker *maker, const struct palette_picture *picture, struct palette *palette)
{
    const int colors = count_colors(maker, picture);
    palette->count = 0;
    if (colors == 0) return;
    struct box boxes[PALETTE_COLORS] = {measure(maker->colors, 0, colors)};
    int count = 1;
    while (count < PALETTE_COLORS) {
        struct box *most = boxes;
        for (int b = 1; b < count; b++) {
            if (boxes[b].spread > most->spread) most = &boxes[b];
        }
        const int below = most->spread > 0 ? cut(maker->colors, most) : 0;
        if (below == 0) break;
        boxes[count++] = measure(maker->colors, most->first + below, most->count - below);
        *most = measure(maker->colors, most->first, below);
    }
    palette->count = count;
    for (int b = 0; b < count; b++) {
        for (int c = 0; c < 3; c++) palette->colors[b][c] = (unsigned char)(boxes[b].mean[c] + 0.5f);
    }
    qsort(palette->colors, (size_t)count, sizeof *palette->colors, by_green);
}

/// The nearest color. `from[green]` is the first color of at least this green.
static int nearest(const struct palette *palette, const int from[256], const int wanted[3])
{
    int best = 0, least = INT_MAX;
    for (int step = -1; step <= 1; step += 2) {
        for (int i = from[wanted[1]] - (step < 0); i >= 0 && i < palette->count; i += step) {
            const unsigned char *color = palette->colors[i];
            const int red = color[0] - wanted[0], green = color[1] - wanted[1], blue = color[2] - wanted[2];
            if (WEIGHT[1] * green * green >= least) break; // as are all beyond
            const int off = WEIGHT[0] * red * red + WEIGHT[1] * green * green + WEIGHT[2] * blue * blue;
            if (off >= least) continue;
            least = off;
            best = i;
        }
    }
    return best;
}

void palette_draw(struct palette_maker *maker, const struct palette_picture *picture, const struct palette *palette,
                  unsigned char *indices)
{
    int from[256];
    for (int green = 0, i = 0; green < 256; green++) {
        while (i < palette->count && palette->colors[i][1] < green) i++;
        from[green] = i;
    }
    const size_t row = 3 * ((size_t)picture->width + 2);
    int *here = maker->errors, *below = here + row;
    memset(here, 0, 2 * row * sizeof *here);
    for (int y = 0; y < picture->height; y++) {
        for (int x = 0; x < picture->width; x++) {
            const size_t i = (size_t)y * (size_t)picture->width + (size_t)x;
            int *error = here + 3 * (x + 1), *next = below + 3 * (x + 1), wanted[3];
            if (!picture->drawn[i]) continue;
            for (int c = 0; c < 3; c++) {
                wanted[c] = picture->pixels[4 * i + (size_t)c] + (3 * error[c] + (error[c] >= 0 ? 32 : -32)) / 64;
                wanted[c] = wanted[c] < 0 ? 0 : wanted[c] > 255 ? 255 : wanted[c];
            }
            indices[i] = (unsigned char)nearest(palette, from, wanted);
            for (int c = 0; c < 3; c++) {
                const int off = wanted[c] - palette->colors[indices[i]][c];
                error[c + 3] += 7 * off;
                next[c - 3] += 3 * off;
                next[c] += 5 * off;
                next[c + 3] += off;
            }
        }
        int *swap = here;
        here = below;
        below = swap;
        memset(below, 0, row * sizeof *below);
    }
}
