/// L D Lᵀ of the band, from both ends at once (of eq. 6, eq. 22 and their kin).
//
// A = Rᵀ W R couples a sample with two neighbours on each side:
//
//     | D0 E0' F0'           |        D_k symmetric 2×2 for (Re x, Im x), E_k = A_{k+1,k}, F_k = A_{k+2,k},
//     | E0 D1  E1' F1'       |        because a knot fixes Re x alone and so breaks complex linearity.
//     | F0 E1  D2  E2' F2'   |
//     |    F1  E2  D3  E3'   |        Eliminating Re x_k, then Im x_k, changes what couples the next two samples. There is
//     |        F2  E3  D4    |        no fill outside the band, and no pivoting, because A is positive definite.
//
// A step waits for the one before, so one lane goes up from the first sample while another goes down from the last. They meet in a dense
// block of two or three samples. A loop's last two samples, the seam, have columns of their own and join that block. With l_j = a_j / pivot
//
//     z_j ← z_j − l_j z;      y = z / pivot;      x = y − Σ l_j x_j.
//
// What is known is not eliminated: 1/pivot is 0 there, so are all its l, and the solution.
// The pivots are scalars: a 2×2 block with an explicit inverse keeps half of the digits only. Of A⁻¹ the diagonal follows on the way back
// (Takahashi): with l = a / pivot, Z_kj = −Σ l_i Z_ij and Z_kk = 1/pivot − Σ l_j Z_kj need only Z of the next two samples.
#include "maths/wide.h"
#include "spline/system.h"
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

typedef int64_t masks __attribute__((vector_size(16), aligned(8), may_alias));

/// Rounding of a banded L D Lᵀ, and of its solves, in units of Σ (A⁻¹)_kk A_kk.
static const double of_squares = 80 * DBL_EPSILON;

/// A step of the factor: l of Im x_k on Re x_k, 1/pivot of both, l of both on the next samples (u, v) and on those after them (f, g), and y of
/// a solve under way.
typedef struct record2 {
    twin l, ia, id, u[2], v[2], f[2], g[2], y[2];
} record2;

/// The same outside complex mode.
typedef struct record1 {
    twin ia, u, f, y;
} record1;

_Static_assert(sizeof(record2) == 2 * BAND_RECORD * sizeof(double), "the room for a factor");

ALWAYS_INLINE twin kept(twin a, masks where) { return (twin)((masks)a & where); }
ALWAYS_INLINE twin chosen(twin a, twin other, masks where)
{
    return (twin)(((masks)a & where) | ((masks)other & ~where));
}

/// Samples before a loop's seam; those that each end eliminates; the samples between.
static int band_interior(const band_matrix *b) { return b->cyclic ? b->count - 2 : b->count; }
static int band_steps(const band_matrix *b)
{
    const int n = band_interior(b);
    return n < 4 ? 0 : (n - 2) / 2;
}
static int band_middle(const band_matrix *b) { return band_interior(b) - 2 * band_steps(b); }

band_block band_block_at(const band_matrix *m, int k)
{
    band_block block = m->alike;
    if (m->marks[k] & BAND_OWN) {
        block = m->own[k];
    } else if (!m->is_alike) {
        block = (band_block){.d = {m->d[k], 0, m->d[k]},
                             .e = {m->e_re[k], -m->e_im[k], m->e_im[k], m->e_re[k]},
                             .f = {m->f_re[k], -m->f_im[k], m->f_im[k], m->f_re[k]}};
        if (m->im_weight) block.d[2] += m->im_weight[k];
    }
    if (m->stiffness) block.d[0] += m->stiffness[k];
    return block;
}

band_block *band_own(band_matrix *m, int k)
{
    if (m->marks[k] & BAND_OWN) return &m->own[k];
    const double *stiffness = m->stiffness;
    m->stiffness = NULL;
    m->own[k] = band_block_at(m, k);
    m->stiffness = stiffness;
    m->marks[k] |= BAND_OWN;
    for (int i = k; i < k + 3 && i < m->count; i++) m->marks[i] |= BAND_BESIDE;
    return &m->own[k];
}

/// What a factor's storage depends on: the count, negative outside complex mode, and a bit for a loop.
static int shape_of(const band_matrix *m)
{
    return (m->is_complex ? m->count : -m->count) ^ (m->cyclic ? 1 << 30 : 0);
}

void band_keep(band_matrix *m)
{
    m->is_kept = m->is_factor && m->is_alike;
    if (!m->is_kept) return;
    m->kept_alike = m->alike;
    m->kept_shape = shape_of(m);
    memcpy(m->kept_marks, m->marks, (size_t)m->count);
    for (int k = 0; k < m->count; k++) {
        if (m->marks[k] & BAND_OWN) m->kept_own[k] = m->own[k];
    }
}

bool band_is_kept(const band_matrix *m)
{
    if (!m->is_alike || m->kept_shape != shape_of(m) || memcmp(&m->kept_alike, &m->alike, sizeof m->alike) != 0 ||
        memcmp(m->kept_marks, m->marks, (size_t)m->count) != 0)
        return false;
    for (int k = 0; k < m->count; k++) {
        if (m->marks[k] & BAND_OWN && memcmp(&m->kept_own[k], &m->own[k], sizeof *m->own) != 0) return false;
    }
    return true;
}

/// A_ij of two different samples, rows i.
static void couple(const band_matrix *m, int i, int j, double a[4])
{
    static const int turned[4] = {0, 2, 1, 3};
    const int n = m->count;
    memset(a, 0, 4 * sizeof *a);
    for (int by = 1; by <= 2; by++) {
        if (j + by == i || (m->cyclic && j + by == i + n)) {
            const band_block block = band_block_at(m, j);
            for (int k = 0; k < 4; k++) a[k] += by == 1 ? block.e[k] : block.f[k];
        }
        if (i + by == j || (m->cyclic && i + by == j + n)) {
            const band_block block = band_block_at(m, i);
            for (int k = 0; k < 4; k++) a[k] += (by == 1 ? block.e : block.f)[turned[k]];
        }
    }
}

// --- the blocks of a step, in both lanes -----------------------------------------------------------------------------

/// A step's diagonal and couplings to the next two samples, of Re x (u, f) and of Im x (v, g); where Re and Im are unknown.
typedef struct step_blocks {
    twin a, b, d, u[2], v[2], f[2], g[2];
    bool is_known; ///< some are not
    masks re, im;
} step_blocks;

