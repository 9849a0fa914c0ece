// SPDX-License-Identifier: Apache-2.0
// OpenCV's AlignMTB on the frames of a bracket: how far each lies from the first, one line each.
//
//   lightcal_bench_mtb REFERENCE FRAME...
#include <cstdio>
#include <cstdlib>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/photo.hpp>

int main(int count, char** words) {
  if (count < 3) return EXIT_FAILURE;
  // 2^6 pixels of shift each way; the default looks no further than 64 either.
  const cv::Ptr<cv::AlignMTB> aligner = cv::createAlignMTB(7);
  const cv::Mat reference = cv::imread(words[1], cv::IMREAD_GRAYSCALE);
  if (reference.empty()) return EXIT_FAILURE;
  for (int i = 2; i < count; ++i) {
    const cv::Mat frame = cv::imread(words[i], cv::IMREAD_GRAYSCALE);
    if (frame.empty()) return EXIT_FAILURE;
    const cv::Point shift = aligner->calculateShift(reference, frame);
    // The frame is moved by this to lie on the reference.
    std::printf("%d %d\n", -shift.x, -shift.y);
  }
  return EXIT_SUCCESS;
}
