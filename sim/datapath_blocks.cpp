#include "sim/datapath_blocks.h"

#include <fmt/format.h>

namespace phongpipe {

DatapathBlocks::DatapathBlocks(const DatapathConfiguration& configuration)
    : rom_adders_(static_cast<std::uint64_t>(configuration.rom_adders())),
      quadratic_lane_adders_(static_cast<std::uint64_t>(configuration.quadratic_lane_adders())),
      linear_lane_adders_(static_cast<std::uint64_t>(configuration.linear_lane_adders())) {
  const auto block = [](const std::string& name) {
    return std::make_unique<DatapathBlock>(name.c_str());
  };
  for (int c = 0; c < configuration.channels; ++c) {
    if (configuration.diffuse) diffuse_.push_back(block(fmt::format("diffuse_series_{}", c)));
    color_sum_.push_back(block(fmt::format("color_sum_{}", c)));
    if (configuration.depth_cue) depth_cue_.push_back(block(fmt::format("depth_cue_{}", c)));
  }
  if (configuration.specular) {
    specular_ = block("specular_series");
    exponent_rom_ = block("exponent_rom");
  }
  if (configuration.has_gate_series()) gate_ = block("gate_series");
  if (configuration.depth_cue) cue_series_ = block("cue_series");
}

void DatapathBlocks::shade(const Span& span) {
  const auto pixels = static_cast<std::uint64_t>(span.row.length);
  const std::uint64_t steps = 2 * pixels + quadratic_lane_adders_;
  if (span.step_diffuse) {
    for (const Block& series : diffuse_) series->operations.additions += steps;
    if (gate_) gate_->operations.additions += steps;
  }
  if (span.step_specular) specular_->operations.additions += steps;
  if (span.highlight) {
    exponent_rom_->operations.reads += pixels;
    exponent_rom_->operations.additions += rom_adders_ * pixels;
    for (const Block& sum : color_sum_) sum->operations.additions += pixels;
  }
  if (cue_series_) cue_series_->operations.additions += pixels + linear_lane_adders_;
  for (const Block& cue : depth_cue_) {
    cue->operations.additions += 2 * pixels;
    cue->operations.multiplications += pixels;
  }
}

PixelOperations DatapathBlocks::operations() const {
  PixelOperations sum;
  const auto add = [&sum](const Block& block) {
    if (!block) return;
    sum.additions += block->operations.additions;
    sum.multiplications += block->operations.multiplications;
    sum.reads += block->operations.reads;
  };
  for (const auto* blocks : {&diffuse_, &color_sum_, &depth_cue_}) {
    for (const Block& block : *blocks) add(block);
  }
  for (const Block* block : {&specular_, &gate_, &exponent_rom_, &cue_series_}) add(*block);
  return sum;
}

}  // namespace phongpipe
