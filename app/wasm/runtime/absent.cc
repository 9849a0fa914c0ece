// SPDX-License-Identifier: Apache-2.0
// What this module has not: devices, pictures, other programs, several processes. Each says so and
// where it is to be had.
#include <CLI/CLI.hpp>
#include <string>

#include "batch/run_batch.h"
#include "commands.h"
#include "commands/color_tlci.h"
#include "lightcal/calibrate/captures/ball_capture.h"
#include "lightcal/calibrate/captures/capture_readings.h"
#include "lightcal/calibrate/captures/wall_capture.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/presets/environment_files.h"
#include "lightcal/presets/filament_ktx.h"
#include "lightcal/records/embedded_cameras.h"
#include "lightcal/records/journal.h"
#include "lightcal_devices/captures/bracket.h"
#include "lightcal_devices/files/archive.h"
#include "lightcal_devices/files/tm27_spdx.h"
#include "page_file.h"
#include "picture_file.h"
#include "raster_png.h"

namespace lightcal {
namespace {

tl::unexpected<Error> NeedsPictures(const Session& session) {
  return Refused("needs_pictures", session.captures.front().light,
                 "is measured by pictures, which the lightcal program alone reads (Linux: "
                 "app/quickstart); readings, spectra and IES files are calculated here");
}

}  // namespace

Result<std::vector<BallPlacement>> PlaceByBalls(const Session& session, const Sources& /*sources*/,
                                                Evidence& /*evidence*/) {
  if (!session.captures.empty()) return NeedsPictures(session);
  return std::vector<BallPlacement>{};
}

Result<CaptureReadings> ReadCaptures(const Session& session, const Sources& /*sources*/,
                                     Evidence& /*evidence*/) {
  return CaptureReadings{{}, session.lights, session.captures};
}

bool RestsOnCameraScale(const Session& /*session*/, const std::string& /*light*/) { return false; }

Result<std::vector<FittedLight>> MeasureWalls(const Session& /*session*/,
                                              const Sources& /*sources*/,
                                              const FitSettings& /*settings*/,
                                              Evidence& /*evidence*/) {
  return std::vector<FittedLight>{};
}

// Of pictures, which no light.json brings here.
EncodedPicture RadianceFile(const EnvironmentPicture& /*picture*/, const ColorTarget& /*color*/) {
  return {};
}
EncodedPicture ExrFile(const EnvironmentPicture& /*picture*/, const ColorTarget& /*color*/) {
  return {};
}
EncodedPicture EqualAreaSquare(const EnvironmentPicture& /*picture*/,
                               const ColorTarget& /*color*/) {
  return {};
}
std::string FilamentKtx(const EnvironmentPicture& /*picture*/, const std::string& /*harmonics*/) {
  return {};
}

// A tenth of the page; `match`, which asks for cameras by name, is not in it.
std::span<const records::EmbeddedCamera> records::EmbeddedCameras() { return {}; }

namespace devices {

Result<std::vector<std::string>> ExpandFiles(std::span<const std::string> patterns) {
  return Refused("needs_pictures", patterns.empty() ? std::string() : patterns.front(),
                 "pictures are read by the lightcal program alone");
}

namespace files {

Result<std::string> OnlyFileInZip(std::string_view /*bytes*/, std::string_view name) {
  return Refused("unknown_format", std::string(name),
                 "is packed, which the lightcal program alone opens; give the file inside");
}
bool IsZip(std::string_view bytes) { return bytes.starts_with("PK\x03\x04"); }

bool IsTm27Spdx(std::string_view text) { return text.find("<IESTM2714") != std::string_view::npos; }
Result<ImportedFile> ReadTm27Spdx(std::string_view /*text*/, std::string_view name) {
  return Refused("unknown_format", std::string(name),
                 "is IES TM-27 (XML), which the lightcal program alone reads; export it as CSV");
}

Result<std::vector<Tm27Distribution>> Tm27Distributions(std::string_view text,
                                                        std::string_view name) {
  return Propagate(ReadTm27Spdx(text, name));
}

}  // namespace files
}  // namespace devices

namespace app {
namespace {

// A command of the program that this module has not: any words, one answer.
Run Absent(CLI::App& parser, const char* why) {
  parser.prefix_command();
  parser.set_help_flag();
  const std::string name = parser.get_name();
  return [name, why](Console&) -> Result<void> {
    return Failed("needs_program", name,
                  std::string(why) +
                      ", which the lightcal program has and this module has not; on Linux: "
                      "app/quickstart of lightcal's repository");
  };
}
constexpr const char* kDevices = "speaks to meters and cameras";
constexpr const char* kPictures = "reads pictures";
constexpr const char* kSessions = "writes into sessions and libraries or studies them";

}  // namespace

Run BuildNew(CLI::App& p) { return Absent(p, kSessions); }
Run BuildPlan(CLI::App& p) { return Absent(p, kSessions); }
Run BuildShoot(CLI::App& p) { return Absent(p, kDevices); }
Run BuildImport(CLI::App& p) { return Absent(p, kSessions); }
Run BuildCamera(CLI::App& p) { return Absent(p, kPictures); }
Run BuildMatch(CLI::App& p) { return Absent(p, kSessions); }
Run BuildMerge(CLI::App& p) { return Absent(p, kPictures); }
Run BuildDome(CLI::App& p) { return Absent(p, kPictures); }
Run BuildInspect(CLI::App& p) { return Absent(p, kPictures); }
Run BuildSimulate(CLI::App& p) { return Absent(p, kPictures); }
Run BuildTradeoff(CLI::App& p) { return Absent(p, kSessions); }
Run BuildEngine(CLI::App& p) { return Absent(p, kPictures); }
Run BuildCheck(CLI::App& p) { return Absent(p, kPictures); }
Run BuildDiff(CLI::App& p) { return Absent(p, kSessions); }
Run BuildLights(CLI::App& p) { return Absent(p, kSessions); }
Run BuildValidate(CLI::App& p) { return Absent(p, kSessions); }
Run BuildCompletion(CLI::App& p) { return Absent(p, kSessions); }
Run BuildMan(CLI::App& p) { return Absent(p, kSessions); }
Run BuildPage(CLI::App& p) { return Absent(p, "writes this very page"); }
Run BuildDevices(CLI::App& p) { return Absent(p, kDevices); }
Run BuildSweep(CLI::App& p) { return Absent(p, kDevices); }
Run BuildRead(CLI::App& p) { return Absent(p, kDevices); }
Run BuildWatch(CLI::App& p) { return Absent(p, kDevices); }

Result<Tlci> TlciByArgyll(const Spectrum& /*spectrum*/) {
  return Failed("no_program", "specplot", "no other program runs here");
}

Result<std::string> PageWith(const LightFile& /*lights*/, const std::string& name) {
  return Failed("needs_program", name, "the page is written by the lightcal program alone");
}

Result<void> CheckPictureName(const std::string& option, const std::string& path) {
  if (LowerAscii(path).ends_with(".svg")) return {};
  if (LowerAscii(path).ends_with(".png")) {
    return WrongUsage(option, "PNG is painted by the lightcal program alone; write an .svg");
  }
  return WrongUsage(option, "\"" + path + "\" must end in .svg");
}

Result<OutputFile> PictureFile(const std::string& path, const std::string& svg) {
  if (auto named = CheckPictureName("picture", path); !named) return Propagate(std::move(named));
  return OutputFile{path, svg};
}

std::string PngUri(View2d<const std::uint8_t> /*rgb*/) { return {}; }

Result<std::vector<BatchItem>> BatchItems(const std::vector<std::string>& sessions,
                                          const std::string& /*output*/, bool /*apart*/) {
  return Failed("needs_program", sessions.empty() ? "run" : sessions.front(),
                "several sessions at once run in processes of their own, which the lightcal "
                "program alone starts; run one session at a time");
}
Result<void> RunBatch(const BatchRequest& /*request*/, const Console& /*console*/) {
  return Failed("needs_program", "run", "several sessions at once need the lightcal program");
}
}  // namespace app
}  // namespace lightcal
