// SPDX-License-Identifier: Apache-2.0
#include "library/light_search.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string_view>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {
namespace {

using Value = std::optional<double>;

Value ValueOf(const std::optional<Uncertain>& u) { return u ? Value(u->value) : std::nullopt; }
Value Cct(const LibraryLight& l) { return ValueOf(l.light.color.cct_K); }
Value Flux(const LibraryLight& l) { return ValueOf(l.light.flux_lm); }
Value Intensity(const LibraryLight& l) { return ValueOf(l.light.intensity_cd); }
Value Illuminance(const LibraryLight& l) { return ValueOf(l.light.illuminance_lx); }

// A number a light may have: the word of its option and order, its unit, where it is.
struct LibraryMeasure {
  std::string_view word;
  std::string_view unit;
  Value (*of)(const LibraryLight&);
  std::string SearchWords::*range;
};
constexpr std::array kMeasures = {LibraryMeasure{"cct", "K", Cct, &SearchWords::cct},
                                  LibraryMeasure{"lm", "lm", Flux, &SearchWords::lm},
                                  LibraryMeasure{"cd", "cd", Intensity, &SearchWords::cd},
                                  LibraryMeasure{"lx", "lx", Illuminance, &SearchWords::lx}};

struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
};

Result<double> ParseEnd(const LibraryMeasure& measure, std::string_view text) {
  const auto number = SplitNumberAndUnit(TrimBlanks(text));
  if (number && (number->unit.empty() || number->unit == measure.unit)) return number->number;
  return WrongUsage("--" + std::string(measure.word),
                    "\"" + std::string(text) + "\" is no number of " + std::string(measure.unit) +
                        "; a range is 3000..3500, 500.. or ..2000");
}

Result<Range> ParseRange(const LibraryMeasure& measure, std::string_view text) {
  const std::size_t dots = text.find("..");
  Range range;
  const std::string_view low = text.substr(0, dots);
  const std::string_view high = dots == std::string_view::npos ? low : text.substr(dots + 2);
  for (const auto& [part, end] : {std::pair(low, &range.low), std::pair(high, &range.high)}) {
    if (TrimBlanks(part).empty() && dots != std::string_view::npos) continue;
    const auto number = ParseEnd(measure, part);
    if (!number) return tl::unexpected(number.error());
    *end = *number;
  }
  if (range.low > range.high) {
    return WrongUsage("--" + std::string(measure.word),
                      "\"" + std::string(text) + "\" holds nothing: it ends below its beginning");
  }
  return range;
}

bool NameHolds(const LibraryLight& entry, const std::string& part) {
  const std::string file = std::filesystem::path(entry.path).stem().string();
  return LowerAscii(entry.light.name).find(part) != std::string::npos ||
         LowerAscii(file).find(part) != std::string::npos;
}

Result<void> KeepMeasured(const SearchWords& words, std::vector<LibraryLight>& lights) {
  for (const LibraryMeasure& measure : kMeasures) {
    const std::string& text = words.*measure.range;
    if (text.empty()) continue;
    const auto range = ParseRange(measure, text);
    if (!range) return tl::unexpected(range.error());
    std::erase_if(lights, [&](const LibraryLight& entry) {
      const Value value = measure.of(entry);
      return !value || *value < range->low || *value > range->high;
    });
  }
  return {};
}

Result<void> KeepKind(const std::string& word, std::vector<LibraryLight>& lights) {
  if (word.empty()) return {};
  const auto kind = LightKindFromName(word);
  if (!kind) {
    const std::string nearest = NearestWord(word, kLightKindNames);
    return WrongUsage("--kind", "\"" + word + "\" is no kind of light" +
                                    (nearest.empty() ? "" : "; did you mean " + nearest + "?"));
  }
  std::erase_if(lights, [&](const LibraryLight& entry) { return entry.light.kind != *kind; });
  return {};
}

void SortByMeasure(const LibraryMeasure& measure, bool down, std::vector<LibraryLight>& lights) {
  std::ranges::stable_sort(lights, [&](const LibraryLight& a, const LibraryLight& b) {
    const Value x = measure.of(a);
    const Value y = measure.of(b);
    if (!x || !y) return x.has_value() && !y.has_value();
    return down ? *x > *y : *x < *y;
  });
}

Result<void> Sort(const std::string& word, std::vector<LibraryLight>& lights) {
  const bool down = word.starts_with('-');
  const std::string order = down ? word.substr(1) : word;
  const auto by_text = [&](const auto& text_of) {
    std::ranges::stable_sort(lights, [&](const LibraryLight& a, const LibraryLight& b) {
      return down ? text_of(b) < text_of(a) : text_of(a) < text_of(b);
    });
  };
  for (const LibraryMeasure& measure : kMeasures) {
    if (measure.word == order) return SortByMeasure(measure, down, lights), Result<void>{};
  }
  if (order.empty() || order == "name") {
    by_text([](const LibraryLight& entry) { return LowerAscii(entry.light.name); });
  } else if (order == "kind") {
    by_text([](const LibraryLight& entry) { return LightKindName(entry.light.kind); });
  } else if (order == "time") {
    by_text([](const LibraryLight& entry) { return entry.provenance.time; });
  } else {
    return WrongUsage("--sort", "\"" + word +
                                    "\" is no order; use name, kind, cct, lm, cd, lx or "
                                    "time, with a - before it from large to small");
  }
  return {};
}

}  // namespace

Result<std::vector<LibraryLight>> Search(std::vector<LibraryLight> lights,
                                         const SearchWords& words) {
  if (auto kept = KeepMeasured(words, lights); !kept) return Propagate(std::move(kept));
  if (auto kept = KeepKind(words.kind, lights); !kept) return Propagate(std::move(kept));
  if (!words.name.empty()) {
    const std::string part = LowerAscii(words.name);
    std::erase_if(lights, [&](const LibraryLight& entry) { return !NameHolds(entry, part); });
  }
  if (auto sorted = Sort(words.sort, lights); !sorted) return Propagate(std::move(sorted));
  return lights;
}

}  // namespace lightcal::app
