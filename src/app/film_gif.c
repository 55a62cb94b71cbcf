/// Writes films as GIF (version 89a), each picture with colors of its own and only where it differs from the last.
#include "app/film_file.h"
#include "base/file.h"
#include "base/need.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/// LZW as GIF has it: codes of 9 to 12 bits, low bits first, in blocks of up to 255 bytes.
enum { CLEAR = 256, END, FIRST_CODE, CODES = 4096, PLACES = 16384 };

struct lzw {
    FILE *stream;
    uint32_t keys[PLACES]; ///< a code and the index after it; 0: free
    uint16_t codes[PLACES];
    int next, width; ///< the next new code; bits a code
    uint32_t bits;
    int bit_count;
    unsigned char block[256]; ///< its size first
};

// Few colors for a picture: the box of colors that spreads most is cut at its mean until there are enough boxes
// (a kin of median cut). Three quarters of each error are diffused as by Floyd and Steinberg; more would build up and make specks.

enum { PALETTE_COLORS = 255 };

struct palette {
    unsigned char colors[PALETTE_COLORS][3]; ///< by rising green
    int count;
};

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

struct film_file {
    struct film_shape shape;
    struct file_output output;
    long written;
    unsigned char *last; ///< the pixels as they were when each was last written
    bool *drawn;
    unsigned char *indices;
    struct cell *cells;
    struct color *colors;
    int *errors; ///< of this row of pixels and the next, with one more at both ends, in sixteenths
    struct lzw lzw;
};

enum { TRANSPARENT = PALETTE_COLORS, LONGEST = 65535 };
/// Steps of a channel that nobody sees. Without them a film of the fox has 120 % of the bytes.
enum { NOT_SEEN = 1 };

// --- compression

static void put_block(struct lzw *lzw)
{
    fwrite(lzw->block, 1, lzw->block[0] + 1U, lzw->stream);
    lzw->block[0] = 0;
}

/// Writes what is there of the bits, down to less than `least`.
static void put_bits(struct lzw *lzw, int least)
{
    for (; lzw->bit_count >= least; lzw->bit_count -= 8) {
        lzw->block[++lzw->block[0]] = (unsigned char)lzw->bits;
        lzw->bits >>= 8;
        if (lzw->block[0] == 255) put_block(lzw);
    }
}

static void put_code(struct lzw *lzw, int code)
{
    lzw->bits |= (uint32_t)code << lzw->bit_count;
    lzw->bit_count += lzw->width;
    put_bits(lzw, 8);
}

/// A code of indices, after which the reader has one code more.
static void put_string(struct lzw *lzw, int code)
{
    put_code(lzw, code);
    if (lzw->next == 1 << lzw->width) lzw->width++;
}

static void clear(struct lzw *lzw)
{
    put_code(lzw, CLEAR);
    memset(lzw->keys, 0, sizeof lzw->keys);
    lzw->next = FIRST_CODE;
    lzw->width = 9;
}

/// The place of a key, or the free one where it belongs.
static int find(const struct lzw *lzw, uint32_t key)
{
    uint32_t place = key * 2654435761U >> 18;
    while (lzw->keys[place] && lzw->keys[place] != key) place = (place + 1) % PLACES;
    return (int)place;
}

/// Adds an index after the indices that `code` stands for. Returns the code of what is not yet written.
static int add_index(struct lzw *lzw, int code, unsigned char index)
{
    const uint32_t key = ((uint32_t)code << 8 | index) + 1;
    const int place = find(lzw, key);
    if (lzw->keys[place]) return lzw->codes[place];
    put_string(lzw, code);
    if (lzw->next == CODES - 1) {
        clear(lzw);
    } else {
        lzw->keys[place] = key;
        lzw->codes[place] = (uint16_t)lzw->next++;
    }
    return index;
}

// --- the file, and what differs from the last picture

static void put_short(FILE *stream, long value)
{
    putc((int)(value & 255), stream);
    putc((int)(value >> 8 & 255), stream);
}

