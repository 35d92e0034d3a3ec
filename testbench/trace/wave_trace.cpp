#include "testbench/trace/wave_trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <set>

#include "sim/pipeline.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/rtl/rtl_signals.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {

namespace {

constexpr const char* kRoot = "phongpipe";

std::string bits_text(std::int64_t value, int width) {
  std::string text(static_cast<std::size_t>(width), '0');
  for (int bit = 0; bit < width; ++bit) {
    if ((static_cast<std::uint64_t>(value) >> bit & 1) != 0) {
      text[static_cast<std::size_t>(width - 1 - bit)] = '1';
    }
  }
  return text;
}

// A variable with what gives its value in a clock.
struct Probe {
  WaveVariable variable;
  std::function<std::string()> bits;
  std::function<double()> real;  // if the variable is real
  bool after = false;            // known once all modules have done the clock
};

// Both implementations of pixel_datapath in one clock, as they are before its edge.
struct Clock {
  std::int64_t cycle = 0;
  DatapathInputs inputs;
  DatapathOutputs outputs;  // of SystemC
};

// Everything that a trace shows, from the table of signals and from the RTL itself.
class Probes {
 public:
  Probes(const DatapathConfiguration& configuration, const DatapathRegisters& systemc,
         const RtlDatapath& rtl, const Clock& clock, const ActivityRecorder& activity)
      : configuration_(configuration),
        systemc_(systemc),
        clock_(clock),
        activity_(activity),
        inside_(rtl) {
    add_word(kRoot, "cycle", 32, 0, [this] { return clock_.cycle; });
    add_registers();
    add_rtl();
    add_systemc_ports();
    add_pipeline();
    std::stable_sort(probes_.begin(), probes_.end(), [](const Probe& a, const Probe& b) {
      return a.variable.scope < b.variable.scope;
    });
  }

  const std::vector<Probe>& all() const { return probes_; }

 private:
  static std::string side(const char* name, const std::string& block) {
    return fmt::format("{}.{}.{}", kRoot, name, block);
  }
  void add_word(const std::string& scope, const std::string& name, int width, int fraction_bits,
                std::function<std::int64_t()> value) {
    Probe probe;
    probe.variable = {scope, name, width, fraction_bits};
    probe.bits = [width, value = std::move(value)] { return bits_text(value(), width); };
    probes_.push_back(std::move(probe));
  }
  void add_register(const char* name, const DatapathSignal& signal,
                    const std::function<std::int64_t()>& value) {
    add_word(side(name, signal.block()), signal.name, signal.width, signal.fraction_bits, value);
    probes_.back().variable.is_signed = signal.is_signed;
    if (signal.unit.empty() && signal.fraction_bits == 0) return;
    Probe probe;
    probe.variable = {fmt::format("{}.lsb.{}.{}", kRoot, name, signal.block()), signal.name};
    probe.variable.real = true;
    probe.real = [signal, value] { return signal.real(value()); };
    probes_.push_back(std::move(probe));
  }

  void add_registers() {
    for (const DatapathSignal& signal : datapath_signals(configuration_)) {
      add_register("systemc", signal, [this, signal] { return signal.value(systemc_); });
      const auto rtl = RtlRegister::find(inside_, signal);
      if (!rtl) continue;
      add_register("rtl", signal, [rtl = *rtl] { return rtl.value(); });
      if (signal.packed.empty()) known_.insert(rtl->view().scope + "." + rtl->view().name);
    }
  }

  // All other signals of the RTL, as plain words.
  void add_rtl() {
    for (const RtlSignalView& signal : inside_.all()) {
      const bool is_array = signal.elements > 1, is_clock = signal.name == "clk";
      const bool unused = signal.name.rfind("unused", 0) == 0;
      if (is_array || is_clock || unused) continue;
      if (known_.count(signal.scope + "." + signal.name) != 0) continue;
      Probe probe;
      probe.variable = {fmt::format("{}.rtl.{}", kRoot, signal.scope), signal.name, signal.width};
      probe.bits = [&signal] { return signal.text(); };
      probes_.push_back(std::move(probe));
    }
  }

