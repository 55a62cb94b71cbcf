/// With C = Σ c cᵀ of the pulls at the pose of a round, r what a point can be from its base, and v its way, first cut to r/2:
///
///     v ← C (C + 4 |c⁰|² (|v|/r)^{3/2})⁻¹ v             a far way takes no step that would curl the rig up; a near one is taken whole
///     rows ← L⁻¹ rows,  L Lᵀ = C + 0.3 |c⁰|²             a curled rig does not count as easily moved in all directions alike
///
/// where |c⁰| is of the motion without pins. The place itself is taken no farther from the base than r.
#include "scene/storage.h"
#include <math.h>

static const double STEP = 0.5;     ///< of the reach
static const double DAMPING = 4;    ///< least at which drags far out of reach (tests/test_pins_drag.c) do not jump
static const double FIRMNESS = 0.3; ///< with less, they curl tails up; with more, less of what can be reached is

static double dot(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

double pin_ease(const wiggly_pin *pin)
{
    double sum = 0;
    for (int i = 0; i < pin->pull_count; i++) {
        for (int k = 0; k < 3; k++) {
            const double *c = pin->pulls[i].c[k];
            sum += c[0] * c[0] + c[1] * c[1];
        }
    }
    return sqrt(sum);
}

/// L of L Lᵀ = C + least.
static void factor(const wiggly_pull *pulls, int count, double least, double l[3][3])
{
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k <= j; k++) {
            l[j][k] = j == k ? least : 0;
            for (int i = 0; i < count; i++)
                l[j][k] += pulls[i].c[j][0] * pulls[i].c[k][0] + pulls[i].c[j][1] * pulls[i].c[k][1];
            for (int m = 0; m < k; m++) l[j][k] -= l[j][m] * l[k][m];
            l[j][k] = j == k ? sqrt(l[j][j]) : l[j][k] / l[k][k];
        }
    }
}

/// v ← L⁻¹ v
static void forward(const double l[3][3], double v[3])
{
    for (int j = 0; j < 3; j++) {
        for (int k = 0; k < j; k++) v[j] -= l[j][k] * v[k];
        v[j] /= l[j][j];
    }
}

/// v ← L⁻ᵀ v
static void backward(const double l[3][3], double v[3])
{
    for (int j = 2; j >= 0; j--) {
        for (int k = j + 1; k < 3; k++) v[j] -= l[k][j] * v[k];
        v[j] /= l[j][j];
    }
}

/// The way to a place, or to as far there as the point can be from its base; returns its length.
static double find_way(const struct pin_point *from, const double to[3], double way[3])
{
    double out[3];
    for (int k = 0; k < 3; k++) out[k] = to[k] - from->base[k];
    const double far = sqrt(dot(out, out));
    for (int k = 0; k < 3; k++)
        way[k] = (far > from->reach ? from->base[k] + out[k] * (from->reach / far) : to[k]) - from->at[k];
    return sqrt(dot(way, way));
}

/// Takes off a way what would ask much of x.
static void damp(const wiggly_pull *pulls, int count, double damping, double way[3])
{
    double l[3][3], left[3] = {way[0], way[1], way[2]};
    if (!(damping > 0)) return;
    factor(pulls, count, damping, l);
    forward(l, left);
    backward(l, left);
    for (int k = 0; k < 3; k++) way[k] -= damping * left[k];
}

static void weigh(wiggly_pin *pin, wiggly_pull *pulls, double least)
{
    double l[3][3];
    factor(pulls, pin->pull_count, least, l);
    forward(l, pin->to);
    for (int i = 0; i < pin->pull_count; i++) {
        for (int part = 0; part < 2; part++) {
            double c[3] = {pulls[i].c[0][part], pulls[i].c[1][part], pulls[i].c[2][part]};
            forward(l, c);
            for (int k = 0; k < 3; k++) pulls[i].c[k][part] = c[k];
        }
    }
}

void pin_aim(const struct pin_point *from, double ease, const double to[3], const double passed[3], wiggly_pin *pin,
             wiggly_pull *pulls)
{
    const bool is_bent = !from->is_linear && ease > 0 && from->reach > 0;
    double way[3] = {to[0] - from->at[0], to[1] - from->at[1], to[2] - from->at[2]};
    if (is_bent) {
        const double far = find_way(from, to, way), part = fmin(1, STEP * from->reach / far);
        const double share = part * far / from->reach;
        for (int k = 0; k < 3; k++) way[k] *= part;
        damp(pulls, pin->pull_count, DAMPING * ease * ease * share * sqrt(share), way);
    }
    for (int k = 0; k < 3; k++) pin->to[k] = passed[k] + way[k];
    if (is_bent) weigh(pin, pulls, FIRMNESS * ease * ease);
}
