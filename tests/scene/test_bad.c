/// Scenes that must be refused: each with one sentence that names file, line and path, and without a crash or a leak.
#include "documents.h"

#include "folder.h"
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MEGABYTE = 1 << 20, LINE_SIZE = 512, TEXT_SIZE = 4096, NOBODY = 65534 };

static char *read_figure(size_t *size)
{
    char *text;
    assert_done(file_read("assets/scenes/figure5.json", MEGABYTE, &text, size, &error));
    return text;
}

static void assert_contains(const char *text, const char *fragment)
{
    if (!strstr(text, fragment)) fail_msg("\"%s\" does not say \"%s\"", text, fragment);
}

/// The file must be refused, with that fragment in its sentence.
static void assert_refused(const char *path, const char *fragment)
{
    struct error error = {0};
    struct document *document = scene_load(path, NULL, &error);
    if (document) fail_msg("%s was loaded", path);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_null(strchr(error.text, '\n'));
    assert_contains(error.text, fragment);
}

struct heard {
    char first[LINE_SIZE];
    int errors, warnings;
};

static void hear(void *user, bool is_error, const char *sentence)
{
    struct heard *heard = user;
    if (is_error && heard->errors == 0) snprintf(heard->first, sizeof heard->first, "%s", sentence);
    heard->errors += is_error;
    heard->warnings += !is_error;
}

static void assert_check_agrees(const char *path)
{
    struct heard heard = {0};
    struct problems problems = {hear, &heard, 0, 0};
    struct error error = {0};
    assert_null(scene_load(path, &problems, &error));
    assert_true(heard.errors >= 1);
    assert_int_equal(heard.errors, problems.errors);
    assert_int_equal(heard.warnings, problems.warnings);
    error.text[sizeof heard.first - 1] = '\0';
    assert_string_equal(heard.first, error.text);
}

/// Puts `to` in the place of the first `from`.
static void replace(char text[TEXT_SIZE], const char *from, const char *to)
{
    char rest[TEXT_SIZE], *at = strstr(text, from);
    if (!at) fail_msg("tests/bad/base.json has no %s", from);
    snprintf(rest, sizeof rest, "%s", at + strlen(from));
    snprintf(at, (size_t)(text + TEXT_SIZE - at), "%s%s", to, rest);
}

/// Checks a line of the list: a file and its sentence; or changes of the base, each from and to, and their sentence. Returns whether it
/// is a file.
static bool check_line(const char *base, char *line)
{
    char text[TEXT_SIZE], path[64], *fields[9];
    int count = 0;
    for (char *field; (field = strsep(&line, "\t")); count++) fields[count] = field;
    const bool is_file = count == 2;
    if (is_file) {
        snprintf(path, sizeof path, "tests/bad/%.50s", fields[0]);
    } else {
        assert_int_equal(count % 2, 1);
        snprintf(text, sizeof text, "%s", base);
        for (int i = 0; i + 1 < count; i += 2) replace(text, fields[i], fields[i + 1]);
        folder_file("changed.json", text);
    }
    assert_refused(is_file ? path : folder_path("changed.json"), fields[count - 1]);
    assert_check_agrees(is_file ? path : folder_path("changed.json"));
    return is_file;
}

TEST(test_listed_scenes)
{
    char line[TEXT_SIZE], *base;
    size_t size;
    int count = 0, files = 1;
    assert_done(file_read("tests/bad/base.json", TEXT_SIZE, &base, &size, &error));
    document_destroy(document_of_text(base));
    FILE *list = fopen("tests/bad/expected.txt", "r");
    assert_non_null(list);
    while (fgets(line, sizeof line, list)) {
        line[strcspn(line, "\n")] = '\0';
        if (line[0] == '#') continue;
        files += check_line(base, line);
        count++;
    }
    fclose(list);
    free(base);
    assert_true(count >= 140);
    DIR *bad = opendir("tests/bad");
    assert_non_null(bad);
    for (struct dirent *entry; (entry = readdir(bad));) files -= strstr(entry->d_name, ".json") != NULL;
    closedir(bad);
    assert_int_equal(files, 0); // none is forgotten in the list
}

TEST(test_what_is_no_file)
{
    assert_refused(folder, "got a directory");
    assert_refused(folder_path("missing.json"), "No such file");
    assert_refused("/dev/zero", "expected a file");
    assert_refused("/dev/null", "expected a file");
    assert_refused("", "cannot be opened");
    assert_int_equal(mkfifo(folder_path("fifo"), 0600), 0);
    assert_refused(folder_path("fifo"), "expected a file");
    assert_int_equal(symlink("loop", folder_path("loop")), 0);
    assert_refused(folder_path("loop"), "cannot be opened");
}

TEST(test_no_permission)
{
    folder_file("secret.json", "{}");
    assert_int_equal(chmod(folder_path("secret.json"), 0), 0);
    bool is_root = geteuid() == 0; // who may read anything
    if (is_root) assert_int_equal(seteuid(NOBODY), 0);
    assert_refused(folder_path("secret.json"), "Permission denied");
    if (is_root) assert_int_equal(seteuid(0), 0);
}