/// The marks that make a step of a lane unusual.
ALWAYS_INLINE unsigned unusual(const bool is_complex, unsigned up, unsigned down)
{
    const unsigned fixed = is_complex ? FIXED_RE | FIXED_IM : FIXED_RE;
    return (up & (fixed | BAND_OWN)) | (down & (fixed | BAND_BESIDE));
}

/// Blocks one by one.
static void load_each(const band_matrix *m, int up, int down, step_blocks *s)
{
    const band_block a = band_block_at(m, up), b = band_block_at(m, down), next = band_block_at(m, down - 1),
                     after = band_block_at(m, down - 2);
    s->a = (twin){a.d[0], b.d[0]}, s->b = (twin){a.d[1], b.d[1]}, s->d = (twin){a.d[2], b.d[2]};
    for (int i = 0; i < 2; i++) {
        s->u[i] = (twin){a.e[2 * i], next.e[i]}, s->v[i] = (twin){a.e[2 * i + 1], next.e[2 + i]};
        s->f[i] = (twin){a.f[2 * i], after.f[i]}, s->g[i] = (twin){a.f[2 * i + 1], after.f[2 + i]};
    }
    const unsigned above = m->marks[up], below = m->marks[down];
    s->is_known = (above | below) & (FIXED_RE | FIXED_IM);
    s->re = (masks){above & FIXED_RE ? 0 : -1, below & FIXED_RE ? 0 : -1};
    s->im = (masks){above & FIXED_IM ? 0 : -1, below & FIXED_IM ? 0 : -1};
}

ALWAYS_INLINE void set_complex(twin *re, twin *im, twin r, twin i) { re[0] = r, re[1] = i, im[0] = -i, im[1] = r; }

/// The blocks of a step. `usual` are those of samples that are alike.
ALWAYS_INLINE step_blocks load_step(const band_matrix *m, const bool is_complex, int up, int down,
                                    const step_blocks *usual)
{
    if (unusual(is_complex, m->marks[up], m->marks[down])) {
        step_blocks s;
        load_each(m, up, down, &s);
        return s;
    }
    step_blocks s = *usual;
    if (!m->is_alike) {
        s.a = (twin){m->d[up], m->d[down]}, s.d = s.a;
        if (is_complex && m->im_weight) s.d += (twin){m->im_weight[up], m->im_weight[down]};
        set_complex(s.u, s.v, (twin){m->e_re[up], m->e_re[down - 1]}, (twin){m->e_im[up], -m->e_im[down - 1]});
        set_complex(s.f, s.g, (twin){m->f_re[up], m->f_re[down - 2]}, (twin){m->f_im[up], -m->f_im[down - 2]});
    }
    if (m->stiffness) s.a += (twin){m->stiffness[up], m->stiffness[down]};
    return s;
}

/// The seam's columns of a sample in a lane.
static void load_seam(const band_matrix *m, int up, int down, twin h[2][4])
{
    for (int s = 0; s < 2; s++) {
        double a[4], b[4];
        couple(m, m->count - 2 + s, up, a);
        couple(m, m->count - 2 + s, down, b);
        for (int row = 0; row < 2; row++) {
            for (int part = 0; part < 2; part++) h[part][2 * s + row] = (twin){a[2 * row + part], b[2 * row + part]};
        }
    }
}

// --- factor ----------------------------------------------------------------------------------------------------------

/// What elimination takes from the next samples: the diagonals of both, and what couples them.
typedef struct taken {
    twin near[3], far[3], across[4];
} taken;

/// The same from the seam's columns, and from the seam.
typedef struct seam_taken {
    twin near[2][4], far[2][4], corner[4][4];
} seam_taken;

/// Takes what was eliminated before from the seam's columns, then eliminates them. `pair` are both pivots' l on the next samples, times the
/// pivots.
ALWAYS_INLINE void eliminate_seam(const band_matrix *m, int step, int up, int down, const record2 *r,
                                  const twin pair[4][2], twin (*kept_seam)[4], seam_taken *t)
{
    twin h[2][4] = {{{0}}}, of[2][4] = {{{0}}};
    if (step < 2) load_seam(m, up, down, h);
    for (int c = 0; c < 4; c++) {
        const twin re = h[0][c] - t->near[0][c];
        const twin im = (h[1][c] - t->near[1][c]) - r->l * re;
        const twin by_re = re * r->ia, by_im = im * r->id;
        of[0][c] = re, of[1][c] = im;
        kept_seam[0][c] = by_re, kept_seam[1][c] = by_im;
        for (int i = 0; i < 2; i++) {
            t->near[i][c] = t->far[i][c] + (pair[0][i] * by_re + pair[1][i] * by_im);
            t->far[i][c] = pair[2][i] * by_re + pair[3][i] * by_im;
        }
        // above the diagonal, too, where nothing reads: Emscripten 3.1.6 gets the triangle wrong
        for (int k = 0; k < 4; k++) t->corner[c][k] += by_re * of[0][k] + by_im * of[1][k];
    }
}

