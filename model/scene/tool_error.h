// Failure of a tool or the machine (compiler, disk, memory), described in one line with what to
// look at.
#pragma once

#include <stdexcept>

namespace phongpipe {

// The program prints what() and exits with status 3.
class ToolError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace phongpipe
