// SPDX-License-Identifier: Apache-2.0
// What spotread prints, by the printf formats of ArgyllCMS 2.3.1; the figures are ours.
#pragma once

#include <string>

namespace lightcal::test {

inline const std::string kSpotreadPrompt =
    "\nPlace instrument on spot to be measured,\n"
    "and hit [A-Z] to read white and setup FWA compensation (keyed to letter)\n"
    "[a-z] to read and make FWA compensated reading from keyed reference\n"
    "'r' to set reference, 's' to save spectrum,\n"
    "'f' to report cal. refresh rate, 'F' to measure refresh rate\n"
    "'h' to toggle high res., 'k' to do a calibration\n"
    "Hit ESC or Q to exit, instrument switch or any other key to take a reading: ";

// An i1 Display Pro: three filters.
inline const std::string kSpotreadColorimeter =
    "Connecting to the instrument ..\n"
    "Product Name:      i1Display3\n"
    "Serial Number:     I1-15.A-01.111111.11\n" +
    kSpotreadPrompt +
    "\n Result is XYZ: 210.523114 192.512345 65.100009, Yxy: 192.512345 0.449706 0.411232\n"
    " Ambient = 192.5 Lux, CCT = 2857K (Duv 0.0012)\n"
    " Suggested EV @ ISO100 for 192.5 Lux incident light = 6.3\n"
    " Closest Planckian temperature = 2850K (DE2K 1.2)\n"
    " Closest Daylight temperature  = 2901K (DE2K 8.0)\n";

// A Spyder: one channel.
inline const std::string kSpotreadOneChannel =
    kSpotreadPrompt +
    "\n Result is Y: 17.250000, L*: 48.5\n"
    " Ambient = 17.3 Lux\n"
    " Suggested EV @ ISO100 for 17.3 Lux incident light = 2.8\n";

// An i1 Pro in equal-energy light of 10 mW m^-2 nm^-1: E = 683.002 lm/W sum ybar 0.01 10 nm.
inline const std::string kSpotreadSpectral = [] {
  std::string values = "10";
  for (int i = 1; i < 36; ++i) values += ", 10";
  return "Instrument Type:   i1 Pro 2\nSerial Number:     1234567\n" + kSpotreadPrompt +
         "Spectrum from 380.000 to 730.000 nm in 36 steps\n" + values +
         "\n\n Result is XYZ: 729.682000 729.831000 730.003000, Yxy: 729.831000 0.333241 0.333309\n"
         " Ambient = 729.8 Lux, CCT = 5455K (Duv -0.0044)\n"
         " Suggested EV @ ISO100 for 729.8 Lux incident light = 8.2\n"
         " Closest Planckian temperature = 5455K (DE2K 3.4)\n"
         " Closest Daylight temperature  = 5602K (DE2K 6.1)\n"
         " Color Rendering Index (Ra) = 95.2 [ R9 = 84.8 ]\n"
         "  R1  = 96.1  R2  = 97.2  R3  = 95.3  R4  = 93.4  R5  = 94.5  R6  = 94.6  R7  = 95.7\n"
         "  R8  = 94.8  R9  = 84.8  R10 = 92.0  R11 = 91.1  R12 = 90.2  R13 = 96.3  R14 = 97.4\n"
         " Television Lighting Consistency Index 2012 (Qa) = 98.7\n"
         " IES TM-30-15 Rf = 96.12 Rg = 101.34 CCT = 5455 Duv = -0.004412\n";
}();

inline const std::string kSpotreadNoAmbient =
    "Requested ambient light capability,\nand instrument doesn't support it.\n";
inline const std::string kSpotreadNoSpectrum =
    "Need spectral information for custom illuminant or observer\n"
    "and instrument doesn't support it\n";
inline const std::string kSpotreadCalibratedItself =
    "\nSpot read needs a calibration before continuing\nCalibration complete\n";
inline const std::string kSpotreadPlacedToCalibrate =
    "\nSpot read needs a calibration before continuing\n"
    "\nPlace the instrument on its reflective white reference S/N 1234567,\n"
    " and then hit any key to continue,\n or hit Esc or Q to abort: "
    "Calibration complete\n";
inline const std::string kSpotreadMisread =
    kSpotreadPrompt +
    "\n\nSpot read failed due to misread (Readings are inconsistent)\n"
    "Hit Esc or Q to give up, any other key to retry:";

}  // namespace lightcal::test
