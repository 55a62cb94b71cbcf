/// Motions in every form that they come in: types, orders, shapes, byte orders, caches; written and read back; refused.
#include "base/file.h"
#include "model/motion.h"
#include "near.h"
#include "temporary.h"

enum { FRAMES = 5, VERTICES = 4, COLUMNS = 3 * VERTICES };

/// What column j holds in frame i: a float exactly.
static double number(int i, int j) { return 100 * i + j + 0.5; }

static void assert_holds_numbers(const char *path, double fps)
{
    struct motion motion;
    double slab[FRAMES * COLUMNS];
    assert_done(motion_open(&motion, path, &error));
    assert_int_equal(motion.frames, FRAMES);
    assert_int_equal(motion.vertices, VERTICES);
    assert_near(motion.fps, fps, 0);
    for (int first = 0; first < COLUMNS; first += 5) { // slabs that end inside of a vertex, the last one short
        int count = first + 5 < COLUMNS ? 5 : COLUMNS - first;
        assert_done(motion_columns(&motion, first, count, slab, &error));
        for (int i = 0; i < FRAMES; i++) {
            for (int j = 0; j < count; j++) assert_near(slab[i * count + j], number(i, first + j), 0);
        }
    }
    motion_close(&motion);
}

/// A file of the test's own: bytes appended one after the other.
struct bytes {
    unsigned char data[4096];
    size_t size;
};

static void add(struct bytes *b, const void *data, size_t size, bool swap)
{
    const unsigned char *from = data;
    for (size_t i = 0; i < size; i++) b->data[b->size++] = from[swap ? size - 1 - i : i];
}

static void add_number(struct bytes *b, double value, int size, bool swap)
{
    const float single = (float)value;
    add(b, size == 4 ? (const void *)&single : &value, (size_t)size, swap);
}

/// In which order an array has its numbers: frames, vertices, x y z; in Fortran's the first of three or of two indices runs fastest.
enum order { IN_C, FORTRAN_3, FORTRAN_2 };

/// An array with this dictionary, of version 1 or 2.
static const char *npy(int version, const char *dictionary, int size, bool swap, enum order order)
{
    static struct bytes b;
    const uint32_t length = (uint32_t)strlen(dictionary);
    b.size = 0;
    add(&b, "\x93NUMPY", 6, false);
    add(&b, &version, 1, false);
    add(&b, "", 1, false);
    add(&b, &length, version == 2 ? 4 : 2, false);
    add(&b, dictionary, length, false);
    for (int n = 0; n < FRAMES * COLUMNS; n++) {
        const int frame = order == IN_C ? n / COLUMNS : n % FRAMES, rest = order == IN_C ? n % COLUMNS : n / FRAMES;
        add_number(&b, number(frame, order == FORTRAN_3 ? 3 * (rest % VERTICES) + rest / VERTICES : rest), size,
                   swap);
    }
    return temporary_file("motion.npy", b.data, b.size);
}

/// A dictionary in C's order.
#define DICTIONARY(descr, shape) "{'descr': " descr ", 'fortran_order': False, 'shape': " shape ", }"

TEST(npy_of_every_type_and_order)
{
    static const struct {
        int version;
        const char *dictionary;
        int size;
        bool swap;
        enum order order;
    } rows[] = {
        {1, DICTIONARY("'<f4'", "(5, 4, 3)") "\n", 4, false, IN_C},
        {2, "{'descr': '<f8', 'fortran_order': False, 'shape': (5, 4, 3)}", 8, false, IN_C},
        {1, "{'shape': (5, 12), 'fortran_order': False, 'descr': '>f4'}", 4, true, IN_C},
        {1, "{'descr':'>f8','fortran_order':False,'shape':(5,12),}", 8, true, IN_C},
        {1, "{'descr': '<f4', 'fortran_order': True, 'shape': (5, 4, 3), }\n", 4, false, FORTRAN_3},
        {1, "{'descr': '>f8', 'fortran_order': True, 'shape': (5, 12), }\n", 8, true, FORTRAN_2},
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        assert_holds_numbers(npy(rows[r].version, rows[r].dictionary, rows[r].size, rows[r].swap, rows[r].order), 0);
}

TEST(mdd_carries_its_rate)
{
    static const struct {
        double times[FRAMES], fps; ///< 0: uneven, so nobody knows
    } rows[] = {{{2, 2 + 1.0 / 24, 2 + 2.0 / 24, 2 + 3.0 / 24, 2 + 4.0 / 24}, 24}, {{0, 1, 2, 3, 3.5}, 0}, {{0}, 0}};
    static const int32_t counts[] = {FRAMES, VERTICES};
    for (int r = 0; r < 3; r++) {
        static struct bytes b;
        b.size = 0;
        for (int k = 0; k < 2; k++) add(&b, &counts[k], 4, true);
        for (int i = 0; i < FRAMES; i++) add_number(&b, rows[r].times[i], 4, true);
        for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&b, number(n / COLUMNS, n % COLUMNS), 4, true);
        assert_holds_numbers(temporary_file("motion.mdd", b.data, b.size), rows[r].fps);
    }
}

static void write_motion(const char *path)
{
    struct file_output output;
    struct error error;
    assert_true(motion_start(&output, path, FRAMES, VERTICES, &error));
    for (int i = 0; i < FRAMES; i++) {
        float frame[VERTICES][3];
        for (int j = 0; j < COLUMNS; j++) frame[j / 3][j % 3] = (float)number(i, j);
        fwrite(frame, sizeof frame, 1, output.stream);
    }
    if (!file_output_commit(&output, &error)) fail_msg("%s", error.text);
}

