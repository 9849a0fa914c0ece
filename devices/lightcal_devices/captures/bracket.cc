// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/bracket.h"

#include <glob.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string_view>
#include <system_error>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/core/parallel.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/masked_picture.h"
#include "lightcal_devices/captures/picture.h"

namespace lightcal::devices {
namespace {

// Exposures this near are one setting: third stops are 26 % apart.
constexpr double kSameExposure = 0.02;

// "b_2" before "b_10": runs of digits compare as numbers.
bool NaturalLess(const std::string& a, const std::string& b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (!digit(a[i]) || !digit(b[j])) {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i;
      ++j;
      continue;
    }
    const auto run = [&](const std::string& s, std::size_t& at) {
      while (at < s.size() && s[at] == '0') ++at;
      const std::size_t first = at;
      while (at < s.size() && digit(s[at])) ++at;
      return std::string_view(s).substr(first, at - first);
    };
    const std::string_view m = run(a, i), n = run(b, j);
    if (m.size() != n.size()) return m.size() < n.size();
    if (m != n) return m < n;
  }
  return a.size() - i < b.size() - j;
}

Result<std::vector<std::string>> Matches(const std::string& pattern) {
  std::error_code ignored;
  if (std::filesystem::exists(pattern, ignored)) return std::vector{pattern};
  glob_t found{};
  const int error = glob(pattern.c_str(), GLOB_BRACE | GLOB_TILDE, nullptr, &found);
  std::vector<std::string> paths(found.gl_pathv, found.gl_pathv + found.gl_pathc);
  globfree(&found);
  if (error != 0 || paths.empty()) {
    return Failed("not_found", pattern, "no file of this name; check the path and the wildcards");
  }
  std::sort(paths.begin(), paths.end(), NaturalLess);
  return paths;
}

std::string Seconds3(std::optional<Seconds> time) {
  return time ? RoundedText(time->value(), 3) + " s" : "no time";
}

// The same bytes under two names, or one file named twice.
bool SameBytes(const std::string& a, const std::string& b, OpenFiles* files) {
  const auto one = MapFile(a, files), other = MapFile(b, files);
  if (!one || !other || one->size != other->size) return false;
  const bool same = std::memcmp(one->bytes.get(), other->bytes.get(), one->size) == 0;
  ReleasePages(*one);
  ReleasePages(*other);
  return same;
}

void LeaveOutDuplicates(Bracket& bracket, OpenFiles* files) {
  std::vector<FrameInfo> kept;
  for (FrameInfo& frame : bracket.frames) {
    const auto twin = std::find_if(kept.begin(), kept.end(), [&](const FrameInfo& k) {
      return SameBytes(k.file, frame.file, files);
    });
    if (twin == kept.end()) {
      kept.push_back(std::move(frame));
      continue;
    }
    bracket.warnings.push_back({"duplicate_frame", frame.file,
                                "it is the same picture as " + twin->file + " and is left out"});
  }
  bracket.frames = std::move(kept);
}

Result<void> MustAgree(const std::vector<FrameInfo>& frames) {
  const FrameInfo& first = frames.front();
  for (const FrameInfo& frame : frames) {
    if (frame.width != first.width || frame.height != first.height) {
      const auto size = [](const FrameInfo& f) {
        return std::to_string(f.width) + " x " + std::to_string(f.height);
      };
      return Refused("mixed_size", frame.file,
                     "it is " + size(frame) + ", " + first.file + " is " + size(first) +
                         "; a bracket has frames of one size");
    }
    if (frame.meaning != first.meaning || frame.channels != first.channels ||
        frame.cfa.values != first.cfa.values) {
      return Refused("mixed_kind", frame.file,
                     "it is another kind of picture than " + first.file +
                         " (RAW, linear, encoded, or its colour filter array); merge one kind");
    }
  }
  return {};
}

// Warns once, about the first frame that differs, where `value` is known of both.
void WarnWhereMixed(const std::vector<FrameInfo>& frames, const char* code, const char* what,
                    const char* effect,
                    const std::function<std::optional<double>(const FrameInfo&)>& value,
                    Warnings& warnings) {
  for (const FrameInfo& frame : frames) {
    const auto first = value(frames.front()), other = value(frame);
    if (!first || !other || std::abs(*other / *first - 1.0) <= kSameExposure) continue;
    warnings.push_back({code, frame.file,
                        std::string(what) + " " + RoundedText(*other, 3) + ", but " +
                            RoundedText(*first, 3) + " in " + frames.front().file + ": " + effect});
    return;
  }
}

void WarnOfDifferences(const std::vector<FrameInfo>& frames, Warnings& warnings) {
  WarnWhereMixed(
      frames, "mixed_iso", "ISO", "noise and clipping differ from frame to frame",
      [](const FrameInfo& f) { return f.exposure.iso; }, warnings);
  WarnWhereMixed(
      frames, "mixed_aperture", "f-number",
      "apertures repeat to about 5 % and blur differently; change the time instead",
      [](const FrameInfo& f) { return f.exposure.light_f_number(); }, warnings);
  const auto metres = [](std::optional<Metres> v) {
    return v ? std::optional(v->value()) : std::nullopt;
  };
  WarnWhereMixed(
      frames, "mixed_focus", "focused at metres", "the picture's size and light change with focus",
      [&](const FrameInfo& f) { return metres(f.subject_distance); }, warnings);
  WarnWhereMixed(
      frames, "mixed_focus", "focal length in metres", "the zoom moved between frames",
      [&](const FrameInfo& f) { return metres(f.focal_length); }, warnings);
}

void WarnOfExposures(const std::vector<FrameInfo>& frames, Warnings& warnings) {
  for (const FrameInfo& frame : frames) {
    warnings.insert(warnings.end(), frame.warnings.begin(), frame.warnings.end());
    if (!frame.exposure.time) {
      warnings.push_back({"no_exposure_time", frame.file,
                          "the file does not say how long it was exposed; give exposures"});
    }
    if (frame.lens_shading_in_opcodes) {
      warnings.push_back({"lens_shading_not_applied", frame.file,
                          "it asks readers to correct its lens shading, which is not done here; "
                          "calibrate a flat field with {CalibrateCamera}"});
    }
  }
  for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
    const auto& a = frames[i].exposure.time;
    const auto& b = frames[i + 1].exposure.time;
    if (a && b && std::abs(*b / *a - 1.0) <= kSameExposure &&
        frames[i].exposure.light_f_number() == frames[i + 1].exposure.light_f_number() &&
        frames[i].exposure.iso == frames[i + 1].exposure.iso) {
      warnings.push_back(
          {"repeated_exposure", frames[i + 1].file,
           "exposed as " + frames[i].file + " (" + Seconds3(a) + "): it lowers noise, not range"});
      return;
    }
  }
}

