#include <algorithm>

#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

RtlSeries to_rtl(const SeriesStart& start) {
  return {start.v, start.d1, start.d2};
}

}  // namespace

RtlSpan to_rtl(const Span& span) {
  RtlSpan rtl = {};
  rtl.x = span.row.x;
  rtl.y = span.row.y;
  rtl.length = span.row.length;
  for (std::size_t c = 0; c < 3; ++c) {
    rtl.diffuse[c] = to_rtl(span.diffuse[c]);
    rtl.level[c] = span.level[c];
  }
  rtl.specular = to_rtl(span.specular);
  rtl.gate = to_rtl(span.gate);
  rtl.cue = to_rtl(span.cue);
  rtl.first_pass = span.first_pass;
  rtl.step_diffuse = span.step_diffuse;
  rtl.step_specular = span.step_specular;
  rtl.highlight = span.highlight;
  return rtl;
}

RtlDatapath::RtlDatapath(const RtlLibrary& library, const OutputColor& cue_color)
    : interface_(&library.interface()), rtl_(interface_->create()) {
  std::copy(cue_color.begin(), cue_color.end(), ports_.cue_color);
}

RtlDatapath::~RtlDatapath() {
  interface_->destroy(rtl_);
}

void RtlDatapath::reset() {
  ports_.span = nullptr;
  ports_.rom_write = 0;
  ports_.reset = 1;
  interface_->clock(rtl_, &ports_);
  ports_.reset = 0;
  presenting_ = false;
}

DatapathOutputs RtlDatapath::clock(const DatapathInputs& inputs) {
  if (inputs.span != nullptr && !presenting_) presented_ = to_rtl(*inputs.span);
  presenting_ = inputs.span != nullptr;
  ports_.span = presenting_ ? &presented_ : nullptr;
  ports_.pixel_ready = inputs.pixel_ready;
  ports_.rom_write = inputs.table != nullptr;
  if (inputs.table != nullptr) {
    ports_.rom_address = static_cast<std::uint16_t>(inputs.rom_address);
    for (std::size_t c = 0; c < inputs.table->roms.size(); ++c) {
      const auto address = static_cast<std::size_t>(inputs.rom_address);
      ports_.rom_data[c] = static_cast<std::uint16_t>(inputs.table->roms[c].words()[address]);
    }
  }
  interface_->clock(rtl_, &ports_);
  if (ports_.span_ready) presenting_ = false;
  DatapathOutputs outputs;
  outputs.span_ready = ports_.span_ready != 0;
  outputs.pixel_valid = ports_.pixel_valid != 0;
  outputs.pixel = {ports_.pixel_x, ports_.pixel_y, ports_.pixel_color};
  return outputs;
}

void RtlDatapath::load_table(const HighlightTable& table) {
  DatapathInputs inputs;
  inputs.table = &table;
  const auto words = static_cast<int>(table.roms.front().words().size());
  for (inputs.rom_address = 0; inputs.rom_address < words; ++inputs.rom_address) clock(inputs);
}

}  // namespace phongpipe
