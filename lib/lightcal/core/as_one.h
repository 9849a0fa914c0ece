// SPDX-License-Identifier: Apache-2.0
// Several refusals as the one error of an answer.
#pragma once

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "lightcal/core/result.h"

namespace lightcal {

// The first with the others beside it, each once: what no single lamp or file caused is one cause.
// `errors` is not empty.
[[nodiscard]] inline Error AsOne(std::vector<Error> errors) {
  Error first = std::move(errors.front());
  std::vector<Error> more = std::exchange(first.others, {});
  for (auto error = errors.begin() + 1; error != errors.end(); ++error) {
    std::vector<Error> beside = std::exchange(error->others, {});
    more.push_back(std::move(*error));
    std::ranges::move(beside, std::back_inserter(more));
  }
  const auto same = [](const Error& a, const Error& b) {
    return a.subject == b.subject && a.message == b.message;
  };
  for (Error& error : more) {
    if (!same(error, first)) first.others.push_back(std::move(error));
  }
  return first;
}

}  // namespace lightcal
