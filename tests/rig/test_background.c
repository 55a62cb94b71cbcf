/// The picture or film behind the stage: which picture a frame shows, read at once or ahead in a thread; and what is said where there is none.
#include "documents.h"
#include "folder.h"

#include "base/png.h"
#include "rig/background.h"
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/// Writes a picture of one grey.
static void put_picture(const char *name, int width, int height, int grey)
{
    unsigned char *pixels = malloc((size_t)(4 * width * height));
    assert_non_null(pixels);
    memset(pixels, grey, (size_t)(4 * width * height));
    assert_done(png_write(folder_path(name), width, height, pixels, &error));
    free(pixels);
}

/// An ffmpeg of films of 90 pictures, whose greys are 33 … 122. It makes what it is asked to skip only once.
static const char ffmpeg[] =
    "#!/bin/sh\n"
    "while [ $# -gt 0 ]; do case $1 in -ss) from=$2;; -vf) filter=$2;; -i) film=$2;; esac; shift; done\n"
    "case $film in *broken*) echo nonsense; exit 1;; esac\n"
    "fps=${filter#fps=}; fps=${fps%%:*}; lead=${filter#*start_frame=}; lead=${lead%%,*}\n"
    "echo $from $lead >>\"${film%/*}/asked\"\n"
    "awk \"BEGIN { for (i = int($from * $fps + $lead + 0.5); i < 90; i++) printf \\\"P7\\nWIDTH 1\\nHEIGHT 1\\nDEPTH "
    "4\\n"
    "MAXVAL 255\\nTUPLTYPE RGB_ALPHA\\nENDHDR\\n%c%c%c%c\\\", 33 + i, 33 + i, 33 + i, 33 + i }\"\n";

static char path_before[4096];

static int make(void **state)
{
    char path[sizeof path_before + 80];
    if (folder_make(state) != 0) return -1;
    folder_run("mkdir %s/walk %s/none %s/broken");
    put_picture("walk/f1.png", 2, 1, 10);
    put_picture("walk/f2.jpg", 2, 1, 20);
    put_picture("walk/f10.png", 2, 1, 30);
    put_picture("broken/a.png", 2, 1, 10);
    put_picture("broken/c.png", 2, 1, 30);
    put_picture("large.png", 2560, 100, 40);
    folder_file("walk/notes.txt", "");
    folder_file("walk/.f0.png", "");
    folder_file("broken/b.png", "\x89PNG no more");
    folder_file("film.mp4", "");
    folder_file("film.gif", "");
    folder_file("broken.mp4", "");
    if (chmod(folder_file("ffmpeg", ffmpeg), 0755) != 0) return -1;
    snprintf(path_before, sizeof path_before, "%s", getenv("PATH"));
    snprintf(path, sizeof path, "%s:%s", folder, path_before);
    return setenv("PATH", path, 1);
}

static int clean(void **state)
{
    setenv("PATH", path_before, 1);
    return folder_remove(state);
}

static struct document *document_with(const char *file, int offset)
{
    char text[256];
    snprintf(text, sizeof text,
             "{'frames': [0, 9], 'fps': 30, 'background': {'file': '%s', 'offset': %d, 'later': [1]}}", file, offset);
    struct document *document = document_of_text(json(text));
    document->folder = strdup(folder);
    return document;
}

/// The grey of the picture at a frame, 0 for none, once it is there.
static int grey_at(struct background *background, double frame)
{
    uint64_t id;
    struct png_picture shown = background_at(background, frame, &id);
    for (int i = 0; background_is_behind(background) && i < 60000; i++) {
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        shown = background_at(background, frame, &id);
    }
    return shown.pixels ? shown.pixels[0] : 0;
}

/// Frames, and the grey there; and what is said, once.
static const struct {
    const char *file;
    int offset, count;
    double frame[8];
    int grey[8];
    const char *says;
} rows[] = {
    {"walk", 0, 7, {0, 1, 1.75, 2, 3, 100, -1}, {10, 20, 20, 30, 30, 30, 10}, NULL},
    {"walk", 1, 3, {0, 1, 2}, {20, 30, 30}, NULL},
    {"walk", -100, 4, {99, 100, 101, 102}, {10, 10, 20, 30}, NULL},
    {"walk/f10.png", 7, 2, {0, 50}, {30, 30}, NULL},
    {"large.png", 0, 1, {0}, {40}, NULL},
    {"broken", 0, 4, {0, 1, 2, 1}, {10, 10, 30, 30}, "/broken/b.png: expected PNG or JPEG"},
    {"missing.png", 0, 2, {0, 3}, {0, 0}, "/missing.png: the background is missing"},
    {"none", 0, 1, {0}, {0}, "/none: the background is missing: expected a picture, a film or a folder of .png"},
    {"film.mp4", 0, 8, {0, 1, 5, 80, 3, 45, 89, 500}, {33, 34, 38, 113, 36, 78, 122, 122}, NULL},
    {"film.mp4", -10, 3, {0, 10, 11}, {33, 33, 34}, NULL},
    {"film.mp4", 300, 3, {0, -250, -300}, {122, 83, 33}, NULL}, // beyond its end from the start
    {"film.gif", 0, 5, {80, 60, 2, 89, 90}, {113, 93, 35, 122, 122}, NULL},
    {"broken.mp4", 0, 1, {0}, {0}, "/broken.mp4: ffmpeg cannot read it as a film"},
};