/// One step in complex mode. The determinant, not the second pivot, is divided by: so the two divisions do not wait for each other. `pair`
/// receives what couples both to the next samples, l times the pivots.
ALWAYS_INLINE void factor_complex(const step_blocks *s, taken *t, record2 *r, masks *good, twin pair[4][2])
{
    const twin one = both(1);
    twin a = s->a - t->near[0];
    const twin b = s->b - t->near[1], d = s->d - t->near[2];
    const twin u0 = s->u[0] - t->across[0], u1 = s->u[1] - t->across[2];
    const twin v0 = s->v[0] - t->across[1], v1 = s->v[1] - t->across[3];
    twin det = a * d - b * b;
    if (s->is_known) {
        a = chosen(a, one, s->re);
        det = chosen(a * d - kept(b, s->re) * b, one, s->im);
    }
    twin ia = one / a, id = a * (one / det);
    if (s->is_known) ia = kept(ia, s->re), id = kept(id, s->im);
    const twin l = b * ia;
    *good &= (a > both(0)) & (det > both(0)) & (det < both(INFINITY));
    const twin w0 = v0 - u0 * l, w1 = v1 - u1 * l, f0 = s->f[0], f1 = s->f[1], g0 = s->g[0] - f0 * l,
               g1 = s->g[1] - f1 * l;
    const twin p0 = u0 * ia, p1 = u1 * ia, q0 = w0 * id, q1 = w1 * id;
    const twin x0 = f0 * ia, x1 = f1 * ia, z0 = g0 * id, z1 = g1 * id;
    r->ia = ia, r->id = id;
    r->l = l, r->u[0] = p0, r->u[1] = p1, r->f[0] = x0, r->f[1] = x1;
    r->v[0] = q0, r->v[1] = q1, r->g[0] = z0, r->g[1] = z1;
    pair[0][0] = u0, pair[0][1] = u1, pair[1][0] = w0, pair[1][1] = w1;
    pair[2][0] = f0, pair[2][1] = f1, pair[3][0] = g0, pair[3][1] = g1;
    t->near[0] = t->far[0] + (u0 * p0 + w0 * q0);
    t->near[1] = t->far[1] + (u0 * p1 + w0 * q1);
    t->near[2] = t->far[2] + (u1 * p1 + w1 * q1);
    t->across[0] = f0 * p0 + g0 * q0, t->across[1] = f0 * p1 + g0 * q1;
    t->across[2] = f1 * p0 + g1 * q0, t->across[3] = f1 * p1 + g1 * q1;
    t->far[0] = f0 * x0 + g0 * z0;
    t->far[1] = f0 * x1 + g0 * z1;
    t->far[2] = f1 * x1 + g1 * z1;
}

/// One step outside complex mode.
ALWAYS_INLINE void factor_real(const step_blocks *s, taken *t, record1 *r, masks *good, twin pair[2])
{
    const twin one = both(1), a = chosen(s->a - t->near[0], one, s->re), u = s->u[0] - t->across[0], f = s->f[0];
    const twin ia = kept(one / a, s->re), p = u * ia, x = f * ia;
    *good &= (a > both(0)) & (a < both(INFINITY));
    r->ia = ia, r->u = p, r->f = x;
    pair[0] = u, pair[1] = f;
    t->near[0] = t->far[0] + u * p;
    t->across[0] = f * p;
    t->far[0] = f * x;
}

ALWAYS_INLINE void eliminate_seam_real(const band_matrix *m, int step, int up, int down, const record1 *r,
                                       const twin pair[2], twin *kept_seam, seam_taken *t)
{
    twin h[2][4] = {{{0}}}, of[2];
    if (step < 2) load_seam(m, up, down, h);
    for (int c = 0; c < 2; c++) {
        const twin re = h[0][2 * c] - t->near[0][c], by = re * r->ia;
        of[c] = re;
        kept_seam[c] = by;
        t->near[0][c] = t->far[0][c] + pair[0] * by;
        t->far[0][c] = pair[1] * by;
        for (int k = 0; k <= c; k++) t->corner[c][k] += by * of[k];
    }
}

/// The place of a sample's part in the dense block: of sample s of the middle, or after them of the seam.
static int dense_at(const band_matrix *m, int s, int part) { return m->is_complex ? 2 * s + part : s; }

static int dense_sample(const band_matrix *m, int s)
{
    const int middle = band_middle(m);
    return s < middle ? band_steps(m) + s : m->count - 2 + (s - middle);
}

static int dense_samples(const band_matrix *m) { return band_middle(m) + (m->cyclic ? 2 : 0); }

/// The dense block, without what both lanes take from it.
static void load_dense(band_matrix *m)
{
    const int samples = dense_samples(m), parts = m->is_complex ? 2 : 1;
    for (int s = 0; s < samples; s++) {
        for (int r = 0; r <= s; r++) {
            const int i = dense_sample(m, s), j = dense_sample(m, r);
            double a[4];
            if (r < s) {
                couple(m, i, j, a);
            } else {
                const band_block own = band_block_at(m, i);
                a[0] = own.d[0], a[1] = a[2] = own.d[1], a[3] = own.d[2];
            }
            for (int row = 0; row < parts; row++) {
                for (int column = 0; column < parts; column++)
                    m->dense[dense_at(m, s, row)][dense_at(m, r, column)] = a[2 * row + column];
            }
        }
    }
}

/// Takes what was eliminated from the middle: both lanes end beside it, one at each end.
static void take_from_middle(band_matrix *m, const taken *t)
{
    const int parts = m->is_complex ? 2 : 1, last = band_middle(m) - 1;
    static const int of_diagonal[2][2] = {{0, 1}, {1, 2}};
    for (int lane = 0; lane < 2; lane++) {
        const int near = lane ? last : 0, far = lane ? last - 1 : 1;
        for (int r = 0; r < parts; r++) {
            for (int c = 0; c < parts; c++) {
                const double across = t->across[2 * r + c][lane];
                if (c <= r) {
                    m->dense[dense_at(m, near, r)][dense_at(m, near, c)] -= t->near[of_diagonal[r][c]][lane];
                    m->dense[dense_at(m, far, r)][dense_at(m, far, c)] -= t->far[of_diagonal[r][c]][lane];
                }
                if (lane) { // below the diagonal: the sample nearer to the end
                    m->dense[dense_at(m, near, c)][dense_at(m, far, r)] -= across;
                } else {
                    m->dense[dense_at(m, far, r)][dense_at(m, near, c)] -= across;
                }
            }
        }
    }
}

static void take_from_seam(band_matrix *m, const seam_taken *t)
{
    const int parts = m->is_complex ? 2 : 1, middle = band_middle(m), seam = dense_at(m, middle, 0);
    for (int c = 0; c < 2 * parts; c++) {
        for (int lane = 0; lane < 2; lane++) {
            const int near = lane ? middle - 1 : 0, far = lane ? middle - 2 : 1;
            for (int part = 0; part < parts; part++) {
                m->dense[seam + c][dense_at(m, near, part)] -= t->near[part][c][lane];
                m->dense[seam + c][dense_at(m, far, part)] -= t->far[part][c][lane];
            }
        }
        for (int k = 0; k <= c; k++) m->dense[seam + c][seam + k] -= t->corner[c][k][0] + t->corner[c][k][1];
    }
}

