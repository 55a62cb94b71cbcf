/// Sums the loads.
#include "simulation/loads.h"

/// How much higher the floor is, seen from the base.
static double floor_rise(const struct loads *loads, double time)
{
    return loads->drive ? -drive_place(loads->drive, time) * loads->drive->direction[1] : 0;
}

double loads_forces(const struct loads *loads, const struct body *body, double time, const double (*x)[3],
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

void loads_aim(const struct loads *loads, double time, double step, double rate, const double (*q)[3])
{
    if (!loads->floor) return;
    const double risen = floor_rise(loads, time);
    floor_aim(loads->floor, rate, q, risen, (risen - floor_rise(loads, time - step)) / step);
}
