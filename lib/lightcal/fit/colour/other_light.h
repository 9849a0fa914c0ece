// SPDX-License-Identifier: Apache-2.0
// How much of the light that a lamp's colour was read in is not its own.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "lightcal/records/fitted_light.h"
#include "lightcal/records/session.h"

namespace lightcal::fit {

// Shares of a reading's illuminance.
struct OtherShares {
  double walls = 0.0;    // the lamp's, thrown back
  double common = 0.0;   // 1 sigma of `walls` over it, as all readings of the lamp share it
  double own = 0.0;      // and as this place has it alone
  double ambient = 0.0;  // of other lamps, or day
  [[nodiscard]] bool any() const { return walls > 0.0 || ambient > 0.0; }
};

// After the fit: what it found of the walls (in_room, located), else what is known of them
// beforehand (WallPriors); what was read behind a card at a reading's own place before both.
// Ambient light as it was read, else what may be where nobody read any.
class OtherLight {
 public:
  OtherLight(const Session& session, const LightDescription& description, const FittedLight& light);

  // Of a reading that measured a colour: nothing of one that says what the box says (a temperature
  // of no named instrument), of a data sheet, outdoors or in the dark.
  [[nodiscard]] OtherShares SharesIn(const SessionReading& row) const;
  // What was read behind the card where this was read, null if nothing.
  [[nodiscard]] const Reading* CardBeside(const Reading& reading) const;

 private:
  struct Walls {
    double walls_lx = 0.0, direct_lx = 0.0;
    double sd_ln = 0.0, scatter = 0.0;
  };
  void Note(const SessionReading& row);
  void NoteUnknownPlace();
  [[nodiscard]] std::optional<double> DistanceOf(const Reading& reading) const;
  [[nodiscard]] std::optional<Walls> WallsAt(double distance_m) const;
  [[nodiscard]] double AmbientIn(const Reading& reading) const;
  [[nodiscard]] OtherShares Unlit(const Reading& reading) const;
  const Session& session_;
  const LightDescription& description_;
  const FittedLight& light_;
  double ambient_lx_ = 0.0;
  std::vector<const SessionReading*> cards_, offs_;
  std::map<double, Walls> walls_;  // at the distances, in metres, that its colours were read at
  OtherShares of_unknown_place_;
};

}  // namespace lightcal::fit