static bool factor_dense(band_matrix *m)
{
    const int samples = dense_samples(m), parts = m->is_complex ? 2 : 1, n = samples * parts;
    for (int j = 0; j < n; j++) {
        const int fixed = m->marks[dense_sample(m, j / parts)] & (j % parts ? FIXED_IM : FIXED_RE);
        const double pivot = m->dense[j][j], inverse = fixed ? 0 : 1 / pivot;
        if (!fixed && !(pivot > 0 && pivot < INFINITY)) return false;
        m->dense_inverse[j] = inverse;
        for (int i = j + 1; i < n; i++) {
            const double l = m->dense[i][j] * inverse;
            for (int k = j + 1; k <= i; k++) m->dense[i][k] -= l * m->dense[k][j];
        }
    }
    return true;
}

// --- solve -----------------------------------------------------------------------------------------------------------

/// What a forward pass takes from the right side of the next samples and, `corner`, of the seam.
typedef struct passed {
    twin near[2], far[2], corner[4], energy;
} passed;

ALWAYS_INLINE twin load_two(const double *x, int up, int down) { return (twin){x[2 * up], x[2 * down]}; }

/// A step of the way forward in complex mode.
ALWAYS_INLINE void forward(band_matrix *m, const bool is_cyclic, int step, const double *x, passed *p)
{
    const int up = step, down = band_interior(m) - 1 - step;
    record2 *r = (record2 *)(void *)m->record + step;
    const twin(*const seam)[4] = (twin(*)[4])(void *)m->seam + 2 * step;
    const twin a = load_two(x, up, down) - p->near[0];
    const twin b = (load_two(x + 1, up, down) - p->near[1]) - r->l * a;
    r->y[0] = a * r->ia, r->y[1] = b * r->id;
    p->energy += a * r->y[0] + b * r->y[1];
    for (int i = 0; i < 2; i++) {
        p->near[i] = p->far[i] + (r->u[i] * a + r->v[i] * b);
        p->far[i] = r->f[i] * a + r->g[i] * b;
    }
    for (int c = 0; is_cyclic && c < 4; c++) p->corner[c] += seam[0][c] * a + seam[1][c] * b;
}

/// The same outside it.
ALWAYS_INLINE void forward_real(band_matrix *m, const bool is_cyclic, int step, const double *x, passed *p)
{
    record1 *r = (record1 *)(void *)m->record + step;
    const twin(*const seam)[2] = (twin(*)[2])(void *)m->seam + step;
    const twin z = load_two(x, step, band_interior(m) - 1 - step) - p->near[0];
    r->y = z * r->ia;
    p->energy += z * r->y;
    for (int c = 0; is_cyclic && c < 2; c++) p->corner[c] += (*seam)[c] * z;
    p->near[0] = p->far[0] + r->u * z;
    p->far[0] = r->f * z;
}

// --- factor and solve ---

/// Factors, and passes the right side x on if there is one.
ALWAYS_INLINE bool factor(band_matrix *m, const bool is_complex, const bool is_cyclic, const double *x, passed *p)
{
    const int n = band_interior(m), steps = band_steps(m);
    const band_block *alike = &m->alike;
    step_blocks usual = {.re = {-1, -1}, .im = {-1, -1}, .a = both(alike->d[0]), .d = both(alike->d[2])};
    set_complex(usual.u, usual.v, both(alike->e[0]), (twin){alike->e[2], -alike->e[2]});
    set_complex(usual.f, usual.g, both(alike->f[0]), (twin){alike->f[2], -alike->f[2]});
    taken t = {.near = {{0}}};
    seam_taken of_seam = {.near = {{{0}}}};
    masks good = {-1, -1};
    for (int r = 0; r < steps; r++) {
        const step_blocks s = load_step(m, is_complex, r, n - 1 - r, &usual);
        if (is_complex) {
            record2 *to = (record2 *)(void *)m->record + r;
            twin pair[4][2];
            factor_complex(&s, &t, to, &good, pair);
            if (is_cyclic)
                eliminate_seam(m, r, r, n - 1 - r, to, pair, (twin(*)[4])(void *)m->seam + 2 * r, &of_seam);
            if (x) forward(m, is_cyclic, r, x, p);
        } else {
            record1 *to = (record1 *)(void *)m->record + r;
            twin pair[2];
            factor_real(&s, &t, to, &good, pair);
            if (is_cyclic)
                eliminate_seam_real(m, r, r, n - 1 - r, to, pair, (twin *)(void *)m->seam + 2 * r, &of_seam);
            if (x) forward_real(m, is_cyclic, r, x, p);
        }
    }
    if (!(good[0] & good[1])) return false;
    load_dense(m);
    if (steps > 0) take_from_middle(m, &t);
    if (is_cyclic && steps > 0) take_from_seam(m, &of_seam);
    return factor_dense(m);
}

static bool factor_any(band_matrix *m, const double *x, passed *p)
{
    m->by_rows = m->has_spread = false;
    m->is_factor = m->is_complex ? m->cyclic ? factor(m, true, true, x, p) : factor(m, true, false, x, p)
                   : m->cyclic ? factor(m, false, true, x, p)
                                 : factor(m, false, false, x, p);
    return m->is_factor;
}

bool band_factor(band_matrix *m) { return factor_any(m, NULL, NULL); }

static void solve_dense(const band_matrix *m, const passed *p, double *x, double *energy)
{
    const int samples = dense_samples(m), parts = m->is_complex ? 2 : 1, n = samples * parts, middle = band_middle(m),
              seam = middle * parts;
    double z[BAND_DENSE], y[BAND_DENSE];
    for (int j = 0; j < n; j++) z[j] = x[2 * dense_sample(m, j / parts) + j % parts];
    for (int lane = 0; lane < 2 && band_steps(m) > 0; lane++) {
        const int near = lane ? middle - 1 : 0, far = lane ? middle - 2 : 1;
        for (int part = 0; part < parts; part++) {
            z[dense_at(m, near, part)] -= p->near[part][lane];
            z[dense_at(m, far, part)] -= p->far[part][lane];
        }
    }
    for (int c = 0; m->cyclic && c < 2 * parts; c++) z[seam + c] -= p->corner[c][0] + p->corner[c][1];
    for (int j = 0; j < n; j++) {
        y[j] = m->dense_inverse[j] * z[j];
        *energy += z[j] * y[j];
        for (int i = j + 1; i < n; i++) z[i] -= m->dense[i][j] * y[j];
    }
    for (int j = n - 1; j >= 0; j--) {
        double sum = 0;
        for (int i = j + 1; i < n; i++) sum += m->dense[i][j] * y[i];
        y[j] -= m->dense_inverse[j] * sum;
        x[2 * dense_sample(m, j / parts) + j % parts] = y[j];
    }
}

