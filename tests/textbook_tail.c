/// Behind the last knot L, w = e^{p…} w_L + e: e is the real oscillator's motion from rest at L under what presses it.
#include "textbook.h"

/// A row's coefficients on the samples before, at and after it, and |g|⁻².
struct row {
    real by[3], weight;
};

static struct row row_at(const struct textbook *book, int row)
{
    const struct textbook_poles *at = &book->at[book->last + row];
    const real decay = expq(-at->d * book->h);
    return (struct row){{decay * decay, -2 * decay * cosq(at->turn * book->h), 1}, 1 / (decay * decay)};
}

static real force_of(const struct row *row, const real *e, int i)
{
    return row->by[2] * e[i + 1] + row->by[1] * e[i] + (i > 0 ? row->by[0] * e[i - 1] : 0);
}

real textbook_tail_pull(const struct textbook *book, const real *e, int count, int sample)
{
    real sum = 0;
    for (int i = sample - 1; i <= sample + 1; i++) {
        if (i < 0 || i + 1 >= count) continue;
        const struct row row = row_at(book, i);
        sum += row.weight * row.by[sample - i + 1] * force_of(&row, e, i);
    }
    return -sum / (book->h * book->h * book->h);
}

// Between samples q = e^{−dt} (e_i cos ω_d t + B sin ω_d t), so that −(q' + d q) / ω_d = −B, of the side from which it is seen.
real textbook_tail_im(const struct textbook *book, const real *e, int count, int sample)
{
    const struct textbook_poles *at = &book->at[book->last + sample];
    const real decay = expq(-at->d * book->h), c = cosq(at->turn * book->h), s = sinq(at->turn * book->h);
    const real behind = (e[sample] * c - e[sample - 1] * decay) / s;
    if (sample + 1 == count) return -behind;
    return -(behind + (e[sample + 1] / decay - e[sample] * c) / s) / 2;
}
