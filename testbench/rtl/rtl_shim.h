// RtlInterface over a Verilated pixel_datapath. Compiled together with what Verilator generates.
#pragma once

#include "rtl_abi.h"

#include <verilated.h>
#ifdef PHONGPIPE_RTL_SIGNALS
#include <verilated_syms.h>
#endif

#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

#include "model/fixed/constants.h"

namespace {

using phongpipe::GateSource;
using phongpipe::kCueWidth;
using phongpipe::kDigitBits;
using phongpipe::kOutputBits;

// The low `width` bits of each value side by side, the first in the low bits, into a port of
// whatever type Verilator chose for it.
template <typename Port, typename Value>
void pack(Port& port, const Value* values, int count, int width) {
  const std::uint64_t mask = ~std::uint64_t{0} >> (64 - width);
  if constexpr (std::is_integral_v<Port>) {
    std::uint64_t packed = 0;
    for (int i = 0; i < count; ++i) {
      packed |= (static_cast<std::uint64_t>(values[i]) & mask) << (i * width);
    }
    port = static_cast<Port>(packed);
  } else {  // words of 32 bits
    for (int word = 0; word < static_cast<int>(sizeof(port) / sizeof(EData)); ++word)
      port[word] = 0;
    for (int i = 0; i < count; ++i) {
      std::uint64_t value = static_cast<std::uint64_t>(values[i]) & mask;
      for (int bit = i * width; value != 0;) {
        port[bit / 32] |= static_cast<EData>(value << (bit % 32));
        const int stored = 32 - bit % 32;
        value >>= stored;
        bit += stored;
      }
    }
  }
}

// Whether a Verilated module reads the words of a span digit by digit, as pixel_datapath_serial.
template <typename Top, typename = void>
constexpr bool kReadsDigits = false;
template <typename Top>
constexpr bool kReadsDigits<Top, std::void_t<decltype(std::declval<Top&>().span_digit)>> = true;

// Pixels side by side that a datapath delivers.
template <typename Parameters, typename = void>
constexpr int kLanes = 1;
template <typename Parameters>
constexpr int kLanes<Parameters, std::void_t<decltype(Parameters::LANES)>> = Parameters::LANES;

// `Top`: the Verilated module. `Parameters`: a struct with its parameters as constants of the same
// names.
template <typename Top, typename Parameters>
class Rtl {
  static constexpr int kChannels = Parameters::CHANNELS;
  static constexpr int kDiffuseWidth = phongpipe::diffuse_width(Parameters::DIFFUSE_FRACTION);
  static constexpr int kSpecularWidth = phongpipe::specular_width(
      Parameters::SPECULAR_GUARD, Parameters::ROM_ADDRESS_BITS, Parameters::SPECULAR_FRACTION);
  static constexpr int kRomDataBits = Parameters::ROM_DATA_BITS;

 public:
  Rtl() : top_(&context_) {
    top_.clk = 0;
    top_.reset = 1;
    top_.span_valid = 0;
    top_.rom_write = 0;
    top_.pixel_ready = 0;
    top_.eval();  // an edge is one only from a low clock that was seen
    edge();
    top_.reset = 0;
  }
  ~Rtl() { top_.final(); }

  void clock(RtlPorts& ports) {
    top_.reset = ports.reset;
    top_.pixel_ready = ports.pixel_ready;
    top_.rom_write = ports.rom_write;
    if (ports.rom_write) {
      top_.rom_address = static_cast<decltype(+top_.rom_address)>(ports.rom_address);
      pack(top_.rom_data, ports.rom_data, kChannels, kRomDataBits);
    }
    pack(top_.cue_color, ports.cue_color, kChannels, kOutputBits);
    top_.span_valid = ports.span != nullptr;
    if (ports.span != presented_) present(ports.span);
    if constexpr (kReadsDigits<Top>) answer_digit();
    top_.clk = 0;
    top_.eval();
    ports.span_ready = top_.span_ready;
    ports.pixel_valid = top_.pixel_valid & 1;
    if (ports.pixel_valid) {
      ports.pixel_x = top_.pixel_x;
      ports.pixel_y = top_.pixel_y;
      ports.pixels = 0;
      for (int k = 0; k < kLanes<Parameters>; ++k) {
        ports.pixel_color[k] = color_of_lane(k);
        // A hole between valid pixels is taken for one more, so that it is found.
        if ((top_.pixel_valid >> k & 1) != 0) ports.pixels = static_cast<std::uint8_t>(k + 1);
      }
    }
    if (top_.span_ready) presented_ = nullptr;  // the next span may stand at the same address
    if constexpr (kReadsDigits<Top>) {
      if (top_.span_ready && ports.span != nullptr) taken_ = *ports.span;
      series_ = top_.span_series;
      digit_ = top_.span_digit;
    }
    if (ports.before_edge != nullptr) ports.before_edge(ports.user);
    edge();
  }