/// Z of the next two samples and of the seam: the lower triangle.
typedef struct window {
    twin z[8][8];
} window;

ALWAYS_INLINE twin at(const window *w, int i, int j) { return i >= j ? w->z[i][j] : w->z[j][i]; }

/// A⁻¹ of the dense block, for both lanes; its diagonal to `spread`.
static void invert_dense(const band_matrix *m, window *w)
{
    const int samples = dense_samples(m), parts = m->is_complex ? 2 : 1, n = samples * parts, middle = band_middle(m);
    double z[BAND_DENSE][BAND_DENSE] = {{0}};
    for (int j = n - 1; j >= 0; j--) {
        double own = 0;
        for (int i = j + 1; i < n; i++) {
            double sum = 0;
            for (int k = j + 1; k < n; k++) sum -= m->dense_inverse[j] * m->dense[k][j] * z[k][i];
            z[i][j] = sum;
        }
        for (int i = j + 1; i < n; i++) z[j][i] = z[i][j];
        for (int i = j + 1; i < n; i++) own -= m->dense_inverse[j] * m->dense[i][j] * z[i][j];
        z[j][j] = m->dense_inverse[j] + own;
    }
    for (int s = 0; s < samples; s++) { // of the differences only their triangle inequality
        double *to = m->spread + 2 * dense_sample(m, s);
        to[0] = 0, to[1] = -1;
        for (int part = 0; part < parts; part++) to[0] += z[parts * s + part][parts * s + part];
    }
    m->spread[1] = -1;
    if (middle < 2) return;
    const int wide = m->cyclic ? 4 : 2;
    for (int i = 0; i < wide * parts; i++) {
        for (int j = 0; j <= i; j++) {
            const int of_up[4] = {0, 1, middle, middle + 1},
                      of_down[4] = {middle - 1, middle - 2, middle, middle + 1};
            const int a = dense_at(m, of_up[i / parts], i % parts), b = dense_at(m, of_up[j / parts], j % parts);
            const int c = dense_at(m, of_down[i / parts], i % parts), d = dense_at(m, of_down[j / parts], j % parts);
            w->z[i][j] = (twin){z[a][b], z[c][d]};
        }
    }
}

/// Z one sample on. Writes the sum of both parts' A⁻¹ to `d`, and the same of the difference to the next sample to `step`.
ALWAYS_INLINE void widen_complex(const record2 *r, twin (*seam)[4], const bool is_cyclic, window *w, twin *d,
                                 twin *step)
{
    const int n = is_cyclic ? 8 : 4;
    const twin own = r->l;
    twin l[8] = {r->u[0], r->u[1], r->f[0], r->f[1]}, k[8] = {r->v[0], r->v[1], r->g[0], r->g[1]}, s[8] = {{0}},
         t[8] = {{0}};
    for (int c = 0; is_cyclic && c < 4; c++) l[4 + c] = seam[0][c], k[4 + c] = seam[1][c];
    for (int j = 0; j < n; j++) {
        twin a = (k[0] * at(w, 0, j) + k[1] * at(w, 1, j)) + (k[2] * at(w, 2, j) + k[3] * at(w, 3, j));
        twin b = (l[0] * at(w, 0, j) + l[1] * at(w, 1, j)) + (l[2] * at(w, 2, j) + l[3] * at(w, 3, j));
        for (int c = 4; c < n; c++) a += k[c] * at(w, c, j), b += l[c] * at(w, c, j);
        t[j] = -a, s[j] = b; // −Z_Im and, without what Im x adds, −Z_Re
    }
    twin of_k = (k[0] * t[0] + k[1] * t[1]) + (k[2] * t[2] + k[3] * t[3]);
    twin of_both = (l[0] * t[0] + l[1] * t[1]) + (l[2] * t[2] + l[3] * t[3]);
    twin of_l = (l[0] * s[0] + l[1] * s[1]) + (l[2] * s[2] + l[3] * s[3]);
    for (int c = 4; c < n; c++) of_k += k[c] * t[c], of_both += l[c] * t[c], of_l += l[c] * s[c];
    const twin im = r->id - of_k, twice = own * of_both, cross = -(of_both + own * im);
    const twin re = (r->ia + of_l) + ((twice + twice) + (own * own) * im);
    for (int j = 0; j < n; j++) s[j] = -(s[j] + own * t[j]);
    *d = re + im;
    *step = (re - (s[0] + s[0]) + w->z[0][0]) + (im - (t[1] + t[1]) + w->z[1][1]);
    for (int c = 0; is_cyclic && c < 4; c++) {
        w->z[4 + c][2] = w->z[4 + c][0], w->z[4 + c][3] = w->z[4 + c][1];
        w->z[4 + c][0] = s[4 + c], w->z[4 + c][1] = t[4 + c];
    }
    w->z[2][2] = w->z[0][0], w->z[3][2] = w->z[1][0], w->z[3][3] = w->z[1][1];
    w->z[2][0] = s[0], w->z[2][1] = t[0], w->z[3][0] = s[1], w->z[3][1] = t[1];
    w->z[0][0] = re, w->z[1][0] = cross, w->z[1][1] = im;
}

ALWAYS_INLINE void widen_real(const record1 *r, const twin *seam, const bool is_cyclic, window *w, twin *d,
                              twin *step)
{
    const int n = is_cyclic ? 4 : 2;
    twin l[4] = {r->u, r->f}, s[4] = {{0}}, own;
    for (int c = 0; is_cyclic && c < 2; c++) l[2 + c] = seam[c];
    for (int j = 0; j < n; j++) {
        twin a = l[0] * at(w, 0, j) + l[1] * at(w, 1, j);
        for (int c = 2; c < n; c++) a += l[c] * at(w, c, j);
        s[j] = -a;
    }
    own = l[0] * s[0] + l[1] * s[1];
    for (int c = 2; c < n; c++) own += l[c] * s[c];
    *d = r->ia - own;
    *step = *d - (s[0] + s[0]) + w->z[0][0];
    for (int c = 0; is_cyclic && c < 2; c++) w->z[2 + c][1] = w->z[2 + c][0], w->z[2 + c][0] = s[2 + c];
    w->z[1][1] = w->z[0][0], w->z[1][0] = s[0], w->z[0][0] = *d;
}

