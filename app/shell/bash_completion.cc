// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <vector>

#include "lightcal/core/joined.h"
#include "shell/shell_texts.h"

namespace lightcal::app {
namespace {

// What follows an option that takes a value, as a branch of a case.
std::string ValueBranch(const std::string& path, const TypedOption& option) {
  const std::string patterns = Joined(option.names, " | ", [&](const std::string& name) {
    return "\"" + path + " " + name + "\"";
  });
  std::string answer = "compopt -o default";
  if (option.number) answer = ":";
  if (!option.words.empty()) {
    answer = (option.commas ? "_lightcal_list \"" : "_lightcal_words \"") +
             Joined(option.words, " ") + "\"";
  }
  return "    " + patterns + ") " + answer + "; return ;;\n";
}

struct Branches {
  std::string commands, values, paths;
};

void AddBranches(const TypedCommand& command, Branches& branches) {
  const std::string path = PathText(command);
  std::vector<std::string> options, words;
  for (const TypedOption& option : command.options) {
    options.insert(options.end(), option.names.begin(), option.names.end());
    if (option.names.empty()) words.insert(words.end(), option.words.begin(), option.words.end());
    if (option.values > 0 && !option.names.empty()) branches.values += ValueBranch(path, option);
  }
  for (const TypedCommand& below : command.commands) {
    words.push_back(below.path.back());
    branches.commands +=
        (branches.commands.empty() ? "\"" : " | \"") + path + " " + below.path.back() + "\"";
  }
  branches.paths += "    \"" + path + "\") options=\"" + Joined(options, " ") + "\" words=\"" +
                    Joined(words, " ") + "\" ;;\n";
  for (const TypedCommand& below : command.commands) AddBranches(below, branches);
}

}  // namespace

std::string BashCompletion(const TypedCommand& lightcal) {
  Branches branches;
  AddBranches(lightcal, branches);
  return R"(# bash completion of lightcal, made by: lightcal completion bash
_lightcal_words() {
  mapfile -t COMPREPLY < <(compgen -W "$1" -- "$cur")
}
# The last of words that are joined by commas.
_lightcal_list() {
  local before=
  [[ $cur == *,* ]] && before=${cur%,*},
  mapfile -t COMPREPLY < <(compgen -P "$before" -W "$1" -- "${cur##*,}")
  compopt -o nospace
}
_lightcal() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD - 1]} path='' options='' words='' i
  # --to=g arrives as three words.
  if [[ $cur == "=" ]]; then
    cur=
  elif [[ $prev == "=" ]]; then
    prev=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${COMP_WORDS[i]}" in
      )" +
         branches.commands +
         R"() path=${path:+$path }${COMP_WORDS[i]} ;;
    esac
  done
  case "$path $prev" in
)" + branches.values +
         R"(  esac
  case $path in
)" + branches.paths +
         R"(  esac
  if [[ $cur == -* ]]; then
    _lightcal_words "$options"
  elif [[ -n $words ]]; then
    _lightcal_words "$words"
  else
    compopt -o default
  fi
}
complete -F _lightcal lightcal
)";
}

}  // namespace lightcal::app
