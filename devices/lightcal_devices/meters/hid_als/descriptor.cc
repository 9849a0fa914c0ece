// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/hid_als/descriptor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

namespace lightcal::devices::hid_als {
namespace {

using ByteSpan = std::span<const std::byte>;

tl::unexpected<Error> Bad(const std::string& what) {
  return Failed(std::string(kBadDescriptor), "report descriptor",
                what + "; the device describes itself wrongly and cannot be read");
}

// bSize of a short item: 0, 1, 2 or 4 bytes of data.
struct Item {
  unsigned type = 0;  // 0 main, 1 global, 2 local
  unsigned tag = 0;
  std::size_t data_bytes = 0;
  std::uint32_t value = 0;

  [[nodiscard]] std::int64_t Signed() const {
    switch (data_bytes) {
      case 1:
        return static_cast<std::int8_t>(value);
      case 2:
        return static_cast<std::int16_t>(value);
      default:
        return static_cast<std::int32_t>(value);
    }
  }
};

struct Globals {
  std::uint32_t usage_page = 0;
  Item logical_min;
  Item logical_max;
  std::int8_t unit_exponent = 0;
  std::uint32_t report_size = 0;
  std::uint32_t report_count = 0;
  std::uint8_t report = 0;

  [[nodiscard]] std::int64_t Minimum() const { return logical_min.Signed(); }
  // Unsigned where nothing negative is meant: 26 FF FF is then 65535, not -1.
  [[nodiscard]] std::int64_t Maximum() const {
    return Minimum() < 0 ? logical_max.Signed() : static_cast<std::int64_t>(logical_max.value);
  }
};

class Parser {
 public:
  explicit Parser(ByteSpan bytes) : bytes_(bytes) {}

  Result<ReportDescriptor> Parse() {
    if (bytes_.size() > kLongestDescriptor) return Bad("longer than 4096 bytes");
    while (at_ < bytes_.size()) {
      auto item = Next();
      if (!item) return Propagate(std::move(item));
      if (auto taken = Take(*item); !taken) return tl::unexpected(taken.error());
    }
    if (!collections_.empty()) return Bad("a collection has no end");
    for (const auto& [which, bits] : ends_) {
      result_.lengths.push_back({which.first, which.second, bits});
    }
    return std::move(result_);
  }

 private:
  static constexpr unsigned kMain = 0;
  static constexpr unsigned kGlobal = 1;
  static constexpr unsigned kLocal = 2;

  Result<Item> Next() {
    const auto prefix = std::to_integer<unsigned>(bytes_[at_]);
    ++at_;
    Item item;
    item.type = (prefix >> 2U) & 3U;
    item.tag = prefix >> 4U;
    item.data_bytes = (prefix & 3U) == 3U ? 4 : prefix & 3U;
    constexpr unsigned kLongItem = 0xFE;
    if (prefix == kLongItem && at_ < bytes_.size()) {
      item.type = 3;  // reserved: no one takes it
      item.data_bytes = 2 + std::to_integer<std::size_t>(bytes_[at_]);
    }
    if (bytes_.size() - at_ < item.data_bytes) {
      return Bad("cut short at byte " + std::to_string(bytes_.size()));
    }
    for (std::size_t i = 0; item.type != 3 && i < item.data_bytes; ++i) {
      item.value |= std::to_integer<std::uint32_t>(bytes_[at_ + i]) << (8U * i);
    }
    at_ += item.data_bytes;
    return item;
  }

  Result<void> Take(const Item& item) {
    if (item.type == kGlobal) return TakeGlobal(item);
    if (item.type == kLocal) return TakeLocal(item);
    if (item.type == kMain) return TakeMain(item);
    return {};
  }

