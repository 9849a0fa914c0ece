// SPDX-License-Identifier: Apache-2.0
// A Torch Bearer spectrometer that never existed, as its protocol describes it.
#pragma once

#include <cmath>
#include <memory>

#include "hex_bytes.h"
#include "stream_instrument.h"
#include "torchbearer_encoder.h"

namespace lightcal::test {

// A black body of 2856 K (CIE illuminant A) from 340 to 1050 nm, times 10^6 as the device sends it;
// `peak` W m^-2 nm^-1 at 1015 nm, where it peaks.   M(l) = l^-5 / (exp(c2/(l T)) - 1)
inline std::vector<std::uint16_t> IlluminantASamples(double peak) {
  constexpr double kC2 = 1.4388e-2;
  constexpr double kT = 2848.0 * 1.4388 / 1.435;  // CIE 15 defines A as 2848 K where c2 was 1.435
  const auto radiance = [](int nm) {
    const double metres = nm * 1e-9;
    return std::pow(metres, -5.0) / std::expm1(kC2 / (metres * kT));
  };
  const double highest = radiance(1015);
  std::vector<std::uint16_t> samples;
  for (int nm = 340; nm <= 1050; ++nm) {
    samples.push_back(static_cast<std::uint16_t>(std::lround(1e6 * peak * radiance(nm) / highest)));
  }
  return samples;
}

struct TorchSetting {
  std::string id = "Y21B7W-0042";
  std::vector<TorchMeasurement> measurements;  // one a moment while it streams, the last for ever
  bool automatic = true;                       // its exposure
  bool acknowledges_stop = true;
  // A whole message that is said instead of the answer to this type, as often as `times` says; ""
  // is silence.
  unsigned faulty_type = 0;
  std::string instead;
  int times = 0;
  bool pulls_the_plug = false;  // with the faulty answer
};

inline TorchMeasurement IlluminantA() {
  TorchMeasurement measurement;
  measurement.samples = IlluminantASamples(0.05);
  return measurement;
}
inline TorchMeasurement Exposed(unsigned status) {
  TorchMeasurement measurement = IlluminantA();
  measurement.status = status;
  return measurement;
}

class FakeTorchbearer {
 public:
  explicit FakeTorchbearer(TorchSetting setting) : setting_(std::move(setting)) {}

  // Takes whole requests: CC 01 length type data sum 0D 0A.
  Spoken operator()(std::string& unread) {
    Spoken spoken;
    while (unread.size() >= 9) {
      const auto length = static_cast<unsigned char>(unread[2]);
      if (unread.size() < length) break;
      Answer(unread.substr(0, length), spoken);
      unread.erase(0, length);
    }
    if (streaming_ && !spoken.pulls_the_plug && spoken.bytes.empty()) Measure(spoken);
    return spoken;
  }

 private:
  static constexpr unsigned kStop = 0x04;
  static constexpr unsigned kData = 0x33;

  bool Faulty(unsigned type, Spoken& spoken) {
    if (type != setting_.faulty_type || setting_.times <= 0) return false;
    --setting_.times;
    spoken.bytes += setting_.instead;
    spoken.pulls_the_plug = setting_.pulls_the_plug;
    return true;
  }

  void Answer(const std::string& request, Spoken& spoken) {
    const auto type = static_cast<unsigned char>(request[5]);
    if (type == kData) streaming_ = true;
    if (type == kStop) streaming_ = false;
    if (type == kData || Faulty(type, spoken)) return;
    const auto say = [&](const devices::Bytes& data) {
      spoken.bytes += AsText(TorchMessage(type, data));
    };
    switch (type) {
      case 0x08: {
        const auto id = devices::AsBytes(setting_.id);
        return say(devices::Bytes(id.begin(), id.end()));
      }
      case 0x0F:
        return say(TorchRange(340, 1050));
      case 0x0B:
        return say({setting_.automatic ? std::byte{1} : std::byte{0}});
      case 0x0A:
        setting_.automatic = request[6] == '\x01';
        return say({std::byte{0}});
      case kStop:
        if (setting_.acknowledges_stop && last_was_good_) say({});
        return;
      default:
        return;
    }
  }

  void Measure(Spoken& spoken) {
    if (setting_.measurements.empty() || Faulty(kData, spoken)) return;
    const TorchMeasurement& measurement = setting_.measurements[next_];
    if (next_ + 1 < setting_.measurements.size()) ++next_;
    last_was_good_ = measurement.status == 0;
    spoken.bytes += AsText(TorchMessage(kData, TorchData(measurement)));
  }

  TorchSetting setting_;
  std::size_t next_ = 0;
  bool streaming_ = false;
  bool last_was_good_ = false;
};

}  // namespace lightcal::test
