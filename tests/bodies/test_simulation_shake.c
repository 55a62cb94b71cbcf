/// What acts on a soft body from outside: a base that moves, gravity, a floor; where it is held and how soft it is.
#include "near.h"
#include "simulation/body.h"
#include "simulation/soft.h"
#include "temporary.h"

/// A box of `width` × `height` × `width` that stands on y = 0, white at its upper four corners and black below; made soft, and shaken.
struct box {
    float position[8][3], color[8][3];
    struct surface surface;
    struct soft_options options;
    struct soft soft;
    struct integrator integrator;
    struct floor floor;
};

/// In about as many tetrahedra; what else is wanted of its options is set before soften().
static void box_open(struct box *b, float width, float height, int tets)
{
    static uint32_t faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    *b = (struct box){.options = soft_default_options()};
    b->options.tets = tets;
    for (int i = 0; i < 8; i++) {
        const float p[3] = {(i & 4 ? 0.5f : -0.5f) * width, i & 2 ? height : 0.0f, (i & 1 ? 0.5f : -0.5f) * width};
        memcpy(b->position[i], p, sizeof p);
        for (int c = 0; c < 3; c++) b->color[i][c] = i & 2 ? 1.0f : 0.0f;
    }
    b->surface = (struct surface){
        .position = b->position, .color = b->color, .vertex_count = 8, .indices = faces[0], .index_count = 36};
}

static void soften(struct box *b) { assert_done(soft_create(&b->soft, &b->surface, "box", &b->options, &error)); }

static void integrate_by(struct box *b, double step, double tolerance)
{
    integrator_create(&b->integrator, &b->soft.body, step);
    b->integrator.tolerance = tolerance;
}

static void box_close(struct box *b)
{
    if (b->integrator.work) pool_free(&b->integrator.pool);
    pool_free(&b->floor.pool);
    soft_free(&b->soft);
}

#define BOX_TEST(name, width, height, tets)                                                                          \
    TEST_OF(struct box, b, box_open(b, width, height, tets), box_close(b), name)

/// Where the corners are now.
static void corners_of(const struct box *b, float place[8][3])
{
    lattice_embed(&b->soft.lattice, (const double(*)[3])b->integrator.x, place);
}

// --- loads

/// φᵀM d of the seen mode, d being one direction for all nodes, or their displacements.
static double project(const struct box *b, const double direction[3])
{
    const struct body *body = &b->soft.body;
    const double(*shape)[3] =
        (const double(*)[3])b->soft.modes.shape + (size_t)b->soft.seen * (size_t)body->node_count;
    double sum = 0;
    for (int i = 0; i < 3 * body->node_count; i++)
        sum += body->mass[i / 3] * shape[i / 3][i % 3] *
               (direction ? direction[i % 3] : b->integrator.x[i / 3][i % 3] - body->rest[i / 3][i % 3]);
    return sum;
}

/// Each mode of a body whose base moves a little is an oscillator that −Γ a(t) pushes: q'' + 2ζω q' + ω² q = −Γ a.
BOX_TEST(a_moving_base_shakes_a_mode_as_it_shakes_an_oscillator, 0.3f, 1, 150)
{
    const double side[3] = {1, 0, 0}, h = 2e-3, omega = 2 * M_PI * 2;
    struct shake shake = {.direction = {1, 0, 0}, .driven = true};
    struct base_drive drive = {
        .kind = DRIVE_BURST, .direction = {1, 0, 0}, .size = 1e-4, .frequency = 1.7, .seconds = 3};
    b->options.shake = &shake;
    b->options.damping = 0.1;
    soften(b);
    assert_near(soft_frequency(&b->soft), 2, 1e-9);
    integrate_by(b, h, 1e-10);
    b->integrator.mass_damping = b->soft.alpha;
    b->integrator.stiffness_damping = b->soft.beta;
    b->integrator.loads.drive = &drive;
    const double gamma = project(b, side);
    double q = 0, v = 0, difference = 0, size = 0;
    for (int step = 0; step < quick_or_all(400, 1000); step++) {
        for (int k = 0; k < 20; k++) { // symplectic Euler in steps of a twentieth
            const double a = drive_acceleration(&drive, (step + k / 20.0) * h);
            v += h / 20 * (-gamma * a - 2 * 0.1 * omega * v - omega * omega * q);
            q += h / 20 * v;
        }
        assert_true(integrator_step(&b->integrator));
        difference += pow(project(b, NULL) - q, 2);
        size += q * q;
    }
    print_message("differs from the oscillator by %.2g\n", sqrt(difference / size));
    assert_true(size > 0 && sqrt(difference / size) < 0.01);
    assert_int_equal(b->integrator.calmed, 0);
}

