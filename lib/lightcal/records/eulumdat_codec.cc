// SPDX-License-Identifier: Apache-2.0
// Grammar: EULUMDAT (Stockmar 1990) as published summaries give it, one value a line.
#include <algorithm>
#include <cmath>
#include <utility>

#include "lightcal/core/numbers_text.h"
#include "lightcal/records/photometric_codec.h"
#include "lightcal/records/photometric_text.h"

namespace lightcal {
namespace {

using records::BadPhotometric;
using records::HeaderText;
using records::kLeastLumens;
using records::kMostLumens;

constexpr double kMostEulumdatAngles = 1e5;

// Stored planes are Mc1 ... Mc2 of the Mc C angles.
struct StoredPlanes {
  std::size_t first = 0, count = 0;
};
StoredPlanes PlanesOf(int symmetry, std::size_t mc) {
  switch (symmetry) {
    case 1:
      return {0, 1};
    case 2:
      return {0, mc / 2 + 1};
    case 3:
      return {3 * mc / 4, mc / 2 + 1};
    case 4:
      return {0, mc / 4 + 1};
    default:
      return {0, mc};
  }
}

class EulumdatReader {
 public:
  EulumdatReader(std::string_view text, std::string_view where, std::optional<int> lamp_set)
      : lines_(text), where_(where), lamp_set_(lamp_set) {}

  Result<ReadPhotometric> Read() {
    ReadHeader();
    ReadLamps();
    ReadIntensities();
    if (error_) return tl::unexpected(*error_);
    auto table = IntensityTable::Make(std::move(grid_), where_);
    if (!table) return Propagate(std::move(table));
    if (auto line = lines_.Next(); line && !line->empty()) {
      Warn("trailing_data", "more stands behind the last intensity; it is not used");
    }
    return ReadPhotometric{{std::move(header_), std::move(*table)}, std::move(warnings_)};
  }

 private:
  std::string_view Line(std::string_view what) {
    if (error_) return {};
    const auto line = lines_.Next();
    if (!line) Fail(std::string(what) + " is missing: the file ends too early");
    return line.value_or("");
  }
  std::string Text(std::string_view what) { return HeaderText(Line(what)); }
  double Number(std::string_view what) { return NumberOf(Line(what), what); }
  // Where files leave lines empty.
  double NumberOrZero(std::string_view what) {
    const std::string_view line = Line(what);
    return line.empty() ? 0.0 : NumberOf(line, what);
  }
  double NumberOf(std::string_view line, std::string_view what) {
    if (error_) return 0.0;
    const auto value = records::NumberEitherWay(line);
    if (!value) {
      Fail(std::string(what) + " (line " + std::to_string(lines_.number()) + ") is \"" +
           HeaderText(line.substr(0, 40)) + "\", no number");
    }
    return value.value_or(0.0);
  }
  int Whole(std::string_view what, double least, double most) {
    const double value = Number(what);
    if (!error_ && (value < least || value > most || value != std::floor(value))) {
      Fail(std::string(what) + " (line " + std::to_string(lines_.number()) + ") is " +
           ShortestText(value) + "; a whole number from " + ShortestText(least) + " to " +
           ShortestText(most) + " is needed");
    }
    return error_ ? 0 : static_cast<int>(value);
  }
  std::vector<double> List(std::size_t count, std::string_view what) {
    std::vector<double> out;
    // Each value takes two characters at least, so that a count cannot claim memory.
    if (!error_ && count > lines_.rest().size() / 2 + 1) {
      Fail(std::to_string(count) + " numbers (" + std::string(what) +
           ") are announced, the file is too short for them");
    }
    if (error_) return out;
    out.reserve(count);
    for (std::size_t i = 0; i < count && !error_; ++i) out.push_back(Number(what));
    return out;
  }
  // Of the list of angles last read, those from `first` on.
  void CheckIncrease(const std::vector<double>& angles, std::size_t first, std::size_t end,
                     std::string_view which, int line_before) {
    for (std::size_t i = first + 1; i < end && !error_; ++i) {
      if (angles[i] > angles[i - 1]) continue;
      error_ = records::AnglesMustIncrease(where_, which, angles[i - 1], angles[i],
                                           line_before + static_cast<int>(i) + 1)
                   .value();
    }
  }
  void Fail(const std::string& why) {
    if (!error_) error_ = BadPhotometric(where_, why).value();
  }
  void Warn(std::string code, std::string message) {
    warnings_.push_back({std::move(code), std::string(where_), std::move(message)});
  }

