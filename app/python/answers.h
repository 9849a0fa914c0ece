// SPDX-License-Identifier: Apache-2.0
// What Python gives, as the structs that commands are asked with; what they answer, as Python has
// it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "console.h"
#include "lightcal/core/result.h"

namespace lightcal::app::python {

namespace py = pybind11;

// Raises lightcal.Error(kind, code, subject, message), options spelled as keywords.
[[noreturn]] void Raise(const Error& error);
template <class T>
T OrRaise(Result<T>&& result) {
  if (!result) Raise(result.error());
  return *std::move(result);
}

// "give --anchor-sigma" or "give {merge.anchor}" -> "give `anchor_sigma`": keywords are named as
// the options are. What stands in `backticks` is a command line and stays.
[[nodiscard]] std::string InKeywords(std::string_view text);

// A value as a person would type it; a bare number is SI. TypeError for anything else; raises usage
// for a text that is not Unicode (half of a pair).
[[nodiscard]] std::string TextOf(py::handle value);
[[nodiscard]] std::vector<std::string> TextsOf(py::handle values);

// A keyword and the member that it sets; `words`, where not empty, are all it takes.
template <class Options>
struct Keyword {
  std::string_view name;
  std::variant<std::string Options::*, std::vector<std::string> Options::*, bool Options::*> member;
  std::vector<std::string> words = {};
};
void CheckWord(std::string_view keyword, const std::string& text,
               std::span<const std::string> words);

// Sets what is given and not None. Raises usage for a word that is none, TypeError for a keyword
// that there is not.
template <class Options>
void Fill(Options& options, const py::dict& given, std::span<const Keyword<Options>> keywords) {
  for (const auto& [key, value] : given) {
    if (value.is_none()) continue;
    const auto name = py::cast<std::string>(key);
    const Keyword<Options>* found = nullptr;
    for (const Keyword<Options>& keyword : keywords) {
      if (keyword.name == name) found = &keyword;
    }
    if (found == nullptr) throw py::type_error("unexpected keyword argument '" + name + "'");
    if (const auto* flag = std::get_if<bool Options::*>(&found->member)) {
      options.** flag = py::cast<bool>(value);
    } else if (const auto* text = std::get_if<std::string Options::*>(&found->member)) {
      options.** text = TextOf(value);
      CheckWord(name, options.**text, found->words);
    } else {
      options.*std::get<std::vector<std::string> Options::*>(found->member) = TextsOf(value);
    }
  }
}

// A document as dicts, lists, texts and numbers. Raises not_finite rather than give a NaN.
[[nodiscard]] py::object FromNode(const Node& node);
// The same, with what the console was warned of under "warnings".
[[nodiscard]] py::dict AnswerOf(Node document, const Console& console);

// Samples as a numpy array that keeps `owner` alive: no copy.
template <class T, class Owner>
py::array_t<T> ArrayOf(std::vector<T>& samples, std::vector<py::ssize_t> shape,
                       const std::shared_ptr<Owner>& owner) {
  py::capsule keeper(new std::shared_ptr<Owner>(owner),
                     [](void* held) { delete static_cast<std::shared_ptr<Owner>*>(held); });
  return py::array_t<T>(std::move(shape), samples.data(), keeper);
}

}  // namespace lightcal::app::python
