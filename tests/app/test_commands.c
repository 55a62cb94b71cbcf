/// What commands say and refuse, a row for each: options, what they read, what they would write over.
#include "folder.h"

#include "commands/commands.h"
#include <dirent.h>
#include <ftw.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { LINE = 4096 };
#define COUNT(rows) (sizeof(rows) / sizeof *(rows))

static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {{"live", command_live},       {"solve", command_solve}, {"rig", command_rig},
                {"export", command_export},   {"check", command_check}, {"simulate", command_simulate},
                {"analyze", command_analyze}, {"flesh", command_flesh}};

/// What the last child has said.
static struct {
    int status;              ///< its exit status; −1 if a signal ended it
    char out[1 << 17], *err; ///< standard output and, in the same storage, standard error
} command;

/// A command line without `wiggly`, its words apart by one space.
static int call(const char *line)
{
    static char own[LINE];
    char *words[256], *rest = own;
    int count = 0;
    snprintf(own, sizeof own, "%s", line);
    for (char *word; (word = strsep(&rest, " "));) words[count++] = word;
    words[count] = NULL;
    for (size_t i = 0; i < COUNT(commands); i++)
        if (strcmp(words[0], commands[i].name) == 0) return commands[i].run(count, words);
    return -1;
}

/// Calls it in a child whose working folder is the test's.
static void run(int (*called)(const char *line), const char *line)
{
    const int files[] = {memfd_create("out", 0), memfd_create("err", 0)};
    int status;
    char *text = command.out;
    fflush(NULL);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        dup2(files[0], STDOUT_FILENO);
        dup2(files[1], STDERR_FILENO);
        signal(SIGXFSZ, SIG_IGN);
        file_guard_reads(true);
        exit(chdir(folder) == 0 ? called(line) : 99);
    }
    assert_int_equal(waitpid(child, &status, 0), child);
    command.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    for (int i = 0; i < 2; i++) {
        const ssize_t size = pread(files[i], text, (size_t)(command.out + sizeof command.out - text - 1), 0);
        assert_true(size >= 0);
        if (i == 1) command.err = text;
        text += size;
        *text++ = '\0';
        close(files[i]);
    }
}

static FILE *listing;

static int list(const char *path, const struct stat *about, int type, struct FTW *at)
{
    (void)type, (void)at;
    return fprintf(listing, "%s %lu %lo %ld %ld.%ld\n", path, (unsigned long)about->st_ino,
                   (unsigned long)about->st_mode, (long)about->st_size, (long)about->st_mtim.tv_sec,
                   (long)about->st_mtim.tv_nsec) < 0;
}

/// A text that tells whether anything in the folder was changed. The caller frees it.
static char *list_folder(void)
{
    char *text;
    size_t size;
    listing = open_memstream(&text, &size);
    assert_int_equal(nftw(folder, list, 8, FTW_PHYS), 0);
    fclose(listing);
    return text;
}

/// The text has each part of `parts`, which are apart by "|".
static bool has(const char *text, const char *parts)
{
    char all[512], *rest = all;
    assert_true((size_t)snprintf(all, sizeof all, "%s", parts) < sizeof all);
    for (char *part; (part = strsep(&rest, "|"));)
        if (!strstr(text, part)) return false;
    return true;
}

/// The command ends so and says this. One that fails says one line, on stderr, and leaves the folder as it is.
static void expect(int status, const char *line, const char *says)
{
    char *before = status ? list_folder() : NULL;
    run(call, line);
    char *after = status ? list_folder() : NULL;
    if (command.status != status)
        fail_msg("wiggly %s: exit status %d, expected %d\n%s%s", line, command.status, status, command.out,
                 command.err);
    if (!has(command.err, says) && (status != 0 || !has(command.out, says)))
        fail_msg("wiggly %s: \"%s\" is not in:\n%s%s", line, says, command.out, command.err);
    if (strchr(command.err, '\x1b')) fail_msg("wiggly %s: a control character is printed", line);
    if (status != 0 && strchr(command.err, '\n') != strrchr(command.err, '\n'))
        fail_msg("wiggly %s: more than a line:\n%s", line, command.err);
    if (status != 0 && strcmp(before, after) != 0) fail_msg("wiggly %s: changes\n%sto\n%s", line, before, after);
    free(before);
    free(after);
}

/// The same, of lines with a %s.
static void expect_each(int status, const char *format, const char *says_format, const char *word)
{
    char line[128], says[128];
    snprintf(line, sizeof line, format, word, word);      // NOLINT
    snprintf(says, sizeof says, says_format, word, word); // NOLINT
    expect(status, line, says);
}

static void copy(const char *name, const char *from, size_t most)
{
    char *data;
    size_t size;
    assert_done(file_read(from, 1 << 24, &data, &size, &error));
    assert_done(file_write_atomic(folder_path(name), data, size < most ? size : most, &error));
    free(data);
}

#define BOX_VERTICES "v 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 2 0\nv 1 2 0\nv 1 2 1\nv 0 2 1\n"
#define BOX_FACES "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
#define BOX "v 0 0 0\n" BOX_VERTICES BOX_FACES
#define THREE(file)                                                                                                  \
    "{\"asset\": {\"version\": \"2.0\"}, \"buffers\": [{\"uri\": \"" file "\", \"byteLength\": 36}], "               \
    "\"bufferViews\": [{\"buffer\": 0, \"byteLength\": 36}], \"accessors\": [{\"bufferView\": 0, "                   \
    "\"componentType\": 5126, \"count\": 3, \"type\": \"VEC3\"}], \"meshes\": [{\"primitives\": [{\"attributes\": "  \
    "{\"POSITION\": 0}}]}], \"nodes\": [{\"name\": \"n\", \"mesh\": 0}], \"scenes\": [{\"nodes\": [0]}]}"
#define SHOWS(file)                                                                                                  \
    "{\"wiggly\": 1, \"frames\": [0, 9], \"splines\": [{\"name\": \"s\"}], \"rigs\": [{\"type\": \"model\", "        \
    "\"model\": \"" file "\"}]}"
