/// Generalised-α steps, one Newton solve each.
#include "simulation/integrator.h"
#include "base/need.h"
#include "simulation/linear.h"
#include <stdlib.h>
#include <string.h>

enum { NEWTON_MAX = 60, GRADIENTS_MAX = 2000 };

// A looser tolerance costs more Newton iterations, each with an assembly; a tighter one saves none.
static const double linear_tolerance = 1e-3;

// Without a drive the energy cannot rise. This share is allowed for rounding and the scheme's ripple.
static const double growth_allowed = 0.01;

struct integrator_work {
    double (*a)[3];         ///< accelerations; one allocation for all vectors starts here
    double (*y)[3];         ///< the unknown: positions at the step's end
    double (*target)[3];    ///< t
    double (*origin)[3];    ///< q
    double (*start)[3];     ///< f at the step's start
    double (*force)[3];     ///< f(y)
    double (*downhill)[3];  ///< minus the gradient of the potential
    double (*direction)[3]; ///< the Newton step
    double (*moved)[3];     ///< y − q
    double (*drag)[3];      ///< K (y − q)
    struct blocks lagged;   ///< K at the step's start: the pattern is the body's, the blocks are its own
    bool started;           ///< accelerations are known
    double least;           ///< lowest energy so far, loads included; with a drive: energy at the step's start; J
    double scale;           ///< strain and kinetic energy at the step's start; with a drive: the highest so far; J
    double potential;       ///< of the loads at the step's start, J
};

/// How much higher the floor is, in the base's frame.
static double floor_rise(const struct loads *loads, double time)
{
    return loads->drive ? -drive_place(loads->drive, time) * loads->drive->direction[1] : 0;
}

/// Adds the forces at a time and the positions x to `force`. Returns their potential, J.
static double loads_forces(const struct loads *loads, const struct body *body, double time, const double (*x)[3],
                           double (*force)[3])
{
    double pull[3] = {0, -loads->gravity, 0}, energy = 0;
    if (loads->drive) {
        double acceleration = drive_acceleration(loads->drive, time);
        for (int c = 0; c < 3; c++) pull[c] -= acceleration * loads->drive->direction[c];
    }
    for (int i = 0; i < body->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            force[i][c] += body->mass[i] * pull[c];
            energy -= body->mass[i] * pull[c] * (x[i][c] - body->rest[i][c]);
        }
    }
    if (loads->floor) energy += floor_push(loads->floor, floor_rise(loads, time), x, force);
    return energy;
}

/// Prepares the floor for a step that ends at `time`. Nodes at y then move at `rate` (y − q).
static void loads_aim(const struct loads *loads, double time, double step, double rate, const double (*q)[3])
{
    if (!loads->floor) return;
    const double risen = floor_rise(loads, time);
    floor_aim(loads->floor, rate, q, risen, (risen - floor_rise(loads, time - step)) / step);
}

/// A step in the form of Newmark's: x + h v + h² (k a + β a'), v + h ((1 − γ) a + γ a'), with a' from the balance of forces at
/// fractions of the step.
struct scheme {
    double am, af, k, beta, gamma;
    double inertia, rate; ///< κ and r
};

static struct scheme complete(struct scheme s, double h)
{
    s.inertia = (1 - s.am) / ((1 - s.af) * s.beta * h * h);
    s.rate = s.gamma / (s.beta * h);
    return s;
}

/// Chung and Hulbert's parameters for ρ∞ = 0.8.
static struct scheme generalised_alpha(double h)
{
    const double rho = 0.8;
    struct scheme s = {.am = (2 * rho - 1) / (rho + 1), .af = rho / (rho + 1)};
    s.gamma = 0.5 - s.am + s.af;
    s.beta = 0.25 * (1 - s.am + s.af) * (1 - s.am + s.af);
    s.k = 0.5 - s.beta;
    return complete(s, h);
}

static struct scheme backward_euler(double h) { return complete((struct scheme){.beta = 1, .gamma = 1}, h); }