/// Under its weight a body rests where inner forces and weight balance, sunk and not moving.
BOX_TEST(gravity_is_settled_before_the_start, 0.4f, 1, 300)
{
    const struct body *body = &b->soft.body;
    b->options.frequency = 3;
    soften(b);
    integrate_by(b, 0.01, 1e-7);
    b->integrator.loads.gravity = 9.81;
    assert_true(integrator_find_equilibrium(&b->integrator));
    double(*held)[3] = calloc((size_t)body->node_count, sizeof *held), lowest = 0;
    memcpy(held, b->integrator.x, (size_t)body->node_count * sizeof *held);
    for (int step = 0; step < 50; step++) assert_true(integrator_step(&b->integrator));
    for (int i = 0; i < body->node_count; i++) {
        for (int c = 0; c < 3; c++) assert_near(b->integrator.x[i][c], held[i][c], 1e-5);
        lowest = fmin(lowest, held[i][1] - body->rest[i][1]);
    }
    assert_true(lowest < -1e-3);
    free(held);
}

/// A box that nothing holds, above a floor.
static void loose_open(struct box *b, double floor, double stiffness_damping, double mass_damping)
{
    box_open(b, 1, 1, 200);
    b->options.pin.kind = REGION_NONE;
    b->options.young = 1e5;
    soften(b);
    floor_create(&b->floor, &b->soft.lattice, &b->surface, floor, b->soft.young, b->options.density);
    integrate_by(b, 0.005, 1e-6);
    b->integrator.stiffness_damping = stiffness_damping;
    b->integrator.mass_damping = mass_damping;
    b->integrator.loads.gravity = 9.81;
    b->integrator.loads.floor = &b->floor;
}

/// It falls, bounces and comes to rest on the floor, no corner below it by more than a hundredth of the height.
TEST_OF(struct box, b, loose_open(b, -0.3, 0.01, 3), box_close(b), a_box_falls_on_the_floor_and_stays)
{
    float place[8][3], lowest = 1;
    for (int step = 0; step < 500; step++) {
        assert_true(integrator_step(&b->integrator));
        corners_of(b, place);
        for (int i = 0; i < 8; i++) lowest = fminf(lowest, place[i][1]);
    }
    print_message("lowest %.3f m, at the end %.3f m at %.2g m/s\n", (double)lowest, (double)place[0][1],
                  b->integrator.v[0][1]);
    assert_true(lowest > -0.3f - 0.1f);
    for (int i = 0; i < 8; i++)
        if (!(i & 2)) assert_near(place[i][1], -0.3, 0.01);
    for (int i = 0; i < b->soft.body.node_count; i++) assert_near(b->integrator.v[i][1], 0, 0.1);
}

/// What lies on the floor and has hardly any damping of its own stays in touch: its vertices do not go in and out with every step.
TEST(a_box_on_the_floor_does_not_chatter)
{
    enum { STEPS = 1800, LAST = 600, FEW = 60 };
    struct box box, *b = &box;
    bool below[8] = {false};
    int changes = 0;
    if (!is_thorough()) skip();
    loose_open(b, -0.1, 0.002, 0.5);
    for (int step = 0; step < STEPS; step++) {
        assert_true(integrator_step(&b->integrator));
        for (int i = 0; i < 8; i++) {
            changes += step >= STEPS - LAST && b->floor.touched[i] != below[i];
            below[i] = b->floor.touched[i];
        }
    }
    print_message("%d changes of touch in %d steps; %ld steps calmed\n", changes, LAST, b->integrator.calmed);
    assert_true(changes < FEW);
    assert_true(b->integrator.calmed < 5);
    box_close(b);
}

