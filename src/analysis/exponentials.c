/// Forward selection of poles, on G = S Sᵀ alone.
#include "analysis/poles.h"
#include "base/need.h"
#include <math.h>
#include <stdlib.h>

enum { MIDDLE = 1 }; ///< sequences at the start of the basis that no pole has

static const double steady = 0.05;        ///< how far a steady pole may wander
static const double wanderer_gain = 0.01; ///< share of the motion's power that a wandering pole must explain
static const double cancelling = 4;       ///< times the motion's power: a larger part only cancels another

void exponentials_fill(double complex z, int frames, double *rows)
{
    double complex s = clog(z);
    int largest = creal(s) > 0 ? frames - 1 : 0;
    for (int t = 0; t < frames; t++) {
        double complex value = cexp(s * (t - largest));
        rows[t] = creal(value);
        rows[frames + t] = -cimag(value);
    }
}

static void append(struct basis *basis, double complex z, double *room)
{
    exponentials_fill(z, basis->frames, room);
    basis_append(basis, room);
    basis_append(basis, room + basis->frames);
}

/// The largest power of one pole's part on its own, Σ (Bᵀ W S)² over its two sequences: tr(B Bᵀ W G Wᵀ) with
/// B Bᵀ = L Lᵀ. The first sequence is no pole's. `weights` has room for all of W.
static double largest_part(const struct basis *basis, const double *gram, double *weights)
{
    size_t n = (size_t)basis->frames;
    double largest = 0;
    basis_weights(basis, weights);
    for (int k = MIDDLE; k < basis->count; k += 2) {
        double part = 0;
        for (int i = 0; i < 4; i++) {
            const double *a = weights + (size_t)(k + i / 2) * n, *b = weights + (size_t)(k + i % 2) * n;
            double power = 0, product = 0;
            for (size_t t = 0; t < n; t++) power += a[t] * basis_dot(gram + t * n, b, basis->frames);
            for (int j = 0; j < basis->capacity; j++)
                product +=
                    basis->lower[(k + i / 2) * basis->capacity + j] * basis->lower[(k + i % 2) * basis->capacity + j];
            part += power * product;
        }
        largest = fmax(largest, part);
    }
    return largest;
}

/// Finds the pole in poles[first …] that explains most beside those of the basis; returns its gain.
static int find_best(const struct pole *poles, int first, int count, const double *gram, struct basis *basis,
                     double *room, double *gain)
{
    int best = first;
    *gain = -1;
    for (int k = first; k < count; k++) {
        append(basis, poles[k].z, room);
        double more = basis_gain(basis, 2, gram);
        basis->count -= 2;
        if (more > *gain) {
            best = k;
            *gain = more;
        }
    }
    return best;
}

/// Appends the best of poles[chosen … count) while it explains `least` of the power or fewer than `needed` are chosen. Returns the
/// new number of chosen poles.
static int choose_among(struct pole *poles, int chosen, int count, int needed, int most, double least,
                        const double *gram, double power, struct basis *basis, double *room)
{
    while (chosen < count && chosen < most) {
        double gain;
        int best = find_best(poles, chosen, count, gram, basis, room, &gain);
        struct pole pole = poles[best];
        if (chosen >= needed && gain < least * power) break;
        append(basis, pole.z, room);
        if (chosen > 0 && largest_part(basis, gram, room) > cancelling * power) {
            basis->count -= 2;
            poles[best] = poles[--count];
            continue;
        }
        poles[best] = poles[chosen];
        poles[chosen++] = pole;
    }
    return chosen;
}

static int choose(struct pole *poles, int count, int most, double least, const double *gram, struct basis *basis,
                  double *room)
{
    size_t n = (size_t)basis->frames;
    double power = -basis_gain(basis, MIDDLE, gram);
    int steady_count = 0;
    for (size_t t = 0; t < n; t++) power += gram[t * n + t];
    while (steady_count < count && poles[steady_count].wander < steady) steady_count++;
    int chosen = choose_among(poles, 0, steady_count, 0, most, least, gram, power, basis, room);
    for (int k = chosen; k + steady_count - chosen < count; k++) poles[k] = poles[k + steady_count - chosen];
    return choose_among(poles, chosen, count - steady_count + chosen, 1, most, wanderer_gain, gram, power, basis,
                        room);
}

int exponentials_choose(struct pole *poles, int count, int most, double least, const double *gram,
                        struct basis *basis)
{
    double *room = need((size_t)basis->capacity * (size_t)basis->frames, sizeof *room);
    int chosen = choose(poles, count, most, least, gram, basis, room);
    free(room);
    return chosen;
}
