// SPDX-License-Identifier: Apache-2.0
#include "lightcal_devices/transport/process.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <thread>
#include <utility>

#include "lightcal_devices/transport/file_descriptor.h"
#include "lightcal_devices/transport/spawn.h"

namespace lightcal::devices {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

constexpr milliseconds kTermGrace{500};  // between SIGTERM and SIGKILL
constexpr milliseconds kSlice{20};       // between two looks at whether the program is over

// Keeps a write to a program that is over from ending us: for the scope, SIGPIPE is blocked, and
// one that came is taken away again.
class WithoutSigpipe {
 public:
  WithoutSigpipe() {
    sigemptyset(&sigpipe_);
    sigaddset(&sigpipe_, SIGPIPE);
    sigset_t pending;
    sigpending(&pending);
    was_pending_ = sigismember(&pending, SIGPIPE) == 1;
    pthread_sigmask(SIG_BLOCK, &sigpipe_, &former_);
  }
  ~WithoutSigpipe() {
    if (!was_pending_) {
      constexpr timespec kNow = {0, 0};
      while (sigtimedwait(&sigpipe_, nullptr, &kNow) < 0 && errno == EINTR) {
      }
    }
    pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }
  WithoutSigpipe(const WithoutSigpipe&) = delete;
  WithoutSigpipe& operator=(const WithoutSigpipe&) = delete;

 private:
  sigset_t sigpipe_{};
  sigset_t former_{};
  bool was_pending_ = false;
};

std::vector<std::string> SplitArguments(std::span<const std::byte> bytes) {
  std::vector<std::string> arguments;
  std::string current;
  for (const std::byte b : bytes) {
    const char c = std::to_integer<char>(b);
    if (c == '\n' || c == '\0') {
      arguments.push_back(std::exchange(current, ""));
    } else {
      current += c;
    }
  }
  if (!current.empty()) arguments.push_back(current);
  return arguments;
}

// Whether a child has ended; it stays a zombie, so that its number and its group's stay its own.
bool HasEnded(pid_t child, siginfo_t& how) {
  how = {};
  int status = 0;
  do {
    status = ::waitid(P_PID, static_cast<id_t>(child), &how, WEXITED | WNOHANG | WNOWAIT);
  } while (status != 0 && errno == EINTR);
  return status == 0 && how.si_pid == child;
}

std::string StatusText(const siginfo_t& how) {
  const std::string number = std::to_string(how.si_status);
  return how.si_code == CLD_EXITED ? number : "signal " + number;
}

// The time one call may take.
class Limit {
 public:
  explicit Limit(milliseconds timeout) : until_(Clock::now() + timeout) {}
  void NotBeyond(Clock::time_point other) { until_ = std::min(until_, other); }
  [[nodiscard]] milliseconds Left() const {
    const auto left = std::chrono::ceil<milliseconds>(until_ - Clock::now());
    return std::max(left, milliseconds(0));
  }
  // The next piece of it; never more than a slice.
  [[nodiscard]] milliseconds Slice() const { return std::min(Left(), kSlice); }

 private:
  Clock::time_point until_;
};

class ProcessTransport final : public Transport {
 public:
  explicit ProcessTransport(ProcessSettings settings) : settings_(std::move(settings)) {
    settings_.environment.emplace_back("LC_ALL=C");
  }
  ~ProcessTransport() override { Stop(); }
  ProcessTransport(const ProcessTransport&) = delete;
  ProcessTransport& operator=(const ProcessTransport&) = delete;

  Result<void> Write(std::span<const std::byte> bytes, milliseconds timeout) override;
  Result<Bytes> Read(std::size_t max, milliseconds timeout) override;
  Result<Bytes> Control(std::string_view verb, std::span<const std::byte> bytes, std::size_t max,
                        milliseconds timeout) override;
  [[nodiscard]] std::string Name() const override { return "program " + settings_.program; }