TEST_WITH(make, clean, a_frame_shows_its_picture)
{
    for (size_t i = 0; i < 2 * sizeof rows / sizeof *rows; i++) {
        struct background *background = background_create();
        struct document *document = document_with(rows[i / 2].file, rows[i / 2].offset);
        const bool ahead = i % 2;
        const char *says = rows[i / 2].says;
        struct error error = {0};
        int said = !background_follow(background, document, ahead, &error);
        for (int k = 0; k < rows[i / 2].count; k++) {
            const int grey = grey_at(background, rows[i / 2].frame[k]);
            if (grey != rows[i / 2].grey[k])
                fail_msg("%s, %s: %d on frame %g, expected %d", rows[i / 2].file, ahead ? "ahead" : "at once", grey,
                         rows[i / 2].frame[k], rows[i / 2].grey[k]);
            said += !background_follow(background, document, ahead, &error);
        }
        if (said != (says != NULL) || (says && !strstr(error.text, says)))
            fail_msg("%s said %d times \"%s\"", rows[i / 2].file, said, said ? error.text : "");
        document_destroy(document);
        background_destroy(background);
    }
}

/// Large pictures are made smaller, and a film that goes back is not read from its start.
TEST_WITH(make, clean, no_more_is_read_than_is_shown)
{
    struct background *background = background_create();
    struct document *document = document_with("large.png", 0);
    uint64_t id, other;
    assert_true(background_follow(background, document, false, NULL));
    const struct png_picture shown = background_at(background, 0, &id);
    assert_int_equal(shown.width, 1280);
    assert_int_equal(shown.height, 50);
    background_at(background, 1, &other);
    assert_true(id == other);
    document_destroy(document);

    document = document_with("film.mp4", 0);
    document->serial = 1;
    assert_true(background_follow(background, document, false, NULL));
    assert_int_equal(grey_at(background, 80), 113); // from 77, of which 30 are skipped
    assert_int_equal(grey_at(background, 78), 111);
    assert_int_equal(grey_at(background, 85), 118);
    assert_int_equal(grey_at(background, 20), 53);
    folder_run("printf '1.56666667 30\\n0 17\\n' | cmp - %s/asked");
    document_destroy(document);
    background_destroy(background);
}

/// Another file, rate or scene begins anew; none shows none.
TEST_WITH(make, clean, it_follows_the_document)
{
    struct background *background = background_create();
    struct document *document = document_with("walk", 0);
    struct error error;
    assert_true(background_follow(background, document, true, &error));
    assert_int_equal(grey_at(background, 1), 20);
    document->background.offset = 1;
    document_touch(document);
    assert_true(background_follow(background, document, true, &error));
    assert_int_equal(grey_at(background, 1), 30);
    free(document->background.file);
    document->background.file = strdup("film.mp4");
    document_touch(document);
    assert_true(background_follow(background, document, true, &error));
    assert_int_equal(grey_at(background, 1), 35);
    free(document->background.file);
    document->background.file = NULL;
    document_touch(document);
    assert_true(background_follow(background, document, true, &error));
    assert_int_equal(grey_at(background, 1), 0);
    document_destroy(document);
    background_destroy(background);
}

TEST_WITH(make, clean, a_film_needs_ffmpeg)
{
    struct background *background = background_create();
    struct document *document = document_with("film.mp4", 0);
    uint64_t id;
    setenv("PATH", folder_path("none"), 1);
    assert_true(background_follow(background, document, false, NULL));
    assert_null(background_at(background, 0, &id).pixels);
    assert_refusal(background_follow(background, document, false, &error), "/film.mp4: a film needs ffmpeg");
    assert_true(background_follow(background, document, false, NULL));
    document_destroy(document);
    background_destroy(background);
}

/// The real one, if it is installed: pictures of 10 a second in a scene of 30, in a film and in a .gif.
TEST_WITH(make, clean, ffmpeg_reads_films)
{
    static const char *const films[] = {"real.mkv", "real.gif"};
    if (!quick_or_all(0, 1)) return;
    setenv("PATH", path_before, 1);
    if (system("ffmpeg -version >/dev/null 2>&1") != 0) {
        print_message("skip - films are not read, as ffmpeg is missing\n");
        return;
    }
    folder_run("cd %s && ffmpeg -v error -f lavfi -i \"color=black:s=1600x90:r=10:d=5,format=rgb24,"
               "geq=r='4*N':g='4*N':b='4*N'\" -c:v ffv1 real.mkv && ffmpeg -v error -i real.mkv -vf "
               "'scale=64:-1,split[a][b];[a]palettegen[p];[b][p]paletteuse=dither=none' real.gif");
    for (int i = 0; i < 4; i++) {
        struct background *background = background_create();
        struct document *document = document_with(films[i / 2], 0);
        assert_true(background_follow(background, document, i % 2, NULL));
        for (int k = 0; k < 6; k++) {
            static const double frames[] = {0, 16, 130, 75, 76, 1000};
            assert_near(grey_at(background, frames[k]), 4 * fmin(floor((frames[k] + 0.5) / 3), 49), 4.1);
        }
        assert_true(background_follow(background, document, i % 2, NULL));
        document_destroy(document);
        background_destroy(background);
    }
}
