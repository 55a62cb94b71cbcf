/// Sums the loads.
#include "simulation/loads.h"

double loads_forces(const struct loads *loads, const struct body *body, double time, const double (*x)[3],
                    double (*force)[3])
{
    double pull[3] = {0, -loads->gravity, 0}, energy = 0, risen = 0;
    if (loads->drive) {
        double acceleration = drive_acceleration(loads->drive, time);
        for (int c = 0; c < 3; c++) pull[c] -= acceleration * loads->drive->direction[c];
        risen = -drive_place(loads->drive, time) * loads->drive->direction[1];
    }
    for (int i = 0; i < body->node_count; i++) {
        for (int c = 0; c < 3; c++) {
            force[i][c] += body->mass[i] * pull[c];
            energy -= body->mass[i] * pull[c] * (x[i][c] - body->rest[i][c]);
        }
    }
    if (loads->floor) energy += floor_push(loads->floor, risen, x, force);
    return energy;
}
