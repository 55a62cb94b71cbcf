/// Loads LAPACKE and OpenBLAS at run time.
#include "base/lapack.h"
#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/// dlsym() returns an object pointer; POSIX allows copying it into a function pointer, C forbids the cast.
static void find(void *library, const char *name, void *function)
{
    void *symbol = library ? dlsym(library, name) : NULL;
    memcpy(function, &symbol, sizeof symbol);
}

bool lapack_load(struct lapack *lapack, char *description, size_t size)
{
    *lapack = (struct lapack){0};
    void (*set_threads)(int) = NULL;
    char *(*get_config)(void) = NULL;
    lapack->blas = dlopen("libopenblas.so.0", RTLD_NOW | RTLD_GLOBAL);
    lapack->lapacke = dlopen("liblapacke.so.3", RTLD_NOW);
    find(lapack->blas, "openblas_set_num_threads", &set_threads);
    find(lapack->blas, "openblas_get_config", &get_config);
    find(lapack->blas, "cblas_dsyrk", &lapack->dsyrk);
    find(lapack->blas, "cblas_dgemm", &lapack->dgemm);
    find(lapack->lapacke, "LAPACKE_dpbsv", &lapack->dpbsv);
    find(lapack->lapacke, "LAPACKE_zpbsv", &lapack->zpbsv);
    find(lapack->lapacke, "LAPACKE_dsyevd", &lapack->dsyevd);
    find(lapack->lapacke, "LAPACKE_zheevd", &lapack->zheevd);
    find(lapack->lapacke, "LAPACKE_dgeev", &lapack->dgeev);
    if (set_threads) set_threads(1);
    bool whole = lapack->dpbsv && lapack->zpbsv && lapack->dsyevd && lapack->zheevd && lapack->dgeev &&
                 lapack->dsyrk && lapack->dgemm;
    if (!whole) {
        lapack_unload(lapack);
        snprintf(description, size, "not found (install liblapacke and libopenblas0)");
    } else {
        snprintf(description, size, "%s, one thread", get_config ? get_config() : "liblapacke.so.3");
    }
    return whole;
}

void lapack_unload(struct lapack *lapack)
{
    if (lapack->lapacke) dlclose(lapack->lapacke);
    if (lapack->blas) dlclose(lapack->blas);
    *lapack = (struct lapack){0};
}
