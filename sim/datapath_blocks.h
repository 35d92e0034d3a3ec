// The blocks inside pixel_datapath, as modules: those the configuration has are elaborated, and
// each counts the operations it executes. Values come from the model, many pixels at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

struct PixelOperations {
  std::uint64_t additions = 0, multiplications = 0, reads = 0;  // reads: of exponent_rom
};

class DatapathBlock : public sc_core::sc_module {
 public:
  explicit DatapathBlock(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  PixelOperations operations;
};

// To be made inside the constructor of the module they are part of.
class DatapathBlocks {
 public:
  explicit DatapathBlocks(const DatapathConfiguration& configuration);

  // Counts what the span's pixels take.
  void shade(const Span& span);
  PixelOperations operations() const;

 private:
  using Block = std::unique_ptr<DatapathBlock>;

  std::vector<Block> diffuse_, color_sum_, depth_cue_;  // one a channel, or none
  Block specular_, gate_, exponent_rom_, cue_series_;   // or null
};

}  // namespace phongpipe
