// Child processes of our own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>

namespace phongpipe {

// fork(); throws ToolError where there can be no new process. The child ends with _exit(), for the
// parent's destructors and exit handlers are the parent's.
pid_t fork_or_throw();

// In a child: `signal` comes when the parent ends, or we end now if it has ended already.
void end_with_parent(pid_t parent, int signal);

// setrlimit(); what the parent was allowed is the most.
void set_limit(int resource, std::uint64_t soft, std::uint64_t hard);

// In a child that handles what nobody vouches for: bytes of memory beyond those that it has, and
// seconds of processor time, after which SIGXCPU ends it.
void limit_memory(std::size_t bytes);
void limit_processor_time(unsigned seconds);
// The most that a child may be allowed later, by prlimit().
constexpr unsigned kMostProcessorSeconds = 120;

// Returns what waitpid() says when the process has ended.
int wait_for(pid_t process);

}  // namespace phongpipe
