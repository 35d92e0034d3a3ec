#include "sim/datapath_registers.h"

#include <fmt/format.h>

#include <cmath>

#include "model/fixed/color_sum.h"
#include "model/fixed/depth_cue.h"

namespace phongpipe {

DatapathRegisters::DatapathRegisters(const DatapathConfiguration& configuration,
                                     const OutputColor& cue_color)
    : configuration_(configuration), cue_color_(cue_color) {
  const ForwardDifferencer diffuse(configuration.diffuse_width());
  step_.diffuse = {diffuse, diffuse, diffuse};
  step_.specular = ForwardDifferencer(configuration.specular_width());
  step_.gate = diffuse;
  step_.cue = ForwardDifferencer(kCueWidth);
  if (!configuration.specular) return;
  for (std::size_t c = 0; c < channels(); ++c) {
    table_[c].resize(static_cast<std::size_t>(configuration.rom_words()));
  }
}

void DatapathRegisters::reset() {
  advance(ready(false));  // as the clock of the reset does
  step_.valid = compare_.valid = read_.valid = add_.valid = fade_.valid = false;
}

bool DatapathRegisters::valid(DatapathStage stage) const {
  const bool all[] = {step_.valid, compare_.valid, read_.valid, add_.valid, fade_.valid};
  return all[static_cast<std::size_t>(stage)];
}

DatapathRegisters::Ready DatapathRegisters::ready(bool pixel_ready) const {
  Ready ready{};
  ready.fade = !fade_.valid || pixel_ready;
  ready.add = !add_.valid || (configuration_.depth_cue ? ready.fade : pixel_ready);
  ready.read = !read_.valid || ready.add;
  ready.compare = !compare_.valid || ready.read;
  return ready;
}

std::uint32_t DatapathRegisters::color(std::size_t channel) const {
  if (configuration_.depth_cue) return fade_.color[channel];
  return static_cast<std::uint32_t>(std::min(add_.sum[channel], kOutputMax));
}

DatapathOutputs DatapathRegisters::outputs(const DatapathInputs& inputs) const {
  DatapathOutputs outputs;
  outputs.span_ready = !step_.valid || (ready(inputs.pixel_ready).compare && step_.remaining == 1);
  const StageRegisters& last =
      configuration_.depth_cue ? static_cast<const StageRegisters&>(fade_) : add_;
  outputs.pixel_valid = last.valid;
  outputs.pixel = {last.x, last.y, 0};
  for (std::size_t c = 0; c < channels(); ++c) {
    outputs.pixel.color |= color(c) << (c * kOutputBits);
  }
  return outputs;
}

// Without its diffuse series a channel's light is the level.
std::int64_t DatapathRegisters::diffuse_value(std::size_t channel) const {
  return configuration_.diffuse ? step_.diffuse[channel].v() : step_.level[channel];
}

// One clock of all registers, from the last stage to the first, for each takes what the one before
// it held.
void DatapathRegisters::advance(const Ready& ready) {
  const auto follow = [](StageRegisters& stage, const StageRegisters& before) { stage = before; };
  if (configuration_.depth_cue && ready.fade) {
    fade_.valid = add_.valid;
    fade_.x = add_.x;
    fade_.y = add_.y;
    for (std::size_t c = 0; c < channels(); ++c) {
      fade_.color[c] = depth_cue(add_.sum[c], add_.first_pass ? cue_color_[c] : 0, add_.cue_factor);
    }
  }
  if (ready.add) {
    follow(add_, read_);
    for (std::size_t c = 0; c < channels(); ++c) {
      const std::int32_t mask = (1 << configuration_.rom_data_bits) - 1;
      const std::int32_t word =
          read_.open ? aligned_word(configuration_, (read_.word[c] + read_.increment[c]) & mask)
                     : std::int32_t{0};
      add_.sum[c] = light_sum(configuration_, read_.clamped[c], word);
    }
  }
  if (ready.read) {
    follow(read_, compare_);
    bool open = configuration_.gate == GateSource::off || compare_.open;
    if (configuration_.gate == GateSource::diffuse) {
      for (std::size_t c = 0; c < channels(); ++c) open = open || compare_.lit[c];
    }
    read_.open = configuration_.specular && open && compare_.highlight;
    for (std::size_t c = 0; c < channels(); ++c) {
      if (configuration_.specular) {
        const RomPlaces places = ExponentRom::places(configuration_, compare_.address);
        read_.word[c] = table_[c][places.base];
        if (places.increment) read_.increment[c] = table_[c][*places.increment];
      }
      read_.clamped[c] = compare_.lit[c] ? compare_.diffuse_cut[c] : compare_.level_cut[c];
    }
  }
  if (!ready.compare) return;
  compare_.valid = step_.valid;
  compare_.x = step_.x;
  compare_.y = step_.y;
  compare_.first_pass = step_.first_pass;
  compare_.cue_factor = cue_factor(step_.cue.v());
  for (std::size_t c = 0; c < channels(); ++c) {
    const std::int64_t diffuse = diffuse_value(c), level = step_.level[c];
    compare_.lit[c] = is_lit(diffuse, level);
    // What color_sum keeps of a value that is not below the level.
    const auto cut = [this](std::int64_t value) {
      constexpr std::int32_t kIntegerMask = (1 << (kGuardBits + kOutputBits)) - 1;
      const std::int32_t mask = (kIntegerMask + 1) * (1 << configuration_.sum_fraction_bits()) - 1;
      return clamped_diffuse(configuration_, value, value) & mask;
    };
    compare_.diffuse_cut[c] = cut(diffuse);
    compare_.level_cut[c] = cut(level);
  }
  if (configuration_.specular) {
    compare_.address = ExponentRom::address(configuration_, step_.specular.v());
    compare_.highlight = step_.highlight;
  }
  if (configuration_.has_gate_series()) compare_.open = is_lit(step_.gate.v(), 0);
}

void DatapathRegisters::load(const Span& span) {
  step_.x = static_cast<std::uint16_t>(span.row.x);
  step_.y = static_cast<std::uint16_t>(span.row.y);
  step_.remaining = span.row.length;
  step_.step_diffuse = span.step_diffuse;
  step_.step_specular = span.step_specular;
  step_.highlight = span.highlight;
  step_.first_pass = span.first_pass;
  for (std::size_t c = 0; c < channels(); ++c) {
    step_.level[c] = wrap_to(span.level[c], configuration_.diffuse_width());
    step_.diffuse[c].load(span.diffuse[c]);
  }
  step_.specular.load(span.specular);
  step_.gate.load(span.gate);
  step_.cue.load({span.cue.v, span.cue.d1, 0});
}

DatapathOutputs DatapathRegisters::clock(const DatapathInputs& inputs) {
  const DatapathOutputs before = outputs(inputs);
  const Ready taken = ready(inputs.pixel_ready);
  const bool stepped = step_.valid && taken.compare,
             loaded = inputs.span != nullptr && before.span_ready;
  advance(taken);
  if (inputs.table != nullptr && configuration_.specular) {
    for (std::size_t c = 0; c < inputs.table->roms.size(); ++c) {
      const auto address = static_cast<std::size_t>(inputs.rom_address);
      table_[c][address] = inputs.table->roms[c].contents()[address];
    }
  }
  if (loaded) {
    load(*inputs.span);
    step_.valid = true;
  } else if (stepped) {
    step_.valid = step_.remaining != 1;
    ++step_.x;
    --step_.remaining;
    for (std::size_t c = 0; c < channels(); ++c) {
      if (step_.step_diffuse) step_.diffuse[c].step();
    }
    if (step_.step_specular) step_.specular.step();
    if (step_.step_diffuse) step_.gate.step();
    step_.cue.step();
  }
  return before;
}

std::string DatapathSignal::block() const {
  return scope.empty() ? "pixel_datapath" : "pixel_datapath." + scope;
}

double DatapathSignal::real(std::int64_t bits) const {
  return std::ldexp(static_cast<double>(bits), -fraction_bits);
}

namespace {

using Registers = DatapathRegisters;

class SignalTable {
 public:
  explicit SignalTable(const DatapathConfiguration& configuration)
      : configuration_(configuration) {}