TEST(what_is_written_reads_back)
{
    write_motion(temporary_path("written.npy"));
    assert_holds_numbers(temporary_path("written.npy"), 0);
    write_motion(temporary_path("written.pc2"));
    assert_holds_numbers(temporary_path("written.pc2"), 0);
    FILE *file = fopen(temporary_path("written.npy"), "rb");
    fseek(file, 0, SEEK_END);
    assert_int_equal(ftell(file), 128 + 4 * FRAMES * COLUMNS); // the numbers start aligned
    fclose(file);
}

static void assert_refused(const char *path, const char *says)
{
    struct motion motion;
    struct error error = {0};
    assert_false(motion_open(&motion, path, &error));
    if (!strstr(error.text, says)) fail_msg("'%s' lacks '%s'", error.text, says);
    assert_int_equal(error.kind, ERROR_INPUT);
}

TEST(bad_files_get_one_sentence)
{
    static const struct {
        int version;
        const char *dictionary, *says;
    } arrays[] = {
        {1, DICTIONARY("'<i4'", "(5, 4, 3)"), "expected numbers of type float32 or float64, got '<i4'"},
        {1, DICTIONARY("[('x', '<f4')]", "(5, 4, 3)"), "expected numbers of type float32 or float64, got [('x'"},
        {1, DICTIONARY("'<f4'", "(60,)"), "expected an array of shape (frames, vertices, 3), got (60,)"},
        {1, DICTIONARY("'<f4'", "(5, 3, 4)"), "got (5, 3, 4)"},
        {1, DICTIONARY("'<f4'", "(0, 4, 3)"), "expected one frame and one vertex or more, got 0 and 4"},
        {1, DICTIONARY("'<f4'", "(6, 4, 3)"), "expected 6 frames of 4 vertices, got a file that ends in frame 5"},
        {1, DICTIONARY("'<f8'", "(1000000000, 700000000, 3)"), "got a file that ends in frame 0"},
        {1, "{'descr': '<f4'}", "expected the header of an .npy array"},
        {9, DICTIONARY("'<f4'", "(5, 4, 3)"), "expected the header of an .npy array"},
    };
    static const struct {
        const char *name, *bytes;
        size_t size;
        const char *says;
    } files[] = {
        {"short.npy", "\x93NUMPY\1\0\xff\x0f{'descr': ", 20, "expected a header of 4105 bytes, got 20"},
        {"empty.npy", "", 0, "got a file of 0 bytes"},
        {"text.npy", "v 0 0 0\nv 1 1 1\n", 16, "got something else"},
        {"short.mdd", "\0\0\0\5\0\0\0\4\0\0\0\0\0\0\0\0", 16, "got a file that ends in frame 0"},
        {"less.mdd", "\xff\xff\xff\xff\0\0\0\4\0\0\0\0\0\0\0\0", 16, "got -1 and 4"},
    };
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        assert_refused(npy(arrays[i].version, arrays[i].dictionary, 4, false, IN_C), arrays[i].says);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        assert_refused(temporary_file(files[i].name, files[i].bytes, files[i].size), files[i].says);
    assert_refused("/nowhere.npy", "/nowhere.npy: cannot be opened");
    assert_refused("/tmp", "/tmp: expected a file");
}

TEST(a_number_that_is_none_is_named)
{
    double slab[FRAMES * COLUMNS];
    const char *path = npy(1, DICTIONARY("'<f4'", "(5, 4, 3)"), 4, false, IN_C);
    FILE *file = fopen(path, "r+b");
    fseek(file, -(FRAMES - 2) * COLUMNS * 4 + 7 * 4, SEEK_END);
    fwrite(&(const float){NAN}, 4, 1, file);
    fclose(file);
    struct motion motion;
    assert_done(motion_open(&motion, path, &error));
    assert_done(motion_columns(&motion, 0, 7, slab, &error));
    assert_refusal(motion_columns(&motion, 5, 4, slab, &error), "frame 2, vertex 2: expected a finite number");
    motion_close(&motion);
}

/// Headers changed at random: read or refused, never more (the sanitizers watch).
TEST(changed_headers_do_no_harm)
{
    static const char dictionary[] = "{'descr': '<f4', 'fortran_order': True, 'shape': (5, 4, 3), }";
    char *good, *bytes;
    size_t size;
    uint32_t seed = 4711;
    int refused = 0;
    assert_done(file_read(npy(1, dictionary, 4, false, FORTRAN_3), 1 << 16, &good, &size, &error));
    for (int round = 0; round < 1000; round++) {
        struct motion motion;
        bytes = memcpy(malloc(size), good, size);
        for (int k = 0; k < 2; k++) {
            seed = 1664525u * seed + 1013904223u;
            bytes[(seed >> 8) % (10 + strlen(dictionary))] = (char)(k == 0 ? '0' + round % 10 : (int)(seed >> 24));
        }
        if (motion_open(&motion, temporary_file("changed.npy", bytes, size), NULL)) {
            double *slab = malloc((size_t)motion.frames * 3 * (size_t)motion.vertices * sizeof *slab);
            motion_columns(&motion, 0, 3 * motion.vertices, slab, NULL);
            free(slab);
            motion_close(&motion);
        } else {
            refused++;
        }
        free(bytes);
    }
    free(good);
    assert_in_range(refused, 50, 999);
}
