// SPDX-License-Identifier: Apache-2.0
// How many trials a test of frequencies makes.
#pragma once

namespace lightcal::test {

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool kUnderAddressSanitizer = true;
#else
inline constexpr bool kUnderAddressSanitizer = false;
#endif
#else
inline constexpr bool kUnderAddressSanitizer = false;  // the asan preset builds with Clang
#endif

// A sanitizer looks for faults of the code, which a few trials run through as a thousand do; how
// often an interval holds the truth is judged on the build without one, where this gives `all`.
constexpr int TrialsOf(int all) { return kUnderAddressSanitizer ? 1 + all / 20 : all; }

// The same of a map's points: so many across it make a sixteenth of them.
constexpr int AcrossOf(int all) { return kUnderAddressSanitizer ? (all + 3) / 4 : all; }

}  // namespace lightcal::test
