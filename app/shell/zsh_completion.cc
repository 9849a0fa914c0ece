// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "lightcal/core/joined.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

std::string ZshQuoted(const std::string& text) { return "'" + Replaced(text, "'", "'\\''") + "'"; }

// Within the brackets of an _arguments specification.
std::string Explained(const std::string& text) {
  return Replaced(Replaced(Replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]");
}

// ":FILE:_files", once for each value.
std::string Values(const TypedOption& option) {
  const std::string joined = Joined(option.words, " ");
  std::string action = "_files";
  if (option.number) action = " ";
  if (!joined.empty()) action = option.commas ? "_values -s , word " + joined : "(" + joined + ")";
  std::string text;
  for (int i = 0; i < option.values; ++i) {
    text += ":" + Replaced(option.placeholder, ":", "\\:") + ":" + action;
  }
  return text;
}

// One argument of _arguments.
std::string Specification(const TypedOption& option) {
  if (option.names.empty()) {
    return ZshQuoted((option.many ? "*" : "") + Values(option));
  }
  const bool equals = option.values == 1;
  const std::string all = Joined(option.names, " ");
  const std::string forms = Joined(option.names, ",", [&](const std::string& name) {
    return name + (equals ? (name.starts_with("--") ? "=" : "+") : "");
  });
  const std::string once = option.many ? "*" : "(" + all + ")";
  const std::string rest = "[" + Explained(option.summary) + "]" + Values(option);
  if (option.names.size() == 1) return ZshQuoted(once + forms + rest);
  return ZshQuoted(once) + "{" + forms + "}" + ZshQuoted(rest);
}

std::string FunctionName(const TypedCommand& command) {
  return "_lightcal" + (command.path.empty() ? "" : "_" + PathText(command, "_"));
}

std::string Function(const TypedCommand& command) {
  std::string specifications;
  for (const TypedOption& option : command.options) {
    specifications += " \\\n    " + Specification(option);
  }
  std::string text = FunctionName(command) + "() {\n";
  if (command.commands.empty()) return text + "  _arguments -s" + specifications + "\n}\n";
  std::string rows, branches;
  for (const TypedCommand& below : command.commands) {
    rows += "        " + ZshQuoted(below.path.back() + ":" + below.summary) + "\n";
    branches += "        " + below.path.back() + ") " + FunctionName(below) + " ;;\n";
  }
  text += "  local curcontext=$curcontext state line\n  typeset -A opt_args\n  _arguments -C" +
          specifications + " \\\n    '1:command:->command' '*::argument:->argument'\n" +
          "  case $state in\n    command)\n      local -a commands=(\n" + rows +
          "      )\n      _describe -t commands command commands ;;\n    argument)\n" +
          "      case $words[1] in\n" + branches + "      esac ;;\n  esac\n}\n";
  for (const TypedCommand& below : command.commands) text += Function(below);
  return text;
}

}  // namespace

std::string ZshCompletion(const TypedCommand& lightcal) {
  return "#compdef lightcal\n# zsh completion of lightcal, made by: lightcal completion zsh\n" +
         Function(lightcal) +
         R"(# Autoloaded, it is this function; sourced, it is made known.
if [[ $funcstack[1] == _lightcal ]]; then _lightcal "$@"; else compdef _lightcal lightcal; fi
)";
}

}  // namespace lightcal::app
