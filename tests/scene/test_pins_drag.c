/// Drags of pins out of reach: the motion is a continuous function of where a pin is to be.
#include "stand.h"

/// A pinned point of a scene, and the drag's circle or line.
struct drag {
    const char *scene;
    int rig, point;
    double frame;
    double middle[3], u[3], v[3]; ///< of the rig's size, from where the point is without the pin
    bool is_line;                 ///< from `middle` along `u`; else round it
};

enum { STEPS = 90, HALVINGS = 14, MOST_NUMBERS = 8192 };

struct pulled {
    struct stand stand;
    double from[3], size; ///< the point without its pin
    double seen[2][MOST_NUMBERS];
};

static struct pin *pin_of(struct pulled *pulled, const struct drag *drag)
{
    return &document_own_rig(pulled->stand.opened.document, drag->rig)->pins[0];
}

static void open_drag(struct pulled *pulled, const struct drag *drag)
{
    memset(&pulled->stand, 0, sizeof pulled->stand);
    stand_open(&pulled->stand, drag->scene);
    opened_solve(&pulled->stand.opened, SOLVER_BY_LENGTH);
    const struct pin_point at = stand_find(&pulled->stand, drag->rig, drag->point, drag->frame, NULL);
    struct pin pin = {.frame = drag->frame, .point = drag->point, .to = {at.at[0], at.at[1], at.at[2]}};
    memcpy(pulled->from, at.at, sizeof pulled->from);
    pulled->size = at.size;
    stand_end(&pulled->stand, edit_pin_add(stand_begin(&pulled->stand), drag->rig, &pin, NULL));
}

/// What is left of the pin, of the size.
static double solve(struct pulled *pulled, const struct drag *drag)
{
    stand_solve(&pulled->stand);
    return length_of(stand_left(&pulled->stand, drag->rig, 0)->way) / pulled->size;
}

/// All curves with the pin at t of the drag.
static void solve_at(struct pulled *pulled, const struct drag *drag, double t, double *seen)
{
    const struct evaluation *evaluation = &pulled->stand.opened.evaluation;
    const double turn = 2 * 3.14159265358979323846 * t;
    const double on[2] = {drag->is_line ? t : cos(turn), drag->is_line ? 0 : sin(turn)};
    for (int k = 0; k < 3; k++) {
        const double way = drag->middle[k] + on[0] * drag->u[k] + on[1] * drag->v[k];
        pin_of(pulled, drag)->to[k] = pulled->from[k] + pulled->size * way;
    }
    solve(pulled, drag);
    for (int s = 0, n = 0; s < evaluation->count; s++) {
        for (int i = 0; i < evaluation->samples && n < MOST_NUMBERS; i++) seen[n++] = evaluation->curves[s].total[i];
    }
}

static double difference(const double *a, const double *b)
{
    double most = 0;
    for (int i = 0; i < MOST_NUMBERS; i++) most = fmax(most, fabs(a[i] - b[i]));
    return most;
}

/// The largest change of any spline between two neighbouring places of the drag, halved towards where it changes most.
static double largest_jump(struct pulled *pulled, const struct drag *drag, double *step_change)
{
    double most = 0, at = 0;
    solve_at(pulled, drag, 0, pulled->seen[0]);
    for (int i = 1; i <= STEPS; i++) {
        solve_at(pulled, drag, (double)i / STEPS, pulled->seen[i % 2]);
        const double change = difference(pulled->seen[0], pulled->seen[1]);
        if (change > most) most = change, at = (double)(i - 1) / STEPS;
    }
    *step_change = most;
    double width = 1.0 / STEPS;
    static double middle[MOST_NUMBERS];
    solve_at(pulled, drag, at, pulled->seen[0]);
    solve_at(pulled, drag, at + width, pulled->seen[1]);
    for (int i = 0; i < HALVINGS; i++) {
        width /= 2;
        solve_at(pulled, drag, at + width, middle);
        const double before = difference(pulled->seen[0], middle), after = difference(middle, pulled->seen[1]);
        if (after > before) at += width;
        memcpy(pulled->seen[after > before ? 0 : 1], middle, sizeof middle);
        most = fmax(before, after);
    }
    return most;
}

