/// Time: what the timing log writes, sums up and concludes, which is evidence and must be exact; and what the app does about slow frames.
#include "folder.h"

#include "app/state.h"
#include "maths/maths.h"
#include "regress/bootstrap.h"
#include "regress/log.h"
#include <sys/wait.h>
#include <unistd.h>

static char path[96], other_path[96];

// --- a log

static const struct frame_header header = {
    .gl_renderer = "test", .width = 1280, .height = 720, .scale = 1, .warm_up = 2, .first_frame_ms = NAN};

static struct framelog *open_log(const char *to, int capacity)
{
    struct framelog *log;
    assert_done(log = framelog_open(to, &header, capacity, &error));
    return log;
}

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

static void push(struct framelog *log, long frame, double ms)
{
    const struct frame_row pushed = row(frame, ms);
    framelog_push(log, &pushed);
}

/// Writes a log of `count` frames that take base + 0.01·(frame mod 10) ms; returns its summary.
static const char *write_log(const char *to, int count, int capacity, double base)
{
    static char text[1024];
    struct framelog *log = open_log(to, capacity);
    for (int i = 0; i < count; i++) push(log, i, base + 0.01 * (i % 10));
    memset(text, 0, sizeof text);
    FILE *summary = fmemopen(text, sizeof text - 1, "w");
    assert_non_null(summary);
    assert_done(framelog_close(log, summary, &error));
    fclose(summary);
    return text;
}

static void assert_has(const char *text, const char *part)
{
    if (!strstr(text, part)) fail_msg("no '%s' in:\n%s", part, text);
}

static struct timing_log read_log(void)
{
    struct timing_log log;
    assert_done(timing_log_read(path, &log, &error));
    return log;
}

/// The file's text, until the next call.
static const char *text_of_log(void)
{
    static char text[8192];
    char *data;
    size_t size;
    assert_done(file_read(path, sizeof text - 1, &data, &size, &error));
    strcpy(text, data);
    free(data);
    return text;
}

TEST(what_is_written_reads_back)
{
    write_log(path, 600, 4096, 10);
    struct timing_log log = read_log();
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

TEST(the_header_says_where_it_was_measured)
{
    static const char *const lines[] = {
        "# schema: " TIMING_SCHEMA "\n",
        "# wiggly: ",
        "# compiler: ",
        "# os: Linux",
        "# cpu: ",
        "# gl_renderer: test\n",
        "# size: 1280x720 scale 1\n",
        "# vsync: 0\n",
        "# solver: NA\n",
        "# warm_up_frames: 2\n",
        "# first_frame_ms: NA\n",
        "\n2,0.040000,10.0200,15.0200,10.0,0.0,0.0,1002.0,0.0,0.0,0.0,NA,0.0,0,121,5,0,NA,NA,0\n"};
    write_log(path, 3, 256, 10);
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++) assert_has(text_of_log(), lines[i]);
}

/// A switch in the middle of a session is said where it is made.
TEST(a_log_names_every_solver)
{
    static const char *const order[] = {"\n# solver: chain\n", "\nframe,", "\n# solver: band\n10,",
                                        "\n# solver: chain\n20,"};
    struct frame_header chain = header;
    struct framelog *log;
    chain.solver = "chain";
    assert_done(log = framelog_open(path, &chain, 256, &error));
    for (int i = 0; i < 30; i++) {
        struct frame_row frame = row(i, 10);
        frame.solver = i >= 10 && i < 20 ? "band" : "chain";
        framelog_push(log, &frame);
    }
    assert_done(framelog_close(log, NULL, &error));
    const char *text = text_of_log();
    for (int i = 0; i < 4; i++, text++) {
        assert_has(text, order[i]);
        text = strstr(text, order[i]);
    }
    struct timing_log read = read_log();
    assert_int_equal(read.rows, 28);
    assert_int_equal(read.runs, 1);
    timing_log_free(&read);
}

