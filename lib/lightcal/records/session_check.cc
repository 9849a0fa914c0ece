// SPDX-License-Identifier: Apache-2.0
// What a session must obey, whoever made it.
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include "lightcal/records/reading_codec.h"
#include "lightcal/records/session_rules.h"
#include "lightcal/records/session_toml.h"

namespace lightcal {
namespace records {
namespace {

template <class Named>
std::optional<NameFault> NameFaultAmong(const std::vector<Named>& all, std::size_t i,
                                        std::string_view what) {
  const std::string& name = all[i].name;
  if (name.empty()) return NameFault{"bad_session", "name must not be empty"};
  const auto here = all.begin() + static_cast<std::ptrdiff_t>(i);
  if (std::find_if(all.begin(), here, [&](const Named& n) { return n.name == name; }) == here) {
    return std::nullopt;
  }
  return NameFault{"duplicate_name",
                   std::string(what) + " " + Quoted(name) + " is described twice; rename one"};
}

template <class Described>
std::optional<ReadingFault> FaultOfShape(const Described& light) {
  if (light.width && light.height && light.width->value() == 0.0 && light.height->value() == 0.0) {
    return ReadingFault{"size_m", "size_m = [0, 0] is no rect; one side of 0 makes it a line"};
  }
  if (light.inner && light.outer && *light.outer < *light.inner) {
    return ReadingFault{"inner_deg",
                        "inner_deg exceeds outer_deg; both are half angles: swap them"};
  }
  return std::nullopt;
}

// A direction as it is after loading.
std::string FaultOfUnitVector(const char* key, const std::optional<Vec3>& direction) {
  constexpr double kUnit = 1e-6;
  if (!direction || std::abs(Length(*direction) - 1.0) <= kUnit) return "";
  return std::string(key) + " must be a direction of length 1";
}

std::optional<ReadingFault> FaultOfLight(const LightDescription& light) {
  FieldChecker checker;
  VisitLight(checker, light);
  checker.Keep("aim", FaultOfUnitVector("aim", light.aim));
  checker.Keep("axis", FaultOfUnitVector("axis", light.axis));
  checker.Keep(DisagreementIn(light));
  for (const StateDescription& one : light.at) {
    VisitAtState(checker, one);
    checker.Keep(DisagreementIn(one));
  }
  return checker.fault();
}

tl::unexpected<Error> BadSession(const std::string& subject, const std::string& message) {
  return Refused("bad_session", subject, message);
}

template <class Named>
Result<void> CheckNames(const std::vector<Named>& all) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (auto fault = FaultOfName(all, i)) {
      return Refused(std::move(fault->code), all[i].name, std::move(fault->message));
    }
  }
  return {};
}

}  // namespace

std::optional<NameFault> FaultOfName(const std::vector<LightDescription>& all, std::size_t i) {
  return NameFaultAmong(all, i, "light");
}
std::optional<NameFault> FaultOfName(const std::vector<MeterDescription>& all, std::size_t i) {
  return NameFaultAmong(all, i, "meter");
}

std::optional<ReadingFault> DisagreementIn(const LightDescription& light) {
  if (light.in_time.flicker_depth && light.in_time.pwm_duty) {
    return ReadingFault{"pwm_duty",
                        "pwm_duty describes pulses and flicker_depth a smooth ripple; keep one"};
  }
  if (light.beam && light.field && *light.field < *light.beam) {
    return ReadingFault{"field_deg",
                        "field_deg (10 % of the peak) is below beam_deg (50 %); swap them"};
  }
  if (!light.distribution_file.empty() && light.kind != LightKind::kPhotometric) {
    return ReadingFault{
        "distribution",
        "distribution names a photometric file, which goes with kind = \"photometric\""};
  }
  if (light.name.find('/') != std::string::npos) {
    return ReadingFault{"name", "name = " + Quoted(light.name) +
                                    " holds a slash; names become parts of file names"};
  }
  if (light.inner && !light.outer) {
    return ReadingFault{"inner_deg",
                        "inner_deg is where a cone begins to fall that outer_deg ends; give both, "
                        "or neither and read off the axis"};
  }
  return FaultOfShape(light);
}

std::optional<ReadingFault> DisagreementIn(const StateDescription& one) {
  constexpr std::array kOther = {LightKind::kDirectional, LightKind::kPhotometric,
                                 LightKind::kDome};
  if (one.kind && std::ranges::find(kOther, *one.kind) != kOther.end()) {
    return ReadingFault{"kind",
                        "kind of a [[light.at]] is one with a candela of its own: point, spot, "
                        "sphere, disk, rect or tube"};
  }
  return FaultOfShape(one);
}

std::optional<ReadingFault> DisagreementIn(const MeterDescription& meter) {
  if (meter.calibration_relative && meter.repeatability_relative) {
    return ReadingFault{"repeatability_relative",
                        "calibration_relative says how much of sigma_relative all readings share, "
                        "repeatability_relative what each has beside it; keep one"};
  }
  if (meter.calibration_relative && *meter.calibration_relative > meter.sigma_relative) {
    return ReadingFault{
        "calibration_relative",
        "calibration_relative exceeds sigma_relative, of which it is a part; give the "
        "meter's whole sigma_relative beside it"};
  }
  if (meter.name == kDataSheetMeter) {
    return ReadingFault{"name",
                        "the name data_sheet is reserved for figures a manufacturer prints and "
                        "needs no [[meter]]; choose another"};
  }
  return std::nullopt;
}

}  // namespace records

std::optional<Session> SetFaultyAside(const Session& session) {
  std::optional<Session> sound;
  const auto set_aside = [&](std::vector<SessionReading> Session::* rows) {
    for (std::size_t i = 0; i < (session.*rows).size(); ++i) {
      const SessionReading& row = (session.*rows)[i];
      if (row.reading.distance && row.reading.distance->value() < 0.0) continue;
      auto fault = records::FaultInMemory(row.reading);
      if (!fault) continue;
      if (!sound) sound = session;
      Reading nothing;
      nothing.light = row.reading.light;
      ((*sound).*rows)[i] = {std::move(nothing), row.where, {}, -1, std::move(fault->message)};
    }
  };
  set_aside(&Session::readings);
  set_aside(&Session::state_readings);
  return sound;
}

Result<void> CheckSession(const Session& session) {
  records::FieldChecker around;
  if (session.room) records::VisitRoom(around, *session.room);
  around.Number("haze_per_m", session.haze_per_metre, records::kNotNegative);
  if (around.fault()) return records::BadSession("room", around.fault()->message);
  if (auto names = records::CheckNames(session.lights); !names) return names;
  if (auto names = records::CheckNames(session.meters); !names) return names;
  for (const LightDescription& light : session.lights) {
    if (auto fault = records::FaultOfLight(light)) {
      return records::BadSession(light.name, fault->message);
    }
  }
  for (const MeterDescription& meter : session.meters) {
    records::FieldChecker checker;
    records::VisitMeter(checker, meter);
    checker.Keep(records::DisagreementIn(meter));
    if (checker.fault()) return records::BadSession(meter.name, checker.fault()->message);
  }
  std::optional<Error> strange;
  VisitReadings(session, [&](const SessionReading& row) {
    if (strange) return;
    if (auto name = records::FindStrangeName(session, row.reading)) {
      strange =
          Error{ErrorKind::kRefused, std::move(name->code), row.where, std::move(name->message)};
    }
  });
  if (strange) return tl::unexpected(*std::move(strange));
  return {};
}

}  // namespace lightcal
