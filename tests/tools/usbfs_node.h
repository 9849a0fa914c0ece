// SPDX-License-Identifier: Apache-2.0
// The node /dev/bus/usb/001/002 of a device on a simulated bus: umockdev answers the ioctls that
// libusb makes on it, also those of programs the test starts. Needs umockdev-wrapper.
#pragma once

#include <umockdev-1.0/umockdev.h>

#include <cerrno>
#include <cstddef>
#include <deque>
#include <memory>
#include <mutex>
#include <span>
#include <string>

struct usbdevfs_urb;

namespace lightcal::test {

struct Unref {
  void operator()(gpointer object) const { g_object_unref(object); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Unref>;

// An empty machine: no device at all. Throws std::runtime_error outside umockdev-wrapper.
[[nodiscard]] Owned<UMockdevTestbed> NewTestbed();

// The root hub that the device sits on, as a umockdev file describes it.
extern const char* const kRootHub;

// One transfer (URB) that a program has submitted.
class UsbTransfer {
 public:
  explicit UsbTransfer(UMockdevIoctlData* argument);

  [[nodiscard]] int type() const;  // USBDEVFS_URB_TYPE_*
  [[nodiscard]] bool in() const;   // towards the program; never a control transfer
  [[nodiscard]] bool done() const { return done_; }
  [[nodiscard]] std::span<const std::byte> sent() const;  // by the program

  void Accept();                                  // all that was sent
  void Answer(std::span<const std::byte> bytes);  // as far as there is room
  void Fail(int error);                           // EPIPE = stalled, ENODEV = gone

 private:
  friend class UsbfsNode;
  [[nodiscard]] usbdevfs_urb& urb() const;

  Owned<UMockdevIoctlData> urb_, buffer_;
  bool done_ = false;
};

// What sits behind a node. The errors are errno's, 0 = none. Called under the node's mutex.
class UsbfsInstrument {
 public:
  virtual ~UsbfsInstrument() = default;
  virtual int Claim() = 0;
  // A new transfer: finishes it, or refuses it with an error; an IN transfer may be left to wait.
  virtual int Take(UsbTransfer& transfer) = 0;
  // An IN transfer that waits, after each new one: finishes it if there is something to say.
  virtual void Serve(UsbTransfer& waiting) = 0;
  virtual bool gone() const { return false; }
  // Any further ioctl.
  virtual int Control(gulong /*request*/, UMockdevIoctlData* /*argument*/) { return ENOTTY; }
};

// The node exists, and answers, as long as this object; `instrument` outlives it.
class UsbfsNode {
 public:
  // `description` of the hub and the device; a forbidden node belongs to nobody.
  UsbfsNode(UsbfsInstrument& instrument, const std::string& description, bool forbidden);
  ~UsbfsNode();
  UsbfsNode(const UsbfsNode&) = delete;
  UsbfsNode& operator=(const UsbfsNode&) = delete;

  // Held while the instrument is asked or looked at.
  [[nodiscard]] std::mutex& mutex() const { return mutex_; }

 private:
  static gboolean OnIoctl(UMockdevIoctlBase* base, UMockdevIoctlClient* client, gpointer self);
  int Answer(gulong request, UMockdevIoctlData* argument);
  int Submit(UMockdevIoctlData* argument);
  int Discard(UMockdevIoctlData* argument);
  int Reap(UMockdevIoctlData* argument);

  UsbfsInstrument& instrument_;
  mutable std::mutex mutex_;
  std::deque<UsbTransfer> transfers_;
  Owned<UMockdevTestbed> testbed_;
  Owned<UMockdevIoctlBase> handler_;
};

}  // namespace lightcal::test