  void ReadHeader() {
    header_.format = PhotometricFormat::kEulumdat;
    header_.version = "EULUMDAT";
    header_.manufacturer = Text("the company");
    (void)NumberOrZero("the type of luminaire");
    symmetry_ = Whole("the symmetry (Isym)", 0, 4);
    mc_ = static_cast<std::size_t>(Whole("the number of C planes (Mc)", 1, kMostEulumdatAngles));
    (void)NumberOrZero("the step of C planes");
    ng_ =
        static_cast<std::size_t>(Whole("the number of gamma angles (Ng)", 2, kMostEulumdatAngles));
    (void)NumberOrZero("the step of gamma angles");
    header_.report = Text("the measurement report");
    header_.luminaire = Text("the luminaire's name");
    header_.catalogue = Text("the luminaire's number");
    (void)Text("the file name");
    TakeDate(Text("date and user"));
    ReadSizes();
    (void)NumberOrZero("the downward flux fraction");
    const double ratio = NumberOrZero("the light output ratio");
    if (ratio > 0.0) header_.output_ratio = ratio / 100.0;
    conversion_ = NumberOrZero("the conversion factor for intensities");
    if (conversion_ == 0.0) conversion_ = 1.0;
    if (conversion_ < 0.0) Fail("the conversion factor for intensities is below 0");
    if (const double tilt = NumberOrZero("the tilt in measurement"); tilt != 0.0) {
      Warn("measured_tilted",
           "was measured tilted by " + ShortestText(tilt) + " degrees (line " +
               std::to_string(lines_.number()) +
               "). Its angles are used as they stand: gamma 0 is down in that position, not the "
               "lamp's own axis; aim that way, or turn the aim by the tilt");
    }
  }

  void TakeDate(const std::string& line) {
    const std::size_t cut = line.find(records::kEulumdatLab);
    header_.date = line.substr(0, cut);
    if (cut != std::string::npos)
      header_.laboratory = line.substr(cut + records::kEulumdatLab.size());
  }

  void ReadSizes() {
    for (const auto* what : {"the luminaire's length", "its width", "its height"}) {
      (void)NumberOrZero(what);
    }
    const auto metres = [&](std::string_view what) {
      return Metres(std::max(0.0, NumberOrZero(what)) / 1000.0);
    };
    LuminousOpening& opening = header_.opening;
    opening.along_c90 = metres("the length of the luminous area");
    opening.along_c0 = metres("the width of the luminous area");
    for (const auto* what : {"its height in C0", "in C90", "in C180", "in C270"}) {
      opening.height = std::max(opening.height, metres(what));
    }
    if (opening.along_c90.value() == 0.0) return;
    opening.shape = OpeningShape::kRect;
    if (opening.along_c0.value() == 0.0) {
      opening.shape = OpeningShape::kRound;
      opening.along_c0 = opening.along_c90;
    }
  }

  void ReadLamps() {
    constexpr double kMostSets = 100;
    constexpr double kMostLamps = 1e6;
    const int count_of_sets = Whole("the number of lamp sets", 1, kMostSets);
    std::vector<LampSet> sets;
    std::vector<bool> absolute;
    for (int i = 0; i < count_of_sets && !error_; ++i) {
      LampSet set;
      const int count = Whole("the number of lamps", -kMostLamps, kMostLamps);
      absolute.push_back(count < 0);
      set.count = std::max(1, std::abs(count));
      set.type = Text("the type of lamps");
      set.flux = Lumens(Number("the lamps' luminous flux"));
      set.color = Text("the colour of the lamps");
      set.rendering = Text("the colour rendering group");
      set.power = Watts(std::max(0.0, NumberOrZero("the lamps' wattage")));
      sets.push_back(std::move(set));
    }
    TakeSet(sets, absolute);
    for (int i = 0; i < records::kEulumdatDirectRatios; ++i) (void)NumberOrZero("a direct ratio");
  }

