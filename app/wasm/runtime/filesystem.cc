// SPDX-License-Identifier: Apache-2.0
// What libc++'s <filesystem> declares and Debian's libc++ for WASI leaves out, over wasi-libc.
// Only what lightcal calls. The working directory is the host's and in PWD.
// Source: ISO/IEC 14882:2020, 31.12 [filesystems].
#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

_LIBCPP_BEGIN_NAMESPACE_STD
// Files as streams, which <fstream> expects the library to hold.
template class basic_filebuf<char>;
template class basic_ifstream<char>;
template class basic_ofstream<char>;
_LIBCPP_END_NAMESPACE_STD

_LIBCPP_BEGIN_NAMESPACE_FILESYSTEM

namespace {

using View = std::string_view;

// Apart from its caller: clang 19 does not survive the two in one function.
[[noreturn, gnu::noinline]] void Raise(int error_number, const char* what, const path& p) {
  throw filesystem_error(what, p, error_code(error_number, generic_category()));
}

void Report(int error_number, error_code* ec, const char* what, const path& p) {
  if (ec != nullptr) {
    *ec = error_code(error_number, generic_category());
  } else if (error_number != 0) {
    Raise(error_number, what, p);
  }
}

// wasi-libc begins at "/"; relative names are meant from where the host is.
[[gnu::constructor]] void GoWhereTheHostIs() {
  const char* const here = std::getenv("PWD");
  if (here != nullptr) static_cast<void>(::chdir(here));
}

std::size_t LastSlash(View text) { return text.find_last_of('/'); }

// "/a//b/" -> "/" "a" "b" "" (31.12.6.6)
std::vector<View> Elements(View text) {
  std::vector<View> elements;
  std::size_t at = 0;
  if (text.starts_with('/')) {
    elements.push_back(text.substr(0, 1));
    at = text.find_first_not_of('/');
  }
  while (at < text.size()) {
    const std::size_t end = std::min(text.find('/', at), text.size());
    elements.push_back(text.substr(at, end - at));
    at = text.find_first_not_of('/', end);
    if (at == View::npos && end < text.size()) elements.push_back(text.substr(text.size() - 1, 0));
  }
  return elements;
}

file_status StatusOf(int failed, const struct stat& found, error_code* ec, const path& p) {
  if (failed != 0) {
    const int number = errno;
    if (ec != nullptr) *ec = error_code(number, generic_category());
    if (number == ENOENT || number == ENOTDIR) return file_status(file_type::not_found);
    if (ec == nullptr) Report(number, ec, "status", p);
    return file_status(file_type::none);
  }
  if (ec != nullptr) ec->clear();
  const file_type type = S_ISREG(found.st_mode)   ? file_type::regular
                         : S_ISDIR(found.st_mode) ? file_type::directory
                         : S_ISLNK(found.st_mode) ? file_type::symlink
                         : S_ISCHR(found.st_mode) ? file_type::character
                                                  : file_type::unknown;
  return file_status(type, perms::owner_all);
}

}  // namespace

const path::value_type path::preferred_separator;

View path::__root_directory() const {
  return View(__pn_).substr(0, __pn_.starts_with('/') ? 1 : 0);
}
View path::__root_name() const { return {}; }
View path::__root_path_raw() const { return __root_directory(); }
View path::__relative_path() const {
  const auto at = __pn_.find_first_not_of('/');
  return at == View::npos ? View() : View(__pn_).substr(at);
}
View path::__filename() const {
  const std::size_t slash = LastSlash(__pn_);
  return View(__pn_).substr(slash == View::npos ? 0 : slash + 1);
}
View path::__parent_path() const {
  const View text(__pn_);
  const std::size_t slash = LastSlash(text);
  if (slash == View::npos) return {};
  const std::size_t last = text.substr(0, slash).find_last_not_of('/');
  return text.substr(0, last == View::npos ? 1 : last + 1);
}
View path::__stem() const {
  const View name = __filename();
  const std::size_t dot = name.rfind('.');
  return dot == View::npos || dot == 0 || name == ".." ? name : name.substr(0, dot);
}
View path::__extension() const { return __filename().substr(__stem().size()); }

int path::__compare(View other) const {
  const auto mine = Elements(__pn_), theirs = Elements(other);
  for (std::size_t i = 0; i < std::min(mine.size(), theirs.size()); ++i) {
    // A root directory comes after every name.
    const bool root = mine[i] == "/", their_root = theirs[i] == "/";
    if (root != their_root) return root ? 1 : -1;
    if (const int order = mine[i].compare(theirs[i]); order != 0) return order;
  }
  return mine.size() == theirs.size() ? 0 : mine.size() < theirs.size() ? -1 : 1;
}

