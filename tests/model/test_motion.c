/// Motions in every form that they come in: types, orders, shapes, byte orders, caches; written and read back; refused.
#include "model/motion.h"
#include "near.h"
#include "temporary.h"
#include <glob.h>

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
    float single = (float)value;
    if (size == 4) add(b, &single, 4, swap);
    if (size == 8) add(b, &value, 8, swap);
}

static void add_int(struct bytes *b, int32_t value, bool swap) { add(b, &value, 4, swap); }

/// An .npy header of version 1 or 2 with this dictionary.
static void add_npy(struct bytes *b, int version, const char *dictionary)
{
    size_t length = strlen(dictionary);
    const unsigned char short_length[] = {(unsigned char)length, (unsigned char)(length >> 8)};
    const unsigned char versions[] = {(unsigned char)version, 0};
    add(b, "\x93NUMPY", 6, false);
    add(b, versions, 2, false);
    add(b, short_length, 2, false);
    if (version == 2) add(b, "\0", 2, false);
    add(b, dictionary, length, false);
}

/// A dictionary in C's order.
#define DICTIONARY(descr, shape) "{'descr': " descr ", 'fortran_order': False, 'shape': " shape ", }"

static const char *npy(int version, const char *dictionary, int number_size, bool swap)
{
    static struct bytes b;
    b.size = 0;
    add_npy(&b, version, dictionary);
    for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&b, number(n / COLUMNS, n % COLUMNS), number_size, swap);
    return temporary_file("motion.npy", b.data, b.size);
}

TEST(npy_of_every_type)
{
    assert_holds_numbers(npy(1, DICTIONARY("'<f4'", "(5, 4, 3)") "\n", 4, false), 0);
    assert_holds_numbers(npy(2, "{'descr': '<f8', 'fortran_order': False, 'shape': (5, 4, 3)}", 8, false), 0);
    assert_holds_numbers(npy(1, "{'shape': (5, 12), 'fortran_order': False, 'descr': '>f4'}", 4, true), 0);
    assert_holds_numbers(npy(1, "{'descr':'>f8','fortran_order':False,'shape':(5,12),}", 8, true), 0);
}

TEST(npy_in_fortran_order)
{
    static struct bytes b;
    add_npy(&b, 1, "{'descr': '<f4', 'fortran_order': True, 'shape': (5, 4, 3), }\n");
    for (int k = 0; k < 3; k++) { // the first index runs fastest
        for (int v = 0; v < VERTICES; v++) {
            for (int i = 0; i < FRAMES; i++) add_number(&b, number(i, 3 * v + k), 4, false);
        }
    }
    assert_holds_numbers(temporary_file("motion.npy", b.data, b.size), 0);
    b.size = 0;
    add_npy(&b, 1, "{'descr': '>f8', 'fortran_order': True, 'shape': (5, 12), }\n");
    for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&b, number(n % FRAMES, n / FRAMES), 8, true);
    assert_holds_numbers(temporary_file("motion.npy", b.data, b.size), 0);
}

static const char *mdd(const double times[FRAMES])
{
    static struct bytes b;
    b.size = 0;
    add_int(&b, FRAMES, true);
    add_int(&b, VERTICES, true);
    for (int i = 0; i < FRAMES; i++) add_number(&b, times[i], 4, true);
    for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&b, number(n / COLUMNS, n % COLUMNS), 4, true);
    return temporary_file("motion.mdd", b.data, b.size);
}