  std::vector<DatapathSignal> all() {
    add_step();
    add_compare();
    add_read();
    add_add();
    if (configuration_.depth_cue) add_fade();
    return std::move(signals_);
  }

 private:
  template <typename Value>
  DatapathSignal& add(DatapathStage stage, const std::string& scope, const std::string& name,
                      int width, Value value) {
    DatapathSignal signal;
    signal.scope = scope;
    signal.name = name;
    signal.stage = stage;
    signal.width = width;
    signal.value = [value](const Registers& r) { return static_cast<std::int64_t>(value(r)); };
    return signals_.emplace_back(std::move(signal));
  }
  static void in_units(DatapathSignal& signal, const char* unit, int fraction_bits,
                       bool is_signed) {
    signal.unit = unit;
    signal.fraction_bits = fraction_bits;
    signal.is_signed = is_signed;
  }
  template <typename Of>
  void add_place(DatapathStage stage, const std::string& scope, const std::string& prefix, Of of) {
    add(stage, scope, prefix + "_valid", 1, [of](const Registers& r) { return of(r).valid; });
    add(stage, scope, prefix + "_x", kCoordinateBits, [of](const Registers& r) { return of(r).x; });
    add(stage, scope, prefix + "_y", kCoordinateBits, [of](const Registers& r) { return of(r).y; });
  }
  template <typename Of>
  void add_cue(DatapathStage stage, const std::string& prefix, Of of) {
    if (!configuration_.depth_cue) return;
    add(stage, "cueing", prefix + "_factor", kCueFactorBits + 1, [of](const Registers& r) {
      return of(r).cue_factor;
    }).fraction_bits = kCueFactorBits;
    add(stage, "cueing", prefix + "_first_pass", 1,
        [of](const Registers& r) { return of(r).first_pass; });
  }
  template <typename Of>
  void add_series(const std::string& scope, const char* unit, int width, int fraction_bits, Of of) {
    const auto part = [&](const char* name, auto value) {
      in_units(add(DatapathStage::step, scope, name, width, value), unit, fraction_bits, true);
    };
    part("v", [of](const Registers& r) { return of(r).v(); });
    part("d1", [of](const Registers& r) { return of(r).d1(); });
    part("d2", [of](const Registers& r) { return of(r).d2(); });
  }
  static std::string channel_scope(int channel) { return fmt::format("channel[{}]", channel); }
  template <typename Add>
  void for_channels(Add add_channel) {
    for (int c = 0; c < configuration_.channels; ++c) {
      add_channel(channel_scope(c), static_cast<std::size_t>(c));
    }
  }

