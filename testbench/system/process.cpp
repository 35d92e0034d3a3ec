#include "testbench/system/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

#include "model/files/fork.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"

namespace phongpipe {
namespace {

struct Pipe {
  int read_end, write_end;
};

Pipe make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) {
    throw ToolError(fmt::format("no pipe to a new process: {}", std::strerror(errno)));
  }
  return {ends[0], ends[1]};
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

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128;
}

std::string ending_text(int wait_status) {
  // A file that is mapped into memory and cannot grow ends a process by SIGBUS.
  if (WIFSIGNALED(wait_status) &&
      (WTERMSIG(wait_status) == SIGBUS || WTERMSIG(wait_status) == SIGXFSZ)) {
    return fmt::format("signal {}; is the disk full, or are files limited?", WTERMSIG(wait_status));
  }
  return WIFSIGNALED(wait_status) ? fmt::format("signal {}", WTERMSIG(wait_status))
                                  : fmt::format("status {}", WEXITSTATUS(wait_status));
}

// What a program is started with; made before the fork, after which nothing may be allocated.
struct Start {
  std::vector<char*> arguments;
  int folder = -1;  // -1: the current one
  int input, output;
  int failure;  // takes errno where the program cannot be started
  ProcessLimits limits;
};

[[noreturn]] void become_program(const Start& start) {
  dup2(start.input, STDIN_FILENO);
  dup2(start.output, STDOUT_FILENO);
  dup2(start.output, STDERR_FILENO);
  if (start.limits.memory_bytes > 0) {
    set_limit(RLIMIT_AS, start.limits.memory_bytes, start.limits.memory_bytes);
    set_limit(RLIMIT_CPU, start.limits.processor_seconds, start.limits.processor_seconds);
  }
  if (start.folder < 0 || fchdir(start.folder) == 0) {
    execvp(start.arguments.front(), start.arguments.data());
  }
  const int error = errno;
  [[maybe_unused]] const ssize_t ignored = write(start.failure, &error, sizeof error);
  _exit(127);
}

// Between us and the program, which gets a process group of its own: when we end, or on Ctrl-C, the
// whole group is killed. Nothing else would reach what the program has started.
[[noreturn]] void supervise(const Start& start, pid_t parent) {
  sigset_t awaited, before;
  sigemptyset(&awaited);
  for (const int signal : {SIGCHLD, SIGHUP, SIGINT, SIGQUIT, SIGTERM}) sigaddset(&awaited, signal);
  sigprocmask(SIG_BLOCK, &awaited, &before);
  end_with_parent(parent, SIGTERM);
  const pid_t supervisor = getpid();
  const pid_t program = fork();
  if (program == 0) {
    setpgid(0, 0);
    end_with_parent(supervisor, SIGKILL);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    become_program(start);
  }
  if (program < 0) {
    const int error = errno;
    [[maybe_unused]] const ssize_t ignored = write(start.failure, &error, sizeof error);
    _exit(127);
  }
  setpgid(program, program);  // here as well: whoever comes first
  close(start.output);
  for (;;) {
    int signal = 0, status = 0;
    sigwait(&awaited, &signal);
    if (signal != SIGCHLD) {
      kill(-program, SIGKILL);
      _exit(128 + signal);
    }
    if (waitpid(program, &status, WNOHANG) == program) _exit(exit_status(status));
  }
}

int open_or_throw(const char* path, int flags) {
  const int file = open(path, flags | O_CLOEXEC);
  if (file < 0) throw ToolError(fmt::format("{}: {}", path, std::strerror(errno)));
  return file;
}

// First byte of what a child hands back.
constexpr char kResult = 'r', kInputError = 'i', kToolError = 't', kNoMemory = 'm', kOther = 'e';

std::string result_of(const std::function<std::string()>& work) {
  try {
    return kResult + work();
  } catch (const InputError& error) {
    return kInputError + std::string(error.what());
  } catch (const ToolError& error) {
    return kToolError + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return {kNoMemory};
  } catch (const std::exception& error) {
    return kOther + std::string(error.what());
  }
}

}  // namespace

