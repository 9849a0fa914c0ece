// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/captures/safe_process.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <random>
#include <string>

#include "lightcal_devices/captures/raw.h"
#include "run_cli.h"
#include "synthetic_dng.h"

namespace lightcal::devices {
namespace {

TEST(SafeProcess, WhatItWritesIsSeenAndWhatItChangesIsNot) {
  std::array<int, 2> ends{};
  ASSERT_EQ(pipe(ends.data()), 0);
  int changed = 0;
  const auto ended = RunInSafeProcess([&] {
    changed = 1;
    static_cast<void>(!write(ends[1], "x", 1));
  });
  ASSERT_TRUE(ended);
  EXPECT_EQ(*ended, ProcessEnd::kDone);
  EXPECT_EQ(changed, 0);
  char got = 0;
  EXPECT_EQ(read(ends[0], &got, 1), 1);
  EXPECT_EQ(got, 'x');
  close(ends[0]);
  close(ends[1]);
}

TEST(SafeProcess, ACrashStaysInside) {
  for (const int signal : {SIGSEGV, SIGABRT, SIGKILL}) {
    const auto ended = RunInSafeProcess([signal] { static_cast<void>(raise(signal)); });
    ASSERT_TRUE(ended);
    EXPECT_EQ(*ended, ProcessEnd::kBroken) << signal;
  }
}

// Bytes of the directories changed at random: LibRaw breaks off over some of these files; they are
// refused, or read as something.
TEST(SafeProcess, DamagedDirectoriesAreRefusedOrRead) {
  test::SyntheticCamera camera;
  camera.width = 16;
  camera.height = 12;
  const test::SyntheticExposure exposure;
  const std::string whole = EncodeDng(
      camera, exposure, Expose(camera, exposure, [](int, int) { return test::XyzOf(100.0); }));
  const test::TempDir folder;
  std::mt19937_64 random(20261121);
  for (int i = 0; i < 400; ++i) {
    std::string bytes = whole;
    const int changes = 1 + i % 4;
    for (int change = 0; change < changes; ++change) {
      bytes[random() % (bytes.size() - 384)] = static_cast<char>(random());
    }
    const auto frame = ReadRaw(folder.Write("a.dng", bytes));
    if (frame) continue;
    EXPECT_EQ(frame.error().kind, ErrorKind::kRefused) << frame.error().message;
  }
}

}  // namespace
}  // namespace lightcal::devices
