/// Writes films as GIF (version 89a), each picture with colors of its own and only where it differs from the last.
#include "app/film_file.h"
#include "app/film_palette.h"
#include "base/file.h"
#include "base/need.h"
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

struct film_file {
    struct film_shape shape;
    struct file_output output;
    long written;
    unsigned char *last; ///< the pixels as they were when each was last written
    bool *drawn;
    unsigned char *indices;
    struct palette_maker *maker;
    struct lzw lzw;
};

enum { TRANSPARENT = PALETTE_COLORS, LONGEST = 65535 };
/// Steps of a channel that nobody sees. Without them a film of the fox has 120 % of the bytes.
enum { NOT_SEEN = 1 };

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

static void put_short(FILE *stream, long value)
{
    putc((int)(value & 255), stream);
    putc((int)(value >> 8 & 255), stream);
}

static void close_gif(struct film_file *file)
{
    file_output_discard(&file->output);
    palette_maker_destroy(file->maker);
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
    file->maker = palette_maker_create(shape->width, shape->height);
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
    const struct palette_picture picture = {pixels, file->drawn, file->shape.width, file->shape.height};
    memset(file->indices, TRANSPARENT, (size_t)file->shape.width * (size_t)file->shape.height);
    palette_choose(file->maker, &picture, &palette);
    palette_draw(file->maker, &picture, &palette, file->indices);
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
