// Work in independent parts, on all cores.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

namespace phongpipe {

// Calls work(part) once for each part from 0 to before `parts`, on all cores or one.
template <typename Work>
void run_parts(std::uint32_t parts, bool one_core, Work work) {
  std::atomic<std::uint32_t> next{0};
  const auto run = [&] {
    for (std::uint32_t part = next++; part < parts; part = next++) work(part);
  };
  std::vector<std::thread> threads;
  const unsigned cores = one_core ? 1 : std::thread::hardware_concurrency();
  for (unsigned i = 1; i < std::min(cores, parts); ++i) threads.emplace_back(run);
  run();
  for (std::thread& thread : threads) thread.join();
}

// The first of `count` items that belong to a part; part + 1 gives the end.
inline std::uint32_t first_of_part(std::size_t count, std::uint32_t part, std::uint32_t parts) {
  return static_cast<std::uint32_t>(std::uint64_t{count} * part / parts);
}

}  // namespace phongpipe
