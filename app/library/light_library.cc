// SPDX-License-Identifier: Apache-2.0
#include "library/light_library.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "input_files.h"
#include "lightcal/core/file_name.h"
#include "lightcal/core/numbers_text.h"
#include "lightcal/records/light_codec.h"
#include "output_files.h"

namespace lightcal::app {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHashDigits = 12;
constexpr std::size_t kLongestName = 60;

// Letters, digits and what is not ASCII stay; runs of all others become one '-'.
std::string FileNameOf(std::string_view name) {
  std::string slug;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool keeps = byte >= 0x80U || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') ||
                       (c >= 'A' && c <= 'Z') || c == '_';
    if (keeps) {
      slug += c;
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  std::size_t size = std::min(slug.size(), kLongestName);
  const auto inside_character = [&] {
    return size < slug.size() && (static_cast<unsigned char>(slug[size]) & 0xC0U) == 0x80U;
  };
  while (inside_character()) --size;
  slug.resize(size);
  while (slug.ends_with('-')) slug.pop_back();
  return slug.empty() ? "light" : slug;
}

std::string HashOf(const std::vector<InputFile>& inputs, const std::string& text) {
  std::string list;
  for (const InputFile& input : inputs) list += input.sha256 + '\n';
  return devices::Sha256Hex(list.empty() ? text : list).substr(0, kHashDigits);
}

Result<std::vector<OutputFile>> LibraryFiles(const LightFile& file, const std::string& folder) {
  std::vector<OutputFile> outputs;
  std::set<std::string> taken;
  for (const FittedLight& light : file.lights) {
    auto text = LightFileToJson({{light}, file.provenance});
    if (!text) return Propagate(std::move(text));
    const std::string name = DistinctFileName(
        FileNameOf(light.name) + "-" + HashOf(file.provenance.inputs, *text), taken);
    outputs.push_back({(fs::path(folder) / (name + ".json")).string(), *std::move(text)});
  }
  return outputs;
}

bool LooksLikeLights(const std::string& text) {
  return text.find('"' + std::string(kLightSchema) + '"') != std::string::npos;
}

}  // namespace

Result<std::string> DefaultLibrary() {
  if (const char* const data = std::getenv("XDG_DATA_HOME"); data && *data) {
    return (fs::path(data) / "lightcal" / "lights").string();
  }
  if (const char* const home = std::getenv("HOME"); home && *home) {
    return (fs::path(home) / ".local" / "share" / "lightcal" / "lights").string();
  }
  return Failed("no_library", "lights", "neither XDG_DATA_HOME nor HOME is set; give --library");
}

Result<std::vector<LibraryLight>> LightsInFolder(const std::string& folder, Warnings& warnings) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    return Failed("not_found", folder,
                  "no such folder; lights add light.json makes it, --library names another");
  }
  std::vector<std::string> paths;
  for (const auto& entry : fs::recursive_directory_iterator(
           folder, fs::directory_options::skip_permission_denied, error)) {
    std::error_code ignored;
    const bool json = entry.path().extension() == ".json";
    if (json && entry.is_regular_file(ignored)) paths.push_back(entry.path().string());
  }
  std::ranges::sort(paths);
  std::vector<LibraryLight> lights;
  for (const std::string& path : paths) {
    const auto text = ReadInputFile(path);
    if (!text || !LooksLikeLights(*text)) continue;
    auto file = LightFileFromJson(*text, path);
    if (!file) {
      const Error& fault = file.error();
      warnings.push_back({fault.code, fault.subject, fault.message + "; passed over"});
      continue;
    }
    for (FittedLight& light : file->lights) {
      lights.push_back({path, std::move(light), file->provenance});
    }
  }
  return lights;
}

Result<void> RefuseTakenName(const LibraryLight& entry, const std::string& name,
                             const std::vector<LibraryLight>& all) {
  LightFile renamed{{entry.light}, entry.provenance};
  renamed.lights.front().name = name;
  const auto files = LibraryFiles(renamed, fs::path(entry.path).parent_path().string());
  if (!files) return tl::unexpected(files.error());
  const std::string path = LowerAscii(files->front().path);
  const auto taken = std::ranges::find_if(
      all, [&](const LibraryLight& one) { return LowerAscii(one.path) == path; });
  if (taken == all.end() || (taken->path == entry.path && files->front().path != entry.path)) {
    return {};
  }
  return Failed("exists", name,
                taken->path == entry.path
                    ? "is what it is called already"
                    : "exists already (" + taken->path +
                          "): take another name, or lights remove that light first");
}

Result<std::vector<std::string>> AddToLibrary(const LightFile& file, const std::string& folder) {
  std::vector<std::string> paths;
  const auto outputs = LibraryFiles(file, folder);
  if (!outputs) return tl::unexpected(outputs.error());
  for (const OutputFile& output : *outputs) paths.push_back(output.path);
  if (auto written = WriteOutputs(*outputs, false); !written) return Propagate(std::move(written));
  return paths;
}

Result<void> RemoveFromLibrary(const LibraryLight& entry, const std::vector<LibraryLight>& all) {
  const auto beside = std::ranges::count(all, entry.path, &LibraryLight::path);
  if (beside > 1) {
    return Refused(
        "several_lights", entry.path,
        "holds " + std::to_string(beside) + " lights; lights add puts each into a file of its own");
  }
  std::error_code error;
  if (fs::remove(entry.path, error)) return {};
  return Failed("not_removed", entry.path, error ? error.message() : "it is gone already");
}

}  // namespace lightcal::app
