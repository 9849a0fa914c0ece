// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "lightcal/records/accuracy_profile.h"
#include "lightcal/records/field_reader.h"
#include "lightcal/records/field_writer.h"
#include "lightcal/records/json_codec.h"

namespace lightcal {
namespace records {
namespace {

constexpr NumberRule kToleranceRule{[](double v) { return v > 0.0 && v < 1.0; },
                                    "must lie between 0 and 1: 0.01 is 1 %"};
constexpr int kMostPatches = 64;
constexpr int kFewestSamples = 100;  // or none at all
constexpr int kMostSamples = 10'000'000;

template <class Archive, class Estimator>
void VisitEstimator(Archive& archive, Estimator& choice) {
  archive.Word("solver", choice.solver, kSolverWords);
  archive.Truth("reject", choice.reject);
  archive.Truth("leave_one_out", choice.leave_one_out);
  archive.Truth("exact_source", choice.exact_source);
  archive.Integer("bounce_patches", choice.bounce_patches);
  archive.Integer("interval_samples", choice.interval_samples);
}

template <class Archive, class Pictures>
void VisitPictures(Archive& archive, Pictures& choice) {
  archive.Integer("frame_stride", choice.frame_stride);
  archive.Integer("pixel_stride", choice.pixel_stride);
  archive.Truth("average_pixels", choice.average_pixels);
  archive.Word("estimator", choice.estimator, kMergeEstimatorWords);
  archive.Truth("measure_ratios", choice.measure_ratios);
  archive.Truth("check_frames", choice.check_frames);
}

template <class Archive, class Profile>
void VisitProfile(Archive& archive, Profile& profile) {
  archive.Number("tolerance_relative", profile.tolerance_relative, kToleranceRule);
  archive.Text("effects", profile.effects);
  archive.Group("estimator", [&](auto& a) { VisitEstimator(a, profile.estimator); });
  archive.Word("cct_method", profile.cct_method, kCctMethodWords);
  archive.Integer("reading_stride", profile.reading_stride);
  archive.Number("spectral_step_nm", profile.spectral_step_nm, kNotNegative);
  archive.Number("table_step_deg", profile.table_step_deg, kNotNegative);
  archive.Group("pictures", [&](auto& a) { VisitPictures(a, profile.pictures); });
}

void CheckCounts(FieldReader& reader, const AccuracyProfile& profile) {
  const auto check = [&](std::string_view key, int value, int least, int most) {
    if (value >= least && value <= most) return;
    reader.Fail("bad_profile", key,
                std::string(key) + " = " + std::to_string(value) + ": must lie between " +
                    std::to_string(least) + " and " + std::to_string(most));
  };
  check("bounce_patches", profile.estimator.bounce_patches, 1, kMostPatches);
  if (profile.estimator.interval_samples != 0) {
    check("interval_samples", profile.estimator.interval_samples, kFewestSamples, kMostSamples);
  }
  check("reading_stride", profile.reading_stride, 1, 1 << 20);
  check("frame_stride", profile.pictures.frame_stride, 1, 1 << 10);
  check("pixel_stride", profile.pictures.pixel_stride, 1, 1 << 10);
}

}  // namespace
}  // namespace records

records::Node DocumentOf(const AccuracyProfile& profile) {
  records::FieldWriter writer;
  writer.Put("schema", kProfileSchema);
  records::VisitProfile(writer, profile);
  return writer.TakeTable();
}

Result<std::string> AccuracyProfileToJson(const AccuracyProfile& profile) {
  return records::FiniteJson(DocumentOf(profile));
}

Result<AccuracyProfile> AccuracyProfileFromJson(std::string_view text, std::string_view where) {
  const auto node = records::ParseJson(text);
  if (!node) return Refused("bad_profile", std::string(where), node.error().message);
  if (node->kind != records::Node::Kind::kTable) {
    return Refused("bad_profile", std::string(where), "a profile.json must be one JSON object");
  }
  records::ReadingOfFile reading{std::string(where), "bad_profile", records::PlaceStyle::kJson,
                                 std::nullopt};
  records::FieldReader reader(*node, "", reading);
  AccuracyProfile profile;
  std::string schema;
  reader.Text("schema", schema);
  if (schema != kProfileSchema) {
    reader.Fail("schema", "a profile.json has \"schema\": \"" + std::string(kProfileSchema) +
                              "\"; `{MakeStudy}` writes one");
  }
  records::VisitProfile(reader, profile);
  reader.Ignore("measured");
  if (!reader.Failed()) records::CheckCounts(reader, profile);
  reader.Finish();
  if (reading.error) return tl::unexpected(*std::move(reading.error));
  return profile;
}

}  // namespace lightcal
