/// Scenes that must be refused: each with one sentence that names file, line and path, and without a crash or a leak.
#include "documents.h"

#include "folder.h"
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MEGABYTE = 1 << 20, LINE_SIZE = 512, TEXT_SIZE = 4096, NOBODY = 65534 };

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

/// The file must be refused, with that fragment in its one sentence; and all of its problems are counted, that one first.
static void assert_refused(const char *path, const char *fragment)
{
    struct error error = {0};
    struct heard heard = {0};
    struct problems problems = {hear, &heard, 0, 0};
    if (scene_load(path, NULL, &error)) fail_msg("%s was loaded", path);
    assert_int_equal(error.kind, ERROR_INPUT);
    assert_null(strchr(error.text, '\n'));
    if (!strstr(error.text, fragment)) fail_msg("\"%s\" does not say \"%s\"", error.text, fragment);
    assert_null(scene_load(path, &problems, &error));
    assert_true(heard.errors >= 1);
    assert_int_equal(heard.errors, problems.errors);
    assert_int_equal(heard.warnings, problems.warnings);
    error.text[sizeof heard.first - 1] = '\0';
    assert_string_equal(heard.first, error.text);
}

/// A text with what stands where `from` does replaced by `to`; the caller frees it.
static char *text_with(const char *text, const char *from, const char *to)
{
    const char *at = strstr(text, from);
    if (!at) fail_msg("there is no %s in %s", from, text);
    const size_t size = strlen(text) + strlen(to) + 1;
    char *changed = malloc(size);
    assert_non_null(changed);
    snprintf(changed, size, "%.*s%s%s", (int)(at - text), text, to, at + strlen(from));
    return changed;
}

/// Checks a line of the list: a file and its sentence; or changes of the base, each from and to, and their sentence. Returns whether it
/// is a file.
static bool check_line(const char *base, char *line)
{
    char path[64], *fields[9];
    int count = 0;
    for (char *field; (field = strsep(&line, "\t")); count++) fields[count] = field;
    if (count == 2) {
        snprintf(path, sizeof path, "tests/bad/%.50s", fields[0]);
        assert_refused(path, fields[1]);
        return true;
    }
    assert_int_equal(count % 2, 1);
    char *text = strdup(base);
    for (int i = 0; i + 1 < count; i += 2) {
        char *changed = text_with(text, fields[i], fields[i + 1]);
        free(text);
        text = changed;
    }
    assert_refused(folder_file("changed.json", text), fields[count - 1]);
    free(text);
    return false;
}

TEST(what_is_listed)
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