void integrator_create(struct integrator *integrator, struct body *body, double step)
{
    enum { VECTORS = 10 };
    size_t n = (size_t)body->node_count;
    *integrator = (struct integrator){.body = body, .step = step, .tolerance = 1e-9};
    integrator->x = need_zeroed(n, sizeof *integrator->x);
    integrator->v = need_zeroed(n, sizeof *integrator->v);
    struct integrator_work *w = integrator->work = need_zeroed(1, sizeof *w);
    double(*pool)[3] = need_zeroed(VECTORS * n, sizeof *pool);
    w->lagged = body->stiffness;
    w->lagged.block = need_zeroed((size_t)body->stiffness.start[n] + 1, sizeof *w->lagged.block);
    w->a = pool;
    w->y = pool + n;
    w->target = pool + 2 * n;
    w->origin = pool + 3 * n;
    w->start = pool + 4 * n;
    w->force = pool + 5 * n;
    w->downhill = pool + 6 * n;
    w->direction = pool + 7 * n;
    w->moved = pool + 8 * n;
    w->drag = pool + 9 * n;
    memcpy(integrator->x, body->rest, n * sizeof *integrator->x);
}

void integrator_free(struct integrator *integrator)
{
    struct integrator_work *w = integrator->work;
    free(w->a);
    free(w->lagged.block);
    free(w);
    free(integrator->x);
    free(integrator->v);
    *integrator = (struct integrator){0};
}

/// Forces of strain and loads at the positions x, 0 at pinned nodes. Returns the strain energy; the loads' goes to `potential`.
static double add_up(struct integrator *m, double time, const double (*x)[3], double (*force)[3], double *potential)
{
    double energy = body_forces(m->body, x, force);
    *potential = loads_forces(&m->loads, m->body, time, x, force);
    for (int i = 0; i < m->body->node_count; i++) {
        if (m->body->pinned[i]) memset(force[i], 0, sizeof force[i]);
    }
    return energy;
}

/// Returns the potential at y, and its negative gradient in work->downhill:
/// κ/2 |y − t|²_M + r/2 (y − q)ᵀ C (y − q) + Ψ(y)
static double evaluate(struct integrator *m, const struct scheme *scheme, const double (*y)[3])
{
    struct integrator_work *w = m->work;
    double potential, energy = add_up(m, m->time + m->step, y, w->force, &potential);
    energy += potential + (m->loads.floor ? m->loads.floor->drag : 0);
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3; c++) w->moved[i][c] = y[i][c] - w->origin[i][c];
    }
    if (m->stiffness_damping > 0) blocks_multiply(&w->lagged, (const double(*)[3])w->moved, w->drag);
    for (int i = 0; i < m->body->node_count; i++) {
        double mass = m->body->mass[i];
        for (int c = 0; c < 3; c++) {
            w->downhill[i][c] = 0;
            if (m->body->pinned[i]) continue;
            double ahead = y[i][c] - w->target[i][c], push = scheme->inertia * mass * ahead;
            double drag = m->mass_damping * mass * w->moved[i][c];
            if (m->stiffness_damping > 0) drag += m->stiffness_damping * w->drag[i][c];
            drag *= scheme->rate;
            energy += 0.5 * (push * ahead + drag * w->moved[i][c]);
            w->downhill[i][c] = w->force[i][c] - push - drag;
        }
    }
    return energy;
}

/// The body's matrix becomes κ M + r C + K(y), with y from the last evaluate().
static void assemble(struct integrator *m, const struct scheme *scheme)
{
    struct blocks *a = &m->body->stiffness;
    const double factor = scheme->rate * m->stiffness_damping;
    body_stiffness(m->body);
    if (m->loads.floor) floor_stiffness(m->loads.floor, m->body);
    int count = a->start[a->rows];
    for (int k = 0; factor > 0 && k < count; k++) {
        for (int i = 0; i < 9; i++) a->block[k][i] += factor * m->work->lagged.block[k][i];
    }
    for (int i = 0; i < a->rows; i++) {
        double inertia = m->body->mass[i] * (scheme->inertia + scheme->rate * m->mass_damping);
        for (int d = 0; d < 9; d += 4) a->block[a->diagonal[i]][d] += inertia;
    }
}

