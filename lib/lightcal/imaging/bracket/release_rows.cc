// SPDX-License-Identifier: Apache-2.0
#include "lightcal/imaging/bracket/release_rows.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <variant>

namespace lightcal {
namespace {

// The whole pages between two addresses.
void DropPages(const void* begin, const void* end) {
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto first = (reinterpret_cast<std::uintptr_t>(begin) + page - 1) / page * page;
  const auto last = reinterpret_cast<std::uintptr_t>(end) / page * page;
  if (last <= first) return;
  // Only a hint: of a shared mapping nothing is lost.
  static_cast<void>(madvise(reinterpret_cast<void*>(first), last - first, MADV_DONTNEED));
}

}  // namespace

void ReleaseRows(const Frame& frame, int first, int count) {
  if (!frame.in_file || count < 1) return;
  std::visit(
      [&](const auto& view) {
        const auto last = view.row(first + count - 1);
        DropPages(view.row(first).data(), last.data() + last.size());
      },
      frame.samples);
}

}  // namespace lightcal
