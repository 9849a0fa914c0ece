// SPDX-License-Identifier: Apache-2.0
// wasi-libc has getentropy alone.
#pragma once

#include_next <sys/random.h>
#include <sys/types.h>

inline ssize_t getrandom(void* bytes, size_t size, unsigned /*flags*/) {
  return getentropy(bytes, size) == 0 ? static_cast<ssize_t>(size) : -1;
}
