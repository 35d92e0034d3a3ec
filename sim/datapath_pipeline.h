// pixel_datapath, clock by clock: the model's values, in a pipeline with one stage per clock of
// latency. A stage advances when the next one is free.
#pragma once

#include <vector>

#include "model/fixed/pixel_datapath.h"
#include "sim/clocked_datapath.h"

namespace phongpipe {

class DatapathPipeline : public ClockedDatapath {
 public:
  explicit DatapathPipeline(const DatapathConfiguration& configuration,
                            const OutputColor& cue_color = {});

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

 private:
  void accept(const Span& span);

  struct Stage {
    bool valid = false;
    ShadedPixel pixel;
  };
  PixelDatapath values_;
  int last_address_;
  // The first stage holds a span and works through its pixels, the others hold one pixel each.
  std::vector<std::uint32_t> colors_;
  RowSpan row_;
  int next_ = 0;
  std::vector<Stage> stages_;
};

}  // namespace phongpipe
