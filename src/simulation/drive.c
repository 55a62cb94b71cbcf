/// The base's displacement over time.
#include "simulation/drive.h"
#include "base/file.h"
#include "base/need.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 26, BURST_PERIODS = 3, SWELL_PERIODS = 2 };

/// The largest number in a track, and the shortest step in seconds. Within them no acceleration overflows.
static const double TRACK_LIMIT = 1e9, TRACK_STEP = 1e-9;

/// 0 … 1 with vanishing first and second derivatives at both ends.
static double swell(double x)
{
    x = fmax(0, fmin(1, x));
    return x * x * x * (10 + x * (6 * x - 15));
}

/// The phase of an exponential chirp, radians.
static double sweep_phase(const struct drive *d, double t)
{
    const double octaves = 2, rate = octaves * M_LN2 / d->seconds;
    return 2 * M_PI * d->frequency / 2 * expm1(rate * t) / rate;
}

/// The natural cubic spline; beyond its ends it is a straight line.
static double track_at(const struct drive *d, double t, int derivative)
{
    int low = 0, high = d->count - 1;
    while (high - low > 1) {
        int middle = (low + high) / 2;
        if (d->time[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    double width = d->time[high] - d->time[low];
    double b = fmax(0, fmin(1, (t - d->time[low]) / width)), a = 1 - b;
    if (derivative == 2)
        return t < d->time[0] || t > d->time[d->count - 1] ? 0 : a * d->curvature[low] + b * d->curvature[high];
    double bend = (a * a * a - a) * d->curvature[low] + (b * b * b - b) * d->curvature[high];
    return a * d->value[low] + b * d->value[high] + bend * width * width / 6;
}

double drive_place(const struct drive *d, double t)
{
    t = fmax(t, 0);
    const double periods = d->frequency * t, wave = sin(2 * M_PI * periods);
    switch (d->kind) {
    case DRIVE_NONE:
        return 0;
    case DRIVE_SINE:
        return d->size * swell(periods / SWELL_PERIODS) * wave;
    case DRIVE_BURST:
        if (periods >= BURST_PERIODS) return 0;
        return d->size * pow(sin(M_PI * periods / BURST_PERIODS), 4) * wave;
    case DRIVE_SWEEP: {
        double part = t / d->seconds;
        return d->size * swell(10 * part) * swell(10 * (1 - part)) * sin(sweep_phase(d, t));
    }
    case DRIVE_TRACK:
        return d->size * (track_at(d, t, 0) - d->value[0]);
    }
    return 0;
}

double drive_acceleration(const struct drive *d, double t)
{
    if (d->kind == DRIVE_NONE) return 0;
    if (d->kind == DRIVE_TRACK) return d->size * track_at(d, t, 2);
    const double h = 1e-3 / (2 * M_PI * d->frequency); // balances truncation and rounding, each about 1e-7
    return (drive_place(d, t + h) - 2 * drive_place(d, t) + drive_place(d, t - h)) / (h * h);
}

double drive_end(const struct drive *d)
{
    if (d->kind == DRIVE_BURST) return BURST_PERIODS / d->frequency;
    return d->kind == DRIVE_TRACK ? d->time[d->count - 1] : INFINITY;
}

/// Second derivatives of the natural cubic spline, by the usual tridiagonal elimination.
static void bend_track(struct drive *d, double *above)
{
    const double *t = d->time, *y = d->value;
    for (int i = 1; i < d->count - 1; i++) {
        double before = t[i] - t[i - 1], after = t[i + 1] - t[i];
        double right = 6 * ((y[i + 1] - y[i]) / after - (y[i] - y[i - 1]) / before);
        double pivot = 2 * (before + after) - before * above[i - 1];
        above[i] = after / pivot;
        d->curvature[i] = (right - before * d->curvature[i - 1]) / pivot;
    }
    for (int i = d->count - 2; i > 0; i--) d->curvature[i] -= above[i] * d->curvature[i + 1];
}

static bool read_lines(struct drive *d, char *text, const char *path, struct error *error)
{
    int number = 0;
    for (char *line = text, *next; line; line = next) {
        next = strchr(line, '\n');
        if (next) *next++ = '\0';
        number++;
        double time, value;
        int end = 0;
        if (!line[strspn(line, " \t\r")]) continue;
        bool good = sscanf(line, "%lf , %lf %n", &time, &value, &end) == 2 && !line[end] &&
                    fabs(time) <= TRACK_LIMIT && fabs(value) <= TRACK_LIMIT;
        if (!good && d->count == 0 && !strpbrk(line, "0123456789")) continue; // the headings
        if (!good) {
            return fail(error, ERROR_INPUT,
                        "%s:%d: expected two numbers up to 1e9, \"seconds,displacement\", got '%.24s'", path, number,
                        line);
        }
        if (d->count > 0 && !(time - d->time[d->count - 1] >= TRACK_STEP)) {
            return fail(error, ERROR_INPUT, "%s:%d: expected a time a nanosecond or more after %g, got %g", path,
                        number, d->time[d->count - 1], time);
        }
        d->time[d->count] = time;
        d->value[d->count++] = value;
    }
    if (d->count >= 2) return true;
    return fail(error, ERROR_INPUT, "%s: expected two lines \"seconds,displacement\" or more, got %d", path,
                d->count);
}

bool drive_read_track(struct drive *d, const char *path, struct error *error)
{
    char *text;
    size_t size, lines = 1;
    if (!file_read_text(path, FILE_LIMIT, &text, &size, error)) return false;
    for (size_t i = 0; i < size; i++) lines += text[i] == '\n';
    d->kind = DRIVE_TRACK;
    d->time = need_zeroed(lines, sizeof *d->time);
    d->value = need_zeroed(lines, sizeof *d->value);
    d->curvature = need_zeroed(lines, sizeof *d->curvature);
    double *scratch = need_zeroed(lines, sizeof *scratch);
    const bool good = read_lines(d, text, path, error);
    if (good) bend_track(d, scratch);
    free(scratch);
    free(text);
    return good;
}

void drive_free(struct drive *d)
{
    free(d->time);
    free(d->value);
    free(d->curvature);
    *d = (struct drive){0};
}