/// The file has all frames of a long session, the summary the last ones.
TEST(summaries)
{
    static const struct {
        int count, capacity;
        double base;
        const char *says[5];
    } rows[] = {
        // 500 frames 20 ms apart from the third on: 498 frames in 497·20 ms + the last one's 10.09 ms
        {500,
         4096,
         10,
         {"live: 498 frames in 9.95 s, 50.0 fps on average, without the warm-up ones",
          "frame_ms               10.050     10.090     10.090     10.090",
          "solve_us               1005.0     1009.0", "frame_interval_ms      15.050",
          "over 16.7 ms       0 of 498 frames (0.0 %), up to 0 in a row\nover 33.3 ms       0 of"}},
        {1002,
         4096,
         40,
         {"over 33.3 ms       1000 of 1000 frames (100.0 %), up to 1000 in a row",
          "1 % low            22.2 fps"}}, // of the intervals, which are 5 ms longer
        {2, 4096, 10, {"nothing to sum up"}},
        {1000, 256, 10, {"256 frames in 5.11 s"}},
    };
    for (int i = 0; i < 4; i++) {
        const char *text = write_log(i < 3 ? NULL : path, rows[i].count, rows[i].capacity, rows[i].base);
        for (int k = 0; k < 5 && rows[i].says[k]; k++) assert_has(text, rows[i].says[k]);
        if (i == 0) assert_true(!strstr(text, "1 % low") && !strstr(text, "event_to_swap_us")); // too few frames
    }
    struct timing_log log = read_log();
    assert_int_equal(log.rows, 998);
    timing_log_free(&log);
}

TEST(pushing_allocates_nothing)
{
    struct framelog *log = open_log(path, 1024);
    const long before = allocation_count();
    assert_true(before > 0);
    for (int i = 0; i < 700; i++) push(log, i, 10);
    assert_int_equal(allocation_count() - before, 0);
    assert_done(framelog_close(log, NULL, &error));
}

TEST(failures_name_the_path)
{
    struct error error = {0};
    assert_null(framelog_open("/no/such/folder/a.csv", &header, 256, &error));
    assert_int_equal(error.kind, ERROR_ENVIRONMENT);
    assert_has(error.text, "/no/such/folder/a.csv");
    struct framelog *log = open_log("/dev/full", 256);
    for (int i = 0; i < 1000; i++) push(log, i, 10);
    assert_false(framelog_close(log, NULL, &error));
    assert_has(error.text, "/dev/full: the timing log could not be written: No space left on device");
}

TEST(broken_logs_are_refused)
{
    static const char *const rows[][2] = {
        {"frame,t_s\n0,0\n", ":1: expected a timing log's '# schema:' line first"},
        {"# schema: wiggly-frames 99\n", ":1: expected the schema wiggly-frames 2, got 'wiggly-frames 99'"},
        {"# schema: wiggly-frames 2\nframe,t_s\n", ":2: expected the column names"},
        {"# schema: wiggly-frames 2\nframe,frame_ms,colour\n", ":2: expected the column names"},
        {"# schema: wiggly-frames 2\nframe,frame_ms\n0,1,2\n", ":3: expected a number or NA for each column"},
        {"# schema: wiggly-frames 2\nframe,frame_ms\n0\n", ":3: expected a number or NA for each column"},
        {"", "there are no frames"},
    };
    struct timing_log log;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        folder_file("log.csv", rows[i][0]);
        assert_refusal(timing_log_read(path, &log, &error), rows[i][1]);
    }
}

TEST(gpu_time_is_in_the_row_of_its_frame)
{
    struct framelog *log = open_log(path, 256);
    for (int i = 0; i < 600; i++) { // comes back three frames late; the last three never do
        if (i >= 3) framelog_gpu(log, i - 3, 1000 + (i - 3));
        framelog_gpu(log, i - 30, 1); // too late
        framelog_gpu(log, -1, 1);     // of no frame of the run
        push(log, i, 10);
    }
    assert_done(framelog_close(log, NULL, &error));
    struct timing_log read = read_log();
    for (int r = 0; r < read.rows; r++) {
        const double *values = &read.values[(size_t)r * COLUMN_COUNT];
        if (values[COLUMN_FRAME] < 597)
            assert_near(values[COLUMN_GPU_US], 1000 + values[COLUMN_FRAME], 0);
        else
            assert_true(isnan(values[COLUMN_GPU_US]));
    }
    timing_log_free(&read);
}

// --- statistics

TEST(quantiles_and_runs_over_a_budget)
{
    static const double at[][3] = {{4, 0, 1}, {4, 0.5, 2.5}, {4, 1, 4}, {1, 0.99, 1}};
    double values[] = {4, 1, 3, 2};
    qsort(values, 4, sizeof *values, maths_compare);
    for (int i = 0; i < 4; i++) assert_near(statistics_quantile(values, (int)at[i][0], at[i][1]), at[i][2], 0);
    assert_true(isnan(statistics_quantile(values, 0, 0.5)));
    const double ms[] = {20, 20, 10, 20, NAN, 20, 20, 20, 16};
    const struct over_budget over = statistics_over(ms, 9, 17);
    assert_int_equal(over.frames, 6);
    assert_int_equal(over.longest, 3); // what was not measured ends a run
}