#define LONG(frames)                                                                                                 \
    "{\"wiggly\": 1, \"fps\": 1, \"frames\": [0, " frames "], \"splines\": [{\"name\": \"s\"}], \"rigs\": "          \
    "[{\"type\": \"tail\", \"name\": \"t\", \"spline\": \"s\"}]}"

static const struct {
    const char *name, *text;
} files[] = {
    {"box.obj", BOX},
    {"rest.obj", BOX},
    {"cube.rest.obj", BOX},
    {"bright.obj", "v 0 0 0 1e30 0 0\n" BOX_VERTICES BOX_FACES},
    {"four.obj", "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3 4\n"},
    {"flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n"},
    {"far.obj", "v 1e31 90 90\nv 0 0 0\n" BOX_VERTICES BOX_FACES},
    {"open.obj", "v 0 0 0\n" BOX_VERTICES "f 1 2 3 4\nf 8 7 6 5\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5\n"},
    {"flag.obj", "v 0 0 0\nv .5 0 0\nv 1 0 0\nv 0 1 0\nv .5 1 0\nv 1 1 0\nf 1 2 5 4\nf 2 3 6 5\n"},
    {"three.gltf", THREE("three.bin")},
    {"three.json", SHOWS("three.gltf")},
    {"odd.gltf", THREE("w-0002.png")}, // as pictures of a film are called
    {"odd.json", SHOWS("odd.gltf")},
    {"shots.gltf", THREE("sub/frame_00000.png")},
    {"shots.json", SHOWS("shots.gltf")},
    {"keys.json", LONG("90009")},
    {"film.json", LONG("41841")},
    {"bad.json", "{\"frames\": [9, 0], \"fps\": -1,\n\"splines\": [{\"name\": 3}]}"},
    {"c.json", "{\"frames\": [0, 9], \"splines\": [{\"name\": \"s\", \"knots\": [{\"frame\": 0, \"value\": 1}]}]}"},
    {"none.json", "{\"frames\": [0, 1]}"},
    {"names.json", // frames before zero and between frames, few digits and many
     "{\"frames\": [-1, 0], \"substeps\": 3, \"splines\": [{\"name\": \"a,b\", \"mode\": \"cubic\", \"knots\": "
     "[{\"frame\": 0, \"value\": 0.1}]}, {\"name\": \"say \\\"hi\\\"\", \"mode\": \"cubic\"}, {\"name\": "
     "\"two\\nlines\", \"mode\": \"cubic\"}]}"},
    {"loose.json", "{\"frames\": [0, 48], \"splines\": [{\"name\": \"loose\", \"frequency\": 1, \"calm\": 0, "
                   "\"knots\": [{\"frame\": 0, \"value\": 0}, {\"frame\": 24, \"value\": 1}]}]}"},
    {"pinned.json",
     "{\"frames\": [0, 48], \"splines\": [{\"name\": \"sway\", \"frequency\": 1, \"limits\": [-1, 1], \"knots\": "
     "[{\"frame\": 0, \"value\": 0}]}], \"rigs\": [{\"type\": \"tail\", \"name\": \"tail\", \"spline\": \"sway\", "
     "\"pins\": [{\"frame\": 20, \"joint\": 23, \"to\": [0, 9, 0]}]}]}"},
    {"gone.json", "{\"frames\": [0, 1], \"background\": {\"file\": \"gone.mp4\"}}"},
    {"sunk.json", "{\"frames\": [0, 24], \"splines\": [{\"name\": \"up\", \"frequency\": 1, \"knots\": [{\"frame\": "
                  "0, \"value\": 0}, {\"frame\": 20, \"value\": -8}]}], \"rigs\": [{\"type\": \"character\", "
                  "\"name\": \"soft\", \"model\": \"assets/models/creature.glb\", \"floor\": 0, \"coordinates\": "
                  "[{\"name\": \"up\", \"spline\": \"up\", \"amplitude\": 4}]}]}"},
    {"tiny.npy", "no"},
    {"broken.simulation.json", "{\"fps\": 0}"},
    {"a.FBX", "Kaydara FBX Binary"},
    {"hello.replay", "hello\n"},
    {"other.replay", "wiggly-replay 1\nsize 640 480\nscale 1\nscene 1\nframes 2\n"},
    {"old.csv", "old"},
    {"there.csv", ""},
};

#define QUICK "--tets 60 --seconds 0.25 --fps 24 --substeps 2 "
#define SOFT(map) "simulate box.obj --soft " map " " QUICK "-o x.npy"
#define BLIND "live --no-draw --frames 2 "
#define DRAWN "live --headless --frames 2 "
#define OVER(input) "cannot be written, because it is read as " input
#define UNREAD_PIPE "pipe.csv: cannot be written: it is a pipe that nobody reads"
#define NO_FILE "expected a file, got something else (a device or a pipe)"
#define FBX "a.FBX: expected glTF, got FBX: export it from Blender as glTF, or run tools/from-fbx.sh on it"

static const float half[] = {.5f, .5f, .5f, .5f, .5f, .5f, .5f, .5f, .5f}, above[8] = {2},
                   below[] = {0, 0, 0, 0, 0, 0, 0, -.5f}, wild[] = {0, 0, 0, 0, 0, 0, 0, NAN};

/// .npy arrays of float32; so many bytes of them.
static const struct {
    const char *name, *shape;
    const float *numbers;
    size_t bytes;
} maps[] = {
    {"map.npy", "(8,)", half, 32},    {"short.npy", "(8,)", half, 24},
    {"long.npy", "(9,)", half, 36},   {"huge.npy", "(8, 4611686018427387904)", half, 32},
    {"wild.npy", "(8,)", wild, 32},   {"above.npy", "(8, 1)", above, 32},
    {"below.npy", "(8,)", below, 32}, {"paint.npy", "(1, 4, 2)", half, 32},
};