path& path::replace_extension(const path& replacement) {
  __pn_.erase(__pn_.size() - __extension().size());
  if (!replacement.empty() && !replacement.native().starts_with('.')) __pn_ += '.';
  __pn_ += replacement.native();
  return *this;
}

path path::lexically_normal() const {
  if (empty()) return {};
  std::vector<View> kept;
  bool ends_in_directory = false;
  for (const View element : Elements(__pn_)) {
    ends_in_directory = element.empty() || element == "." || element == "..";
    if (element.empty() || element == ".") continue;
    if (element == ".." && !kept.empty() && kept.back() == "/") continue;
    if (element == ".." && !kept.empty() && kept.back() != "..") {
      kept.pop_back();
      continue;
    }
    kept.push_back(element);
  }
  path normal;
  for (const View element : kept) normal /= path(std::string(element));
  if (ends_in_directory && !kept.empty() && kept.back() != ".." && kept.back() != "/") normal /= "";
  if (normal.empty()) normal = ".";
  return normal;
}

path path::lexically_relative(const path& base) const {
  if (has_root_directory() != base.has_root_directory()) return {};
  const auto mine = Elements(__pn_), theirs = Elements(base.__pn_);
  std::size_t common = 0;
  while (common < mine.size() && common < theirs.size() && mine[common] == theirs[common]) ++common;
  if (common == mine.size() && common == theirs.size()) return ".";
  int up = 0;
  for (std::size_t i = common; i < theirs.size(); ++i) {
    if (theirs[i] == "..") {
      --up;
    } else if (!theirs[i].empty() && theirs[i] != ".") {
      ++up;
    }
  }
  if (up < 0) return {};
  if (up == 0 && (common == mine.size() || mine[common].empty())) return ".";
  path relative;
  for (int i = 0; i < up; ++i) relative /= "..";
  for (std::size_t i = common; i < mine.size(); ++i) relative /= path(std::string(mine[i]));
  return relative;
}

size_t hash_value(const path& p) noexcept {
  size_t hash = 0;
  for (const View element : Elements(p.native())) {
    hash = 31 * hash + std::hash<View>()(element);
  }
  return hash;
}

path::iterator path::begin() const {
  iterator at;
  at.__path_ptr_ = this;
  const auto elements = Elements(__pn_);
  if (elements.empty()) return end();
  at.__entry_ = elements.front();
  at.__state_ = iterator::_InFilenames;
  at.__stashed_elem_ = path(std::string(at.__entry_));
  return at;
}
path::iterator path::end() const {
  iterator at;
  at.__path_ptr_ = this;
  at.__entry_ = View(__pn_).substr(__pn_.size());
  at.__state_ = iterator::_AtEnd;
  return at;
}
path::iterator& path::iterator::__increment() {
  const auto elements = Elements(__path_ptr_->native());
  for (std::size_t i = 0; i + 1 < elements.size(); ++i) {
    if (elements[i].data() != __entry_.data()) continue;
    __entry_ = elements[i + 1];
    __stashed_elem_ = path(std::string(__entry_));
    return *this;
  }
  *this = __path_ptr_->end();
  return *this;
}
path::iterator& path::iterator::__decrement() {
  const auto elements = Elements(__path_ptr_->native());
  std::size_t i = elements.size();
  while (i > 0 && elements[i - 1].data() >= __entry_.data()) --i;
  __entry_ = elements[i == 0 ? 0 : i - 1];
  __state_ = _InFilenames;
  __stashed_elem_ = path(std::string(__entry_));
  return *this;
}

filesystem_error::~filesystem_error() = default;
void filesystem_error::__create_what(int) {
  __storage_->__what_ = std::string(system_error::what()) + ": " + __storage_->__p1_.native();
}

file_status __status(const path& p, error_code* ec) {
  struct stat found {};
  return StatusOf(::stat(p.c_str(), &found), found, ec, p);
}
file_status __symlink_status(const path& p, error_code* ec) {
  struct stat found {};
  return StatusOf(::lstat(p.c_str(), &found), found, ec, p);
}
uintmax_t __file_size(const path& p, error_code* ec) {
  struct stat found {};
  const int failed = ::stat(p.c_str(), &found);
  Report(failed != 0 ? errno : 0, ec, "file_size", p);
  return failed != 0 ? static_cast<uintmax_t>(-1) : static_cast<uintmax_t>(found.st_size);
}
bool __equivalent(const path& a, const path& b, error_code* ec) {
  struct stat one {
  }, other{};
  const bool found = ::stat(a.c_str(), &one) == 0 && ::stat(b.c_str(), &other) == 0;
  Report(found ? 0 : errno, ec, "equivalent", a);
  return found && one.st_dev == other.st_dev && one.st_ino == other.st_ino;
}

