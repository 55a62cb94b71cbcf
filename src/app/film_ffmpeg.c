/// Films by ffmpeg, which gets raw pictures through its standard input and writes to a temporary file.
#include "app/film_file.h"
#include "base/file.h"
#include "base/need.h"
#include "platform/child.h"
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

struct film_file {
    const char *path;
    size_t size, taken; ///< bytes of a picture, and of the running one those that ffmpeg has
    struct child *child;
    struct file_output output;
};

enum { MAX_ARGUMENTS = 48 };

/// ffmpeg writes where its standard output goes: a file, in which .mp4 needs to go back.
static char output_name[] = "/dev/fd/1";

static struct film_file *open_encoder(const char *path, const struct film_shape *shape, char *const *coding,
                                      struct error *error)
{
    char size[32], rate[32];
    snprintf(size, sizeof size, "%dx%d", shape->width, shape->height);
    snprintf(rate, sizeof rate, "%.10g", shape->rate);
    char *const input[] = {"ffmpeg",   "-nostdin", "-hide_banner", "-loglevel",   "error", "-f",
                           "rawvideo", "-pix_fmt", "rgba",         "-video_size", size,    "-framerate",
                           rate,       "-i",       "pipe:0",       "-y"};
    char *arguments[MAX_ARGUMENTS] = {NULL};
    int count = 0;
    for (size_t i = 0; i < sizeof input / sizeof *input; i++) arguments[count++] = input[i];
    while (*coding) arguments[count++] = *coding++;
    arguments[count] = output_name;
    struct film_file *file = need_zeroed(1, sizeof *file);
    bool missing = false;
    file->path = path;
    file->size = 4 * (size_t)shape->width * (size_t)shape->height;
    if (file_output_open(&file->output, path, error)) {
        file->child = child_start(arguments, file->output.stream, &missing, error);
        if (file->child) return file;
        if (missing)
            fail(error, ERROR_ENVIRONMENT,
                 "%s: films are made by ffmpeg, which is missing: install the package ffmpeg, or write pictures "
                 "(.png), which need nothing",
                 path);
        file_output_discard(&file->output);
    }
    free(file);
    return NULL;
}

/// Colours as screens have them, and as the file then says.
#define SCREEN_COLORS "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709", "-color_range", "tv"

static struct film_file *open_mp4(const char *path, const struct film_shape *shape, struct error *error)
{
    static char *const coding[] = {"-vf",         "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p",
                                   SCREEN_COLORS, "-c:v",
                                   "libx264",     "-crf",
                                   "18",
                                   "-aq-mode", // bits for dark gradients, which else fall into bands
                                   "3",           "-movflags",
                                   "+faststart",  "-f",
                                   "mp4",         NULL};
    return open_encoder(path, shape, coding, error);
}

static struct film_file *open_webm(const char *path, const struct film_shape *shape, struct error *error)
{
#define WEBM(format)                                                                                                 \
    {                                                                                                                \
        "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=" format, SCREEN_COLORS, "-c:v", "libvpx-vp9",      \
            "-crf", "24", "-b:v", "0", "-deadline", "good", "-cpu-used", "4", "-row-mt", "1", "-f", "webm", NULL     \
    }
    static char *const opaque[] = WEBM("yuv420p"), *const transparent[] = WEBM("yuva420p");
#undef WEBM
    return open_encoder(path, shape, shape->transparent ? transparent : opaque, error);
}

static struct film_file *open_gif(const char *path, const struct film_shape *shape, struct error *error)
{
    static char *const coding[] = {"-filter_complex",
                                   "split[all][some];[some]palettegen=stats_mode=diff[palette];"
                                   "[all][palette]paletteuse=dither=sierra2_4a:diff_mode=rectangle",
                                   "-loop",
                                   "0",
                                   "-f",
                                   "gif",
                                   NULL};
    return open_encoder(path, shape, coding, error);
}

/// Why ffmpeg gave up, in its own words.
static enum film_state fail_encoder(struct film_file *file, struct error *error)
{
    char words[400];
    child_complaint(file->child, words, sizeof words);
    fail(error, ERROR_ENVIRONMENT, "%s: ffmpeg cannot write it: %s", file->path, words[0] ? words : "it was ended");
    return FILM_FAILED;
}

static enum film_state put(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error)
{
    enum child_state state = child_feed(file->child, pixels, file->size, &file->taken, wait);
    if (state == CHILD_RUNS) return FILM_RUNS;
    if (state == CHILD_FAILED) {
        while (child_finish(file->child, true) == CHILD_RUNS) continue; // so that its last words are there
        return fail_encoder(file, error);
    }
    file->taken = 0;
    return FILM_DONE;
}

static enum film_state finish(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    struct stat about;
    enum child_state state = child_finish(file->child, wait);
    if (state == CHILD_RUNS) return FILM_RUNS;
    if (state == CHILD_FAILED) return fail_encoder(file, error);
    *bytes = fstat(fileno(file->output.stream), &about) == 0 ? about.st_size : 0;
    return file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

static void close_encoder(struct film_file *file)
{
    child_end(file->child);
    file_output_discard(&file->output);
    free(file);
}

const struct film_file_kind film_mp4 = {open_mp4, put, finish, close_encoder};
const struct film_file_kind film_webm = {open_webm, put, finish, close_encoder};
const struct film_file_kind film_gif = {open_gif, put, finish, close_encoder};
