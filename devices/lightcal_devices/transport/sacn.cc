// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/sacn.h"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <system_error>
#include <utility>

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;

constexpr std::string_view kAcnIdentifier("ASC-E1.17\0\0\0", 12);
constexpr std::uint32_t kVectorRootData = 0x00000004;
constexpr std::uint32_t kVectorDataPacket = 0x00000002;
constexpr std::uint8_t kVectorSetProperty = 0x02;
constexpr std::uint8_t kStreamTerminated = 0x40;
constexpr std::size_t kSourceNameBytes = 64;
constexpr std::size_t kHeaderBytes = 126;  // up to the start code, it included
// A universe at its fastest is sent 44 times a second (DMX512-A).
constexpr milliseconds kShortInterval(25);
constexpr milliseconds kKeepAlive(800);  // 6.6.2: 800 ... 1000 ms
constexpr int kFirstPackets = 25;
constexpr int kPacketsOfAChange = 3;
constexpr int kTerminationPackets = 3;

class Writer {
 public:
  void Put8(std::uint32_t value) { bytes_.push_back(static_cast<std::byte>(value & 0xff)); }
  void Put16(std::uint32_t value) {
    Put8(value >> 8);
    Put8(value);
  }
  void Put32(std::uint32_t value) {
    Put16(value >> 16);
    Put16(value);
  }
  void Text(std::string_view text, std::size_t size) {
    for (std::size_t i = 0; i < size; ++i) {
      Put8(i < text.size() ? static_cast<unsigned char>(text[i]) : 0U);
    }
  }
  // Flags 0x7 and the length from here to the packet's end.
  void FlagsAndLength(std::size_t whole) {
    Put16(0x7000U | static_cast<std::uint32_t>(whole - bytes_.size()));
  }
  Bytes Take() { return std::move(bytes_); }

 private:
  Bytes bytes_;
};

// Whole characters of UTF-8, with room for the final zero.
std::string_view Cut(std::string_view name) {
  if (name.size() < kSourceNameBytes) return name;
  std::size_t end = kSourceNameBytes - 1;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0) == 0x80) --end;
  return name.substr(0, end);
}

struct Found {
  FileDescriptor socket;
  std::string address;
};

Result<Found> Connect(const SacnTarget& target) {
  const std::string host =
      target.host.empty() ? SacnMulticastAddress(target.universe) : target.host;
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* list = nullptr;
  const int code = ::getaddrinfo(host.c_str(), std::to_string(target.port).c_str(), &hints, &list);
  if (code != 0 || list == nullptr) {
    return Failed("no_host", host, std::string("has no address: ") + ::gai_strerror(code));
  }
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> owner(list, ::freeaddrinfo);
  int error = 0;
  for (const addrinfo* one = list; one != nullptr; one = one->ai_next) {
    FileDescriptor socket(::socket(one->ai_family, one->ai_socktype | SOCK_CLOEXEC, 0));
    // Connected, the kernel tells when the host answers that nobody listens there.
    if (socket.get() >= 0 && ::connect(socket.get(), one->ai_addr, one->ai_addrlen) == 0) {
      std::array<char, NI_MAXHOST> text{};
      ::getnameinfo(one->ai_addr, one->ai_addrlen, text.data(), text.size(), nullptr, 0,
                    NI_NUMERICHOST);
      return Found{std::move(socket), std::string(text.data()) + ":" + std::to_string(target.port)};
    }
    error = errno;
  }
  return Failed(std::string(fault::kIo), host,
                "cannot be sent to: " + std::generic_category().message(error));
}

}  // namespace

Bytes EncodeSacn(const SacnPacket& packet) {
  const std::size_t slots = std::min<std::size_t>(packet.slots.size(), 512);
  const std::size_t whole = kHeaderBytes + slots;
  Writer out;
  out.Put16(0x0010);  // preamble
  out.Put16(0x0000);  // no postamble
  out.Text(kAcnIdentifier, kAcnIdentifier.size());
  out.FlagsAndLength(whole);
  out.Put32(kVectorRootData);
  for (const std::uint8_t byte : packet.cid) out.Put8(byte);
  out.FlagsAndLength(whole);
  out.Put32(kVectorDataPacket);
  out.Text(Cut(packet.source_name), kSourceNameBytes);
  out.Put8(static_cast<std::uint32_t>(packet.priority));
  out.Put16(0);  // not synchronized with others
  out.Put8(packet.sequence);
  out.Put8(packet.terminated ? kStreamTerminated : 0U);
  out.Put16(static_cast<std::uint32_t>(packet.universe));
  out.FlagsAndLength(whole);
  out.Put8(kVectorSetProperty);
  out.Put8(0xa1);     // address and data type
  out.Put16(0x0000);  // first property
  out.Put16(0x0001);  // increment
  out.Put16(static_cast<std::uint32_t>(slots + 1));
  out.Put8(0);  // start code
  for (std::size_t i = 0; i < slots; ++i) out.Put8(packet.slots[i]);
  return out.Take();
}

