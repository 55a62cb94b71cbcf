/// Forces and stiffness of one tetrahedron, from stress and stiffness in principal stretches.
#include "simulation/element.h"
#include <string.h>

/// The pairs of principal axes.
static const int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};

struct material material_from(double young, double poisson)
{
    return (struct material){.mu = young / (2 * (1 + poisson)),
                             .lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// L(σ). log1p keeps all digits of σ − 1 near rest.
static double logarithm(double sigma)
{
    return sigma >= MATERIAL_CLAMP ? log1p(sigma - 1) : log(MATERIAL_CLAMP) + sigma / MATERIAL_CLAMP - 1;
}

/// L'(σ)
static double slope(double sigma) { return 1 / fmax(sigma, MATERIAL_CLAMP); }

/// L''(σ)
static double curvature(double sigma) { return sigma >= MATERIAL_CLAMP ? -1 / (sigma * sigma) : 0; }

static double log_volume(const double sigma[3])
{
    return logarithm(sigma[0]) + logarithm(sigma[1]) + logarithm(sigma[2]);
}

double material_energy(const struct material *material, const double sigma[3])
{
    double shear = 0, volume = log_volume(sigma);
    for (int i = 0; i < 3; i++) { // ½(σ² − 1) − L(σ) with σ = 1 + e: less cancellation near rest
        double e = sigma[i] - 1;
        shear += e + 0.5 * e * e - logarithm(sigma[i]);
    }
    return material->mu * shear + 0.5 * material->lambda * volume * volume;
}

void material_stress(const struct material *material, const double sigma[3], double stress[3])
{
    double pressure = material->lambda * log_volume(sigma) - material->mu;
    for (int i = 0; i < 3; i++) stress[i] = material->mu * sigma[i] + pressure * slope(sigma[i]);
}

/// Sets negative eigenvalues to zero.
static void project(double a[3][3])
{
    double minor = a[0][0] * a[1][1] - a[0][1] * a[0][1];
    double determinant =
        a[2][2] * minor - a[0][0] * a[1][2] * a[1][2] - a[1][1] * a[0][2] * a[0][2] + 2 * a[0][1] * a[0][2] * a[1][2];
    if (a[0][0] > 0 && minor > 0 && determinant > 0) return; // Sylvester: already definite
    double vectors[9], values[3];
    eigen_symmetric(3, &a[0][0], values, vectors);
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            a[i][j] = 0;
            for (int k = 0; k < 3; k++) a[i][j] += fmax(values[k], 0) * vectors[3 * k + i] * vectors[3 * k + j];
        }
    }
}

void material_stiffness(const struct material *material, const double sigma[3], struct principal_stiffness *stiffness)
{
    double stress[3], pressure = material->lambda * log_volume(sigma) - material->mu;
    material_stress(material, sigma, stress);
    double(*stretch)[3] = stiffness->stretch;
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) stretch[i][j] = material->lambda * slope(sigma[i]) * slope(sigma[j]);
        stretch[i][i] += material->mu + pressure * curvature(sigma[i]);
    }
    for (int k = 0; k < 3; k++) {
        int i = pairs[k][0], j = pairs[k][1];
        double difference = sigma[i] - sigma[j], sum = sigma[i] + sigma[j]; // both ≥ 0 in this order
        // Two eigenvalues: (Pᵢ − Pⱼ)/(σᵢ − σⱼ) of the symmetric shear, (Pᵢ + Pⱼ)/(σᵢ + σⱼ) of the rotation.
        double shear = difference > 1e-6 ? (stress[i] - stress[j]) / difference
                                         : 0.5 * (stretch[i][i] + stretch[j][j]) - stretch[i][j];
        double turn = (stress[i] + stress[j]) / fmax(sum, 1e-6);
        shear = fmax(shear, 0);
        turn = fmax(turn, 0);
        stiffness->straight[k] = 0.5 * (shear + turn);
        stiffness->across[k] = 0.5 * (shear - turn);
    }
    project(stretch);
}