/// A clamped beam is as thick as its mesh and becomes softer with each doubling, towards Euler and Bernoulli's frequency, whatever the
/// height of the clamp is. It is square, so that it swings as fast to either side.
TEST(a_beam_is_monotone_under_refinement)
{
    const double young = 1e6, length = 7.6;
    const double slender = 1.8751040687 * 1.8751040687 / (2 * M_PI * length * length) * sqrt(young / (12 * 1000));
    double before = INFINITY;
    for (int tets = 400; tets <= quick_or_all(1600, 12800); tets *= 2) {
        struct box b;
        double volume = 0;
        box_open(&b, 1, 8, tets);
        b.options.young = young;
        b.options.poisson = 0;
        b.options.shake = &(struct shake){.direction = {1, 0, 0}, .amplitude = 0.1};
        b.options.pin = (struct region){.kind = REGION_FOOT, .size = 0.4};
        soften(&b);
        const struct lattice *lattice = &b.soft.lattice;
        const double *frequency = b.soft.modes.frequency, ratio = frequency[0] / slender;
        for (int e = 0; e < lattice->tet_count; e++) volume += lattice->fraction[e] / 12 * pow(lattice->cell, 3) / 8;
        print_message("%d tetrahedra, volume %.3f: %.4f of Euler and Bernoulli's\n", lattice->tet_count, volume,
                      ratio);
        assert_near(volume, 1, 0.02);
        assert_true(ratio < before && ratio > 0.985);
        assert_near(frequency[1] / frequency[0], 1, 0.02); // 1.05 if one side has all diagonals
        before = ratio;
        box_close(&b);
    }
    assert_near(before, 1, is_thorough() ? 0.0155 : 0.075);
}

// --- where it is held, and how soft it is

/// Wherever a box is held, its far end moves by the amplitude times its length that way.
TEST(a_shake_grows_away_from_the_pinned_side)
{
    static const struct {
        const char *where;
        int axis;
        float far_end;
    } rows[] = {{"0.1", 1, 1}, {"plane:0,0.9,0,0,-1,0", 1, 0}, {"plane:-0.4,0,0,1,0,0", 0, 0.5f}};
    const struct shake shake = {.direction = {0, 0, 1}, .amplitude = 0.2};
    for (int row = 0; row < 3; row++) {
        struct box b;
        float place[8][3], most = 0;
        box_open(&b, 1, 1, 300);
        b.options.shake = &shake;
        assert_true(region_parse(rows[row].where, &b.options.pin));
        soften(&b);
        integrate_by(&b, 0.01, 1e-6);
        soft_shake(&b.soft, &shake, &b.integrator);
        corners_of(&b, place);
        for (int i = 0; i < 8; i++)
            if (b.position[i][rows[row].axis] == rows[row].far_end)
                most = fmaxf(most, place[i][2] - b.position[i][2]);
        if (!(b.soft.share > 0.5) || fabs((double)most - 0.2) > 0.05)
            fail_msg("%s: moves by %g, %g of it in the mode", rows[row].where, (double)most, b.soft.share);
        box_close(&b);
    }
}

TEST(regions_hold_what_they_name)
{
    static const struct {
        const char *where;
        int least; ///< nodes; none: no more
    } rows[] = {{"plane:0,0.7,0,0,-1,0", 5}, {"sphere:0,1,0,0.3", 1}, {"color:FFFFFF", 1}, {"none", 0}}; // the top
    static const char *const wrong[] = {
        "",          "foot",           "-1",          "0.1,2",        "plane:0,0,0,0,0,0",
        "plane:1,2", "sphere:0,0,0,0", "color:12345", "color:GGGGGG", "0.1m"};
    for (int row = 0; row < 4; row++) {
        struct box b;
        int low = 0;
        box_open(&b, 0.5f, 1, 300);
        assert_true(region_parse(rows[row].where, &b.options.pin));
        soften(&b);
        for (int i = 0; i < b.soft.body.node_count; i++) low += b.soft.body.pinned[i] && b.soft.body.rest[i][1] < 0.5;
        if (low > 0 || b.soft.pinned < rows[row].least || !b.soft.pinned != !rows[row].least)
            fail_msg("%s: %d nodes, %d of them low", rows[row].where, b.soft.pinned, low);
        box_close(&b);
    }
    static const char *const refused[][2] = {
        {"sphere:9,9,9,0.1", "box: the region of --pin holds nothing: it is off"},
        {"2", "box: nothing can move: all of it is in the region of --pin"}};
    for (int i = 0; i < 2; i++) {
        struct box b;
        box_open(&b, 0.5f, 1, 300);
        assert_true(region_parse(refused[i][0], &b.options.pin));
        assert_refusal(soft_create(&b.soft, &b.surface, "box", &b.options, &error), refused[i][1]);
        box_close(&b);
    }
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        struct region region;
        if (region_parse(wrong[i], &region)) fail_msg("\"%s\" is a region", wrong[i]);
    }
}