Result<void> Override(std::vector<FrameInfo>& frames, const BracketOverrides& overrides) {
  if (!overrides.exposure.empty() && overrides.exposure.size() != frames.size()) {
    return Refused("exposure_count", "exposures",
                   std::to_string(overrides.exposure.size()) + " exposures for " +
                       std::to_string(frames.size()) + " files; give one a file, in their order");
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    FrameExposure& exposure = frames[i].exposure;
    if (!overrides.exposure.empty()) {
      exposure.time = overrides.exposure[i];
      exposure.time_snapped = false;
    }
    if (overrides.f_number || overrides.t_stop) {
      exposure.f_number = overrides.f_number;
      exposure.t_stop = overrides.t_stop;
      exposure.f_number_snapped = false;
    }
    if (overrides.iso) exposure.iso = overrides.iso;
    exposure.overridden =
        !overrides.exposure.empty() || overrides.f_number || overrides.t_stop || overrides.iso;
  }
  return {};
}

// Light let onto the sensor, for sorting: t/N^2; an unknown f-number is one for all.
double Light(const FrameInfo& frame) {
  const double n = frame.exposure.light_f_number().value_or(1.0);
  return frame.exposure.time->value() * frame.exposure.iso.value_or(100.0) / (n * n);
}

void SortByExposure(std::vector<FrameInfo>& frames) {
  const bool all_timed = std::all_of(
      frames.begin(), frames.end(), [](const FrameInfo& f) { return f.exposure.time.has_value(); });
  if (!all_timed) return;
  std::stable_sort(frames.begin(), frames.end(),
                   [](const FrameInfo& a, const FrameInfo& b) { return Light(a) < Light(b); });
}

}  // namespace

