#include "model/files/confined_child.h"

#include <fmt/format.h>
#include <seccomp.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>

#include "model/files/fork.h"
#include "model/scene/tool_error.h"

namespace phongpipe {
namespace {

constexpr time_t kPatienceSeconds = 60;
constexpr int kNoMemory = 99;  // exit status

// The system calls that C++ code needs to compute, to talk over a socket that it has, and to end.
constexpr std::array kAllowedCalls = {
    SCMP_SYS(read),         SCMP_SYS(write),          SCMP_SYS(sendto),
    SCMP_SYS(recvfrom),     SCMP_SYS(mmap),           SCMP_SYS(munmap),
    SCMP_SYS(mremap),       SCMP_SYS(mprotect),       SCMP_SYS(madvise),
    SCMP_SYS(brk),          SCMP_SYS(futex),          SCMP_SYS(sched_yield),
    SCMP_SYS(rt_sigreturn), SCMP_SYS(rt_sigprocmask), SCMP_SYS(sigaltstack),
    SCMP_SYS(getpid),       SCMP_SYS(gettid),         SCMP_SYS(clock_gettime),
    SCMP_SYS(getrandom),    SCMP_SYS(exit),           SCMP_SYS(restart_syscall),
    SCMP_SYS(exit_group),
};

// All other system calls fail. Where the kernel has no seccomp, the limits must do.
[[maybe_unused]] void filter_system_calls() {
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(EPERM));
  if (filter == nullptr) return;
  for (const int call : kAllowedCalls) seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 0);
  // Of signals only to itself, as abort() sends one.
  seccomp_rule_add(filter, SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1,
                   SCMP_A0(SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid())));
  seccomp_load(filter);
  seccomp_release(filter);
}

void confine(const ChildLimits& limits) {
  limit_memory(limits.memory_bytes);
  limit_processor_time(limits.processor_seconds);
  close_range(1, ~0U, 0);  // 0 is the channel
  std::set_new_handler([] { _exit(kNoMemory); });
#ifndef __SANITIZE_ADDRESS__  // it opens files of its own where an exception is thrown
  for (const int resource : {RLIMIT_NOFILE, RLIMIT_FSIZE, RLIMIT_NPROC, RLIMIT_CORE}) {
    set_limit(resource, 0, 0);
  }
  filter_system_calls();
#endif
}

[[noreturn]] void run_child(int socket, pid_t parent, const ChildLimits& limits,
                            const std::function<void(const Channel&)>& work) {
  end_with_parent(parent, SIGKILL);
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) {
    std::signal(signal, SIG_DFL);
  }
  dup2(socket, 0);
  confine(limits);
  int status = 0;
  try {
    work(Channel(0));
  } catch (...) {  // nobody is left to tell
    status = 1;
  }
  _exit(status);
}

}  // namespace

void Channel::send(std::uint64_t kind, const void* bytes, std::size_t size) const {
  const auto send_all = [this](const void* data, std::size_t left) {
    for (const char* at = static_cast<const char*>(data); left > 0;) {
      const ssize_t count = ::send(socket_, at, left, MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) throw Closed("the other end does not listen");
      at += count;
      left -= static_cast<std::size_t>(count);
    }
  };
  const Header header = {kind, size};
  send_all(&header, sizeof header);
  send_all(bytes, size);
}

void Channel::send(std::uint64_t kind, const std::string& text) const {
  send(kind, text.data(), text.size());
}

Channel::Header Channel::receive_header() const {
  Header header;
  receive(&header, sizeof header);
  return header;
}

void Channel::receive(void* bytes, std::size_t size) const {
  for (char* at = static_cast<char*>(bytes); size > 0;) {
    const ssize_t count = recv(socket_, at, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw Closed("the other end is silent");
    if (count == 0) throw Closed("the other end has gone");
    at += count;
    size -= static_cast<std::size_t>(count);
  }
}

ConfinedChild::ConfinedChild(const std::function<void(const Channel&)>& work,
                             const ChildLimits& limits)
    : memory_bytes_(limits.memory_bytes), processor_seconds_(limits.processor_seconds) {
  std::array<int, 2> ends{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    throw ToolError(fmt::format("no connection to a new process: {}", std::strerror(errno)));
  }
  const timeval patience = {kPatienceSeconds, 0};
  setsockopt(ends[0], SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
  setsockopt(ends[0], SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  const pid_t parent = getpid();
  try {
    process_ = fork_or_throw();
  } catch (const ToolError&) {
    close(ends[0]);
    close(ends[1]);
    throw;
  }
  if (process_ == 0) run_child(ends[1], parent, limits, work);
  close(ends[1]);
  socket_ = ends[0];
  channel_ = Channel(socket_);
}

ConfinedChild::~ConfinedChild() {
  close(socket_);
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  wait_for(process_);
}

void ConfinedChild::allow_processor_seconds(unsigned seconds) {
  processor_seconds_ = std::min(seconds, kMostProcessorSeconds);
  rlimit limit{};
  prlimit(process_, RLIMIT_CPU, nullptr, &limit);
  limit.rlim_cur = std::min<rlim_t>(processor_seconds_, limit.rlim_max);
  prlimit(process_, RLIMIT_CPU, &limit, nullptr);
}

std::string ConfinedChild::ending() {
  // It may still be ending by itself, which tells more than that we killed it.
  shutdown(socket_, SHUT_RDWR);
  int status = 0;
  for (int attempt = 0; attempt < 100; ++attempt) {
    const pid_t ended = waitpid(process_, &status, WNOHANG);
    if (ended != 0) {
      process_ = -1;
      break;
    }
    usleep(1000);
  }
  if (process_ >= 0) {
    kill(process_, SIGKILL);
    wait_for(process_);
    process_ = -1;
    return fmt::format("gave no answer for {} s", kPatienceSeconds);
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    return fmt::format("took more than {} s of processor time", processor_seconds_);
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNoMemory) {
    return fmt::format("needs more than {} MiB of memory", memory_bytes_ >> 20U);
  }
  return WIFSIGNALED(status)
             ? fmt::format("died of signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)))
             : fmt::format("ended early with status {}", WEXITSTATUS(status));
}

}  // namespace phongpipe
