// SPDX-License-Identifier: Apache-2.0
#include "picture_words.h"

#include <algorithm>
#include <optional>
#include <string_view>

#include "lightcal/core/nearest_word.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/units_text.h"

namespace lightcal::app {

Result<LuminanceConvention> ParseConvention(const std::string& option, const std::string& word) {
  if (word == "photometric") return LuminanceConvention::kPhotometric;
  if (word == "radiometric") return LuminanceConvention::kRadiometric;
  if (word == "radiance") return LuminanceConvention::kRadiance;
  return WrongUsage(option, "\"" + word + "\" is none of photometric, radiometric, radiance");
}

Result<Projection> ParseProjection(const std::string& option, const std::string& word) {
  if (const auto projection = ProjectionByName(word)) return *projection;
  const std::string near = NearestWord(word, kProjectionWords);
  return WrongUsage(option, "\"" + word + "\" is none of rect, latlong, equidistant, equisolid" +
                                (near.empty() ? "" : "; did you mean " + near + "?"));
}

Result<double> ParseShare(const std::string& option, const std::string& text) {
  std::string_view digits = TrimBlanks(text);
  const bool percent = digits.ends_with('%');
  if (percent) digits.remove_suffix(1);
  const auto number = ParseNumber(TrimBlanks(digits));
  const double share = number ? *number / (percent ? 100.0 : 1.0) : -1.0;
  if (!(share > 0.0 && share < 1.0)) {
    return WrongUsage(option, "\"" + text + "\" is not a share such as 2% or 0.02");
  }
  return share;
}

Result<LampsOnSet> ParseLamps(const std::string& mains, const std::string& pwm) {
  LampsOnSet lamps;
  if (mains == "50" || mains == "60") {
    lamps.mains = {{.frequency_hz = mains == "50" ? 100.0 : 120.0}};
  } else if (mains == "none") {
    lamps.mains.clear();
  } else if (!mains.empty()) {
    return WrongUsage("--mains", "\"" + mains + "\" is none of 50, 60, none");
  }
  if (pwm.empty()) return lamps;
  const std::string_view text(pwm);
  const std::size_t comma = std::min(text.find(','), text.size());
  const auto frequency = SplitNumberAndUnit(text.substr(0, comma));
  const auto duty = comma < text.size() ? ParseNumber(text.substr(comma + 1)) : std::optional(0.5);
  const bool known = frequency && duty && (frequency->unit.empty() || frequency->unit == "Hz") &&
                     frequency->number > 0.0 && *duty > 0.0 && *duty <= 1.0;
  if (!known) {
    return WrongUsage("--pwm", "\"" + pwm + "\" is not HZ or HZ,DUTY, e.g. 400Hz or 400,0.25");
  }
  lamps.pwm = LampFlicker{frequency->number, *duty};
  return lamps;
}

}  // namespace lightcal::app