  Result<void> TakeGlobal(const Item& item) {
    switch (item.tag) {
      case 0x0:
        globals_.usage_page = item.value & 0xFFFFU;
        return {};
      case 0x1:
        globals_.logical_min = item;
        return {};
      case 0x2:
        globals_.logical_max = item;
        return {};
      case 0x5:  // a nibble in two's complement
        globals_.unit_exponent =
            static_cast<std::int8_t>(item.value & 0x8U ? static_cast<int>(item.value & 0xFU) - 16
                                                       : static_cast<int>(item.value & 0xFU));
        return {};
      case 0x7:
        globals_.report_size = item.value;
        return {};
      case 0x8:
        if (item.value == 0 || item.value > 255) return Bad("a report number outside 1..255");
        globals_.report = static_cast<std::uint8_t>(item.value);
        result_.numbered = true;
        return {};
      case 0x9:
        globals_.report_count = item.value;
        return {};
      case 0xA:
        if (stack_.size() == kDeepestNesting) return Bad("pushes too deep");
        stack_.push_back(globals_);
        return {};
      case 0xB:
        if (stack_.empty()) return Bad("pops more than it pushed");
        globals_ = stack_.back();
        stack_.pop_back();
        return {};
      default:
        return {};  // physical range, unit
    }
  }

  // A usage of four bytes brings its own page.
  [[nodiscard]] Usage Complete(const Item& item) const {
    return item.data_bytes == 4 ? item.value : globals_.usage_page << 16U | item.value;
  }

  Result<void> TakeLocal(const Item& item) {
    if (item.tag == 0x0) return AddUsages(Complete(item), Complete(item));
    if (item.tag == 0x1) range_from_ = Complete(item);
    if (item.tag == 0x2 && range_from_) {
      const Usage from = *range_from_;
      range_from_.reset();
      return AddUsages(from, Complete(item));
    }
    return {};
  }

  Result<void> AddUsages(Usage from, Usage to) {
    if (to < from || to - from >= kMostFields - std::min(usages_.size(), kMostFields)) {
      return Bad("a range of usages that ends before it begins, or has too many");
    }
    for (Usage usage = from;; ++usage) {
      usages_.push_back(usage);
      if (usage == to) return {};
    }
  }

  void ForgetLocals() {
    usages_.clear();
    range_from_.reset();
  }

  Result<void> TakeMain(const Item& item) {
    Result<void> taken;
    switch (item.tag) {
      case 0x8:
        taken = AddData(ReportKind::kInput, item.value);
        break;
      case 0x9:
        taken = AddData(ReportKind::kOutput, item.value);
        break;
      case 0xB:
        taken = AddData(ReportKind::kFeature, item.value);
        break;
      case 0xA:
        if (collections_.size() == kDeepestNesting) return Bad("nests too deep");
        collections_.push_back(usages_.empty() ? 0 : usages_.back());
        break;
      case 0xC:
        if (collections_.empty()) return Bad("ends a collection that never began");
        collections_.pop_back();
        break;
      default:
        break;
    }
    ForgetLocals();
    return taken;
  }

  Result<void> AddData(ReportKind kind, std::uint32_t flags) {
    constexpr std::uint32_t kConstant = 0x01;
    constexpr std::uint32_t kVariable = 0x02;
    const std::uint32_t size = globals_.report_size;
    const std::uint32_t count = globals_.report_count;
    std::uint32_t& end = ends_[{kind, globals_.report}];
    if (end == 0 && globals_.report != 0) end = 8;  // the number itself
    if (size > kLongestReportBits || count > kLongestReportBits ||
        std::uint64_t{size} * count > kLongestReportBits - end) {
      return Bad("a report longer than 4096 bytes");
    }
    const std::uint32_t begin = end;
    end += size * count;
    if ((flags & kConstant) != 0 || size == 0 || size > 32 || usages_.empty()) return {};
    for (std::uint32_t i = 0; i < count; ++i) {
      if (result_.fields.size() == kMostFields) return Bad("has too many fields");
      const bool is_variable = (flags & kVariable) != 0;
      // The last usage stands for all that remain.
      const Usage usage = usages_[std::min<std::size_t>(i, usages_.size() - 1)];
      AddField(kind, begin + i * size, is_variable ? usage : 0,
               is_variable ? std::vector<Usage>() : usages_);
    }
    return {};
  }

