// SPDX-License-Identifier: Apache-2.0
#include "python/answers.h"

#include <algorithm>
#include <cmath>

#include "option_words.h"

namespace lightcal::app::python {

std::string InKeywords(std::string_view text) {
  const std::string words = InOptionWords(text);
  std::string out;
  bool command = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == '`') command = !command;
    const bool dashes =
        !command && words.compare(i, 2, "--") == 0 && i + 2 < words.size() && words[i + 2] >= 'a' &&
        words[i + 2] <= 'z' &&
        (i == 0 || words[i - 1] == ' ' || words[i - 1] == '(' || words[i - 1] == ',');
    if (!dashes) {
      out += words[i];
      continue;
    }
    std::size_t end = i + 2;
    while (end < words.size() && ((words[end] >= 'a' && words[end] <= 'z') || words[end] == '-')) {
      ++end;
    }
    std::string name = words.substr(i + 2, end - i - 2);
    std::ranges::replace(name, '-', '_');
    out += name;
    i = end - 1;
  }
  return out;
}

namespace {

py::object Raised(const Error& error) {
  static constexpr const char* kKinds[] = {"failed", "failed", "usage", "refused"};
  py::list others;
  for (const Error& other : error.others) others.append(Raised(other));
  return py::module_::import("lightcal._error")
      .attr("Error")(kKinds[static_cast<int>(error.kind)], error.code, InKeywords(error.subject),
                     InKeywords(error.message), py::tuple(others));
}

}  // namespace

void Raise(const Error& error) {
  const py::object raised = Raised(error);
  PyErr_SetObject(py::type::of(raised).ptr(), raised.ptr());
  throw py::error_already_set();
}

std::string TextOf(py::handle value) {
  if (py::isinstance<py::str>(value)) {
    if (PyUnicode_AsUTF8(value.ptr()) != nullptr) return py::cast<std::string>(value);
    PyErr_Clear();
    Raise({ErrorKind::kUsage, "usage", py::cast<std::string>(py::repr(value)),
           "holds half a character (a lone surrogate); give text"});
  }
  if (py::hasattr(value, "__fspath__")) {
    return py::cast<std::string>(py::module_::import("os").attr("fspath")(value));
  }
  if (py::isinstance<py::bool_>(value)) throw py::type_error("True and False are no value here");
  if (py::isinstance<py::int_>(value)) return py::cast<std::string>(py::str(value));
  if (py::hasattr(value, "__float__")) {
    return py::cast<std::string>(py::repr(py::float_(py::reinterpret_borrow<py::object>(value))));
  }
  throw py::type_error("expected a text or a number, not " +
                       py::cast<std::string>(py::str(py::type::of(value).attr("__name__"))));
}

std::vector<std::string> TextsOf(py::handle values) {
  if (py::isinstance<py::str>(values) || !py::hasattr(values, "__iter__")) {
    return {TextOf(values)};
  }
  std::vector<std::string> texts;
  for (const py::handle value : values) texts.push_back(TextOf(value));
  return texts;
}

void CheckWord(std::string_view keyword, const std::string& text,
               std::span<const std::string> words) {
  if (words.empty() || std::ranges::find(words, text) != words.end()) return;
  std::string all;
  for (const std::string& word : words) all += (all.empty() ? "" : ", ") + word;
  Raise({ErrorKind::kUsage, "usage", std::string(keyword), "\"" + text + "\" is none of " + all});
}

py::object FromNode(const Node& node) {
  switch (node.kind) {
    case Node::Kind::kNull:
      return py::none();
    case Node::Kind::kBoolean:
      return py::bool_(node.boolean);
    case Node::Kind::kInteger:
      return py::int_(node.integer);
    case Node::Kind::kNumber:
      if (!std::isfinite(node.number)) {
        Raise({ErrorKind::kFailed, "not_finite", "", "an answer is not finite; please report it"});
      }
      return py::float_(node.number);
    case Node::Kind::kText:
      return py::str(node.text);
    case Node::Kind::kArray: {
      py::list list;
      for (const Node& item : node.items) list.append(FromNode(item));
      return list;
    }
    case Node::Kind::kTable: {
      py::dict dict;
      for (const records::Member& member : node.members) {
        dict[py::str(member.key)] = FromNode(member.value);
      }
      return dict;
    }
  }
  return py::none();
}

py::dict AnswerOf(Node document, const Console& console) {
  document.Put("warnings",
               Node::UnlessEmpty(Node::List(console.warnings(), [](const Warning& w) -> Node {
                 return {{"code", w.code},
                         {"subject", InKeywords(w.subject)},
                         {"message", InKeywords(w.message)}};
               })));
  return FromNode(document);
}

}  // namespace lightcal::app::python