std::string SacnMulticastAddress(int universe) {
  return "239.255." + std::to_string(universe / 256) + "." + std::to_string(universe % 256);
}

SacnCid SacnCidOf(std::string_view name) {
  SacnCid cid{};
  std::uint64_t hash = 1469598103934665603ULL;  // FNV-1a
  for (std::size_t half = 0; half < 2; ++half) {
    for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
    for (std::size_t i = 0; i < 8; ++i) {
      cid[8 * half + i] = static_cast<std::uint8_t>(hash >> (8 * i));
    }
    hash ^= 0x9e3779b97f4a7c15ULL;
  }
  cid[6] = static_cast<std::uint8_t>((cid[6] & 0x0f) | 0x80);
  cid[8] = static_cast<std::uint8_t>((cid[8] & 0x3f) | 0x80);
  return cid;
}

Result<std::unique_ptr<SacnSender>> SacnSender::Open(const SacnTarget& target, SacnPacket source,
                                                     std::vector<std::uint8_t> slots) {
  auto found = Connect(target);
  if (!found) return Propagate(std::move(found));
  source.universe = target.universe;
  return std::unique_ptr<SacnSender>(new SacnSender(
      std::move(found->socket), std::move(found->address), std::move(source), std::move(slots)));
}

SacnSender::SacnSender(FileDescriptor socket, std::string address, SacnPacket source,
                       std::vector<std::uint8_t> slots)
    : socket_(std::move(socket)),
      address_(std::move(address)),
      source_(std::move(source)),
      slots_(std::move(slots)),
      burst_(kFirstPackets) {
  // Signals are the main thread's: what waits there for a person or a meter must see them.
  sigset_t all;
  sigset_t former;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &former);
  thread_ = std::thread([this] { Work(); });
  ::pthread_sigmask(SIG_SETMASK, &former, nullptr);
}

SacnSender::~SacnSender() {
  {
    const std::lock_guard lock(guard_);
    stop_ = true;
  }
  wake_.notify_all();
  thread_.join();
}

void SacnSender::Set(std::vector<std::uint8_t> slots) {
  {
    const std::lock_guard lock(guard_);
    slots_ = std::move(slots);
    burst_ = std::max(burst_, kPacketsOfAChange);
  }
  wake_.notify_all();
}

Result<void> SacnSender::Trouble() const {
  const std::lock_guard lock(guard_);
  if (trouble_) return tl::unexpected(*trouble_);
  return {};
}

void SacnSender::Work() {
  std::unique_lock lock(guard_);
  while (!stop_) {
    Send(false);
    if (burst_ > 0) --burst_;
    const bool fast = burst_ > 0;
    wake_.wait_for(lock, fast ? kShortInterval : kKeepAlive,
                   [&] { return stop_ || (!fast && burst_ > 0); });
  }
  for (int i = 0; i < kTerminationPackets; ++i) {
    Send(true);
    std::this_thread::sleep_for(kShortInterval);
  }
}

void SacnSender::Send(bool terminated) {
  source_.terminated = terminated;
  source_.slots = slots_;
  const Bytes bytes = EncodeSacn(source_);
  ++source_.sequence;
  if (::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0 || trouble_) return;
  if (errno == ECONNREFUSED) {
    trouble_ =
        Error{ErrorKind::kFailed, "unheard", address_,
              "nothing listens there: no fixture was set; see that it is on and set to sACN"};
  } else {
    trouble_ = Error{ErrorKind::kFailed, std::string(fault::kIo), address_,
                     "cannot be sent to: " + std::generic_category().message(errno)};
  }
}

}  // namespace lightcal::devices
