// SPDX-License-Identifier: Apache-2.0
// OpenCV's merge of the 8 bit frames that lightcal_bench_bracket wrote; its result as raw floats.
//
//   lightcal_bench_opencv_merge robertson|debevec DIRECTORY OUT.raw
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <opencv2/photo.hpp>
#include <string>
#include <vector>

namespace {

cv::Mat ReadPgm(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, top = 0;
  file >> magic >> width >> height >> top;
  file.get();
  cv::Mat picture(height, width, CV_8UC1);
  file.read(reinterpret_cast<char*>(picture.data), static_cast<std::streamsize>(picture.total()));
  // OpenCV merges three channels only.
  cv::Mat colour;
  cv::merge(std::vector<cv::Mat>(3, picture), colour);
  return colour;
}

}  // namespace

int main(int count, char** words) {
  if (count != 4) return EXIT_FAILURE;
  const std::string method = words[1], directory = words[2];
  std::vector<cv::Mat> frames;
  std::vector<float> times;
  std::ifstream list(directory + "/times.txt");
  for (float time = 0.0F; list >> time;) {
    frames.push_back(ReadPgm(directory + "/f" + std::to_string(times.size()) + ".pgm"));
    times.push_back(time);
  }
  cv::Mat linear(256, 1, CV_32FC3);
  for (int code = 0; code < 256; ++code) {
    linear.at<cv::Vec3f>(code) = cv::Vec3f::all(static_cast<float>(code == 0 ? 1 : code) / 255.0F);
  }
  cv::Mat merged;
  if (method == "robertson") {
    cv::createMergeRobertson()->process(frames, merged, times, linear);
  } else {
    cv::createMergeDebevec()->process(frames, merged, times, linear);
  }
  cv::extractChannel(merged, merged, 0);
  std::ofstream(words[3], std::ios::binary)
      .write(reinterpret_cast<const char*>(merged.data),
             static_cast<std::streamsize>(merged.total() * merged.elemSize()));
  return EXIT_SUCCESS;
}
