// SPDX-License-Identifier: Apache-2.0
// lightcal new: asks about a lamp and writes the session.toml it is measured into.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>

#include "commands.h"
#include "guide/drawings.h"
#include "guide/lamp_interview.h"
#include "guide/new_session.h"
#include "guide/questions.h"
#include "input_files.h"
#include "interrupt.h"
#include "lightcal/core/file_stem.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/photometry/light_kind.h"
#include "lightcal/records/session_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

struct NewOptions {
  LampFlags flags;
  bool yes = false;
  bool force = false;
};

std::string SessionFile(const std::string& directory) {
  return (fs::path(directory) / "session.toml").string();
}

// A session belongs to the person who edits it: never replaced unasked.
Result<void> CheckFree(const std::string& directory, bool force) {
  std::error_code error;
  const std::string path = SessionFile(directory);
  if (force || !fs::exists(path, error)) return {};
  return Failed("exists", path,
                "there is a session already; choose another folder, or pass --force to write "
                "session.toml anew (its readings stay)");
}

Node DocumentOf(const NewSession& session) {
  return {{"session", SessionFile(session.directory)},
          {"light", session.light.name},
          {"kind", LightKindName(session.light.kind)},
          {"next", std::vector{ReadLine(session), RunLine(session)}},
          {"device", Node::UnlessEmpty(session.device)},
          {"to", Node::UnlessEmpty(session.targets)}};
}

// A session that is copied elsewhere takes its lamp's file along.
Result<std::vector<OutputFile>> TakeDistributionIn(NewSession& session) {
  std::string& named = session.light.distribution_file;
  if (named.empty()) return std::vector<OutputFile>();
  const fs::path from = fs::path(session.directory) / named;
  auto bytes = ReadInputFile(from.lexically_normal().string());
  if (!bytes) return Propagate(std::move(bytes));
  named = "captures/" + FileStem(session.light.name) + LowerAscii(from.extension().string());
  const std::string to = (fs::path(session.directory) / named).string();
  std::error_code error;
  if (fs::equivalent(from, to, error)) return std::vector<OutputFile>();
  return std::vector<OutputFile>{{to, *std::move(bytes)}};
}

Result<void> RunNew(const NewOptions& options, Console& console) {
  const InterruptGuard guard;  // Ctrl-C ends a question like the end of input does
  const Questions questions = Questions::Choose(options.yes);
  if (options.flags.directory) {
    if (auto free = CheckFree(*options.flags.directory, options.force); !free) return free;
  }
  auto session = InterviewAboutLamp(questions, options.flags);
  if (!session) return Propagate(std::move(session));
  if (auto free = CheckFree(session->directory, options.force); !free) return free;
  const auto taken = TakeDistributionIn(*session);
  if (!taken) return tl::unexpected(taken.error());
  const auto text = SessionText(*session);
  if (!text) return tl::unexpected(text.error());
  std::error_code error;
  if (fs::exists(JournalPath(session->directory), error)) {
    console.Warn({"journal_kept", JournalPath(session->directory),
                  "readings of an earlier session are there and count; remove the file if they "
                  "are of another lamp"});
  }
  if (auto strict = console.RefuseIfStrict(); !strict) return strict;
  const std::string path = SessionFile(session->directory);
  if (auto written = WriteOutputs(*taken, options.force); !written) return written;
  if (auto written = WriteOutputs({{path, *text}}, true); !written) return written;
  console.Print("\nwrote " + path + "\n");
  if (session->light.kind != LightKind::kDirectional) {
    console.Print("\n" + ShadowCardDrawing());
  }
  console.Print("\nSwitch the lamp on and let it warm up for ten minutes. Then\n  " +
                ReadLine(*session) + "\nsays where to put the meter, and after it\n  " +
                RunLine(*session) +
                "\nwrites the presets and the report. A camera's bracket is added in session.toml, "
                "under [[capture]].\n");
  console.PrintDocument(DocumentOf(*session));
  return {};
}

}  // namespace

Run BuildNew(CLI::App& parser) {
  auto options = std::make_shared<NewOptions>();
  LampFlags& flags = options->flags;
  parser.add_option("directory", flags.directory, "Folder of the session [asked]");
  parser.add_option("--lamp", flags.lamp, "What the lamp is called [asked; key]");
  parser.add_option("--kind", flags.kind,
                    "point spot sphere disk rect tube photometric directional [asked; point]");
  parser.add_option("--fixture", flags.fixture,
                    "bulb cob_bare reflector fresnel panel softbox luminaire: where its light "
                    "starts [asked of a point or spot; not known]");
  parser.add_option("--diameter", flags.diameter, "Of a sphere or disk: 6cm [asked]");
  parser.add_option("--size", flags.size, "Of a rect: 120x60cm [asked]");
  parser.add_option("--length", flags.length, "Of a tube: 1.2m [asked]");
  parser.add_option("--radius", flags.radius, "Of a tube: 13mm [asked]");
  parser.add_option("--distribution", flags.distribution, "Its IES or LDT file [asked]");
  parser.add_option("--box", flags.box, "What the box says: \"9W 806lm 2900K 36deg\" [asked]");
  parser.add_option("--meter", flags.meter,
                    "none (you type what it shows), or a device [asked; the one plugged in]");
  parser.add_option("--accuracy", flags.accuracy,
                    "Of the meter, as its maker says, taken as 95 %: 3% [asked of one that is "
                    "typed; 10%]");
  parser.add_option("--to", flags.targets, "Engines: gltf,blender or all [asked; all]");
  parser.add_option("--room", flags.room,
                    "Width, depth, height in metres: 5,4,2.6, or dark or outdoors [asked]");
  parser.add_option("--reflectance", flags.reflectance, "Of the room's walls [asked; 0.5]");
  parser.add_flag("-y,--yes", options->yes, "Ask nothing: what no flag says takes its default");
  parser.add_flag("--force", options->force, "Write the session.toml anew where there is one");
  return [options](Console& console) { return RunNew(*options, console); };
}

}  // namespace lightcal::app
