// SPDX-License-Identifier: Apache-2.0
// lightcal._native: the questions of the package's __init__.py, which documents them. Each answers
// with the document that the command of its name prints, without its text.
#include <array>
#include <filesystem>
#include <memory>
#include <utility>

#include "color_words.h"
#include "commands/color_asked.h"
#include "commands/merge_request.h"
#include "export_request.h"
#include "input_files.h"
#include "lightcal/light/fixture.h"
#include "lightcal/records/capture.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"
#include "picture_words.h"
#include "python/answers.h"
#include "quick/quick_answer.h"
#include "session_answer.h"
#include "target_words.h"

namespace lightcal::app::python {
namespace {

// A call says nothing on its own: warnings are part of its answer.
Console SilentConsole(bool allow_outside = false) {
  Console::Flags flags;
  flags.quiet = true;
  flags.muted = true;
  flags.allow_outside = allow_outside;
  return Console(flags);
}

template <class Words>
std::vector<std::string> Listed(const Words& words) {
  return {words.begin(), words.end()};
}

// Without the interpreter's lock, the inputs of this call known to all that runs beside it.
template <class Work>
auto Unlocked(const Work& work) {
  const py::gil_scoped_release released;
  const InputsOfOneAnswer inputs;
  return work();
}

struct RunWishes {
  CalibrationOptions calibration;
  std::vector<std::string> targets;
  std::string output;
  bool rig = false, force = false, allow_outside = false;
};

struct WrittenRun {
  AnsweredSession run;
  std::vector<std::string> paths;
};

Result<WrittenRun> RunAndWrite(const RunWishes& wishes, Console& console) {
  auto run = AnswerSession(wishes.calibration, wishes.targets, console);
  if (!run) return Propagate(std::move(run));
  WrittenRun written{*std::move(run), {}};
  if (wishes.output.empty()) return written;
  auto files = SessionOutputs(written.run, wishes.output, wishes.targets, wishes.rig, console);
  if (!files) return Propagate(std::move(files));
  if (auto done = WriteOutputs(*files, wishes.force); !done) return Propagate(std::move(done));
  written.paths = PathsOf(*files);
  return written;
}

py::dict Run(const std::string& session, const py::dict& given) {
  static const std::vector<Keyword<RunWishes>> kOwn = {
      {"to", &RunWishes::targets},
      {"output", &RunWishes::output},
      {"rig", &RunWishes::rig},
      {"force", &RunWishes::force},
      {"allow_outside", &RunWishes::allow_outside}};
  static const std::vector<Keyword<CalibrationOptions>> kCalibration = {
      {"tol", &CalibrationOptions::tolerance},
      {"effects", &CalibrationOptions::effects},
      {"monte_carlo", &CalibrationOptions::monte_carlo},
      {"full_angles", &CalibrationOptions::full_angles},
      {"profile", &CalibrationOptions::profile},
      {"lights", &CalibrationOptions::lights},
      {"without", &CalibrationOptions::without}};
  py::dict own, calibration;
  for (const auto& [key, value] : given) {
    const auto name = py::cast<std::string>(key);
    const bool mine = std::ranges::find(kOwn, name, &Keyword<RunWishes>::name) != kOwn.end();
    (mine ? own : calibration)[key] = value;
  }
  RunWishes wishes;
  Fill<RunWishes>(wishes, own, kOwn);
  Fill<CalibrationOptions>(wishes.calibration, calibration, kCalibration);
  wishes.calibration.session = session;
  wishes.calibration.tolerance_given = given.contains("tol") && !given["tol"].is_none();
  wishes.calibration.effects_given = given.contains("effects") && !given["effects"].is_none();
  if (!wishes.calibration.lights.empty() && !wishes.calibration.without.empty()) {
    Raise({ErrorKind::kUsage, "usage", "without", "excludes lights: give one of them"});
  }
  SpellOutAll(wishes.targets);
  Console console = SilentConsole(wishes.allow_outside);
  auto done = OrRaise(Unlocked([&] { return RunAndWrite(wishes, console); }));
  Node document = DocumentOf(done.run);
  document.Put("files", Node::UnlessEmpty(done.paths));
  return AnswerOf(std::move(document), console);
}

py::dict Quick(const std::vector<std::string>& readings, const py::dict& given) {
  using O = QuickOptions;
  static const std::vector<Keyword<O>> kKeywords = {
      {"name", &O::name},     {"kind", &O::kind, Listed(kQuickKinds)},
      {"cct", &O::cct},       {"fixture", &O::fixture, Listed(kFixtureNames)},
      {"room", &O::room},     {"diameter", &O::diameter},
      {"size", &O::size},     {"length", &O::length},
      {"radius", &O::radius}, {"inner", &O::inner},
      {"outer", &O::outer},   {"full_angles", &O::full_angles},
      {"sigma", &O::sigma},   {"meter", &O::meter},
      {"lumens", &O::lumens}, {"beam", &O::beam},
      {"field", &O::field},   {"watts", &O::watts},
      {"at", &O::predict_at}, {"gel", &O::gel},
      {"gels", &O::gels},     {"spectrum", &O::spectrum},
      {"plan", &O::plan}};
  QuickOptions options;
  options.readings = readings;
  Fill<O>(options, given, kKeywords);
  if (!options.sigma.empty() && !options.meter.empty()) {
    Raise({ErrorKind::kUsage, "usage", "meter", "stands instead of sigma: give one of them"});
  }
  if (options.readings.empty() && options.lumens.empty()) {
    Raise({ErrorKind::kUsage, "usage", "readings",
           "give what the meter showed and where, \"192lx@0.5m\", or lumens of a data sheet"});
  }
  Console console = SilentConsole();
  const auto answer = OrRaise(Unlocked([&] { return AnswerQuick(options, console); }));
  return AnswerOf(DocumentOf(answer), console);
}

py::dict Color(const py::dict& given) {
  ColorOptions options;
  static const std::vector<Keyword<ColorOptions>> kKeywords = {
      {"xy", &ColorOptions::xy},
      {"xyz", &ColorOptions::xyz},
      {"cct", &ColorOptions::cct},
      {"duv", &ColorOptions::duv},
      {"locus", &ColorOptions::locus, {"planck", "daylight"}},
      {"spectrum", &ColorOptions::spectrum},
      {"column", &ColorOptions::column},
      {"through", &ColorOptions::through},
      {"gels", &ColorOptions::gels}};
  static const std::vector<Keyword<ColorExtraOptions>> kExtras = {
      {"sigma", &ColorExtraOptions::sigma},
      {"white", &ColorExtraOptions::white},
      {"gamut", &ColorExtraOptions::gamut, {"keep", "clip", "desaturate"}},
      {"sampling", &ColorExtraOptions::sampling, {"auto", "band", "point"}},
      {"engines", &ColorExtraOptions::engines},
      {"adobe", &ColorExtraOptions::adobe},
      {"tlci", &ColorExtraOptions::tlci}};
  py::dict own, extra;
  for (const auto& [key, value] : given) {
    const auto name = py::cast<std::string>(key);
    const bool more =
        std::ranges::find(kExtras, name, &Keyword<ColorExtraOptions>::name) != kExtras.end();
    (more ? extra : own)[key] = value;
  }
  Fill<ColorOptions>(options, own, kKeywords);
  Fill<ColorExtraOptions>(options.extra, extra, kExtras);
  const bool pairs = (options.xy.empty() || options.xy.size() == 2) &&
                     (options.xyz.empty() || options.xyz.size() == 3);
  if (!pairs) {
    Raise({ErrorKind::kUsage, "usage", "color", "xy takes two numbers, xyz three"});
  }
  if (auto checked = CheckColor(options); !checked) Raise(checked.error());
  const auto extras = OrRaise(ParseColorExtras(options.extra));
  Console console = SilentConsole();
  const auto answered = OrRaise(Unlocked([&] { return AnswerColor(options, extras, console); }));
  return AnswerOf(DocumentOf(answered), console);
}

py::dict Merge(const std::vector<std::string>& frames, bool sigma, const py::dict& given) {
  using O = MergeOptions;
  static const std::vector<Keyword<O>> kKeywords = {
      {"exposures", &O::exposures},
      {"f_number", &O::f_number},
      {"t_stop", &O::t_stop},
      {"iso", &O::iso},
      {"anchor", &O::anchor},
      {"anchor_sigma", &O::anchor_sigma},
      {"space", &O::space, Listed(kSpaceWords)},
      {"white", &O::white},
      {"camera", &O::camera},
      {"nd", &O::nd},
      {"lamp_class", &O::lamp_class, Listed(kLampClassWords)},
      {"no_flat", &O::no_flat},
      {"cos4", &O::cos4},
      {"align", &O::align, {"auto", "off"}},
      {"mains", &O::mains, Listed(kMainsWords)},
      {"pwm", &O::pwm}};
  MergeOptions options;
  options.frames = frames;
  py::dict words;
  for (const auto& [key, value] : given) {
    if (py::cast<std::string>(key) != "noise") {
      words[key] = value;
    } else if (!value.is_none()) {
      options.noise = py::cast<std::vector<double>>(value);
    }
  }
  Fill<O>(options, words, kKeywords);
  Console console = SilentConsole();
  const auto merged = OrRaise(Unlocked([&]() -> Result<std::shared_ptr<MergedBracket>> {
    auto opened = OpenMerge(options);
    if (!opened) return Propagate(std::move(opened));
    opened->request.want_sigma = sigma;
    auto made = MergeOpened(*opened, console);
    if (!made) return Propagate(std::move(made));
    return std::make_shared<MergedBracket>(*std::move(made));
  }));
  py::dict answer = AnswerOf(DocumentOf(*merged), console);
  std::vector<py::ssize_t> shape = {merged->height, merged->width};
  if (sigma) answer["sigma"] = ArrayOf(merged->sigma, shape, merged);
  if (merged->channels > 1) shape.push_back(merged->channels);
  answer["luminance"] = ArrayOf(merged->picture, shape, merged);
  return answer;
}

std::vector<OutputFile> OutputFilesOf(ExportedPresets&& presets) {
  std::vector<OutputFile> files;
  for (PresetFile& file : presets.files) {
    files.push_back({std::move(file.name), std::move(file.contents)});
  }
  return files;
}

// `document`: the text of a light.json instead of a path; then `stem` names the presets.
py::dict Export(const std::string& path, const std::string& document, const std::string& stem,
                const std::string& output, const py::dict& given) {
  using O = ExportOptions;
  static const std::vector<Keyword<O>> kKeywords = {
      {"to", &O::targets},        {"states", &O::states},
      {"space", &O::space},       {"white", &O::white},
      {"range", &O::range},       {"spots", &O::spots, {"auto", "ies", "cone"}},
      {"renderer", &O::renderer}, {"into", &O::into},
      {"engine", &O::engine},     {"rig", &O::rig},
      {"force", &O::force}};
  ExportOptions options;
  Fill<O>(options, given, kKeywords);
  SpellOutAll(options.targets, !options.into.empty());
  Console console = SilentConsole();
  std::vector<std::string> pastes;
  const auto files = OrRaise(Unlocked([&]() -> Result<std::vector<OutputFile>> {
    const auto preset = PresetOptionsOf(options);
    if (!preset) return tl::unexpected(preset.error());
    auto presets = [&]() -> Result<ExportedPresets> {
      if (document.empty()) return PresetsOfInput(path, options, *preset, console);
      auto lights = LightFileFromJson(document, "lights");
      if (!lights) return Propagate(std::move(lights));
      return PresetsOfLights({*std::move(lights), stem, ".", stem + ".json"}, options, *preset,
                             console);
    }();
    if (!presets) return Propagate(std::move(presets));
    console.Warn(presets->warnings);
    for (const std::string& line : presets->pastes) {
      pastes.push_back(WithDirectory(line, output.empty() ? "." : output));
    }
    std::vector<OutputFile> made = OutputFilesOf(*std::move(presets));
    if (output.empty()) return made;
    PlaceUnder(output, made);
    if (auto done = WriteOutputs(made, options.force); !done) return Propagate(std::move(done));
    return made;
  }));
  py::dict answer =
      AnswerOf({{"files", PathsOf(files)}, {"paste", Node::UnlessEmpty(pastes)}}, console);
  if (output.empty()) {
    py::dict contents;
    for (const OutputFile& file : files) contents[py::str(file.path)] = py::bytes(file.contents);
    answer["contents"] = contents;
  }
  return answer;
}

}  // namespace
}  // namespace lightcal::app::python

PYBIND11_MODULE(_native, module) {
  namespace py = pybind11;
  using namespace lightcal::app;
  module.doc() = "What `import lightcal` answers with; use that.";
  module.attr("generator") = GeneratorName();
  module.def("run", &python::Run, py::arg("session"), py::arg("given"));
  module.def("quick", &python::Quick, py::arg("readings"), py::arg("given"));
  module.def("color", &python::Color, py::arg("given"));
  module.def("merge", &python::Merge, py::arg("frames"), py::arg("sigma"), py::arg("given"));
  module.def("export", &python::Export, py::arg("path"), py::arg("document"), py::arg("stem"),
             py::arg("output"), py::arg("given"));
}
