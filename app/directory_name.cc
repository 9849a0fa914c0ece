// SPDX-License-Identifier: Apache-2.0
#include "directory_name.h"

#include <filesystem>
#include <system_error>

#include "provenance_mark.h"

namespace lightcal::app {

CLI::Validator DirectoryName(const std::string& also) {
  return {[also](std::string& text) -> std::string {
            std::error_code error;
            const bool allowed = std::filesystem::path(text).extension().string() == also;
            if (allowed || !EndsAsOurs(text) || std::filesystem::is_directory(text, error)) {
              return "";
            }
            return "\"" + text +
                   "\" is a file's name, and this is the directory that the files go to: leave the "
                   "ending out";
          },
          ""};
}

}  // namespace lightcal::app