  void AddField(ReportKind kind, std::uint32_t bit_offset, Usage usage,
                std::vector<Usage> choices) {
    Field field;
    field.kind = kind;
    field.report = globals_.report;
    field.usage = usage;
    field.choices = std::move(choices);
    field.collections = collections_;
    field.bit_offset = bit_offset;
    field.bit_count = static_cast<std::uint8_t>(globals_.report_size);
    field.logical_min = globals_.Minimum();
    field.logical_max = globals_.Maximum();
    field.unit_exponent = globals_.unit_exponent;
    result_.fields.push_back(std::move(field));
  }

  ByteSpan bytes_;
  std::size_t at_ = 0;
  ReportDescriptor result_;
  Globals globals_;
  std::vector<Globals> stack_;
  std::vector<Usage> collections_;
  std::vector<Usage> usages_;
  std::optional<Usage> range_from_;
  std::map<std::pair<ReportKind, std::uint8_t>, std::uint32_t> ends_;  // in bits
};

bool Reaches(const Field& field, std::size_t bytes) {
  return std::uint64_t{field.bit_offset} + field.bit_count <= std::uint64_t{bytes} * 8U;
}

}  // namespace

std::optional<std::int64_t> Field::RawIn(ByteSpan report_bytes) const {
  if (!Reaches(*this, report_bytes.size())) return std::nullopt;
  std::uint64_t bits = 0;
  for (std::uint32_t i = 0; i < bit_count; ++i) {
    const std::uint32_t at = bit_offset + i;
    const std::uint64_t bit = (std::to_integer<unsigned>(report_bytes[at / 8U]) >> (at % 8U)) & 1U;
    bits |= bit << i;
  }
  auto raw = static_cast<std::int64_t>(bits);
  const bool is_negative = logical_min < 0 && ((bits >> (bit_count - 1U)) & 1U) != 0;
  if (is_negative) raw -= std::int64_t{1} << bit_count;
  if (raw < logical_min || raw > logical_max) return std::nullopt;
  return raw;
}

std::optional<double> Field::ValueIn(ByteSpan report_bytes) const {
  const auto raw = RawIn(report_bytes);
  if (!raw) return std::nullopt;
  // Dividing by a whole power of ten rounds once; multiplying by 0.01 would twice.
  const double scale = std::pow(10.0, std::abs(static_cast<int>(unit_exponent)));
  const auto value = static_cast<double>(*raw);
  return unit_exponent < 0 ? value / scale : value * scale;
}

std::optional<Usage> Field::ChoiceIn(ByteSpan report_bytes) const {
  const auto raw = RawIn(report_bytes);
  if (!raw) return std::nullopt;
  const auto index = static_cast<std::uint64_t>(*raw - logical_min);
  if (index >= choices.size()) return std::nullopt;
  return choices[static_cast<std::size_t>(index)];
}

bool Field::Put(std::int64_t raw, std::span<std::byte> report_bytes) const {
  if (!Reaches(*this, report_bytes.size())) return false;
  const auto bits = static_cast<std::uint64_t>(raw);
  for (std::uint32_t i = 0; i < bit_count; ++i) {
    const std::uint32_t at = bit_offset + i;
    const auto mask = static_cast<std::byte>(1U << (at % 8U));
    std::byte& target = report_bytes[at / 8U];
    target = ((bits >> i) & 1U) != 0 ? target | mask : target & ~mask;
  }
  return true;
}

std::size_t ReportDescriptor::ReportBytes(ReportKind kind, std::uint8_t report) const {
  for (const ReportLength& length : lengths) {
    if (length.kind == kind && length.report == report) return (length.bits + 7U) / 8U;
  }
  return 0;
}

Result<ReportDescriptor> ParseReportDescriptor(ByteSpan bytes) { return Parser(bytes).Parse(); }

}  // namespace lightcal::devices::hid_als
