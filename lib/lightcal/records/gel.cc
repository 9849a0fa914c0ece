// SPDX-License-Identifier: Apache-2.0
#include "lightcal/records/gel.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>

#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"

namespace lightcal {
namespace {

constexpr double kLargestTransmittance = 1.02;  // a spectrophotometer's noise over clear film
constexpr std::size_t kMostListed = 6;

// What the trade says -> what catalogues print.
constexpr std::array<std::pair<std::string_view, std::string_view>, 11> kTradeWords = {{
    {"1/1", "full"},
    {"1/2", "half"},
    {"1/4", "quarter"},
    {"1/8", "eighth"},
    {"3/4", "three quarter"},
    {"cto", "c t orange"},
    {"ctb", "c t blue"},
    {"cts", "c t straw"},
    {"plusgreen", "plus green"},
    {"minusgreen", "minus green"},
    {"colour", "color"},
}};

// Lower-case words of letters and digits; "0.3ND" -> 0.3 nd.
std::vector<std::string> GelWords(std::string_view text) {
  std::string plain = LowerAscii(text);
  for (const auto& [trade, catalogue] : kTradeWords) {
    for (std::size_t at = 0; (at = plain.find(trade, at)) != std::string::npos;
         at += catalogue.size()) {
      plain.replace(at, trade.size(), catalogue);
    }
  }
  std::vector<std::string> words;
  char last = ' ';
  for (std::size_t i = 0; i < plain.size(); ++i) {
    const char c = plain[i];
    const auto digit = [](char d) { return d >= '0' && d <= '9'; };
    const bool point = c == '.' && i + 1 < plain.size() && digit(plain[i + 1]);
    const bool figure = digit(c) || point;
    const bool part = figure || std::isalpha(static_cast<unsigned char>(c)) != 0;
    if (!part) {
      last = ' ';
      continue;
    }
    const bool last_figure = digit(last) || last == '.';
    if (last == ' ' || last_figure != figure) words.emplace_back();
    words.back() += c;
    last = c;
  }
  for (std::string& word : words) {
    if (word.starts_with('.')) word.insert(0, "0");
  }
  return words;
}

// "L204" -> 204
std::string_view NumberIn(std::string_view id) {
  const std::size_t first = id.find_first_of("0123456789");
  return first == std::string_view::npos ? std::string_view() : id.substr(first);
}

std::string TitlesOf(const GelSet& set, const std::vector<std::size_t>& found) {
  std::vector<std::string> titles;
  for (const std::size_t i : found) {
    if (titles.size() == kMostListed) break;
    titles.push_back(GelTitle(set.gels[i]));
  }
  return Joined(titles) + (found.size() > kMostListed ? ", ..." : "");
}

}  // namespace

std::string GelTitle(const Gel& gel) {
  return gel.name.empty() || gel.name == gel.id ? gel.id : gel.id + " " + gel.name;
}

Result<std::size_t> FindGel(const GelSet& set, std::string_view words) {
  const std::string wanted = LowerAscii(TrimBlanks(words));
  const auto only = [&](const auto& fits) {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < set.gels.size(); ++i) {
      if (fits(set.gels[i])) found.push_back(i);
    }
    return found;
  };
  const std::vector<std::string> parts = GelWords(wanted);
  for (const auto& found :
       {only([&](const Gel& g) { return LowerAscii(g.id) == wanted; }),
        only([&](const Gel& g) { return !wanted.empty() && NumberIn(g.id) == wanted; }),
        only([&](const Gel& g) { return !parts.empty() && GelWords(g.name) == parts; })}) {
    if (found.size() == 1) return found.front();
  }
  const auto holding = only([&](const Gel& g) {
    const std::vector<std::string> all = GelWords(g.id + " " + g.name);
    return !parts.empty() && std::ranges::all_of(parts, [&](const std::string& part) {
      return std::ranges::find(all, part) != all.end();
    });
  });
  if (holding.size() == 1) return holding.front();
  const std::string typed(words);
  if (holding.size() > 1) {
    return Refused("ambiguous_gel", typed,
                   "may be " + TitlesOf(set, holding) + "; give its number");
  }
  std::vector<std::string> names;
  for (const Gel& gel : set.gels) {
    names.push_back(LowerAscii(gel.id));
    names.push_back(LowerAscii(gel.name));
  }
  const std::vector<std::string_view> views(names.begin(), names.end());
  const std::string nearest = NearestWord(wanted, views);
  const auto at = std::ranges::find(names, nearest);
  const std::string hint =
      nearest.empty() || at == names.end()
          ? ""
          : "; did you mean " +
                GelTitle(set.gels[static_cast<std::size_t>(at - names.begin()) / 2]) + "?";
  return Refused(
      "unknown_gel", typed,
      "is none of the " + std::to_string(set.gels.size()) + " gels of " + set.source + hint);
}

std::string FaultOf(const Gel& gel) {
  if (gel.wavelengths_nm.size() < 2 || gel.wavelengths_nm.size() != gel.transmittance.size()) {
    return "holds fewer than two wavelengths";
  }
  for (std::size_t i = 0; i < gel.wavelengths_nm.size(); ++i) {
    if (!std::isfinite(gel.wavelengths_nm[i]) ||
        (i > 0 && !(gel.wavelengths_nm[i] > gel.wavelengths_nm[i - 1]))) {
      return "its wavelengths do not increase";
    }
    if (!(gel.transmittance[i] >= 0.0 && gel.transmittance[i] <= kLargestTransmittance)) {
      return "lets " + ShortestText(gel.transmittance[i]) + " through at " +
             ShortestText(gel.wavelengths_nm[i]) +
             " nm; a transmittance is between 0 and 1, or 0 and 100 in percent";
    }
  }
  constexpr double kBlueSide = 450.0;
  constexpr double kRedSide = 650.0;
  if (gel.wavelengths_nm.front() > kBlueSide || gel.wavelengths_nm.back() < kRedSide) {
    return "covers " + ShortestText(gel.wavelengths_nm.front()) + " to " +
           ShortestText(gel.wavelengths_nm.back()) + " nm; 450 to 650 nm at least are needed";
  }
  return {};
}

}  // namespace lightcal
