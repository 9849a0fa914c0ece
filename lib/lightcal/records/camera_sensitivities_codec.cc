// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <charconv>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "lightcal/records/camera_sensitivities.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace {

using records::Node;

constexpr double kFromNm = 400.0, kToNm = 700.0;  // what has to be there
constexpr double kSameStep = 1e-6;

struct Row {
  double wavelength_nm = 0.0;
  std::array<double, 3> channels{};
};

const Node* Find(const Node* table, std::string_view key) {
  const bool is_table = table != nullptr && table->kind == Node::Kind::kTable;
  return is_table ? table->Find(key) : nullptr;
}

std::string TextOf(const Node* node) {
  return node != nullptr && node->kind == Node::Kind::kText ? node->text : std::string();
}

std::optional<Row> RowOf(const records::Member& member) {
  Row row;
  const char* end = member.key.data() + member.key.size();
  const auto parsed = std::from_chars(member.key.data(), end, row.wavelength_nm);
  if (parsed.ec != std::errc() || parsed.ptr != end || member.value.items.size() != 3) {
    return std::nullopt;
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const Node& value = member.value.items[c];
    if (!value.IsNumber() || !std::isfinite(value.number)) return std::nullopt;
    row.channels[c] = value.number;
  }
  return row;
}

// Why the rows are no sensitivities; empty where they are.
std::string FaultOf(const std::vector<Row>& rows) {
  if (rows.size() < 2) return "holds fewer than two wavelengths";
  const double step = rows[1].wavelength_nm - rows[0].wavelength_nm;
  if (!(step > 0.0)) return "names a wavelength twice";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (std::abs(rows[i].wavelength_nm - rows[i - 1].wavelength_nm - step) > kSameStep) {
      return "its wavelengths are not equally spaced";
    }
  }
  return {};
}

tl::unexpected<Error> Bad(std::string_view where, const std::string& what) {
  return Refused("bad_sensitivities", std::string(where),
                 what +
                     "; a file of rawtoaces-data is wanted: header and spectral_data with R, G "
                     "and B at each wavelength");
}

}  // namespace

Result<CameraSensitivities> CameraSensitivitiesFromJson(std::string_view text,
                                                        std::string_view where) {
  const auto root = records::ParseJson(text);
  if (!root) return Bad(where, "not valid JSON: " + root.error().message);
  const Node* spectral = Find(&*root, "spectral_data");
  const Node* index = Find(Find(spectral, "index"), "main");
  const Node* data = Find(Find(spectral, "data"), "main");
  const bool rgb = index != nullptr && index->items.size() == 3 &&
                   TextOf(&index->items[0]) == "R" && TextOf(&index->items[1]) == "G" &&
                   TextOf(&index->items[2]) == "B";
  if (!rgb || data == nullptr || data->kind != Node::Kind::kTable) {
    return Bad(where, "holds no sensitivities of R, G and B");
  }
  std::vector<Row> rows;
  for (const records::Member& member : data->members) {
    const auto row = RowOf(member);
    if (!row) return Bad(where, "wavelength " + member.key + " holds no three numbers");
    rows.push_back(*row);
  }
  std::ranges::sort(rows, {}, &Row::wavelength_nm);
  if (const std::string fault = FaultOf(rows); !fault.empty()) return Bad(where, fault);

  CameraSensitivities out;
  const Node* header = Find(&*root, "header");
  out.camera = TextOf(Find(header, "manufacturer"));
  const std::string model = TextOf(Find(header, "model"));
  if (!out.camera.empty() && !model.empty()) out.camera += " ";
  out.camera += model;
  out.first_nm = rows.front().wavelength_nm;
  out.step_nm = rows[1].wavelength_nm - rows[0].wavelength_nm;
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < 3; ++c) out.channels[c].push_back(row.channels[c]);
  }
  if (const std::string fault = FaultOf(out); !fault.empty()) return Bad(where, fault);
  return out;
}

std::string FaultOf(const CameraSensitivities& sensitivities) {
  const auto& channels = sensitivities.channels;
  const std::size_t count = channels[0].size();
  if (count < 2 || channels[1].size() != count || channels[2].size() != count) {
    return "holds fewer than two wavelengths, or channels of unequal length";
  }
  const double last =
      sensitivities.first_nm + sensitivities.step_nm * static_cast<double>(count - 1);
  if (sensitivities.first_nm > kFromNm || !(last >= kToNm)) return "does not cover 400-700 nm";
  for (const auto& channel : channels) {
    const double sum = std::accumulate(channel.begin(), channel.end(), 0.0);
    if (!(sum > 0.0) || !std::isfinite(sum)) return "has a channel that sees nothing";
  }
  return {};
}

}  // namespace lightcal