Result<std::vector<std::string>> ExpandFiles(std::span<const std::string> patterns) {
  std::vector<std::string> files;
  for (const std::string& pattern : patterns) {
    auto matches = Matches(pattern);
    if (!matches) return matches;
    for (std::string& match : *matches) {
      if (std::find(files.begin(), files.end(), match) == files.end()) {
        files.push_back(std::move(match));
      }
    }
  }
  return files;
}

Result<Bracket> OpenBracket(std::span<const std::string> patterns,
                            const BracketOverrides& overrides, OpenFiles* open) {
  auto files = ExpandFiles(patterns);
  if (!files) return Propagate(std::move(files));
  if (files->empty()) return Failed("not_found", "bracket", "no files were named");
  // A RAW file is asked in a process of its own.
  std::vector<Result<FrameInfo>> asked(files->size(), FrameInfo{});
  ParallelFor(static_cast<int>(files->size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    asked[at] = ReadFrameInfo((*files)[at], open);
  });
  Bracket bracket;
  for (Result<FrameInfo>& info : asked) {
    if (!info) return Propagate(std::move(info));
    bracket.frames.push_back(std::move(*info));
  }
  if (auto ok = Override(bracket.frames, overrides); !ok) return Propagate(std::move(ok));
  LeaveOutDuplicates(bracket, open);
  if (auto ok = MustAgree(bracket.frames); !ok) return Propagate(std::move(ok));
  SortByExposure(bracket.frames);
  WarnOfDifferences(bracket.frames, bracket.warnings);
  WarnOfExposures(bracket.frames, bracket.warnings);
  return bracket;
}

namespace {

// The bracket's exposure for a frame read anew.
Result<void> TakeExposure(const FrameInfo& info, Frame& frame) {
  if (frame.info.width != info.width || frame.info.height != info.height) {
    return Failed("file_changed", info.file, "the file changed while it was read; try again");
  }
  frame.info.exposure = info.exposure;
  return {};
}

}  // namespace

Result<Frame> LoadFrame(const FrameInfo& info, SampleStore store, OpenFiles* files) {
  auto frame = ReadFrame(info.file, store, files);
  if (!frame) return frame;
  if (auto taken = TakeExposure(info, *frame); !taken) return Propagate(std::move(taken));
  return frame;
}

Result<MaskedPicture> LoadMaskedFrame(const FrameInfo& info, SampleStore store, OpenFiles* files) {
  auto picture = ReadMaskedFrame(info.file, store, files);
  if (!picture) return picture;
  if (auto taken = TakeExposure(info, picture->frame); !taken) return Propagate(std::move(taken));
  return picture;
}

Result<MaskedPicture> ReadMaskedFrame(const std::string& path, SampleStore store,
                                      OpenFiles* files) {
  if (!LooksLikeRaw(path)) {
    auto picture = ReadMaskedPicture(path, store, files);
    if (picture || picture.error().code != "unknown_format") return picture;
  }
  auto frame = ReadFrame(path, store, files);
  if (!frame) return Propagate(std::move(frame));
  return MaskedPicture{std::move(*frame), {}};
}

Result<FrameInfo> ReadFrameInfo(const std::string& path, OpenFiles* files) {
  if (LooksLikeRaw(path)) return ReadRawInfo(path, files);
  auto info = ReadPictureInfo(path, files);
  if (info || info.error().code != "unknown_format") return info;
  auto raw = ReadRawInfo(path, files);
  return raw ? raw : info;
}

Result<Frame> ReadFrame(const std::string& path, SampleStore store, OpenFiles* files) {
  if (LooksLikeRaw(path)) return ReadRaw(path, store, files);
  auto frame = ReadPicture(path, store, files);
  if (frame || frame.error().code != "unknown_format") return frame;
  auto raw = ReadRaw(path, store, files);
  return raw ? raw : frame;
}

}  // namespace lightcal::devices