  std::uint64_t run(const std::uint8_t* cue_color, const RtlSpan* spans, std::size_t count,
                    RtlPixel* pixels) {
    std::uint64_t left = 0;
    for (std::size_t i = 0; i < count; ++i) left += static_cast<std::uint64_t>(spans[i].length);
    const RtlSpan* const end = spans + count;
    RtlPorts ports = {};
    ports.pixel_ready = 1;
    for (int c = 0; c < kChannels; ++c) ports.cue_color[c] = cue_color[c];
    std::uint64_t clocks = 0, idle = 0;
    // A datapath that loses pixels must not keep us forever.
    for (constexpr std::uint64_t kPatience = 1000; left > 0 && idle < kPatience; ++clocks) {
      ports.span = spans != end ? spans : nullptr;
      clock(ports);
      if (ports.span != nullptr && ports.span_ready) ++spans;
      ++idle;
      if (ports.pixel_valid) {
        idle = 0;
        for (int k = 0; k < ports.pixels && left > 0; ++k, --left) {
          *pixels++ = {static_cast<std::uint16_t>(ports.pixel_x + k), ports.pixel_y,
                       ports.pixel_color[k]};
        }
      }
    }
    return clocks;
  }

#ifdef PHONGPIPE_RTL_SIGNALS
  void visit_signals(void (*visit)(void* user, const RtlSignal* signal), void* user) {
    for (const auto& [full_name, scope] : *context_.scopeNameMap()) {
      const char* const below_top = std::strstr(full_name, "pixel_datapath");
      if (below_top == nullptr || scope->varsp() == nullptr) continue;
      // The top module's name is left out, for it tells the kind of the datapath.
      const char* const inside = std::strchr(below_top, '.');
      const std::string name =
          with_brackets(std::string("pixel_datapath") + (inside != nullptr ? inside : ""));
      for (const auto& [variable_name, variable] : *scope->varsp()) {
        if (variable.isParam()) continue;
        RtlSignal signal = {};
        signal.scope = name.c_str();
        signal.name = variable_name;
        signal.data = variable.datap();
        signal.width = variable.dims() > variable.udims() ? variable.packed().elements() : 1;
        signal.bytes = variable.entSize();
        signal.elements = variable.udims() > 0 ? variable.unpacked().elements() : 1;
        visit(user, &signal);
      }
    }
  }
#endif

 private:
#ifdef PHONGPIPE_RTL_SIGNALS
  // Verilator writes the brackets of a generate block's index in letters.
  static std::string with_brackets(std::string name) {
    const std::pair<const char*, const char*> spellings[] = {{"__BRA__", "["}, {"__KET__", "]"}};
    for (const auto& [letters, bracket] : spellings) {
      for (std::size_t at = 0; (at = name.find(letters)) != std::string::npos;) {
        name.replace(at, std::strlen(letters), bracket);
      }
    }
    return name;
  }
#endif
  std::uint32_t color_of_lane(int lane) const {
    constexpr int kBits = kChannels * kOutputBits;
    if constexpr (std::is_integral_v<std::remove_reference_t<decltype(top_.pixel_color)>>) {
      constexpr std::uint64_t kMask = (std::uint64_t{1} << kBits) - 1;
      return static_cast<std::uint32_t>(std::uint64_t{top_.pixel_color} >> (lane * kBits) & kMask);
    } else {  // words of 32 bits; a channel is in one of them
      std::uint32_t color = 0;
      for (int bit = 0; bit < kBits; bit += kOutputBits) {
        const int at = lane * kBits + bit;
        const std::uint32_t channel =
            top_.pixel_color[at / 32] >> (at % 32) & ((1 << kOutputBits) - 1);
        color |= channel << bit;
      }
      return color;
    }
  }
  void edge() {
    top_.clk = 1;
    top_.eval();
  }