ALWAYS_INLINE void store_two(double *x, int up, int down, twin re, twin im)
{
    *(twin *)(void *)(x + 2 * up) = (twin){re[0], im[0]};
    *(twin *)(void *)(x + 2 * down) = (twin){re[1], im[1]};
}

/// The step between a sample and the one before is that of the later one.
ALWAYS_INLINE void store_spread(band_matrix *m, int up, int down, twin d, twin step)
{
    m->spread[2 * up] = d[0], m->spread[2 * up + 3] = step[0];
    m->spread[2 * down] = d[1], m->spread[2 * down + 1] = step[1];
}

/// The way back in complex mode; with `spread` finds A⁻¹'s diagonal on it. Returns the energy.
ALWAYS_INLINE double back(band_matrix *m, double *x, const passed *p, const bool is_cyclic, const bool spread)
{
    const int n = band_interior(m), steps = band_steps(m);
    const record2 *record = (const record2 *)(const void *)m->record;
    twin(*seam)[4] = (twin(*)[4])(void *)m->seam;
    double energy = p->energy[0] + p->energy[1];
    solve_dense(m, p, x, &energy);
    window w;
    if (spread) invert_dense(m, &w);
    const int first = steps, last = n - 1 - steps;
    twin next[2] = {{0}}, after[2] = {{0}}, on_seam[4] = {{0}};
    if (steps > 0) {
        next[0] = load_two(x, first, last), next[1] = load_two(x + 1, first, last);
        after[0] = load_two(x, first + 1, last - 1), after[1] = load_two(x + 1, first + 1, last - 1);
    }
    for (int c = 0; is_cyclic && c < 4; c++) on_seam[c] = both(x[2 * n + c]);
    for (int r = steps - 1; r >= 0; r--) {
        const record2 *s = record + r;
        twin(*columns)[4] = seam + 2 * r;
        twin im = (s->g[0] * after[0] + s->g[1] * after[1]) + (s->v[0] * next[0] + s->v[1] * next[1]);
        twin re = (s->f[0] * after[0] + s->f[1] * after[1]) + (s->u[0] * next[0] + s->u[1] * next[1]);
        for (int c = 0; is_cyclic && c < 4; c++) re += columns[0][c] * on_seam[c], im += columns[1][c] * on_seam[c];
        after[0] = next[0], after[1] = next[1];
        next[1] = s->y[1] - im;
        next[0] = (s->y[0] - re) - s->l * next[1];
        store_two(x, r, n - 1 - r, next[0], next[1]);
        if (spread) {
            twin d, step;
            widen_complex(s, columns, is_cyclic, &w, &d, &step);
            store_spread(m, r, n - 1 - r, d, step);
        }
    }
    return energy;
}

/// The same outside complex mode.
ALWAYS_INLINE double back_real(band_matrix *m, double *x, const passed *p, const bool is_cyclic, const bool spread)
{
    const int n = band_interior(m), steps = band_steps(m);
    const record1 *record = (const record1 *)(const void *)m->record;
    twin(*seam)[2] = (twin(*)[2])(void *)m->seam;
    double energy = p->energy[0] + p->energy[1];
    solve_dense(m, p, x, &energy);
    window w;
    if (spread) invert_dense(m, &w);
    twin next = {0}, after = {0}, on_seam[2] = {{0}};
    if (steps > 0) next = load_two(x, steps, n - 1 - steps), after = load_two(x, steps + 1, n - 2 - steps);
    for (int c = 0; is_cyclic && c < 2; c++) on_seam[c] = both(x[2 * (n + c)]);
    for (int r = steps - 1; r >= 0; r--) {
        const record1 *s = record + r;
        twin sum = s->f * after + s->u * next;
        for (int c = 0; is_cyclic && c < 2; c++) sum += seam[r][c] * on_seam[c];
        after = next;
        next = s->y - sum;
        x[2 * r] = next[0], x[2 * (n - 1 - r)] = next[1];
        if (spread) {
            twin d, step;
            widen_real(s, seam[r], is_cyclic, &w, &d, &step);
            store_spread(m, r, n - 1 - r, d, step);
        }
    }
    return energy;
}

/// Checks what was found of A⁻¹, and sums ρ. The backward error of a factor of squares is that of its diagonal, and of a factor of rows that of
/// each column, its root.
static void sum_spread(band_matrix *m)
{
    const double unit = 64 * DBL_EPSILON; // what a difference may have lost
    const double usual = m->alike.d[2] > m->alike.d[0] ? m->alike.d[2] : m->alike.d[0];
    double largest = 0, sum = 0, *s = m->spread;
    double before = m->cyclic ? s[2 * (m->count - 1)] : 0;
    for (int k = 0; k < m->count; k++) {
        double a = usual;
        if (m->marks[k] & BAND_OWN || m->stiffness) {
            const band_block block = band_block_at(m, k);
            a = m->is_complex && block.d[2] > block.d[0] ? block.d[2] : block.d[0];
        } else if (!m->is_alike) {
            a = m->d[k] + (m->im_weight ? m->im_weight[k] : 0);
        }
        const double here = s[2 * k] <= 0 ? 0 : s[2 * k];
        const double step = s[2 * k + 1] + unit * (here + before), apart = 2 * (here + before);
        largest = here <= largest ? largest : here;
        sum += m->by_rows ? sqrt(2 * here * a) : here * a;
        s[2 * k] = here;
        s[2 * k + 1] = s[2 * k + 1] >= 0 && step < apart ? step : apart;
        before = here;
    }
    m->largest = sqrt(largest);
    m->rounding = of_squares * sum;
    m->has_spread = true;
}

static double back_any(band_matrix *m, double *x, const passed *p, bool spread)
{
    double energy;
    if (m->is_complex) {
        energy = m->cyclic ? spread ? back(m, x, p, true, true) : back(m, x, p, true, false)
                 : spread ? back(m, x, p, false, true)
                           : back(m, x, p, false, false);
    } else {
        energy = m->cyclic ? spread ? back_real(m, x, p, true, true) : back_real(m, x, p, true, false)
                 : spread ? back_real(m, x, p, false, true)
                           : back_real(m, x, p, false, false);
    }
    if (spread) sum_spread(m);
    return energy;
}

