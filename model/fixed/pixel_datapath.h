// pixel_datapath: forward_differencer × series, exponent_rom and color_sum, many spans at a time.
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
  // `cue_color`: what depth cueing fades to. Throws InputError where the configuration is out of
  // range.
  explicit PixelDatapath(const DatapathConfiguration& configuration,
                         Evaluation evaluation = best_evaluation(),
                         const OutputColor& cue_color = {});

  // Needed before the first span that has a highlight.
  void load_table(const HighlightTable& table);

  // Colours of the spans' pixels, back to back, channel 0 in the low byte. `colors` must have room
  // for the last span's length rounded up to a multiple of kLanes; what lies behind its length is
  // overwritten with rubbish.
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
  // Words aligned to the fraction of color_sum, as it adds them.
  std::array<std::vector<std::int32_t>, 3> aligned_rom_;
  std::array<const std::int32_t*, 3> rom_ = {};
};

}  // namespace phongpipe