/// dᵀ∇ of the potential for the Newton step d: negative if it leads down.
static double slope_along(const struct integrator *m)
{
    double slope = 0;
    for (int i = 0; i < m->body->node_count; i++) slope -= vec3_dot(m->work->direction[i], m->work->downhill[i]);
    return slope;
}

/// Line search along the Newton step, until the potential has fallen enough: by Armijo's condition or, where rounding hides the
/// fall, by the slope (Hager and Zhang 2005, approximate Wolfe condition). Returns the largest move of a node, 0 if no step leads
/// down. A step below the tolerance is taken unchecked.
static double search(struct integrator *m, const struct scheme *scheme, double *energy)
{
    enum { HALVINGS_MAX = 30 };
    const double enough = 1e-4, rounding = 1e-6;
    struct integrator_work *w = m->work;
    double *y = vec3_flat(w->y), *direction = vec3_flat(w->direction);
    double largest = 0, before = *energy, slope = slope_along(m), part = 1, taken = 0;
    for (int i = 0; i < m->body->node_count; i++) largest = fmax(largest, vec3_length(w->direction[i]));
    for (int halving = 0; halving < HALVINGS_MAX; halving++, part /= 2) {
        for (int i = 0; i < 3 * m->body->node_count; i++) y[i] += (part - taken) * direction[i];
        if (largest <= m->tolerance) return largest;
        taken = part;
        *energy = evaluate(m, scheme, (const double(*)[3])w->y);
        if (*energy <= before + enough * part * slope) return part * largest;
        if (*energy <= before + rounding * fabs(before) && fabs(slope_along(m)) <= 0.8 * fabs(slope)) {
            return part * largest;
        }
    }
    return 0;
}

/// Minimises the potential from y. It has creases where two principal stretches of an inverted element are opposite, and Newton's
/// method may not converge on one. Then the lowest point found is good enough, since every iteration went down.
static void minimise(struct integrator *m, const struct scheme *scheme)
{
    struct integrator_work *w = m->work;
    const size_t bytes = (size_t)m->body->node_count * sizeof *w->direction;
    double energy = evaluate(m, scheme, (const double(*)[3])w->y);
    for (int iteration = 0; iteration < NEWTON_MAX && isfinite(energy); iteration++) {
        assemble(m, scheme);
        memset(w->direction, 0, bytes);
        m->gradients += conjugate_solve(&m->body->scratch, &m->body->stiffness, (const double(*)[3])w->downhill,
                                        w->direction, linear_tolerance, GRADIENTS_MAX);
        m->newton++;
        if (!(search(m, scheme, &energy) > m->tolerance)) return;
    }
}

/// Forces, energy and the stiffness for damping; at the first step also the accelerations M⁻¹(f − C v).
static void begin(struct integrator *m)
{
    struct integrator_work *w = m->work;
    double energy = add_up(m, m->time, (const double(*)[3])m->x, w->start, &w->potential) +
                    body_kinetic(m->body, (const double(*)[3])m->v);
    if (m->loads.floor) floor_start(m->loads.floor);
    w->scale = m->loads.drive ? fmax(w->scale, energy) : energy;
    energy += w->potential;
    w->least = w->started && !m->loads.drive ? fmin(w->least, energy) : energy;
    if (m->stiffness_damping > 0) {
        body_stiffness(m->body);
        memcpy(w->lagged.block, m->body->stiffness.block,
               (size_t)w->lagged.start[w->lagged.rows] * sizeof *w->lagged.block);
        blocks_multiply(&w->lagged, (const double(*)[3])m->v, w->drag);
    }
    for (int i = 0; !w->started && i < m->body->node_count; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            double drag = m->stiffness_damping > 0 ? m->stiffness_damping * w->drag[i][c] : 0;
            w->a[i][c] = (w->start[i][c] - drag) / m->body->mass[i] - m->mass_damping * m->v[i][c];
        }
    }
    w->started = true;
}