/// A sparse file: it takes no room on the disk, and must not be read at all.
TEST(test_too_large)
{
    int file = open(folder_path("large.json"), O_CREAT | O_WRONLY, 0600);
    assert_true(file >= 0);
    assert_int_equal(ftruncate(file, (off_t)1 << 40), 0);
    close(file);
    assert_refused(folder_path("large.json"), "expected at most 256 MiB");
}

/// The pattern again and again, with a bracket that no recursive parser's stack would stand, or that would fill its
/// memory.
static void assert_flood_refused(const char *pattern, int megabytes, const char *fragment)
{
    size_t length = strlen(pattern), size = (size_t)megabytes * MEGABYTE / length * length;
    char *flood = malloc(size);
    assert_non_null(flood);
    for (size_t i = 0; i < size; i += length) memcpy(flood + i, pattern, length);
    FILE *file = fopen(folder_path("flood.json"), "wb"); // which waits for no disk
    assert_non_null(file);
    assert_int_equal(fwrite(flood, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    free(flood);
    assert_refused(folder_path("flood.json"), fragment);
    assert_int_equal(unlink(folder_path("flood.json")), 0);
}

TEST(test_floods)
{
    assert_flood_refused("[", 1, "expected at most 64 levels");
    assert_flood_refused("{\"a\":", 3, "expected at most 64 levels");
    assert_flood_refused("{},", 8, "expected at most 2000000 objects");
    assert_flood_refused("1,", 17, "8000000 values");
    assert_flood_refused("\"", 1, "expected '[' or '{'");
}

TEST(test_cut_off_anywhere)
{
    size_t size;
    char *text = read_figure(&size);
    while (size > 0 && text[size - 1] != '}') size--;
    for (size_t cut = 0; cut < size; cut++) {
        struct error error = {0};
        struct document *document = scene_parse("cut.json", text, cut, NULL, &error);
        if (document) fail_msg("cut off at byte %zu it was loaded", cut);
        assert_int_equal(strncmp(error.text, "cut.json:", 9), 0);
    }
    free(text);
}

/// What survives damage must be a scene that can be saved and loaded again.
TEST(test_damaged_bytes)
{
    size_t size;
    char *text = read_figure(&size), *damaged = malloc(size);
    assert_non_null(damaged);
    srand(20);
    for (int round = 0; round < 4000; round++) {
        memcpy(damaged, text, size);
        for (int i = 0; i <= round % 3; i++) {
            damaged[(size_t)rand() % size] = round % 2 ? (char)rand() : "0123456789-.,:{}[]\"e"[rand() % 20];
        }
        struct error error = {0};
        struct document *document = scene_parse("damaged.json", damaged, size, NULL, &error);
        if (!document) {
            assert_int_equal(strncmp(error.text, "damaged.json:", 13), 0);
            continue;
        }
        assert_loads_again(document);
        document_destroy(document);
    }
    free(damaged);
    free(text);
}

/// Each of very many problems is named with its own line, in a time that does not grow with their square.
TEST(test_many_problems)
{
    enum { KNOTS = 100000, KNOT_BYTES = 32 };
    char *text = malloc(KNOTS * KNOT_BYTES + 200);
    assert_non_null(text);
    char *end = text + sprintf(text, "{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\", \"knots\": [\n");
    for (int i = 0; i < KNOTS; i++)
        end += sprintf(end, "{\"frame\": 0, \"value\": \"\"}%s\n", i < KNOTS - 1 ? "," : "");
    end += sprintf(end, "]}]}\n");
    struct heard heard = {0};
    struct problems problems = {hear, &heard, 0, 0};
    struct error error = {0};
    assert_null(scene_parse("many.json", text, (size_t)(end - text), &problems, &error));
    assert_int_equal(heard.errors, KNOTS);
    assert_string_equal(heard.first, "many.json:2: splines[0].knots[0].value: expected a number, got a string");
    free(text);
}

/// A chain of tracks as long as a scene may be: no recursion may follow it.
TEST(test_long_chain_of_tracks)
{
    enum { SPLINES = 100000, SPLINE_BYTES = 64 };
    char *text = malloc(SPLINES * SPLINE_BYTES + 200);
    assert_non_null(text);
    char *end = text + sprintf(text, "{\"frames\": [0, 9], \"splines\": [\n");
    for (int i = 0; i < SPLINES; i++) {
        const char *comma = i < SPLINES - 1 ? "," : "";
        end += sprintf(end, "{\"name\": \"%d\", \"equilibrium\": {\"spline\": \"%d\"}}%s\n", i, (i + 1) % SPLINES,
                       comma);
    }
    end += sprintf(end, "]}\n");
    struct error error = {0};
    assert_null(scene_parse("chain.json", text, (size_t)(end - text), NULL, &error));
    assert_contains(error.text, "splines[99999].equilibrium: expected tracks without a cycle");
    free(text);
}

TESTS_BETWEEN(folder_make, folder_remove)
