// SPDX-License-Identifier: Apache-2.0
// Streaming ACN: a DMX universe in UDP packets, and the sender that keeps it alive.
// Source: ANSI E1.31-2018, Lightweight streaming protocol for transport of DMX512 using ACN.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "lightcal/core/result.h"
#include "lightcal_devices/transport/file_descriptor.h"
#include "lightcal_devices/transport/transport.h"

namespace lightcal::devices {

inline constexpr int kSacnPort = 5568;  // ACN_SDT_MULTICAST_PORT, 9.1

using SacnCid = std::array<std::uint8_t, 16>;

struct SacnPacket {
  SacnCid cid{};            // who sends: an RFC 4122 UUID
  std::string source_name;  // UTF-8, at most 63 bytes; what is longer is cut
  int priority = 100;       // 0 ... 200
  std::uint8_t sequence = 0;
  int universe = 1;                     // 1 ... 63999
  bool terminated = false;              // Options bit 6, Stream_Terminated
  std::span<const std::uint8_t> slots;  // at most 512, start code 0
};

// Root, framing and DMP layer: 126 bytes and one a slot (tables 4-1, 5-1, 6-1 and 7-1).
[[nodiscard]] Bytes EncodeSacn(const SacnPacket& packet);

// 239.255.hi.lo, 9.3.1.
[[nodiscard]] std::string SacnMulticastAddress(int universe);

// A UUID of version 8 (RFC 9562) that is the same whenever `name` is: a sweep that was killed and
// goes on is the same source, so that receivers do not take it for a second one.
[[nodiscard]] SacnCid SacnCidOf(std::string_view name);

struct SacnTarget {
  int universe = 1;
  std::string host;  // a name or address to unicast to; empty multicasts
  int port = kSacnPort;
};

// Sends from a thread of its own: 25 packets at once 25 ms apart (receivers that remember a killed
// sender's sequence numbers drop at most 20), three after every change and one each 0.8 s as long
// as nothing changes (6.6.2; a receiver gives up after 2.5 s). Its end sends three packets with
// Stream_Terminated (6.2.6), whatever ends it but a kill.
class SacnSender {
 public:
  // Fails: no_host (the name has no address), io.
  [[nodiscard]] static Result<std::unique_ptr<SacnSender>> Open(const SacnTarget& target,
                                                                SacnPacket source,
                                                                std::vector<std::uint8_t> slots);
  ~SacnSender();
  SacnSender(const SacnSender&) = delete;
  SacnSender& operator=(const SacnSender&) = delete;

  void Set(std::vector<std::uint8_t> slots);
  // Of sending, so far: unheard (the host said that nobody listens there), io.
  [[nodiscard]] Result<void> Trouble() const;
  [[nodiscard]] const std::string& address() const { return address_; }  // "10.0.0.5:5568"

 private:
  SacnSender(FileDescriptor socket, std::string address, SacnPacket source,
             std::vector<std::uint8_t> slots);
  void Work();
  void Send(bool terminated);  // under guard_

  FileDescriptor socket_;
  std::string address_;
  SacnPacket source_;
  mutable std::mutex guard_;
  std::condition_variable wake_;
  std::vector<std::uint8_t> slots_;
  int burst_ = 0;  // packets still to come at the short interval
  bool stop_ = false;
  std::optional<Error> trouble_;
  std::thread thread_;
};

}  // namespace lightcal::devices