  void add_systemc_ports() {
    const std::string scope = side("systemc", "pixel_datapath");
    const auto span = [this](auto value) {
      return [this, value]() -> std::int64_t {
        return clock_.inputs.span == nullptr ? 0 : value(*clock_.inputs.span);
      };
    };
    add_word(scope, "span_valid", 1, 0, [this] { return clock_.inputs.span != nullptr; });
    add_word(scope, "span_ready", 1, 0, [this] { return clock_.outputs.span_ready; });
    add_word(scope, "span_x", kCoordinateBits, 0, span([](const Span& s) { return s.row.x; }));
    add_word(scope, "span_y", kCoordinateBits, 0, span([](const Span& s) { return s.row.y; }));
    add_word(scope, "span_length", kLengthBits, 0,
             span([](const Span& s) { return s.row.length; }));
    add_word(scope, "rom_write", 1, 0, [this] { return clock_.inputs.table != nullptr; });
    add_word(scope, "rom_address", configuration_.rom_address_bits, 0,
             [this] { return clock_.inputs.rom_address; });
    const int lanes = configuration_.lanes();
    add_word(scope, "pixel_valid", lanes, 0, [this] { return clock_.outputs.valid_bits(); });
    add_word(scope, "pixel_ready", 1, 0, [this] { return clock_.inputs.pixel_ready; });
    add_word(scope, "pixel_x", kCoordinateBits, 0, [this] { return clock_.outputs.pixel.x; });
    add_word(scope, "pixel_y", kCoordinateBits, 0, [this] { return clock_.outputs.pixel.y; });
    const int color_bits = configuration_.channels * kOutputBits;
    if (lanes == 1) {
      add_word(scope, "pixel_color", color_bits, 0, [this] { return clock_.outputs.pixel.color; });
      return;
    }
    for (int k = 0; k < lanes; ++k) {
      const DatapathRegisters& lane = systemc_.lane(static_cast<std::size_t>(k));
      const std::string own = fmt::format("{}.{}", scope, lane_scope(k));
      add_word(own, "pixel_valid", 1, 0, [&lane] { return lane.outputs().pixel_valid; });
      add_word(own, "pixel_color", color_bits, 0, [&lane] { return lane.outputs().pixel.color; });
    }
  }

  void add_pipeline() {
    for (const Module module : kModules) {
      const auto add = [&](const char* name, int width, auto value) {
        add_word(fmt::format("{}.systemc.{}", kRoot, phongpipe::name(module)), name, width, 0,
                 [this, module, value] {
                   return static_cast<std::int64_t>(value(activity_.now(module)));
                 });
        probes_.back().after = true;
      };
      const auto in = [](ModuleState state) {
        return [state](const ModuleNow& now) { return now.state == state; };
      };
      add("busy", 1, in(ModuleState::busy));
      add("stalled", 1, in(ModuleState::stalled));
      add("waiting", 1, in(ModuleState::waiting));
      add("triangle", 32, [](const ModuleNow& now) { return now.triangle; });
      if (module == Module::setup_engine) continue;
      add("queue_fill", 16, [](const ModuleNow& now) { return now.fill; });
    }
  }

  const DatapathConfiguration& configuration_;
  const DatapathRegisters& systemc_;
  const Clock& clock_;
  const ActivityRecorder& activity_;
  RtlSignals inside_;
  std::set<std::string> known_;  // signals of the RTL that the table describes
  std::vector<Probe> probes_;
};

// The variables of the file: two clocks, then the probes.
std::vector<WaveVariable> variables_of(const Probes& probes) {
  std::vector<WaveVariable> variables;
  for (const Probe& probe : probes.all()) variables.push_back(probe.variable);
  // Before the variables of the same scope, so that scopes stay together.
  for (const char* name : {"rtl", "systemc"}) {
    const WaveVariable clk = {fmt::format("{}.{}.pixel_datapath", kRoot, name), "clk"};
    const auto place = std::lower_bound(
        variables.begin(), variables.end(), clk,
        [](const WaveVariable& a, const WaveVariable& b) { return a.scope < b.scope; });
    variables.insert(place, clk);
  }
  return variables;
}

// Writes what changes.
class Recorder {
 public:
  Recorder(const std::filesystem::path& file, const Probes& probes, std::uint64_t period_ps)
      : variables_(variables_of(probes)),
        period_(period_ps),
        writer_(WaveWriter::open(file, variables_)),
        last_(variables_.size()) {
    auto probe = probes.all().begin();
    for (std::size_t i = 0; i < variables_.size(); ++i) {
      if (variables_[i].name == "clk") {
        clocks_.push_back(i);
      } else {
        values_.push_back({i, &*probe++, {}});
      }
    }
  }

