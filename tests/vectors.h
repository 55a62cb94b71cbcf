/// Scenes with exact solutions: lists a folder's scenes, reads their tables, and measures a curve's error.
#ifndef TESTS_VECTORS_H
#define TESTS_VECTORS_H

#include "near.h"

#include "base/file.h"
#include <dirent.h>
#include <wiggly/wiggly.h>

/// Calls `check` with each scene's name without .json; returns the number of scenes.
static inline int vectors_each(const char *folder, void (*check)(const char *name))
{
    DIR *directory = opendir(folder);
    int count = 0;
    assert_non_null(directory);
    for (struct dirent *entry; (entry = readdir(directory));) {
        char *dot = strstr(entry->d_name, ".json");
        if (!dot) continue;
        *dot = '\0';
        check(entry->d_name);
        count++;
    }
    closedir(directory);
    return count;
}

/// The numbers of FOLDER/NAME.csv after its header, `columns` per row. The caller frees them.
static inline double *vectors_table(const char *folder, const char *name, int columns, int rows)
{
    char path[512], *text;
    size_t size;
    snprintf(path, sizeof path, "%s/%s.csv", folder, name);
    assert_done(file_read(path, (size_t)1 << 26, &text, &size, &error));
    double *numbers = malloc(sizeof *numbers * (size_t)(columns * rows));
    char *at = strchr(text, '\n');
    for (int i = 0; i < columns * rows; i++) {
        char *end;
        numbers[i] = strtod(at + 1, &end);
        if (end == at + 1) fail_msg("%s: fewer than %d numbers", path, columns * rows);
        at = end;
    }
    free(text);
    return numbers;
}

/// The largest difference in total, Re x and Im x from columns 3·spline + 1 …, relative to the total's range or magnitude.
static inline double vectors_error(const wiggly_curve *curve, const double *table, int columns, int spline)
{
    double low = INFINITY, high = -INFINITY, worst = 0;
    for (int i = 0; i < curve->samples; i++) {
        const double *row = table + columns * i + 1 + 3 * spline;
        low = fmin(low, row[0]), high = fmax(high, row[0]);
        worst = fmax(worst, fabs(curve->total[i] - row[0]));
        worst = fmax(worst, fmax(fabs(curve->re[i] - row[1]), fabs(curve->im[i] - row[2])));
    }
    const double size = fmax(high - low, fmax(fabs(low), fabs(high)));
    return size > 0 ? worst / size : worst;
}

#endif