 private:
  Result<void> Start(std::span<const std::byte> arguments);
  // Kills the group and collects the child; the pipes are closed.
  void Stop();
  Result<Bytes> ExitStatus(milliseconds timeout);
  [[nodiscard]] bool Runs() const { return child_ > 0; }
  [[nodiscard]] Limit LimitOf(milliseconds timeout) const;
  // Ends a run that took too long; the error of a call whose time is up.
  tl::unexpected<Error> OutOfTime(milliseconds timeout);
  [[nodiscard]] tl::unexpected<Error> Over() const;
  [[nodiscard]] tl::unexpected<Error> Io(std::string_view what) const;

  ProcessSettings settings_;
  pid_t child_ = -1;
  Clock::time_point started_;
  FileDescriptor input_;   // the program's, our end
  FileDescriptor output_;  // its standard output and error, our end
  std::string ending_ = "was not started";
};

tl::unexpected<Error> ProcessTransport::Io(std::string_view what) const {
  return Failed(std::string(fault::kIo), Name(), std::string(what) + ": " + std::strerror(errno));
}

tl::unexpected<Error> ProcessTransport::Over() const {
  std::string how = ending_;
  if (siginfo_t end; Runs() && HasEnded(child_, end)) {
    how =
        "is over, " + std::string(end.si_code == CLD_EXITED ? "exit code " : "") + StatusText(end);
  }
  return Failed(std::string(fault::kEnded), Name(), how);
}

Limit ProcessTransport::LimitOf(milliseconds timeout) const {
  Limit limit(timeout);
  if (settings_.longest_run.count() > 0) limit.NotBeyond(started_ + settings_.longest_run);
  return limit;
}

tl::unexpected<Error> ProcessTransport::OutOfTime(milliseconds timeout) {
  const bool too_long =
      settings_.longest_run.count() > 0 && Clock::now() >= started_ + settings_.longest_run;
  if (!too_long) {
    return Failed(std::string(fault::kTimeout), Name(),
                  "nothing within " + std::to_string(timeout.count()) + " ms; it still runs");
  }
  Stop();
  ending_ =
      "ran longer than " + std::to_string(settings_.longest_run.count()) + " ms and was stopped";
  return Over();
}

Result<void> ProcessTransport::Start(std::span<const std::byte> arguments) {
  Stop();
  Pipe input;
  Pipe output;
  if (!MakePipe(input) || !MakePipe(output)) return Io("no pipe");
  std::vector<std::string> words = SplitArguments(arguments);
  words.insert(words.begin(), settings_.program);
  pid_t child = -1;
  errno = SpawnProgram(child, std::move(words), EnvironmentWith(settings_.environment),
                       input.read_end.get(), output.write_end.get());
  if (errno == ENOENT || errno == ENOTDIR) {
    return Failed(std::string(fault::kNoDevice), Name(),
                  "there is no such program; install it, or give its whole path");
  }
  if (errno == EACCES || errno == EPERM || errno == ENOEXEC) {
    return Failed(std::string(fault::kNoPermission), Name(),
                  "may not be executed; make it executable (chmod +x)");
  }
  if (errno != 0) return Io("cannot be started");
  child_ = child;
  started_ = Clock::now();
  input_ = std::move(input.write_end);
  output_ = std::move(output.read_end);
  // Only ours: each end of a pipe has flags of its own.
  ::fcntl(input_.get(), F_SETFL, O_NONBLOCK);
  ::fcntl(output_.get(), F_SETFL, O_NONBLOCK);
  return {};
}

void ProcessTransport::Stop() {
  input_.Close();
  output_.Close();
  if (!Runs()) return;
  siginfo_t how;
  if (!HasEnded(child_, how)) {
    ::kill(-child_, SIGTERM);
    const Limit grace(kTermGrace);
    while (!HasEnded(child_, how) && grace.Left().count() > 0) {
      std::this_thread::sleep_for(milliseconds(1));
    }
  }
  ::kill(-child_, SIGKILL);  // whoever of the group is left
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  ending_ = "was stopped";
}

Result<Bytes> ProcessTransport::Read(std::size_t max, milliseconds timeout) {
  if (!Runs()) return Over();
  if (max == 0) return Bytes();
  const Limit limit = LimitOf(timeout);
  Bytes buffer(std::min<std::size_t>(max, 65536));
  bool closed = false;
  for (;;) {
    siginfo_t how;
    const bool ended = HasEnded(child_, how);  // looked at first: then what it printed is all there
    const ssize_t got = closed ? 0 : ::read(output_.get(), buffer.data(), buffer.size());
    if (got > 0) {
      buffer.resize(static_cast<std::size_t>(got));
      return buffer;
    }
    if (got < 0 && errno != EAGAIN && errno != EINTR) return Io("cannot be read");
    if (ended) return Over();
    closed = got == 0;
    if (limit.Left().count() == 0) return OutOfTime(timeout);
    pollfd line{closed ? -1 : output_.get(), POLLIN, 0};
    const auto wait = closed ? milliseconds(1) : limit.Slice();
    ::poll(&line, 1, static_cast<int>(wait.count()));
  }
}

Result<void> ProcessTransport::Write(std::span<const std::byte> bytes, milliseconds timeout) {
  if (!Runs()) return Over();
  const WithoutSigpipe guard;
  const Limit limit = LimitOf(timeout);
  while (!bytes.empty()) {
    const ssize_t sent = ::write(input_.get(), bytes.data(), bytes.size());
    if (sent > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      continue;
    }
    if (errno == EPIPE) {
      siginfo_t how;
      if (HasEnded(child_, how)) return Over();
      return Failed(std::string(fault::kEnded), Name(), "has closed its standard input");
    }
    if (errno != EAGAIN && errno != EINTR) return Io("cannot be written to");
    if (limit.Left().count() == 0) return OutOfTime(timeout);
    pollfd line{input_.get(), POLLOUT, 0};
    ::poll(&line, 1, static_cast<int>(limit.Slice().count()));
  }
  return {};
}

Result<Bytes> ProcessTransport::ExitStatus(milliseconds timeout) {
  if (!Runs()) return Over();
  const Limit limit = LimitOf(timeout);
  siginfo_t how;
  while (!HasEnded(child_, how)) {
    if (limit.Left().count() == 0) return OutOfTime(timeout);
    std::this_thread::sleep_for(milliseconds(1));
  }
  const std::string text = StatusText(how);
  const auto bytes = AsBytes(text);
  return Bytes(bytes.begin(), bytes.end());
}

Result<Bytes> ProcessTransport::Control(std::string_view verb, std::span<const std::byte> bytes,
                                        std::size_t max, milliseconds timeout) {
  if (verb == "program") {
    settings_.program.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return Bytes();
  }
  if (verb == "start") {
    if (auto started = Start(bytes); !started) return tl::unexpected(started.error());
    return Bytes();
  }
  if (verb == "stop") {
    Stop();
    return Bytes();
  }
  if (verb == "exit_status") return ExitStatus(timeout);
  return Transport::Control(verb, bytes, max, timeout);
}

}  // namespace

std::unique_ptr<Transport> OpenProcess(const ProcessSettings& settings) {
  return std::make_unique<ProcessTransport>(settings);
}

Bytes StartArguments(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) text += argument + '\n';
  const auto bytes = AsBytes(text);
  return {bytes.begin(), bytes.end()};
}

std::optional<std::string> ProgramOnPath(std::string_view program) {
  const auto runs = [](const std::string& path) { return ::access(path.c_str(), X_OK) == 0; };
  if (program.find('/') != std::string_view::npos) {
    const std::string path(program);
    return runs(path) ? std::optional(path) : std::nullopt;
  }
  const char* const variable = std::getenv("PATH");
  std::string_view folders = variable == nullptr ? "/usr/local/bin:/usr/bin:/bin" : variable;
  while (!folders.empty() && !program.empty()) {
    const auto colon = folders.find(':');
    const std::string folder(folders.substr(0, colon));
    if (const std::string path = folder + "/" + std::string(program);
        !folder.empty() && runs(path)) {
      return path;
    }
    if (colon == std::string_view::npos) break;
    folders.remove_prefix(colon + 1);
  }
  return std::nullopt;
}

}  // namespace lightcal::devices
