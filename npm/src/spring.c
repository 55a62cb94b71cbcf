/// A spring through keys, for the web: what a damped oscillator does by itself while its goal steps from key to key, plus what the
/// solver adds, with the least force, to meet the keys.
//
//     total = u + w,    u″ + 2d u′ + k u = k goal(t),    d = ζω, k = ω²,
//
// u begins as the spring does, with the first key's value and the given speed. Its goal steps to the next key half way. w begins at rest
// (WIGGLY_REST) and passes through what is left at the keys. After the last sample all is one free swing about the last key.
// A key need not lie on a sample: the knot is on the nearest one, with the value for which the cubics between samples meet the key.
#include "spline/oscillator.h"
#include <wiggly/wiggly.h>

typedef struct motion {
    double at, rate; ///< rate: of u per second, of samples per sample
} motion;

enum { PAGE = 65536, ROUNDS = 40 };

extern unsigned char __heap_base;

static struct {
    int keys, samples; ///< one sample more than the keys need, for the slope of the last
    double *times, *values, *w, *spare;
    motion *curve, *u; ///< curve: what the caller reads
    wiggly_knot *knots;
    wiggly_solver *solver;
} room;

static void *take(size_t *used, size_t count, size_t size)
{
    void *at = (void *)*used;
    *used += (count * size + 15) & ~(size_t)15;
    const size_t have = __builtin_wasm_memory_size(0) * PAGE;
    if (*used <= have) return at;
    return __builtin_wasm_memory_grow(0, (*used - have + PAGE - 1) / PAGE) == (size_t)-1 ? NULL : at;
}

/// Room for keys ≥ 2, in order, and samples up to one behind the last key. Returns where the keys' times, their values and the curve are,
/// one after the other; NULL: no memory.
double *spring_room(int keys, int samples)
{
    const size_t k = (size_t)keys, n = (size_t)samples, solver = wiggly_memsize(samples, keys);
    size_t used = (size_t)&__heap_base;
    room.keys = keys, room.samples = samples;
    room.times = take(&used, 2 * k + 2 * n, sizeof(double));
    room.values = room.times + k;
    room.curve = (motion *)(room.values + k);
    room.u = take(&used, n, sizeof *room.u);
    room.w = take(&used, n, sizeof *room.w);
    room.spare = take(&used, n, sizeof *room.spare);
    room.knots = take(&used, k, sizeof *room.knots);
    void *memory = take(&used, 1, solver);
    return memory && wiggly_create_at(memory, solver, samples, keys, &room.solver) == WIGGLY_OK ? room.times : NULL;
}

/// A motion about 0, after what the step stands for.
static motion moved(step_matrix step, motion m)
{
    return (motion){step.q_q * m.at + step.q_v * m.rate, step.v_q * m.at + step.v_v * m.rate};
}

/// After t seconds of a free swing.
static motion swing(motion m, double d, double k, double t)
{
    return moved(oscillator_step((oscillator){d, k}, t), m);
}

/// Its value, or its speed.
double spring_swing(double value, double speed, double d, double k, double t, bool moving)
{
    const motion m = swing((motion){value, speed}, d, k, t);
    return moving ? m.rate : m.at;
}

/// u of all samples.
static void move_alone(double rate, double d, double k, double speed)
{
    const double *times = room.times, *values = room.values, h = 1 / rate;
    const step_matrix step = oscillator_step((oscillator){d, k}, h);
    motion m = {0, speed}; // about the goal
    int goal = 0;
    for (int i = 0; i < room.samples; i++) {
        room.u[i] = (motion){values[goal] + m.at, m.rate};
        double from = i * h;
        bool steps = false;
        for (; goal + 1 < room.keys; goal++) {
            const double half = (times[goal] + times[goal + 1]) / 2;
            if (half >= (i + 1) * h) break;
            m = swing(m, d, k, half - from);
            m.at += values[goal] - values[goal + 1];
            from = half, steps = true;
        }
        m = steps ? swing(m, d, k, (i + 1) * h - from) : moved(step, m);
    }
}

/// The curve, u + w: the slopes of w are those of its cubic spline, level at the start; at the last key they are those of a free swing.
static void add_solved(double rate, double d, double k)
{
    const double *w = room.w;
    const int last = room.samples - 2;
    const step_matrix step = oscillator_step((oscillator){d, k}, 1 / rate);
    double below = 0, *part = room.spare;
    motion *at = room.curve;
    at[0].rate = 0;
    for (int i = 1; i < last; i++) {
        below = part[i] = 1 / (4 - below);
        at[i].rate = (3 * (w[i + 1] - w[i - 1]) - at[i - 1].rate) * below;
    }
    at[last].rate = (w[last + 1] - step.q_q * w[last]) / (step.q_v * rate);
    for (int i = last - 1; i > 0; i--) at[i].rate -= part[i] * at[i + 1].rate;
    for (int i = 0; i <= last; i++) at[i] = (motion){room.u[i].at + w[i], room.u[i].rate / rate + at[i].rate};
}

/// The curve at a time up to the last sample, and a free swing after that: as index.js reads it.
static double read(double time, double rate, double d, double k)
{
    const int last = room.samples - 2, i = (int)(time * rate);
    const double u = time * rate - i;
    const motion *at = room.curve + (i < last ? i : last);
    if (i >= last) {
        const double goal = room.values[room.keys - 1];
        return goal + swing((motion){at->at - goal, at->rate * rate}, d, k, time - last / rate).at;
    }
    const double step = at[1].at - at->at;
    return at->at +
           u * (at->rate + u * (3 * step - 2 * at->rate - at[1].rate + u * (at->rate + at[1].rate - 2 * step)));
}

/// Moves the knots by what the curve misses the keys by; returns the most of that.
static double correct(double rate, double d, double k)
{
    double worst = 0;
    for (int n = 1; n < room.keys; n++) {
        const double missed = room.values[n] - read(room.times[n], rate, d, k);
        room.knots[n - 1].value += missed;
        worst = fmax(worst, fabs(missed));
    }
    return worst;
}

/// Fills the curve up to the sample before the last: values, and slopes per sample. Returns the solver's status.
int spring_solve(double rate, double frequency, double damping, double speed)
{
    const double natural = 2 * M_PI * frequency, d = damping * natural, k = natural * natural;
    wiggly_desc desc = {.size = sizeof desc,
                        .knots = room.knots,
                        .knot_count = room.keys - 1,
                        .samples = room.samples,
                        .step = 1 / rate,
                        .mode = WIGGLY_REAL,
                        .start = WIGGLY_REST,
                        .frequency = {.value = frequency},
                        .damping = {.value = damping}};
    wiggly_curve curve = {.size = sizeof curve, .total = room.w};
    double size = fabs(speed) * room.times[room.keys - 1];
    move_alone(rate, d, k, speed);
    for (int n = 1; n < room.keys; n++) {
        const int sample = (int)(room.times[n] * rate + 0.5);
        room.knots[n - 1] = (wiggly_knot){.sample = sample, .value = room.values[n] - room.u[sample].at};
        size = fmax(size, fabs(room.values[n] - room.values[0]));
    }
    for (int round = 0; round < ROUNDS; round++) {
        const int status = wiggly_solve(room.solver, &desc, &curve);
        if (status >= WIGGLY_SINGULAR) return status;
        add_solved(rate, d, k);
        if (!(correct(rate, d, k) > 1e-13 * size)) break;
    }
    for (int n = 0; n < room.keys; n++) { // to the last digit
        const double at = room.times[n] * rate;
        if (at == (int)at) room.curve[(int)at].at = room.values[n];
    }
    return WIGGLY_OK;
}
