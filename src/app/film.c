/// Films a scene: chooses frames and size, draws the pictures and writes them as .gif, with ffmpeg or as numbered files.
#include "app/film.h"
#include "base/child.h"
#include "base/file.h"
#include "base/names.h"
#include "base/need.h"
#include "base/png.h"
#include "draw/draw.h"
#include "editor/editor.h"
#include "platform/platform.h"
#include <ctype.h>
#include <errno.h>
#include <limits.h>
#include <math.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

// === .gif (version 89a): each picture with colors of its own and only where it differs from the last

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
    const char *path;
    struct film_shape shape;
    struct file_output output; ///< of .gif and ffmpeg

    // .gif
    struct pool pool;
    long written;        ///< pictures
    unsigned char *last; ///< the pixels as they were when each was last written
    bool *drawn;
    unsigned char *indices;
    struct cell *cells;
    struct color *colors;
    int *errors; ///< of this row of pixels and the next, with one more at both ends, in sixteenths
    struct lzw lzw;

    // ffmpeg
    size_t size, taken; ///< bytes per picture; bytes of the current picture already sent
    struct child encoder;
    int feed; ///< our end of its standard input; −1: closed

    // .png
    int before, digits; ///< bytes of the path before the number; least number of digits; −1: no number
    const char *after;  ///< the path after the number
    long loose;         ///< pictures written, which are removed if no more come
    off_t bytes;
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

static void clear_codes(struct lzw *lzw)
{
    put_code(lzw, CLEAR);
    memset(lzw->keys, 0, sizeof lzw->keys);
    lzw->next = FIRST_CODE;
    lzw->width = 9;
}

