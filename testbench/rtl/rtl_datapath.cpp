#include <algorithm>

#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

// Bits that leave the word at the left are those that its register does not have.
std::int64_t shifted(std::int64_t value, int bits) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(value) << bits);
}

RtlSeries to_rtl(const SeriesStart& start, int shift) {
  return {shifted(start.v, shift), shifted(start.d1, shift), shifted(start.d2, shift)};
}

}  // namespace

RtlSpan to_rtl(const Span& span, const RtlAlignment& alignment) {
  RtlSpan rtl = {};
  rtl.x = span.row.x;
  rtl.y = span.row.y;
  rtl.length = span.row.length;
  for (std::size_t c = 0; c < 3; ++c) {
    rtl.diffuse[c] = to_rtl(span.diffuse[c], alignment.diffuse);
    rtl.level[c] = shifted(span.level[c], alignment.diffuse);
  }
  rtl.specular = to_rtl(span.specular, alignment.specular);
  rtl.gate = to_rtl(span.gate, alignment.diffuse);
  rtl.cue = {span.cue.v, span.cue.d1, 0};
  rtl.first_pass = span.first_pass;
  rtl.step_diffuse = span.step_diffuse;
  rtl.step_specular = span.step_specular;
  rtl.highlight = span.highlight;
  return rtl;
}

RtlDatapath::RtlDatapath(const RtlLibrary& library, const OutputColor& cue_color,
                         const RtlAlignment& alignment)
    : interface_(&library.interface()), rtl_(interface_->create()), alignment_(alignment) {
  std::copy(cue_color.begin(), cue_color.end(), ports_.cue_color);
}

RtlDatapath::~RtlDatapath() {
  interface_->destroy(rtl_);
}

void RtlDatapath::before_edge(std::function<void()> look) {
  look_ = std::move(look);
  ports_.user = &look_;
  ports_.before_edge = [](void* user) { (*static_cast<std::function<void()>*>(user))(); };
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
  if (inputs.span != nullptr && !presenting_) presented_ = to_rtl(*inputs.span, alignment_);
  presenting_ = inputs.span != nullptr;
  ports_.span = presenting_ ? &presented_ : nullptr;
  ports_.pixel_ready = inputs.pixel_ready;
  ports_.rom_write = inputs.table != nullptr;
  if (inputs.table != nullptr) write_word(*inputs.table, inputs.rom_address);
  interface_->clock(rtl_, &ports_);
  if (ports_.span_ready) presenting_ = false;
  DatapathOutputs outputs;
  outputs.span_ready = ports_.span_ready != 0;
  outputs.pixel_valid = ports_.pixel_valid != 0;
  outputs.pixel = {ports_.pixel_x, ports_.pixel_y, ports_.pixel_color[0]};
  if (!outputs.pixel_valid) return outputs;
  outputs.others = ports_.pixels - 1;
  for (int k = 1; k <= outputs.others; ++k) {
    outputs.other[static_cast<std::size_t>(k) - 1] = {
        static_cast<std::uint16_t>(ports_.pixel_x + k), ports_.pixel_y, ports_.pixel_color[k]};
  }
  return outputs;
}

// To all addresses that begin with `address`; the last of them is left for the caller's clock.
void RtlDatapath::write_word(const HighlightTable& table, int address) {
  for (std::size_t c = 0; c < table.roms.size(); ++c) {
    const std::uint32_t word = table.roms[c].contents()[static_cast<std::size_t>(address)];
    ports_.rom_data[c] = static_cast<std::uint16_t>(word);
  }
  RtlPorts ports = ports_;  // no pixel is in flight, and no span may enter
  ports.span = nullptr;
  const int copies = 1 << alignment_.address;
  for (int copy = 0; copy + 1 < copies; ++copy) {
    ports.rom_address = static_cast<std::uint16_t>(address * copies + copy);
    interface_->clock(rtl_, &ports);
  }
  ports_.rom_address = static_cast<std::uint16_t>((address + 1) * copies - 1);
}

void RtlDatapath::load_table(const HighlightTable& table) {
  DatapathInputs inputs;
  inputs.table = &table;
  const auto words = static_cast<int>(table.roms.front().contents().size());
  for (inputs.rom_address = 0; inputs.rom_address < words; ++inputs.rom_address) clock(inputs);
}

}  // namespace phongpipe
