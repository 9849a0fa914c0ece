// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/text.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "lightcal_devices/transport/process.h"
#include "lightcal_devices/transport/tty.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

constexpr std::size_t kPieceBytes = 4096;
constexpr int kMostPieces = 64;  // of what had piled up: 256 KiB, more than a pipe holds

tl::unexpected<Error> ReadOnly(const std::string& name) {
  return Failed(std::string(fault::kIo), name, "only sends; nothing can be written to it");
}

bool EndsLine(std::byte byte) { return byte == std::byte{'\n'} || byte == std::byte{'\r'}; }

class LineTransport final : public Transport {
 public:
  LineTransport(std::unique_ptr<Transport> inner, bool repeats)
      : inner_(std::move(inner)), repeats_(repeats) {}

  Result<void> Write(std::span<const std::byte> /*bytes*/, milliseconds /*timeout*/) override {
    return ReadOnly(Name());
  }

  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    const bool stale = steady_clock::now() - last_ > kStaleAfter;
    const bool paused = std::exchange(paused_, false);
    if (repeats_ && !joined_) {
      Join();
    } else if (stale || paused) {
      DropOld(repeats_ && stale);
    }
    auto line = NextLine(max, timeout);
    last_ = steady_clock::now();
    return line;
  }

  void Paused() override { paused_ = true; }
  [[nodiscard]] std::string Name() const override { return inner_->Name(); }

 private:
  // Adds what comes within `timeout`.
  Result<void> More(milliseconds timeout) {
    const auto piece = inner_->Read(kPieceBytes, timeout);
    if (!piece) return tl::unexpected(piece.error());
    held_.insert(held_.end(), piece->begin(), piece->end());
    return {};
  }

  void Join() {
    joined_ = true;
    in_the_middle_ = More(kJoinSilence).has_value();
  }

  // All whole lines, or (`all` false) all but the last.
  void DropOld(bool all) {
    std::size_t piled_up = held_.size();
    for (int i = 0; i < kMostPieces && More(milliseconds(0)); ++i) {
    }
    piled_up = held_.size() - piled_up;
    const auto is_end = [](std::byte byte) { return EndsLine(byte); };
    const auto last = std::find_if(held_.rbegin(), held_.rend(), is_end).base();
    // A full buffer of the kernel has holes.
    const bool ran_over = repeats_ && piled_up + 1 >= kPieceBytes;
    if (all || ran_over) {
      held_.erase(held_.begin(), last);
      in_the_middle_ = in_the_middle_ || ran_over;
      return;
    }
    // The last whole line: from its start, past the ends that stand after it.
    auto end = last;
    while (end != held_.begin() && EndsLine(*std::prev(end))) --end;
    auto start = end;
    while (start != held_.begin() && !EndsLine(*std::prev(start))) --start;
    held_.erase(held_.begin(), start);
  }

  Result<Bytes> NextLine(std::size_t max, milliseconds timeout) {
    while (true) {
      const auto end = std::ranges::find_if(held_, EndsLine);
      if (end == held_.end() && held_.size() < max) {
        auto more = More(timeout);
        if (more) continue;
        if (more.error().code != fault::kEnded || held_.empty()) return Propagate(std::move(more));
      }
      Bytes line(held_.begin(), end);
      held_.erase(held_.begin(), end == held_.end() ? end : std::next(end));
      if (std::exchange(in_the_middle_, false) || line.empty()) continue;
      line.resize(std::min(line.size(), max));
      return line;
    }
  }

  std::unique_ptr<Transport> inner_;
  bool repeats_;
  bool joined_ = false;
  bool paused_ = false;
  bool in_the_middle_ = false;  // what comes next is the rest of a line
  Bytes held_;
  steady_clock::time_point last_ = steady_clock::now();
};

class FifoTransport final : public Transport {
 public:
  FifoTransport(int file, std::string name) : file_(file), name_(std::move(name)) {}
  FifoTransport(const FifoTransport&) = delete;
  FifoTransport& operator=(const FifoTransport&) = delete;
  ~FifoTransport() override { ::close(file_); }

