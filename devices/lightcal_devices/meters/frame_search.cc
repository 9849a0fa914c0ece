// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/meters/frame_search.h"

namespace lightcal::devices {
namespace {

tl::unexpected<Error> NoFrame(const Transport& transport, const FrameSearch& search,
                              std::size_t received) {
  if (received == 0) {
    return Failed(std::string(fault::kTimeout), transport.Name(),
                  "sent nothing in " + std::to_string(search.waits) + " waits of " +
                      std::to_string(search.wait.count()) + " ms; " + std::string(search.hint));
  }
  return Failed(std::string(kBadReply), transport.Name(),
                std::to_string(received) +
                    " bytes came, but none of this meter's frames; is this the meter's port, and "
                    "is its cable firm?");
}

// Forgets bytes from the front until the rest may be a frame's beginning.
void DropNoise(Bytes& window, const FrameSearch& search) {
  std::span<const std::byte> rest(window);
  while (!rest.empty() && !search.may_begin(rest)) rest = rest.subspan(1);
  window.erase(window.begin(), window.end() - static_cast<std::ptrdiff_t>(rest.size()));
}

}  // namespace

Result<Bytes> FindFrame(Transport& transport, const FrameSearch& search,
                        const Cancellation& cancellation) {
  Bytes window;
  std::size_t received = 0;
  int silences = 0;
  while (received < search.most_bytes && silences < search.waits) {
    if (cancellation.Requested()) return Interrupted(transport.Name());
    const auto piece = transport.Read(search.frame_bytes - window.size(), search.wait);
    if (!piece && piece.error().code != fault::kTimeout) return tl::unexpected(piece.error());
    if (!piece) {
      ++silences;
      window.clear();  // a frame that broke off
      continue;
    }
    received += piece->size();
    window.insert(window.end(), piece->begin(), piece->end());
    DropNoise(window, search);
    if (window.size() == search.frame_bytes) return window;
  }
  if (cancellation.Requested()) return Interrupted(transport.Name());
  return NoFrame(transport, search, received);
}

void ForgetQueued(Transport& transport) {
  StreamReader(transport).Drain(std::chrono::milliseconds(0));
}

tl::unexpected<Error> Interrupted(const std::string& device) {
  return Failed("interrupted", device, "stopped by you; the meter is released");
}

bool IsGone(const Error& error) {
  return error.code == fault::kUnplugged || error.code == fault::kNoDevice;
}

}  // namespace lightcal::devices
