#include "testbench/system/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>

namespace phongpipe {
namespace {

struct Pipe {
  int read_end, write_end;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
  return {ends[0], ends[1]};
}

pid_t fork_or_throw() {
  std::fflush(nullptr);  // or the child would print it again
  const pid_t process = fork();
  if (process < 0) throw std::system_error(errno, std::generic_category(), "fork");
  return process;
}

std::string read_to_end(int file) {
  std::string text;
  std::array<char, 65536> buffer{};
  for (;;) {
    const ssize_t count = read(file, buffer.data(), buffer.size());
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      break;
    }
  }
  close(file);
  return text;
}

void write_all(int file, const std::string& text) {
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count > 0) {
      done += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      return;
    }
  }
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

constexpr char kResult = 'r', kException = 'e';

}  // namespace

ProcessOutput run_process(const std::vector<std::string>& command) {
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const Pipe output = make_pipe();
  const pid_t process = fork_or_throw();
  if (process == 0) {
    dup2(output.write_end, STDOUT_FILENO);
    dup2(output.write_end, STDERR_FILENO);
    execvp(arguments.front(), arguments.data());
    _exit(127);
  }
  close(output.write_end);
  ProcessOutput result;
  result.text = read_to_end(output.read_end);
  const int status = wait_for(process);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return result;
}

Child::Child(const std::function<std::string()>& work) {
  const Pipe result = make_pipe();
  process_ = fork_or_throw();
  if (process_ == 0) {
    close(result.read_end);
    std::string text;
    try {
      text = kResult + work();
    } catch (const std::exception& error) {
      text = kException + std::string(error.what());
    }
    write_all(result.write_end, text);
    std::fflush(nullptr);
    _exit(0);  // the parent's destructors and exit handlers are the parent's
  }
  close(result.write_end);
  pipe_ = result.read_end;
}

Child::~Child() {
  if (process_ < 0) return;
  close(pipe_);
  kill(process_, SIGKILL);
  wait_for(process_);
}

std::string Child::get() {
  const std::string text = read_to_end(pipe_);
  const int status = wait_for(process_);
  process_ = -1;
  if (text.empty()) {
    throw std::runtime_error(fmt::format("a child process ended without a result ({})",
                                         WIFSIGNALED(status)
                                             ? fmt::format("signal {}", WTERMSIG(status))
                                             : fmt::format("status {}", WEXITSTATUS(status))));
  }
  if (text.front() == kException) throw std::runtime_error(text.substr(1));
  return text.substr(1);
}

}  // namespace phongpipe
