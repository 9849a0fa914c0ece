// SPDX-License-Identifier: Apache-2.0
// Lights, gels and cameras as `lightcal match` and its neighbours take them from what is typed.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "console.h"
#include "lightcal/colorimetry/spectrum.h"
#include "lightcal/core/result.h"
#include "lightcal/fit/states/state_answer.h"
#include "lightcal/records/camera_sensitivities.h"
#include "lightcal/records/fitted_light.h"
#include "lightcal/records/gel.h"

namespace lightcal::app {

// One light with its spectrum.
struct MatchLight {
  std::string title;
  Spectrum spectrum;
  bool measured = true;              // false: an illuminant by definition
  std::optional<FittedLight> light;  // of a light.json or a session
  std::vector<InputFile> inputs;
  std::string session{};            // tells its lights from another fit's of the same names
  std::optional<StateAnswer> at{};  // the state of its controls that is meant
};

// What beside the source may be typed of it.
struct MatchLightWords {
  std::string source;       // FILE, illuminant:A, 5600K, light.json, session
  std::string column;       // of a file with several spectra
  std::string light;        // of a session or light.json with several lights
  std::string spectrum;     // of a light.json, which holds none
  bool may_assume = false;  // a colour alone stands for the black body or daylight of its CCT
  // A lamp that was read at states of its controls is left without a spectrum, to be set by them.
  bool by_states = false;
  bool by_color = false;  // a light of a light.json or session is left without a spectrum
};
// Refused: no_spectrum (a light.json or session without one), several_spectra, several_lights, and
// as ReadSpectrumSource, LightsIn and CalibrateSession. Warns spectrum_assumed, spectrum_truncated,
// color_disagrees (a spectrum given for a light that was measured to have another colour).
[[nodiscard]] Result<MatchLight> ReadMatchLight(const MatchLightWords& words, Console& console);

// A gel file, or the demonstration filters where none is named (warns demonstration_gels).
[[nodiscard]] Result<GelSet> ReadGels(const std::string& file, Console& console);

// "FILE.csv:L204+L205", "L204" (of `file`), "FILE.csv" alone: every gel by itself.
struct GelChoice {
  GelSet set;
  std::vector<std::vector<std::size_t>> stacks;
};
[[nodiscard]] Result<GelChoice> ReadGelChoice(const std::string& text, const std::string& file,
                                              Console& console);

// "all": every camera that ships; "observer" or nothing: none; a file, or a folder of files, of
// sensitivities; else a camera's name. Refused: bad_sensitivities, no_cameras, unknown_camera,
// ambiguous_camera.
[[nodiscard]] Result<std::vector<CameraSensitivities>> ReadCameras(const std::string& words);

}  // namespace lightcal::app
