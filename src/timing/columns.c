/// The columns of the timing log.
#include "timing/columns.h"
#include <math.h>
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
