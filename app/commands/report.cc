// SPDX-License-Identifier: Apache-2.0
// lightcal report: one self-contained page of a session or of fitted lights, and its plots.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>

#include "calibration_options.h"
#include "commands.h"
#include "input_files.h"
#include "lamp_answer.h"
#include "lightcal/calibrate/environments.h"
#include "lightcal/calibrate/states/control_sweeps.h"
#include "lightcal/core/file_name.h"
#include "lightcal/core/joined.h"
#include "lightcal/core/nearest_word.h"
#include "lightcal/records/keep_lights.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/report/page.h"
#include "lightcal/report/plots.h"
#include "lightcal_devices/disk_sources.h"
#include "match/match_sheet_of.h"
#include "minutes_answer.h"
#include "output_files.h"
#include "picture_file.h"
#include "progress_line.h"
#include "report_html.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct ReportOptions {
  CalibrationOptions calibration;  // of a session, which is the input then; its lights of both
  std::string input;
  std::string output;
  std::vector<std::string> plots;  // "distance=FILE.svg"
  std::string light;
  CameraViewWords view;
  std::string spectrum;  // of a light.json's lamp
  bool force = false;
};

struct Source {
  LightFile lights;
  ReportExtras extras;
  std::string title;
  std::string default_output;
};

// ---- --plot NAME=FILE ----

struct PlotRequest {
  std::string name, file;
};

