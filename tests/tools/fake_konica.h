// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "serial_instrument.h"

namespace lightcal::test {

// STX, `body` (head, command, and what follows), ETX, check characters, end of line.
inline std::string KonicaFrame(const std::string& body) {
  unsigned sum = '\x03';
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  constexpr const char* kDigits = "0123456789ABCDEF";
  return '\x02' + body + '\x03' + kDigits[sum / 16] + kDigits[sum % 16] + "\r\n";
}

// Answers commands, given as head, command and parameters ("00021200"), with frames of the bodies.
inline SerialAnswers KonicaAnswers(std::map<std::string, std::string> bodies) {
  return [bodies = std::move(bodies)](const std::string& command) {
    const auto body = bodies.find(command.size() > 8 ? command.substr(1, 8) : "");
    return body == bodies.end() ? std::string() : KonicaFrame(body->second);
  };
}

// The CL-200A reply 02 was captured from a real meter; the others follow the documentation.
inline const std::map<std::string, std::string> kCl200aBodies = {
    {"00541   ", "0054    "},
    {"004010  ", "0040    "},
    {"00021200", "00021 10+ 2733+45450+44990"},
    {"00081200", "00081 10+ 2733+30674+01480"}};
inline const std::map<std::string, std::string> kT10aBodies = {
    {"00541   ", "0054    "}, {"00100200", "00101 00+12344            "}};

// 8 characters after STX of each command: head, command, parameters.
inline std::vector<std::string> KonicaCommands(const std::vector<std::string>& commands) {
  std::vector<std::string> bodies;
  for (const std::string& command : commands) bodies.push_back(command.substr(1, 8));
  return bodies;
}

}  // namespace lightcal::test