static const char *const links[][2] = {
    {"s.json", "soft.csv"}, {".", "here"}, {"dog.glb", "walk.glb"}, {"/dev/full", "full"}, {"there.csv", "link.csv"}};

static int open_folder(void **state)
{
    static const char zeros[36];
    static const char *const binary[] = {"three.bin", "w-0002.png", "sub/frame_00000.png"};
    static const char *const pipes[] = {"pipe.csv", "pipe.gif", "pipe.json"};
    char text[PATH_LIMIT], place[PATH_LIMIT - 16], about[118], *dog;
    size_t size;
    if (folder_make(state) != 0 || mkdir(folder_path("sub"), 0700) != 0 || !getcwd(place, sizeof place)) return -1;
    for (int i = 0; i < 2; i++) { // what the rows name as from the root of the tree
        snprintf(text, sizeof text, "%s/%s", place, i ? "tests" : "assets");
        assert_int_equal(symlink(text, folder_path(i ? "tests" : "assets")), 0);
    }
    for (size_t i = 0; i < COUNT(files); i++) folder_file(files[i].name, files[i].text);
    for (int i = 0; i < 3; i++) assert_done(file_write_atomic(folder_path(binary[i]), zeros, 36, &error));
    copy("s.json", "assets/scenes/tail.json", SIZE_MAX);
    copy("dog.glb", "assets/models/dog.glb", SIZE_MAX);
    copy("cut.glb", "assets/models/dog.glb", 5000);
    assert_done(file_read("assets/scenes/dog.json", 1 << 24, &dog, &size, &error));
    char *model = strstr(dog, "../models/dog.glb");
    memmove(model, model + strlen("../models/"), strlen(model + strlen("../models/")) + 1);
    folder_file("dog.json", dog);
    free(dog);
    for (size_t i = 0; i < COUNT(links); i++) assert_int_equal(symlink(links[i][0], folder_path(links[i][1])), 0);
    assert_int_equal(link(folder_path("s.json"), folder_path("hard.csv")), 0);
    assert_int_equal(link(folder_path("there.csv"), folder_path("twin.csv")), 0);
    for (int i = 0; i < 3; i++) assert_int_equal(mkfifo(folder_path(pipes[i]), 0600), 0);
    for (size_t i = 0; i < COUNT(maps); i++) {
        snprintf(about, sizeof about, "{'descr': '<f4', 'fortran_order': False, 'shape': %s, }", maps[i].shape);
        snprintf(text, sizeof text, "\x93NUMPY\x01%c\x76%c%-117s\n", 1, 1, about);
        text[7] = text[9] = 0;
        memcpy(text + 128, maps[i].numbers, maps[i].bytes);
        assert_done(file_write_atomic(folder_path(maps[i].name), text, 128 + maps[i].bytes, &error));
    }
    assert_done(file_write_atomic(folder_path("endless.npy"), "\x93NUMPY\1\0\xff\xff{ and no more", 23, &error));
    assert_done(file_write_atomic(folder_path("header.npy"), "\x93NUMPY\1\0\x76\0{ and no more", 23, &error));
    expect(0, "simulate rest.obj --tets 60 --seconds 2 --fps 30 --substeps 2 --drive none -o up.npy",
           "up.npy: 60 frames");
    copy("up.rest.obj", folder_path("rest.obj"), SIZE_MAX);
    copy("broken.npy", folder_path("up.npy"), SIZE_MAX);
    copy("found.npy", folder_path("up.npy"), SIZE_MAX);
    copy("cut.npy", folder_path("up.npy"), 1000);
    expect(0, BLIND "--record r.replay s.json", "");
    return 0;
}

TESTS_BETWEEN(open_folder, folder_remove)

TEST(every_command_has_help_and_names_the_nearest_option)
{
    for (size_t i = 0; i < COUNT(commands); i++) {
        expect_each(0, "%s --help", "Usage: wiggly %s", commands[i].name);
        expect_each(2, "%s --hlep", "unknown option --hlep (did you mean --help?)", commands[i].name);
    }
    expect(0, "live --help", "--ui-scale");
    assert_null(strstr(command.out, "--replay"));
    expect(0, "live --help-all", "--replay");
}

static const struct {
    const char *option, *below, *least, *most, *above;
} ranges[] = {
    {"live --frames", "0", "1", "10000000", "10000001"},
    {"live --size", "319x320", "320x320", "8192x8192", "8192x8193"},
    {"live --scale", "0.49999", "0.5", "4", "4.00001"},
    {"live --ui-scale", "0.7499", "0.75", "3", "3.001"},
    {"export --fps", "0.00099", "0.001", "100000", "100000.1"},
    {"export --substeps", "0", "1", "1024", "1025"},
    {"export --size", "15x16", "16x16", "8192x8192", "8193x16"},
    {"export --loops", "0", "1", "10000", "10001"},
    {"flesh --depth", "-0.1", "0", "1000000", "1000001"},
    {"flesh --amplitude", "-2.01", "-2", "2", "2.01"},
    {"flesh --modes", "0", "1", "8", "9"},
    {"flesh --fps", "0.99", "1", "1000", "1000.1"},
    {"rig --frequency", "0.00099", "0.001", "1000", "1000.1"},
    {"rig --damping", "0", "0.000001", "1", "1.00001"},
    {"analyze --fps", "0.00099", "0.001", "100000", "100000.1"},
    {"analyze --modes", "0", "1", "8", "9"},
    {"analyze --lag", "-3600.1", "-3600", "3600", "3600.1"},
    {"analyze --from", "-0.1", "0", "1000000", "1000001"},
    {"simulate --scale", "9e-10", "1e-09", "1000000000", "1000000001"},
    {"simulate --amplitude", "-2.01", "-2", "2", "2.01"},
    {"simulate --drive-frequency", "0.00099", "0.001", "1000", "1000.1"},
    {"simulate --seconds", "0.00099", "0.001", "3600", "3600.1"},
    {"simulate --fps", "0.99", "1", "1000", "1000.1"},
    {"simulate --accuracy", "0.000099", "0.0001", "1", "1.01"},
    {"simulate --substeps", "0", "1", "1000", "1001"},
    {"simulate --tets", "49", "50", "200000", "200001"},
    {"simulate --frequency", "0.00099", "0.001", "1000", "1000.1"},
    {"simulate --softness", "0.00099", "0.001", "1000", "1000.1"},
    {"simulate --poisson", "-0.01", "0", "0.49", "0.4901"},
    {"simulate --damping", "-0.01", "0", "1", "1.01"},
    {"simulate --gravity", "-0.1", "0", "10000", "10000.1"},
    {"simulate --floor", "-0.1", "0", "1000000", "1000001"},
};

