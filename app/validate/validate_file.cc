// SPDX-License-Identifier: Apache-2.0
#include "validate/validate_file.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "batch/run_stamp.h"
#include "input_files.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/check/read_preset.h"
#include "lightcal/presets/check/rig_file.h"
#include "lightcal/presets/check/whole_text.h"
#include "lightcal/presets/preset_table.h"
#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/camera_profile.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/light_codec.h"
#include "lightcal/records/meter_calibration.h"
#include "lightcal/records/tethered_shoot.h"
#include "lightcal_devices/files/gdtf_file.h"
#include "lightcal_devices/files/import_file.h"
#include "lightcal_devices/files/read_photometric.h"
#include "lightcal_devices/transport/tape_codec.h"
#include "output_files.h"
#include "preset_input.h"
#include "provenance_mark.h"
#include "validate/validate_session.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;
using records::Node;

constexpr std::uintmax_t kMostBytes = 256U << 20U;
constexpr int kValidateDigits = 4;

// What a reader found in the file, in a few words.
using Contents = Result<std::string>;

Contents LightContents(const std::string& text, const std::string& path) {
  const auto file = LightFileFromJson(text, path);
  if (!file) return tl::unexpected(file.error());
  return Counted(file->lights.size(), "light");
}

Contents PresetContents(const std::string& text, const std::string& path) {
  // The reader goes by the name, which a person may have changed.
  auto lights = LightsOfPreset("lights.preset.json", text, FilesBeside(path));
  if (!lights) {
    Error error = std::move(lights).error();
    error.subject = path;
    return tl::unexpected(std::move(error));
  }
  const std::string count = Counted(lights->size(), "light");
  auto rig = RigFromPreset(text, path);
  if (rig) return count + " in a rig";
  if (rig.error().code == "no_rig") return count + " without a rig";
  return Propagate(std::move(rig));
}

Contents CameraContents(const std::string& text, const std::string& path) {
  const auto profile = CameraProfileFromJson(text, path);
  if (!profile) return tl::unexpected(profile.error());
  return profile->camera.empty() ? "a camera without a name" : profile->camera;
}

Contents SensitivityContents(const std::string& text, const std::string& path) {
  const auto sensitivities = CameraSensitivitiesFromJson(text, path);
  if (!sensitivities) return tl::unexpected(sensitivities.error());
  return sensitivities->camera;
}

Contents ProfileContents(const std::string& text, const std::string& path) {
  const auto profile = AccuracyProfileFromJson(text, path);
  if (!profile) return tl::unexpected(profile.error());
  return "tolerance " + PercentText(profile->tolerance_relative);
}

Contents CaptureContents(const std::string& text, const std::string& path) {
  const auto shoot = TetheredShootFromJson(text, path);
  if (!shoot) return tl::unexpected(shoot.error());
  return Counted(shoot->frames.size(), "frame") + (shoot->complete ? "" : ", broken off");
}

Contents TapeContents(const std::string& text, const std::string& path) {
  const auto tape = devices::TapeFromText(text, path);
  if (!tape) return tl::unexpected(tape.error());
  return tape->driver + ", " + Counted(tape->exchanges.size(), "exchange");
}

Contents RunStampContents(const std::string& text, const std::string& path) {
  const auto stamp = RunStampFromJson(text, path);
  if (!stamp) return tl::unexpected(stamp.error());
  return Counted(stamp->outputs.size(), "output");
}

Contents MeterContents(const std::string& text, const std::string& path) {
  const auto meters = MeterCalibrationsFromToml(text, path);
  if (!meters) return tl::unexpected(meters.error());
  return Counted(meters->size(), "calibration");
}

// Every JSON document that says itself which it is. A new one is one line.
struct JsonFormat {
  std::string_view name;
  std::string_view schema;
  Contents (*read)(const std::string& text, const std::string& path);
};
constexpr JsonFormat kJsonFormats[] = {
    {"light", kLightSchema, LightContents},
    {"preset", "lightcal.preset/1", PresetContents},
    {"camera", kCameraSchema, CameraContents},
    {"profile", kProfileSchema, ProfileContents},
    {"capture", "lightcal.capture/1", CaptureContents},
    {"tape", "lightcal.tape/1", TapeContents},
    {"run", kRunStampSchema, RunStampContents},
};

// Whether a file is an engine's own: its name alone tells. Photometric files and our own JSON say
// themselves what they are.
bool IsEngineFile(const std::string& name) {
  const PresetTarget* target = TargetOfFile(name);
  return target != nullptr && target->place_in_report > 0;
}

Error UnknownFormat(const std::string& path, const std::string& what) {
  return {ErrorKind::kRefused, "unknown_format", path,
          what + "; lightcal validate --help lists what is known"};
}

void Take(Contents contents, FileVerdict& verdict) {
  if (contents) {
    verdict.holds = *std::move(contents);
  } else {
    verdict.error = std::move(contents).error();
  }
}