static void close_gif(struct film_file *file)
{
    file_output_discard(&file->output);
    free(file->cells);
    free(file->colors);
    free(file->errors);
    free(file->last);
    free(file->drawn);
    free(file->indices);
    free(file);
}

static struct film_file *open_gif(const char *path, const struct film_shape *shape, struct error *error)
{
    struct film_file *file = need_zeroed(1, sizeof *file);
    const size_t pixels = (size_t)shape->width * (size_t)shape->height;
    file->shape = *shape;
    file->last = need(pixels, 4);
    file->drawn = need(pixels, sizeof *file->drawn);
    file->indices = need(pixels, 1);
    file->cells = need(CELLS, sizeof *file->cells);
    file->colors = need(pixels < CELLS ? pixels : CELLS, sizeof *file->colors);
    file->errors = need(2 * 3 * ((size_t)shape->width + 2), sizeof *file->errors);
    if (!file_output_open(&file->output, path, error)) {
        close_gif(file);
        return NULL;
    }
    FILE *stream = file->lzw.stream = file->output.stream;
    fputs("GIF89a", stream);
    put_short(stream, shape->width);
    put_short(stream, shape->height);
    fwrite("\x70\0\0", 1, 3, stream);                               // no colors for all pictures
    fwrite("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 1, 19, stream); // forever
    return file;
}

struct rectangle {
    int left, top, right, bottom; ///< the latter two are not within
};

static bool differs(const unsigned char *a, const unsigned char *b)
{
    return abs(a[0] - b[0]) > NOT_SEEN || abs(a[1] - b[1]) > NOT_SEEN || abs(a[2] - b[2]) > NOT_SEEN;
}

/// Notes in `drawn` the pixels that differ, and returns where they are.
static struct rectangle compare(struct film_file *file, const unsigned char *pixels)
{
    const int width = file->shape.width, height = file->shape.height;
    struct rectangle r = {width, height, 0, 0};
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            file->drawn[i] = file->written == 0 || differs(pixels + 4 * i, file->last + 4 * i);
            if (!file->drawn[i]) continue;
            memcpy(file->last + 4 * i, pixels + 4 * i, 4);
            r.left = x < r.left ? x : r.left;
            r.right = x >= r.right ? x + 1 : r.right;
            r.top = y < r.top ? y : r.top;
            r.bottom = y + 1;
        }
    }
    return r.right > 0 ? r : (struct rectangle){0, 0, 1, 1};
}

// --- colors