/// Calls a line again and again; returns 1 and says what is wrong unless each is refused with these words.
static int refuse(const char *line, const char *says)
{
    char text[512];
    assert_int_equal(ftruncate(STDERR_FILENO, 0), 0);
    lseek(STDERR_FILENO, 0, SEEK_SET);
    const int status = call(line);
    fflush(stderr);
    const ssize_t size = pread(STDERR_FILENO, text, sizeof text - 1, 0);
    text[size > 0 ? size : 0] = '\0';
    if (status == 2 && strstr(text, says) && strchr(text, '\n') == strrchr(text, '\n')) return 0;
    printf("wiggly %s: exit status %d, and \"%s\" is not in:\n%s", line, status, says, text);
    return 1;
}

/// The ends of a range are taken (then the option behind is what is wrong), what lies beyond is not.
static int try_range(const char *row)
{
    const size_t i = strtoul(row, NULL, 10);
    const char *const values[] = {
        ranges[i].least, ranges[i].most, ranges[i].below, ranges[i].above, "nan", "inf", "1e999", "", "1,5"};
    char line[128], says[64];
    int wrong = 0;
    for (int v = 0; v < 9; v++) {
        snprintf(line, sizeof line, "%s=%s --nonsense", ranges[i].option, values[v]);
        snprintf(says, sizeof says, "%s: expected", strchr(ranges[i].option, ' ') + 1);
        wrong |= refuse(line, v < 2 ? "--nonsense" : says);
    }
    return wrong;
}

TEST(ranges_of_options)
{
    char *before = list_folder(), row[32];
    for (size_t i = 0; i < COUNT(ranges); i++) {
        snprintf(row, sizeof row, "%zu", i);
        run(try_range, row);
        if (command.status != 0) fail_msg("%s%s", command.out, command.err);
    }
    char *after = list_folder();
    assert_string_equal(after, before);
    free(before);
    free(after);
}

/// Chains of a rig, and motions of an analysis.
TEST(options_that_are_given_many_times)
{
    static const struct {
        const char *command, *again, *end, *taken, *refused;
        int most;
    } many[] = {{"rig", " --chain a:b", " --nonsense", "--nonsense", "at most 32 times", 32},
                {"analyze --rest mesh.obj", " motion.npy", "", "-o creature.glb", "motion.npy", 16}};
    char line[LINE];
    for (int i = 0; i < 6; i++) {
        const int times = many[i / 3].most - 1 + i % 3;
        int n = sprintf(line, "%s", many[i / 3].command);
        for (int k = 0; k < times; k++) n += sprintf(line + n, "%s", many[i / 3].again);
        strcpy(line + n, many[i / 3].end);
        expect(2, line, times > many[i / 3].most ? many[i / 3].refused : many[i / 3].taken);
    }
}

