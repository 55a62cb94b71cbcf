/// Generalised-α steps, one Newton solve each, and the loads: a base that moves, a floor.
#include "simulation/integrator.h"
#include "base/file.h"
#include "base/need.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// --- the base's displacement over time

enum { FILE_LIMIT = 1 << 26, BURST_PERIODS = 3, SWELL_PERIODS = 2 };

/// The largest number in a track, and the shortest step in seconds. Within them no acceleration overflows.
static const double TRACK_LIMIT = 1e9, TRACK_STEP = 1e-9;

/// 0 … 1 with vanishing first and second derivatives at both ends.
static double swell(double x)
{
    x = fmax(0, fmin(1, x));
    return x * x * x * (10 + x * (6 * x - 15));
}

/// The natural cubic spline; beyond its ends it is a straight line.
static double track_at(const struct base_drive *d, double t, int derivative)
{
    int low = 0, high = d->count - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (d->time[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    double width = d->time[high] - d->time[low];
    double b = fmax(0, fmin(1, (t - d->time[low]) / width)), a = 1 - b;
    if (derivative == 2)
        return t < d->time[0] || t > d->time[d->count - 1] ? 0 : a * d->curvature[low] + b * d->curvature[high];
    double bend = (a * a * a - a) * d->curvature[low] + (b * b * b - b) * d->curvature[high];
    return a * d->value[low] + b * d->value[high] + bend * width * width / 6;
}

double drive_place(const struct base_drive *d, double t)
{
    t = fmax(t, 0);
    const double periods = d->frequency * t, wave = sin(2 * M_PI * periods);
    switch (d->kind) {
    case DRIVE_NONE:
        return 0;
    case DRIVE_SINE:
        return d->size * swell(periods / SWELL_PERIODS) * wave;
    case DRIVE_BURST:
        if (periods >= BURST_PERIODS) return 0;
        return d->size * pow(sin(M_PI * periods / BURST_PERIODS), 4) * wave;
    case DRIVE_SWEEP: {
        const double octaves = 2, rate = octaves * M_LN2 / d->seconds, part = t / d->seconds; // an exponential chirp
        const double phase = 2 * M_PI * d->frequency / 2 * expm1(rate * t) / rate;
        return d->size * swell(10 * part) * swell(10 * (1 - part)) * sin(phase);
    }
    case DRIVE_TRACK:
        return d->size * (track_at(d, t, 0) - d->value[0]);
    }
    return 0;
}

double drive_acceleration(const struct base_drive *d, double t)
{
    if (d->kind == DRIVE_NONE) return 0;
    if (d->kind == DRIVE_TRACK) return d->size * track_at(d, t, 2);
    const double h = 1e-3 / (2 * M_PI * d->frequency); // balances truncation and rounding, each about 1e-7
    return (drive_place(d, t + h) - 2 * drive_place(d, t) + drive_place(d, t - h)) / (h * h);
}

double drive_end(const struct base_drive *d)
{
    if (d->kind == DRIVE_BURST) return BURST_PERIODS / d->frequency;
    return d->kind == DRIVE_TRACK ? d->time[d->count - 1] : INFINITY;
}

bool drive_read_track(struct base_drive *d, const char *path, struct error *error)
{
    char *text;
    size_t size, lines = 1;
    if (!file_read_text(path, FILE_LIMIT, &text, &size, error)) return false;
    for (size_t i = 0; i < size; i++) lines += text[i] == '\n';
    d->kind = DRIVE_TRACK;
    d->time = pool_take(&d->pool, lines, sizeof *d->time);
    d->value = pool_take(&d->pool, lines, sizeof *d->value);
    d->curvature = pool_take(&d->pool, lines, sizeof *d->curvature);
    bool good = true;
    int number = 0;
    for (char *line = text, *next; good && line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        number++;
        double time, value;
        int end = 0;
        if (!line[strspn(line, " \t\r")]) continue;
        good = sscanf(line, "%lf , %lf %n", &time, &value, &end) == 2 && !line[end] && fabs(time) <= TRACK_LIMIT &&
               fabs(value) <= TRACK_LIMIT;
        if (!good && d->count == 0 && !strpbrk(line, "0123456789")) { // the headings
            good = true;
            continue;
        }
        if (!good) {
            fail(error, ERROR_INPUT, "%s:%d: expected two numbers up to 1e9, \"seconds,displacement\", got '%.24s'",
                 path, number, line);
        } else if (d->count > 0 && !(time - d->time[d->count - 1] >= TRACK_STEP)) {
            good = fail(error, ERROR_INPUT, "%s:%d: expected a time a nanosecond or more after %g, got %g", path,
                        number, d->time[d->count - 1], time);
        } else {
            d->time[d->count] = time;
            d->value[d->count++] = value;
        }
    }
    if (good && d->count < 2)
        good = fail(error, ERROR_INPUT, "%s: expected two lines \"seconds,displacement\" or more, got %d", path,
                    d->count);

    // Second derivatives of the natural cubic spline, by the usual tridiagonal elimination.
    const double *t = d->time, *y = d->value;
    double *above = pool_take(&d->pool, lines, sizeof *above);
    for (int i = 1; good && i < d->count - 1; i++) {
        double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
        double right = 6 * ((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
        double pivot = 2 * (before + after) - before * above[i - 1];
        above[i] = after / pivot;
        d->curvature[i] = (right - before * d->curvature[i - 1]) / pivot;
    }
    for (int i = d->count - 2; good && i > 0; i--) d->curvature[i] -= above[i] * d->curvature[i + 1];
    free(text);
    return good;
}

// --- springs under the vertices

void floor_create(struct floor *f, const struct lattice *lattice, const struct surface *surface, double height,
                  double young, double density)
{
    const double stiffer = 10; // than a layer of cells: the floor gives way a tenth as much as the feet
    size_t count = (size_t)surface->vertex_count + 1;
    *f = (struct floor){.lattice = lattice, .height = height};
    f->spring = pool_take(&f->pool, count, sizeof *f->spring);
    f->damper = pool_take(&f->pool, count, sizeof *f->damper);
    f->origin = pool_take(&f->pool, count, sizeof *f->origin);
    f->touched = pool_take(&f->pool, count, sizeof *f->touched);
    f->damped = pool_take(&f->pool, count, sizeof *f->damped);
    f->pushed = pool_take(&f->pool, count, sizeof *f->pushed);
    for (int i = 0; i < surface->index_count; i++) { // a vertex gets a third of the area of each of its triangles
        double normal[3], middle[3];
        triangle_measure(surface, i / 3, normal, middle);
        f->spring[surface->indices[i]] += vec3_length(normal) / 6;
    }
    for (int i = 0; i < surface->vertex_count; i++) {
        f->damper[i] = f->spring[i] * sqrt(young * density);
        f->spring[i] *= stiffer * young / lattice->cell;
    }
}

static double depth_of(const struct floor *f, int vertex, double risen, const double (*x)[3])
{
    const struct lattice *l = f->lattice;
    const int *node = l->tet[l->host[vertex]];
    double depth = f->height + risen;
    for (int a = 0; a < 4; a++) depth -= l->weight[vertex][a] * x[node[a]][1];
    return depth;
}

// --- steps

enum { NEWTON_STEPS = 60, GRADIENT_STEPS = 2000 };

// A looser tolerance costs more Newton iterations, each with an assembly; a tighter one saves none.
static const double linear_tolerance = 1e-3;

// Without a drive the energy cannot rise. This share is allowed for rounding and the scheme's ripple.
static const double growth_allowed = 0.01;

struct integrator_work {
    double (*a)[3];         ///< accelerations
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
    if (!loads->floor) return energy;

    // The springs under the vertices push the nodes.
    struct floor *f = loads->floor;
    const struct lattice *l = f->lattice;
    const double risen = floor_rise(loads, time);
    double pressed = 0;
    f->drag = 0;
    for (int i = 0; i < l->vertex_count; i++) {
        f->touched[i] = f->pushed[i] = false;
        if (l->host[i] < 0 || !(f->spring[i] > 0)) continue;
        const int *node = l->tet[l->host[i]];
        const double depth = depth_of(f, i, risen, x), below = fmax(depth, 0);
        const double drag = f->damped[i] ? f->damper[i] * f->rate : 0, sunk = depth - f->origin[i];
        const double push = f->spring[i] * below + drag * sunk, spring = 0.5 * f->spring[i] * below * below;
        f->touched[i] = depth > 0;
        f->pushed[i] = push > 0;
        pressed += spring;
        // Where the damper would pull, the potential stays at its minimum.
        const double origin = fmax(f->origin[i], 0), both = drag * f->spring[i] / (drag + f->spring[i]);
        f->drag += push > 0 ? 0.5 * drag * sunk * sunk : 0.5 * both * origin * origin - spring;
        for (int a = 0; push > 0 && a < 4; a++) force[node[a]][1] += l->weight[i][a] * push;
    }
    return energy + pressed;
}

/// A step in the form of Newmark's: x + h v + h² (k a + β a'), v + h ((1 − γ) a + γ a'), with a' from the balance of forces at
/// fractions of the step.
struct scheme {
    double am, af, k, beta, gamma;
    double inertia, rate; ///< κ and r
};

static struct scheme complete_scheme(struct scheme s, double h)
{
    s.inertia = (1 - s.am) / ((1 - s.af) * s.beta * h * h);
    s.rate = s.gamma / (s.beta * h);
    return s;
}

static struct scheme backward_euler(double h) { return complete_scheme((struct scheme){.beta = 1, .gamma = 1}, h); }

void integrator_create(struct integrator *integrator, struct body *body, double step)
{
    size_t n = (size_t)body->node_count;
    *integrator = (struct integrator){.body = body, .step = step, .tolerance = 1e-9};
    struct pool *pool = &integrator->pool;
    struct integrator_work *w = integrator->work = pool_take(pool, 1, sizeof *w);
    typedef double point[3];
    point **const vectors[] = {&integrator->x, &integrator->v, &w->a,        &w->y,         &w->target, &w->origin,
                               &w->start,      &w->force,      &w->downhill, &w->direction, &w->moved,  &w->drag};
    for (size_t i = 0; i < sizeof vectors / sizeof *vectors; i++)
        *vectors[i] = pool_take(pool, n, sizeof **vectors[i]);
    w->lagged = body->stiffness;
    w->lagged.block = pool_take(pool, (size_t)body->stiffness.start[n] + 1, sizeof *w->lagged.block);
    memcpy(integrator->x, body->rest, n * sizeof *integrator->x);
}

/// Forces of strain and loads at the positions x, 0 at pinned nodes. Returns the strain energy; the loads' goes to `potential`.
static double sum_forces(struct integrator *m, double time, const double (*x)[3], double (*force)[3],
                         double *potential)
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
static double evaluate_potential(struct integrator *m, const struct scheme *scheme, const double (*y)[3])
{
    struct integrator_work *w = m->work;
    double potential, energy = sum_forces(m, m->time + m->step, y, w->force, &potential);
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

/// dᵀ∇ of the potential for the Newton step d: negative if it leads down.
static double slope_along(const struct integrator *m)
{
    double slope = 0;
    for (int i = 0; i < m->body->node_count; i++) slope -= vec3_dot(m->work->direction[i], m->work->downhill[i]);
    return slope;
}

/// Minimises the potential from y. It has creases where two principal stretches of an inverted element are opposite, and Newton's
/// method may not converge on one. Then the lowest point found is good enough, since every iteration went down.
static void minimise(struct integrator *m, const struct scheme *scheme)
{
    enum { HALVINGS = 30 };
    const double enough = 1e-4, rounding = 1e-6;
    struct integrator_work *w = m->work;
    struct blocks *a = &m->body->stiffness;
    const size_t bytes = (size_t)m->body->node_count * sizeof *w->direction;
    double energy = evaluate_potential(m, scheme, (const double(*)[3])w->y);
    for (int iteration = 0; iteration < NEWTON_STEPS && isfinite(energy); iteration++) {
        // The body's matrix becomes κ M + r C + K(y), with y from the last evaluate_potential().
        const double damping = scheme->rate * m->stiffness_damping;
        const double inertia = scheme->inertia + scheme->rate * m->mass_damping;
        body_stiffness(m->body);
        const struct floor *f = m->loads.floor;
        const struct lattice *l = f ? f->lattice : NULL;
        for (int i = 0; f && i < l->vertex_count; i++) { // −∂f/∂x of its springs as loads_forces() left them
            if (!f->pushed[i]) continue;
            const int *place = m->body->place[l->host[i]];
            const double stiffness = (f->touched[i] ? f->spring[i] : 0) + (f->damped[i] ? f->damper[i] * f->rate : 0);
            for (int k = 0; k < 16; k++) {
                if (place[k] < 0) continue;
                a->block[place[k]][4] += stiffness * l->weight[i][k / 4] * l->weight[i][k % 4];
            }
        }
        for (int k = 0; damping > 0 && k < a->start[a->rows]; k++) {
            for (int i = 0; i < 9; i++) a->block[k][i] += damping * w->lagged.block[k][i];
        }
        for (int i = 0; i < a->rows; i++) {
            for (int d = 0; d < 9; d += 4) a->block[a->diagonal[i]][d] += m->body->mass[i] * inertia;
        }

        memset(w->direction, 0, bytes);
        m->gradients += conjugate_solve(&m->body->scratch, a, (const double(*)[3])w->downhill, w->direction,
                                        linear_tolerance, GRADIENT_STEPS);
        m->newton++;

        // Line search along the Newton step, until the potential has fallen enough: by Armijo's condition or, where rounding hides the
        // fall, by the slope (Hager and Zhang 2005, approximate Wolfe condition). A step below the tolerance is taken unchecked.
        double *y = vec3_flat(w->y), *direction = vec3_flat(w->direction), largest = 0, part = 1, taken = 0;
        const double before = energy, slope = slope_along(m);
        for (int i = 0; i < a->rows; i++) largest = fmax(largest, vec3_length(w->direction[i]));
        bool falls = false;
        for (int halving = 0; halving < HALVINGS && !falls; halving++) {
            for (int i = 0; i < 3 * a->rows; i++) y[i] += (part - taken) * direction[i];
            if (largest <= m->tolerance) return;
            taken = part;
            energy = evaluate_potential(m, scheme, (const double(*)[3])w->y);
            falls = energy <= before + enough * part * slope ||
                    (energy <= before + rounding * fabs(before) && fabs(slope_along(m)) <= 0.8 * fabs(slope));
            if (!falls) part /= 2;
        }
        if (!falls || !(part * largest > m->tolerance)) return;
    }
}

/// t, q and a first guess at y.
static void set_targets(struct integrator *m, const struct scheme *s)
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

    // A floor that rises, and the speed of a vertex over it at the step's end.
    struct floor *floor = m->loads.floor;
    if (!floor) return;
    const double end = m->time + h, risen = floor_rise(&m->loads, end);
    const double speed = (risen - floor_rise(&m->loads, end - h)) / h;
    floor->rate = s->rate;
    for (int i = 0; i < floor->lattice->vertex_count; i++) {
        if (!floor->damped[i]) continue;
        floor->origin[i] = depth_of(floor, i, risen, (const double(*)[3])w->moved) - speed / s->rate;
    }
}

/// Newmark's acceleration and velocity at the step's end.
static void newmark(const struct integrator *m, const struct scheme *s, int i, int c, double *a, double *v)
{
    const double h = m->step, before = m->work->a[i][c];
    double ahead = m->work->y[i][c] - m->x[i][c] - h * m->v[i][c];
    *a = (ahead / (h * h) - s->k * before) / s->beta;
    *v = m->v[i][c] + h * ((1 - s->gamma) * before + s->gamma * *a);
}

bool integrator_find_equilibrium(struct integrator *m)
{
    enum { EQUILIBRIUM_STEPS = 200 };
    const double step = m->step;
    const size_t bytes = (size_t)m->body->node_count * sizeof *m->x;
    double moved = INFINITY;
    m->step = 10; // s: so long that inertia hardly matters
    m->time = -m->step;
    const struct scheme scheme = backward_euler(m->step);
    for (int i = 0; i < EQUILIBRIUM_STEPS && moved > m->tolerance; i++) {
        memset(m->v, 0, bytes);
        memset(m->work->a, 0, bytes);
        set_targets(m, &scheme);
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
    struct integrator_work *w = m->work;
    const double rho = 0.8; // ρ∞ of Chung and Hulbert's parameters
    struct scheme scheme = {.am = (2 * rho - 1) / (rho + 1), .af = rho / (rho + 1)};
    scheme.gamma = 0.5 - scheme.am + scheme.af;
    scheme.beta = 0.25 * (1 - scheme.am + scheme.af) * (1 - scheme.am + scheme.af);
    scheme.k = 0.5 - scheme.beta;
    scheme = complete_scheme(scheme, m->step);

    // Forces, energy and the stiffness for damping; at the first step also the accelerations M⁻¹(f − C v).
    double energy = sum_forces(m, m->time, (const double(*)[3])m->x, w->start, &w->potential) +
                    body_kinetic(m->body, (const double(*)[3])m->v);
    struct floor *floor = m->loads.floor;
    if (floor) memcpy(floor->damped, floor->touched, (size_t)floor->lattice->vertex_count * sizeof *floor->damped);
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

    set_targets(m, &scheme);
    minimise(m, &scheme);

    // The energy at the step's end has a bound. A drive does the work ∂Φ/∂t on the body, here by the trapezoidal rule: the mean change
    // of Φ at the start's positions and at the end's.
    double end, work = 0, a, v;
    energy = sum_forces(m, m->time + m->step, (const double(*)[3])w->y, w->force, &end);
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            newmark(m, &scheme, i, c, &a, &v);
            energy += 0.5 * m->body->mass[i] * v * v;
        }
    }
    if (m->loads.drive) {
        work = loads_forces(&m->loads, m->body, m->time + m->step, (const double(*)[3])m->x, w->force) - w->potential;
        work += end - loads_forces(&m->loads, m->body, m->time, (const double(*)[3])w->y, w->force);
        work /= 2;
    }
    if (!(energy + end - work - w->least - growth_allowed * w->scale <= 0)) { // also true if it is not finite
        scheme = backward_euler(m->step);
        set_targets(m, &scheme);
        minimise(m, &scheme);
        m->calmed++;
    }

    double sum = 0;
    for (int i = 0; i < m->body->node_count; i++) {
        for (int c = 0; c < 3 && !m->body->pinned[i]; c++) {
            newmark(m, &scheme, i, c, &a, &v);
            w->a[i][c] = a;
            m->v[i][c] = v;
            m->x[i][c] = w->y[i][c];
            sum += m->x[i][c] + v;
        }
    }
    m->time += m->step;
    return isfinite(sum);
}
