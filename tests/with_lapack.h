/// Loads LAPACKE before a group of tests and unloads it after. Include it after near.h.
#ifndef TESTS_WITH_LAPACK_H
#define TESTS_WITH_LAPACK_H

#include "base/lapack.h"

static struct lapack lapack;

static int with_lapack_load(void **state)
{
    char description[128];
    (void)state;
    if (lapack_load(&lapack, description, sizeof description)) return 0;
    print_error("LAPACKE: %s\n", description);
    return 1;
}

static int with_lapack_unload(void **state)
{
    (void)state;
    lapack_unload(&lapack);
    return 0;
}

#endif
