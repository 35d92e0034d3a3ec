#include "model/files/fork.h"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "model/scene/tool_error.h"

namespace phongpipe {

pid_t fork_or_throw() {
  std::signal(SIGCHLD, SIG_DFL);  // where it is ignored, there is no exit status
  std::fflush(nullptr);           // or the child would print it again
  const pid_t process = fork();
  if (process < 0) {
    throw ToolError(
        fmt::format("no new process could be started, memory or processes are short: {}",
                    std::strerror(errno)));
  }
  return process;
}

void end_with_parent(pid_t parent, int signal) {
  prctl(PR_SET_PDEATHSIG, signal);
  if (getppid() != parent) _exit(1);
}

void set_limit(int resource, std::uint64_t soft, std::uint64_t hard) {
  const auto which = static_cast<__rlimit_resource>(resource);
  rlimit limit{};
  getrlimit(which, &limit);
  limit.rlim_max = std::min<rlim_t>(limit.rlim_max, hard);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, soft);
  setrlimit(which, &limit);
}

void limit_memory(std::size_t bytes) {
  unsigned long long pages = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "re");
  if (file == nullptr || std::fscanf(file, "%llu", &pages) != 1) pages = 0;
  if (file != nullptr) std::fclose(file);
  const rlim_t address_space = pages * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + bytes;
  set_limit(RLIMIT_AS, address_space, address_space);
}

void limit_processor_time(unsigned seconds) {
  set_limit(RLIMIT_CPU, std::min(seconds, kMostProcessorSeconds), kMostProcessorSeconds);
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace phongpipe
