// SPDX-License-Identifier: Apache-2.0
// sACN packets against the octets that ANSI E1.31-2018 prints, and the sender on 127.0.0.1. Where
// universes multicast to is tested as text: nothing here leaves this computer.
#include "lightcal_devices/transport/sacn.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

namespace lightcal::devices {
namespace {

using Octets = std::vector<int>;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

Octets Of(const Bytes& bytes, std::size_t from, std::size_t count) {
  Octets out;
  for (std::size_t i = from; i < from + count; ++i) out.push_back(static_cast<int>(bytes.at(i)));
  return out;
}

SacnPacket Sample(const std::vector<std::uint8_t>& slots) {
  SacnPacket packet;
  for (std::size_t i = 0; i < packet.cid.size(); ++i) {
    packet.cid[i] = static_cast<std::uint8_t>(0xa0 + i);
  }
  packet.source_name = "desk";
  packet.priority = 120;
  packet.sequence = 0xfe;
  packet.universe = 0x1234;
  packet.slots = slots;
  return packet;
}

TEST(Sacn, EveryOctetIsWhereTheStandardPutsIt) {
  std::vector<std::uint8_t> slots(512);
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = static_cast<std::uint8_t>(i * 7);
  const Bytes bytes = EncodeSacn(Sample(slots));
  ASSERT_EQ(bytes.size(), 638U);
  // Table 5-1, root layer; flags and length from its octet 16: 638 - 16 = 0x26e.
  EXPECT_EQ(Of(bytes, 0, 16), (Octets{0x00, 0x10, 0x00, 0x00, 'A', 'S', 'C', '-', 'E', '1', '.',
                                      '1', '7', 0x00, 0x00, 0x00}));
  EXPECT_EQ(Of(bytes, 16, 6), (Octets{0x72, 0x6e, 0x00, 0x00, 0x00, 0x04}));
  EXPECT_EQ(Of(bytes, 22, 3), (Octets{0xa0, 0xa1, 0xa2}));
  EXPECT_EQ(Of(bytes, 37, 1), (Octets{0xaf}));
  // Table 6-1, framing layer: 638 - 38 = 0x258.
  EXPECT_EQ(Of(bytes, 38, 6), (Octets{0x72, 0x58, 0x00, 0x00, 0x00, 0x02}));
  EXPECT_EQ(Of(bytes, 44, 5), (Octets{'d', 'e', 's', 'k', 0}));
  EXPECT_EQ(Of(bytes, 108, 7), (Octets{120, 0x00, 0x00, 0xfe, 0x00, 0x12, 0x34}));
  // Table 7-1, DMP layer: 638 - 115 = 0x20b.
  EXPECT_EQ(Of(bytes, 115, 11),
            (Octets{0x72, 0x0b, 0x02, 0xa1, 0x00, 0x00, 0x00, 0x01, 0x02, 0x01, 0x00}));
  for (std::size_t i = 0; i < slots.size(); ++i) {
    ASSERT_EQ(static_cast<int>(bytes[126 + i]), slots[i]) << "slot " << i + 1;
  }
}

TEST(Sacn, AShortUniverseHasShortLengths) {
  const std::vector<std::uint8_t> slots = {9, 8};
  const Bytes bytes = EncodeSacn(Sample(slots));
  ASSERT_EQ(bytes.size(), 128U);
  EXPECT_EQ(Of(bytes, 16, 2), (Octets{0x70, 112}));
  EXPECT_EQ(Of(bytes, 38, 2), (Octets{0x70, 90}));
  EXPECT_EQ(Of(bytes, 115, 2), (Octets{0x70, 13}));
  EXPECT_EQ(Of(bytes, 123, 5), (Octets{0, 3, 0, 9, 8}));
}

TEST(Sacn, AnEndSaysSoInBitSixOfItsOptions) {
  SacnPacket packet = Sample({});
  packet.terminated = true;
  EXPECT_EQ(Of(EncodeSacn(packet), 112, 1), (Octets{0x40}));
}

TEST(Sacn, ALongNameIsCutBetweenCharactersAndEndsWithZero) {
  SacnPacket packet = Sample({});
  packet.source_name = std::string(62, 'x') + "é!";  // the é would be octets 62 and 63
  const Bytes bytes = EncodeSacn(packet);
  EXPECT_EQ(Of(bytes, 44 + 61, 3), (Octets{'x', 0, 0}));
}

TEST(Sacn, AUniverseMulticastsToItsOwnAddress) {
  EXPECT_EQ(SacnMulticastAddress(1), "239.255.0.1");
  EXPECT_EQ(SacnMulticastAddress(256), "239.255.1.0");
  EXPECT_EQ(SacnMulticastAddress(4660), "239.255.18.52");
  EXPECT_EQ(SacnMulticastAddress(63999), "239.255.249.255");
}

TEST(Sacn, ASourceKeepsItsIdentity) {
  const SacnCid cid = SacnCidOf("/lamp#1");
  EXPECT_EQ(cid, SacnCidOf("/lamp#1"));
  EXPECT_NE(cid, SacnCidOf("/lamp#2"));
  EXPECT_EQ(cid[6] >> 4, 8) << "a UUID of version 8";
  EXPECT_EQ(cid[8] >> 6, 2) << "of the variant of RFC 9562";
}

// A receiver on 127.0.0.1.
class Receiver {
 public:
  Receiver() : socket_(::socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = ::htonl(INADDR_LOOPBACK);
    ::bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    socklen_t size = sizeof address;
    ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ::ntohs(address.sin_port);
  }
  [[nodiscard]] SacnTarget target() const { return {7, "127.0.0.1", port_}; }