  // Takes the values of a clock before its edge.
  void record(std::int64_t cycle) {
    if (next_ && cycle != *next_) leave(*next_);
    next_ = cycle + 1;
    pending_ = cycle;
    for (Value& value : values_) {
      if (!value.probe->after) value.text = text_of(*value.probe);
    }
  }

  // Writes them; call it when all modules have done the clock.
  void write() {
    if (!pending_) return;
    const std::uint64_t begin = static_cast<std::uint64_t>(*pending_) * period_;
    pending_.reset();
    writer_->time(begin);
    tick("1");
    for (Value& value : values_) {
      if (value.probe->after) value.text = text_of(*value.probe);
      change(value.variable, value.text);
    }
    writer_->time(begin + period_ / 2);
    tick("0");
  }

  void close() {
    write();
    if (next_) {
      writer_->time(static_cast<std::uint64_t>(*next_) * period_);
      tick("1");
    }
    writer_->close();
  }

 private:
  void tick(const char* value) {
    for (const std::size_t clock : clocks_) writer_->change(clock, value);
  }
  static std::string text_of(const Probe& probe) {
    return probe.variable.real ? fmt::format("{}", probe.real()) : probe.bits();
  }
  void change(std::size_t index, const std::string& text) {
    if (text == last_[index]) return;
    writer_->change(index, text);
    last_[index] = text;
  }
  // The last clock before cycles that are not recorded has its edge, and then nothing is known.
  void leave(std::int64_t cycle) {
    writer_->time(static_cast<std::uint64_t>(cycle) * period_);
    tick("1");
    writer_->time(static_cast<std::uint64_t>(cycle) * period_ + 1);
    tick("x");
    for (const Value& value : values_) {
      const WaveVariable& variable = value.probe->variable;
      if (variable.real) continue;
      change(value.variable, std::string(static_cast<std::size_t>(variable.width), 'x'));
    }
  }

  std::vector<WaveVariable> variables_;
  std::uint64_t period_;
  std::unique_ptr<WaveWriter> writer_;
  std::vector<std::string> last_;  // values, by variable
  std::vector<std::size_t> clocks_;
  struct Value {
    std::size_t variable = 0;
    const Probe* probe = nullptr;
    std::string text;
  };
  std::vector<Value> values_;
  std::optional<std::int64_t> next_;     // cycle after the last recorded one
  std::optional<std::int64_t> pending_;  // recorded and not yet written
};

// SystemC and RTL on the same inputs; what happens in the windows is recorded.
class RecordedDatapath : public ClockedDatapath {
 public:
  RecordedDatapath(const FrameSetup& frame, const RtlLibrary& library,
                   const std::vector<CycleWindow>& windows, const TraceTarget& target,
                   const TraceOptions& options, const ActivityRecorder& activity,
                   const std::filesystem::path& file, std::uint64_t period_ps)
      : windows_(windows),
        target_(target),
        rtl_drives_(options.rtl_drives),
        systemc_(frame.configuration, frame.cue_color),
        rtl_(library, frame.cue_color),
        probes_(frame.configuration, systemc_, rtl_, clock_, activity),
        recorder_(file, probes_, period_ps) {
    rtl_.before_edge([this] {
      if (recording_) recorder_.record(clock_.cycle);
    });
  }

