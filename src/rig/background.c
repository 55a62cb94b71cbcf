/// Reads the pictures and films behind the stage.
#include "rig/background.h"
#include "base/child.h"
#include "base/need.h"
#include "model/gltf.h"
#include <dirent.h>
#include <limits.h>
#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

enum { WIDEST = 1280, HIGHEST = 720, SIZE = 4 * WIDEST * HIGHEST, MOST_BYTES = 256 << 20 };
/// Pictures that are kept and read ahead; those of a film that are read again for steps back, and read on rather than begin anew.
enum { KEPT = 12, AHEAD = 8, BACK = 3, PATIENCE = 48 };

struct slot {
    int number, width, height; ///< −1: nothing; 0 wide: it could not be read
    unsigned char *pixels;
};

struct background {
    // set while no thread runs
    char path[PATH_LIMIT]; ///< "": none
    uint64_t edits;        ///< of the document
    unsigned serial;
    double fps;
    int offset;
    struct dirent **names; ///< of a folder's pictures
    bool is_film, from_start /* no part of it can be skipped */, threaded;
    pthread_t thread;
    unsigned char *memory;

    // the reader's
    struct slot spare;
    FILE *film; ///< what ffmpeg writes
    struct child decoder;
    int first, next; ///< pictures since ffmpeg was started

    // shared
    pthread_mutex_t lock;
    pthread_cond_t news;
    struct slot kept[KEPT]; ///< by number
    int wanted, last;       ///< INT_MAX: unknown; −1: none
    bool stop;
    struct error error;

    // the caller's
    struct slot shown;
    uint64_t id;
    bool is_behind;
};

enum { PICTURES = 3, GIF = PICTURES, ENDINGS = 9 };

/// The index of a path's ending among those of pictures and films, or ENDINGS.
static int ending(const char *path)
{
    static const char known[ENDINGS][6] = {".png", ".jpg", ".jpeg", ".gif", ".mp4", ".mov", ".webm", ".mkv", ".avi"};
    int i = 0;
    while (i < ENDINGS && !path_has_end(path, known[i])) i++;
    return i;
}

bool background_suits(const char *path)
{
    struct stat status;
    return ending(path) < ENDINGS || (stat(path, &status) == 0 && S_ISDIR(status.st_mode));
}

// --- pictures

static int is_of_folder(const struct dirent *entry)
{
    return entry->d_name[0] != '.' && ending(entry->d_name) < PICTURES;
}

/// Scales a picture down by averaging blocks of whole pixels.
static void shrink(const struct gltf_image *image, struct slot *to)
{
    const double factor = fmax(1, fmax((double)image->width / WIDEST, (double)image->height / HIGHEST));
    const int w = to->width = (int)fmax(1, image->width / factor),
              h = to->height = (int)fmax(1, image->height / factor);
    for (int i = 0; i < w * h; i++) {
        const int x0 = i % w * image->width / w, x1 = (i % w + 1) * image->width / w;
        const int y0 = i / w * image->height / h, y1 = (i / w + 1) * image->height / h;
        int sum[4] = {0};
        for (int y = y0; y < y1; y++) {
            for (int k = 4 * x0; k < 4 * x1; k++) sum[k % 4] += image->pixels[4 * y * image->width + k];
        }
        for (int k = 0; k < 4; k++) to->pixels[4 * i + k] = (unsigned char)(sum[k] / ((x1 - x0) * (y1 - y0)));
    }
}

static void read_picture(struct background *b, int number, struct error *error)
{
    char path[2 * PATH_LIMIT], *bytes;
    struct gltf_image image = {0};
    struct error why;
    size_t size;
    snprintf(path, sizeof path, "%s%s%s", b->path, b->names ? "/" : "", b->names ? b->names[number]->d_name : "");
    b->spare.width = 0;
    if (!file_read(path, MOST_BYTES, &bytes, &size, error)) return;
    if (gltf_decode_image((unsigned char *)bytes, size, MOST_BYTES, &image, &why))
        shrink(&image, &b->spare);
    else
        fail(error, why.kind, "%s: %s", path, why.text);
    free(image.pixels);
    free(bytes);
}

// --- films

static void end_film(struct background *b)
{
    if (!b->film) return;
    fclose(b->film);
    b->film = NULL;
    child_end(&b->decoder);
}