/// Only its way forward.
ALWAYS_INLINE void forward_all(band_matrix *m, const bool is_complex, const bool is_cyclic, const double *x,
                               passed *p)
{
    for (int r = 0; r < band_steps(m); r++) (is_complex ? forward : forward_real)(m, is_cyclic, r, x, p);
}

double band_solve(band_matrix *m, double *x, bool spread)
{
    passed p = {.near = {{0}}};
    if (m->is_complex && m->cyclic) {
        forward_all(m, true, true, x, &p);
    } else if (m->is_complex) {
        forward_all(m, true, false, x, &p);
    } else if (m->cyclic) {
        forward_all(m, false, true, x, &p);
    } else {
        forward_all(m, false, false, x, &p);
    }
    return back_any(m, x, &p, spread);
}

bool band_factor_solve(band_matrix *m, double *x)
{
    passed p = {.near = {{0}}};
    if (!factor_any(m, x, &p)) return false;
    back_any(m, x, &p, true);
    return true;
}

// --- a factor of the rows themselves, for ill-conditioned systems: Givens rotations
//
// A row touches at most three neighbouring samples, so U of Q U = R is as narrow as the band:
//
//     | U00 U01 U02             |   Row by row: a rotation takes a row's first entry into the row of U that begins there, until
//     |     U11 U12 U13         |   none begins where the rest of it does. In hand are the rows of U that begin at x_k, x_{k+1},
//     |         U22 U23 U24     |   x_{k+2}. Once all rows that begin at x_k are in, U_k* is done.
//     |             U33 U34 U35 |
//
// As the band, from both ends: rows that touch none of the samples between are taken there. In a loop the last two samples, the seam, have
// their own columns at the right and stay to the end. A rotation involves only two rows, so a stiff slope row does not drown the soft ones.
// As Uᵀ U = L D Lᵀ, the pivots are U_kk² and what couples them U_kk U_kj.

/// A row U of a triangular factor with pivot u[0]: of a sample's part, coupled to its other part, the next two samples, and the seam.
static void put_row(band_matrix *m, int step, int lane, int part, const double *u, const double *seam)
{
    const bool known = m->marks[lane ? band_interior(m) - 1 - step : step] & (part ? FIXED_IM : FIXED_RE);
    const double scale = known ? 0 : 1 / u[0], inverse = scale * scale; // what is known pulls by the gradient alone
    if (!m->is_complex) {
        record1 *r = (record1 *)(void *)m->record + step;
        twin *to = (twin *)(void *)m->seam + 2 * step;
        r->ia[lane] = inverse, r->u[lane] = scale * u[2], r->f[lane] = scale * u[4];
        for (int c = 0; m->cyclic && c < 2; c++) to[c][lane] = scale * seam[2 * c];
        return;
    }
    record2 *r = (record2 *)(void *)m->record + step;
    twin *const near = part ? r->v : r->u, *const far = part ? r->g : r->f;
    twin *to = (twin *)(void *)m->seam + 8 * step + 4 * part;
    if (part) {
        r->id[lane] = inverse;
    } else {
        r->ia[lane] = inverse, r->l[lane] = scale * u[1];
    }
    for (int i = 0; i < 2; i++) near[i][lane] = scale * u[2 - part + i], far[i][lane] = scale * u[4 - part + i];
    for (int c = 0; m->cyclic && c < 4; c++) to[c][lane] = scale * seam[c];
}

enum { COLUMNS = BAND_DENSE, SEAM = 6 };

/// Lanes, and the dense block after them.
enum { UP, DOWN, BETWEEN };

typedef struct walk {
    const system_rows *rows;
    int interior, steps; ///< samples before the seam; those that each lane eliminates
    int lane, k;         ///< the lane, and the sample that it eliminates
    double u[COLUMNS]
            [COLUMNS]; ///< of the sample and the two behind it and, from SEAM on, the seam: re and im of each
} walk;

/// Sets a row's coefficient; fixed unknowns have none.
static void put(const walk *w, double *row, int sample, int part, double value)
{
    const int begin = w->lane == BETWEEN ? w->steps : w->k, away = w->lane == DOWN ? begin - sample : sample - begin;
    const int column = sample >= w->interior ? SEAM + 2 * (sample - w->interior) : 2 * away;
    if (!(w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE))) row[column + part] += value;
}

/// Rotates a row into U; its content is lost.
static void take_row(walk *w, double *row)
{
    for (int c = 0; c < COLUMNS; c++) {
        double *u = w->u[c];
        if (row[c] == 0) continue;
        if (u[c] == 0) {
            memcpy(u, row, sizeof w->u[c]);
            return;
        }
        const double size = sqrt(u[c] * u[c] + row[c] * row[c]), cosine = u[c] / size, sine = row[c] / size;
        for (int j = c; j < COLUMNS; j++) {
            const double above = u[j];
            u[j] = cosine * above + sine * row[j];
            row[j] = cosine * row[j] - sine * above;
        }
        row[c] = 0;
    }
}

/// Whether a row on these samples is taken now: where it begins.
static bool begins_here(const walk *w, const int samples[3])
{
    int least = w->interior, most = -1;
    for (int i = 0; i < 3; i++) {
        if (samples[i] < 0 || samples[i] >= w->interior) continue;
        least = samples[i] < least ? samples[i] : least;
        most = samples[i] > most ? samples[i] : most;
    }
    if (least < w->steps) return w->lane == UP && least == w->k;
    if (most >= w->interior - w->steps) return w->lane == DOWN && most == w->k;
    return w->lane == BETWEEN;
}

/// Adds a complex row of coefficients on up to three samples, as two real ones, or one outside complex mode or if it is `real`: Re(c x).
static void add_row(walk *w, double weight, bool real, const stencil *s)
{
    if (!(weight > 0) || !begins_here(w, s->at)) return;
    const double root = sqrt(weight);
    double re[COLUMNS] = {0}, im[COLUMNS] = {0};
    for (int i = 0; i < 3; i++) {
        if (s->at[i] < 0) continue;
        put(w, re, s->at[i], 0, root * s->c[i].re);
        put(w, re, s->at[i], 1, -root * s->c[i].im);
        put(w, im, s->at[i], 0, root * s->c[i].im);
        put(w, im, s->at[i], 1, root * s->c[i].re);
    }
    take_row(w, re);
    if (w->rows->is_complex && !real) take_row(w, im);
}