static int count_colors(struct film_file *file, const unsigned char *pixels)
{
    const size_t pixel_count = (size_t)file->shape.width * (size_t)file->shape.height;
    int count = 0;
    memset(file->cells, 0, CELLS * sizeof *file->cells);
    for (size_t i = 0; i < pixel_count; i++) {
        if (!file->drawn[i]) continue;
        const unsigned char *p = pixels + 4 * i;
        struct cell *cell =
            &file->cells[(p[0] >> SHIFT) << 2 * CELL_BITS | (p[1] >> SHIFT) << CELL_BITS | p[2] >> SHIFT];
        cell->count++;
        for (int c = 0; c < 3; c++) cell->sum[c] += p[c];
    }
    for (int i = 0; i < CELLS; i++) {
        const struct cell *cell = &file->cells[i];
        if (!cell->count) continue;
        struct color *color = &file->colors[count++];
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

/// The colors that suit the drawn pixels best.
static void choose_colors(struct film_file *file, const unsigned char *pixels, struct palette *palette)
{
    const int colors = count_colors(file, pixels);
    palette->count = 0;
    if (colors == 0) return;
    struct box boxes[PALETTE_COLORS] = {measure(file->colors, 0, colors)};
    int count = 1;
    while (count < PALETTE_COLORS) {
        struct box *most = boxes;
        for (int b = 1; b < count; b++) {
            if (boxes[b].spread > most->spread) most = &boxes[b];
        }
        const int below = most->spread > 0 ? cut(file->colors, most) : 0;
        if (below == 0) break;
        boxes[count++] = measure(file->colors, most->first + below, most->count - below);
        *most = measure(file->colors, most->first, below);
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

/// Writes the index of a color for each drawn pixel. Neighbours make up for what a color is off by.
static void draw(struct film_file *file, const unsigned char *pixels, const struct palette *palette)
{
    int from[256];
    for (int green = 0, i = 0; green < 256; green++) {
        while (i < palette->count && palette->colors[i][1] < green) i++;
        from[green] = i;
    }
    const size_t row = 3 * ((size_t)file->shape.width + 2);
    int *here = file->errors, *below = here + row;
    memset(here, 0, 2 * row * sizeof *here);
    for (int y = 0; y < file->shape.height; y++) {
        for (int x = 0; x < file->shape.width; x++) {
            const size_t i = (size_t)y * (size_t)file->shape.width + (size_t)x;
            int *error = here + 3 * (x + 1), *next = below + 3 * (x + 1), wanted[3];
            if (!file->drawn[i]) continue;
            for (int c = 0; c < 3; c++) {
                wanted[c] = pixels[4 * i + (size_t)c] + (3 * error[c] + (error[c] >= 0 ? 32 : -32)) / 64;
                wanted[c] = wanted[c] < 0 ? 0 : wanted[c] > 255 ? 255 : wanted[c];
            }
            file->indices[i] = (unsigned char)nearest(palette, from, wanted);
            for (int c = 0; c < 3; c++) {
                const int off = wanted[c] - palette->colors[file->indices[i]][c];
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

// --- pictures

static void put_pixels(struct film_file *file, const struct rectangle *r)
{
    struct lzw *lzw = &file->lzw;
    int code = -1;
    putc(8, lzw->stream); // bits an index
    lzw->bit_count = 0;
    lzw->width = 9;
    clear(lzw);
    for (int y = r->top; y < r->bottom; y++) {
        const unsigned char *row = file->indices + (size_t)y * (size_t)file->shape.width;
        for (int x = r->left; x < r->right; x++) code = code < 0 ? row[x] : add_index(lzw, code, row[x]);
    }
    put_string(lzw, code);
    put_code(lzw, END);
    put_bits(lzw, 1);
    if (lzw->block[0]) put_block(lzw);
    putc(0, lzw->stream);
}

/// When a picture begins, in hundredths of a second.
static long begins(const struct film_file *file, long picture)
{
    return lround(100 * (double)picture / file->shape.rate);
}

static enum film_state put(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error)
{
    (void)wait;
    FILE *stream = file->output.stream;
    struct palette palette;
    const struct rectangle r = compare(file, pixels);
    memset(file->indices, TRANSPARENT, (size_t)file->shape.width * (size_t)file->shape.height);
    choose_colors(file, pixels, &palette);
    draw(file, pixels, &palette);
    fwrite("\x21\xf9\x04\x05", 1, 4, stream); // on top of the last; with transparency
    const long time = begins(file, file->written + 1) - begins(file, file->written);
    put_short(stream, time < LONGEST ? time : LONGEST);
    putc(TRANSPARENT, stream);
    putc(0, stream);
    putc(',', stream);
    put_short(stream, r.left);
    put_short(stream, r.top);
    put_short(stream, r.right - r.left);
    put_short(stream, r.bottom - r.top);
    putc(0x87, stream); // 256 colors of its own
    fwrite(palette.colors, 3, (size_t)palette.count, stream);
    for (int c = palette.count; c < 256; c++) fwrite("\0\0\0", 1, 3, stream);
    put_pixels(file, &r);
    file->written++;
    return !ferror(stream) || file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

static enum film_state finish(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    (void)wait;
    putc(';', file->output.stream);
    *bytes = ftello(file->output.stream);
    return file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

const struct film_file_kind film_gif = {open_gif, put, finish, close_gif};
