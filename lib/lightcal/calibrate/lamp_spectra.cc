// SPDX-License-Identifier: Apache-2.0
#include "lightcal/calibrate/lamp_spectra.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "lightcal/fit/model/observations.h"
#include "lightcal/fit/states/state_spectrum.h"

namespace lightcal {
namespace {

bool OfTheLampAlone(const ReadSpectrum& one) {
  const Reading& reading = one.row.reading;
  return reading.lamp == LampState::kOn && !reading.shadow_card && one.row.others_lit.empty();
}

// The lamp's direct light; nothing unless some is left at most wavelengths.
std::optional<Spectrum> LessItsCard(const ReadSpectrum& open, const ReadSpectrum& card) {
  constexpr double kLeft = 0.9;  // of the wavelengths
  if (open.spectrum.wavelengths_nm != card.spectrum.wavelengths_nm) return std::nullopt;
  Spectrum out = fit::SpectrumOfLux(open.spectrum, open.row.reading.illuminance->value());
  const Spectrum walls = fit::SpectrumOfLux(card.spectrum, card.row.reading.illuminance->value());
  std::size_t left = 0;
  for (std::size_t i = 0; i < out.values.size(); ++i) {
    out.values[i] = std::max(0.0, out.values[i] - walls.values[i]);
    left += out.values[i] > 0.0 ? 1 : 0;
  }
  if (static_cast<double>(left) < kLeft * static_cast<double>(out.values.size())) {
    return std::nullopt;
  }
  return out;
}

std::optional<Spectrum> BesideItsCard(const ReadSpectrum& open,
                                      const std::vector<ReadSpectrum>& read) {
  const Reading& reading = open.row.reading;
  if (!reading.illuminance) return std::nullopt;
  const auto card = std::ranges::find_if(read, [&](const ReadSpectrum& one) {
    return one.row.reading.meter == reading.meter && fit::IsCardOf(one.row, reading);
  });
  return card == read.end() ? std::nullopt : LessItsCard(open, *card);
}

double DistanceOf(const Reading& reading) {
  return reading.distance ? reading.distance->value() : std::numeric_limits<double>::infinity();
}

struct Best {
  NamedSpectrum named;
  bool beside_card = false;
  double distance_m = 0.0;
};

}  // namespace

std::vector<NamedSpectrum> LampSpectra(const std::vector<ReadSpectrum>& read) {
  std::vector<Best> best;
  for (const ReadSpectrum& one : read) {
    if (!OfTheLampAlone(one)) continue;
    const Reading& reading = one.row.reading;
    const std::optional<Spectrum> alone = BesideItsCard(one, read);
    Best here{{reading.light, reading.spectrum_file, alone.value_or(one.spectrum), reading.state,
               one.doubt},
              alone.has_value(),
              DistanceOf(reading)};
    const auto known = std::ranges::find_if(best, [&](const Best& other) {
      return other.named.light == reading.light && SameState(other.named.state, reading.state);
    });
    if (known == best.end()) {
      best.push_back(std::move(here));
    } else if (here.beside_card != known->beside_card ? here.beside_card
                                                      : here.distance_m < known->distance_m) {
      *known = std::move(here);
    }
  }
  std::vector<NamedSpectrum> out;
  for (Best& one : best) out.push_back(std::move(one.named));
  return out;
}

}  // namespace lightcal
