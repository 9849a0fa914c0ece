// SPDX-License-Identifier: Apache-2.0
#include "batch/run_stamp.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <span>

#include "input_files.h"
#include "lightcal/calibrate/session_files.h"
#include "lightcal/records/json_codec.h"
#include "lightcal/records/session_codec.h"
#include "lightcal/records/session_reader.h"
#include "lightcal_devices/captures/bracket.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;
using records::Node;

Node FileNode(const InputFile& file) { return {{"path", file.path}, {"sha256", file.sha256}}; }

std::vector<InputFile> FilesAt(const Node& document, std::string_view key) {
  std::vector<InputFile> files;
  if (const Node* list = document.Find(key)) {
    for (const Node& file : list->items)
      files.push_back({file.TextAt("path"), file.TextAt("sha256")});
  }
  return files;
}

bool StillTheSame(const fs::path& directory, const std::vector<InputFile>& files) {
  return std::ranges::all_of(files, [&](const InputFile& file) {
    const auto bytes = ReadOutput((directory / file.path).string());
    return bytes && devices::Sha256Hex(*bytes) == file.sha256;
  });
}

// Matches of the wildcards of a session's captures; one that matches nothing has none.
std::vector<std::string> MatchedFrames(const Session& session) {
  std::vector<std::string> frames;
  const auto add = [&](const std::string& name) {
    if (name.empty()) return;
    const std::string pattern = PathInSession(session, name);
    auto files = devices::ExpandFiles(std::span(&pattern, 1));
    if (files) std::ranges::move(*files, std::back_inserter(frames));
  };
  for (const CaptureDescription& capture : session.captures) {
    add(capture.frames);
    if (!capture.wall) continue;
    add(capture.wall->board_views);
    add(capture.wall->off_frames);
  }
  return frames;
}

}  // namespace

std::string RunStampToJson(const RunStamp& stamp) {
  const Node document = {{"schema", kRunStampSchema},
                         {"generator", stamp.generator},
                         {"settings_sha256", stamp.settings},
                         {"session_sha256", stamp.session},
                         {"inputs", Node::List(stamp.inputs, FileNode)},
                         {"outputs", Node::List(stamp.outputs, FileNode)}};
  return PrintJson(document, records::JsonLayout::kPretty) + "\n";
}

Result<RunStamp> RunStampFromJson(std::string_view text, std::string_view where) {
  const auto bad = [&](const std::string& what) {
    return Refused("bad_run", std::string(where), what + "; delete it, and run the session again");
  };
  const auto document = records::ParseJson(text);
  if (!document || document->kind != Node::Kind::kTable) return bad("is no JSON object");
  if (document->TextAt("schema") != kRunStampSchema) {
    return bad("\"schema\" is not " + std::string(kRunStampSchema));
  }
  RunStamp stamp{document->TextAt("generator"), document->TextAt("settings_sha256"),
                 document->TextAt("session_sha256"), FilesAt(*document, "inputs"),
                 FilesAt(*document, "outputs")};
  for (const auto* key : {&stamp.generator, &stamp.settings, &stamp.session}) {
    if (key->empty()) return bad("generator, settings_sha256 or session_sha256 is missing");
  }
  for (const auto* files : {&stamp.inputs, &stamp.outputs}) {
    for (const InputFile& file : *files) {
      if (file.path.empty() || file.sha256.empty()) return bad("a file lacks path or sha256");
    }
    if (files->empty()) return bad("inputs or outputs is missing");
  }
  return stamp;
}

Result<std::string> NamedFilesHash(const std::string& session_path) {
  const auto loaded = LoadSession(session_path, InputSources().read_text);
  if (!loaded) return tl::unexpected(loaded.error());
  const Session& session = loaded->session;
  std::vector<std::string> files = session.input_files;
  std::ranges::move(MatchedFrames(session), std::back_inserter(files));
  std::string list;
  for (const std::string& file : files) {
    auto bytes = ReadInputFile(file);
    if (!bytes) return Propagate(std::move(bytes));
    const fs::path relative = fs::path(file).lexically_proximate(session.directory);
    list += relative.generic_string() + '\n' + devices::Sha256Hex(*bytes) + '\n';
  }
  return devices::Sha256Hex(list);
}

bool IsUpToDate(const std::string& directory, const std::string& session_directory,
                const std::string& settings, const std::string& session_hash) {
  const std::string path = (fs::path(directory) / kRunStampFile).string();
  const auto text = ReadOutput(path);
  if (!text) return false;
  const auto stamp = RunStampFromJson(*text, path);
  return stamp && stamp->generator == GeneratorName() && stamp->settings == settings &&
         stamp->session == session_hash && StillTheSame(session_directory, stamp->inputs) &&
         StillTheSame(directory, stamp->outputs);
}

}  // namespace lightcal::app