/// Starts ffmpeg, which writes pictures at the scene's frame rate. False if it does not run.
static bool start_film(struct background *b, int first)
{
    const int lead = (int)fmin(first, ceil(b->fps)); // what is shown may have begun a second before
    char from[32], filter[256];
    int ends[2];
    snprintf(from, sizeof from, "%.9g", (first - lead) / b->fps);
    snprintf(filter, sizeof filter,
             "fps=%.10g:start_time=0,trim=start_frame=%d,setpts=PTS-STARTPTS,"
             "scale=min(%d\\,iw):min(%d\\,ih):force_original_aspect_ratio=decrease",
             b->fps, lead, WIDEST, HIGHEST);
    char *const arguments[] = {"ffmpeg", "-nostdin", "-loglevel", "quiet", "-ss",    from, "-i",
                               b->path,  "-map",     "0:v:0",     "-vf",   filter,   "-f", "image2pipe",
                               "-c:v",   "pam",      "-pix_fmt",  "rgba",  "pipe:1", NULL};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return false;
    if (!(b->film = fdopen(ends[0], "rb"))) need_failed();
    const bool runs = child_start(&b->decoder, arguments, -1, ends[1]) == 0;
    close(ends[1]);
    b->first = b->next = first;
    if (runs) return true;
    fclose(b->film);
    b->film = NULL;
    return false;
}

/// Reads the film's next picture, on the way to `number`. −1: none, on failure or at the end, which sets `last`.
static int read_film(struct background *b, int number, int *last, struct error *error)
{
    struct slot *to = &b->spare;
    if (!b->film || number < b->next || (number > b->next + PATIENCE && !b->from_start)) {
        end_film(b);
        if (!start_film(b, b->from_start ? 0 : (int)fmax(0, number - BACK))) {
            fail(error, ERROR_ENVIRONMENT, "%s: a film needs ffmpeg: on a desktop install that package, or use PNGs",
                 b->path);
            return -1;
        }
    }
    if (fscanf(b->film, "P7 WIDTH %d HEIGHT %d DEPTH 4 MAXVAL 255 TUPLTYPE RGB_ALPHA ENDHDR", &to->width,
               &to->height) == 2 &&
        getc(b->film) == '\n' && to->width > 0 && to->width <= WIDEST && to->height > 0 && to->height <= HIGHEST &&
        fread(to->pixels, 4 * (size_t)to->width, (size_t)to->height, b->film) == (size_t)to->height)
        return b->next++;
    end_film(b);
    if (b->next > b->first)
        *last = b->next - 1;
    else if (b->first == 0)
        fail(error, ERROR_INPUT, "%s: ffmpeg cannot read it as a film", b->path);
    else
        b->from_start = true; // it may be shorter: its end is found from there
    return -1;
}

// --- both

/// Reads what is missing; in a thread until it is stopped.
static void *run(void *of)
{
    struct background *b = of;
    pthread_mutex_lock(&b->lock);
    while (!b->stop) {
        int number = b->wanted, last = b->last;
        const int end = (int)fmin(last, number + (b->threaded ? AHEAD : 0));
        struct error error = {0};
        while (number <= end && b->kept[number % KEPT].number == number) number++;
        if (number > end && !b->threaded) break;
        if (number > end) {
            pthread_cond_wait(&b->news, &b->lock);
            continue;
        }
        pthread_mutex_unlock(&b->lock);
        if (b->is_film)
            number = read_film(b, number, &last, &error);
        else
            read_picture(b, number, &error);
        pthread_mutex_lock(&b->lock);
        if (error.kind != ERROR_NONE && b->error.kind == ERROR_NONE) b->error = error;
        b->last = b->is_film && error.kind != ERROR_NONE ? -1 : last;
        if (number < 0 || b->kept[number % KEPT].number == b->wanted) continue; // what is shown stays
        const struct slot old = b->kept[number % KEPT];
        b->kept[number % KEPT] = b->spare;
        b->kept[number % KEPT].number = number;
        b->spare = old;
    }
    pthread_mutex_unlock(&b->lock);
    return NULL;
}