// "lightcal.light/1" of the document; where its syntax is broken, of the first text that looks so.
// A tape is one document a line.
std::string SchemaIn(std::string_view text) {
  const std::string_view first_line = text.substr(0, text.find('\n'));
  for (const std::string_view part : {text, first_line}) {
    const auto node = records::ParseJson(part);
    if (node && node->kind == Node::Kind::kTable) return node->TextAt("schema");
  }
  for (const JsonFormat& format : kJsonFormats) {
    if (text.find('"' + std::string(format.schema) + '"') != std::string_view::npos) {
      return std::string(format.schema);
    }
  }
  return "";
}

void ValidateJson(const std::string& text, FileVerdict& verdict) {
  const std::string schema = SchemaIn(text);
  const std::string family = schema.substr(0, schema.find('/'));
  for (const JsonFormat& format : kJsonFormats) {
    if (family.empty() || format.schema.substr(0, format.schema.find('/')) != family) continue;
    verdict.format = format.name;
    verdict.version = schema;
    if (schema == format.schema) {
      Take(format.read(text, verdict.path), verdict);
    } else {
      verdict.error = Error{ErrorKind::kRefused, "unknown_version", verdict.path,
                            "is " + schema + ", this program reads " + std::string(format.schema) +
                                "; update lightcal, or write the file again with this one"};
    }
    return;
  }
  const auto node = records::ParseJson(text);
  if (!node) {
    verdict.error = Error{ErrorKind::kRefused, "bad_json", verdict.path,
                          "is broken JSON and does not say what it is; copy or write it again"};
  } else if (node->Find("spectral_data") != nullptr) {
    verdict.format = "camera sensitivities";
    Take(SensitivityContents(text, verdict.path), verdict);
  } else {
    verdict.error = UnknownFormat(
        verdict.path, schema.empty() ? "is JSON without a \"schema\"" : "is a " + schema);
  }
}

void ValidatePhotometric(FileVerdict& verdict) {
  auto read = devices::ReadPhotometricFile(verdict.path);
  if (!read) {
    if (verdict.format.empty()) verdict.format = "photometric";
    verdict.error = std::move(read).error();
    return;
  }
  const PhotometricHeader& header = read->file.header;
  verdict.format = header.format == PhotometricFormat::kIes ? "IES" : "EULUMDAT";
  verdict.version = header.version;
  verdict.warnings = std::move(read->warnings);
  const IntensityTable& table = read->file.table;
  verdict.holds = RoundedText(table.Flux().value(), kValidateDigits) + " lm, peak " +
                  RoundedText(table.peak().intensity.value(), kValidateDigits) + " cd";
}

void ValidateGdtf(const std::string& bytes, FileVerdict& verdict) {
  verdict.format = "GDTF";
  const auto fixture = devices::GdtfFromArchive(bytes, verdict.path);
  if (!fixture) {
    verdict.error = fixture.error();
    return;
  }
  verdict.holds = Counted(fixture->emitters.size(), "emitter") + ", " +
                  Counted(fixture->beams.size(), "beam") + ", " +
                  Counted(fixture->modes.size(), "mode");
}

void ValidateImport(FileVerdict& verdict) {
  auto imported = devices::ImportFile(verdict.path);
  if (!imported) {
    verdict.error = std::move(imported).error();
    if (verdict.error->code != "unknown_format" && verdict.error->code != "not_text") return;
    // EULUMDAT has no mark of its own: what reads as one is one.
    if (devices::ReadPhotometricFile(verdict.path)) {
      verdict.error.reset();
      ValidatePhotometric(verdict);
    } else {
      verdict.error = UnknownFormat(verdict.path, "its format is not recognised");
    }
    return;
  }
  verdict.format = imported->format;
  verdict.warnings = std::move(imported->warnings);
  verdict.holds = imported->spectra.empty()
                      ? Counted(imported->readings.size(), "reading")
                      : Counted(imported->spectra.size(),
                                imported->spectra.size() == 1 ? "spectrum" : "spectrum column");
}

// What a file of ours holds that is made to hold no lamp; "" = it should have one.
std::string HeldInsteadOfLights(const std::string& text) {
  const std::string format = OwnFormatOf(text);
  if (format == "usd" && text.find("\nover \"") != std::string::npos) {
    return "opinions on lights of a stage";
  }
  const bool sky = text.find("\nbackground_mode = 2\n") != std::string::npos;
  return format == "godot" && sky ? "a panorama, no lamp" : "";
}

// The scripts whose presets are read: what runs around them is Python's and JavaScript's to judge.
struct PresetScript {
  std::string_view target, script, language;
};
constexpr PresetScript kPresetScripts[] = {{"blender", "blender.py", "Python"},
                                           {"three", "three.js", "JavaScript"}};

