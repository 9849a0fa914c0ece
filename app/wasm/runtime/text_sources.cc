// SPDX-License-Identifier: Apache-2.0
// The files that need no pictures: texts, spectra, IES and EULUMDAT. Stands in for
// devices/lightcal_devices/disk_sources.cc, whose pictures and boards need libraries that this
// module has not.
#include <array>
#include <bit>
#include <cstdint>
#include <memory>

#include "lightcal_devices/disk_sources.h"
#include "lightcal_devices/files/read_files.h"

namespace lightcal::devices {
namespace {

using Block = std::array<std::uint32_t, 16>;
using State = std::array<std::uint32_t, 8>;

// The first 32 bits of the fractional parts of the roots of the first primes, by Newton's method
// in whole numbers.  Source: FIPS 180-4, 4.2.2 and 5.3.3.
struct Constants {
  std::array<std::uint32_t, 64> cube_roots{};
  State square_roots{};
};
constexpr Constants MakeConstants() {
  Constants constants;
  std::size_t found = 0;
  for (unsigned n = 2; found < 64; ++n) {
    bool prime = true;
    for (unsigned d = 2; d * d <= n; ++d) prime = prime && n % d != 0;
    if (!prime) continue;
    using Wide = unsigned __int128;
    const auto root = [n](int power) {
      const Wide target = static_cast<Wide>(n) << (power == 2 ? 64 : 96);
      std::uint64_t low = 0, high = std::uint64_t{1} << 37U;  // root(311) 2^32 lies below
      while (high - low > 1) {
        const std::uint64_t middle = (low + high) / 2;
        Wide product = static_cast<Wide>(middle) * middle;
        if (power == 3) product *= middle;
        (product <= target ? low : high) = middle;
      }
      return static_cast<std::uint32_t>(low);
    };
    constants.cube_roots[found] = root(3);
    if (found < 8) constants.square_roots[found] = root(2);
    ++found;
  }
  return constants;
}
constexpr Constants kConstants = MakeConstants();
static_assert(kConstants.square_roots[0] == 0x6a09e667 && kConstants.cube_roots[63] == 0xc67178f2);

// Source: FIPS 180-4, 6.2.2.
void Digest(State& state, const Block& block) {
  std::array<std::uint32_t, 64> w{};
  for (std::size_t t = 0; t < 64; ++t) {
    if (t < 16) {
      w[t] = block[t];
      continue;
    }
    const std::uint32_t a = w[t - 15], b = w[t - 2];
    w[t] = (std::rotr(b, 17) ^ std::rotr(b, 19) ^ (b >> 10U)) + w[t - 7] +
           (std::rotr(a, 7) ^ std::rotr(a, 18) ^ (a >> 3U)) + w[t - 16];
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t first = h + (std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25)) +
                                ((e & f) ^ (~e & g)) + kConstants.cube_roots[t] + w[t];
    const std::uint32_t second =
        (std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22)) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + first, d = c, c = b, b = a, a = first + second;
  }
  const State add = {a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += add[i];
}

tl::unexpected<Error> NeedsPictures(const std::string& path) {
  return Refused("needs_pictures", path,
                 "pictures are read by the lightcal program alone (Linux); this is the module "
                 "that runs in a browser and in node");
}

}  // namespace

std::string Sha256Hex(std::string_view bytes) {
  std::string padded(bytes);
  padded += '\x80';
  while (padded.size() % 64 != 56) padded += '\0';
  const std::uint64_t bits = 8 * static_cast<std::uint64_t>(bytes.size());
  for (int shift = 56; shift >= 0; shift -= 8) padded += static_cast<char>(bits >> shift);
  State state = kConstants.square_roots;
  for (std::size_t at = 0; at < padded.size(); at += 64) {
    Block block{};
    for (std::size_t i = 0; i < 64; ++i) {
      block[i / 4] = block[i / 4] << 8U | static_cast<unsigned char>(padded[at + i]);
    }
    Digest(state, block);
  }
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string text;
  for (const std::uint32_t word : state) {
    for (int shift = 28; shift >= 0; shift -= 4) text += kHex[word >> shift & 0xFU];
  }
  return text;
}

Sources DiskSources() {
  const auto files = std::make_shared<ReadFiles>();
  Sources sources;
  sources.expand_files = [](std::span<const std::string> patterns) {
    return Result<std::vector<std::string>>(NeedsPictures(patterns.empty() ? "" : patterns[0]));
  };
  AddFileSources(files, sources);
  sources.sha256 = [files](const std::string& path) -> Result<std::string> {
    const auto text = files->Text(path);
    if (!text) return text;
    return Sha256Hex(*text);
  };
  sources.open_bracket = [](std::span<const std::string> patterns, const BracketOverrides&) {
    return Result<Bracket>(NeedsPictures(patterns.empty() ? "" : patterns[0]));
  };
  sources.read_frame_info = [](const std::string& path) {
    return Result<FrameInfo>(NeedsPictures(path));
  };
  sources.read_frame = [](const std::string& path) { return Result<Frame>(NeedsPictures(path)); };
  sources.load_frame = [](const FrameInfo& info) {
    return Result<Frame>(NeedsPictures(info.file));
  };
  sources.read_masked_frame = [](const std::string& path) {
    return Result<MaskedPicture>(NeedsPictures(path));
  };
  sources.load_masked_frame = [](const FrameInfo& info, SampleStore) {
    return Result<MaskedPicture>(NeedsPictures(info.file));
  };
  return sources;
}

}  // namespace lightcal::devices
