// SPDX-License-Identifier: Apache-2.0
// lightcal reference: typical values, each with its source.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/reference_values.h"

namespace lightcal::app {
namespace {

struct ReferenceOptions {
  std::vector<std::string> words;
};

// What people call a quantity, and a word that stands in every row of it.
struct Alias {
  std::string_view word;
  std::string_view stands_for;
};
constexpr Alias kAliases[] = {{"lux", "illuminance"},        {"lx", "illuminance"},
                              {"luminance", "luminance cd"}, {"nit", "luminance cd"},
                              {"nits", "luminance cd"},      {"flux", "luminous flux"},
                              {"lumen", "luminous flux"},    {"lumens", "luminous flux"},
                              {"lm", "luminous flux"},       {"efficacy", "luminous efficacy"}};

std::string Haystack(const ReferenceValue& row) {
  std::string text;
  for (const std::string_view part :
       {ReferenceQuantityName(row.quantity), ReferenceUnit(row.quantity), row.what, row.source}) {
    text += LowerAscii(part) + " ";
  }
  return text;
}

bool Matches(const ReferenceValue& row, const std::vector<std::string>& words) {
  const std::string haystack = Haystack(row);
  return std::ranges::all_of(words, [&haystack](const std::string& typed) {
    const std::string word = LowerAscii(typed);
    const auto* const alias = std::ranges::find(kAliases, word, &Alias::word);
    return haystack.find(alias == std::end(kAliases) ? std::string_view(word)
                                                     : alias->stands_for) != std::string::npos;
  });
}

// At most four digits, without zeros to fill them.
std::string ShortText(double value) {
  std::string rounded = RoundedText(value, 4);
  std::string shortest = ShortestText(value);
  return shortest.size() < rounded.size() ? shortest : rounded;
}

std::string ReferenceRange(const ReferenceValue& row) {
  const std::string low = ShortText(row.low);
  return row.low == row.high ? low : low + " - " + ShortText(row.high);
}

Node RowNode(const ReferenceValue* row) {
  return {{"quantity", ReferenceQuantityName(row->quantity)},
          {"what", row->what},
          {"low", row->low},
          {"high", row->high},
          {"unit", ReferenceUnit(row->quantity)},
          {"basis", ReferenceBasisName(row->basis)},
          {"source", row->source},
          {"seed_value", row->seed_value},
          {"seed_note", Node::UnlessEmpty(row->seed_note)},
          {"seed_doubtful", !row->seed_note.empty()}};
}

void PrintRows(const std::vector<const ReferenceValue*>& found, Console& console) {
  std::vector<std::vector<std::string>> table;
  std::string notes;
  for (const ReferenceValue* row : found) {
    const std::string what(row->what);
    table.push_back({std::string(ReferenceQuantityName(row->quantity)), ReferenceRange(*row),
                     std::string(ReferenceUnit(row->quantity)), what, std::string(row->source)});
    if (!row->seed_note.empty()) notes += what + ": " + std::string(row->seed_note) + "\n";
  }
  console.Print(TextTable({"quantity", "value", "unit", "what", "source"}, table));
  if (console.verbose() && !notes.empty()) {
    console.Print("\nPrinted otherwise in the text lightcal began with (\"the seed\"):\n" + notes);
  }
}

Result<void> RunReference(const ReferenceOptions& o, Console& console) {
  std::vector<const ReferenceValue*> found;
  for (const ReferenceValue& row : ReferenceValues()) {
    if (Matches(row, o.words)) found.push_back(&row);
  }
  if (found.empty()) {
    return WrongUsage(o.words.front(),
                      "no value mentions this; try sun, moon, sky, office, museum, "
                      "road, display, LED, halogen, flux, illuminance, luminance, "
                      "efficacy, or no word for all");
  }
  PrintRows(found, console);
  console.PrintDocument({{"values", Node::List(found, RowNode)}});
  return {};
}

}  // namespace

Run BuildReference(CLI::App& parser) {
  auto o = std::make_shared<ReferenceOptions>();
  parser.add_option("word", o->words, "Show the values that mention every one of these words");
  return [o](Console& console) { return RunReference(*o, console); };
}

}  // namespace lightcal::app