  // One of the sets is in the luminaire.
  void TakeSet(const std::vector<LampSet>& sets, const std::vector<bool>& absolute) {
    if (error_) return;
    const auto chosen = static_cast<std::size_t>(lamp_set_.value_or(1)) - 1;
    std::string named;
    for (const LampSet& set : sets) {
      named += (named.empty() ? "" : "; ") + std::to_string(set.count) + " x " + set.type + ", " +
               ShortestText(set.flux.value()) + " lm, " + ShortestText(set.power.value()) + " W";
    }
    if (chosen >= sets.size()) {
      error_ = Refused("no_lamp_set", std::string(where_),
                       "has no set of lamps " + std::to_string(chosen + 1) + ", only " + named)
                   .value();
      return;
    }
    if (sets.size() > 1 && !lamp_set_) {
      Warn("lamp_sets",
           "describes " + std::to_string(sets.size()) +
               " sets of lamps, of which one is in it: " + named +
               ". The first is taken; {ReadDistribution} {photometric.set} 2 takes the "
               "second and can convert it alone");
    }
    const LampSet& set = sets[chosen];
    const double flux = set.flux.value();
    if (!(flux > kLeastLumens && flux < kMostLumens)) {
      Fail("the lamps' luminous flux is " + ShortestText(flux) +
           " lm, so that candela per 1000 lm mean nothing");
    }
    header_.lamps = {set};
    header_.absolute = absolute[chosen];
    header_.lamp_flux = set.flux;
    header_.power = set.power;
  }

  void ReadIntensities() {
    const StoredPlanes stored = PlanesOf(symmetry_, mc_);
    const int line_before_c = lines_.number();
    const std::vector<double> c = List(mc_, "a C angle");
    // Planes that are not stored may bear any angle; those stored may run through C0.
    if (!error_) {
      CheckIncrease(c, stored.first, std::min(mc_, stored.first + stored.count), "C",
                    line_before_c);
      if (stored.first > 0) {
        CheckIncrease(c, 0, stored.first + stored.count - mc_, "C", line_before_c);
      }
    }
    const int line_before_gamma = lines_.number();
    grid_.vertical_deg = List(ng_, "a gamma angle");
    if (!error_) CheckIncrease(grid_.vertical_deg, 0, ng_, "gamma", line_before_gamma);
    grid_.candela = List(stored.count * ng_, "an intensity");
    if (error_) return;
    const double scale = header_.lamp_flux->value() / 1000.0 * conversion_;
    for (double& v : grid_.candela) v *= scale;
    if (stored.count == 1) {
      grid_.horizontal_deg = {0.0};
      return;
    }
    for (std::size_t i = 0; i < stored.count; ++i) {
      grid_.horizontal_deg.push_back(c[(stored.first + i) % mc_]);
    }
    if (symmetry_ == 2) grid_.horizontal_deg.back() = 180.0;
    if (symmetry_ == 4) grid_.horizontal_deg.back() = 90.0;
    if (symmetry_ == 3) MirrorInto90To270();
    if (symmetry_ == 0) CloseTurn();
  }

  // Planes come from C270 over C360 to C90; their mirror images run from C270 down to C90.
  void MirrorInto90To270() {
    std::vector<double> mirrored;
    std::vector<double> candela;
    for (std::size_t i = grid_.horizontal_deg.size(); i-- > 0;) {
      const double c = grid_.horizontal_deg[i];
      mirrored.push_back(c >= 270.0 ? 540.0 - c : 180.0 - c);
      candela.insert(candela.end(), grid_.candela.begin() + static_cast<std::ptrdiff_t>(i * ng_),
                     grid_.candela.begin() + static_cast<std::ptrdiff_t>((i + 1) * ng_));
    }
    grid_.horizontal_deg = std::move(mirrored);
    grid_.candela = std::move(candela);
  }

  void CloseTurn() {
    grid_.horizontal_deg.push_back(360.0);
    const std::vector<double> first(grid_.candela.begin(),
                                    grid_.candela.begin() + static_cast<std::ptrdiff_t>(ng_));
    grid_.candela.insert(grid_.candela.end(), first.begin(), first.end());
  }

  records::Lines lines_;
  std::string_view where_;
  std::optional<int> lamp_set_;
  PhotometricHeader header_;
  IntensityGrid grid_;
  Warnings warnings_;
  std::optional<Error> error_;
  int symmetry_ = 0;
  std::size_t mc_ = 0, ng_ = 0;
  double conversion_ = 1.0;
};

}  // namespace

Result<ReadPhotometric> EulumdatFromText(std::string_view text, std::string_view where,
                                         std::optional<int> lamp_set) {
  return EulumdatReader(text, where, lamp_set).Read();
}

}  // namespace lightcal