static const struct {
    int status;
    const char *line, *says;
} rows[] = {
    // the table of options: values in every spelling, names that look like options, and what is refused
    {0, "solve --solver=band --output=b.csv c.json", ""},
    {0, "solve c.json -o no/b.csv --output=b.csv", ""}, // the last counts
    {1, "solve -- --help", "--help: cannot be opened"},
    {1, "solve -", "-: cannot be opened"}, // by itself it is a name
    {0, "solve c.json -o --help", ""},     // a value may begin with a dash
    {2, "solve c.json c.json", "'c.json' is one argument too many"},
    {2, "solve ", "expected scene.json, got an empty argument"},
    {2, "solve -x", "unknown option -x"},
    {2, "solve --outptu", "unknown option --outptu (did you mean --output?)"},
    {2, "export s.json --quiet=yes", "--quiet takes no value"},
    {2, "solve c.json -o", "--output needs a value"},
    {2, "solve c.json --output=", "--output: expected FILE, got nothing"},
    {2, "solve c.json --out=b.csv", "unknown option --out"},
    {2, "solve c.json --solver", "--solver needs a value: chain|band"},
    {2, "solve c.json --solver=", "--solver: expected chain or band, got ''"},
    {2, "solve c.json --solver Band", "--solver: expected chain or band, got 'Band'"},
    {2, "solve c.json --solver ban", "--solver: expected chain or band, got 'ban'"},
    {2, "solve c.json --solver bands", "--solver: expected chain or band, got 'bands'"},
    {2, "live --frames 7x", "--frames: expected a whole number"},
    {2, "live --frames 99999999999999999999", "--frames: expected a whole number"},
    {2, "live --size 1280x", "--size: expected"},
    {2, "live --size 1280x720x2", "--size: expected WIDTHxHEIGHT, each from 320 to 8192, got '1280x720x2'"},
    {2, "live --size 1280x9000", "--size: expected"},
    {2, "live --scale 0.5x", "--scale: expected a number from 0.5 to 4, got '0.5x'"},
    // live
    {2, "live --frames", "--frames needs a value"},
    {2, "live --frames ten", "expected a whole number from 1 to 10000000, got 'ten'"},
    {2, "live --size 1280", "--size: expected"},
    {2, "live --theme pink", "--theme: expected"},
    {2, "live --solver tree", "--solver: expected chain or band, got 'tree'"},
    {2, "live --turns third", "--turns: expected"},
    {2, BLIND "--screenshot x.png", "--no-draw: expected no --screenshot"},
    {2, BLIND "--saves sub s.json", "--saves is for what a replay writes: expected --replay, too"},
    {1, BLIND "missing.json", "missing.json: cannot be opened"},
    {1, BLIND "three.bin", "three.bin"},
    {1, BLIND "pipe.json", "pipe.json: expected a file, got something else"},
    {1, BLIND "a.FBX", FBX},
    {1, "live --no-draw --replay none.replay s.json", "none.replay"},
    {1, "live --no-draw --replay hello.replay s.json", "hello.replay:1: expected \"wiggly-replay 1\", got \"hello\""},
    {1, "live --no-draw --replay other.replay s.json", "recorded on another scene"},
    {3, BLIND "--log no/live.csv", "no/live.csv"},
    {3, BLIND "--log pipe.csv s.json", UNREAD_PIPE},
    {3, BLIND "--record pipe.csv s.json", UNREAD_PIPE},
    {3, BLIND "--result pipe.csv s.json", UNREAD_PIPE},
    {3, DRAWN "--screenshot pipe.csv s.json", UNREAD_PIPE},
    {2, "live --frames \x1b[31m", "got '\\x1b[31m'"}, // nothing of a terminal's own
    // solve, check and log
    {2, "solve", "scene.json"},
    {2, "solve --\x1b[31m", "unknown option --\\x1b[31m"},
    {2, "check a.json b.json", "'b.json'"},
    {1, "solve missing.json", "missing.json"},
    {1, "solve bad.json -o old.csv", "bad.json:1: "},
    {3, "solve c.json -o no/out.csv", "no/out.csv"},
    {3, "solve c.json -o full", "full: cannot be written: No space left on device"},
    {3, "solve c.json -o pipe.csv", UNREAD_PIPE},
    {0, "solve none.json", "frame\n0\n1\n"},
    {0, "solve names.json", // quotes as RFC 4180 wants
     "frame,\"a,b\",\"a,b.re\",\"a,b.im\",\"say \"\"hi\"\"\",\"say \"\"hi\"\".re\",\"say "
     "\"\"hi\"\".im\",\"two\nlines\",\"two\nlines.re\",\"two\n"
     "lines.im\"\n-1,0.10000000000000001,0.10000000000000001,0,0,0,0,0,0,0\n-0.6666666666666667,"},
    {0, "solve loose.json", "\"loose\": "},
    {0, "check loose.json", "warning: "},
    {0, "check pinned.json",
     "pinned.json: rigs[0].pins[0]: the point stays 9.|splines[0].limits: ignored, because pins or a floor move this "
     "spline"},
    {0, "solve pinned.json", "warning: rigs[0].pins[0]: the point stays 9."},
    {0, "solve gone.json", "frame\n0\n1\n"},
    {0, "check sunk.json", "sunk.json: rigs[0].floor: knots and pins hold the character up to "},
    {0, "check tests/vectors/loop_moving_equilibrium.json",
     "the equilibrium of this loop does not end where it starts"},
    {1, "check a.FBX", FBX},
    // export
    {2, "export s.json", "-o"},
    {2, "export s.json -o x.fbx", ".glb, .gltf, .usda, .bvh, .csv, .pc2, .mdd, .npy, .gif, .mp4, .webm or .png"},
    {2, "export s.json -o x.glb --frames 24", "--frames"},
    {2, "export s.json -o x.glb --fps 24 --substeps 2", "--substeps"},
    {2, "export dog.json --all-clips --frames 1:9 -o x.glb", "--all-clips"},
    {2, "export s.json -o x.mp4 --transparent", ".webm and .png have"},
    {2, "export s.json -o %d-%d.png", "walk-%04d.png"},
    {1, "export assets/scenes/character.json -o x.bvh", "export it as .glb, .gltf, .usda, .csv, .pc2, .mdd or .npy"},
    {1, "export assets/scenes/figure1.json -o x.mp4 --loops 2", "nothing in this scene loops"},
    {1, "export s.json -o x.mp4 --frames 0:500", "--frames"},
    {1, "export s.json -o x.gif --fps 51", "expected at most 50 pictures a second in a .gif file, got 51"},
    {3, "export s.json -o no/x.glb", "no/x.glb: cannot be written"},
    {3, "export s.json --frames 0:1 --size 64x36 -o no/x.png", "no/x-0001.png: cannot be written"},
    {3, "export s.json --frames 0:1 --size 64x36 -o pipe.csv", NO_FILE},
    {3, "export s.json --frames 0:1 --size 64x36 -o pipe.gif", NO_FILE},
    // at the limit it is the folder that is wrong
    {3, "export keys.json --fps 1111 -o no/x.csv", "no/x.csv: cannot be written"},
    {1, "export keys.json --fps 1111.00002 -o no/x.csv", "at most 100000000 keys, got 100000001"},
    {3, "export film.json --fps 239 -o no/x.mp4", ""},
    {1, "export film.json --fps 239.00003 -o no/x.mp4", "at most 10000000 pictures, got 10000001"},
    // rig
    {1, "rig assets/models/creature.glb --chain arm -o o.glb",
     "creature.glb: expected a bone called \"arm\", got none"},
    {1, "rig none.glb", "none.glb"},
    {1, "rig cut.glb", "cut.glb"},
    {1, "rig a.FBX", FBX},
    {1, "rig dog.glb --chain wing -o x.json", "expected a bone called \"wing\", got none"},
    {1, "rig dog.glb --chain chest -o x.json", "\"chest\" branches into"},
    {1, "rig dog.glb --clip Fly --chain tail_1 -o x.json", "expected a clip called \"Fly\""},
    {2, "rig s.json", ""},
    {2, "rig dog.glb --chain tail_1", "-o"},
    {2, "rig dog.glb --chain tail_1 -o x.fbx", ".json"},
    {2, "rig dog.glb --chain tail_1 --loop --once -o x.json", "--once"},
    {2, "rig dog.glb --chain tail_1 --all-clips -o x.json", "--all-clips"},
    {2, "rig dog.glb --chain tail_1 --all-clips -o x.usda", "x.usda: holds one clip: all clips need .glb or .gltf"},
    {3, "rig dog.glb --chain tail_1 -o no/x.json", "no/x.json: cannot be written"},
    // flesh
    {1, "flesh dog.glb --part tial_1 -o x.glb",
     "dog.glb: expected a bone for --part, got \"tial_1\" (did you mean \"tail_1\"?)"},
    {1, "flesh dog.glb --part paint.npy -o x.glb",
     "paint.npy: expected paint for a skinned mesh of |dog.glb, got paint for 4 vertices"},
    {1, "flesh assets/models/creature.glb -o x.glb", "creature.glb: expected a mesh with a skin, got none"},
    {1, "flesh none.glb -o x.glb", "none.glb"},
    {1, "flesh dog.glb --depth 9 -o x.glb", "nothing can move: all of it is within 9 m of a bone"},
    {1, "flesh dog.glb --part tail_1 --tets 50 --seconds 0.5 -o x.glb",
     "do not fit into 0.5 s: choose a longer time"},
    {2, "flesh dog.glb", "-o FILE is missing"},
    {2, "flesh dog.glb -o x.obj", "--output: expected a name ending in .glb"},
    {2, "flesh dog.glb -o dog.glb", "dog.glb: "},
    {2, "flesh dog.glb --young 1e6 --frequency 2 -o x.glb", "--young and --frequency both set the stiffness"},
    {0, "flesh dog.glb --tets 500 --substeps 1 --modes 1 -o y.glb", "  held within 0.|m of the bones (--depth)"},
    // simulate
    {2, "simulate box.obj --pin round -o x.npy", "--pin: expected a height, none, plane:"},
    {1, "simulate box.obj --soft paper -o x.npy", "paper: cannot be opened"},
    {1, SOFT("color"), "--soft color: expected colours of vertices, got none"},
    {1, "simulate bright.obj " QUICK "-o x.npy", "bright.obj:1: expected a colour from 0 to 1, got 1e+30"},
    {1, SOFT("short.npy"), "short.npy: expected 8 numbers, got a file that ends before"},
    {1, SOFT("long.npy"), "long.npy: expected an array of 8 numbers, one a vertex"},
    {1, SOFT("huge.npy"), "huge.npy: expected an array of 8 numbers, one a vertex"},
    {1, SOFT("wild.npy"), "wild.npy: vertex 7: expected a number from 0 to 1, got nan"},
    {1, SOFT("above.npy"), "above.npy: vertex 0: expected a number from 0 to 1, got 2"},
    {1, SOFT("below.npy"), "below.npy: vertex 7: expected a number from 0 to 1, got -0.5"},
    {1, SOFT("endless.npy"), "endless.npy: expected the header of an .npy array"},
    {1, SOFT("header.npy"), "header.npy: expected a header of 128 bytes, got 23"},
    {1, SOFT("tiny.npy"), "tiny.npy: expected a .npy file"},
    {1, SOFT("box.obj"), "box.obj: expected"},
    {1, SOFT("nowhere.npy"), "nowhere.npy: cannot be opened"},
    {1, "simulate flag.obj --up z --thickness 0.1 " QUICK "-o x.npy",
     "nothing can move: all of it is in the region of --pin"},
    {1, "simulate flat.obj -o x.npy",
     "flat.obj: the mesh has no clear inside: --thickness 0.03 makes it a sheet of 0.03 m"},
    {1, "simulate far.obj --scale 1e9 " QUICK "-o x.npy",
     "far.obj: expected a size that --scale keeps finite, got an infinite one"},
    {1, "simulate nowhere.obj -o x.npy", "nowhere.obj"},
    {1, "simulate box.obj --tets 60 --pin 9 -o x.npy", "nothing can move"},
    {2, "simulate box.obj --up w -o x.npy", "--up: expected x, y or z"},
    {2, "simulate box.obj --yuong 1 -o x.npy", "unknown option --yuong (did you mean --young?)"},
    {2, "simulate box.obj --shake 0,0,0 -o x.npy", "--shake: expected up, side, front or a vector x,y,z"},
    {2, "simulate box.obj --young 1e6 --frequency 2 -o x.npy", "--young and --frequency both set the stiffness"},
    {2, "simulate box.obj --density 500 -o x.npy", "--density needs --young"},
    {2, "simulate box.obj --drive none --world -o x.npy", "--drive-frequency and --world need a drive, got none"},
    {2, "simulate box.obj --drive sine --impulse -o x.npy", "--impulse and a drive both start the motion"},
    {2, "simulate box.obj --drive sine --pin none -o x.npy",
     "--drive moves the pinned part, but --pin none pins nothing"},
    {2, "simulate box.obj --drive bursts -o x.npy",
     "--drive: expected burst, sine, sweep, a track's FILE.csv or none"},
    {2, "simulate box.obj", "-o FILE is missing"},
    {2, "simulate box.obj -o x.abc", "expected a name ending in .npy or .pc2"},
    {3, "simulate box.obj --tets 60 -o no/such/x.npy", "no/such/x.npy"},
    {0, "simulate box.obj " QUICK "--soft map.npy -o y.npy", "y.npy: 6 frames of 8 vertices at 24 fps"},
    {0, "simulate open.obj " QUICK "-o y.npy",
     "open.obj: open at 3 edges: inside is where its winding number exceeds a half"},
    // analyze
    {2, "analyze found.npy --rest rest.obj -o x.glb", "give --fps N"},
    {2, "analyze found.npy -o x.glb", "--rest mesh.obj is missing"},
    {2, "analyze up.npy --pin round -o x.glb", "--pin: expected a height, none, plane:"},
    {2, "analyze up.npy --shake sideways -o x.glb", "--shake: expected up, side, front"},
    {2, "analyze up.npy --shake up:side -o x.glb", "--shake: expected up, side, front"},
    {2, "analyze up.npy --method pca -o x.glb", "--method: expected poles or cpca"},
    {2, "analyze up.npy --method cpca --from 1 -o x.glb", "--from has no effect with --method cpca"},
    {2, "analyze --rest rest.obj -o x.glb", "an argument is missing"},
    {2, "analyze up.npy --modes 9 -o x.glb", "--modes: expected a whole number from 1 to 8"},
    {2, "analyze up.npy", "-o creature.glb is missing"},
    {1, "analyze up.npy --pin sphere:9,9,9,1 -o x.glb", "no vertex is in the region of --pin"},
    {1, "analyze broken.npy --rest rest.obj -o x.glb",
     "broken.simulation.json: expected what wiggly simulate writes"},
    {1, "analyze up.npy --from 1.8 -o x.glb", "up.npy: expected 8 frames or more after the drive stops, got 6"},
    {1, "analyze up.npy --from 1e6 -o x.glb", "up.npy: expected 8 frames or more after the drive stops, got 0"},
    {1, "analyze up.npy --rest four.obj -o x.glb", "expected 4 vertices as four.obj has, got 8"},
    {1, "analyze cut.npy --rest rest.obj --fps 30 -o x.glb",
     "cut.npy: expected 60 frames of 8 vertices, got a file that ends in frame 9"},
    {1, "analyze rest.obj --rest rest.obj --fps 30 -o x.glb", "rest.obj: expected a motion (.npy, .pc2 or .mdd)"},
    {1, "analyze none.npy --rest rest.obj --fps 30 -o x.glb", "none.npy: cannot be opened"},
    {1, "analyze up.npy --rest up.npy -o x.glb", "up.npy: expected the text of an OBJ file, got binary data"},
    {3, "analyze up.npy -o no/x.glb", "no/x.glb: cannot be written"},
    // two outputs to one file
    {2, BLIND "--log x --result x", "--log and --result: expected two files, got x for both"},
    {2, BLIND "--result sub/../x --record ./x", "expected two files"},
    {2, BLIND "--log link.csv --result there.csv", "expected two files"},
    {2, BLIND "--log twin.csv --result there.csv", "expected two files"},
    {2, "analyze x.npy --rest x.obj -o x --scene x", "expected two files"},
    {2, "analyze x.npy --rest x.obj -o x --coordinates x", "expected two files"},
    // what a command reads: its operands, the models that a scene names, what these name, and other input
    {2, "solve s.json -o s.json", "--output: s.json: " OVER("scene.json")},
    {2, "solve s.json -o sub/..//./s.json", OVER("scene.json")},
    {2, "solve s.json -o here/s.json", OVER("scene.json")},
    {2, "solve s.json -o soft.csv", OVER("scene.json")},
    {2, "solve s.json -o hard.csv", OVER("scene.json")},
    {2, "solve dog.json -o dog.glb", "dog.glb: " OVER("a model of the scene")},
    {2, "live --no-draw --replay r.replay --record r.replay s.json", OVER("--replay")},
    {2, DRAWN "--frames-dir sub shots.json", "frame_00000.png: " OVER("")},
    {2, "export dog.json -o dog.glb", "dog.glb: " OVER("a model of the scene")},
    {2, "export dog.json -o walk.glb", "walk.glb: cannot be written"},
    {2, "export dog.glb -o dog.glb", OVER("scene.json")},
    {2, "export odd.json --frames 0:1 --size 64x36 -o w.png", "w-0002.png: cannot be written"},
    {2, "rig dog.glb --chain tail_1:tail_8 -o dog.glb", OVER("character.glb")},
    {2, "simulate cube.rest.obj " QUICK "-o cube.npy", "cube.rest.obj: " OVER("MESH")},
    {2, "simulate rest.obj --tets 60 --seconds 2 --substeps 1 --soft map.npy -o map.npy",
     "map.npy: " OVER("map.npy")},
    {2, "analyze up.npy --rest rest.obj -o rest.obj", OVER("--rest")},
    {2, "analyze up.npy -o x.glb --scene up.rest.obj", "up.rest.obj: cannot be written"},
    {2, "analyze up.npy --rest rest.obj -o up.npy", OVER("up.npy")},
    // what is made, which the next row may read
    {0, "export s.json -o TAIL.GLB", "TAIL.GLB: 24 joints, 121 keys, 6"},
    {0, "export s.json -o t.csv --fps 7.3", "warning: the last key is on frame 118.356"},
    {0, "export s.json -o t.csv --frames 24:48 --substeps 2", "49 rows"},
    {0, "export dog.json -o dog.usda --substeps 1", "97 keys, 1 texture in dog_textures, "},
    {0, "export assets/scenes/character.json -o soft.glb --frames 0:4", " morph targets, 5 keys"},
    {0, "rig dog.glb", // a bone under its parent
     "Walk (1 s, loops)|          tail_3|chains you can use with --chain:\n|  jaw (1 bone)\n  tail_1:tail_8 (8 "
     "bones)\n"},
    {0, "check dog.glb",
     "dog.glb: a glTF character of 19816 triangles and 43 joints|Trot (0.583 s, loops)|  ear_1_L:ear_4_L (4 bones)"},
    {0, "rig dog.glb --chain tail_1:tail_8 --chain ear_1_L -c ear_1_R -o d.json", "wrote d.json: 3 chains"},
    {0, "check d.json", ""},
    {0, "rig dog.glb --chain tail_1 --clip Trot -o trot.glb",
     "wrote trot.glb|the clip's largest swing turns its tip by up to 30 degrees"},
    {0, "rig trot.glb", "Trot (0.583 s, loops)"},
    {0, "rig dog.glb --chain tail_1 --all-clips -o all.glb", "8 bones bent by chains in 3 clips, 161 keys"},
    {0, "rig all.glb", "  Walk (1 s, loops)\n  Trot (0.583 s, loops)\n  Idle (5 s, loops)"},
    {0, "rig dog.glb --chain tail_1 --once -o once.json", "1 chain; clip Walk plays once"},
    {0, "rig dog.glb --chain tail_1 --loop -o loop.glb", "clip Walk loops"},
    // but other files, and a new name
    {0, "export dog.json -o other.glb", ""},
    {0, "export dog.json -o other.glb --frames 0:1", ""},
    {0, "live --no-draw --replay r.replay --record new.replay s.json", ""},
};