static const struct drag drags[] = {
    {"assets/scenes/tail.json", 0, 23, 30, {0}, {0, 0, -3}, {0}, true},
    {"assets/scenes/tail.json", 0, 23, 30, {0}, {3, 0, 0}, {0}, true},
    {"assets/scenes/tail.json", 0, 23, 30, {0}, {-2, 2, 1}, {0}, true},
    {"assets/scenes/tail.json", 0, 23, 72, {0}, {0, 3, 0}, {0}, true},
    {"assets/scenes/tail.json", 0, 23, 30, {0}, {0.8, 0, 0}, {0, 0.8, 0}, false},
    {"assets/scenes/tail.json", 0, 23, 30, {0}, {0.8, 0, 0}, {0, 0, 0.8}, false},
    {"assets/scenes/tail.json", 0, 23, 72, {0}, {2, 0, 0}, {0, 2, 0}, false},
    {"assets/scenes/tail.json", 0, 12, 50, {0}, {1, 0, 0}, {0, 0, 1}, false},
    {"assets/scenes/follow.json", 0, 11, 40, {0}, {1, 0, 0}, {0, 1, 0}, false},
    {"assets/scenes/follow.json", 0, 23, 30, {0}, {0, 0, 2}, {0, 2, 0}, false},
    {"assets/scenes/dog.json", 1, 7, 30, {0}, {0, 0, 2}, {0, 2, 0}, false},
    {"assets/scenes/dog.json", 1, 7, 30, {0}, {1, 0, 0}, {0, 1, 0}, false},
    {"assets/scenes/dog.json", 2, 1, 30, {0}, {1, 1, 1}, {0}, true},
};

TEST(far_drags_do_not_jump)
{
    static struct pulled pulled;
    for (size_t i = 0; i < sizeof drags / sizeof *drags; i += (size_t)quick_or_all(3, 1)) {
        const struct drag *drag = &drags[i];
        double change;
        open_drag(&pulled, drag);
        const double jump = largest_jump(&pulled, drag, &change);
        if (!(change < 4 && jump < 0.01))
            fail_msg("%s, rig %d, point %d, frame %g: changes by %g in a step of the drag, by %g in 1/%d of it",
                     drag->scene, drag->rig, drag->point, drag->frame, change, jump, 1 << HALVINGS);
        stand_close(&pulled.stand);
    }
}

/// A place where the point is after some change of what the splines are at its sample, up to `most` each.
static void move_within_reach(struct pulled *pulled, const struct drag *drag, double most)
{
    const struct document *document = pulled->stand.opened.document;
    struct evaluation *evaluation = &pulled->stand.opened.evaluation;
    const int sample = document_sample(document, drag->frame);
    memcpy(pin_of(pulled, drag)->to, pulled->from, sizeof pulled->from);
    solve(pulled, drag);
    for (int s = 0; s < document->spline_count; s++) {
        bool is_knot = false;
        for (int k = 0; k < document->splines[s]->knot_count; k++)
            is_knot |= document_sample(document, document->splines[s]->knots[k].frame) == sample;
        if (is_knot) continue;
        evaluation->curves[s].re[sample] += most * (2.0 * rand() / RAND_MAX - 1);
        evaluation->curves[s].im[sample] += most * (2.0 * rand() / RAND_MAX - 1);
    }
    const struct pin_point at = stand_find(&pulled->stand, drag->rig, drag->point, drag->frame, NULL);
    memcpy(pin_of(pulled, drag)->to, at.at, sizeof at.at);
}

/// Most directions in which a tail gives way by design are in these places too: so it is how many that counts.
TEST(what_can_be_reached_is_reached)
{
    static struct pulled pulled;
    int met = 0, near = 0, count = 0;
    srand(1);
    for (size_t i = 0; i < sizeof drags / sizeof *drags; i++) {
        open_drag(&pulled, &drags[i]);
        for (int n = 0; n < quick_or_all(10, 50); n++) {
            move_within_reach(&pulled, &drags[i], 0.4);
            const double left = solve(&pulled, &drags[i]);
            met += left <= 1e-6, near += left < 0.01, count++;
        }
        stand_close(&pulled.stand);
    }
    if (met < 0.4 * count || near < 0.75 * count)
        fail_msg("of %d places %d are met, and %d nearly: expected 40 and 75 percent", count, met, near);
}
