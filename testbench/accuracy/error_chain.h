// The colour of each pixel at every link of the chain exact Phong → Phong of the triangle that is
// shown → real polynomial → rounded coefficients → ROM → 8-bit output. All lights together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "testbench/accuracy/exact_visibility.h"

namespace phongpipe {

// The colours of one visible pixel along the chain, in LSB; the channels in use only.
struct ErrorChain {
  std::size_t index = 0;  // of the pixel in the image
  Color exact;            // Phong shading of the nearest triangle, normals normalised at the pixel
  Color shown;            // the same of the triangle that the frame shows
  Color polynomial;       // the series in real arithmetic, exact powers
  Color rounded;          // the datapath's series, exact powers
  Color address;  // exact powers of what the ROM's addresses stand for; in split_error() only
  Color table;    // the datapath's series and ROM words
  Color output;   // the datapath's output
};

// Calls `visit` for every visible pixel of the model's frame, triangle by triangle from `first` to
// before `end`. `misplaced`: those of the frame.
void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model,
                            const std::vector<MisplacedPixel>& misplaced, std::uint32_t first,
                            std::uint32_t end, const std::function<void(const ErrorChain&)>& visit);
// The same for all triangles.
void for_each_visible_pixel(const FrameSetup& frame, const ModelFrame& model,
                            const std::function<void(const ErrorChain&)>& visit);

// The causes of a pixel's error, in the order of the chain.
struct ErrorPart {
  std::string_view name, meaning;
};
constexpr std::array<ErrorPart, 7> kErrorParts = {{
    {"visibility", "the frame shows another triangle than the nearest, by rounded depths"},
    {"normals", "interpolated over the piece that is shaded, not the whole triangle"},
    {"series", "second-degree polynomial in place of the exact reflection"},
    {"coefficient_rounding", "of the T_i and of the starts of spans"},
    {"table_address", "power of the x that the ROM's address stands for"},
    {"table_word", "rounding of the ROM's word"},
    {"output_rounding", "to 8 bits, and under depth cueing of its factor"},
}};

// The error of one pixel by channel, in LSB; channels that are not in use are 0. Colours along the
// chain are rounded to multiples of 2^-40 LSB. Their differences, and all sums of these, then have
// at most 53 bits: in double precision too the parts add up to output − exact, to the last bit.
struct ErrorSplit {
  Color output, exact;
  std::array<Color, kErrorParts.size()> parts;

  Color error() const { return output - exact; }
  // Place in `parts` of what has the largest size in some channel.
  std::size_t largest_part() const;
};
// Of covered pixel (x, y) of the model's frame. `misplaced`: the pixels of the frame.
ErrorSplit split_error(const PreparedFrame& frame, const ModelFrame& model,
                       const std::vector<MisplacedPixel>& misplaced, int x, int y);

}  // namespace phongpipe