/// What a file that is made has, and what it lacks.
TEST(what_commands_write)
{
    static const struct {
        const char *line, *file, *has, *lacks;
    } made[] = {
        {"export s.json -o t.gltf", "t.gltf", "\"name\": \"s\"", "tail.json"}, // the clip's name is the scene's
        {"rig dog.glb --chain tail_1:tail_8 --frequency 2 -o d.json", "d.json", "\"frequency\": 2,", "\"once\""},
        {"rig dog.glb --chain tail_1 --once -o once.json", "once.json", "\"repeat\": \"once\"",
         "\"start\": \"loop\""},
        {"rig dog.glb --chain tail_1 --plain -o plain.json", "plain.json", "\"tail_1\"", "\"joint\""},
        // two ears share a spline for each axis, or have their own
        {"rig dog.glb --chain ear_1_L --chain ear_1_R -o e.json", "e.json", "\"ear_1_L side\"", "\"ear_1_R side\""},
        {"rig dog.glb --chain ear_1_L --chain ear_1_R --own-splines -o e.json", "e.json", "\"ear_1_R side\"",
         "\"x\""},
    };
    static const char *const endings[] = {"glb", "gltf", "usda", "bvh", "csv", "pc2", "mdd", "npy"};
    for (size_t i = 0; i < COUNT(made); i++) {
        char *text;
        size_t size;
        expect(0, made[i].line, "wrote");
        assert_done(file_read(folder_path(made[i].file), 1 << 24, &text, &size, &error));
        if (!strstr(text, made[i].has)) fail_msg("%s lacks %s", made[i].line, made[i].has);
        if (strstr(text, made[i].lacks)) fail_msg("%s has %s", made[i].line, made[i].lacks);
        free(text);
    }
    for (size_t i = 0; i < COUNT(endings); i++)
        expect_each(0, "export s.json -o tail.%s", "wrote tail.%s: ", endings[i]);
    expect(0, "export s.json -o tail.csv --quiet", "");
    assert_true(!command.out[0] && !command.err[0]);
}