  void reset() override {
    rtl_.reset();
    systemc_.reset();
  }
  DatapathOutputs clock(const DatapathInputs& inputs) override {
    recorder_.write();  // the clock before
    while (window_ < windows_.size() && windows_[window_].last < clock_.cycle) ++window_;
    recording_ = window_ < windows_.size() && windows_[window_].first <= clock_.cycle;
    clock_.inputs = inputs;
    clock_.outputs = systemc_.outputs();
    const DatapathOutputs rtl = rtl_.clock(inputs);
    if (recording_) mark();
    const DatapathOutputs systemc = systemc_.clock(inputs);
    ++clock_.cycle;
    return rtl_drives_ ? rtl : systemc;
  }

  void close() { recorder_.close(); }
  const std::vector<TraceMarker>& markers() const { return markers_; }

 private:
  bool is_target(int x, int y) const {
    const std::array<int, 2> place = {x, y};
    return std::find(target_.pixels.begin(), target_.pixels.end(), place) != target_.pixels.end();
  }
  void mark() {
    const DatapathPixel& entered = systemc_.in_stage(0);
    bool inside = false;
    for (int x = entered.x; entered.valid && x < entered.x + systemc_.pixels_in(0); ++x) {
      if (!is_target(x, entered.y)) continue;
      inside = true;
      if (!entering_) {
        markers_.push_back({fmt::format("enters {},{}", x, entered.y), clock_.cycle});
      }
    }
    entering_ = inside;
    const DatapathOutputs& outputs = clock_.outputs;
    if (!outputs.pixel_valid || !clock_.inputs.pixel_ready) return;
    for (int k = 0; k < outputs.pixels(); ++k) {
      if (!is_target(outputs[k].x, outputs[k].y)) continue;
      markers_.push_back({fmt::format("leaves {},{}", outputs[k].x, outputs[k].y), clock_.cycle});
    }
  }

  const std::vector<CycleWindow>& windows_;
  const TraceTarget& target_;
  bool rtl_drives_;
  DatapathRegisters systemc_;
  RtlDatapath rtl_;
  Clock clock_;
  Probes probes_;
  Recorder recorder_;
  std::size_t window_ = 0;
  bool recording_ = false, entering_ = false;
  std::vector<TraceMarker> markers_;
};

// The variables of every trace of this hardware, in the order of the file.
std::vector<WaveVariable> trace_variables(const DatapathConfiguration& configuration,
                                          const RtlLibrary& library) {
  const DatapathRegisters systemc(configuration);
  const RtlDatapath rtl(library);
  const Clock clock;
  const ActivityRecorder activity(0);
  return variables_of(Probes(configuration, systemc, rtl, clock, activity));
}

}  // namespace

RecordedTrace record_trace(const PreparedFrame& frame, const Hardware& hardware,
                           const RtlLibrary& library, const std::vector<CycleWindow>& windows,
                           const TraceTarget& target, const TraceOptions& options,
                           const std::filesystem::path& file) {
  const double clock_ns = hardware.technology.clock(frame.setup.configuration).ns;
  constexpr double kPicoseconds = 1000;  // in a nanosecond
  const auto period = static_cast<std::uint64_t>(std::llround(clock_ns * kPicoseconds));
  Child child([&] {
    ActivityRecorder activity(0);
    RecordedDatapath datapath(frame.setup, library, windows, target, options, activity, file,
                              period);
    StreamHash hash;
    SimulationOptions simulation = options.simulation;
    simulation.detail = Detail::cycle;
    simulation.datapath = &datapath;
    simulation.activity = &activity;
    simulation.observe = [&](const ShadedPixel* pixels, const std::int64_t* cycles,
                             std::size_t count) { hash.add(pixels, cycles, count); };
    const SimulationResult result = simulate(frame.setup, hardware.pipeline, simulation);
    datapath.close();
    const Fingerprint fingerprint = hash.fingerprint();
    TraceSummary trace;
    trace.markers = datapath.markers();
    trace.period_ps = period;
    trace.frame_cycles = result.frame_cycles;
    trace.failure = result.failure;
    trace.stream_hash = fingerprint.stream_hash ^ fingerprint.cycles_hash;
    return to_bytes(trace);
  });
  return {from_bytes<TraceSummary>(child.get()),
          trace_variables(frame.setup.configuration, library)};
}

}  // namespace phongpipe