static void leave(struct background *b)
{
    pthread_mutex_lock(&b->lock);
    b->stop = true;
    pthread_cond_signal(&b->news);
    pthread_mutex_unlock(&b->lock);
    if (b->threaded) pthread_join(b->thread, NULL);
    end_film(b);
    for (int i = 0; b->names && i <= b->last; i++) free(b->names[i]);
    free(b->names);
    b->names = NULL;
    b->stop = b->threaded = b->is_behind = false;
    b->error.kind = ERROR_NONE;
    b->wanted = 0;
    b->last = -1;
    b->shown = (struct slot){.number = -1};
}

/// Finds out what the file is, and begins to read it.
static void enter(struct background *b, bool ahead)
{
    struct stat status = {0};
    const int kind = ending(b->path);
    const bool is_folder = stat(b->path, &status) == 0 && S_ISDIR(status.st_mode);
    b->is_film = !is_folder && kind >= PICTURES;
    b->from_start = kind == GIF; // its pictures may last for minutes
    if (is_folder) b->last = scandir(b->path, &b->names, is_of_folder, versionsort) - 1;
    if (S_ISREG(status.st_mode)) b->last = b->is_film ? INT_MAX : 0;
    if (b->last < 0) {
        fail(&b->error, ERROR_INPUT, "%s: the background is missing: expected a picture, a film or a folder of .png",
             b->path);
        return;
    }
    if (!b->memory) b->memory = need(KEPT + 1, SIZE);
    b->spare.pixels = b->memory;
    for (int i = 0; i < KEPT; i++)
        b->kept[i] = (struct slot){.number = -1, .pixels = b->memory + (size_t)(1 + i) * SIZE};
    b->threaded = ahead; // before it starts
    if (ahead && pthread_create(&b->thread, NULL, run, b) != 0) b->threaded = false;
}

struct background *background_create(void)
{
    struct background *b = need_zeroed(1, sizeof *b);
    pthread_mutex_init(&b->lock, NULL);
    pthread_cond_init(&b->news, NULL);
    b->last = -1;
    return b;
}

void background_destroy(struct background *b)
{
    leave(b);
    pthread_cond_destroy(&b->news);
    pthread_mutex_destroy(&b->lock);
    free(b->memory);
    free(b);
}

bool background_follow(struct background *b, const struct document *document, bool ahead, struct error *error)
{
    char path[PATH_LIMIT] = "";
    if (document->edits != b->edits) {
        if (!document_background_path(document, path)) path[0] = '\0';
        const bool same = strcmp(path, b->path) == 0 && document->serial == b->serial && document->fps == b->fps;
        b->edits = document->edits;
        b->offset = document->background.offset;
        if (!same) { // else a thread may read all of this
            leave(b);
            b->serial = document->serial;
            b->fps = document->fps;
            strcpy(b->path, path);
            if (path[0]) enter(b, ahead);
        }
    }
    pthread_mutex_lock(&b->lock);
    const bool good = b->error.kind == ERROR_NONE;
    if (!good && error) *error = b->error;
    b->error.kind = ERROR_NONE;
    pthread_mutex_unlock(&b->lock);
    return good;
}

struct png_picture background_at(struct background *b, double frame, uint64_t *id)
{
    if (!b) return (struct png_picture){0};
    pthread_mutex_lock(&b->lock);
    for (int pass = 0; pass < 2; pass++) { // the first may find the film's end
        b->wanted = (int)fmax(0, fmin(floor(frame + 1e-6) + b->offset, b->last));
        if (b->threaded) break;
        pthread_mutex_unlock(&b->lock);
        run(b);
        pthread_mutex_lock(&b->lock);
    }
    const struct slot *slot = &b->kept[b->wanted % KEPT];
    const bool is_there = b->last >= 0 && slot->number == b->wanted;
    b->is_behind = b->threaded && b->last >= 0 && !is_there;
    if (is_there && slot->width > 0) { // else the one before
        b->id += slot->number != b->shown.number;
        b->shown = *slot;
    }
    pthread_cond_signal(&b->news);
    pthread_mutex_unlock(&b->lock);
    *id = b->id;
    return (struct png_picture){b->shown.width, b->shown.height, 4, b->shown.pixels};
}

bool background_is_behind(const struct background *b) { return b && b->is_behind; }
