// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/exposure_tags.h"

#include <cmath>
#include <cstddef>
#include <functional>

#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/exposure_grid.h"

namespace lightcal::devices {
namespace {

// Labels stray from the grid by 6.7 % in time and 5.5 % in the square of the f-number.
constexpr double kLabelsStrayStops = 0.12;
// A place of the half stops and one of the thirds are up to a sixth apart, and cameras that turn
// their dial in one write a tag in the other (f/4.5 and Av 4.5, which is 4.757): one value.
constexpr double kGridsStrayStops = 1.0 / 6.0 + 0.01;
// Within the digits of either tag both say the same number.
constexpr double kSameNumberStops = 0.02;

struct Range {
  double low, high;
  [[nodiscard]] bool Holds(double v) const { return v >= low && v <= high; }  // false for NaN
};
constexpr Range kTimes{1e-7, 1e6};
constexpr Range kFNumbers{0.3, 1000.0};
constexpr Range kIsos{0.1, 1e8};
constexpr Range kTStops{0.3, 1000.0};
constexpr Range kAngles{0.1, 360.0};
constexpr Range kFrameRates{0.01, 1e5};
// A lens lets through at most everything and hardly less than four tenths of it: T/N.
constexpr Range kTOverN{0.97, 1.6};

std::optional<double> Plausible(std::optional<double> v, Range range) {
  return v && range.Holds(*v) ? v : std::nullopt;
}

struct Believed {
  std::optional<double> value;
  bool snapped = false;
};

// One quantity q with a label and an APEX tag; stops(q) is its APEX value.
struct Scale {
  const char* name;
  Range range;
  std::function<double(double)> stops, from_stops;
  std::function<std::optional<double>(double)> of_label;
  // Whether tags that contradict each other leave a value: what lies between them.
  bool may_disagree = false;
};

Believed FromLabel(double label, const Scale& scale) {
  const std::optional<double> truth = scale.of_label(label);
  return {truth.value_or(label), truth && std::abs(*truth / label - 1.0) > 1e-4};
}

Believed FromApex(double apex, const Scale& scale) {
  return {scale.from_stops(ApexOnGrid(apex).value_or(apex)), false};
}

Believed Believe(std::optional<double> written_label, std::optional<double> written_apex,
                 const Scale& scale, const std::string& subject, Warnings& warnings) {
  const std::optional<double> label = Plausible(written_label, scale.range);
  const double apex = written_apex.value_or(0.0);
  const bool has_apex = written_apex && Plausible(scale.from_stops(apex), scale.range);
  // 0 is what programs write that know nothing: believed only beside a label that agrees.
  const bool apex_is_default = has_apex && apex == 0.0;
  if (!label) return has_apex && !apex_is_default ? FromApex(apex, scale) : Believed{};

  const double label_stops = scale.stops(*label);
  const double apart = has_apex ? std::abs(apex - label_stops) : 0.0;
  if (!has_apex || (apex_is_default && apart > kLabelsStrayStops)) return FromLabel(*label, scale);
  if (apart > kLabelsStrayStops && apart <= kGridsStrayStops) {
    return {scale.from_stops(ApexOnGrid(apex).value_or(apex)), false};
  }
  if (apart > kLabelsStrayStops && scale.may_disagree) {
    warnings.push_back({"exposure_tags_disagree", subject,
                        std::string("its two tags of the ") + scale.name + " say " +
                            RoundedText(*label, 4) + " and " +
                            RoundedText(scale.from_stops(apex), 4) +
                            "; what lies between them is taken, and the absolute scale is as much "
                            "wider: give it, or a spot reading ({merge.anchor})"});
    return {scale.from_stops((apex + label_stops) / 2.0), true};
  }
  if (apart > kLabelsStrayStops) {
    warnings.push_back({"exposure_tags_disagree", subject,
                        std::string("its two tags of the ") + scale.name + " say " +
                            RoundedText(*label, 4) + " and " +
                            RoundedText(scale.from_stops(apex), 4) +
                            "; neither is believed: give it with the session or the command line"});
    return {};
  }
  if (const auto on_grid = ApexOnGrid(apex)) {
    return {scale.from_stops(*on_grid), std::abs(*on_grid - label_stops) > 1e-4};
  }
  if (apart < kSameNumberStops) return FromLabel(*label, scale);
  return {scale.from_stops(apex), false};
}

// A shutter angle is exact where times are labels: 172.8 degrees at 24 frames a second are 1/50 s.
std::optional<double> TimeOfAngle(const WrittenExposure& written) {
  const auto angle = Plausible(written.shutter_angle_deg, kAngles);
  const auto rate = Plausible(written.frames_per_second, kFrameRates);
  if (!angle || !rate) return std::nullopt;
  return *angle / 360.0 / *rate;
}

// The time by the angle, unless the time that is written contradicts it.
void PreferAngle(const WrittenExposure& written, FrameExposure& exposure,
                 const std::string& subject, Warnings& warnings) {
  const auto by_angle = TimeOfAngle(written);
  if (!by_angle) return;
  const auto label = Plausible(written.exposure_time_s, kTimes);
  if (label && std::abs(std::log2(*label / *by_angle)) > kLabelsStrayStops) {
    warnings.push_back({"exposure_tags_disagree", subject,
                        "its exposure time says " + RoundedText(*label, 4) +
                            " s, its shutter angle at its frame rate " + RoundedText(*by_angle, 4) +
                            " s; neither is believed: give it with the session or the command "
                            "line"});
    exposure.time.reset();
    return;
  }
  exposure.time = Seconds(*by_angle);
  exposure.time_snapped = false;
}

void TakeTStop(const WrittenExposure& written, FrameExposure& exposure, const std::string& subject,
               Warnings& warnings) {
  const auto t_stop = Plausible(written.t_stop, kTStops);
  if (!t_stop) return;
  if (exposure.f_number && !kTOverN.Holds(*t_stop / *exposure.f_number)) {
    warnings.push_back(
        {"exposure_tags_disagree", subject,
         "no lens of f/" + RoundedText(*exposure.f_number, 3) + " is T" + RoundedText(*t_stop, 3) +
             "; neither is believed: give {exposure.f_number} or {exposure.t_stop}"});
    exposure.f_number.reset();
    return;
  }
  exposure.t_stop = t_stop;
}

const Scale& TimeScale() {
  static const Scale scale{"exposure time in seconds",
                           kTimes,
                           [](double t) { return -std::log2(t); },
                           [](double tv) { return std::exp2(-tv); },
                           [](double t) -> std::optional<double> {
                             const auto truth = TimeOfLabel(Seconds(t));
                             return truth ? std::optional(truth->value()) : std::nullopt;
                           },
                           false};
  return scale;
}

const Scale& FNumberScale() {
  static const Scale scale{"f-number",
                           kFNumbers,
                           [](double n) { return 2.0 * std::log2(n); },
                           [](double av) { return std::exp2(av / 2.0); },
                           FNumberOfLabel,
                           true};
  return scale;
}

}  // namespace

std::optional<double> IsoOfTags(const IsoTags& tags) {
  const auto says = [](std::optional<double> v) { return v && *v > 0.0 && *v != kIsoIsElsewhere; };
  // What SensitivityType names: 1 SOS, 2 REI, 3 ISO speed, 4 to 7 several of them, which are alike.
  const int type = static_cast<int>(tags.type.value_or(0.0));
  const bool standard = type == 1 || type == 4 || type == 5 || type == 7;
  const bool recommended = type == 2 || type == 4 || type == 6 || type == 7;
  if (says(tags.photographic)) return tags.photographic;
  if (recommended && says(tags.recommended)) return tags.recommended;
  if (standard && says(tags.standard_output)) return tags.standard_output;
  if (type >= 3 && says(tags.iso_speed)) return tags.iso_speed;
  for (const auto& any : {tags.recommended, tags.standard_output, tags.iso_speed}) {
    if (says(any)) return any;
  }
  return std::nullopt;
}

FrameExposure ExposureFromTags(const WrittenExposure& written, const std::string& subject,
                               Warnings& warnings) {
  FrameExposure exposure;
  exposure.written = written;
  const Believed time =
      Believe(written.exposure_time_s, written.shutter_apex, TimeScale(), subject, warnings);
  if (time.value) exposure.time = Seconds(*time.value);
  exposure.time_snapped = time.snapped;
  const Believed f_number =
      Believe(written.f_number, written.aperture_apex, FNumberScale(), subject, warnings);
  exposure.f_number = f_number.value;
  exposure.f_number_snapped = f_number.snapped;
  exposure.iso = written.iso == kIsoIsElsewhere ? std::nullopt : Plausible(written.iso, kIsos);
  PreferAngle(written, exposure, subject, warnings);
  TakeTStop(written, exposure, subject, warnings);
  return exposure;
}

std::string IsoTimeFromExif(const std::string& exif) {
  constexpr std::string_view kShape = "dddd:dd:dd dd:dd:dd";
  if (exif.size() < kShape.size()) return "";
  std::string time = exif.substr(0, kShape.size());
  for (std::size_t i = 0; i < kShape.size(); ++i) {
    const bool digit = time[i] >= '0' && time[i] <= '9';
    if (kShape[i] == 'd' ? !digit : time[i] != kShape[i]) return "";
  }
  if (time.starts_with("0000")) return "";
  time[4] = time[7] = '-';
  time[10] = 'T';
  return time;
}

}  // namespace lightcal::devices
