// SPDX-License-Identifier: Apache-2.0
// LIGHTCAL_EVERY_CPU before a function: compiled once a level of x86-64, and the one that this
// processor can run is chosen when the program is loaded. That is before the thread sanitizer runs,
// whose build asks for one (LIGHTCAL_ONE_PROCESSOR); other processors have one as well.
#pragma once

#if defined(__x86_64__) && !defined(LIGHTCAL_ONE_PROCESSOR)
#define LIGHTCAL_EVERY_CPU \
  __attribute__((target_clones("default", "arch=x86-64-v3", "arch=x86-64-v4")))
#else
#define LIGHTCAL_EVERY_CPU
#endif
