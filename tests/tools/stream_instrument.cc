// SPDX-License-Identifier: Apache-2.0
#include "stream_instrument.h"

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

#include <stdexcept>

namespace lightcal::test {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kMoment{5};

unsigned SpeedOf(int port) {
  termios attributes{};
  if (::tcgetattr(port, &attributes) != 0) return 0;
  return ::cfgetospeed(&attributes);
}

}  // namespace

Speak Saying(std::vector<std::string> frames) {
  return [frames = std::move(frames), next = std::size_t{0}](std::string& unread) mutable {
    unread.clear();
    if (frames.empty()) return Spoken{};
    const std::string frame = frames[next];
    if (next + 1 < frames.size()) ++next;
    return Spoken{frame, false};
  };
}

Result<void> StreamFake::Write(std::span<const std::byte> bytes, milliseconds) {
  if (gone_) return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  std::string text;
  for (const std::byte byte : bytes) text.push_back(static_cast<char>(byte));
  unread_ += text;
  writes_.push_back(std::move(text));
  return {};
}

Result<devices::Bytes> StreamFake::Read(std::size_t max, milliseconds timeout) {
  ++reads_;
  if (pending_.empty() && gone_)
    return Failed(std::string(devices::fault::kUnplugged), Name(), "gone");
  if (pending_.empty() && timeout.count() > 0) {
    const Spoken spoken = speak_(unread_);
    pending_ = spoken.bytes;
    gone_ = spoken.pulls_the_plug;
  }
  if (pending_.empty()) {
    return Failed(std::string(gone_ ? devices::fault::kUnplugged : devices::fault::kTimeout),
                  Name(), "silent");
  }
  const std::string given = pending_.substr(0, max);
  pending_.erase(0, given.size());
  const auto bytes = devices::AsBytes(given);
  return devices::Bytes(bytes.begin(), bytes.end());
}

std::string StreamFake::received() const {
  std::string all;
  for (const std::string& write : writes_) all += write;
  return all;
}

StreamStandIn::StreamStandIn(Speak speak)
    : speak_(std::move(speak)),
      path_(terminal_.path()),
      watch_(::open(path_.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC)) {
  if (watch_ < 0) throw std::runtime_error("cannot watch " + path_);
  idle_speed_ = SpeedOf(watch_);
  thread_ = std::thread([this] { Serve(); });
}

StreamStandIn::~StreamStandIn() {
  stop_ = true;
  thread_.join();
  ::close(watch_);
}

bool StreamStandIn::IsSetUp() const { return SpeedOf(watch_) != idle_speed_; }

void StreamStandIn::Serve() {
  std::string unread;
  while (!stop_) {
    const std::string bytes = terminal_.Receive(4096, kMoment);
    unread += bytes;
    {
      const std::lock_guard lock(guard_);
      received_ += bytes;
    }
    if (!IsSetUp()) continue;
    const Spoken spoken = speak_(unread);
    if (!spoken.bytes.empty()) terminal_.Send(spoken.bytes);
    if (spoken.pulls_the_plug) {
      terminal_.Unplug();
      return;
    }
  }
}

std::string StreamStandIn::received() const {
  const std::lock_guard lock(guard_);
  return received_;
}

bool StreamStandIn::WaitFor(const std::string& bytes) const {
  for (int i = 0; i < 1000; ++i) {
    if (received().find(bytes) != std::string::npos) return true;
    std::this_thread::sleep_for(kMoment);
  }
  return false;
}

}  // namespace lightcal::test
