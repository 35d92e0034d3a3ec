// Compares two waveforms of pixel_datapath pixel by pixel, whatever the time at which each pixel
// passes.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace phongpipe {

// The first signal that differs.
struct TraceDifference {
  std::uint64_t pixel = 0;  // of those that both traces have
  int x = 0, y = 0;
  std::string signal;                // "pixel_datapath.color.specular.rom.address"
  std::string a, b;                  // bits
  std::uint64_t a_ps = 0, b_ps = 0;  // when the stage takes the pixel
};

// One pixel_datapath of each file, compared.
struct TraceComparison {
  std::string a_scope, b_scope;  // "phongpipe.rtl"
  bool same_record = false;      // both in one file: then each has the pixels that the other has
  int lanes = 1;                 // of a wide datapath, whose groups of pixels are counted as pixels
  std::uint64_t a_pixels = 0, b_pixels = 0;               // in each trace
  std::uint64_t compared = 0;                             // pixels that both have
  std::size_t signals = 0;                                // that both have
  std::optional<int> a_latency_cycles, b_latency_cycles;  // the least of all pixels
  std::optional<TraceDifference> first;

  bool same() const { return !first && compared > 0 && (!same_record || a_pixels == b_pixels); }
};

struct TraceDiff {
  std::vector<TraceComparison> comparisons;
  bool a_complete = true, b_complete = true;  // false: the file was cut

  bool same() const;
};

// Compares the implementations that both files have, by the name of their scope; if they have none
// in common, the first of each. `a` and `b` may be the same file: then its implementations are
// compared with each other. Throws InputError if a file is no waveform, has no pixel_datapath, or
// was cut before a pixel that both have.
TraceDiff diff_traces(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace phongpipe
