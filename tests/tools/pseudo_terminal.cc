// SPDX-License-Identifier: Apache-2.0
#include "pseudo_terminal.h"

#include <fcntl.h>
#include <poll.h>
#include <pty.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace lightcal::test {

PseudoTerminal::PseudoTerminal() {
  std::array<char, 64> name{};
  if (::openpty(&instrument_, &keeper_, name.data(), nullptr, nullptr) != 0) {
    throw std::runtime_error("openpty failed");
  }
  // A child that outlives the test must not hold the line up.
  ::fcntl(instrument_, F_SETFD, FD_CLOEXEC);
  ::fcntl(keeper_, F_SETFD, FD_CLOEXEC);
  termios attributes{};
  ::tcgetattr(keeper_, &attributes);
  ::cfmakeraw(&attributes);
  ::tcsetattr(keeper_, TCSANOW, &attributes);
  path_ = name.data();
}

PseudoTerminal::~PseudoTerminal() { Unplug(); }

void PseudoTerminal::Send(std::string_view bytes) const {
  if (::write(instrument_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("the pseudo-terminal took less than all bytes");
  }
}

std::string PseudoTerminal::Receive(std::size_t count, std::chrono::milliseconds wait) const {
  std::string received;
  while (received.size() < count) {
    pollfd line{instrument_, POLLIN, 0};
    if (::poll(&line, 1, static_cast<int>(wait.count())) <= 0) break;
    std::array<char, 256> piece{};
    const std::size_t left = count - received.size();
    const ssize_t got =
        ::read(instrument_, piece.data(), left < piece.size() ? left : piece.size());
    if (got <= 0) break;
    received.append(piece.data(), static_cast<std::size_t>(got));
  }
  return received;
}

void PseudoTerminal::Unplug() {
  if (instrument_ >= 0) ::close(instrument_);
  if (keeper_ >= 0) ::close(keeper_);
  instrument_ = keeper_ = -1;
}

}  // namespace lightcal::test
