// SPDX-License-Identifier: Apache-2.0
// What `color` was asked, and the colours that answer it.
#pragma once

#include <string>
#include <vector>

#include "color_answer.h"
#include "color_extras.h"
#include "console.h"
#include "lightcal/core/result.h"
#include "match/behind_gels.h"

namespace lightcal::app {

struct ColorOptions {
  std::vector<std::string> typed;  // without an option's name
  std::vector<std::string> xy, xyz;
  std::string cct, duv, locus = "planck";
  std::string spectrum, column, vector_graphic;
  bool force = false;
  std::string batch;
  std::string through, gels;
  ColorExtraOptions extra;
};

// Puts what was typed where it belongs: "3200K", "0.33,0.34", "X,Y,Z" or a spectrum's source.
void TakeTyped(ColorOptions& options);

// Wrong usage: not one colour asked for, or what does not go together.
[[nodiscard]] Result<void> CheckColor(const ColorOptions& options);

struct AnsweredColors {
  bool one = true;                  // one colour was asked for, not a file of several spectra
  std::vector<ColorAnswer> colors;  // that have an answer
  std::vector<BehindGels> behind;   // of each, where gels were asked for
  std::vector<Node> documents;      // of each asked for: as ToJson, or "refused" and why
};
// A typed colour or the spectra asked for; warnings go to the console.
// Refused: as CctFromXy, ReadSpectrumSource, ChosenSpectra, PutBehindGels, TlciByArgyll.
[[nodiscard]] Result<AnsweredColors> AnswerColor(const ColorOptions& options,
                                                 const ColorExtras& extras, Console& console);
// As ToJson of the one colour, or {"spectra"}.
[[nodiscard]] Node DocumentOf(const AnsweredColors& answered);

}  // namespace lightcal::app
