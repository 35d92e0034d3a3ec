// Other processes: programs run for their output, and our own work done in a child. None of them
// outlives the thread that started it, however that thread ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace phongpipe {

struct ProcessOutput {
  int status = -1;      // 0 is success; 127 where the program could not be started
  std::string text;     // standard output and standard error
  int start_error = 0;  // errno where the program could not be started
};

// Of each process that the program starts; 0: none.
struct ProcessLimits {
  std::uint64_t memory_bytes = 0;
  std::uint64_t processor_seconds = 0;
};

// Runs the program in `folder`, or in the current folder if it is empty, without input. When our
// process ends, the program and all that it has started are killed.
ProcessOutput run_process(const std::vector<std::string>& command,
                          const std::filesystem::path& folder = {},
                          const ProcessLimits& limits = {});

// Runs `work` in a child process, in parallel with the caller. get() returns the text of `work`, or
// throws again an InputError, ToolError or std::bad_alloc of the child, and any other exception as
// std::runtime_error.
class Child {
 public:
  explicit Child(const std::function<std::string()>& work);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  std::string get();  // waits for the child; call it once

 private:
  int process_ = -1;
  int pipe_ = -1;
};

// Runs `work` in a child process that sends messages, in parallel with the caller. The child
// ignores SIGINT: Ctrl-C is for the parent to answer.
class Worker {
 public:
  using Send = std::function<void(const std::string& message)>;

  explicit Worker(const std::function<void(const Send&)>& work);
  ~Worker();  // kills the child if it still runs
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  int file() const { return pipe_; }  // for poll(): readable when receive() would not block
  // Waits until something has come; returns the whole messages of it.
  std::vector<std::string> receive();
  bool ended() const { return ended_; }  // the child has sent its last message
  // Why the child ended without finishing its work, such as "signal 11"; empty if it finished. Call
  // it once ended().
  std::string failure();

 private:
  int process_ = -1;
  int pipe_ = -1;
  std::string received_;  // the start of a message
  bool ended_ = false;
};

}  // namespace phongpipe
