// The blocks inside pixel_datapath as SystemC modules. Only the blocks of the configuration are
// elaborated; each counts the operations it executes. Values come from the model, many pixels at a
// time.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <systemc>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"
#include "model/shading/fields.h"

namespace phongpipe {

struct PixelOperations {
  std::uint64_t additions = 0, multiplications = 0;
  std::uint64_t reads = 0;  // of exponent_rom

  static constexpr auto fields() {
    using P = PixelOperations;
    return std::make_tuple(field("additions", &P::additions),
                           field("multiplications", &P::multiplications),
                           field("reads", &P::reads));
  }
};

class DatapathBlock : public sc_core::sc_module {
 public:
  explicit DatapathBlock(const sc_core::sc_module_name& name) : sc_core::sc_module(name) {}
  PixelOperations operations;
};

// Construct it inside the constructor of the module that contains the blocks.
class DatapathBlocks {
 public:
  explicit DatapathBlocks(const DatapathConfiguration& configuration);

  // Counts the operations of the span's pixels.
  void shade(const Span& span);
  PixelOperations operations() const;

 private:
  using Block = std::unique_ptr<DatapathBlock>;

  std::vector<Block> diffuse_, color_sum_, depth_cue_;  // one per channel, or none
  Block specular_, gate_, exponent_rom_, cue_series_;   // or null
  std::uint64_t rom_adders_;                            // for the increments of a bipartite ROM
  // For each span and series of a wide datapath: where its lanes start.
  std::uint64_t quadratic_lane_adders_, linear_lane_adders_;
};

}  // namespace phongpipe