TEST(mdd_carries_its_rate)
{
    assert_holds_numbers(mdd((const double[]){2, 2 + 1.0 / 24, 2 + 2.0 / 24, 2 + 3.0 / 24, 2 + 4.0 / 24}), 24);
    assert_holds_numbers(mdd((const double[]){0, 1, 2, 3, 3.5}), 0); // uneven: nobody knows
    assert_holds_numbers(mdd((const double[]){0, 0, 0, 0, 0}), 0);
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
    assert_refused(npy(1, DICTIONARY("'<i4'", "(5, 4, 3)"), 4, false),
                   "expected numbers of type float32 or float64, got '<i4'");
    assert_refused(npy(1, DICTIONARY("[('x', '<f4')]", "(5, 4, 3)"), 4, false),
                   "expected numbers of type float32 or float64, got [('x'");
    assert_refused(npy(1, DICTIONARY("'<f4'", "(60,)"), 4, false),
                   "expected an array of shape (frames, vertices, 3), got (60,)");
    assert_refused(npy(1, DICTIONARY("'<f4'", "(5, 3, 4)"), 4, false), "got (5, 3, 4)");
    assert_refused(npy(1, DICTIONARY("'<f4'", "(0, 4, 3)"), 4, false),
                   "expected one frame and one vertex or more, got 0 and 4");
    assert_refused(npy(1, DICTIONARY("'<f4'", "(6, 4, 3)"), 4, false),
                   "expected 6 frames of 4 vertices, got a file that ends in frame 5");
    assert_refused(npy(1, DICTIONARY("'<f8'", "(1000000000, 700000000, 3)"), 4, false),
                   "got a file that ends in frame 0");
    assert_refused(npy(1, "{'descr': '<f4'}", 4, false), "expected the header of an .npy array");
    assert_refused(npy(9, DICTIONARY("'<f4'", "(5, 4, 3)"), 4, false), "expected the header of an .npy array");
    assert_refused(temporary_file("short.npy", "\x93NUMPY\1\0\xff\x0f{'descr': ", 20),
                   "expected a header of 4105 bytes, got 20");
    assert_refused(temporary_file("empty.npy", "", 0), "got a file of 0 bytes");
    assert_refused(temporary_file("text.npy", "v 0 0 0\nv 1 1 1\n", 16), "got something else");
    assert_refused(temporary_file("short.mdd", "\0\0\0\5\0\0\0\4\0\0\0\0\0\0\0\0", 16),
                   "got a file that ends in frame 0");
    assert_refused(temporary_file("less.mdd", "\xff\xff\xff\xff\0\0\0\4\0\0\0\0\0\0\0\0", 16), "got -1 and 4");
    assert_refused("/nowhere.npy", "/nowhere.npy: cannot be opened");
    assert_refused("/tmp", "/tmp: expected a file");
}

TEST(a_number_that_is_none_is_named)
{
    static struct bytes b;
    double slab[FRAMES * COLUMNS];
    add_npy(&b, 1, DICTIONARY("'<f4'", "(5, 4, 3)"));
    for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&b, n == 2 * COLUMNS + 7 ? (double)NAN : 1, 4, false);
    struct motion motion;
    assert_done(motion_open(&motion, temporary_file("motion.npy", b.data, b.size), &error));
    assert_done(motion_columns(&motion, 0, 7, slab, &error));
    assert_refusal(motion_columns(&motion, 5, 4, slab, &error), "frame 2, vertex 2: expected a finite number");
    motion_close(&motion);
}

/// Headers changed at random: read or refused, never more (the sanitizers watch).
TEST(changed_headers_do_no_harm)
{
    static struct bytes good, b;
    uint32_t seed = 4711;
    int refused = 0;
    add_npy(&good, 1, "{'descr': '<f4', 'fortran_order': True, 'shape': (5, 4, 3), }");
    size_t header = good.size;
    for (int n = 0; n < FRAMES * COLUMNS; n++) add_number(&good, 1, 4, false);
    for (int round = 0; round < 1000; round++) {
        struct motion motion;
        struct error error;
        b = good;
        for (int k = 0; k < 2; k++) {
            seed = 1664525u * seed + 1013904223u;
            b.data[(seed >> 8) % header] = (unsigned char)(k == 0 ? '0' + round % 10 : (int)(seed >> 24));
        }
        if (motion_open(&motion, temporary_file("changed.npy", b.data, b.size), &error)) {
            double *slab = malloc((size_t)motion.frames * 3 * (size_t)motion.vertices * sizeof *slab);
            motion_columns(&motion, 0, 3 * motion.vertices, slab, &error);
            free(slab);
            motion_close(&motion);
        } else {
            refused++;
        }
    }
    assert_in_range(refused, 50, 999);
}
