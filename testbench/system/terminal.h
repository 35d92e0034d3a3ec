// Output on a terminal: progress, colours, and text from outside made harmless.
#pragma once

#include <string>
#include <string_view>

namespace phongpipe {

// Shows the current step on a terminal; silent in a pipe.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void operator()(const std::string& what);
  void clear();

 private:
  bool terminal_;
  bool shown_ = false;
};

// Writes a line to standard error. That it is closed or full is no reason to stop.
void tell(const std::string& line);

bool color_wanted();  // standard output is a terminal, and NO_COLOR is not set

// Text from outside, such as the name of a file, made safe for a terminal and for a JSON string:
// control characters become \n, \t or \x1b, and bytes that are not UTF-8 become \xff.
std::string printable(std::string_view text);

}  // namespace phongpipe
