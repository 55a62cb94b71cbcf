/// Planted delays: timing_diff on seeded logs of eleven pairs on a machine that drifts, stutters and is shared, with builds that
/// draw in turn (make regress). The same build three times in a row says nothing; what is planted is found, and named.
#include "folder.h"
#include "timing/framelog.h"
#include <sys/wait.h>
#include <unistd.h>

enum { PAIRS = 11, FRAMES = 300, WARM_UP = 10 };

static char old_path[96], new_path[96], run_path[96];

/// What the new build does besides its work, in microseconds.
struct plant {
    double draw_factor; ///< draw takes so many times as long
    double every_frame;
    double hitch; ///< in every `period`-th frame
    int period;   ///< 0: no hitch
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
    bool edits = frame % 3 == 0;
    double stutter = uniform() < 0.02 ? 1 + 2 * uniform() : 1; // somebody else got the core
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
    if (plant->period && row->frame % plant->period == (plant->wanders ? phase % plant->period : 0))
        row->swap_us += plant->hitch;
    if (row->frame >= 200 && row->frame < 200 + plant->stall) row->swap_us += 25000;
}

static void push(struct framelog *log, struct frame_row *row)
{
    row->frame_ms = (row->solve_us + row->pose_us + row->draw_us + row->swap_us) / 1000;
    framelog_push(log, row);
}

static struct framelog *open_run(const char *path)
{
    struct frame_header header = {
        .gl_renderer = "test", .warm_up = WARM_UP, .reference_ms = NAN, .first_frame_ms = NAN};
    struct framelog *log;
    assert_done(log = framelog_open(path, &header, FRAMES, &error));
    return log;
}

static void append(const char *from, const char *to)
{
    static char text[1 << 16];
    FILE *in = fopen(from, "r"), *out = fopen(to, "a");
    assert_true(in && out);
    for (size_t size; (size = fread(text, 1, sizeof text, in)) > 0;)
        assert_int_equal(fwrite(text, 1, size, out), size);
    fclose(in);
    assert_int_equal(fclose(out), 0);
}

/// Both builds' logs. The machine's speed wanders from frame to frame, the same for both: they draw in turn.
static void write_logs(unsigned seed, const struct plant *plant)
{
    srand(seed);
    unlink(old_path);
    unlink(new_path);
    for (int pair = 0; pair < PAIRS; pair++) {
        const char *second_path = folder_path("second.csv");
        struct framelog *old = open_run(run_path), *new = open_run(second_path);
        double speed = 0.8 + 0.8 * uniform(), luck = spread(0.003); // where the second build's memory came to lie
        int phase = rand();
        for (int frame = 0; frame < FRAMES; frame++) {
            speed = fmin(fmax(speed * spread(0.03), 0.8), 2.5);
            struct frame_row before = work(frame, speed), after = work(frame, speed * luck);
            add_plant(&after, plant, phase);
            push(old, &before);
            push(new, &after);
        }
        assert_done(framelog_close(old, NULL, &error) && framelog_close(new, NULL, &error));
        append(run_path, old_path);
        append(second_path, new_path);
        unlink(run_path);
        unlink(second_path);
    }
}

static char output[1 << 14]; ///< of timing_diff

/// Writes the logs and compares them; returns timing_diff's exit status.
static int compare(unsigned seed, const struct plant *plant)
{
    char command[512];
    const char *build = getenv("B");
    write_logs(seed, plant);
    snprintf(command, sizeof command, "%s/timing_diff %s %s", build ? build : "build", old_path, new_path);
    FILE *diff = popen(command, "r");
    assert_non_null(diff);
    output[fread(output, 1, sizeof output - 1, diff)] = 0;
    int status = pclose(diff);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// Is there a line on this number of this name, and does it end in SLOWER?
static bool is_slower(const char *name, const char *number)
{
    char start[64];
    snprintf(start, sizeof start, "\n%-18s %s", name, number);
    const char *line = strstr(output, start);
    if (!line) fail_msg("no line '%s' in:\n%s", start + 1, output);
    const char *verdict = strstr(line, "SLOWER"), *end = strchr(line + 1, '\n');
    return verdict && verdict < end;
}

static void expect_slower(const struct plant *plant, const char *name, const char *number)
{
    int status = compare(1, plant);
    if (status != 1 || !is_slower(name, number)) fail_msg("%s %s is not SLOWER:\n%s", name, number, output);
}

TEST(test_the_same_build_says_nothing)
{
    for (unsigned seed = 1; seed <= (unsigned)quick_or_all(1, 3); seed++) {
        if (compare(seed, &(struct plant){0}) != 0) fail_msg("seed %u: a false alarm:\n%s", seed, output);
    }
}

TEST(test_three_percent_in_draw)
{
    expect_slower(&(struct plant){.draw_factor = 1.03}, "draw_us", "p50");
    assert_false(is_slower("pose_us", "p50"));
    assert_false(is_slower("swap_us", "p50"));
}

TEST(test_a_hitch_every_thirtieth_frame)
{
    expect_slower(&(struct plant){.hitch = 25000, .period = 30}, "over 33.3 ms", "share");
    assert_true(is_slower("frame_ms", "p99"));
    assert_false(is_slower("frame_ms", "p50")); // which is why medians alone will not do
}

TEST(test_a_hitch_in_other_frames_of_every_run)
{
    expect_slower(&(struct plant){.hitch = 25000, .period = 30, .wanders = true}, "over 33.3 ms", "share");
}

TEST(test_a_millisecond_in_every_frame) { expect_slower(&(struct plant){.every_frame = 1000}, "frame_ms", "p50"); }

TEST(test_a_stall_of_eight_frames) { expect_slower(&(struct plant){.stall = 8}, "over 33.3 ms", "longest"); }

TEST(test_faster_is_no_failure) { assert_int_equal(compare(1, &(struct plant){.draw_factor = 0.9}), 0); }

static int make_folder(void **state)
{
    if (folder_make(state) != 0) return -1;
    snprintf(old_path, sizeof old_path, "%s", folder_path("old.csv"));
    snprintf(new_path, sizeof new_path, "%s", folder_path("new.csv"));
    snprintf(run_path, sizeof run_path, "%s", folder_path("run.csv"));
    return 0;
}

TESTS_BETWEEN(make_folder, folder_remove)