bool element_init(struct element *element, const int node[4], const double (*rest)[3], double fraction)
{
    memcpy(element->node, node, sizeof element->node);
    double edge[3][3];
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) edge[k][i] = rest[node[k + 1]][i] - rest[node[0]][i];
    }
    double(*b)[3] = element->gradient;
    for (int k = 0; k < 3; k++) vec3_cross(edge[(k + 1) % 3], edge[(k + 2) % 3], b[k + 1]);
    double six_volumes = vec3_dot(edge[0], b[1]);
    double size = vec3_length(edge[0]) * vec3_length(edge[1]) * vec3_length(edge[2]);
    if (!(fabs(six_volumes) > 1e-12 * size)) return false;
    for (int i = 0; i < 3; i++) {
        for (int k = 1; k < 4; k++) b[k][i] /= six_volumes;
        b[0][i] = -(b[1][i] + b[2][i] + b[3][i]);
    }
    element->volume = fraction * fabs(six_volumes) / 6;
    element->stiffness = 1;
    return true;
}

void element_decompose(const struct element *element, const double (*x)[3], struct svd *svd)
{
    double f[3][3] = {{0}};
    for (int a = 0; a < 4; a++) {
        for (int i = 0; i < 3; i++) {
            for (int j = 0; j < 3; j++) f[i][j] += x[element->node[a]][i] * element->gradient[a][j];
        }
    }
    svd3(f, svd);
}

/// Vᵀ b_a: the gradients in the principal axes of the material.
static void principal_gradients(const struct element *element, const struct svd *svd, double g[4][3])
{
    for (int a = 0; a < 4; a++) {
        for (int k = 0; k < 3; k++) {
            g[a][k] = svd->v[0][k] * element->gradient[a][0] + svd->v[1][k] * element->gradient[a][1] +
                      svd->v[2][k] * element->gradient[a][2];
        }
    }
}

double element_force(const struct element *element, const struct material *material, const struct svd *svd,
                     double (*force)[3])
{
    double g[4][3], stress[3];
    principal_gradients(element, svd, g);
    material_stress(material, svd->sigma, stress);
    for (int a = 0; a < 4; a++) {
        double *f = force[element->node[a]];
        for (int i = 0; i < 3; i++) {
            double pb = 0;
            for (int k = 0; k < 3; k++) pb += svd->u[i][k] * stress[k] * g[a][k];
            f[i] -= element->volume * element->stiffness * pb;
        }
    }
    return element->volume * element->stiffness * material_energy(material, svd->sigma);
}

/// Entry (i, k) is Σ_jl (∂P_ij/∂F_kl) p_j q_l in principal axes; all other entries of ∂P/∂F are zero.
static void contract(const struct principal_stiffness *c, const double p[3], const double q[3], double out[3][3])
{
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) out[i][k] = c->stretch[i][k] * p[i] * q[k];
    }
    for (int n = 0; n < 3; n++) {
        int i = pairs[n][0], j = pairs[n][1];
        out[i][i] += c->straight[n] * p[j] * q[j];
        out[j][j] += c->straight[n] * p[i] * q[i];
        out[i][j] += c->across[n] * p[j] * q[i];
        out[j][i] += c->across[n] * p[i] * q[j];
    }
}

/// out = factor · U m Uᵀ
static void turn_back(const double u[3][3], const double m[3][3], double factor, double out[9])
{
    double mu[3][3];
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) {
            mu[i][k] = factor * (m[i][0] * u[k][0] + m[i][1] * u[k][1] + m[i][2] * u[k][2]);
        }
    }
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++) out[3 * i + k] = u[i][0] * mu[0][k] + u[i][1] * mu[1][k] + u[i][2] * mu[2][k];
    }
}

void element_stiffness(const struct element *element, const struct material *material, const struct svd *svd,
                       double block[4][4][9])
{
    struct principal_stiffness stiffness = {0};
    double g[4][3], principal[3][3];
    material_stiffness(material, svd->sigma, &stiffness);
    principal_gradients(element, svd, g);
    for (int a = 0; a < 4; a++) {
        for (int b = a; b < 4; b++) {
            contract(&stiffness, g[a], g[b], principal);
            turn_back(svd->u, principal, element->volume * element->stiffness, block[a][b]);
            for (int i = 0; b > a && i < 9; i++) block[b][a][i] = block[a][b][3 * (i % 3) + i / 3];
        }
    }
}