TEST(rows_of_commands)
{
    char line[LINE];
    for (size_t i = 0; i < COUNT(rows); i++) expect(rows[i].status, rows[i].line, rows[i].says);
    snprintf(line, sizeof line, "simulate box.obj --pin 0.%0130d -o x.npy", 1);
    expect(2, line, "--pin: expected fewer than 128 characters");
    run(call, "analyze up.npy -o y.glb --coordinates no/y.csv"); // the character is there by then
    assert_int_equal(command.status, 3);
    assert_non_null(strstr(command.err, "no/y.csv: cannot be written"));
}

/// Each file that the live app writes over each that it reads; one picture, for it starts a driver.
TEST(outputs_of_live_over_its_input)
{
    static const struct {
        const char *lines, *says;
    } inputs[] = {{"%s s.json s.json", "s.json: " OVER("scene.json")},
                  {"%s dog.glb dog.json", "dog.glb: " OVER("")},
                  {"%s three.bin three.json", "three.bin: " OVER("")}};
    static const char *const options[] = {"--log", "--record", "--result"};
    for (int i = 0; i < 9; i++) {
        char format[64];
        snprintf(format, sizeof format, BLIND "%s", inputs[i / 3].lines);
        expect_each(2, format, inputs[i / 3].says, options[i % 3]);
    }
    expect(2, DRAWN "--screenshot three.bin three.json", "three.bin: " OVER(""));
}