Result<PlotRequest> ParsePlot(const std::string& text) {
  const std::size_t sign = text.find('=');
  const std::string name = text.substr(0, sign);
  const std::vector<std::string_view> known = report::PlotNames();
  if (std::ranges::find(known, name) == known.end()) {
    const std::string nearest = NearestWord(name, known);
    return WrongUsage("--plot", "\"" + name + "\" is no plot" +
                                    (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?") +
                                    " (there are: " + Joined(report::PlotNames()) + ")");
  }
  if (sign == std::string::npos) {
    return WrongUsage("--plot", "say where it goes: " + name + "=FILE.svg or .png");
  }
  PlotRequest request{name, text.substr(sign + 1)};
  if (auto named = CheckPictureName("--plot", request.file); !named) {
    return Propagate(std::move(named));
  }
  return request;
}

Result<std::vector<PlotRequest>> ParsePlots(const std::vector<std::string>& texts) {
  std::vector<PlotRequest> requests;
  for (const std::string& text : texts) {
    auto one = ParsePlot(text);
    if (!one) return Propagate(std::move(one));
    requests.push_back(*std::move(one));
  }
  return requests;
}

// "polar.svg" -> "polar-key.svg", as exports name the photometric files of their lights.
std::string WithLight(const std::string& file, const std::string& light,
                      std::set<std::string>& taken) {
  const fs::path path(file);
  const std::string name =
      DistinctFileName(path.stem().string() + "-" + FileNamePart(light), taken);
  return (path.parent_path() / (name + path.extension().string())).string();
}

Result<void> AddPlot(const PlotRequest& request, const Source& source, const std::string& light,
                     std::vector<OutputFile>& files) {
  std::vector<report::PlotFile> plots =
      report::PlotFilesOf(request.name, source.lights, source.extras);
  std::erase_if(plots, [&](const report::PlotFile& plot) {
    return !light.empty() && !plot.light.empty() && plot.light != light;
  });
  if (plots.empty()) {
    return Refused("no_plot", request.name,
                   light.empty() ? "no light here has what it shows"
                                 : "the light \"" + light + "\" has not what it shows");
  }
  std::set<std::string> taken;
  for (const report::PlotFile& plot : plots) {
    auto picture = PictureFile(
        plots.size() == 1 ? request.file : WithLight(request.file, plot.light, taken), plot.svg);
    if (!picture) return Propagate(std::move(picture));
    files.push_back(*std::move(picture));
  }
  return {};
}

Result<void> CheckDistinct(const std::vector<OutputFile>& files) {
  std::set<std::string> names;
  for (const OutputFile& file : files) {
    if (!names.insert(file.path).second) {
      return WrongUsage("--plot", "\"" + file.path + "\" would be written twice");
    }
  }
  return {};
}

// ---- the input ----

Result<void> CheckLight(const char* option, const std::string& light, const LightFile& file) {
  std::vector<std::string_view> known;
  for (const FittedLight& one : file.lights) known.push_back(one.name);
  if (light.empty() || std::ranges::find(known, light) != known.end()) return {};
  const std::string nearest = NearestWord(light, known);
  return WrongUsage(option, "there is no light \"" + light + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

// The lights that are asked for; those of a session its fit leaves out.
Result<void> KeepAsked(const CalibrationOptions& asked, LightFile& file) {
  for (const auto& [option, names] :
       {std::pair("--lights", &asked.lights), std::pair("--without", &asked.without)}) {
    for (const std::string& name : *names) {
      if (auto known = CheckLight(option, name, file); !known) return known;
    }
  }
  std::erase_if(file.lights, [&](const FittedLight& light) {
    return !IsAsked(light.name, asked.lights, asked.without);
  });
  return {};
}

Result<Source> FromLightFile(const ReportOptions& options, Console& console) {
  const std::string& path = options.input;
  const auto text = ReadInputFile(path);
  if (!text) return tl::unexpected(text.error());
  auto lights = LightFileFromJson(*text, path);
  if (!lights) return Propagate(std::move(lights));
  if (auto kept = KeepAsked(options.calibration, *lights); !kept) return Propagate(std::move(kept));
  // What cannot be read is no reason for no report: the dome is then an even one.
  const auto pictures =
      LoadEnvironments(*lights, fs::path(path).parent_path().string(), devices::DiskSources());
  if (!pictures) {
    console.Warn({"environment_unread", pictures.error().subject, pictures.error().message});
  }
  using Pictures = std::vector<std::shared_ptr<const EnvironmentPicture>>;
  ReportExtras extras = ExtrasOf(*lights, pictures ? *pictures : Pictures{});
  return Source{std::move(*lights), std::move(extras), fs::path(path).stem().string(),
                (fs::path(path).parent_path() / "report.html").string()};
}

Result<Source> FromSession(const ReportOptions& options, Console& console) {
  const std::string& path = options.input;
  CalibrationOptions calibration = options.calibration;
  calibration.session = path;
  auto calibrated = Calibrate(calibration, console);
  if (!calibrated) return Propagate(std::move(calibrated));
  ProgressLine line("planning the next readings", !console.quiet());
  const Progress progress = line.Watcher();
  LampAnswers answers = SessionAnswersOf(*calibrated, path, {}, PartOf(progress, 0.0, 0.5));
  ReportExtras extras =
      ExtrasOf(*calibrated, std::move(answers.engines), ControlSweepsOf(calibrated->lights));
  extras.advice = AdviceOf(answers.lamps, calibrated->session.stem);
  const Session& session = calibrated->session;
  extras.ladders = LaddersOf(session, {}, {}, PartOf(progress, 0.5, 1.0));
  return Source{std::move(calibrated->lights), std::move(extras), TitleOf(session),
                (fs::path(DefaultOutputDirectory(session)) / "report.html").string()};
}

// ---- --match ----

// The lights that a spectrum is known of: the session's own, or the one that is named.
Result<std::vector<MatchLight>> LampsWithSpectra(const ReportOptions& options, const Source& source,
                                                 Console& console) {
  std::vector<MatchLight> lamps;
  for (const FittedLight& light : source.lights.lights) {
    if (!options.light.empty() && light.name != options.light) continue;
    if (!options.spectrum.empty()) {
      MatchLightWords words;
      words.source = options.spectrum;
      auto lamp = ReadMatchLight(words, console);
      if (!lamp) return Propagate(std::move(lamp));
      lamp->title = light.name;
      lamps.push_back(*std::move(lamp));
      continue;
    }
    const auto& spectra = source.extras.spectra;
    const auto own = std::ranges::find(spectra, light.name, &LightSpectrum::light);
    if (own == spectra.end()) continue;
    MatchLight lamp;
    lamp.title = light.name;
    lamp.spectrum = own->spectrum;
    lamp.spectrum.quantity = SpectralQuantity::kRelative;  // at one meter's place
    lamps.push_back(std::move(lamp));
  }
  if (!options.spectrum.empty() && lamps.size() > 1) {
    return WrongUsage("--spectrum", "is of one lamp; say which with --light");
  }
  if (!lamps.empty()) return lamps;
  return Refused("no_spectrum", options.input,
                 "no lamp here was measured with a spectrum, and a colour alone does not say what "
                 "a camera sees; give one with --light NAME --spectrum FILE");
}

Result<void> AddCameraViews(const ReportOptions& options, Source& source, Console& console) {
  if (options.view.target.empty()) return {};
  const auto lamps = LampsWithSpectra(options, source, console);
  if (!lamps) return tl::unexpected(lamps.error());
  auto sheets = SheetsOf(*lamps, options.view, console);
  if (!sheets) return Propagate(std::move(sheets));
  for (std::size_t i = 0; i < sheets->size(); ++i) {
    source.extras.matches.push_back({(*lamps)[i].title, std::move((*sheets)[i])});
  }
  return {};
}

Result<void> RunReport(const ReportOptions& options, Console& console) {
  const auto plots = ParsePlots(options.plots);
  if (!plots) return tl::unexpected(plots.error());
  const bool is_light_file = fs::path(options.input).extension() == ".json";
  auto source = is_light_file ? FromLightFile(options, console) : FromSession(options, console);
  if (!source) return Propagate(std::move(source));
  if (auto known = CheckLight("--light", options.light, source->lights); !known) return known;
  if (auto added = AddCameraViews(options, *source, console); !added) return added;
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  std::vector<OutputFile> files;
  if (plots->empty() || !options.output.empty()) {
    files.push_back({options.output.empty() ? source->default_output : options.output,
                     ReportPage(source->lights, source->title, source->extras)});
  }
  for (const PlotRequest& request : *plots) {
    if (auto added = AddPlot(request, *source, options.light, files); !added) return added;
  }
  if (auto distinct = CheckDistinct(files); !distinct) return distinct;
  if (auto written = WriteOutputs(files, options.force); !written) return written;
  for (const OutputFile& file : files) console.Print("wrote " + file.path + "\n");
  console.PrintDocument({{"files", PathsOf(files)}});
  return {};
}

}  // namespace

Run BuildReport(CLI::App& parser) {
  auto options = std::make_shared<ReportOptions>();
  parser.add_option("input", options->input, "light.json, session directory or .toml file")
      ->required();
  parser.add_option("-o,--output", options->output,
                    "The page [SESSION/out/report.html, or beside light.json]");
  parser
      .add_option("--plot", options->plots,
                  "One of its plots as a file, instead of the page (give -o for both): " +
                      Joined(report::PlotNames()) +
                      ". Where several lights have it, each gets FILE-LIGHT.svg. Repeatable")
      ->type_name("NAME=FILE.svg|png")
      ->delimiter(',')
      ->allow_extra_args(false);
  AddLightsOptions(parser, options->calibration);
  parser.add_option("--light", options->light, "Plots, or the camera's view, of this light alone");
  CLI::Option* const match = parser.add_option("--match", options->view.target,
                                               "Adds what a camera sees of each lamp, of this "
                                               "light (illuminant:A, 3200K, a spectrum), and of "
                                               "the lamp behind the gels that come nearest");
  match->type_name("TARGET");
  parser.add_option("--gels", options->view.gels, "Of --match: a maker's filters")
      ->type_name("FILE.csv")
      ->needs(match);
  parser
      .add_option("--camera", options->view.camera,
                  "Of --match: whose colours decide, a camera's name, all, or observer")
      ->capture_default_str()
      ->needs(match);
  parser.add_option("--spectrum", options->spectrum, "Of --match: the lamp's, where none is known")
      ->type_name("FILE")
      ->needs(match);
  parser.add_flag("--force", options->force, "Replace a file that lightcal did not write");
  return [options](Console& console) { return RunReport(*options, console); };
}

}  // namespace lightcal::app
