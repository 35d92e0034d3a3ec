// Interface of Verilated pixel_datapaths, built as a shared library, to the program that loads
// them.
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

struct RtlSeries {
  std::int64_t v, d1, d2;
};

struct RtlSpan {
  std::int32_t x, y, length;
  RtlSeries diffuse[3];
  RtlSeries specular;
  RtlSeries gate;
  RtlSeries cue;  // without d2
  std::int64_t level[3];
  std::uint8_t first_pass, step_diffuse, step_specular, highlight;
};

// The ports in one clock. Outputs are as they stand before the clock edge.
struct RtlPorts {
  const RtlSpan* span;  // span_valid if not null; must not change until span_ready
  std::uint8_t reset, pixel_ready, rom_write;
  std::uint16_t rom_address;
  std::uint16_t rom_data[3];
  std::uint8_t cue_color[3];
  // Called, if not null, when all values of the clock are settled, before its edge.
  void (*before_edge)(void* user);
  void* user;

  std::uint8_t span_ready, pixel_valid;
  std::uint16_t pixel_x, pixel_y;  // of the first of the pixels side by side
  std::uint8_t pixels;             // that are valid: of a wide datapath, 1 to 4
  std::uint32_t pixel_color[4];
};

struct RtlPixel {
  std::uint16_t x, y;
  std::uint32_t color;
};

// A signal inside the RTL, or a register array, for as long as the instance lives.
struct RtlSignal {
  const char* scope;  // "pixel_datapath.color.specular.rom"
  const char* name;
  void* data;           // of its first element; little-endian, bits above `width` are 0
  std::uint32_t width;  // bits of an element
  std::uint32_t bytes;  // from one element to the next
  std::uint32_t elements;
};

struct RtlInterface {
  void* (*create)();
  void (*destroy)(void* rtl);
  void (*clock)(void* rtl, RtlPorts* ports);
  // Runs spans back to back with the output always ready; returns the clocks until the last pixel
  // has left. `pixels` must have room for all of them.
  std::uint64_t (*run)(void* rtl, const std::uint8_t* cue_color, const RtlSpan* spans,
                       std::size_t count, RtlPixel* pixels);
  // Calls `visit` for every signal; null in libraries that were not built with signals. A written
  // value holds until the RTL writes it again.
  void (*visit_signals)(void* rtl, void (*visit)(void* user, const RtlSignal* signal), void* user);
};

// The interface of the variant with these parameters, written as rtl_parameters_text() has them;
// null if the library does not contain it.
const RtlInterface* phongpipe_rtl_interface(const char* parameters);
}
