/// Encodes films with ffmpeg, which reads raw pictures from standard input and writes a temporary file.
#include "app/film_file.h"
#include "base/file.h"
#include "base/need.h"
#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

struct film_file {
    const char *path;
    size_t size, taken; ///< bytes per picture; bytes of the current picture already sent
    pid_t process;      ///< 0: ended and waited for
    int feed;           ///< our end of its standard input; −1: closed
    FILE *log;          ///< its standard error
    struct file_output output;
};

enum { MAX_ARGUMENTS = 48 };
/// Longest wait in milliseconds before a caller can check whether it should end.
enum { PATIENCE = 100 };

/// ffmpeg writes to its standard output, here a seekable file because .mp4 needs to seek back.
static char output_name[] = "/dev/fd/1";

/// Starts ffmpeg from PATH, without a shell and shielded from the terminal's Ctrl+C. Returns 0 or errno.
static int spawn(struct film_file *file, char *const *arguments, int input)
{
    posix_spawn_file_actions_t files;
    posix_spawnattr_t attributes;
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    sigaddset(&usual, SIGINT);
    sigaddset(&usual, SIGPIPE);
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&files, fileno(file->output.stream), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&files, fileno(file->log), STDERR_FILENO);
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    int cause = posix_spawnp(&file->process, arguments[0], &files, &attributes, arguments, environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    return cause;
}

static int start(struct film_file *file, const struct film_shape *shape)
{
    char size[32], rate[32];
    snprintf(size, sizeof size, "%dx%d", shape->width, shape->height);
    snprintf(rate, sizeof rate, "%.10g", shape->rate);
    char *const input[] = {"ffmpeg",   "-nostdin", "-hide_banner", "-loglevel",   "error", "-f",
                           "rawvideo", "-pix_fmt", "rgba",         "-video_size", size,    "-framerate",
                           rate,       "-i",       "pipe:0",       "-y"};
    char *arguments[MAX_ARGUMENTS] = {NULL};
    int count = 0, ends[2];
    for (size_t i = 0; i < sizeof input / sizeof *input; i++) arguments[count++] = input[i];
    for (char *const *coding = shape->coding; *coding; coding++) arguments[count++] = *coding;
    arguments[count] = output_name;
    // A socket, because writing to one whose reader is gone need not raise SIGPIPE.
    if (!(file->log = tmpfile()) || socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return errno;
    file->feed = ends[0];
    const int cause = spawn(file, arguments, ends[1]);
    close(ends[1]);
    return cause;
}

static void hang_up(struct film_file *file)
{
    if (file->feed >= 0) close(file->feed);
    file->feed = -1;
}

static void close_encoder(struct film_file *file)
{
    hang_up(file);
    if (file->process > 0) {
        kill(file->process, SIGKILL);
        while (waitpid(file->process, NULL, 0) < 0 && errno == EINTR) continue;
    }
    if (file->log) fclose(file->log);
    file_output_discard(&file->output);
    free(file);
}

static struct film_file *open_encoder(const char *path, const struct film_shape *shape, struct error *error)
{
    struct film_file *file = need_zeroed(1, sizeof *file);
    file->path = path;
    file->size = 4 * (size_t)shape->width * (size_t)shape->height;
    file->feed = -1;
    if (file_output_open(&file->output, path, error)) {
        const int cause = start(file, shape);
        if (cause == 0) return file;
        file->process = 0;
        if (cause == ENOENT) {
            fail(error, ERROR_ENVIRONMENT,
                 "%s: ffmpeg, which makes it, is missing: install the package ffmpeg, or write .gif or .png, which "
                 "need nothing",
                 path);
        } else {
            fail(error, ERROR_ENVIRONMENT, "ffmpeg: cannot be run: %s", strerror(cause));
        }
    }
    close_encoder(file);
    return NULL;
}

/// Fails with the last line ffmpeg wrote.
static enum film_state fail_encoder(struct film_file *file, struct error *error)
{
    char words[400] = "it was ended", next[512];
    rewind(file->log);
    while (fgets(next, sizeof next, file->log)) {
        next[strcspn(next, "\r\n")] = '\0';
        if (next[0]) snprintf(words, sizeof words, "%.399s", next);
    }
    fail(error, ERROR_ENVIRONMENT, "%s: ffmpeg cannot write it: %s", file->path, words);
    return FILM_FAILED;
}

/// Closes ffmpeg's input and checks whether it has ended.
static enum film_state end(struct film_file *file, bool wait)
{
    int status;
    hang_up(file);
    pid_t ended = waitpid(file->process, &status, WNOHANG);
    for (int waited = 0; wait && ended == 0 && waited < PATIENCE; waited += 5) {
        poll(NULL, 0, 5);
        ended = waitpid(file->process, &status, WNOHANG);
    }
    if (ended == 0) return FILM_RUNS;
    file->process = 0;
    return ended > 0 && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? FILM_DONE : FILM_FAILED;
}

static enum film_state put(struct film_file *file, const unsigned char *pixels, bool wait, struct error *error)
{
    while (file->taken < file->size) {
        ssize_t sent = send(file->feed, pixels + file->taken, file->size - file->taken, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent >= 0) {
            file->taken += (size_t)sent;
        } else if (errno == EAGAIN || errno == EWOULDBLOCK) {
            if (!wait || poll(&(struct pollfd){file->feed, POLLOUT, 0}, 1, PATIENCE) <= 0) return FILM_RUNS;
        } else if (errno != EINTR) {
            while (end(file, true) == FILM_RUNS) continue; // until its last line is there
            return fail_encoder(file, error);
        }
    }
    file->taken = 0;
    return FILM_DONE;
}

static enum film_state finish(struct film_file *file, bool wait, off_t *bytes, struct error *error)
{
    struct stat about;
    enum film_state state = end(file, wait);
    if (state == FILM_FAILED) return fail_encoder(file, error);
    if (state == FILM_RUNS) return FILM_RUNS;
    *bytes = fstat(fileno(file->output.stream), &about) == 0 ? about.st_size : 0;
    return file_output_commit(&file->output, error) ? FILM_DONE : FILM_FAILED;
}

const struct film_file_kind film_ffmpeg = {open_encoder, put, finish, close_encoder};

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