// That a script was edited, or is of another version: only one that is as written runs for sure.
Warnings ScriptNotChecked(const std::string& text, const std::string& path) {
  const PresetTarget* target = TargetOfFile(path);
  for (const PresetScript& one : kPresetScripts) {
    if (target == nullptr || target->name != one.target || IsOwnScript(text, one.script)) continue;
    return {{"script_not_checked", path,
             "its lights were read, but the script around them is not as this lightcal writes it: "
             "edited, or of another version. Its brackets close; whether " +
                 std::string(one.language) +
                 " takes it was not checked: run it there, or export it again"}};
  }
  return {};
}

void ValidateEngineFile(const std::string& text, FileVerdict& verdict) {
  verdict.format = "engine file";
  const auto lights = LightsIfAny(verdict.path, text, FilesBeside(verdict.path));
  if (!lights) {
    verdict.error = lights.error();
    return;
  }
  verdict.holds = lights->empty() ? HeldInsteadOfLights(text) : Counted(lights->size(), "light");
  if (verdict.holds.empty()) {
    verdict.error = Error{ErrorKind::kRefused, "bad_preset", verdict.path, "holds no light"};
    return;
  }
  verdict.warnings = ScriptNotChecked(text, verdict.path);
  if (!verdict.warnings.empty()) verdict.holds += ", its script not checked";
}

// A panorama's picture beside the preset that names it: <stem>-<light>.exr of a <stem>.* of ours.
bool IsPictureOfPreset(const fs::path& path) {
  constexpr std::string_view kPictures[] = {".exr", ".hdr", ".ktx", ".pfm"};
  const std::string name = path.filename().string();
  if (std::ranges::find(kPictures, path.extension().string()) == std::end(kPictures)) return false;
  std::error_code error;
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  for (const auto& beside : fs::directory_iterator(folder, error)) {
    const std::string other = beside.path().filename().string();
    const std::string stem = other.substr(0, other.find('.'));
    const bool named = TargetOfFile(other) != nullptr || beside.path().extension() == ".pbrt";
    if (named && !stem.empty() && name.starts_with(stem + "-") &&
        !OwnFormatOfFile(beside.path().string()).empty()) {
      return true;
    }
  }
  return false;
}

// What lightcal writes for engines and people and does not read back. Absent: it may be anything.
std::optional<std::string> WrittenForOthers(const std::string& path, const std::string& text) {
  if (IsPictureOfPreset(path)) return "picture";
  const std::string format = OwnFormatOf(text);
  if (format == "script" || format == "json" || format == "lightcal.unity" || format == "mitsuba" ||
      format == "unreal") {
    return "engine file";
  }
  if (format == "html") return "page";
  return format == "hdr" || format == "exr" || format == "png" || format == "svg" || format == "pdf"
             ? std::optional<std::string>("picture")
             : std::nullopt;
}

void ValidateToml(const std::string& text, FileVerdict& verdict) {
  const bool meters = fs::path(verdict.path).filename() == "meters.toml" ||
                      text.find("[[calibration]]") != std::string::npos;
  if (!meters) return ValidateSession(verdict);
  verdict.format = "meters";
  verdict.version = "1";
  Take(MeterContents(text, verdict.path), verdict);
}

void ValidateText(const std::string& text, FileVerdict& verdict) {
  const std::string name = LowerAscii(fs::path(verdict.path).filename().string());
  const auto named = [&](std::string_view ending) { return name.ends_with(ending); };
  const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  std::optional<std::string> for_others = WrittenForOthers(verdict.path, text);
  if (named(".gdtf")) {
    ValidateGdtf(text, verdict);
  } else if (named(".toml")) {
    ValidateToml(text, verdict);
  } else if (named(".jsonl")) {
    ValidateJournal(text, verdict);
  } else if (IsEngineFile(name)) {
    ValidateEngineFile(text, verdict);
  } else if (first != std::string::npos && text[first] == '{' && !for_others) {
    ValidateJson(text, verdict);
  } else if (named(".ies") || named(".ldt") || IsIes(text)) {
    ValidatePhotometric(verdict);
  } else if (for_others) {
    verdict.format = *std::move(for_others);
    verdict.holds = "written by lightcal, no reader here";
    verdict.checked = false;
  } else {
    ValidateImport(verdict);
  }
}

}  // namespace

FileVerdict ValidateFile(const std::string& path) {
  FileVerdict verdict{path, "", "", "", {}, std::nullopt};
  std::error_code error;
  if (fs::is_directory(path, error)) {
    ValidateSession(verdict);
    return verdict;
  }
  const std::uintmax_t bytes = fs::file_size(path, error);
  if (!error && bytes > kMostBytes) {
    verdict.error = Error{ErrorKind::kRefused, "too_large", path,
                          "is larger than 256 MiB, which no file lightcal validates is"};
    return verdict;
  }
  const auto text = ReadInputFile(path);
  if (text) {
    ValidateText(*text, verdict);
  } else {
    verdict.error = text.error();
  }
  return verdict;
}

}  // namespace lightcal::app