  void add_step() {
    constexpr auto kStage = DatapathStage::step;
    const DatapathConfiguration& f = configuration_;
    add_place(
        kStage, "", "fd", [](const Registers& r) -> const auto& { return r.step(); });
    add(kStage, "", "fd_remaining", kLengthBits,
        [](const Registers& r) { return r.step().remaining; });
    add(kStage, "", "fd_step_diffuse", 1, [](const Registers& r) { return r.step().step_diffuse; });
    add(kStage, "", "fd_step_specular", 1,
        [](const Registers& r) { return r.step().step_specular; });
    add(kStage, "", "fd_highlight", 1, [](const Registers& r) { return r.step().highlight; });
    for_channels([&](const std::string& scope, std::size_t c) {
      DatapathSignal& level = add(kStage, scope, "fd_level", f.diffuse_width(),
                                  [c](const Registers& r) { return r.step().level[c]; });
      in_units(level, "LSB", f.diffuse_fraction_bits, true);
      level.packed = level.name;
      level.rtl_lsb = static_cast<int>(c) * f.diffuse_width();
    });
    if (f.diffuse) {
      for_channels([&](const std::string& scope, std::size_t c) {
        add_series(
            scope + ".diffuse.diffuse_series", "LSB", f.diffuse_width(),
            f.diffuse_fraction_bits, [c](const Registers& r) -> const auto& {
              return r.step().diffuse[c];
            });
      });
    }
    if (f.specular) {
      add_series(
          "specular.specular_series", "address", f.specular_width(), f.specular_fraction_bits,
          [](const Registers& r) -> const auto& { return r.step().specular; });
    }
    if (f.has_gate_series()) {
      add_series(
          "specular.gate.gate_series", "LSB", f.diffuse_width(), f.diffuse_fraction_bits,
          [](const Registers& r) -> const auto& { return r.step().gate; });
    }
    if (f.depth_cue) {
      add_series(
          "cueing.cue_series", "", kCueWidth, kCueFraction,
          [](const Registers& r) -> const auto& { return r.step().cue; });
      add(kStage, "cueing", "fd_first_pass", 1,
          [](const Registers& r) { return r.step().first_pass; });
    }
  }

