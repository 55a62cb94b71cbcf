/// The list of a description's members: all are on it, and a solver that has kept the factor of one description solves the next one,
/// which differs in a single member, as a fresh solver does.
#include "near.h"

#include "curve.h"
#include "spline/desc.h"

enum { SAMPLES = 481, KNOTS = 3 };

static const wiggly_knot knots[KNOTS] = {{.sample = 8, .value = 1},
                                         {.sample = 160, .value = -0.5, .has_slope = true, .stiffness = 20},
                                         {.sample = 400, .value = 2}};
static double wave[SAMPLES];

static int set_up(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++) wave[i] = 0.4 + 0.1 * sin(0.05 * i);
    return 0;
}

static wiggly_desc describe(wiggly_mode mode, wiggly_start start)
{
    return (wiggly_desc){.size = sizeof(wiggly_desc),
                         .samples = SAMPLES - 1,
                         .step = 1.0 / 24,
                         .mode = mode,
                         .start = start,
                         .frequency.value = 1.1,
                         .damping.value = 0.08,
                         .bandwidth.value = 0.2,
                         .equilibrium.value = 0.25,
                         .calm = 0.5,
                         .low = -20,
                         .has_calm = true,
                         .has_low = true,
                         .has_high = true,
                         .high = 20,
                         .knots = knots,
                         .knot_count = KNOTS};
}

/// The same description with another value of one member.
static wiggly_desc with_other(const wiggly_desc *desc, const desc_member *member, bool track)
{
    wiggly_desc other = *desc;
    void *at = (char *)&other + member->offset;
    wiggly_param param = {track ? 0 : 0.3, track ? wave : NULL};
    if (member->kind == DESC_PARAM) memcpy(at, &param, sizeof param);
    if (member->kind == DESC_NUMBER) *(double *)at = 0.2 + 0.5 * *(double *)at; // another number, whatever it was
    if (member->kind == DESC_COUNT) *(int *)at += 1;
    if (member->kind == DESC_CHOICE) *(unsigned char *)at ^= 1; // the low byte
    return other;
}

static void compare(wiggly_solver *used, const wiggly_desc *before, const wiggly_desc *after, const char *name)
{
    wiggly_solver *fresh;
    wiggly_curve one = curve_create(SAMPLES), other = curve_create(SAMPLES);
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &fresh), WIGGLY_OK);
    wiggly_solve(used, before, &one);
    memset(one.total, 0, 5 * SAMPLES * sizeof *one.total);
    wiggly_status status = wiggly_solve(used, after, &one), expected = wiggly_solve(fresh, after, &other);
    bool same = status == expected && memcmp(one.total, other.total, 5 * SAMPLES * sizeof *one.total) == 0;
    if (status >= WIGGLY_ERROR_ARGUMENT) same = status == expected;
    if (!same) fail_msg("mode %d, start %d: another %s is not noticed", before->mode, before->start, name);
    curve_destroy(&one);
    curve_destroy(&other);
    wiggly_destroy(fresh);
}

TEST_WITH(set_up, NULL, a_solver_notices_another_value_of_any_member)
{
    wiggly_solver *solver;
    assert_int_equal(wiggly_create(SAMPLES, KNOTS, &solver), WIGGLY_OK);
    for (int c = 0; c < 9; c++) {
        wiggly_desc desc = describe((wiggly_mode)(c / 3), (wiggly_start)(c % 3));
        for (const desc_member *m = desc_members; m->name; m++) {
            for (int track = 0; track < 2; track++) {
                wiggly_desc other = with_other(&desc, m, track);
                compare(solver, &desc, &other, m->name);
                compare(solver, &other, &desc, m->name);
            }
        }
    }
    wiggly_destroy(solver);
}

TEST(the_filter_is_kept_where_every_member_that_it_is_of_is_the_same)
{
    wiggly_desc desc = describe(WIGGLY_REAL, WIGGLY_REST), copy = desc_settings(&desc);
    assert_true(desc_same_filter(&desc, &copy));
    assert_null(copy.knots);
    for (const desc_member *m = desc_members; m->name; m++) {
        wiggly_desc other = with_other(&desc, m, false);
        assert_int_equal(desc_same_filter(&desc, &other), !m->filters);
    }
}
