/// Stress and stiffness in principal stretches.
#include "simulation/material.h"
#include "simulation/linear.h"
#include <math.h>
#include <stdbool.h>

struct material material_from(double young, double poisson)
{
    return (struct material){.mu = young / (2 * (1 + poisson)),
                             .lambda = young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// L(σ); near rest with all digits of σ − 1.
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
    for (int i = 0; i < 3; i++) { // ½(σ² − 1) − L(σ) with σ = 1 + e, which cancels less near rest
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

/// Eigenvalues below zero become zero.
static void project(double a[3][3])
{
    double minor = a[0][0] * a[1][1] - a[0][1] * a[0][1];
    double determinant =
        a[2][2] * minor - a[0][0] * a[1][2] * a[1][2] - a[1][1] * a[0][2] * a[0][2] + 2 * a[0][1] * a[0][2] * a[1][2];
    if (a[0][0] > 0 && minor > 0 && determinant > 0) return; // Sylvester: it is definite as it stands
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
    static const int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
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
        // Two eigenvalues: of the symmetric shear, (Pᵢ − Pⱼ)/(σᵢ − σⱼ), and of the turn, (Pᵢ + Pⱼ)/(σᵢ + σⱼ).
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
