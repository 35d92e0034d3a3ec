#include "model/fixed/pixel_datapath.h"

#include "model/fixed/color_sum.h"
#include "model/fixed/depth_cue.h"
#include "model/fixed/pixel_lanes.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace phongpipe {
namespace {

#if defined(__x86_64__)
struct Avx2Gather {
  static inline __attribute__((target("avx2"))) void read(const std::int32_t* words,
                                                          const Lanes<std::int32_t, 8>& address,
                                                          Lanes<std::int32_t, 8>& result) {
    result = (Lanes<std::int32_t, 8>)_mm256_i32gather_epi32(words, (__m256i)address, 4);
  }
  static inline __attribute__((target("avx2"))) void read(const std::int32_t* words,
                                                          const Lanes<std::int64_t, 8>& address,
                                                          Lanes<std::int64_t, 8>& result) {
    LoopGather::read(words, address, result);
  }
};

template <typename Word, int kChannels, bool kSpecular, GateSource kGate>
__attribute__((target("avx2"))) void shade_avx2(const LaneInputs& inputs, const Span* spans,
                                                std::size_t count, std::uint32_t* colors) {
  shade_lanes<Word, 8, kChannels, kSpecular, kGate, Avx2Gather>(inputs, spans, count, colors);
}
#endif

// Four lanes of 32 bits are what a register of plain x86-64 holds.
template <typename Word, int kChannels, bool kSpecular, GateSource kGate>
void shade_portable(const LaneInputs& inputs, const Span* spans, std::size_t count,
                    std::uint32_t* colors) {
  shade_lanes<Word, 4, kChannels, kSpecular, kGate, LoopGather>(inputs, spans, count, colors);
}

using ShadeFunction = void (*)(const LaneInputs&, const Span*, std::size_t, std::uint32_t*);

template <typename Word, int kChannels, bool kSpecular, GateSource kGate>
ShadeFunction select_instructions(Evaluation evaluation) {
#if defined(__x86_64__)
  if (evaluation == Evaluation::avx2) return shade_avx2<Word, kChannels, kSpecular, kGate>;
#endif
  return shade_portable<Word, kChannels, kSpecular, kGate>;
}

template <typename Word, int kChannels>
ShadeFunction select_highlight(const DatapathConfiguration& configuration, Evaluation evaluation) {
  if (!configuration.specular) {
    return select_instructions<Word, kChannels, false, GateSource::off>(evaluation);
  }
  switch (configuration.gate) {
    case GateSource::off:
      return select_instructions<Word, kChannels, true, GateSource::off>(evaluation);
    case GateSource::series:
      return select_instructions<Word, kChannels, true, GateSource::series>(evaluation);
    case GateSource::diffuse:
      break;
  }
  return select_instructions<Word, kChannels, true, GateSource::diffuse>(evaluation);
}

ShadeFunction select_shade(const DatapathConfiguration& configuration, Evaluation evaluation) {
  const bool narrow = configuration.diffuse_width() <= 32 && configuration.specular_width() <= 32;
  if (configuration.channels == 1) {
    return narrow ? select_highlight<std::int32_t, 1>(configuration, evaluation)
                  : select_highlight<std::int64_t, 1>(configuration, evaluation);
  }
  return narrow ? select_highlight<std::int32_t, 3>(configuration, evaluation)
                : select_highlight<std::int64_t, 3>(configuration, evaluation);
}

}  // namespace

Evaluation best_evaluation() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) return Evaluation::avx2;
#endif
  return Evaluation::portable;
}

PixelDatapath::PixelDatapath(const DatapathConfiguration& configuration, Evaluation evaluation,
                             const OutputColor& cue_color)
    : configuration_(configuration),
      evaluation_(evaluation),
      cue_color_(cue_color),
      shade_lanes_(select_shade(configuration_, evaluation)) {
  configuration_.check();
}

void PixelDatapath::load_table(const HighlightTable& table) {
  for (std::size_t c = 0; c < table.roms.size(); ++c) {
    aligned_rom_[c] = table.roms[c].words();
    for (std::int32_t& word : aligned_rom_[c]) word = aligned_word(configuration_, word);
    rom_[c] = aligned_rom_[c].data();
  }
}

void PixelDatapath::shade(const Span* spans, std::size_t count, std::uint32_t* colors) const {
  if (evaluation_ != Evaluation::stepping) {
    shade_lanes_({&configuration_, cue_color_.data(), rom_.data()}, spans, count, colors);
    return;
  }
  for (const Span* span = spans; span != spans + count; ++span) {
    shade_stepping(*span, colors);
    colors += span->row.length;
  }
}

void PixelDatapath::shade_stepping(const Span& span, std::uint32_t* colors) const {
  const auto channels = static_cast<std::size_t>(configuration_.channels);
  const bool specular_on = configuration_.specular && span.highlight;
  const int diffuse_width = configuration_.diffuse_width();
  std::array<ForwardDifferencer, 3> diffuse = {ForwardDifferencer(diffuse_width),
                                               ForwardDifferencer(diffuse_width),
                                               ForwardDifferencer(diffuse_width)};
  ForwardDifferencer specular(configuration_.specular_width());
  ForwardDifferencer gate(diffuse_width);
  ForwardDifferencer cue(kCueWidth);
  for (std::size_t c = 0; c < channels; ++c) diffuse[c].load(span.diffuse[c]);
  specular.load(span.specular);
  gate.load(span.gate);
  cue.load(span.cue);

  for (int i = 0; i < span.row.length; ++i) {
    bool open = configuration_.gate == GateSource::off ||
                (configuration_.gate == GateSource::series && is_lit(gate.v(), 0));
    if (configuration_.gate == GateSource::diffuse) {
      for (std::size_t c = 0; c < channels; ++c) {
        open = open || is_lit(diffuse[c].v(), span.level[c]);
      }
    }
    const int address = ExponentRom::address(configuration_, specular.v());
    std::uint32_t color = 0;
    for (std::size_t c = 0; c < channels; ++c) {
      const std::int32_t clamped = clamped_diffuse(configuration_, diffuse[c].v(), span.level[c]);
      const std::int32_t word = specular_on && open ? rom_[c][address] : 0;
      const std::uint8_t output =
          configuration_.depth_cue
              ? depth_cue(light_sum(configuration_, clamped, word),
                          span.first_pass ? cue_color_[c] : 0, cue_factor(cue.v()))
              : color_sum(configuration_, clamped, word);
      color |= std::uint32_t{output} << (c * kOutputBits);
      diffuse[c].step();
    }
    specular.step();
    gate.step();
    cue.step();
    colors[i] = color;
  }
}

}  // namespace phongpipe
