/// The timing log is evidence: what it writes, what it sums up and what timing_diff concludes must be exact.
#include "folder.h"
#include "regress/bootstrap.h"
#include "timing/framelog.h"
#include <unistd.h>

static char path[96], other_path[96];

static const struct frame_header header = {.gl_renderer = "test",
                                           .width = 1280,
                                           .height = 720,
                                           .scale = 1,
                                           .warm_up = 2,
                                           .reference_ms = 9.5,
                                           .first_frame_ms = NAN};

/// A frame that took `ms`, with everything else told apart by its number.
static struct frame_row row(long frame, double ms)
{
    return (struct frame_row){.frame = frame,
                              .t_s = 0.02 * (double)frame,
                              .frame_ms = ms,
                              .frame_interval_ms = ms + 5,
                              .wait_us = 10,
                              .solve_us = 100 * ms,
                              .gpu_us = NAN,
                              .splines_solved = frame % 2,
                              .samples = 121,
                              .knots = 5,
                              .event_to_swap_us = NAN,
                              .allocations = -1};
}

static struct framelog *open_log(const char *to, const struct frame_header *with, int capacity)
{
    struct framelog *log;
    assert_done(log = framelog_open(to, with, capacity, &error));
    return log;
}

static void push(struct framelog *log, long frame, double ms)
{
    const struct frame_row pushed = row(frame, ms);
    framelog_push(log, &pushed);
}

/// Writes a log of `count` frames that take base + 0.01·(frame mod 10) ms; returns its summary in `text`.
static void write_log(const char *to, int count, int capacity, double base, char *text, size_t size)
{
    struct framelog *log = open_log(to, &header, capacity);
    for (int i = 0; i < count; i++) {
        push(log, i, base + 0.01 * (i % 10));
    }
    memset(text, 0, size);
    FILE *summary = fmemopen(text, size - 1, "w");
    assert_non_null(summary);
    assert_done(framelog_close(log, summary, &error));
    fclose(summary);
}

TEST(test_what_is_written_reads_back)
{
    char text[1024];
    write_log(path, 600, 4096, 10, text, sizeof text);
    struct timing_log log;
    assert_done(timing_log_read(path, &log, &error));
    assert_int_equal(log.rows, 598); // the two warm-up frames are left out
    assert_int_equal(log.runs, 1);
    const double *last = &log.values[597 * COLUMN_COUNT];
    assert_near(last[COLUMN_FRAME], 599, 0);
    assert_near(last[COLUMN_TIME], 11.98, 1e-6);
    assert_near(last[COLUMN_FRAME_MS], 10.09, 1e-4);
    assert_near(last[COLUMN_SOLVE_US], 1009, 0.1);
    assert_true(isnan(last[COLUMN_EVENT_TO_SWAP_US]));
    assert_true(isnan(last[18])); // allocations that were not measured are not 0
    timing_log_free(&log);
}

TEST(test_header_says_where_it_was_measured)
{
    char text[1024], *file_text;
    size_t length;
    write_log(path, 3, 256, 10, text, sizeof text);
    assert_done(file_read(path, 4096, &file_text, &length, &error));
    const char *keys[] = {"# schema: " TIMING_SCHEMA "\n",
                          "# wiggly: ",
                          "# compiler: ",
                          "# os: Linux",
                          "# cpu: ",
                          "# gl_renderer: test\n",
                          "# size: 1280x720 scale 1\n",
                          "# vsync: 0\n",
                          "# solver: NA\n",
                          "# warm_up_frames: 2\n",
                          "# reference_frame_ms: 9.500\n",
                          "# first_frame_ms: NA\n"};
    for (size_t i = 0; i < sizeof keys / sizeof keys[0]; i++) {
        if (!strstr(file_text, keys[i])) fail_msg("the header lacks %s:\n%s", keys[i], file_text);
    }
    assert_non_null(
        strstr(file_text, "\n2,0.040000,10.0200,15.0200,10.0,0.0,0.0,1002.0,0.0,0.0,0.0,NA,0.0,0,121,5,0,NA,NA,0\n"));
    free(file_text);
}