path __current_path(error_code* ec) {
  if (ec != nullptr) ec->clear();
  const char* const here = std::getenv("PWD");
  return here != nullptr && *here == '/' ? here : "/";
}
path __absolute(const path& p, error_code* ec) {
  if (ec != nullptr) ec->clear();
  return p.is_absolute() ? p : __current_path(nullptr) / p;
}
// Links on the way are followed, as far as the path is there.
path __weakly_canonical(const path& p, error_code* ec) {
  constexpr int kMostLinks = 40;
  path whole = __absolute(p, ec).lexically_normal();
  for (int links = 0; links < kMostLinks; ++links) {
    path done, rest;
    bool followed = false;
    for (const path& part : whole) {
      if (followed) {
        rest /= part;
        continue;
      }
      char said[4096];
      const path next = done / part;
      const ssize_t length = part == "/" ? -1 : ::readlink(next.c_str(), said, sizeof said);
      if (length <= 0) {
        done = next;
        continue;
      }
      const path target(std::string(said, static_cast<std::size_t>(length)));
      done = target.is_absolute() ? target : done / target;
      followed = true;
    }
    if (!followed) break;
    whole = (done / rest).lexically_normal();
  }
  return whole.filename().empty() && whole.has_relative_path() ? whole.parent_path() : whole;
}
path __canonical(const path& p, error_code* ec) {
  struct stat found {};
  const bool there = ::stat(p.c_str(), &found) == 0;
  Report(there ? 0 : errno, ec, "canonical", p);
  return there ? __weakly_canonical(p, ec) : path();
}

bool __create_directory(const path& p, error_code* ec) {
  const int failed = ::mkdir(p.c_str(), 0777);
  const int number = failed != 0 ? errno : 0;
  error_code ignored;
  const bool there = number == EEXIST && __status(p, &ignored).type() == file_type::directory;
  Report(there ? 0 : number, ec, "create_directory", p);
  return failed == 0;
}
bool __create_directories(const path& p, error_code* ec) {
  error_code ignored;
  const file_type type = __status(p, &ignored).type();
  if (type == file_type::directory) {
    if (ec != nullptr) ec->clear();
    return false;
  }
  if (type != file_type::not_found) {
    Report(ENOTDIR, ec, "create_directories", p);
    return false;
  }
  const path parent = p.parent_path();
  if (!parent.empty() && parent != p) {
    error_code failed;
    __create_directories(parent, &failed);
    if (failed) {
      Report(failed.value(), ec, "create_directories", parent);
      return false;
    }
  }
  if (p.filename().empty()) return true;
  return __create_directory(p, ec);
}
bool __remove(const path& p, error_code* ec) {
  const int failed = ::remove(p.c_str());
  const int number = failed != 0 ? errno : 0;
  Report(number == ENOENT ? 0 : number, ec, "remove", p);
  return failed == 0;
}
void __rename(const path& from, const path& to, error_code* ec) {
  const int failed = ::rename(from.c_str(), to.c_str());
  Report(failed != 0 ? errno : 0, ec, "rename", from);
}

class __dir_stream {
 public:
  std::vector<directory_entry> entries;
  std::size_t at = 0;
};

error_code directory_entry::__do_refresh() noexcept {
  error_code ec;
  __data_.__reset();  // nothing is kept: each question asks the host again
  static_cast<void>(filesystem::symlink_status(__p_, ec));
  return ec;
}

directory_iterator::directory_iterator(const path& p, error_code* ec, directory_options) {
  DIR* const open = ::opendir(p.c_str());
  Report(open == nullptr ? errno : 0, ec, "directory_iterator", p);
  if (open == nullptr) return;
  auto stream = std::make_shared<__dir_stream>();
  while (const dirent* const found = ::readdir(open)) {
    const View name(found->d_name);
    if (name != "." && name != "..") {
      error_code ignored;
      stream->entries.emplace_back(p / path(std::string(name)), ignored);
    }
  }
  ::closedir(open);
  if (!stream->entries.empty()) __imp_ = std::move(stream);
}
directory_iterator& directory_iterator::__increment(error_code* ec) {
  if (ec != nullptr) ec->clear();
  if (++__imp_->at == __imp_->entries.size()) __imp_.reset();
  return *this;
}
const directory_entry& directory_iterator::__dereference() const {
  return __imp_->entries[__imp_->at];
}

_LIBCPP_END_NAMESPACE_FILESYSTEM
