// SPDX-License-Identifier: Apache-2.0
// How every room answers: a value, or an error that says what, where and what to do.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

namespace lightcal {

// Whose fault it is.
enum class ErrorKind {
  kFailed = 1,   // I/O, device, internal
  kUsage = 2,    // what is asked for makes no sense
  kRefused = 3,  // the data cannot support an answer
};

struct Error {
  ErrorKind kind = ErrorKind::kFailed;
  std::string code;     // stable snake_case word, e.g. "underdetermined"
  std::string subject;  // what it is about: a light, a file:line, a device
  std::string message;  // what is wrong and what to do; fields in braces: "give {merge.noise}"
  // What else is wrong, where one answer has several causes: each lamp that cannot be fitted.
  std::vector<Error> others{};
};

// Something the answer survives but the person should know.
struct Warning {
  std::string code;
  std::string subject;
  std::string message;
  double strays = 0.0;  // how far off it says that an answer is at most, relative; 0: not said
};
using Warnings = std::vector<Warning>;

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> Refused(std::string code, std::string subject,
                                                   std::string message) {
  return tl::unexpected(
      Error{ErrorKind::kRefused, std::move(code), std::move(subject), std::move(message)});
}
[[nodiscard]] inline tl::unexpected<Error> Failed(std::string code, std::string subject,
                                                  std::string message) {
  return tl::unexpected(
      Error{ErrorKind::kFailed, std::move(code), std::move(subject), std::move(message)});
}
[[nodiscard]] inline tl::unexpected<Error> WrongUsage(std::string subject, std::string message) {
  return tl::unexpected(Error{ErrorKind::kUsage, "usage", std::move(subject), std::move(message)});
}
// Hands an error of one Result on as the error of another.
template <class T>
[[nodiscard]] tl::unexpected<Error> Propagate(Result<T>&& failed) {
  return tl::unexpected(std::move(failed).error());
}

}  // namespace lightcal
