// SPDX-License-Identifier: Apache-2.0
// Debian's libceres.a tells libglog what it does. Nobody reads that here: a fit that finds no
// optimum says so itself (fit/model/least_squares.cc). Only a check of Ceres's own that fails
// speaks, and ends the program. So no start loads libglog, libgflags, libunwind and liblzma.
#include <glog/logging.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace fLI {
std::int32_t FLAGS_v = 0;
}  // namespace fLI

namespace google {

bool InitVLOG3__(SiteFlag* site, int32* level, const char* /*file*/, int32 verbose) {
  site->level = level;
  return *level >= verbose;
}

LogMessageTime::LogMessageTime() : time_struct_(), timestamp_(0), usecs_(0), gmtoffset_(0) {}

struct LogMessage::LogMessageData {
  std::ostringstream text;
};

LogMessage::LogMessage(const char* file, int line) : LogMessage(file, line, GLOG_INFO) {}
LogMessage::LogMessage(const char* /*file*/, int /*line*/, LogSeverity /*severity*/)
    : allocated_(new LogMessageData), data_(allocated_) {}
LogMessage::~LogMessage() { delete allocated_; }
std::ostream& LogMessage::stream() { return data_->text; }

LogMessageFatal::LogMessageFatal(const char* file, int line) : LogMessage(file, line, GLOG_FATAL) {}
LogMessageFatal::LogMessageFatal(const char* file, int line, const CheckOpString& result)
    : LogMessageFatal(file, line) {
  stream() << *result.str_ << " ";
}
LogMessageFatal::~LogMessageFatal() {
  const std::string text = static_cast<std::ostringstream&>(stream()).str();
  std::fprintf(stderr, "lightcal: a check of the solver failed: %s\n", text.c_str());
  std::abort();
}

namespace base {

CheckOpMessageBuilder::CheckOpMessageBuilder(const char* expression)
    : stream_(new std::ostringstream) {
  *stream_ << expression << " (";
}
CheckOpMessageBuilder::~CheckOpMessageBuilder() { delete stream_; }
std::ostream* CheckOpMessageBuilder::ForVar2() {
  *stream_ << " vs. ";
  return stream_;
}
std::string* CheckOpMessageBuilder::NewString() {
  *stream_ << ")";
  return new std::string(stream_->str());
}

}  // namespace base
}  // namespace google
