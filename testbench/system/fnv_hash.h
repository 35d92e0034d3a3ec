// FNV-1a, 64 bits, over any sequence of words, to compare two runs.
#pragma once

#include <cstdint>
#include <string_view>

namespace phongpipe {

class FnvHash {
 public:
  void add(std::uint64_t word) { hash_ = (hash_ ^ word) * 1099511628211U; }
  void add(std::string_view bytes) {
    for (const char byte : bytes) add(std::uint64_t{static_cast<std::uint8_t>(byte)});
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037U;
};

}  // namespace phongpipe
