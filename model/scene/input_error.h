// Error in the input, described in one line: the place, what is wrong and what would be right.
#pragma once

#include <stdexcept>
#include <string>

namespace phongpipe {

// The program prints what() and exits with status 2.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  // "source:line: message", or "source: message" where there is no line (line 0).
  InputError(const std::string& source, unsigned line, const std::string& message);
};

}  // namespace phongpipe
