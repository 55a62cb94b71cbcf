/// Motion with a direction: what an edit leaves alone, to the bit; and knots where the motion settles.
#include "near.h"
#include "uniform.h"
#include <string.h>
#include <wiggly/more.h>

enum { SAMPLES = 241, KNOTS = 6, ROUNDS = 200 };

struct layout {
    wiggly_desc desc;
    wiggly_knot knots[KNOTS];
    double track[SAMPLES];
};

struct solved {
    double total[SAMPLES], re[SAMPLES], im[SAMPLES];
    wiggly_status status;
};

/// Random knots; some are poses, some still, some settle, some have slopes.
static void make(struct layout *l, uint64_t seed)
{
    for (int i = 0; i < 8; i++) uniform(&seed);
    l->desc = wiggly_default_desc();
    l->desc.samples = SAMPLES;
    l->desc.frequency.value = 0.3 + 3 * uniform(&seed);
    l->desc.damping.value = 0.3 * uniform(&seed);
    l->desc.wind_up = 0.2 + uniform(&seed);
    if (uniform(&seed) < 0.3) {
        for (int i = 0; i < SAMPLES; i++) l->track[i] = 1 + 0.5 * sin(i * 0.05);
        l->desc.frequency.track = l->track;
    }
    for (int k = 0; k < KNOTS; k++) {
        const double what = uniform(&seed);
        l->knots[k] = (wiggly_knot){.sample = 8 + 38 * k + (int)(20 * uniform(&seed)),
                                    .value = 2 * uniform(&seed) - 1,
                                    .phase = uniform(&seed) - 0.5,
                                    .slope = 4 * uniform(&seed) - 2,
                                    .has_phase = what<0.25, .has_slope = what> 0.8};
        if (what > 0.4 && what < 0.5) l->knots[k] = (wiggly_knot){.sample = l->knots[k].sample, .still = true};
        l->knots[k].settles = what > 0.7;
    }
    l->desc.knots = l->knots;
    l->desc.knot_count = KNOTS;
}

static void solve(wiggly_solver *solver, const struct layout *l, struct solved *s)
{
    wiggly_curve curve = {.size = sizeof curve, .total = s->total, .re = s->re, .im = s->im};
    s->status = wiggly_solve(solver, &l->desc, &curve);
    assert_int_equal(s->status, WIGGLY_OK);
}

/// The first and the last sample in which two curves differ by a bit; first > last: none.
static void find_changes(const struct solved *a, const struct solved *b, int *first, int *last)
{
    *first = SAMPLES, *last = -1;
    for (int i = 0; i < SAMPLES; i++) {
        if (a->total[i] == b->total[i] && a->im[i] == b->im[i]) continue;
        if (i < *first) *first = i;
        *last = i;
    }
}

static wiggly_solver *solver_of(int samples, int knots)
{
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(samples, knots, &solver), WIGGLY_OK);
    return solver;
}

/// An edit of a knot changes nothing up to the knot before it, and behind the next pose or still knot nothing; what the solver keeps
/// makes no difference.
TEST(an_edit_changes_nothing_before_its_gap)
{
    static struct layout l, edited;
    static struct solved before, after, fresh;
    wiggly_solver *kept = solver_of(SAMPLES, KNOTS);
    int cuts = 0;
    for (int round = 0; round < ROUNDS; round++) {
        make(&l, (uint64_t)round);
        const int k = 1 + round % (KNOTS - 1);
        int first, last;
        for (int n = 0; n < KNOTS; n++) l.knots[n].settles = false; // it moves the mass, for all that follows
        l.knots[0].has_slope = false;                               // how much it says depends on the knot after it
        edited = l;
        edited.desc.knots = edited.knots;
        edited.desc.frequency.track = l.desc.frequency.track;
        if (edited.knots[k].still) edited.knots[k] = (wiggly_knot){.sample = edited.knots[k].sample};
        edited.knots[k].value += 0.5;
        if (round % 2) edited.knots[k].sample += 1;
        solve(kept, &l, &before);
        solve(kept, &edited, &after);
        wiggly_solver *other = solver_of(SAMPLES, KNOTS);
        solve(other, &edited, &fresh);
        wiggly_destroy(other);
        assert_memory_equal(&after, &fresh, sizeof after);
        find_changes(&before, &after, &first, &last);
        assert_true(first > l.knots[k - 1].sample && last >= l.knots[k].sample);
        for (int n = k + 1; n < KNOTS; n++) {
            if (!l.knots[n].has_phase && !l.knots[n].still) continue;
            assert_true(last < l.knots[n].sample);
            cuts++;
            break;
        }
    }
    assert_true(cuts > ROUNDS / 4);
    wiggly_destroy(kept);
}

/// It settles where the last settling knot is, after it has overshot.
TEST(the_motion_stays_where_it_settles)
{
    static struct layout l;
    static struct solved s;
    wiggly_solver *solver = solver_of(SAMPLES, KNOTS);
    l.desc = wiggly_default_desc();
    l.desc.samples = SAMPLES;
    l.desc.frequency.value = 1.5, l.desc.damping.value = 0.15, l.desc.wind_up = 0.5;
    l.knots[0] = (wiggly_knot){.sample = 0, .value = 0};
    l.knots[1] = (wiggly_knot){.sample = 36, .value = 60, .settles = true};
    l.desc.knots = l.knots, l.desc.knot_count = 2;
    solve(solver, &l, &s);
    double most = 0;
    for (int i = 0; i < SAMPLES; i++) most = fmax(most, s.total[i]);
    assert_true(most > 66 && most < 120);
    assert_near(s.total[SAMPLES - 1], 60, 0.5);
    assert_near(s.total[20], 0, 1e-9); // the wind-up has not begun
    wiggly_destroy(solver);
}

/// Long gaps keep their digits: undamped, and where the frequency is 0, next to a solve with half the samples.
TEST(long_gaps_keep_their_digits)
{
    enum { LONG = 20001 };
    static double total[2][LONG];
    wiggly_solver *solver = solver_of(LONG, 3);
    for (int kind = 0; kind < 2; kind++) {
        for (int fine = 0; fine < 2; fine++) {
            const int by = 1 + fine;
            const wiggly_knot knots[] = {{.sample = 0, .value = 0.4},
                                         {.sample = 2000 * by, .value = 1, .has_phase = true},
                                         {.sample = 9000 * by, .value = -0.5, .has_phase = true}};
            wiggly_desc desc = wiggly_default_desc();
            desc.samples = 10000 * by + 1, desc.step = 1e-3 / by;
            desc.frequency.value = kind, desc.wind_up = 100;
            desc.knots = knots, desc.knot_count = 3;
            wiggly_curve curve = {.size = sizeof curve, .total = total[fine]};
            assert_int_equal(wiggly_solve(solver, &desc, &curve), WIGGLY_OK);
            assert_true(curve.error < 1e-10);
        }
        for (int i = 0; i <= 10000; i += 100) assert_near(total[0][i], total[1][2 * i], 1e-5);
    }
    wiggly_destroy(solver);
}
