// SPDX-License-Identifier: Apache-2.0
// lightcal camera: pictures of known things -> what is known of a camera.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "calibration_options.h"
#include "clock.h"
#include "commands.h"
#include "input_files.h"
#include "lightcal/calibrate/camera/calibrate_camera.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/core/uncertain.h"
#include "lightcal/records/camera_profile.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "lightcal_devices/disk_sources.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

struct CameraOptions {
  std::string session, output;
  bool force = false;
};

std::string U95OfSigma(double sigma) { return "± " + PercentText(kZ95 * sigma); }

void AddScale(const CameraScale& scale, std::vector<std::vector<std::string>>& rows) {
  for (const ScaleReading& reading : scale.readings) {
    const auto kind = kScaleReadingWords[static_cast<std::size_t>(reading.kind)];
    rows.push_back({std::string(kind) + " reading, " + reading.frames,
                    "k = " + RoundedText(reading.full_scale_constant, 4),
                    U95OfSigma(reading.sigma_relative)});
  }
  rows.push_back({scale.readings.empty() ? "scale by ISO speed (prior)" : "scale",
                  "k = " + RoundedText(scale.full_scale_constant, 4),
                  U95OfSigma(scale.sigma_relative)});
}

std::string Table(const CameraProfile& profile) {
  std::vector<std::vector<std::string>> rows;
  AddScale(profile.scale, rows);
  if (profile.color) {
    const auto source = kColorMatrixWords[static_cast<std::size_t>(profile.color->source)];
    const auto& color = *profile.color;
    rows.push_back({"colour matrix", std::string(source),
                    color.delta_e_mean
                        ? "ΔE' " + RoundedText(*color.delta_e_mean, 2) + " mean, " +
                              RoundedText(color.delta_e_max.value_or(0.0), 2) + " max"
                        : ""});
  } else {
    rows.push_back({"colour matrix", "unknown: green stands for luminance", ""});
  }
  for (const CameraNoise& one : profile.noise) {
    rows.push_back({"noise, ISO " + RoundedText(one.iso, 4),
                    RoundedText(1.0 / one.noise.scale, 3) + " e at full scale, " +
                        RoundedText(std::sqrt(one.noise.offset) / one.noise.scale, 2) + " e read",
                    ""});
  }
  for (const CameraFlat& flat : profile.flats) {
    const double corner = 1.0 + flat.channels[1][0] + flat.channels[1][1] + flat.channels[1][2];
    rows.push_back({"flat field, f/" + RoundedText(flat.f_number, 2),
                    "corners keep " + PercentText(corner, 3), U95OfSigma(flat.sigma_relative)});
  }
  for (const CameraDark& dark : profile.darks) {
    rows.push_back({"dark, ISO " + RoundedText(dark.iso, 4) + ", " +
                        RoundedText(dark.exposure.value(), 2) + " s",
                    "black " + RoundedText(dark.black[1], 2) + " of full scale, " +
                        std::to_string(dark.hot_pixels.size() / 2) + " hot pixels",
                    ""});
  }
  for (const CameraNdFilter& filter : profile.nd_filters) {
    const auto& a = filter.attenuation;
    rows.push_back({"filter " + filter.name,
                    "x " + RoundedText(a[0], 4) + " " + RoundedText(a[1], 4) + " " +
                        RoundedText(a[2], 4) + " (R G B)",
                    U95OfSigma(filter.sigma_relative)});
  }
  return TextTable({profile.camera, "found", "95 %"}, rows);
}

Result<void> RunCamera(const CameraOptions& options, Console& console) {
  auto loaded = LoadSession(options.session, InputSources().read_text);
  if (!loaded) return Propagate(std::move(loaded));
  console.Warn(loaded->warnings);
  Session& session = loaded->session;
  Warnings warnings;
  if (!options.output.empty()) {
    const PlannedOutput planned{options.output, "lightcal.camera"};
    if (auto free = CheckOutputs({planned}, options.force); !free) return free;
  }
  const auto roots = RootsOfSession(options.session, console.allows_outside());
  if (!roots) return tl::unexpected(roots.error());
  auto profile = CalibrateCamera(session, InputSourcesWithin(*roots), warnings);
  console.Warn(warnings);
  if (!profile) return Propagate(std::move(profile));
  auto provenance = ProvenanceOf(session, InputSources(), SourceDateIso8601().value_or(""));
  if (!provenance) return Propagate(std::move(provenance));
  profile->provenance = std::move(*provenance);
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  auto json = CameraProfileToJson(*profile);
  if (!json) return Propagate(std::move(json));
  const std::string path =
      options.output.empty()
          ? (std::filesystem::path(DefaultOutputDirectory(session)) / "camera.json").string()
          : options.output;
  if (auto written = WriteOutputs({{path, *json}}, options.force); !written) return written;
  console.Print(Table(*profile));
  console.PrintDocument(DocumentOf(*profile));
  console.Note("wrote " + path);
  if (profile->scale.readings.empty()) {
    console.Note(
        "next: photograph something whose luminance a meter read and name it with use = \"scale\"; "
        "until then the scale is what ISO speeds promise");
  }
  return {};
}

}  // namespace

Run BuildCamera(CLI::App& parser) {
  auto options = std::make_shared<CameraOptions>();
  parser.add_option("session", options->session, "Directory or .toml with [[camera_frames]]")
      ->required();
  parser.add_option("-o,--output", options->output,
                    "The profile, for merge --camera and [[capture]] camera [SESSION/out]");
  parser.add_flag("--force", options->force, "Replace files that lightcal did not write");
  return [options](Console& console) { return RunCamera(*options, console); };
}

}  // namespace lightcal::app
