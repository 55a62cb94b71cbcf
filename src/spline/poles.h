/// The poles for the animator's parameters, and the filter's coefficients (docs/mathematics.md, Poles).
#ifndef SPLINE_POLES_H
#define SPLINE_POLES_H

#include <math.h>
#include <wiggly/more.h>

typedef struct cplx {
    double re, im;
} cplx;

static inline cplx cplx_add(cplx a, cplx b) { return (cplx){a.re + b.re, a.im + b.im}; }
static inline cplx cplx_sub(cplx a, cplx b) { return (cplx){a.re - b.re, a.im - b.im}; }
static inline cplx cplx_scale(double s, cplx a) { return (cplx){s * a.re, s * a.im}; }
static inline cplx cplx_mul(cplx a, cplx b) { return (cplx){a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
static inline cplx cplx_conj(cplx a) { return (cplx){a.re, -a.im}; }
static inline double cplx_norm(cplx a) { return a.re * a.re + a.im * a.im; }
static inline double cplx_size(cplx a) { return sqrt(cplx_norm(a)); }

/// Continuous poles in 1/s, natural frequency and band centre in rad/s.
typedef struct poles {
    cplx s[2];
    double natural;  ///< ω_n
    double centre;   ///< ω_c
    double decay;    ///< ζω_n
    double angle[2]; ///< Im s h without whole turns, −π … π
    double half;     ///< Im (s₀−s₁) h / 2 without whole half turns
} poles;

/// Coefficients of r_i = x_{i+1} − a x_i − b x_{i−1} + g ÿ, kept as distances from the cubic's a = 2, b = −1:
///     r_i = (x_{i+1} − 2x_i + x_{i−1}) − m (x_i − x_{i−1}) + p x_{i−1} + g ÿ,   m = μ₀ + μ₁, p = μ₀μ₁, μ = λ − 1,
/// because at high sample rates a and b hold no digit of the frequency. If poles fade within a sample, m and p hold no digit of a and b, and
/// weights of |b|⁻¹ make that matter; so the rest is kept separately.
typedef struct coefficient_rest {
    cplx a, b; ///< 0 up to FAST
} coefficient_rest;

typedef struct coefficients {
    cplx m, p; ///< a = 2 + m + rest.a, −b = 1 + m + p + rest.b
    coefficient_rest rest;
    cplx g; ///< exp((s₀+s₁)h/2): the drive in phase with the filter
} coefficients;

/// What the rounding of m and p may be.
typedef struct coefficient_loss {
    double m, p;
} coefficient_loss;

static inline cplx coefficients_a(const coefficients *at)
{
    return (cplx){(2 + at->m.re) + at->rest.a.re, at->m.im + at->rest.a.im};
}

/// −b.
static inline cplx coefficients_b(const coefficients *at)
{
    return (cplx){(2 + at->m.re - 1 + at->p.re) + at->rest.b.re, (at->m.im + at->p.im) + at->rest.b.im};
}

/// What rounding, and coefficients that are cut, may be to a row: a share of x_j, and one of the differences to its neighbours.
typedef struct speed_loss {
    double x, e;
    bool cut; ///< the poles nearly alias to one: on_e should be larger, and so should the row's weight be
} speed_loss;

/// h times the speed that the poles give from a sample and the difference to its neighbour: on_x x_j + on_e (x_{j+1} − x_j), or backwards with
/// (x_j − x_{j−1}).
typedef struct speed_form {
    cplx on_x, on_e;
    speed_loss loss;
} speed_form;

/// The cost of swing at the start: two squares of the first state, taken as (x₀, e₀) with e₀ = x₁ − x₀,
///     Σ weight |on_x x₀ + on_e e₀|²,
/// the factored information matrix H of the stationary process, without the cancellation of its plain form. Weights are 0 where
/// both poles are 0.
typedef struct start_cost {
    struct start_row {
        double weight;
        cplx on_x, on_e;
        speed_loss loss;
    } row[2];
} start_cost;

/// The lowest damping ratio for the start's cost; times calm, for a loop.
#define LEAST_DAMPING 0.05

/// Faster decay makes no difference to a double, but weights and their products stay finite.
#define DEEPEST 100.0

/// ln of the largest ratio of jets' weights: cubes of it stay finite.
#define HEAVIEST 200.0

/// ln |b|⁻¹ from which on a and b need all their digits.
#define FAST 8.0
/// From here on they are stored as a and b.
#define FASTEST 40.0

/// The first of the samples from … to with the largest natural frequency, and that frequency, rad/s.
int poles_fastest(const wiggly_desc *desc, int from, int to, double *natural);

/// ln |g|⁻² of a sample, the weight of its jet row; at most HEAVIEST.
double poles_weight_exponent(const poles *at, double step);

/// Poles at a sample. `floor` is the lowest damping ratio (0 except for loops and the start's cost).
poles poles_at(const wiggly_desc *desc, int sample, double floor);

/// True where no pole parameter that the mode uses has a track.
bool poles_are_constant(const wiggly_desc *desc);

coefficients poles_coefficients(const poles *at, double step);

/// What rounding leaves of m and p, to first order: of each λ the angle's and the decay's, 4ε (|s h| |λ| + |λ − 1|), whole turns left out. Of a
/// conjugate pair the angle's is of second order, and what a critical damping does to both poles cancels. `pair`: conjugate or real poles.
static inline coefficient_loss poles_loss(const poles *at, double step, bool pair)
{
    const double decay = at->decay * step, natural = at->natural * step,
                 turn = fmax(fabs(at->angle[0]), fabs(at->angle[1]));
    const double unit = 0x1p-50, fade = decay < 1 ? decay : 1; // 4 ε
    const double whole = natural * natural, rest = decay * decay + turn * turn, square = whole < rest ? whole : rest;
    const double bend = square < 4 + natural ? square : 4 + natural, reach = fade + turn,
                 most = reach < 2 ? reach : 2;
    return pair ? (coefficient_loss){2 * unit * (fade + bend), 4 * unit * bend}
                : (coefficient_loss){4 * unit * reach, 4 * unit * reach * most};
}
/// λ = (λ₀ + λ₁)/2 and δ² = (λ₀ − λ₁)²/4 of the discrete poles.
void poles_mean(const poles *at, double step, cplx *lambda, cplx *delta2);
start_cost poles_start_cost(const poles *at, double step);
speed_form poles_speed(const poles *at, double step, bool backwards);
/// The start's cost at the poles `damped` on the state that has the same x and x' as (x₀, e₀) has with the poles `at`.
start_cost poles_start_seen_from(start_cost cost, const poles *damped, const poles *at, double step);
/// The single pole of the free motion, −ζω_n + jω_n√(1−ζ²).
static inline cplx poles_passive(const poles *at) { return (cplx){-at->decay, at->centre}; }
/// Relative change of the free motion, with the pole `passive`, in one sample, where other poles give the speed `ahead`.
cplx poles_tail(cplx passive, const speed_form *ahead, double step);
cplx cplx_exp(cplx z);

/// The same of poles that fade within a sample, from their a and b, which are kept apart.
static inline coefficient_loss poles_fast_loss(const poles *at, double step, const coefficients *c)
{
    const double turn = fmax(fabs(at->angle[0]), fabs(at->angle[1]));
    const double unit = 2 * 0x1p-50 * (1 + 2 * at->decay * step + turn), of_a = unit * cplx_size(coefficients_a(c));
    return (coefficient_loss){of_a, of_a + unit * cplx_size(coefficients_b(c))};
}

// --- many samples at once, for parameters that vary ---

enum { POLES_BLOCK = 64 };

typedef struct poles_block {
    double natural[POLES_BLOCK], centre[POLES_BLOCK]; ///< rad/s
    double exponent[POLES_BLOCK];                     ///< poles_weight_exponent()
    double m_re[POLES_BLOCK], m_im[POLES_BLOCK], p_re[POLES_BLOCK], p_im[POLES_BLOCK];
    double loss_m[POLES_BLOCK], loss_p[POLES_BLOCK]; ///< poles_loss()
} poles_block;

/// Fills `count` ≤ POLES_BLOCK samples from `from` on, as poles_at() and poles_coefficients() would to the last
/// digits.
void poles_block_fill(const wiggly_desc *desc, int from, int count, double floor, poles_block *block);

/// The centres of any number of samples.
void poles_block_centres(const wiggly_desc *desc, int from, int count, double floor, double *centre);

/// out ← e^(real + j angle).
void poles_block_turn(const double *real, const double *angle, int count, cplx *out);

/// out ← eˣ for |x| ≤ 700.
void poles_block_exp(const double *x, int count, double *out);

#endif