  void present(const RtlSpan* span) {
    presented_ = span;
    if (span == nullptr) return;
    top_.span_x = static_cast<SData>(span->x);
    top_.span_y = static_cast<SData>(span->y);
    top_.span_length = static_cast<SData>(span->length);
    top_.span_first_pass = span->first_pass;
    top_.span_step_diffuse = span->step_diffuse;
    top_.span_step_specular = span->step_specular;
    top_.span_highlight = span->highlight;
    if constexpr (!kReadsDigits<Top>) present_words(span);
  }

  void present_words(const RtlSpan* span) {
    std::int64_t v[3], d1[3], d2[3];
    for (int c = 0; c < kChannels; ++c) {
      v[c] = span->diffuse[c].v;
      d1[c] = span->diffuse[c].d1;
      d2[c] = span->diffuse[c].d2;
    }
    pack(top_.span_diffuse_v, v, kChannels, kDiffuseWidth);
    pack(top_.span_diffuse_d1, d1, kChannels, kDiffuseWidth);
    pack(top_.span_diffuse_d2, d2, kChannels, kDiffuseWidth);
    pack(top_.span_level, span->level, kChannels, kDiffuseWidth);
    pack(top_.span_specular_v, &span->specular.v, 1, kSpecularWidth);
    pack(top_.span_specular_d1, &span->specular.d1, 1, kSpecularWidth);
    pack(top_.span_specular_d2, &span->specular.d2, 1, kSpecularWidth);
    pack(top_.span_gate_v, &span->gate.v, 1, kDiffuseWidth);
    pack(top_.span_gate_d1, &span->gate.d1, 1, kDiffuseWidth);
    pack(top_.span_gate_d2, &span->gate.d2, 1, kDiffuseWidth);
    pack(top_.span_cue_v, &span->cue.v, 1, kCueWidth);
    pack(top_.span_cue_d1, &span->cue.d1, 1, kCueWidth);
  }

  // The digits that the module asked for in the clock before.
  void answer_digit() {
    const RtlSeries* series[6] = {};
    int count = 0;
    if (Parameters::SPECULAR) series[count++] = &taken_.specular;
    if (Parameters::SPECULAR && Parameters::GATE == static_cast<int>(GateSource::series))
      series[count++] = &taken_.gate;
    if (Parameters::DEPTH_CUE) series[count++] = &taken_.cue;
    const int first_diffuse = count;
    for (int c = 0; c < kChannels; ++c) series[count++] = &taken_.diffuse[c];
    if (series_ >= count) return;
    const auto digit = [this](std::int64_t word) {
      return static_cast<CData>(word >> (digit_ * kDigitBits) & ((1 << kDigitBits) - 1));
    };
    top_.span_v = digit(series[series_]->v);
    top_.span_d1 = digit(series[series_]->d1);
    top_.span_d2 = digit(series[series_]->d2);
    if (series_ >= first_diffuse) top_.span_level = digit(taken_.level[series_ - first_diffuse]);
  }

  VerilatedContext context_;
  Top top_;
  const RtlSpan* presented_ = nullptr;
  // Of a module that reads digits: the span that was taken last, and the place it asked for.
  RtlSpan taken_ = {};
  int series_ = 0, digit_ = 0;
};

template <typename Top, typename Parameters>
const RtlInterface kRtlInterface = {
    []() -> void* { return new Rtl<Top, Parameters>; },
    [](void* rtl) { delete static_cast<Rtl<Top, Parameters>*>(rtl); },
    [](void* rtl, RtlPorts* ports) { static_cast<Rtl<Top, Parameters>*>(rtl)->clock(*ports); },
    [](void* rtl, const std::uint8_t* cue_color, const RtlSpan* spans, std::size_t count,
       RtlPixel* pixels) {
      return static_cast<Rtl<Top, Parameters>*>(rtl)->run(cue_color, spans, count, pixels);
    },
#ifdef PHONGPIPE_RTL_SIGNALS
    [](void* rtl, void (*visit)(void* user, const RtlSignal* signal), void* user) {
      static_cast<Rtl<Top, Parameters>*>(rtl)->visit_signals(visit, user);
    }
#else
    nullptr
#endif
};

}  // namespace