enum { OBSERVED = 600 };

/// Frames of 10 ms ± 20 %, times `factor`, in stretches of 60 that slow down from 1 to 1 + 9·drift; sorted.
static void noisy(struct observation *items, unsigned seed, double factor, double drift)
{
    srand(seed);
    for (int i = 0; i < OBSERVED; i++) {
        const double noise = (double)rand() / RAND_MAX - 0.5;
        items[i] = (struct observation){factor * (10 + 4 * noise) * (1 + drift * (i / 60)), i / 60};
    }
    sort_observations(items, OBSERVED);
}

static double new_median(const int *weight, const void *user)
{
    const struct observation *const *sets = user;
    return weighted_quantile(sets[1], OBSERVED, weight, 0.5) / 10;
}

/// New over old, of the medians of two sets.
static double median_ratio(const int *weight, const void *user)
{
    const struct observation *const *sets = user;
    return 10 * new_median(weight, user) / weighted_quantile(sets[0], OBSERVED, weight, 0.5);
}

TEST(an_interval_covers_the_true_ratio_and_pairs_cancel_drift)
{
    static struct observation old[OBSERVED], new[OBSERVED];
    const struct observation *sets[] = {old, new};
    noisy(old, 1, 1, 0);
    noisy(new, 2, 1.2, 0);
    const struct estimate first = bootstrap(OBSERVED / 60, median_ratio, sets),
                          again = bootstrap(OBSERVED / 60, median_ratio, sets);
    assert_near(first.value, 1.2, 0.05);
    assert_true(first.low < 1.2 && 1.2 < first.high);
    assert_true(first.low > 1.1 && first.high < 1.3);
    assert_memory_equal(&first, &again, sizeof first); // a fixed seed: the same logs, the same verdict
    noisy(old, 1, 1, 0.1);                             // the machine slows down to half its speed over the ten pairs
    noisy(new, 2, 1.2, 0.1);
    const struct estimate alone = bootstrap(OBSERVED / 60, new_median, sets),
                          paired = bootstrap(OBSERVED / 60, median_ratio, sets);
    assert_true(paired.low < 1.2 && 1.2 < paired.high);
    assert_true(paired.high - paired.low < 0.5 * (alone.high - alone.low));
}

// --- timing_diff, the real program, on two logs

static char output[1 << 14];

