// SPDX-License-Identifier: Apache-2.0
// Colour temperature by LittleCMS. Table as own_cct.cc.
#include <lcms2.h>

#include "rows.h"

int main(int count, char** words) {
  if (count != 2) return EXIT_FAILURE;
  const auto table = page::ReadTable(words[1]);
  const page::Rows rows(table, page::ErrorScale::kRelative);
  rows.PrintEach("LittleCMS", "cmsTempFromWhitePoint", [&](std::size_t i) {
    const cmsCIExyY white{table[i][0], table[i][1], 1.0};
    double kelvins = 0.0;
    return cmsTempFromWhitePoint(&kelvins, &white) != 0 ? kelvins : 0.0;
  });
  return EXIT_SUCCESS;
}
