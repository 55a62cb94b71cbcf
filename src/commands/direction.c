/// Reads up, side, front or a vector from the command line.
#include "commands/direction.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

bool direction_read(const char *text, double direction[3])
{
    static const struct {
        const char *name;
        double direction[3];
    } known[] = {{"up", {0, 1, 0}}, {"side", {1, 0, 0}}, {"front", {0, 0, 1}}};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcmp(text, known[i].name) != 0) continue;
        memcpy(direction, known[i].direction, sizeof known[i].direction);
        return true;
    }
    int end = 0;
    if (sscanf(text, "%lf,%lf,%lf%n", &direction[0], &direction[1], &direction[2], &end) != 3 || text[end])
        return false;
    double length = sqrt(direction[0] * direction[0] + direction[1] * direction[1] + direction[2] * direction[2]);
    if (!isfinite(length) || !(length > 0)) return false;
    for (int c = 0; c < 3; c++) direction[c] /= length;
    return true;
}