/// Adds an index after the indices that `code` stands for. Returns the code of what is not yet written.
static int add_index(struct lzw *lzw, int code, unsigned char index)
{
    const uint32_t key = ((uint32_t)code << 8 | index) + 1;
    uint32_t place = key * 2654435761U >> 18; // of the key, or the free one where it belongs
    while (lzw->keys[place] && lzw->keys[place] != key) place = (place + 1) % PLACES;
    if (lzw->keys[place]) return lzw->codes[place];
    put_string(lzw, code);
    if (lzw->next == CODES - 1) {
        clear_codes(lzw);
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

static bool open_gif(struct film_file *file, struct error *error)
{
    const struct film_shape *shape = &file->shape;
    const size_t pixels = (size_t)shape->width * (size_t)shape->height;
    file->last = pool_take(&file->pool, pixels, 4);
    file->drawn = pool_take(&file->pool, pixels, sizeof *file->drawn);
    file->indices = pool_take(&file->pool, pixels, 1);
    file->cells = pool_take(&file->pool, CELLS, sizeof *file->cells);
    file->colors = pool_take(&file->pool, pixels < CELLS ? pixels : CELLS, sizeof *file->colors);
    file->errors = pool_take(&file->pool, 2 * 3 * ((size_t)shape->width + 2), sizeof *file->errors);
    if (!file_output_open(&file->output, file->path, error)) return false;
    FILE *stream = file->lzw.stream = file->output.stream;
    fputs("GIF89a", stream);
    put_short(stream, shape->width);
    put_short(stream, shape->height);
    fwrite("\x70\0\0", 1, 3, stream);                               // no colors for all pictures
    fwrite("\x21\xff\x0bNETSCAPE2.0\x03\x01\0\0\0", 1, 19, stream); // forever
    return true;
}

// --- colors

static struct box measure_box(const struct color *colors, int first, int count)
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

static int by_green(const void *a, const void *b)
{
    const unsigned char *x = a, *y = b;
    return x[1] != y[1] ? x[1] - y[1] : x[0] != y[0] ? x[0] - y[0] : x[2] - y[2];
}

/// The colors that suit the drawn pixels best.
static void choose_colors(struct film_file *file, const unsigned char *pixels, struct palette *palette)
{
    const size_t pixel_count = (size_t)file->shape.width * (size_t)file->shape.height;
    struct color *colors = file->colors;
    int color_count = 0;
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
        struct color *color = &colors[color_count++];
        color->count = (float)cell->count;
        for (int c = 0; c < 3; c++) color->value[c] = (float)cell->sum[c] / color->count;
    }
    palette->count = 0;
    if (color_count == 0) return;
    struct box boxes[PALETTE_COLORS] = {measure_box(colors, 0, color_count)};
    int count = 1;
    while (count < PALETTE_COLORS) {
        struct box *most = boxes;
        for (int b = 1; b < count; b++) {
            if (boxes[b].spread > most->spread) most = &boxes[b];
        }
        int below = 0; // the colors below the mean go to the front
        for (int i = 0; i < most->count && most->spread > 0; i++) {
            struct color *color = &colors[most->first + i], *place = &colors[most->first + below];
            if (color->value[most->widest] >= most->mean[most->widest]) continue;
            const struct color moved = *color;
            *color = *place;
            *place = moved;
            below++;
        }
        if (below == 0) break;
        boxes[count++] = measure_box(colors, most->first + below, most->count - below);
        *most = measure_box(colors, most->first, below);
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
static void choose_indices(struct film_file *file, const unsigned char *pixels, const struct palette *palette)
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

static enum film_state put_gif(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error)
{
    (void)wait;
    FILE *stream = file->output.stream;
    struct palette palette;
    const int width = file->shape.width, height = file->shape.height;

    // The pixels that differ, and where they are.
    int left = width, top = height, right = 0, bottom = 0; // the latter two are not within
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            const unsigned char *a = pixels + 4 * i, *b = file->last + 4 * i;
            file->drawn[i] = file->written == 0 || abs(a[0] - b[0]) > NOT_SEEN || abs(a[1] - b[1]) > NOT_SEEN ||
                             abs(a[2] - b[2]) > NOT_SEEN;
            if (!file->drawn[i]) continue;
            memcpy(file->last + 4 * i, pixels + 4 * i, 4);
            left = x < left ? x : left;
            right = x >= right ? x + 1 : right;
            top = y < top ? y : top;
            bottom = y + 1;
        }
    }
    if (right == 0) left = top = 0, right = bottom = 1;
    memset(file->indices, TRANSPARENT, (size_t)width * (size_t)height);
    choose_colors(file, pixels, &palette);
    choose_indices(file, pixels, &palette);
    fwrite("\x21\xf9\x04\x05", 1, 4, stream); // on top of the last; with transparency
    const double before = (double)file->written, rate = file->shape.rate;
    const long time = lround(100 * (before + 1) / rate) - lround(100 * before / rate); // hundredths of a second
    put_short(stream, time < LONGEST ? time : LONGEST);
    putc(TRANSPARENT, stream);
    putc(0, stream);
    putc(',', stream);
    put_short(stream, left);
    put_short(stream, top);
    put_short(stream, right - left);
    put_short(stream, bottom - top);
    putc(0x87, stream); // 256 colors of its own
    fwrite(palette.colors, 3, (size_t)palette.count, stream);
    for (int c = palette.count; c < 256; c++) fwrite("\0\0\0", 1, 3, stream);

    struct lzw *lzw = &file->lzw;
    int code = -1;
    putc(8, stream); // bits an index
    lzw->bit_count = 0;
    lzw->width = 9;
    clear_codes(lzw);
    for (int y = top; y < bottom; y++) {
        const unsigned char *row = file->indices + (size_t)y * (size_t)width;
        for (int x = left; x < right; x++) code = code < 0 ? row[x] : add_index(lzw, code, row[x]);
    }
    put_string(lzw, code);
    put_code(lzw, END);
    put_bits(lzw, 1);
    if (lzw->block[0]) put_block(lzw);
    putc(0, stream);
    file->written++;
    return !ferror(stream) || file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

static enum film_state finish_gif(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    (void)wait;
    putc(';', file->output.stream);
    *bytes = ftello(file->output.stream);
    return file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

const struct film_file_kind film_gif = {open_gif, put_gif, finish_gif};

// === ffmpeg, which reads raw pictures from standard input and writes a temporary file

enum { MAX_ARGUMENTS = 48 };
/// Longest wait in milliseconds before a caller can check whether it should end.
enum { PATIENCE = 100 };

/// ffmpeg writes to its standard output, here a seekable file because .mp4 needs to seek back.
static char output_name[] = "/dev/fd/1";

static bool open_encoder(struct film_file *file, struct error *error)
{
    char size[32], rate[32];
    file->size = 4 * (size_t)file->shape.width * (size_t)file->shape.height;
    snprintf(size, sizeof size, "%dx%d", file->shape.width, file->shape.height);
    snprintf(rate, sizeof rate, "%.10g", file->shape.rate);
    char *const input[] = {"ffmpeg",   "-nostdin", "-hide_banner", "-loglevel",   "error", "-f",
                           "rawvideo", "-pix_fmt", "rgba",         "-video_size", size,    "-framerate",
                           rate,       "-i",       "pipe:0",       "-y"};
    char *arguments[MAX_ARGUMENTS] = {NULL};
    int count = 0, ends[2], cause;
    for (size_t i = 0; i < sizeof input / sizeof *input; i++) arguments[count++] = input[i];
    for (char *const *coding = file->shape.coding; *coding; coding++) arguments[count++] = *coding;
    arguments[count] = output_name;
    if (!file_output_open(&file->output, file->path, error)) return false;
    // A socket, because writing to one whose reader is gone need not raise SIGPIPE.
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) {
        cause = errno;
    } else {
        file->feed = ends[0];
        cause = child_start(&file->encoder, arguments, ends[1], fileno(file->output.stream));
        close(ends[1]);
    }
    if (cause == 0) return true;
    if (cause != ENOENT) return fail(error, ERROR_ENVIRONMENT, "ffmpeg: cannot be run: %s", strerror(cause));
    return fail(error, ERROR_ENVIRONMENT,
                "%s: ffmpeg, which makes it, is missing: install the package ffmpeg, or write .gif or .png, which "
                "need nothing",
                file->path);
}

/// Fails with the last line ffmpeg wrote.
static enum film_state fail_encoder(const struct film_file *file, struct error *error)
{
    char words[400];
    child_last_words(&file->encoder, words, sizeof words);
    fail(error, ERROR_ENVIRONMENT, "%s: ffmpeg cannot write it: %s", file->path, words);
    return FILM_FAILED;
}

/// Closes ffmpeg's input and checks whether it has ended.
static enum child_state end_encoder(struct film_file *file, bool wait)
{
    if (file->feed >= 0) close(file->feed);
    file->feed = -1;
    return child_state(&file->encoder, wait ? PATIENCE : 0);
}

static enum film_state put_encoder(struct film_file *file, const unsigned char *pixels, bool wait,
                                   struct error *error)
{
    while (file->taken < file->size) {
        ssize_t sent = send(file->feed, pixels + file->taken, file->size - file->taken, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) {
            file->taken += (size_t)sent;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            if (!wait || poll(&(struct pollfd){file->feed, POLLOUT, 0}, 1, PATIENCE) <= 0) return FILM_RUNS;
        } else if (errno != EINTR) {
            while (end_encoder(file, true) == CHILD_RUNS) continue; // until its last line is there
            return fail_encoder(file, error);
        }
    }
    file->taken = 0;
    return FILM_DONE;
}

static enum film_state finish_encoder(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    struct stat status;
    const enum child_state state = end_encoder(file, wait);
    if (state == CHILD_FAILED) return fail_encoder(file, error);
    if (state == CHILD_RUNS) return FILM_RUNS;
    *bytes = fstat(fileno(file->output.stream), &status) == 0 ? status.st_size : 0;
    return file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

const struct film_file_kind film_ffmpeg = {open_encoder, put_encoder, finish_encoder};

/// sRGB, also noted in the file.
#define SCREEN_COLORS(format)                                                                                        \
    "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=" format, "-colorspace", "bt709", "-color_primaries",   \
        "bt709", "-color_trc", "bt709", "-color_range", "tv"
/// aq-mode gives dark gradients more bits, against banding.
#define MP4 "-c:v", "libx264", "-crf", "18", "-aq-mode", "3", "-movflags", "+faststart", "-f", "mp4", NULL
#define WEBM                                                                                                         \
    "-c:v", "libvpx-vp9", "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1", "-f",    \
        "webm", NULL

char *const film_mp4[] = {SCREEN_COLORS("yuv420p"), MP4};
char *const film_webm[] = {SCREEN_COLORS("yuv420p"), WEBM};
char *const film_webm_alpha[] = {SCREEN_COLORS("yuva420p"), WEBM};

// === numbered pictures, each written to its place

static bool name_picture(const struct film_file *file, long number, char name[PATH_LIMIT], struct error *error)
{
    int length = file->digits < 0 ? snprintf(name, PATH_LIMIT, "%s", file->path)
                                  : snprintf(name, PATH_LIMIT, "%.*s%s%0*ld%s", file->before, file->path,
                                             strchr(file->path, '%') ? "" : "-", file->digits, number, file->after);
    return length < PATH_LIMIT || fail(error, ERROR_INPUT, "%s: the path is too long", file->path);
}

static bool open_pictures(struct film_file *file, struct error *error)
{
    // The path is split at its "%04d", or before ".png" if there is more than one picture.
    const char *path = file->path, *sign = strchr(path_name(path), '%');
    file->digits = file->shape.count > 1 ? 4 : -1;
    file->before = (int)(strlen(path) - strlen(".png"));
    file->after = path + file->before;
    if (sign) {
        int digits = 1, length = 0;
        if (isdigit((unsigned char)sign[1])) sscanf(sign + 1, "%9d%n", &digits, &length);
        const char *end = sign + 1 + length;
        if (*end != 'd' || digits > 9 || strchr(end, '%'))
            return fail(error, ERROR_USAGE, "%s: expected one number in the name, as in walk-%%04d.png", path);
        file->before = (int)(sign - path);
        file->digits = digits;
        file->after = end + 1;
    }
    for (long n = 1; n <= file->shape.count; n++) { // all places must be free before anything is drawn
        char name[PATH_LIMIT];
        if (!name_picture(file, n, name, error) || !file_check_place(name, error)) return false;
    }
    return true;
}

static enum film_state put_picture(struct film_file *file, const unsigned char *pixels, bool wait,
                                   struct error *error)
{
    char name[PATH_LIMIT];
    struct stat status;
    (void)wait;
    if (!name_picture(file, file->loose + 1, name, error) ||
        !png_write(name, file->shape.width, file->shape.height, pixels, error))
        return FILM_FAILED;
    if (stat(name, &status) == 0) file->bytes += status.st_size;
    file->loose++;
    return FILM_DONE;
}

static enum film_state finish_pictures(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    (void)wait;
    (void)error;
    *bytes = file->bytes;
    file->loose = 0;
    return FILM_DONE;
}

const struct film_file_kind film_png = {open_pictures, put_picture, finish_pictures};

// === the film

struct film_file *film_file_open(const struct film_file_kind *kind, const char *path, const struct film_shape *shape,
                                 struct error *error)
{
    struct film_file *file = need_zeroed(1, sizeof *file);
    file->path = path;
    file->shape = *shape;
    file->feed = -1;
    if (kind->open(file, error)) return file;
    film_file_close(file);
    return NULL;
}

void film_file_close(struct film_file *file)
{
    char name[PATH_LIMIT];
    if (file->feed >= 0) close(file->feed);
    child_end(&file->encoder);
    for (long n = 1; n <= file->loose; n++) {
        if (name_picture(file, n, name, &(struct error){0})) unlink(name);
    }
    file_output_discard(&file->output);
    pool_free(&file->pool);
    free(file);
}

enum { MAX_PICTURES = 10000000, MAX_SIDE = 8192 };

static const struct {
    const struct film_file_kind *kind;
    char *const *coding, *const *alpha; ///< ffmpeg's arguments; with transparency
} writers[] = {
    [FILM_GIF] = {&film_gif, NULL, NULL},
    [FILM_MP4] = {&film_ffmpeg, film_mp4, NULL},
    [FILM_WEBM] = {&film_ffmpeg, film_webm, film_webm_alpha},
    [FILM_PNG] = {&film_png, NULL, NULL},
};

struct film {
    const struct export_format *format;
    const char *path;
    const struct film_file_kind *kind;
    struct film_shape shape;
    bool transparent;
    double first, spacing,
        period; ///< frames: the first picture's, the step, and the loop's length (0: no loop)
    const struct opened *opened;
    bool (*proceed)(void *user, long done, long total);
    void *user;
    struct editor *editor;
    struct picture *picture;
    struct error note; ///< of the background
    struct film_file *file;
    const unsigned char *pixels; ///< drawn but not yet written, else NULL
    long drawn, done;            ///< pictures
    off_t bytes;
};

/// Size, coding, frames and rate.
static bool choose_shape(struct film *film, const struct document *document, const struct export_options *options,
                         struct error *error)
{
    struct film_shape *shape = &film->shape;
    shape->width = options->size[0] > 0 ? options->size[0] : film->format->width;
    shape->height = options->size[1] > 0 ? options->size[1] : film->format->height;
    if (film->format->is_even) {
        shape->width = (shape->width + 1) / 2 * 2;
        shape->height = (shape->height + 1) / 2 * 2;
    }
    if (shape->width > MAX_SIDE || shape->height > MAX_SIDE)
        return fail(error, ERROR_INPUT, "--size: expected at most %d pixels a side, got %d × %d", MAX_SIDE,
                    shape->width, shape->height);
    film->transparent = options->transparent;
    shape->coding = film->transparent ? writers[film->format->film].alpha : writers[film->format->film].coding;
    if (options->transparent && !(film->format->choices & CHOICE_ALPHA))
        return fail(error, ERROR_USAGE, "--transparent: a %s file has no transparency: .webm and .png have",
                    film->format->ending);

    const double first = options->has_frames ? options->first : document->first_frame;
    const double last = options->has_frames ? options->last : document->last_frame;
    const bool loops = export_loops(document);
    if (!(first <= last) || first < document->first_frame || last > document->last_frame)
        return fail(error, ERROR_INPUT, "--frames: expected frames from %d to %d in this order, got %g:%g",
                    document->first_frame, document->last_frame, first, last);
    if (options->loops > 0 && !loops)
        return fail(error, ERROR_INPUT, "--loops: nothing in this scene loops: its end does not meet its start");
    if (options->rate > film->format->most_rate)
        return fail(error, ERROR_INPUT, "--fps: expected at most %g pictures a second in a %s file, got %g",
                    film->format->most_rate, film->format->ending, options->rate);
    shape->rate = options->rate;
    const double count = export_pictures(film->format, document, last - first, options->loops, &shape->rate);
    film->first = first;
    film->spacing = document->fps / shape->rate;
    film->period = options->loops > 0 || (film->format->repeats && loops) ? last - first : 0;
    if (count > MAX_PICTURES)
        return fail(error, ERROR_INPUT, "expected at most %d pictures, got %.0f: choose fewer frames or loops",
                    MAX_PICTURES, count);
    shape->count = (long)count;
    return true;
}

struct film *film_open(const struct opened *opened, const char *path, const struct export_options *options,
                       struct error *error)
{
    struct film *film = need_zeroed(1, sizeof *film);
    film->format = export_format(path);
    film->kind = writers[film->format->film].kind;
    film->path = path;
    film->opened = opened;
    film->proceed = options->proceed;
    film->user = options->user;
    film->editor = editor_create(NULL);
    if (file_check_place(path, error) && choose_shape(film, opened->document, options, error) &&
        (film->picture = picture_create(film->shape.width, film->shape.height, error)) &&
        (film->file = film_file_open(film->kind, path, &film->shape, error))) {
        editor_open(film->editor, &(struct editor_world){.document = opened->document,
                                                         .evaluation = &opened->evaluation,
                                                         .models = opened->models});
        return film;
    }
    film_close(film);
    return NULL;
}

static void draw_next(struct film *film)
{
    const double since = (double)film->drawn++ * film->spacing;
    const double frame = film->first + (film->period > 0 ? fmod(since, film->period) : since);
    background_follow(models_background(film->opened->models), film->opened->document, false, &film->note);
    editor_pose_alone(film->editor, frame, (float)film->shape.width, (float)film->shape.height);
    picture_draw(film->picture, editor_stage(film->editor), film->transparent);
}

enum film_state film_step(struct film *film, bool wait, struct error *error)
{
    if (film->proceed && !film->proceed(film->user, film->done, film->shape.count)) {
        fail(error, ERROR_ENVIRONMENT, "interrupted; nothing was written");
        return FILM_FAILED;
    }
    if (film->done == film->shape.count) return film->kind->finish(film->file, wait, &film->bytes, error);
    if (!film->pixels) {
        if (film->drawn == film->done) draw_next(film);
        film->pixels = picture_take(film->picture, wait);
        if (!film->pixels) return FILM_RUNS;
        if (film->drawn < film->shape.count) draw_next(film); // while this one is written
    }
    enum film_state state = film->kind->put(film->file, film->pixels, wait, error);
    if (state != FILM_DONE) return state;
    film->pixels = NULL;
    film->done++;
    return FILM_RUNS;
}

void film_report(const struct film *film, struct export_report *report)
{
    const double megabytes = (double)film->bytes / 1e6;
    char names[64] = ""; // of the files if they differ from the path
    const char *name = path_name(film->path);
    if (film->kind == &film_png && film->shape.count > 1 && !strchr(name, '%'))
        snprintf(names, sizeof names, ", as %.*s-0001.png and so on", (int)fmin(30, (double)strlen(name) - 4), name);
    *report = (struct export_report){.note = ""};
    snprintf(report->note, sizeof report->note, "%.*s", name_fit(film->note.text, sizeof report->note - 1),
             film->note.text);
    snprintf(report->text, sizeof report->text, "%ld picture%s of %d × %d, %g a second, %.*f MB%s", film->shape.count,
             film->shape.count == 1 ? "" : "s", film->shape.width, film->shape.height, film->shape.rate,
             megabytes < 1 ? 2 : 1, megabytes, names);
}

void film_close(struct film *film)
{
    if (!film) return;
    if (film->file) film_file_close(film->file);
    picture_destroy(film->picture);
    editor_destroy(film->editor);
    free(film);
}

bool film_write(const struct opened *opened, const char *path, const struct export_options *options,
                struct export_report *report, struct error *error)
{
    struct platform *platform = platform_offscreen(1, 1, 1, error);
    if (!platform) return false;
    struct film *film = film_open(opened, path, options, error);
    enum film_state state = film ? FILM_RUNS : FILM_FAILED;
    while (state == FILM_RUNS) state = film_step(film, true, error);
    if (state == FILM_DONE) film_report(film, report);
    film_close(film);
    platform_destroy(platform);
    return state == FILM_DONE;
}