/// A switch in the middle of a session is said where it is made; reading finds both names, each once.
TEST(test_a_log_names_every_solver)
{
    struct frame_header chain = header;
    chain.solver = "chain";
    struct framelog *log = open_log(path, &chain, 256);
    for (int i = 0; i < 30; i++) {
        struct frame_row frame = row(i, 10);
        frame.solver = i >= 10 && i < 20 ? "band" : "chain";
        framelog_push(log, &frame);
    }
    assert_done(framelog_close(log, NULL, &error));
    char *text;
    size_t length;
    assert_done(file_read(path, 8192, &text, &length, &error));
    const char *first = strstr(text, "\n# solver: chain\n"), *names = strstr(text, "\nframe,");
    const char *switched = strstr(text, "\n# solver: band\n10,"), *back = strstr(text, "\n# solver: chain\n20,");
    assert_true(first && names && switched && back && first < names && names < switched && switched < back);
    struct timing_log read;
    assert_done(timing_log_read(path, &read, &error));
    assert_int_equal(read.rows, 28);
    assert_int_equal(read.runs, 1);
    assert_string_equal(read.solvers, "chain, band");
    free(text);
    timing_log_free(&read);
}

TEST(test_summary)
{
    char text[1024];
    // 500 frames 20 ms apart from the third on: 498 frames in 497·20 ms + the last one's 10.09 ms
    write_log(NULL, 500, 4096, 10, text, sizeof text);
    assert_non_null(
        strstr(text, "live: 498 frames of 1 run in 9.95 s, 50.0 fps on average, without the warm-up ones"));
    assert_non_null(strstr(text, "frame_ms               10.050     10.090     10.090     10.090"));
    assert_non_null(strstr(text, "solve_us               1005.0     1009.0"));
    assert_non_null(strstr(text, "frame_interval_ms      15.050"));
    assert_non_null(
        strstr(text, "over 16.7 ms       0 of 498 frames (0.0 %), up to 0 in a row\nover 33.3 ms       0 of"));
    assert_null(strstr(text, "1 % low")); // too few frames for it
    assert_null(strstr(text, "event_to_swap_us"));

    write_log(NULL, 1002, 4096, 40, text, sizeof text);
    assert_non_null(strstr(text, "over 33.3 ms       1000 of 1000 frames (100.0 %), up to 1000 in a row"));
    assert_non_null(strstr(text, "1 % low            22.2 fps")); // of the intervals, which are 5 ms longer

    write_log(NULL, 2, 4096, 10, text, sizeof text);
    assert_non_null(strstr(text, "nothing to sum up"));
}

TEST(test_long_session_keeps_the_last_frames)
{
    char text[1024];
    write_log(path, 1000, 256, 10, text, sizeof text);
    assert_non_null(strstr(text, "256 frames of 1 run in 5.11 s"));
    struct timing_log log;
    assert_done(timing_log_read(path, &log, &error));
    assert_int_equal(log.rows, 998); // the file has them all
    timing_log_free(&log);
}

TEST(test_pushing_allocates_nothing)
{
    struct framelog *log = open_log(path, &header, 1024);
    long before = allocation_count();
    assert_true(before > 0);
    for (int i = 0; i < 700; i++) {
        push(log, i, 10);
    }
    assert_int_equal(allocation_count() - before, 0);
    assert_done(framelog_close(log, NULL, &error));
}

TEST(test_failures_name_the_path)
{
    struct error error = {0};
    assert_null(framelog_open("/no/such/folder/a.csv", &header, 256, &error));
    assert_int_equal(error.kind, ERROR_ENVIRONMENT);
    assert_non_null(strstr(error.text, "/no/such/folder/a.csv"));

    struct framelog *log = open_log("/dev/full", &header, 256);
    for (int i = 0; i < 1000; i++) {
        push(log, i, 10);
    }
    assert_false(framelog_close(log, NULL, &error));
    assert_non_null(strstr(error.text, "/dev/full: the timing log could not be written: No space left on device"));
}