  struct Packet {
    Bytes bytes;
    steady_clock::time_point at;
  };
  // The next `most`, fewer where `wait` passes without any.
  std::vector<Packet> Take(std::size_t most, milliseconds wait) {
    std::vector<Packet> packets;
    pollfd one{socket_.get(), POLLIN, 0};
    while (packets.size() < most && ::poll(&one, 1, static_cast<int>(wait.count())) > 0) {
      Bytes bytes(2048);
      const auto size = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
      bytes.resize(static_cast<std::size_t>(size));
      packets.push_back({std::move(bytes), steady_clock::now()});
    }
    return packets;
  }

 private:
  FileDescriptor socket_;
  int port_ = 0;
};

int Sequence(const Bytes& bytes) { return static_cast<int>(bytes.at(111)); }
bool Ends(const Bytes& bytes) { return static_cast<int>(bytes.at(112)) == 0x40; }
int FirstSlot(const Bytes& bytes) { return static_cast<int>(bytes.at(126)); }

TEST(SacnSender, BeginsChangesKeepsAliveAndEnds) {
  Receiver receiver;
  auto sender = SacnSender::Open(receiver.target(), Sample({}), std::vector<std::uint8_t>(512, 1));
  ASSERT_TRUE(sender.has_value());
  // 25 of a beginning, then one that nothing but time asks for.
  const auto begun = receiver.Take(25, milliseconds(700));
  EXPECT_EQ(begun.size(), 25U);
  (*sender)->Set(std::vector<std::uint8_t>(512, 2));
  const auto changed = receiver.Take(3, milliseconds(700));
  EXPECT_EQ(changed.size(), 3U);
  for (const auto& packet : changed) EXPECT_EQ(FirstSlot(packet.bytes), 2);
  const auto alive = receiver.Take(2, milliseconds(1000));
  EXPECT_EQ(alive.size(), 2U) << "nothing for a second";
  EXPECT_TRUE((*sender)->Trouble().has_value());
  EXPECT_EQ((*sender)->address(), "127.0.0.1:" + std::to_string(receiver.target().port));
  sender->reset();
  const auto ended = receiver.Take(4, milliseconds(100));
  ASSERT_EQ(ended.size(), 3U);
  for (const auto& packet : ended) EXPECT_TRUE(Ends(packet.bytes));
  // Sequence numbers count on, through all of them.
  std::vector<int> numbers;
  for (const auto* part : {&begun, &changed, &alive, &ended}) {
    for (const auto& packet : *part) numbers.push_back(Sequence(packet.bytes));
  }
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    EXPECT_EQ(numbers[i], (numbers[i - 1] + 1) % 256);
  }
}

TEST(SacnSender, SaysWhenNobodyListens) {
  SacnTarget target;
  {
    const Receiver gone;
    target = gone.target();
  }
  auto sender = SacnSender::Open(target, Sample({}), std::vector<std::uint8_t>(512, 1));
  ASSERT_TRUE(sender.has_value());
  const auto end = steady_clock::now() + std::chrono::seconds(5);
  while ((*sender)->Trouble() && steady_clock::now() < end) {
    std::this_thread::sleep_for(milliseconds(5));
  }
  ASSERT_FALSE((*sender)->Trouble().has_value());
  EXPECT_EQ((*sender)->Trouble().error().code, "unheard");
}

}  // namespace
}  // namespace lightcal::devices