  void add_compare() {
    constexpr auto kStage = DatapathStage::compare;
    const auto of = [](const Registers& r) -> const auto& {
      return r.compare();
    };
    add_place(kStage, "", "s1", of);
    for_channels([&](const std::string& channel, std::size_t c) {
      const std::string scope = channel + ".summation";
      add(kStage, scope, "lit", 1, [c](const Registers& r) { return r.compare().lit[c]; });
      add_cut(kStage, scope, "diffuse_cut",
              [c](const Registers& r) { return r.compare().diffuse_cut[c]; });
      add_cut(kStage, scope, "level_cut",
              [c](const Registers& r) { return r.compare().level_cut[c]; });
    });
    if (configuration_.specular) {
      add(kStage, "specular.rom", "address", configuration_.rom_address_bits,
          [](const Registers& r) { return r.compare().address; })
          .unit = "address";
      add(kStage, "specular", "s1_highlight", 1,
          [](const Registers& r) { return r.compare().highlight; });
      if (configuration_.has_gate_series()) {
        add(kStage, "specular", "s1_open", 1, [](const Registers& r) { return r.compare().open; });
      }
    }
    add_cue(kStage, "s1", of);
  }

  template <typename Value>
  void add_cut(DatapathStage stage, const std::string& scope, const char* name, Value value) {
    const int fraction = configuration_.sum_fraction_bits();
    in_units(add(stage, scope, name, kGuardBits + kOutputBits + fraction, value), "LSB", fraction,
             false);
  }

  template <typename Of>
  void add_words(const std::string& name, Of of) {
    const int bits = configuration_.rom_data_bits;
    for_channels([&](const std::string& channel, std::size_t c) {
      DatapathSignal& word = add(DatapathStage::read, channel, name, bits,
                                 [of, c](const Registers& r) { return of(r)[c]; });
      in_units(word, "LSB", bits - kOutputBits, false);
      word.packed = name + "s";
      word.rtl_lsb = static_cast<int>(c) * bits;
    });
  }

  void add_read() {
    constexpr auto kStage = DatapathStage::read;
    const auto of = [](const Registers& r) -> const auto& {
      return r.read();
    };
    add_place(kStage, "", "s2", of);
    if (configuration_.specular) {
      add_words(
          "s2_word", [](const Registers& r) -> const auto& { return r.read().word; });
      if (configuration_.rom_layout == RomLayout::bipartite) {
        add_words(
            "s2_increment", [](const Registers& r) -> const auto& { return r.read().increment; });
      }
      add(kStage, "", "s2_open", 1, [](const Registers& r) { return r.read().open; });
    }
    for_channels([&](const std::string& channel, std::size_t c) {
      add_cut(kStage, channel + ".summation", "clamped",
              [c](const Registers& r) { return r.read().clamped[c]; });
    });
    add_cue(kStage, "s2", of);
  }

  void add_add() {
    constexpr auto kStage = DatapathStage::add;
    const auto of = [](const Registers& r) -> const auto& {
      return r.add();
    };
    add_place(kStage, "", "s3", of);
    for_channels([&](const std::string& channel, std::size_t c) {
      add(kStage, channel + ".summation", "sum", kGuardBits + kOutputBits + 1,
          [c](const Registers& r) { return r.add().sum[c]; })
          .unit = "LSB";
    });
    add_cue(kStage, "s3", of);
  }

  void add_fade() {
    constexpr auto kStage = DatapathStage::fade;
    add_place(
        kStage, "cueing", "s4", [](const Registers& r) -> const auto& { return r.fade(); });
    for_channels([&](const std::string& channel, std::size_t c) {
      add(kStage, "cueing." + channel + ".multiplier", "color", kOutputBits,
          [c](const Registers& r) { return r.fade().color[c]; })
          .unit = "LSB";
    });
  }

  const DatapathConfiguration& configuration_;
  std::vector<DatapathSignal> signals_;
};

}  // namespace

std::vector<DatapathSignal> datapath_signals(const DatapathConfiguration& configuration) {
  return SignalTable(configuration).all();
}

}  // namespace phongpipe
