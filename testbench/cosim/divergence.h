// Where an implementation first differs from the model: the pixel, and the register that caused it.
#pragma once

#include <cstdint>
#include <string>

#include "model/fixed/model_frame.h"
#include "model/shading/fields.h"

namespace phongpipe {

// The first pixel at which an implementation differs from the model.
struct Divergence {
  std::uint64_t stream_index = 0;  // of the pixel among all shaded pixels
  std::uint64_t span = 0;          // of the pixel, in the order of pixel_datapath
  std::uint32_t triangle = 0;      // of the scene, even if it was split
  std::int64_t cycle = 0;
  ShadedPixel model, found;
  bool missing = false;  // the implementation ended before this pixel
  bool extra = false;    // the model ended before it; `model` is at the place of `found`

  static constexpr auto fields() {
    using D = Divergence;
    return std::make_tuple(field("stream_index", &D::stream_index), field("span", &D::span),
                           field("triangle", &D::triangle), field("cycle", &D::cycle),
                           field("model", &D::model), field("found", &D::found),
                           field("missing", &D::missing), field("extra", &D::extra));
  }
};

// A register or an output that differs.
struct SignalDivergence {
  std::string block;   // "pixel_datapath.color.specular.rom"
  std::string signal;  // "address", or "table_words[7]"
  int width = 1;       // bits
  std::int64_t cycle = 0;
  std::int64_t model = 0, other = 0;  // values, with their sign if they have one

  static constexpr auto fields() {
    using S = SignalDivergence;
    return std::make_tuple(field("block", &S::block), field("signal", &S::signal),
                           field("width", &S::width), field("cycle", &S::cycle),
                           field("model", &S::model), field("other", &S::other));
  }
  std::string name() const { return block + "." + signal; }
};

// A value in hexadecimal, with the digits of `width` bits, such as 0x1f3.
std::string hex_text(std::int64_t value, int width);

}  // namespace phongpipe
