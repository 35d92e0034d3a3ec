// pixel_datapath: one forward_differencer per series, exponent_rom and color_sum, for many spans at
// a time.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

enum class Evaluation {
  stepping,  // pixel by pixel through the blocks: the definition
  portable,  // closed form, four pixels at a time, any machine
  avx2,      // the same code, eight at a time, with gathered ROM reads
};

// The fastest evaluation this machine can run.
Evaluation best_evaluation();

struct LaneInputs;

class PixelDatapath {
 public:
  // `cue_color`: the colour of depth cueing. Throws InputError if the configuration is out of
  // range.
  explicit PixelDatapath(const DatapathConfiguration& configuration,
                         Evaluation evaluation = best_evaluation(),
                         const OutputColor& cue_color = {});

  // Must be called before the first span that has a highlight.
  void load_table(const HighlightTable& table);

  // Writes the colours of the spans' pixels, back to back, channel 0 in the low byte. `colors` must
  // have room for the last span's length rounded up to a multiple of kLanes; words beyond its
  // length are overwritten with arbitrary values.
  static constexpr int kLanes = 8;
  static std::size_t padded(int length) {
    return (static_cast<std::size_t>(length) + kLanes - 1) / kLanes * kLanes;
  }
  void shade(const Span* spans, std::size_t count, std::uint32_t* colors) const;
  void shade(const Span& span, std::uint32_t* colors) const { shade(&span, 1, colors); }

 private:
  using ShadeFunction = void (*)(const LaneInputs&, const Span*, std::size_t, std::uint32_t*);
  void shade_stepping(const Span& span, std::uint32_t* colors) const;

  DatapathConfiguration configuration_;
  Evaluation evaluation_;
  OutputColor cue_color_;
  ShadeFunction shade_lanes_;
  // ROM words as color_sum adds them (see aligned_word).
  std::array<std::vector<std::int32_t>, 3> aligned_rom_;
  std::array<const std::int32_t*, 3> rom_ = {};
};

}  // namespace phongpipe