/// A sparse file takes no room on the disk, and must not be read at all.
TEST(what_is_no_file_or_none_to_read)
{
    assert_int_equal(mkfifo(folder_path("fifo"), 0644), 0);
    assert_int_equal(symlink("loop", folder_path("loop")), 0);
    folder_file("secret.json", "{}");
    assert_int_equal(chmod(folder_path("secret.json"), 0), 0);
    folder_file("large.json", "");
    assert_int_equal(truncate(folder_path("large.json"), (off_t)1 << 40), 0);
    const bool is_root = geteuid() == 0; // who may read anything
    if (is_root) assert_int_equal(chmod(folder, 0755), 0);
    static const char *const rows[][2] = {
        {"", "got a directory"},
        {"missing.json", "No such file"},
        {"fifo", "expected a file"},
        {"loop", "cannot be opened"},
        {"secret.json", "Permission denied"},
        {"large.json", "expected at most 256 MiB"},
        {"/dev/zero", "expected a file"},
        {"/dev/null", "expected a file"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (is_root) assert_int_equal(seteuid(NOBODY), 0);
        assert_refused(rows[i][0][0] == '/' ? rows[i][0] : folder_path(rows[i][0]), rows[i][1]);
        if (is_root) assert_int_equal(seteuid(0), 0);
    }
    assert_refused("", "cannot be opened");
}

/// A pattern again and again, with a bracket that no recursive parser's stack would stand, or that would fill its memory.
TEST(floods)
{
    static const struct {
        const char *pattern;
        size_t megabytes;
        const char *says;
    } rows[] = {
        {"[", 1, "expected at most 64 levels"},
        {"{\"a\":", 3, "expected at most 64 levels"},
        {"{},", 8, "expected at most 2000000 objects"},
        {"1,", 17, "8000000 values"},
        {"\"", 1, "expected '[' or '{'"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const size_t length = strlen(rows[i].pattern), size = rows[i].megabytes * MEGABYTE / length * length;
        char *flood = malloc(size);
        struct error error = {0};
        assert_non_null(flood);
        for (size_t k = 0; k < size; k += length) memcpy(flood + k, rows[i].pattern, length);
        assert_null(scene_parse("flood.json", flood, size, NULL, &error));
        if (!strstr(error.text, rows[i].says)) fail_msg("%s: %s", rows[i].says, error.text);
        free(flood);
    }
}

static char *read_figure(size_t *size)
{
    char *text;
    assert_done(file_read("assets/scenes/figure5.json", MEGABYTE, &text, size, &error));
    return text;
}

TEST(what_is_cut_off_anywhere)
{
    size_t size;
    char *text = read_figure(&size);
    while (size > 0 && text[size - 1] != '}') size--;
    for (size_t cut = 0; cut < size; cut++) {
        struct error error = {0};
        if (scene_parse("cut.json", text, cut, NULL, &error)) fail_msg("cut off at byte %zu it was loaded", cut);
        assert_int_equal(strncmp(error.text, "cut.json:", 9), 0);
    }
    free(text);
}

/// What survives damage must be a scene that can be saved and loaded again.
TEST(damaged_bytes)
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
        if (document) assert_loads_again(document);
        if (!document) assert_int_equal(strncmp(error.text, "damaged.json:", 13), 0);
        document_destroy(document);
    }
    free(damaged);
    free(text);
}

/// A line for each number from 0 on: with it, and with the next one, of the first behind the last. The caller frees it.
static char *many_lines(const char *head, const char *line, int count, const char *tail)
{
    char *text = malloc((size_t)count * 80 + 200), *end = text + sprintf(text, "%s", head);
    assert_non_null(text);
    for (int i = 0; i < count; i++) {
        end += snprintf(end, 78, line, i, (i + 1) % count); // NOLINT: a format of the tests below
        end += sprintf(end, "%s\n", i < count - 1 ? "," : "");
    }
    sprintf(end, "%s", tail);
    return text;
}

/// Each of very many problems is named with its own line, in a time that does not grow with their square.
TEST(many_problems)
{
    enum { KNOTS = 100000 };
    char *text = many_lines("{\"frames\": [0, 9], \"splines\": [{\"name\": \"x\", \"knots\": [\n",
                            "{\"frame\": 0, \"value\": \"\"}", KNOTS, "]}]}\n");
    struct heard heard = {0};
    struct problems problems = {hear, &heard, 0, 0};
    struct error error = {0};
    assert_null(scene_parse("many.json", text, strlen(text), &problems, &error));
    assert_int_equal(heard.errors, KNOTS);
    assert_string_equal(heard.first, "many.json:2: splines[0].knots[0].value: expected a number, got a string");
    free(text);
}

/// A chain of tracks as long as a scene may be: no recursion may follow it.
TEST(a_long_chain_of_tracks)
{
    char *text = many_lines("{\"frames\": [0, 9], \"splines\": [\n",
                            "{\"name\": \"%d\", \"equilibrium\": {\"spline\": \"%d\"}}", 100000, "]}\n");
    assert_refusal(scene_parse("chain.json", text, strlen(text), NULL, &error) != NULL,
                   "splines[99999].equilibrium: expected tracks without a cycle");
    free(text);
}

TESTS_BETWEEN(folder_make, folder_remove)
