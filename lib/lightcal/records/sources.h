// SPDX-License-Identifier: Apache-2.0
// What opens files and pictures, as functions: the library calibrates from whatever answers them.
// devices' DiskSources() answers from disk.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal/core/view2d.h"
#include "lightcal/records/bracket.h"
#include "lightcal/records/charuco_board.h"
#include "lightcal/records/frame.h"
#include "lightcal/records/imported_file.h"
#include "lightcal/records/masked_picture.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/picture_feature.h"

namespace lightcal {

// Every member must be set. They may be called from several threads at once.
struct Sources {
  // Paths and wildcards (*, ?, [..]) -> files: each wildcard's matches by name, digits as numbers.
  // Fails: not_found (nothing matches).
  std::function<Result<std::vector<std::string>>(std::span<const std::string> patterns)>
      expand_files;
  std::function<bool(const std::string& path)> exists;

  // The bytes of a whole file. Fails: not_found, unreadable.
  std::function<Result<std::string>(const std::string& path)> read_text;
  // SHA-256 of a file's bytes, lower-case hex: of those that another function here read, where one
  // did.   Fails as read_text.
  std::function<Result<std::string>(const std::string& path)> sha256;

  // The spectra and readings of a meter's export.
  // Fails: not_found, unreadable. Refused: unknown_format, bad_spectrum and others, by the format.
  std::function<Result<ImportedFile>(const std::string& path)> read_spectra;
  // An IES or EULUMDAT file, with the TILT file beside it.
  // Fails: not_found, unreadable. Refused: too_large, and as PhotometricFromText.
  std::function<Result<ReadPhotometric>(const std::string& path)> read_photometric;

  // Every file's tags, no samples. Refused: mixed_size, mixed_kind, exposure_count, and what a
  // picture is refused for: unknown_format, bad_picture, unsupported_picture, too_large.
  std::function<Result<Bracket>(std::span<const std::string> patterns,
                                const BracketOverrides& overrides)>
      open_bracket;
  std::function<Result<FrameInfo>(const std::string& path)> read_frame_info;
  // A picture with its samples. Refused besides: bad_samples (NaN, infinity, beyond 1e30).
  std::function<Result<Frame>(const std::string& path)> read_frame;
  // The samples of a bracket's frame; their exposure is that of `info`. Fails besides:
  // file_changed, no_scratch_space.
  std::function<Result<Frame>(const FrameInfo& info)> load_frame;
  // The same, where bad samples are masked instead.
  std::function<Result<MaskedPicture>(const std::string& path)> read_masked_frame;
  std::function<Result<MaskedPicture>(const FrameInfo& info, SampleStore store)> load_masked_frame;

  // The chessboard corners of a printed board in a linear picture of any scale. Fails:
  // no_board_module. Refused: bad_board, board_not_found, board_too_small, board_blurred.
  std::function<Result<std::vector<BoardCorner>>(View2d<const float> luminance,
                                                 const CharucoBoard& board)>
      find_board;
  // Centres x, y of the corner patches of a chart of 6 x 4 patches in a linear picture of three
  // channels. Fails: no_board_module. Refused: chart_not_found.
  std::function<Result<std::array<double, 8>>(View2d<const float> rgb)> find_chart;
  // The places of a grey picture that can be found again in another, `most` at most, where `seen`
  // is not 0. May be called from several threads.   Fails: no_board_module.
  std::function<Result<std::vector<PictureFeature>>(View2d<const std::uint8_t> grey,
                                                    View2d<const std::uint8_t> seen, int most)>
      find_features;
};

}  // namespace lightcal
