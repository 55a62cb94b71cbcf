/// What acts on a soft body from outside: a base that moves, gravity, a floor; where it is held and how soft it is.
#include "near.h"
#include "simulation/body.h"
#include "simulation/soft.h"
#include "temporary.h"

/// A box of `width` × `height` × `width` that stands on y = 0, white at its upper four corners and black below.
struct box {
    float position[8][3], color[8][3];
    uint32_t indices[36];
    struct surface surface;
};

static void make_box(struct box *box, float width, float height)
{
    static const uint32_t faces[12][3] = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                                          {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
    *box = (struct box){0};
    for (int i = 0; i < 8; i++) {
        const float p[3] = {(i & 4 ? 0.5f : -0.5f) * width, i & 2 ? height : 0, (i & 1 ? 0.5f : -0.5f) * width};
        memcpy(box->position[i], p, sizeof p);
        for (int c = 0; c < 3; c++) box->color[i][c] = i & 2 ? 1.0f : 0.0f;
    }
    memcpy(box->indices, faces, sizeof faces);
    box->surface = (struct surface){.position = box->position,
                                    .color = box->color,
                                    .vertex_count = 8,
                                    .indices = box->indices,
                                    .index_count = 36};
}

/// A box made soft, and what shakes it.
struct shaken {
    struct box box;
    struct soft_options options;
    struct soft soft;
    struct integrator integrator;
    struct floor floor;
};

/// In about as many tetrahedra; what else is wanted of its options is set before soften().
static void box_open(struct shaken *s, float width, float height, int tets)
{
    *s = (struct shaken){.options = soft_default_options()};
    s->options.tets = tets;
    make_box(&s->box, width, height);
}

static void soften(struct shaken *s)
{
    assert_done(soft_create(&s->soft, &s->box.surface, "box", &s->options, &error));
}

/// Gets an integrator of steps of so many seconds.
static void shake_by(struct shaken *s, double step, double tolerance)
{
    integrator_create(&s->integrator, &s->soft.body, step);
    s->integrator.tolerance = tolerance;
}

static void box_close(struct shaken *s)
{
    if (s->integrator.work) integrator_free(&s->integrator);
    floor_free(&s->floor);
    soft_free(&s->soft);
}

#define BOX_TEST(name, width, height, tets)                                                                          \
    TEST_OF(struct shaken, s, box_open(s, width, height, tets), box_close(s), name)

/// φᵀM d, d being the direction for all nodes, or their displacements.
static double project(const struct soft *soft, int mode, const double direction[3], const double (*x)[3])
{
    const double(*shape)[3] = (const double(*)[3])soft->modes.shape + (size_t)mode * (size_t)soft->body.node_count;
    double sum = 0;
    for (int i = 0; i < soft->body.node_count; i++) {
        double moved[3];
        for (int c = 0; c < 3; c++) moved[c] = x ? x[i][c] - soft->body.rest[i][c] : direction[c];
        sum += soft->body.mass[i] * vec3_dot(shape[i], moved);
    }
    return sum;
}

/// Each mode of a body whose base moves a little is an oscillator that −Γ a(t) pushes: q'' + 2ζω q' + ω² q = −Γ a.
BOX_TEST(a_moving_base_shakes_a_mode_as_it_shakes_an_oscillator, 0.3f, 1, 150)
{
    const double side[3] = {1, 0, 0}, h = 2e-3;
    const struct soft *soft = &s->soft;
    struct integrator *integrator = &s->integrator;
    struct shake shake = {.direction = {1, 0, 0}, .driven = true};
    s->options.shake = &shake;
    s->options.modes = 6;
    s->options.damping = 0.1;
    soften(s);
    assert_near(soft_frequency(soft), 2, 1e-9);
    struct base_drive drive = {
        .kind = DRIVE_BURST, .direction = {1, 0, 0}, .size = 1e-4, .frequency = 1.7, .seconds = 3};
    shake_by(s, h, 1e-10);
    integrator->mass_damping = soft->alpha;
    integrator->stiffness_damping = soft->beta;
    integrator->loads.drive = &drive;
    const double omega = 2 * M_PI * 2, gamma = project(soft, soft->seen, side, NULL);
    double q = 0, v = 0, difference = 0, size = 0;
    for (int step = 0; step < quick_or_all(400, 1000); step++) {
        for (int k = 0; k < 20; k++) { // symplectic Euler in steps of a twentieth
            v += h / 20 *
                 (-gamma * drive_acceleration(&drive, (step + k / 20.0) * h) - 2 * 0.1 * omega * v -
                  omega * omega * q);
            q += h / 20 * v;
        }
        assert_true(integrator_step(integrator));
        double found = project(soft, soft->seen, side, (const double(*)[3])integrator->x);
        difference += (found - q) * (found - q);
        size += q * q;
    }
    print_message("differs from the oscillator by %.2g\n", sqrt(difference / size));
    assert_true(size > 0 && sqrt(difference / size) < 0.01);
    assert_int_equal(integrator->calmed, 0);
}

/// Under its weight a body rests where inner forces and weight balance, sunk and not moving.
BOX_TEST(gravity_is_settled_before_the_start, 0.4f, 1, 300)
{
    struct integrator *integrator = &s->integrator;
    const struct body *body = &s->soft.body;
    s->options.frequency = 3;
    soften(s);
    shake_by(s, 0.01, 1e-7);
    integrator->loads.gravity = 9.81;
    assert_true(integrator_find_equilibrium(integrator));
    double(*held)[3] = calloc((size_t)body->node_count, sizeof *held), lowest = 0;
    memcpy(held, integrator->x, (size_t)body->node_count * sizeof *held);
    for (int step = 0; step < 50; step++) assert_true(integrator_step(integrator));
    for (int i = 0; i < body->node_count; i++) {
        for (int c = 0; c < 3; c++) assert_near(integrator->x[i][c], held[i][c], 1e-5);
        lowest = fmin(lowest, held[i][1] - body->rest[i][1]);
    }
    assert_true(lowest < -1e-3);
    free(held);
}

/// A box that nothing holds, above a floor.
static void loose_open(struct shaken *s, double floor, double stiffness_damping, double mass_damping)
{
    box_open(s, 1, 1, 200);
    s->options.pin.kind = REGION_NONE;
    s->options.young = 1e5;
    soften(s);
    floor_create(&s->floor, &s->soft.lattice, &s->box.surface, floor, s->soft.young, s->options.density);
    shake_by(s, 0.005, 1e-6);
    s->integrator.stiffness_damping = stiffness_damping;
    s->integrator.mass_damping = mass_damping;
    s->integrator.loads.gravity = 9.81;
    s->integrator.loads.floor = &s->floor;
}

/// It falls, bounces and comes to rest on the floor, no corner below it by more than a hundredth of the height.
TEST_OF(struct shaken, s, loose_open(s, -0.3, 0.01, 3), box_close(s), a_box_falls_on_the_floor_and_stays)
{
    const struct integrator *integrator = &s->integrator;
    float place[8][3], lowest = 1;
    for (int step = 0; step < 500; step++) {
        assert_true(integrator_step(&s->integrator));
        lattice_embed(&s->soft.lattice, (const double(*)[3])integrator->x, place);
        for (int i = 0; i < 8; i++) lowest = fminf(lowest, place[i][1]);
    }
    print_message("lowest %.3f m, at the end %.3f m at %.2g m/s\n", (double)lowest, (double)place[0][1],
                  integrator->v[0][1]);
    assert_true(lowest > -0.3f - 0.1f);
    for (int i = 0; i < 8; i++) {
        if (!(i & 2)) assert_near(place[i][1], -0.3, 0.01);
    }
    for (int i = 0; i < s->soft.body.node_count; i++) assert_near(integrator->v[i][1], 0, 0.1);
}

/// What lies on the floor and has hardly any damping of its own stays in touch: its vertices do not go in and out with every step.
TEST(a_box_on_the_floor_does_not_chatter)
{
    enum { STEPS = 1800, LAST = 600, FEW = 60 };
    struct shaken loose, *s = &loose;
    if (!is_thorough()) skip();
    loose_open(s, -0.1, 0.002, 0.5);
    bool below[8] = {false};
    int changes = 0;
    for (int step = 0; step < STEPS; step++) {
        assert_true(integrator_step(&s->integrator));
        for (int i = 0; i < 8; i++) {
            changes += step >= STEPS - LAST && s->floor.touched[i] != below[i];
            below[i] = s->floor.touched[i];
        }
    }
    print_message("%d changes of touch in %d steps; %ld steps calmed\n", changes, LAST, s->integrator.calmed);
    assert_true(changes < FEW);
    assert_true(s->integrator.calmed < 5);
    box_close(s);
}

/// Volume of the body as a multiple of that of a box of 1 × 8 × 1.
static double swelling(const struct lattice *lattice)
{
    double cubes = 0;
    for (int e = 0; e < lattice->tet_count; e++) cubes += lattice->fraction[e] / 12;
    return cubes * pow(lattice->cell, 3) / 8;
}

/// A clamped beam is as thick as its mesh and becomes softer with each doubling, towards Euler and Bernoulli's frequency, whatever the
/// height of the clamp is. It is square, so that it swings as fast to either side.
TEST(a_beam_is_monotone_under_refinement)
{
    const double young = 1e6, length = 7.6;
    const double slender = 1.8751040687 * 1.8751040687 / (2 * M_PI * length * length) * sqrt(young / (12 * 1000));
    double before = INFINITY;
    for (int tets = 400; tets <= quick_or_all(1600, 12800); tets *= 2) {
        struct shaken s;
        box_open(&s, 1, 8, tets);
        s.options.young = young;
        s.options.poisson = 0;
        s.options.modes = 2;
        s.options.pin = (struct region){.kind = REGION_FOOT, .size = 0.4};
        soften(&s);
        double ratio = s.soft.modes.frequency[0] / slender;
        print_message("%d tetrahedra, volume %.3f: %.4f of Euler and Bernoulli's\n", s.soft.lattice.tet_count,
                      swelling(&s.soft.lattice), ratio);
        assert_near(swelling(&s.soft.lattice), 1, 0.02);
        assert_true(ratio < before && ratio > 0.985);
        assert_near(s.soft.modes.frequency[1] / s.soft.modes.frequency[0], 1,
                    0.02); // 1.05 if one side has all diagonals
        before = ratio;
        box_close(&s);
    }
    assert_near(before, 1, is_thorough() ? 0.0155 : 0.075);
}

/// Wherever a box is held, its far end moves by the amplitude times its length that way.
TEST(a_shake_grows_away_from_the_pinned_side)
{
    static const struct held {
        const char *where;
        int axis;
        float far_end;
    } sides[] = {{"0.1", 1, 1}, {"plane:0,0.9,0,0,-1,0", 1, 0}, {"plane:-0.4,0,0,1,0,0", 0, 0.5f}};
    const struct shake shake = {.direction = {0, 0, 1}, .amplitude = 0.2};
    for (const struct held *side = sides; side < sides + sizeof sides / sizeof *sides; side++) {
        struct shaken s;
        double most = 0;
        box_open(&s, 1, 1, 300);
        s.options.shake = &shake;
        assert_true(region_parse(side->where, &s.options.pin));
        soften(&s);
        assert_true(s.soft.share > 0.5);
        shake_by(&s, 0.01, 1e-6);
        soft_shake(&s.soft, &shake, &s.integrator);
        float place[8][3];
        lattice_embed(&s.soft.lattice, (const double(*)[3])s.integrator.x, place);
        for (int i = 0; i < 8; i++) {
            const float *rest = s.box.surface.position[i];
            if (rest[side->axis] == side->far_end) most = fmax(most, (double)(place[i][2] - rest[2]));
        }
        assert_near(most, 0.2, 0.05);
        box_close(&s);
    }
}

static int count_pinned(const char *where)
{
    struct shaken s;
    const struct body *body = &s.soft.body;
    box_open(&s, 0.5f, 1, 300);
    assert_true(region_parse(where, &s.options.pin));
    soften(&s);
    int pinned = s.soft.pinned, wrong = 0;
    for (int i = 0; i < body->node_count; i++) wrong += body->pinned[i] && body->rest[i][1] < 0.5;
    box_close(&s);
    return wrong ? -1 : pinned;
}

/// Where nobody says what is held, the lowest twentieth of the height is, up to a layer of nodes that lies there.
BOX_TEST(the_lowest_twentieth_is_held, 0.5f, 1, 800)
{
    const struct body *body = &s->soft.body;
    double highest = -1, lowest_free = INFINITY;
    soften(s);
    for (int i = 0; i < body->node_count; i++) {
        const double y = body->rest[i][1];
        if (body->pinned[i]) highest = fmax(highest, y);
        if (!body->pinned[i]) lowest_free = fmin(lowest_free, y);
    }
    assert_near(highest, 0.05, 1e-6);
    assert_true(lowest_free > highest + 0.01);
}

TEST(regions_hold_what_they_name)
{
    struct region region;
    assert_true(count_pinned("plane:0,0.7,0,0,-1,0") > 4); // all above 0.7
    assert_true(count_pinned("sphere:0,1,0,0.3") > 0);
    assert_true(count_pinned("color:FFFFFF") > 0); // the upper corners
    assert_int_equal(count_pinned("none"), 0);
    static const char *const wrong[] = {
        "",          "foot",           "-1",          "0.1,2",        "plane:0,0,0,0,0,0",
        "plane:1,2", "sphere:0,0,0,0", "color:12345", "color:GGGGGG", "0.1m"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) assert_false(region_parse(wrong[i], &region));
}

/// By distance and by brightness alike the box is N times softer at its top than at its foot, and evenly in between.
TEST(softness_falls_as_the_map_says)
{
    static const char *const maps[] = {"distance", "color"};
    for (int m = 0; m < 2; m++) {
        struct shaken s;
        const struct body *body = &s.soft.body;
        box_open(&s, 0.3f, 1, 500);
        s.options.softness = (struct softness){.from = maps[m], .times = 8};
        soften(&s);
        double least = 1, most = 0;
        for (int e = 0; e < body->element_count; e++) {
            least = fmin(least, body->elements[e].stiffness);
            most = fmax(most, body->elements[e].stiffness);
        }
        print_message("%s: %.3f … %.3f\n", maps[m], least, most);
        assert_true(least * 8 < 1.5 && least * 8 > 0.999 && most > 0.6 && most < 1.001);
        box_close(&s);
    }
}

/// A track's spline goes through its samples, and its second derivative is the acceleration.
TEST(a_track_is_smooth)
{
    double time[5] = {0, 0.1, 0.3, 0.4, 0.7}, value[5] = {0, 0.02, -0.01, 0.03, 0};
    char path[] = "/tmp/wiggly-track-XXXXXX";
    FILE *file = fdopen(mkstemp(path), "w");
    fputs("seconds,metres\n", file);
    for (int i = 0; i < 5; i++) fprintf(file, "%g, %g\n", time[i], value[i]);
    fclose(file);
    struct base_drive drive = {.size = 1};
    assert_done(drive_read_track(&drive, path, &error));
    unlink(path);
    for (int i = 0; i < 5; i++) assert_near(drive_place(&drive, time[i]), value[i], 1e-12);
    for (double t = 0.05; t < 0.65; t += 0.0417) {
        const double h = 1e-4;
        double second =
            (drive_place(&drive, t + h) - 2 * drive_place(&drive, t) + drive_place(&drive, t - h)) / (h * h);
        assert_near(drive_acceleration(&drive, t), second, 0.01);
    }
    drive_free(&drive);
}

/// Numbers that a spline through them would leave the finite ones with are refused with their line.
TEST(a_track_stays_finite)
{
    static const struct {
        const char *text, *says; // no sentence: it is taken
    } cases[] = {
        {"-1e9,-1e9\n-999999999.5,1e9\n1e9,-1e9\n", NULL},
        {"0,0\n1e-9,1e9\n2.5e-9,0\n", NULL},
        {"0,0\n1,1.1e9\n", "track.csv:2: expected two numbers up to 1e9, \"seconds,displacement\", got '1,1.1e9'"},
        {"-1.1e9,0\n1,1\n", "track.csv:1: expected two numbers up to 1e9"},
        {"0,1e308\n1,-1e308\n", "track.csv:1: expected two numbers up to 1e9"},
        {"0,0\n\n0.9e-9,1\n", "track.csv:3: expected a time a nanosecond or more after 0, got 9e-10"},
        {"0,0\n1e-320,1\n", "track.csv:2: expected a time a nanosecond or more after 0"},
        {"1,0\n0,1\n", "track.csv:2: expected a time a nanosecond or more after 1, got 0"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct base_drive drive = {.size = 1};
        struct error error = {0};
        const char *path = temporary_file("track.csv", cases[i].text, strlen(cases[i].text));
        const bool good = drive_read_track(&drive, path, &error);
        if (good != !cases[i].says || (!good && !strstr(error.text, cases[i].says)))
            fail_msg("case %zu: %s", i, good ? "taken" : error.text);
        for (int k = 0; good && k < drive.count; k++) {
            assert_true(isfinite(drive_place(&drive, drive.time[k])));
            assert_true(isfinite(drive_acceleration(&drive, drive.time[k])));
        }
        drive_free(&drive);
    }
}