/// A row on one sample.
static stencil row_on(int sample, cplx c) { return (stencil){.at = {-1, sample, -1}, .c = {[1] = c}}; }

/// Adds the slopes on a sample.
static void add_slopes(walk *w, int sample)
{
    const system_rows *rows = w->rows;
    int from = 0, to = rows->slope_count;
    while (from < to) {
        const int middle = (from + to) / 2;
        if (rows->slopes[middle].sample < sample) {
            from = middle + 1;
        } else {
            to = middle;
        }
    }
    for (; from < rows->slope_count && rows->slopes[from].sample == sample; from++) {
        stencil s = system_slope_stencil(rows, &rows->slopes[from]);
        for (int i = 0; i < 3; i++) {
            if (s.c[i].re == 0 && s.c[i].im == 0) s.at[i] = -1;
        }
        add_row(w, rows->slopes[from].weight, true, &s);
    }
}

/// Adds the rows of a sample that begin here.
static void add_rows(walk *w, int sample)
{
    const system_rows *rows = w->rows;
    const jet_row jet = system_jet(rows, sample);
    const int before = system_beside(rows, sample, -1), after = system_beside(rows, sample, 1);
    if (rows->fixed[sample] & FIXED_STILL) { // two jets
        const stencil back = row_on(before, jet.before), ahead = row_on(after, (cplx){1, 0});
        add_row(w, jet.weight, false, &back);
        add_row(w, jet.weight, false, &ahead);
    } else {
        const stencil s = {.at = {before, sample, after}, .c = {jet.before, jet.own, {1, 0}}};
        add_row(w, jet.weight, false, &s);
    }
    add_slopes(w, sample);
    const stencil im = row_on(sample, (cplx){0, -1});
    if (rows->is_complex) add_row(w, rows->is_constant ? rows->own_im : rows->im_weight[sample], true, &im);
    for (int i = 0; sample == 0 && i < 2; i++) {
        const struct start_row *row = &rows->start.row[i];
        const stencil s = {.at = {-1, 0, rows->count > 1 ? 1 : -1},
                           .c = {{0, 0}, system_start_on_x(rows, row), row->on_e}};
        add_row(w, row->weight, false, &s);
    }
}

/// The pivot of an unknown; that of a fixed one is 1. False: there is none.
static bool close_row(walk *w, int sample, int column, int part)
{
    double *pivot = &w->u[column][column];
    if (w->rows->fixed[sample] & (part ? FIXED_IM : FIXED_RE)) *pivot = 1;
    return fabs(*pivot) > 0 && fabs(*pivot) < INFINITY;
}

/// Hands over the rows of a sample, and goes on to the next one.
static bool finish_step(walk *w, int step, band_matrix *m)
{
    double(*u)[COLUMNS] = w->u;
    for (int part = 0; part < 2; part++) {
        if (!close_row(w, w->k, part, part)) return false;
        if (part == 0 || m->is_complex) put_row(m, step, w->lane, part, u[part] + part, u[part] + SEAM);
    }
    for (int r = 0; r < SEAM; r++) {
        const bool is_new = r + 2 >= SEAM;
        for (int c = 0; c < COLUMNS; c++) {
            const int from = c < SEAM ? c + 2 : c;
            u[r][c] = is_new || (c < SEAM && from >= SEAM) ? 0 : u[r + 2][from];
        }
    }
    return true;
}

/// What is between the lanes, in the order of the band's dense block.
static bool finish_between(walk *w, band_matrix *m)
{
    const int parts = m->is_complex ? 2 : 1, middle = band_middle(m), samples = middle + (m->cyclic ? 2 : 0);
    int column[BAND_DENSE] = {0};
    for (int s = 0; s < samples; s++) {
        for (int part = 0; part < parts; part++) {
            const int at = s < middle ? 2 * s : SEAM + 2 * (s - middle);
            column[parts * s + part] = at + part;
            if (!close_row(w, s < middle ? w->steps + s : w->interior + s - middle, at + part, part)) return false;
        }
    }
    for (int j = 0; j < samples * parts; j++) {
        const double *u = w->u[column[j]], pivot = u[column[j]];
        const bool fixed = m->marks[dense_sample(m, j / parts)] & (j % parts ? FIXED_IM : FIXED_RE);
        m->dense_inverse[j] = fixed ? 0 : 1 / (pivot * pivot);
        for (int i = j + 1; i < samples * parts; i++) m->dense[i][j] = pivot * u[column[i]];
    }
    m->is_factor = m->by_rows = true;
    m->has_spread = false;
    return true;
}

bool orthogonal_factor(const system_rows *rows, band_matrix *m)
{
    walk between = {.rows = rows, .interior = band_interior(m), .steps = band_steps(m), .lane = BETWEEN};
    m->is_factor = false;
    for (int lane = UP; lane <= DOWN && between.steps > 0; lane++) {
        walk w = {.rows = rows, .interior = between.interior, .steps = between.steps, .lane = lane};
        for (int step = 0; step < w.steps; step++) {
            w.k = lane == UP ? step : w.interior - 1 - step;
            for (int by = -1; by <= 1; by++) { // those that begin here lie on it, or beside it
                const int at = system_beside(rows, w.k, by);
                if (at >= 0) add_rows(&w, at);
            }
            if (!finish_step(&w, step, m)) return false;
        }
        const int last = w.interior - 2 * w.steps - 1; // the rows that the lane has left go into the dense block
        for (int r = 0; r < COLUMNS; r++) {
            double row[COLUMNS] = {0};
            for (int c = 0; c < 4; c++) row[lane == DOWN ? 2 * (last - c / 2) + c % 2 : c] = w.u[r][c];
            memcpy(row + SEAM, w.u[r] + SEAM, (COLUMNS - SEAM) * sizeof *row);
            take_row(&between, row);
        }
    }
    for (int sample = 0; sample < rows->count; sample++) add_rows(&between, sample);
    return finish_between(&between, m);
}