  Result<void> Write(std::span<const std::byte> /*bytes*/, milliseconds /*timeout*/) override {
    return ReadOnly(name_);
  }
  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    pollfd wait{file_, POLLIN, 0};
    if (::poll(&wait, 1, static_cast<int>(timeout.count())) <= 0) {
      return Failed(std::string(fault::kTimeout), name_,
                    "nothing was written within " + std::to_string(timeout.count()) +
                        " ms; is the program that writes it running, and does it end its lines?");
    }
    Bytes bytes(max);
    const ssize_t received = ::read(file_, bytes.data(), bytes.size());
    if (received <= 0) return Failed(std::string(fault::kIo), name_, std::strerror(errno));
    bytes.resize(static_cast<std::size_t>(received));
    return bytes;
  }
  [[nodiscard]] std::string Name() const override { return name_; }

 private:
  int file_;
  std::string name_;
};

// A program of the shell, started when it is first read and again when it has ended.
class CommandTransport final : public Transport {
 public:
  explicit CommandTransport(std::string command)
      : command_(std::move(command)),
        process_(OpenProcess({.program = "/bin/sh", .environment = {}})) {}
  Result<void> Write(std::span<const std::byte> /*bytes*/, milliseconds /*timeout*/) override {
    return ReadOnly(Name());
  }
  Result<Bytes> Read(std::size_t max, milliseconds timeout) override {
    if (!running_) {
      const auto started = process_->Control("start", StartArguments({"-c", command_}), 0, timeout);
      if (!started) return started;
      running_ = true;
      printed_ = false;
    }
    auto piece = process_->Read(max, timeout);
    if (piece) {
      printed_ = true;
      return piece;
    }
    if (piece.error().code == fault::kEnded) {
      running_ = false;
      if (!printed_) piece.error().message += "; it printed nothing";
    }
    piece.error().subject = Name();
    return piece;
  }
  [[nodiscard]] std::string Name() const override { return "program " + command_; }

 private:
  std::string command_;
  std::unique_ptr<Transport> process_;
  bool running_ = false;
  bool printed_ = false;  // since it was started
};

class TypedTransport final : public Transport {
 public:
  explicit TypedTransport(AskForText ask) : ask_(std::move(ask)) {}
  Result<void> Write(std::span<const std::byte> /*bytes*/, milliseconds /*timeout*/) override {
    return ReadOnly(Name());
  }
  Result<Bytes> Read(std::size_t max, milliseconds /*timeout*/) override {
    const auto text = ask_();
    if (!text) return Failed(std::string(fault::kEnded), Name(), "no number was typed");
    const auto bytes = AsBytes(*text);
    return Bytes(bytes.begin(),
                 bytes.begin() + static_cast<std::ptrdiff_t>(std::min(max, bytes.size())));
  }
  [[nodiscard]] std::string Name() const override { return "typed entry"; }

 private:
  AskForText ask_;
};

Result<std::unique_ptr<Transport>> OpenFifo(const std::string& path) {
  const std::string name = "FIFO " + path;
  // Open for writing too, so that the end of one writer is not the end of the line.
  const int file = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (file >= 0) return std::make_unique<FifoTransport>(file, name);
  if (errno == EACCES) {
    return Failed(std::string(fault::kNoPermission), name, "you may not open this FIFO");
  }
  return Failed(std::string(fault::kIo), name, std::strerror(errno));
}

}  // namespace

std::unique_ptr<Transport> OpenLines(std::unique_ptr<Transport> inner, bool repeats) {
  return std::make_unique<LineTransport>(std::move(inner), repeats);
}

Result<std::unique_ptr<Transport>> OpenTextSource(const std::string& address) {
  if (address.starts_with('!')) {
    return OpenLines(std::make_unique<CommandTransport>(address.substr(1)), false);
  }
  struct stat about = {};
  if (::stat(address.c_str(), &about) != 0) {
    return Failed(std::string(fault::kNoDevice), address,
                  "no such serial port or FIFO; a program is written with a '!': line:!PROGRAM");
  }
  if (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode)) {
    return Failed(std::string(fault::kIo), address,
                  "is neither a serial port nor a FIFO; a finished log is read with lightcal "
                  "import");
  }
  const bool is_fifo = S_ISFIFO(about.st_mode);
  auto stream = is_fifo ? OpenFifo(address) : OpenTty(address, k9600_8N1);
  if (!stream) return stream;
  return OpenLines(*std::move(stream), !is_fifo);
}

std::unique_ptr<Transport> OpenTyped(AskForText ask) {
  return std::make_unique<TypedTransport>(std::move(ask));
}

}  // namespace lightcal::devices