/// Where nobody says what is held, the lowest twentieth of the height is, up to a layer of nodes that lies there.
BOX_TEST(the_lowest_twentieth_is_held, 0.5f, 1, 800)
{
    const struct body *body = &b->soft.body;
    double highest = -1, lowest_free = INFINITY;
    soften(b);
    for (int i = 0; i < body->node_count; i++) {
        const double y = body->rest[i][1];
        if (body->pinned[i]) highest = fmax(highest, y);
        if (!body->pinned[i]) lowest_free = fmin(lowest_free, y);
    }
    assert_near(highest, 0.05, 1e-6);
    assert_true(lowest_free > highest + 0.01);
}

/// By distance and by brightness alike the box is N times softer at its top than at its foot, and evenly in between.
TEST(softness_falls_as_the_map_says)
{
    static const char *const maps[] = {"distance", "color"};
    for (int m = 0; m < 2; m++) {
        struct box b;
        double least = 1, most = 0;
        box_open(&b, 0.3f, 1, 500);
        b.options.softness = (struct softness){.from = maps[m], .times = 8};
        soften(&b);
        for (int e = 0; e < b.soft.body.element_count; e++) {
            least = fmin(least, b.soft.body.elements[e].stiffness);
            most = fmax(most, b.soft.body.elements[e].stiffness);
        }
        if (!(least * 8 < 1.5 && least * 8 > 0.999 && most > 0.6 && most < 1.001))
            fail_msg("%s: %.3f … %.3f", maps[m], least, most);
        box_close(&b);
    }
}

// --- tracks

static bool read_track(struct base_drive *drive, const char *text, struct error *error)
{
    *drive = (struct base_drive){.size = 1};
    return drive_read_track(drive, temporary_file("track.csv", text, strlen(text)), error);
}

/// A track's spline goes through its samples, and its second derivative is the acceleration.
TEST(a_track_is_smooth)
{
    static const double samples[5][2] = {{0, 0}, {0.1, 0.02}, {0.3, -0.01}, {0.4, 0.03}, {0.7, 0}};
    const double h = 1e-4;
    struct base_drive drive;
    assert_done(read_track(&drive, "seconds,metres\n0, 0\n0.1, 0.02\n0.3, -0.01\n0.4, 0.03\n0.7, 0\n", &error));
    for (int i = 0; i < 5; i++) assert_near(drive_place(&drive, samples[i][0]), samples[i][1], 1e-12);
    for (double t = 0.05; t < 0.65; t += 0.0417) {
        const double bend = drive_place(&drive, t + h) - 2 * drive_place(&drive, t) + drive_place(&drive, t - h);
        assert_near(drive_acceleration(&drive, t), bend / (h * h), 0.01);
    }
    pool_free(&drive.pool);
}

/// Numbers that a spline through them would leave the finite ones with are refused with their line.
TEST(a_track_stays_finite)
{
    static const struct {
        const char *text, *says; // no sentence: it is taken
    } rows[] = {
        {"-1e9,-1e9\n-999999999.5,1e9\n1e9,-1e9\n", NULL},
        {"0,0\n1e-9,1e9\n2.5e-9,0\n", NULL},
        {"0,0\n1,1.1e9\n", "track.csv:2: expected two numbers up to 1e9, \"seconds,displacement\", got '1,1.1e9'"},
        {"-1.1e9,0\n1,1\n", "track.csv:1: expected two numbers up to 1e9"},
        {"0,1e308\n1,-1e308\n", "track.csv:1: expected two numbers up to 1e9"},
        {"0,0\n\n0.9e-9,1\n", "track.csv:3: expected a time a nanosecond or more after 0, got 9e-10"},
        {"0,0\n1e-320,1\n", "track.csv:2: expected a time a nanosecond or more after 0"},
        {"1,0\n0,1\n", "track.csv:2: expected a time a nanosecond or more after 1, got 0"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        struct base_drive drive;
        struct error error = {0};
        const bool good = read_track(&drive, rows[i].text, &error);
        if (good != !rows[i].says || (!good && !strstr(error.text, rows[i].says)))
            fail_msg("case %zu: %s", i, good ? "taken" : error.text);
        for (int k = 0; good && k < drive.count; k++) {
            assert_true(isfinite(drive_place(&drive, drive.time[k])));
            assert_true(isfinite(drive_acceleration(&drive, drive.time[k])));
        }
        pool_free(&drive.pool);
    }
}
