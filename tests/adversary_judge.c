/// The solver's answer to an adversary's problem, judged by the textbook.
#include "adversary.h"

#include <math.h>

/// An answer of the textbook's, or the solver's, in arrays of its own.
struct answer {
    double total[ADVERSARY_MAX], re[ADVERSARY_MAX], im[ADVERSARY_MAX];
};

static double size_of(const struct answer *a, int n)
{
    double low = a->total[0], high = low;
    for (int i = 1; i < n; i++) low = fmin(low, a->total[i]), high = fmax(high, a->total[i]);
    return fmax(high - low, fmax(fabs(low), fabs(high)));
}

/// The largest difference in any column, relative to the larger of the total's range and magnitude. What it is the sum of (equilibrium
/// and displacement) has last digits too: they do not count, and a total that is nearly nothing is measured against a millionth of them.
static double error_of(const struct answer *a, const struct answer *exact, int n)
{
    double worst = 0, parts = 0;
    for (int i = 0; i < n; i++) {
        double off = fmax(fabs(a->total[i] - exact->total[i]), fabs(a->re[i] - exact->re[i]));
        off = fmax(off, fabs(a->im[i] - exact->im[i]));
        if (!(off <= worst)) worst = off;
        parts = fmax(parts, fmax(fabs(exact->re[i]), fabs(exact->total[i] - exact->re[i])));
        parts = fmax(parts, fabs(exact->im[i]));
    }
    return worst <= 0x1p-40 * parts ? 0 : worst / fmax(size_of(exact, n), 1e-6 * parts);
}

/// Whether the total is next to nothing beside what it is the sum of.
static bool is_nothing(const struct answer *a, int n)
{
    double parts = 0;
    for (int i = 0; i < n; i++) parts = fmax(parts, fmax(fabs(a->re[i]), fabs(a->total[i] - a->re[i])));
    return size_of(a, n) < 1e-2 * parts;
}

/// Damped so little that rows of the energy weigh much alike.
static bool is_tame(const wiggly_desc *d)
{
    bool tame = true;
    for (int i = 0; i < d->samples; i++)
        tame = tame && (d->damping.track ? d->damping.track[i] : d->damping.value) <= 2;
    return tame;
}

static struct textbook book;

/// How much more the curve changes, relatively, than the numbers that it is made of: the rounding of the poles alone costs any solver in
/// doubles some 1e-16 of it.
static double condition_of(const struct adversary_problem *p, wiggly_status status, const struct answer *exact)
{
    static struct answer changed;
    static double track[ADVERSARY_MAX];
    const double change = 1e-12;
    wiggly_desc other = p->desc;
    wiggly_param *params[] = {&other.frequency, &other.damping};
    double worst = 0;
    for (int i = 0; i < 2; i++) {
        wiggly_param kept = *params[i];
        for (int k = 0; kept.track && k < other.samples; k++) track[k] = kept.track[k] * (1 + change);
        *params[i] = (wiggly_param){kept.value * (1 + change), kept.track ? track : NULL};
        if (!textbook_as(&other, status, &book, changed.total, changed.re, changed.im)) return INFINITY;
        worst = fmax(worst, error_of(&changed, exact, other.samples) / change);
        *params[i] = kept;
    }
    return worst;
}

static double tolerance(const wiggly_desc *d) { return d->mode == WIGGLY_CUBIC ? 1e-9 : 1e-8; }

/// The textbook's answer to what the solver says it solved, and whether that was the right thing to solve.
static void find_exact(const struct adversary_problem *p, struct adversary_verdict *v, struct answer *a)
{
    bool asked = textbook_as(&p->desc, WIGGLY_OK, &book, a->total, a->re, a->im);
    const double inverse = textbook_inverse(&book);
    v->pivot = book.pivot;
    v->growth = book.growth;
    const bool is_blurred = !asked || inverse > 1e26 || book.pivot < 1e-20; // for 34 digits
    v->undecided = book.open && v->said != WIGGLY_OK
                       ? !asked && v->said != WIGGLY_CALMED && v->said != WIGGLY_LEVELLED
                       : is_blurred;
    v->borderline =
        book.open && ((asked && (book.pivot < 1e-11 || inverse > 1e14)) || (book.growth > 300 && book.growth < 3e5));
    v->exists = textbook_curve(&p->desc, &book, &v->status, a->total, a->re, a->im);
    v->undecided = v->undecided || !v->exists;
    if (!v->borderline || v->said == v->status || v->said == WIGGLY_SINGULAR) return;
    bool as_asked = v->said == WIGGLY_INEXACT || v->said == WIGGLY_OK;
    v->status = as_asked ? WIGGLY_OK : v->said;
    v->exists = textbook_as(&p->desc, v->status, &book, a->total, a->re, a->im);
}

/// Whether w is calmed depends on last digits where u is in any case.
static void try_calmed(const struct adversary_problem *p, const struct answer *got, struct answer *exact,
                       struct adversary_verdict *v)
{
    if (textbook_as(&p->desc, WIGGLY_CALMED, &book, exact->total, exact->re, exact->im))
        v->error = fmin(v->error, error_of(got, exact, p->desc.samples));
}

static const char *find_fault(const struct adversary_problem *p, struct adversary_verdict *v,
                              const struct answer *exact)
{
    const bool inexact = v->said == WIGGLY_INEXACT;
    if (v->said != v->status && !(inexact && v->status == WIGGLY_OK)) return "the wrong status";
    if (!(v->estimate >= 0)) return "an estimate that is no number";
    if (v->said == WIGGLY_OK && !(v->error <= tolerance(&p->desc))) return "OK, and off";
    if (v->error > tolerance(&p->desc) && v->error > v->estimate) return "an estimate below the error";
    if (!inexact) return NULL;
    v->needless = true;
    if (!(v->estimate > tolerance(&p->desc))) return "INEXACT by no estimate";
    if (v->error > 0.05 * tolerance(&p->desc) || v->pivot <= 1e-9 || textbook_inverse(&book) > 1e14)
        return NULL; // what is that far off may say so
    if (is_nothing(exact, p->desc.samples) || !is_tame(&p->desc)) return NULL;
    v->condition = condition_of(p, v->status, exact);
    return v->condition < 1e4 ? "INEXACT, and easy" : NULL;
}

void adversary_judge(wiggly_solver *solver, const struct adversary_problem *p, struct adversary_verdict *v)
{
    static struct answer got, exact;
    wiggly_curve curve = {.size = sizeof curve, .total = got.total, .re = got.re, .im = got.im};
    *v = (struct adversary_verdict){.said = wiggly_solve(solver, &p->desc, &curve), .estimate = curve.error};
    v->estimate = curve.error;
    find_exact(p, v, &exact);
    if (v->undecided) return;
    if (v->said == WIGGLY_SINGULAR) {
        v->fault = v->exists && !v->borderline ? "singular is not" : NULL;
    } else if (!v->exists) {
        v->fault = "an answer where there is none";
    } else {
        v->error = error_of(&got, &exact, p->desc.samples);
        if (v->said == WIGGLY_CALMED && v->borderline && v->error > tolerance(&p->desc)) // of w, or of u alone
            try_calmed(p, &got, &exact, v);
        v->fault = find_fault(p, v, &exact);
    }
}

void adversary_explain(FILE *out, const char *name, const struct adversary_verdict *v)
{
    fprintf(out, "%s: %s: said %d, is %d, off by %.3g, estimate %.3g, pivot %.3g, growth %.3g, condition %.2g\n",
            name, v->fault, (int)v->said, (int)v->status, v->error, v->estimate, v->pivot, v->growth, v->condition);
}