ProcessOutput run_process(const std::vector<std::string>& command,
                          const std::filesystem::path& folder, const ProcessLimits& limits) {
  Start start{};
  start.limits = limits;
  start.arguments.reserve(command.size() + 1);
  for (const std::string& word : command) {
    start.arguments.push_back(const_cast<char*>(word.c_str()));
  }
  start.arguments.push_back(nullptr);
  const Pipe output = make_pipe(), failure = make_pipe();
  start.input = open_or_throw("/dev/null", O_RDONLY);
  start.folder = folder.empty() ? -1 : open_or_throw(folder.c_str(), O_PATH | O_DIRECTORY);
  start.output = output.write_end;
  start.failure = failure.write_end;
  const pid_t parent = getpid();
  const pid_t supervisor = fork_or_throw();
  if (supervisor == 0) supervise(start, parent);
  for (const int file : {start.input, start.folder, start.output, start.failure}) close(file);
  ProcessOutput result;
  result.text = read_to_end(output.read_end);
  const std::string error = read_to_end(failure.read_end);
  result.status = exit_status(wait_for(supervisor));
  if (!error.empty()) std::memcpy(&result.start_error, error.data(), sizeof result.start_error);
  return result;
}

Child::Child(const std::function<std::string()>& work) {
  const Pipe result = make_pipe();
  const pid_t parent = getpid();
  process_ = fork_or_throw();
  if (process_ == 0) {
    end_with_parent(parent, SIGKILL);
    dup2(STDERR_FILENO, STDOUT_FILENO);  // what simulated RTL prints is no answer of ours
    close(result.read_end);
    write_all(result.write_end, result_of(work));
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
  if (status != 0 || text.empty()) {
    throw ToolError(
        fmt::format("a child process ended without a result ({})", ending_text(status)));
  }
  std::string rest = text.substr(1);
  switch (text.front()) {
    case kInputError:
      throw InputError(rest);
    case kToolError:
      throw ToolError(rest);
    case kNoMemory:
      throw std::bad_alloc();
    case kOther:
      throw std::runtime_error(rest);
    default:
      return rest;
  }
}

namespace {

// Each message is sent after its size.
void send_message(int file, const std::string& message) {
  const std::uint64_t size = message.size();
  std::string bytes(sizeof size, '\0');
  std::memcpy(bytes.data(), &size, sizeof size);
  write_all(file, bytes + message);
}

}  // namespace

Worker::Worker(const std::function<void(const Send&)>& work) {
  const Pipe messages = make_pipe();
  const pid_t parent = getpid();
  process_ = fork_or_throw();
  if (process_ == 0) {
    end_with_parent(parent, SIGKILL);
    std::signal(SIGINT, SIG_IGN);
    close(messages.read_end);
    int status = 0;
    try {
      work([&](const std::string& message) { send_message(messages.write_end, message); });
    } catch (const std::exception& error) {
      std::fputs(error.what(), stderr);
      status = 1;
    }
    std::fflush(nullptr);
    _exit(status);  // the parent's destructors and exit handlers are the parent's
  }
  close(messages.write_end);
  pipe_ = messages.read_end;
}

Worker::~Worker() {
  close(pipe_);
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  wait_for(process_);
}

std::vector<std::string> Worker::receive() {
  std::array<char, 65536> buffer{};
  const ssize_t count = read(pipe_, buffer.data(), buffer.size());
  if (count > 0) received_.append(buffer.data(), static_cast<std::size_t>(count));
  ended_ = count == 0 || (count < 0 && errno != EINTR);
  std::vector<std::string> messages;
  std::size_t at = 0;
  for (std::uint64_t size = 0; received_.size() - at >= sizeof size; at += size) {
    std::memcpy(&size, received_.data() + at, sizeof size);
    if (received_.size() - at - sizeof size < size) break;
    at += sizeof size;
    messages.push_back(received_.substr(at, size));
  }
  received_.erase(0, at);
  return messages;
}

std::string Worker::failure() {
  const int status = wait_for(process_);
  process_ = -1;
  return status == 0 ? std::string() : ending_text(status);
}

}  // namespace phongpipe