/// t, q and a first guess at y.
static void aim(struct integrator *m, const struct scheme *s)
{
    struct integrator_work *w = m->work;
    const double h = m->step, kept = 1 / (1 - s->af);
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            double x = m->x[i][c], v = m->v[i][c], a = w->a[i][c];
            w->y[i][c] = w->target[i][c] = w->origin[i][c] = w->moved[i][c] = x;
            if (m->body->pinned[i]) continue;
            double rest = kept * (s->af * w->start[i][c] / m->body->mass[i] - s->am * a) / s->inertia;
            w->target[i][c] += h * v + h * h * s->k * a + rest;
            w->origin[i][c] -=
                ((kept - s->gamma / s->beta) * v + h * (1 - s->gamma - s->gamma * s->k / s->beta) * a) / s->rate;
            w->y[i][c] += h * v;
            w->moved[i][c] = w->origin[i][c] + (kept - 1) * v / s->rate; // exactly the velocity at the step's end
        }
    }
    loads_aim(&m->loads, m->time + h, h, s->rate, (const double(*)[3])w->moved);
}

/// Newmark's acceleration and velocity at the step's end.
static void after(const struct integrator *m, const struct scheme *s, int i, int c, double *a, double *v)
{
    const double h = m->step, before = m->work->a[i][c];
    double ahead = m->work->y[i][c] - m->x[i][c] - h * m->v[i][c];
    *a = (ahead / (h * h) - s->k * before) / s->beta;
    *v = m->v[i][c] + h * ((1 - s->gamma) * before + s->gamma * *a);
}

/// How far the energy at the step's end exceeds its bound, J. A drive does the work ∂Φ/∂t on the body, here by the trapezoidal
/// rule: the mean change of Φ at the start's positions and at the end's.
static double surplus(struct integrator *m, const struct scheme *s)
{
    struct integrator_work *w = m->work;
    double end, a, v, work = 0;
    double energy = add_up(m, m->time + m->step, (const double(*)[3])w->y, w->force, &end);
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            after(m, s, i, c, &a, &v);
            energy += 0.5 * m->body->mass[i] * v * v;
        }
    }
    if (m->loads.drive) {
        work = loads_forces(&m->loads, m->body, m->time + m->step, (const double(*)[3])m->x, w->force) - w->potential;
        work += end - loads_forces(&m->loads, m->body, m->time, (const double(*)[3])w->y, w->force);
        work /= 2;
    }
    return energy + end - work - w->least - growth_allowed * w->scale;
}

/// Makes the step's end the new state. False if it is not finite.
static bool finish(struct integrator *m, const struct scheme *s)
{
    double sum = 0, a, v;
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            after(m, s, i, c, &a, &v);
            m->work->a[i][c] = a;
            m->v[i][c] = v;
            m->x[i][c] = m->work->y[i][c];
            sum += m->x[i][c] + v;
        }
    }
    m->time += m->step;
    return isfinite(sum);
}

bool integrator_settle(struct integrator *m)
{
    enum { STEPS_MAX = 200 };
    const double step = m->step;
    const size_t bytes = (size_t)m->body->node_count * sizeof *m->x;
    double moved = INFINITY;
    m->step = 10; // s: so long that inertia hardly matters
    m->time = -m->step;
    const struct scheme scheme = backward_euler(m->step);
    for (int i = 0; i < STEPS_MAX && moved > m->tolerance; i++) {
        memset(m->v, 0, bytes);
        memset(m->work->a, 0, bytes);
        aim(m, &scheme);
        minimise(m, &scheme);
        moved = 0;
        for (int k = 0; k < 3 * m->body->node_count; k++) {
            moved = fmax(moved, fabs(vec3_flat(m->work->y)[k] - vec3_flat(m->x)[k]));
        }
        memcpy(m->x, m->work->y, bytes);
    }
    m->step = step;
    m->time = 0;
    return moved <= m->tolerance;
}

bool integrator_step(struct integrator *m)
{
    struct scheme scheme = generalised_alpha(m->step);
    begin(m);
    aim(m, &scheme);
    minimise(m, &scheme);
    if (!(surplus(m, &scheme) <= 0)) { // also true if it is not finite
        scheme = backward_euler(m->step);
        aim(m, &scheme);
        minimise(m, &scheme);
        m->calmed++;
    }
    return finish(m, &scheme);
}
