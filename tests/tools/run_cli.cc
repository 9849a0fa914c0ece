// SPDX-License-Identifier: Apache-2.0
#include "run_cli.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace lightcal::test {
namespace {

struct Pipe {
  int read_end = -1;
  int write_end = -1;
  Pipe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("pipe");
    read_end = ends[0];
    write_end = ends[1];
  }
};

void Drain(int fd, std::string& text, bool& open) {
  std::array<char, 65536> buffer{};
  const ssize_t n = ::read(fd, buffer.data(), buffer.size());
  if (n > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(n));
  } else {
    open = false;
  }
}

}  // namespace

CliResult RunProgram(const std::vector<std::string>& command, const std::string& input,
                     const std::vector<std::string>& environment) {
  Pipe in;
  Pipe out;
  Pipe err;
  const pid_t child = ::fork();
  if (child < 0) throw std::runtime_error("fork");
  if (child == 0) {
    ::dup2(in.read_end, STDIN_FILENO);
    ::dup2(out.write_end, STDOUT_FILENO);
    ::dup2(err.write_end, STDERR_FILENO);
    for (const std::string& entry : environment) {
      ::putenv(const_cast<char*>(entry.c_str()));
    }
    std::vector<char*> argv;
    for (const std::string& word : command) argv.push_back(const_cast<char*>(word.c_str()));
    argv.push_back(nullptr);
    ::execvp(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(in.read_end);
  ::close(out.write_end);
  ::close(err.write_end);
  auto* const former = std::signal(SIGPIPE, SIG_IGN);
  std::size_t sent = 0;
  while (sent < input.size()) {
    const ssize_t n = ::write(in.write_end, input.data() + sent, input.size() - sent);
    if (n <= 0) break;
    sent += static_cast<std::size_t>(n);
  }
  ::close(in.write_end);
  std::signal(SIGPIPE, former);
  CliResult result;
  bool out_open = true;
  bool err_open = true;
  while (out_open || err_open) {
    std::array<pollfd, 2> fds{pollfd{out_open ? out.read_end : -1, POLLIN, 0},
                              pollfd{err_open ? err.read_end : -1, POLLIN, 0}};
    ::poll(fds.data(), fds.size(), -1);
    if (fds[0].revents != 0) Drain(out.read_end, result.out, out_open);
    if (fds[1].revents != 0) Drain(err.read_end, result.err, err_open);
  }
  ::close(out.read_end);
  ::close(err.read_end);
  int status = 0;
  ::waitpid(child, &status, 0);
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

CliResult RunLightcal(const std::vector<std::string>& arguments, const std::string& input,
                      const std::vector<std::string>& environment,
                      const std::vector<std::string>& wrapper) {
  std::vector<std::string> command = wrapper;
  command.emplace_back(LIGHTCAL_BINARY);
  command.insert(command.end(), arguments.begin(), arguments.end());
  return RunProgram(command, input, environment);
}

TempDir::TempDir() {
  std::string name = (std::filesystem::temp_directory_path() / "lightcal-test-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("mkdtemp");
  path_ = name;
}

TempDir::~TempDir() {
  std::error_code ignored;
  std::filesystem::permissions(path_, std::filesystem::perms::owner_all, ignored);
  std::filesystem::remove_all(path_, ignored);
}

std::string TempDir::Write(const std::string& name, const std::string& contents) const {
  const std::filesystem::path path = std::filesystem::path(path_) / name;
  std::filesystem::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << contents;
  return path.string();
}

std::string ReadFile(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

std::string SampleData(const std::string& name) {
  return std::string(LIGHTCAL_SOURCE_DIR) + "/sample_data/" + name;
}

}  // namespace lightcal::test
