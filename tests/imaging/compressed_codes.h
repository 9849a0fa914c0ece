// SPDX-License-Identifier: Apache-2.0
// What compression makes of the codes of a picture.
#pragma once

#include <vector>

namespace lightcal::test {

// Every 8 x 8 block of one of three channels through a cosine transform whose waves are rounded to
// `step` codes, as compression does.
void Compress(std::vector<double>& codes, int width, int channel, double step);

}  // namespace lightcal::test
