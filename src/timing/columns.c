/// The columns of the timing log, and what sums one up.
#include "timing/columns.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define ROW(field) #field, .offset = offsetof(struct frame_row, field)

const struct column timing_columns[COLUMN_COUNT] = {
    {ROW(frame), .use = COLUMN_LABEL, .is_count = true},
    {ROW(t_s), .use = COLUMN_LABEL, .decimals = 6},
    {ROW(frame_ms), .use = COLUMN_COST, .decimals = 4, .grain = 0.001, .tail_grain = 0.25},
    {ROW(frame_interval_ms), .use = COLUMN_COST, .decimals = 4, .grain = 0.001, .tail_grain = 0.25},
    {ROW(wait_us), .use = COLUMN_WAIT, .decimals = 1},
    {ROW(input_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(edit_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(solve_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(pose_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(upload_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(draw_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(gpu_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(swap_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(splines_solved), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(samples), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(knots), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(edited), .use = COLUMN_COUNTER, .is_count = true},
    {ROW(event_to_swap_us), .use = COLUMN_COST, .decimals = 1, .grain = 1, .tail_grain = 250},
    {ROW(allocations), .use = COLUMN_COST, .is_count = true},
    {ROW(uploaded_bytes), .use = COLUMN_COST, .is_count = true},
};

double column_value(const struct column *column, const struct frame_row *row)
{
    const char *field = (const char *)row + column->offset;
    if (column->is_count) {
        long count;
        memcpy(&count, field, sizeof count);
        return count < 0 ? NAN : (double)count;
    }
    double value;
    memcpy(&value, field, sizeof value);
    return value;
}

static int by_number(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void statistics_sort(double *values, int count)
{
    if (count > 1) qsort(values, (size_t)count, sizeof *values, by_number);
}

double statistics_quantile(const double *sorted, int count, double p)
{
    if (count < 1) return NAN;
    double position = p * (count - 1);
    int below = (int)position;
    int above = below + 1 < count ? below + 1 : below;
    return sorted[below] + (position - below) * (sorted[above] - sorted[below]);
}

const double frame_budgets_ms[BUDGET_COUNT] = {1000.0 / 60, 1000.0 / 30};

struct over_budget statistics_over(const double *values, int count, double budget)
{
    struct over_budget over = {0, 0};
    for (int i = 0, run = 0; i < count; i++) {
        run = values[i] > budget ? run + 1 : 0;
        over.frames += run > 0;
        if (run > over.longest) over.longest = run;
    }
    return over;
}
