// Work on bytes that nobody vouches for, in a child process that can do nothing but compute and
// talk with its parent. It cannot open, write or connect anything: it has no file but the channel
// and no right to another (RLIMIT_NOFILE), and where the kernel has seccomp, no system calls but
// those that manage memory, talk and end. Its memory and its processor time are limited.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>

namespace phongpipe {

// One end of a connection that carries messages: a kind, a size and bytes.
class Channel {
 public:
  explicit Channel(int socket) : socket_(socket) {}

  void send(std::uint64_t kind, const void* bytes, std::size_t size) const;
  void send(std::uint64_t kind, const std::string& text) const;

  struct Header {
    std::uint64_t kind = 0;
    std::uint64_t size = 0;  // bytes that follow: whoever asks for them checks it first
  };
  Header receive_header() const;
  void receive(void* bytes, std::size_t size) const;

  // The other end has gone, or has been silent for a minute.
  class Closed : public std::runtime_error {
   public:
    using std::runtime_error::runtime_error;
  };

 private:
  int socket_;
};

struct ChildLimits {
  std::size_t memory_bytes = 0;    // beyond those that the parent has now
  unsigned processor_seconds = 0;  // at most kMostProcessorSeconds
};

class ConfinedChild {
 public:
  // Throws ToolError where there can be no child.
  ConfinedChild(const std::function<void(const Channel&)>& work, const ChildLimits& limits);
  ~ConfinedChild();
  ConfinedChild(const ConfinedChild&) = delete;
  ConfinedChild& operator=(const ConfinedChild&) = delete;

  const Channel& channel() const { return channel_; }
  void allow_processor_seconds(unsigned seconds);  // in all, from its start

  // Ends the child, and tells how it ended, such as "took more than 2 s of processor time".
  std::string ending();

 private:
  int socket_ = -1;
  Channel channel_{-1};
  pid_t process_ = -1;
  std::size_t memory_bytes_ = 0;
  unsigned processor_seconds_ = 0;
};

}  // namespace phongpipe
