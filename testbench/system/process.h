// Other processes: programs that are run for their output, and our own work done in a child.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace phongpipe {

struct ProcessOutput {
  int status = -1;   // 0 is success; 127 where there is no such program
  std::string text;  // standard output and standard error
};

ProcessOutput run_process(const std::vector<std::string>& command);

// Runs `work` in a child process, at the same time as the caller goes on, and hands back the text
// it returns. An exception in the child becomes a std::runtime_error in get().
class Child {
 public:
  explicit Child(const std::function<std::string()>& work);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string get();  // waits; once

 private:
  int process_ = -1;
  int pipe_ = -1;
};

}  // namespace phongpipe
