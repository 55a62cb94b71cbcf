/// Complex numbers in double-double.
#ifndef SPLINE_DDC_H
#define SPLINE_DDC_H

#include "spline/dd.h"
#include "spline/poles.h"

typedef struct ddc {
    dd re, im;
} ddc;

static inline ddc ddc_from(cplx z) { return (ddc){dd_from(z.re), dd_from(z.im)}; }

/// z·w for a double z.
static inline ddc ddc_scale(cplx z, ddc w)
{
    return (ddc){dd_subtract(dd_scale(z.re, w.re), dd_scale(z.im, w.im)),
                 dd_add(dd_scale(z.re, w.im), dd_scale(z.im, w.re))};
}

static inline ddc ddc_add(ddc a, ddc b) { return (ddc){dd_add(a.re, b.re), dd_add(a.im, b.im)}; }
static inline ddc ddc_subtract(ddc a, ddc b) { return (ddc){dd_subtract(a.re, b.re), dd_subtract(a.im, b.im)}; }

#endif
