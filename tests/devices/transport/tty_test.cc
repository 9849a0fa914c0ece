// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/tty.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <termios.h>
#include <unistd.h>

#include <fstream>

#include "lightcal_devices/transport/framing.h"
#include "pseudo_terminal.h"
#include "text_of_bytes.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;
using test::PseudoTerminal;
using test::Text;
using testing::HasSubstr;

TEST(Tty, WhatOneEndWritesTheOtherReads) {
  const PseudoTerminal terminal;
  const auto port = OpenTty(terminal.path(), k9600_8N1);
  ASSERT_TRUE(port) << port.error().message;
  ASSERT_TRUE((*port)->Write(AsBytes("?\n\r\x11\x13"), milliseconds(1000)));
  EXPECT_EQ(terminal.Receive(5), "?\n\r\x11\x13");
  terminal.Send("12\r\n\x03\xc4");
  EXPECT_EQ(Text(*(*port)->Read(64, milliseconds(1000))), "12\r\n\x03\xc4");
}

TEST(Tty, AReadReturnsAtMostWhatWasAskedAndKeepsTheRest) {
  const PseudoTerminal terminal;
  const auto port = OpenTty(terminal.path(), k9600_8N1);
  terminal.Send("abcdef");
  EXPECT_EQ(Text(*(*port)->Read(4, milliseconds(1000))), "abcd");
  EXPECT_EQ(Text(*(*port)->Read(4, milliseconds(1000))), "ef");
}

// A pseudo-terminal passes the parity bit on; a port set to 7E1 would not.
TEST(Tty, SevenBitCharactersHaveSevenBits) {
  const PseudoTerminal terminal;
  for (const SerialSettings& settings : {k9600_7E1, k9600_7E2}) {
    const auto port = OpenTty(terminal.path(), settings);
    ASSERT_TRUE(port) << port.error().message;
    terminal.Send("\xb1\x32\x8d\x0a");
    EXPECT_EQ(Text(*(*port)->Read(64, milliseconds(1000))), "12\r\n");
  }
}

TEST(Tty, SilenceIsATimeout) {
  const PseudoTerminal terminal;
  const auto port = OpenTty(terminal.path(), k9600_8N1);
  const auto nothing = (*port)->Read(1, milliseconds(20));
  ASSERT_FALSE(nothing);
  EXPECT_EQ(nothing.error().code, fault::kTimeout);
  EXPECT_THAT(nothing.error().message, HasSubstr("within 20 ms"));
}

TEST(Tty, APulledPlugIsUnplugged) {
  PseudoTerminal terminal;
  const auto port = OpenTty(terminal.path(), k9600_8N1);
  terminal.Unplug();
  EXPECT_EQ((*port)->Read(1, milliseconds(1000)).error().code, fault::kUnplugged);
  EXPECT_EQ((*port)->Write(AsBytes("?"), milliseconds(1000)).error().code, fault::kUnplugged);
}

TEST(Tty, APortInUseIsBusyAndFreeAgainAfterwards) {
  const PseudoTerminal terminal;
  {
    const auto port = OpenTty(terminal.path(), k9600_8N1);
    ASSERT_TRUE(port);
    EXPECT_EQ(OpenTty(terminal.path(), k9600_8N1).error().code, fault::kBusy);
  }
  EXPECT_TRUE(OpenTty(terminal.path(), k9600_8N1));
}

TEST(Tty, APortLockedByAnotherProgramIsBusy) {
  const PseudoTerminal terminal;
  const int other = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  ASSERT_EQ(::flock(other, LOCK_EX), 0);
  EXPECT_EQ(OpenTty(terminal.path(), k9600_8N1).error().code, fault::kBusy);
  ::close(other);
}

TEST(Tty, ThePortGetsItsFormerSettingsBack) {
  const PseudoTerminal terminal;
  const int port = ::open(terminal.path().c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios before{};
  ASSERT_EQ(::tcgetattr(port, &before), 0);
  ::cfsetspeed(&before, B1200);
  before.c_lflag |= ECHO;
  ASSERT_EQ(::tcsetattr(port, TCSANOW, &before), 0);
  termios during{};
  {
    const auto line = OpenTty(terminal.path(), k19200_8N1);
    ASSERT_TRUE(line) << line.error().message;
    ::tcgetattr(port, &during);
  }
  termios after{};
  ::tcgetattr(port, &after);
  EXPECT_EQ(::cfgetospeed(&during), speed_t{B19200});
  EXPECT_EQ(during.c_lflag & ECHO, 0U);
  EXPECT_EQ(::cfgetospeed(&after), speed_t{B1200});
  EXPECT_NE(after.c_lflag & ECHO, 0U);
  ::close(port);
}

TEST(Tty, WhatIsNoSerialPortIsSaid) {
  EXPECT_EQ(OpenTty("/dev/ttyUSB999", k9600_8N1).error().code, fault::kNoDevice);
  EXPECT_EQ(OpenTty("/dev/null", k9600_8N1).error().code, fault::kIo);
  const PseudoTerminal terminal;
  SerialSettings odd = k9600_8N1;
  odd.baud = 12345;
  EXPECT_THAT(OpenTty(terminal.path(), odd).error().message, HasSubstr("12345 baud"));
}

}  // namespace
}  // namespace lightcal::devices
