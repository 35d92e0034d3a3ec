// Bad input, told in one line: where it is, what is wrong and what would be right.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace phongpipe {

// The program prints what() and exits with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  // "file:line: message", or "file: message" where there is no line (line 0).
  InputError(const std::filesystem::path& file, unsigned line, const std::string& message);
};

}  // namespace phongpipe