TEST(test_broken_logs_are_refused)
{
    const struct {
        const char *text, *says;
    } cases[] = {
        {"frame,t_s\n0,0\n", ":1: expected a timing log's '# schema:' line first"},
        {"# schema: wiggly-frames 99\n",
         ":1: expected the schema wiggly-frames 2 or wiggly-frames 1, got 'wiggly-frames 99'"},
        {"# schema: wiggly-frames 2\nframe,t_s\n", ":2: expected the column names"},
        {"# schema: wiggly-frames 2\nframe,frame_ms,colour\n", ":2: expected the column names"},
        {"# schema: wiggly-frames 2\nframe,frame_ms\n0,1,2\n", ":3: expected a number or NA for each column"},
        {"# schema: wiggly-frames 2\nframe,frame_ms\n0\n", ":3: expected a number or NA for each column"},
        {"", "there are no frames"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct timing_log log;
        folder_file("log.csv", cases[i].text);
        assert_refusal(timing_log_read(path, &log, &error), cases[i].says);
    }
}

TEST(test_quantiles)
{
    double values[] = {4, 1, 3, 2};
    statistics_sort(values, 4);
    assert_near(statistics_quantile(values, 4, 0), 1, 0);
    assert_near(statistics_quantile(values, 4, 0.5), 2.5, 0);
    assert_near(statistics_quantile(values, 4, 1), 4, 0);
    assert_near(statistics_quantile(values, 1, 0.99), 1, 0);
    assert_true(isnan(statistics_quantile(values, 0, 0.5)));
}

TEST(test_runs_of_frames_over_a_budget)
{
    const double ms[] = {20, 20, 10, 20, NAN, 20, 20, 20, 16};
    struct over_budget over = statistics_over(ms, 9, 17);
    assert_int_equal(over.frames, 6);
    assert_int_equal(over.longest, 3); // what was not measured ends a run
}

enum { FRAMES = 600 };

/// Frames of 10 ms ± 20 %, times `factor`, in stretches of 60 that slow down from 1 to 1 + 9·drift; sorted.
static void noisy(struct observation *items, unsigned seed, double factor, double drift)
{
    srand(seed);
    for (int i = 0; i < FRAMES; i++) {
        double noise = (double)rand() / RAND_MAX - 0.5;
        items[i] = (struct observation){factor * (10 + 4 * noise) * (1 + drift * (i / 60)), i / 60};
    }
    sort_observations(items, FRAMES);
}

/// New over old, of the medians of two sets of FRAMES observations.
static double median_ratio(const int *weight, const void *user)
{
    const struct observation *const *sets = user;
    return weighted_quantile(sets[1], FRAMES, weight, 0.5) / weighted_quantile(sets[0], FRAMES, weight, 0.5);
}

static double new_median(const int *weight, const void *user)
{
    const struct observation *const *sets = user;
    return weighted_quantile(sets[1], FRAMES, weight, 0.5) / 10;
}

TEST(test_interval_covers_the_true_ratio)
{
    static struct observation old[FRAMES], new[FRAMES];
    const struct observation *sets[] = {old, new};
    struct estimate first, again;
    noisy(old, 1, 1, 0);
    noisy(new, 2, 1.2, 0);
    first = bootstrap(FRAMES / 60, median_ratio, sets);
    assert_near(first.value, 1.2, 0.05);
    assert_true(first.low < 1.2 && 1.2 < first.high);
    assert_true(first.low > 1.1 && first.high < 1.3);
    again = bootstrap(FRAMES / 60, median_ratio, sets);
    assert_memory_equal(&first, &again, sizeof first); // a fixed seed: the same logs, the same verdict
}

TEST(test_pairs_cancel_drift)
{
    static struct observation old[FRAMES], new[FRAMES];
    const struct observation *sets[] = {old, new};
    struct estimate alone, paired;
    noisy(old, 1, 1, 0.1); // the machine slows down to half its speed over the ten pairs
    noisy(new, 2, 1.2, 0.1);
    alone = bootstrap(FRAMES / 60, new_median, sets);
    paired = bootstrap(FRAMES / 60, median_ratio, sets);
    assert_true(paired.low < 1.2 && 1.2 < paired.high);
    assert_true(paired.high - paired.low < 0.5 * (alone.high - alone.low));
}

TEST(test_gpu_time_is_in_the_row_of_its_frame)
{
    struct framelog *log = open_log(path, &header, 256);
    for (int i = 0; i < 600; i++) { // comes back three frames late; the last three never do
        if (i >= 3) framelog_gpu(log, i - 3, 1000 + (i - 3));
        framelog_gpu(log, i - 30, 1); // too late
        framelog_gpu(log, -1, 1);     // of no frame of the run
        push(log, i, 10);
    }
    assert_done(framelog_close(log, NULL, &error));
    struct timing_log read;
    assert_done(timing_log_read(path, &read, &error));
    for (int r = 0; r < read.rows; r++) {
        const double *values = &read.values[(size_t)r * COLUMN_COUNT];
        if (values[COLUMN_FRAME] < 597) assert_near(values[COLUMN_GPU_US], 1000 + values[COLUMN_FRAME], 0);
        if (values[COLUMN_FRAME] >= 597) assert_true(isnan(values[COLUMN_GPU_US]));
    }
    timing_log_free(&read);
}

TEST(test_logs_of_the_schema_before_are_read)
{
    folder_file("log.csv", "# schema: wiggly-frames 1\nframe,t_s,frame_ms,wait_us\n0,0.5,16.5,NA\n");
    struct timing_log log;
    assert_done(timing_log_read(path, &log, &error));
    assert_near(log.values[COLUMN_FRAME_MS], 16.5, 0);
    assert_true(isnan(log.values[COLUMN_FRAME_INTERVAL_MS]));
    assert_true(isnan(log.values[COLUMN_SWAP_US]));
    timing_log_free(&log);
}

/// The real program on the two logs; returns its exit status.
static int diff_status(void)
{
    char command[512];
    const char *build = getenv("B");
    snprintf(command, sizeof command, "%s/timing_diff %s %s > /dev/null 2>&1", build ? build : "build", path,
             other_path);
    int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static int diff_status_of(double old_ms, double new_ms)
{
    char text[1024];
    write_log(path, 400, 512, old_ms, text, sizeof text);
    write_log(other_path, 400, 512, new_ms, text, sizeof text);
    return diff_status();
}

TEST(test_timing_diff_verdicts)
{
    assert_int_equal(diff_status_of(10, 10), 0);
    assert_int_equal(diff_status_of(10, 10.1), 0); // surely slower, but by less than 1.5 %
    assert_int_equal(diff_status_of(10, 10.3), 1);
    assert_int_equal(diff_status_of(10, 11.5), 1);
    assert_int_equal(diff_status_of(11.5, 10), 0); // faster is no failure
}

TEST(test_timing_diff_compares_counters_exactly)
{
    char text[1024];
    assert_int_equal(diff_status_of(10, 10), 0);
    struct framelog *log = open_log(other_path, &header, 512);
    for (int i = 0; i < 400; i++) {
        struct frame_row frame = row(i, 10 + 0.01 * (i % 10));
        frame.samples += i == 399; // one sample more, in one frame of four hundred
        framelog_push(log, &frame);
    }
    assert_done(framelog_close(log, NULL, &error));
    assert_int_equal(diff_status(), 1);
    write_log(other_path, 399, 512, 10, text, sizeof text); // a frame less
    assert_int_equal(diff_status(), 2);
    folder_file("other.csv", "");
    assert_int_equal(diff_status(), 2);
}

static int make_folder(void **state)
{
    if (folder_make(state) != 0) return -1;
    snprintf(path, sizeof path, "%s", folder_path("log.csv"));
    snprintf(other_path, sizeof other_path, "%s", folder_path("other.csv"));
    return 0;
}

TESTS_BETWEEN(make_folder, folder_remove)
