// SPDX-License-Identifier: Apache-2.0
// A camera in the network of this machine (fake_ptp_camera.py), for the real libgphoto2, with the
// synthetic pictures it takes.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "run_cli.h"

namespace lightcal::test {

// Pictures of a card of 18 %, 0.8 m from a lamp of 300 cd and 3000 K at f/4 and ISO 100, one for
// every shutter time the camera offers; rendered once a program.
const std::string& CardPictures();

class FakeCamera {
 public:
  // Faults as fake_ptp_camera.py knows them: "busy=2".
  explicit FakeCamera(const std::vector<std::string>& faults = {});
  ~FakeCamera();
  FakeCamera(const FakeCamera&) = delete;
  FakeCamera& operator=(const FakeCamera&) = delete;

  // "gphoto2:ptpip:127.0.0.1:PORT"
  [[nodiscard]] const std::string& id() const { return id_; }
  // What it was told and did, a line each: "set 500d 80", "exposed 80", "fetched 3", "deleted 3".
  [[nodiscard]] std::vector<std::string> log() const;
  [[nodiscard]] int Count(const std::string& beginning) const;
  // Waits (20 s at most) until so many lines begin so; whether they do.
  [[nodiscard]] bool WaitFor(const std::string& beginning, int count) const;
  // Where its properties are now: exposure time 166, f-number 800, ISO 200, mode 1 at the start.
  [[nodiscard]] std::string Property(const std::string& code) const;

 private:
  TempDir folder_;
  std::string id_;
  pid_t process_ = -1;
};

}  // namespace lightcal::test
