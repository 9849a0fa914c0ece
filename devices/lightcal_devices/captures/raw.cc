// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/raw.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string_view>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal_devices/captures/frame_files_module.h"
#include "lightcal_devices/captures/mapped_file.h"
#include "lightcal_devices/captures/raw_answer.h"
#include "lightcal_devices/captures/raw_info.h"
#include "lightcal_devices/captures/safe_process.h"

namespace lightcal::devices {
namespace {

tl::unexpected<Error> Damaged(const std::string& path) {
  return Refused("bad_picture", path,
                 "the file is damaged: LibRaw breaks off over it; copy it from the card again");
}

// The answer of a decoding process, mapped.
struct Answered {
  MappedFile file;
  [[nodiscard]] const RawAnswer& answer() const {
    return *static_cast<const RawAnswer*>(file.bytes.get());
  }
};

Result<Answered> Ask(const std::string& path, SampleStore store, bool with_samples,
                     OpenFiles* files) {
  const auto raw = MapFile(path, files);
  if (!raw) return tl::unexpected(raw.error());
  auto scratch =
      OpenScratch(store == SampleStore::kMemory ? ScratchPlace::kMemory : ScratchPlace::kDisk);
  if (!scratch) return Propagate(std::move(scratch));
  const auto module = FrameFilesModule();
  if (!module) return tl::unexpected(module.error());
  const auto ended =
      RunInSafeProcess([&] { (*module)->decode_raw(path, *raw, with_samples, scratch->get()); });
  if (!ended) return tl::unexpected(ended.error());
  auto file = MapWritten(*scratch, path);
  if (!file) return Propagate(std::move(file));
  if (*ended != ProcessEnd::kDone || file->size < sizeof(RawAnswer)) return Damaged(path);
  Answered answered{std::move(*file)};
  const RawAnswer& answer = answered.answer();
  if (answer.is_error) {
    return tl::unexpected(
        Error{answer.error_kind, answer.code.data(), path, answer.message.data()});
  }
  return answered;
}

template <class Sample>
Result<Frame> FrameOf(const Answered& answered, FrameInfo info, SampleStore store) {
  const RawAnswer& answer = answered.answer();
  const auto sample = static_cast<std::int64_t>(sizeof(Sample));
  const std::int64_t used = std::int64_t{info.width} * answer.channels * sample;
  const std::int64_t room = static_cast<std::int64_t>(answered.file.size - kSamplesAt);
  const bool fits = answer.channels == info.channels && answer.row_bytes % sample == 0 &&
                    answer.left_bytes >= 0 && answer.left_bytes % sample == 0 &&
                    answer.left_bytes + used <= answer.row_bytes &&
                    answer.row_bytes * info.height <= room;
  if (!fits) return Damaged(info.file);
  const auto* bytes = static_cast<const std::byte*>(answered.file.bytes.get()) + kSamplesAt;
  const auto* first = reinterpret_cast<const Sample*>(bytes + answer.left_bytes);
  const View2d<const Sample> view(first, info.width, info.height, info.channels,
                                  answer.row_bytes / sample);
  return Frame{std::move(info), view, answered.file.bytes, store == SampleStore::kScratchFile};
}

}  // namespace

bool LooksLikeRaw(const std::string& path) {
  static constexpr std::array kExtensions = {".dng", ".nef", ".nrw", ".cr2", ".cr3", ".crw", ".arw",
                                             ".srf", ".sr2", ".raf", ".rw2", ".orf", ".pef", ".srw",
                                             ".kdc", ".dcr", ".3fr", ".fff", ".iiq", ".rwl", ".mrw",
                                             ".x3f", ".erf", ".mef", ".mos", ".raw", ".gpr"};
  const std::string name = LowerAscii(path);
  return std::any_of(kExtensions.begin(), kExtensions.end(),
                     [&](std::string_view extension) { return name.ends_with(extension); });
}

Result<FrameInfo> ReadRawInfo(const std::string& path, OpenFiles* files) {
  const auto answered = Ask(path, SampleStore::kMemory, false, files);
  if (!answered) return tl::unexpected(answered.error());
  return FrameInfoOf(answered->answer(), path);
}

Result<Frame> ReadRaw(const std::string& path, SampleStore store, OpenFiles* files) {
  const auto answered = Ask(path, store, true, files);
  if (!answered) return tl::unexpected(answered.error());
  auto info = FrameInfoOf(answered->answer(), path);
  if (!info) return Propagate(std::move(info));
  if (answered->file.size <= kSamplesAt || info->width < 1 || info->height < 1) {
    return Damaged(path);
  }
  return answered->answer().samples == RawAnswer::Samples::kFloat
             ? FrameOf<float>(*answered, std::move(*info), store)
             : FrameOf<std::uint16_t>(*answered, std::move(*info), store);
}

}  // namespace lightcal::devices
