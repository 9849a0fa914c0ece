// SPDX-License-Identifier: Apache-2.0
#include "i2c_capture.h"

#include <archive.h>
#include <archive_entry.h>

#include <algorithm>
#include <map>
#include <memory>
#include <stdexcept>

namespace lightcal::test {
namespace {

constexpr unsigned kClock = 1;
constexpr unsigned kData = 2;

// Puts bits together between a start and a stop condition.
class Decoder {
 public:
  void Start() {
    Stop();
    open_ = true;
    bits_.clear();
    bytes_.clear();
  }
  void Bit(bool bit) {
    bits_.push_back(bit);
    if (bits_.size() < 9) return;
    unsigned value = 0;
    for (std::size_t i = 0; i < 8; ++i) value = value << 1U | (bits_[i] ? 1U : 0U);
    bytes_.emplace_back(value, !bits_[8]);
    bits_.clear();
  }
  void Stop() {
    if (open_ && !bytes_.empty()) transfers_.push_back(Transfer());
    open_ = false;
  }
  [[nodiscard]] std::vector<I2cTransfer> Take() { return std::move(transfers_); }

 private:
  [[nodiscard]] I2cTransfer Transfer() const {
    I2cTransfer transfer;
    transfer.address = static_cast<std::uint8_t>(bytes_.front().first >> 1U);
    transfer.is_read = (bytes_.front().first & 1U) != 0;
    transfer.acknowledged = bytes_.front().second;
    for (std::size_t i = 1; i < bytes_.size(); ++i) {
      transfer.bytes.push_back(static_cast<std::byte>(bytes_[i].first));
    }
    return transfer;
  }

  bool open_ = false;
  std::vector<bool> bits_;
  std::vector<std::pair<unsigned, bool>> bytes_;
  std::vector<I2cTransfer> transfers_;
};

}  // namespace

std::vector<std::uint8_t> SamplesOfSigrok(const std::string& path) {
  const std::unique_ptr<archive, decltype(&archive_read_free)> zip(archive_read_new(),
                                                                   &archive_read_free);
  archive_read_support_format_zip(zip.get());
  if (archive_read_open_filename(zip.get(), path.c_str(), 1U << 16U) != ARCHIVE_OK) {
    throw std::runtime_error(path + ": no zip");
  }
  std::map<int, std::vector<std::uint8_t>> parts;
  const std::string prefix = "logic-1-";
  archive_entry* entry = nullptr;
  while (archive_read_next_header(zip.get(), &entry) == ARCHIVE_OK) {
    const std::string name = archive_entry_pathname(entry);
    if (!name.starts_with(prefix)) continue;
    auto& part = parts[std::stoi(name.substr(prefix.size()))];
    part.resize(static_cast<std::size_t>(archive_entry_size(entry)));
    if (archive_read_data(zip.get(), part.data(), part.size()) < 0) {
      throw std::runtime_error(path + ": damaged");
    }
  }
  std::vector<std::uint8_t> samples;
  for (const auto& [number, part] : parts) samples.insert(samples.end(), part.begin(), part.end());
  return samples;
}

std::vector<I2cTransfer> DecodeI2c(const std::vector<std::uint8_t>& samples) {
  Decoder decoder;
  unsigned before = kClock | kData;
  for (const unsigned now : samples) {
    const bool clock_stays_high = (before & now & kClock) != 0;
    const unsigned changed = before ^ now;
    if (clock_stays_high && (changed & kData) != 0) {
      (now & kData) == 0 ? decoder.Start() : decoder.Stop();
    } else if ((changed & now & kClock) != 0) {
      decoder.Bit((now & kData) != 0);
    }
    before = now;
  }
  return decoder.Take();
}

Result<void> CapturedBus::Write(devices::i2c::Address address, std::span<const std::byte> bytes) {
  const auto is_it = [&](const I2cTransfer& transfer) {
    return !transfer.is_read && transfer.address == address && transfer.acknowledged &&
           std::ranges::equal(transfer.bytes, bytes);
  };
  if (next_ == transfers_.size() || !is_it(transfers_[next_])) {
    return Failed(std::string(devices::i2c::kNack), "capture", "another transfer was captured");
  }
  ++next_;
  while (next_ < transfers_.size() && is_it(transfers_[next_])) ++next_;
  return {};
}

Result<devices::Bytes> CapturedBus::Read(devices::i2c::Address address, std::size_t count) {
  if (next_ == transfers_.size() || !transfers_[next_].is_read ||
      transfers_[next_].address != address || transfers_[next_].bytes.size() != count) {
    return Failed(std::string(devices::i2c::kNack), "capture", "another transfer was captured");
  }
  return transfers_[next_++].bytes;
}

Result<devices::Bytes> CapturedBus::WriteThenRead(devices::i2c::Address address,
                                                  std::span<const std::byte> bytes,
                                                  std::size_t count) {
  if (auto written = Write(address, bytes); !written) return tl::unexpected(written.error());
  return Read(address, count);
}

}  // namespace lightcal::test
