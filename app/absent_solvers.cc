// SPDX-License-Identifier: Apache-2.0
// Debian's libceres.a refers to SuiteSparse, CXSparse and LAPACK for solvers that this program
// never asks for: its problems are dense and small, and Eigen solves them
// (fit/model/least_squares.cc, fit/distribution/intensity_surface.cc). Who asks ends here, instead
// of every start loading fifteen libraries: a third of its time.
#include <cstdio>
#include <cstdlib>

#define LIGHTCAL_ABSENT(name)                                           \
  extern "C" __attribute__((visibility("hidden"))) void name();         \
  void name() {                                                         \
    std::fputs("lightcal holds no sparse solver: " #name "\n", stderr); \
    std::abort();                                                       \
  }

LIGHTCAL_ABSENT(cholmod_amd)
LIGHTCAL_ABSENT(cholmod_analyze)
LIGHTCAL_ABSENT(cholmod_analyze_p)
LIGHTCAL_ABSENT(cholmod_camd)
LIGHTCAL_ABSENT(cholmod_factorize)
LIGHTCAL_ABSENT(cholmod_finish)
LIGHTCAL_ABSENT(cholmod_free_dense)
LIGHTCAL_ABSENT(cholmod_free_factor)
LIGHTCAL_ABSENT(cholmod_free_sparse)
LIGHTCAL_ABSENT(cholmod_print_common)
LIGHTCAL_ABSENT(cholmod_solve)
LIGHTCAL_ABSENT(cholmod_start)
LIGHTCAL_ABSENT(cholmod_triplet_to_sparse)
LIGHTCAL_ABSENT(cholmod_zeros)
LIGHTCAL_ABSENT(cs_di_amd)
LIGHTCAL_ABSENT(cs_di_calloc)
LIGHTCAL_ABSENT(cs_di_chol)
LIGHTCAL_ABSENT(cs_di_cholsol)
LIGHTCAL_ABSENT(cs_di_compress)
LIGHTCAL_ABSENT(cs_di_counts)
LIGHTCAL_ABSENT(cs_di_cumsum)
LIGHTCAL_ABSENT(cs_di_etree)
LIGHTCAL_ABSENT(cs_di_free)
LIGHTCAL_ABSENT(cs_di_ipvec)
LIGHTCAL_ABSENT(cs_di_lsolve)
LIGHTCAL_ABSENT(cs_di_ltsolve)
LIGHTCAL_ABSENT(cs_di_malloc)
LIGHTCAL_ABSENT(cs_di_multiply)
LIGHTCAL_ABSENT(cs_di_nfree)
LIGHTCAL_ABSENT(cs_di_pinv)
LIGHTCAL_ABSENT(cs_di_post)
LIGHTCAL_ABSENT(cs_di_pvec)
LIGHTCAL_ABSENT(cs_di_schol)
LIGHTCAL_ABSENT(cs_di_sfree)
LIGHTCAL_ABSENT(cs_di_spfree)
LIGHTCAL_ABSENT(cs_di_symperm)
LIGHTCAL_ABSENT(cs_di_transpose)
LIGHTCAL_ABSENT(dgeqrf_)
LIGHTCAL_ABSENT(dormqr_)
LIGHTCAL_ABSENT(dpotrf_)
LIGHTCAL_ABSENT(dpotrs_)
LIGHTCAL_ABSENT(dtrtrs_)