/// `wiggly check` says every problem; the scenes of the tree have none.
TEST(checks_of_scenes)
{
    run(call, "check bad.json");
    assert_int_equal(command.status, 1);
    assert_non_null(strstr(command.out, "bad.json:2: splines[0].name: expected a string, got a number\n"));
    int lines = 0;
    for (const char *c = command.out; *c; c++) lines += *c == '\n';
    assert_int_equal(lines, 3);
    run(call, "check sub"); // a folder
    assert_int_equal(command.status, 1);
    DIR *all = opendir("assets/scenes");
    assert_non_null(all);
    for (struct dirent *entry; (entry = readdir(all));) {
        if (!strstr(entry->d_name, ".json")) continue;
        expect_each(0, "check assets/scenes/%s", "", entry->d_name);
        if (command.out[0] || command.err[0]) fail_msg("%s: %s%s", entry->d_name, command.out, command.err);
    }
    closedir(all);
}

/// Undamped, no calm, knots at half periods: only last digits hold it.
TEST(an_inexact_curve_is_said)
{
    char text[LINE];
    int n =
        sprintf(text, "{\"fps\": 15, \"frames\": [0, 610], \"splines\": [{\"name\": \"chain\", \"frequency\": 0.75, "
                      "\"bandwidth\": 0, \"calm\": 1e-6, \"knots\": [");
    for (int k = 0; k <= 60; k++)
        n += sprintf(text + n, "%s{\"frame\": %d, \"value\": 0.%d}", k ? "," : "", 10 * k, k * k * 7 % 10);
    sprintf(text + n, "]}]}");
    folder_file("chain.json", text);
    expect(0, "solve chain.json", "\"chain\": solved, but the estimated error exceeds the tolerance: ");
    assert_non_null(strstr(command.err, " of the curve's size\n"));
}

TEST(the_nearest_word)
{
    static const char *words[] = {"live", "solve", "check"};
    char longest[1000] = "";
    memset(longest, 'x', sizeof longest - 1);
    const char *const typos[][2] = {
        {"slove", "solve"}, {"chek", "check"}, {"lives", "live"}, {"render", NULL}, {longest, NULL}};
    for (size_t i = 0; i < COUNT(typos); i++) {
        const char *nearest = options_nearest(typos[i][0], words, 3);
        if (typos[i][1] ? !nearest || strcmp(nearest, typos[i][1]) != 0 : nearest != NULL)
            fail_msg("%s", typos[i][0]);
    }
}