/// Returns its exit status.
static int diff(void)
{
    char command[512];
    const char *build = getenv("B");
    snprintf(command, sizeof command, "%s/timing_diff %s %s 2>&1", build ? build : "build", path, other_path);
    FILE *stream = popen(command, "r");
    assert_non_null(stream);
    output[fread(output, 1, sizeof output - 1, stream)] = 0;
    const int status = pclose(stream);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(verdicts_of_timing_diff)
{
    static const struct {
        double old_ms, new_ms;
        int status;
    } rows[] = {{10, 10.1, 0}, // surely slower, but by less than 1.5 %
                {10, 10.3, 1},
                {10, 11.5, 1},
                {11.5, 10, 0}, // faster is no failure
                {10, 10, 0}};
    for (int i = 0; i < 5; i++) {
        write_log(path, 400, 512, rows[i].old_ms);
        write_log(other_path, 400, 512, rows[i].new_ms);
        if (diff() != rows[i].status) fail_msg("%g and %g ms:\n%s", rows[i].old_ms, rows[i].new_ms, output);
    }
    struct framelog *log = open_log(other_path, 512);
    for (int i = 0; i < 400; i++) {
        struct frame_row frame = row(i, 10 + 0.01 * (i % 10));
        frame.samples += i == 399; // one sample more, in one frame of four hundred
        framelog_push(log, &frame);
    }
    assert_done(framelog_close(log, NULL, &error));
    assert_int_equal(diff(), 1);
    write_log(other_path, 399, 512, 10); // a frame less
    assert_int_equal(diff(), 2);
    folder_file("other.csv", "");
    assert_int_equal(diff(), 2);
}

// --- planted delays: seeded logs of eleven pairs on a machine that drifts, stutters and is shared, with builds that draw in turn

enum { PAIRS = 11 };

/// What the new build does besides its work, in microseconds.
struct plant {
    double draw_factor; ///< draw takes so many times as long
    double every_frame;
    double hitch; ///< in every thirtieth frame
    bool wanders; ///< it comes in other frames in every run
    int stall;    ///< so many frames of 25 ms more in a row, once a run
};

static double uniform(void) { return (double)rand() / RAND_MAX; }

/// Log-normal with median 1.
static double spread(double sigma)
{
    return exp(sigma * sqrt(-2 * log(1 - uniform() * (1 - 1e-12))) * cos(2 * M_PI * uniform()));
}

/// One frame's work on this machine at this moment. A frame solves and redraws more every third time.
static struct frame_row work(int frame, double speed)
{
    const bool edits = frame % 3 == 0;
    const double stutter = uniform() < 0.02 ? 1 + 2 * uniform() : 1; // somebody else got the core
    struct frame_row row = {.frame = frame, .t_s = 0.02 * frame, .gpu_us = NAN, .event_to_swap_us = NAN};
    row.frame_interval_ms = NAN;
    row.solve_us = (edits ? 80 : 0.6) * speed * spread(0.1);
    row.pose_us = 400 * speed * spread(0.12);
    row.draw_us = (edits ? 5000 : 3200) * speed * spread(0.1) * stutter;
    row.swap_us = (edits ? 9000 : 7000) * speed * spread(0.25) * stutter;
    return row;
}

static void add_plant(struct frame_row *row, const struct plant *plant, int phase)
{
    row->draw_us *= plant->draw_factor > 0 ? plant->draw_factor : 1;
    row->swap_us += plant->every_frame;
    if (row->frame % 30 == (plant->wanders ? phase % 30 : 0)) row->swap_us += plant->hitch;
    if (row->frame >= 100 && row->frame < 100 + plant->stall) row->swap_us += 25000;
}

static void push_work(struct framelog *log, struct frame_row *row)
{
    row->frame_ms = (row->solve_us + row->pose_us + row->draw_us + row->swap_us) / 1000;
    framelog_push(log, row);
}

/// Both builds' logs. The machine's speed wanders from frame to frame, the same for both: they draw in turn.
static void write_pairs(unsigned seed, const struct plant *plant)
{
    const struct frame_header head = {.gl_renderer = "test", .warm_up = 10, .first_frame_ms = NAN};
    const int frames = quick_or_all(150, 300);
    char command[400];
    srand(seed);
    unlink(path);
    unlink(other_path);
    for (int pair = 0; pair < PAIRS; pair++) {
        struct framelog *old, *new;
        assert_done(old = framelog_open(folder_path("old"), &head, frames, &error));
        assert_done(new = framelog_open(folder_path("new"), &head, frames, &error));
        double speed = 0.8 + 0.8 * uniform(), luck = spread(0.003); // where the second build's memory came to lie
        const int phase = rand();
        for (int frame = 0; frame < frames; frame++) {
            speed = fmin(fmax(speed * spread(0.03), 0.8), 2.5);
            struct frame_row before = work(frame, speed), after = work(frame, speed * luck);
            add_plant(&after, plant, phase);
            push_work(old, &before);
            push_work(new, &after);
        }
        assert_done(framelog_close(old, NULL, &error) && framelog_close(new, NULL, &error));
        snprintf(command, sizeof command, "cd %s && cat old >>%s && cat new >>%s", folder, path, other_path);
        assert_int_equal(system(command), 0);
    }
}

/// Is there a line on this number, and does it end in SLOWER?
static bool is_slower(const char *number)
{
    char start[64] = "\n";
    strcat(start, number);
    const char *line = strstr(output, start);
    if (!line) fail_msg("no line '%s' in:\n%s", number, output);
    const char *verdict = strstr(line, "SLOWER"), *end = strchr(line + 1, '\n');
    return verdict && verdict < end;
}

/// The same build three times in a row says nothing; what is planted is found, and named.
TEST(planted_delays_are_found)
{
    static const struct {
        const char *what;
        struct plant plant;
        unsigned seed;
        const char *slower[2], *not_slower[2];
    } rows[] = {
        {"the same build", {.stall = 0}, 1, {0}, {0}},
        {"the same build", {.stall = 0}, 2, {0}, {0}},
        {"the same build", {.stall = 0}, 3, {0}, {0}},
        {"faster is no failure", {.draw_factor = 0.9}, 1, {0}, {0}},
        {"three percent in draw",
         {.draw_factor = 1.03},
         1,
         {"draw_us            p50"},
         {"pose_us            p50", "swap_us            p50"}},
        {"a hitch every thirtieth frame", // which is why medians alone will not do
         {.hitch = 25000},
         1,
         {"over 33.3 ms       share", "frame_ms           p99"},
         {"frame_ms           p50"}},
        {"in other frames of every run", {.hitch = 25000, .wanders = true}, 1, {"over 33.3 ms       share"}, {0}},
        {"a millisecond in every frame", {.every_frame = 1000}, 1, {"frame_ms           p50"}, {0}},
        {"a stall of eight frames", {.stall = 8}, 1, {"over 33.3 ms       longest"}, {0}},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (rows[i].seed > 1 && !is_thorough()) continue;
        write_pairs(rows[i].seed, &rows[i].plant);
        if (diff() != (rows[i].slower[0] ? 1 : 0)) fail_msg("%s, seed %u:\n%s", rows[i].what, rows[i].seed, output);
        for (int k = 0; k < 2; k++) {
            if (rows[i].slower[k] && !is_slower(rows[i].slower[k])) fail_msg("%s:\n%s", rows[i].what, output);
            if (rows[i].not_slower[k] && is_slower(rows[i].not_slower[k])) fail_msg("%s:\n%s", rows[i].what, output);
        }
    }
}

// --- who keeps the time: the display where swaps wait for it, else the app, at the display's own rate

/// Frames one after the other of `work_s` seconds each, on a display whose swaps wait for its next picture (or do not), behind a queue of so
/// many frames. Returns how long they took.
static double pace_frames(struct pace *pace, double *now, int frames, double work_s, double vsync, int queue)
{
    const double start = *now;
    double due = *now, shown = *now;
    for (int i = 0; i < frames; i++) {
        const double begin = fmax(*now, due);
        double done = begin + work_s;
        if (vsync > 0) {
            shown = vsync * ceil(fmax(done, shown + 0.5 * vsync) / vsync);
            done = fmax(done, shown - queue * vsync);
        }
        due = pace_next(pace, due, begin);
        pace_swapped(pace, done, true);
        *now = done;
    }
    return *now - start;
}

TEST(the_display_or_the_app_keeps_the_time)
{
    static const struct {
        double rate;
        bool holds; ///< the display
        double work;
        int warm_up;
    } rows[] = {{60, true, 0.0005, 500},  {75, true, 0.0005, 500},  {90, true, 0.0005, 500}, {120, true, 0.0005, 500},
                {144, true, 0.0005, 500}, {240, true, 0.0005, 500}, {0, false, 0.002, 60},   {60, false, 0.002, 60},
                {75, false, 0.002, 60},   {144, false, 0.002, 60}};
    for (int i = 0; i < 10; i++) {
        for (int queue = 0; queue < (rows[i].holds ? 3 : 1); queue++) {
            struct pace pace = {0};
            const double rate = rows[i].rate > 0 ? rows[i].rate : 60, vsync = rows[i].holds ? 1 / rate : 0;
            double now = 3.217;
            pace_set_rate(&pace, rows[i].rate);
            pace_frames(&pace, &now, rows[i].warm_up, rows[i].work, vsync, queue);
            assert_int_equal(pace.limits, !rows[i].holds);
            const double took = pace_frames(&pace, &now, 500, rows[i].work, vsync, queue);
            if (fabs(took - 500 / rate) > (rows[i].holds ? 3 : 2) / rate) fail_msg("row %d: %g s", i, took);
        }
    }
}

/// Slow frames are never held up, another display is judged anew, and waiting for input says nothing.
TEST(who_keeps_the_time_may_change)
{
    struct pace pace = {0}, idle = {0};
    double now = 1;
    pace_set_rate(&pace, 60);
    for (int k = 0; k < 2; k++) {
        assert_near(pace_frames(&pace, &now, 100, 0.03, 0, 0), 3, 1e-6);
        if (k == 0) assert_false(pace.limits);
        pace.limits = true;
    }
    pace.limits = false;
    pace_frames(&pace, &now, 60, 0.001, 0, 0);
    pace_set_rate(&pace, 60);
    assert_true(pace.limits);
    pace_set_rate(&pace, 144);
    assert_false(pace.limits);
    for (int i = 0; i < 200; i++) pace_swapped(&idle, 0.004 * i, i % 5 != 0);
    assert_false(idle.limits);
}

// --- when the stage is drawn at a lower resolution, and when exactly again

/// Moves for that many frames of that cost; returns the scale at the end.
static float move_at(struct resolution *r, double *now, int frames, struct resolution_cost cost)
{
    float scale = 1;
    for (int i = 0; i < frames; i++, *now += 1.0 / 60) {
        scale = resolution_choose(r, r->hash + 1, *now);
        resolution_measure(r, &cost);
    }
    return scale;
}

/// Frames of so long, of which drawing takes all but a millisecond.
static float move(struct resolution *r, double *now, int frames, double ms)
{
    return move_at(r, now, frames, (struct resolution_cost){.before = 1, .draw = ms - 1});
}

/// From a start. A slow solver is not the stage's; without a clock on the graphics card, its work is in the swap; with one, the swap only
/// waits for a slow display.
TEST(what_lowers_the_resolution)
{
    static const struct {
        const char *what;
        struct resolution_cost cost;
        bool lowers;
    } rows[] = {{"20 ms", {1, 19, 0, 0}, false},
                {"45 ms", {1, 44, 0, 0}, true},
                {"a slow solver", {50, 10, 0, 0}, false},
                {"a swap", {1, 1, 40, 0}, true},
                {"a display at 24 Hz", {1, 1, 40, 5}, false},
                {"a slow card", {1, 1, 1, 40}, true}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct resolution r;
        double now = 10;
        assert_true(resolution_parse(&r, "auto"));
        const float scale = move_at(&r, &now, i ? 100 : 30, rows[i].cost);
        if (rows[i].lowers ? scale >= 1 : scale < 1) fail_msg("%s: %g", rows[i].what, (double)scale);
    }
}

#define ADAPTING_TEST(name) TEST_OF(struct resolution, r, assert_true(resolution_parse(r, "auto")), (void)r, name)

ADAPTING_TEST(stillness_restores_the_resolution)
{
    double now = 10;
    assert_near(move(r, &now, 30, 20), 1, 0);
    assert_near(move(r, &now, 10, 45), 0.5, 0.13);
    assert_false(resolution_is_exact(r));
    assert_true(resolution_wait(r, now) > 0);
    now += 0.2;
    assert_near(resolution_wait(r, now), 0, 0);
    assert_near(resolution_choose(r, r->hash, now), 1, 0);
    assert_true(resolution_is_exact(r) && isinf(resolution_wait(r, now)));
    assert_near(resolution_choose(r, r->hash + 1, now + 5), 1, 0); // one change is no movement
    assert_true(resolution_choose(r, r->hash + 1, now + 5 + 1.0 / 60) < 1);
}

/// 40 ms at full resolution, 20 ms below: quick enough to try again and again.
ADAPTING_TEST(the_resolution_does_not_flicker)
{
    double now = 10;
    int changes = 0;
    float before = 1;
    for (int i = 0; i < 3600; i++) {
        const float scale = move(r, &now, 1, r->moving == 1 || r->moving == 0 ? 40 : 20);
        changes += scale != before;
        before = scale;
    }
    assert_in_range(changes, 3, 15);
}

ADAPTING_TEST(one_slow_frame_now_and_then_changes_nothing)
{
    double now = 10;
    for (int i = 0; i < 50; i++) {
        assert_near(move(r, &now, 1, 80), 1, 0);
        assert_near(move(r, &now, 5, 10), 1, 0);
    }
}

/// The card's clock still tells of the old resolution for a few frames: that is no reason for a second step.
ADAPTING_TEST(a_step_is_judged_by_its_own_frames)
{
    double now = 10;
    while (r->moving == 0) move(r, &now, 1, 40);
    assert_near(move(r, &now, 4, 40), 0.5, 0);
    assert_near(move(r, &now, 30, 28), 0.5, 0);
}

ADAPTING_TEST(a_busy_moment_is_forgotten)
{
    double now = 10;
    assert_true(move(r, &now, 20, 80) < 1);
    assert_near(move(r, &now, 400, 12), 1, 0);
    assert_near(r->moving, 1, 0); // there is nothing sharper
}

TEST(a_resolution_s_words)
{
    static const char *const bad[] = {"", "0", "0.2", "1.5", "half", "0.5x", "nan"};
    struct resolution r;
    double now = 0;
    assert_true(resolution_parse(&r, "0.5") && !r.adapts);
    assert_near(move(&r, &now, 100, 80), 0.5, 0);
    assert_true(resolution_parse(&r, "1") && resolution_is_exact(&r));
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) assert_false(resolution_parse(&r, bad[i]));
}

static int prepare(void **state)
{
    if (folder_make(state) != 0) return -1;
    snprintf(path, sizeof path, "%s", folder_path("log.csv"));
    snprintf(other_path, sizeof other_path, "%s", folder_path("other.csv"));
    return 0;
}

TESTS_BETWEEN(prepare, folder_remove)
