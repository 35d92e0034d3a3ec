// Stuck bits planted in every register and in the table of the RTL, one at a time: those that
// change the picture are named at the stage where they were planted.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "model/fixed/prepared_frame.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cosim/lockstep.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

constexpr int kWordStage = 8;            // in which words of the table are first seen
constexpr int kPort = -kLaneStages - 1;  // in place of a stage

// Registers and memories that are in no table of registers, by block and name, and where a fault in
// them is seen.
const std::map<std::string, int> kSeenAt = {{"queue.places", kPort},
                                            {"queue.colors", kPort},
                                            {"queue.pixel_valid", kPort},
                                            {"queue.pixel_place", kPort},
                                            {"queue.pixel_color", kPort},
                                            {"differencer.places", 1},
                                            {"rom.new_word", kWordStage},
                                            {"plain.new_place", kWordStage},
                                            {"octave.new_place", kWordStage},
                                            {"octave.write_base", kWordStage},
                                            {"second_table.new_increment_place", kWordStage},
                                            {"second_table.write_increment", kWordStage}};

struct Fault {
  std::string scope, name;  // of the RTL's signal
  int element = 0, bit = 0;
  bool value = false;
};

// RTL with a bit that keeps its value.
class FaultyRtl : public RtlDatapath {
 public:
  FaultyRtl(const RtlLibrary& library, const OutputColor& cue_color, const Fault& fault)
      : RtlDatapath(library, cue_color), fault_(fault), signals_(*this) {
    view_ = signals_.find(fault.scope, fault.name);
    EXPECT_NE(view_, nullptr) << fault.scope << "." << fault.name;
  }
  DatapathOutputs clock(const DatapathInputs& inputs) override {
    const DatapathOutputs outputs = RtlDatapath::clock(inputs);
    view_->set_bit(fault_.bit, fault_.value, fault_.element);
    return outputs;
  }

 private:
  Fault fault_;
  RtlSignals signals_;
  const RtlSignalView* view_ = nullptr;
};

class PlantedFaults : public testing::Test {
 protected:
  PlantedFaults(const char* scene, const std::vector<std::string>& settings,
                const char* preset = "paper-1k", const std::vector<std::string>& hardware = {})
      : hardware_(load_hardware(preset, hardware)),
        frame_(load_named_scene(scene, settings), hardware_.formats, hardware_.setup),
        library_(frame_.setup.configuration, build()) {}

  static RtlBuildOptions build() {
    RtlBuildOptions options;
    options.build = RtlBuild::signals;
    options.destination = PHONGPIPE_RTL_CACHE;
    return options;
  }

  // The first pixel at which the picture differs; nothing if none does.
  std::optional<Divergence> first_pixel(const Fault& fault) {
    Child child([&] {
      FaultyRtl rtl(library_, frame_.setup.cue_color, fault);
      StreamChecker checker(frame_.setup);
      SimulationOptions options = limited();
      options.datapath = &rtl;
      options.observe = [&](const ShadedPixel* pixels, const std::int64_t* cycles,
                            std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) checker.observe(pixels[i], cycles[i]);
      };
      const SimulationResult result = simulate(frame_.setup, hardware_.pipeline, options);
      checker.finish(result.datapath_cycles);
      return nlohmann::json(checker.first()).dump();
    });
    return nlohmann::json::parse(child.get()).get<std::optional<Divergence>>();
  }
  std::optional<SignalDivergence> first_signal(const Fault& fault, const Divergence& pixel) {
    return find_signal_divergence(
        frame_.setup, hardware_.pipeline, limited(),
        [&] { return std::make_unique<FaultyRtl>(library_, frame_.setup.cue_color, fault); },
        pixel);
  }
  static SimulationOptions limited() {
    SimulationOptions options;
    options.watchdog_cycles = 10'000;
    return options;
  }

  void plant_everywhere() {
    const RtlDatapath rtl(library_, frame_.setup.cue_color);
    const RtlSignals inside(rtl);
    int planted = 0, shown = 0, named = 0;
    std::string missed;
    const auto plant = [&](const Fault& fault, const std::string& signal, int stage) {
      ++planted;
      const auto pixel = first_pixel(fault);
      if (!pixel) return;
      ++shown;
      const auto found = first_signal(fault, *pixel);
      const bool right = found && stage_of(*found) == stage;
      named += right ? 1 : 0;
      if (right) return;
      missed += fmt::format("{}[{}] stuck at {}: named {}\n", signal, fault.bit, fault.value,
                            found ? found->name() : "nothing");
    };
    for (const DatapathSignal& signal : signals_) {
      std::set<int> bits = {0, signal.width / 2, signal.width - 1};
      for (const int bit : bits) {
        for (const bool value : {false, true}) {
          const RtlSignalView& view = RtlRegister::find(inside, signal)->view();
          const Fault fault = {view.scope, view.name, 0, signal.rtl_lsb + bit, value};
          plant(fault, signal.full_name(), signal.stage);
        }
      }
    }
    for (const RtlSignalView* const memory : rom_memories(inside)) {
      const int last = memory->elements - 1;
      for (const int address : {0, 7 * last / 10, last - last / 43}) {
        for (const int bit : {0, 7}) {
          for (const bool value : {false, true}) {
            plant({memory->scope, memory->name, address, bit, value}, memory->name, kWordStage);
          }
        }
      }
    }
    for (const RtlSignalView& signal : inside.all()) {
      const std::string name = signal.scope.substr(signal.scope.rfind('.') + 1) + "." + signal.name;
      const auto seen = kSeenAt.find(name);
      if (seen == kSeenAt.end()) continue;
      for (const int bit : std::set<int>{0, signal.width - 1}) {
        for (const bool value : {false, true}) {
          plant({signal.scope, signal.name, signal.elements / 9, bit, value},
                signal.scope + "." + signal.name, seen->second);
        }
      }
    }
    RecordProperty("planted", planted);
    RecordProperty("shown", shown);
    fmt::print("{} of {} faults change the picture, {} of these are named at their stage\n{}",
               shown, planted, named, missed);
    EXPECT_GT(shown, planted / 4);
    EXPECT_GE(named, 0.99 * shown) << missed;
  }

  int stage_of(const SignalDivergence& found) const {
    if (found.signal.rfind("table_", 0) == 0) return kWordStage;
    for (const DatapathSignal& signal : signals_) {
      if (signal.block() == found.block && signal.name == found.signal) return signal.stage;
    }
    return kPort;
  }

  Hardware hardware_;
  PreparedFrame frame_;
  RtlLibrary library_;
  std::vector<DatapathSignal> signals_ = datapath_signals(frame_.setup.configuration);
};

const std::vector<std::string> kSmall = {"scene.image.width=48", "scene.image.height=48",
                                         "scene.object.0.segments=[10,6]"};

class InGrey : public PlantedFaults {
 protected:
  InGrey() : PlantedFaults("sphere", kSmall) {}
};
TEST_F(InGrey, AreNamedWhereTheyWerePlanted) {
  plant_everywhere();
}

// A span that is replayed alone shows the register that the whole frame shows, in the frame's
// cycle. Only a difference in the span before, which the frame shows too, comes earlier there.
TEST_F(InGrey, ASpanAloneShowsTheSame) {
  const RtlDatapath rtl(library_, frame_.setup.cue_color);
  const RtlSignals inside(rtl);
  int compared = 0, same_cycle = 0;
  for (const DatapathSignal& signal : signals_) {
    if (signal.stage < 5) continue;  // registers that wait for the span before differ earlier, too
    const RtlSignalView& view = RtlRegister::find(inside, signal)->view();
    const Fault fault = {view.scope, view.name, 0, signal.rtl_lsb + signal.width / 2, true};
    const auto pixel = first_pixel(fault);
    if (!pixel || pixel->missing) continue;
    Divergence not_alone = *pixel;
    not_alone.missing = true;
    const auto alone = first_signal(fault, *pixel), frame = first_signal(fault, not_alone);
    ASSERT_TRUE(alone && frame) << signal.full_name();
    EXPECT_EQ(alone->name(), frame->name());
    EXPECT_GE(alone->cycle, frame->cycle) << alone->name();
    EXPECT_LE(alone->cycle, pixel->cycle) << alone->name();
    ++compared;
    same_cycle += alone->cycle == frame->cycle ? 1 : 0;
  }
  EXPECT_GT(compared, 10);
  EXPECT_GT(same_cycle, compared * 3 / 4);
}

// With words in two tables.
class InDefault : public PlantedFaults {
 protected:
  InDefault() : PlantedFaults("sphere", kSmall, "default") {}
};
TEST_F(InDefault, AreNamedWhereTheyWerePlanted) {
  ASSERT_EQ(frame_.setup.configuration.rom_layout, RomLayout::bipartite);
  plant_everywhere();
}

class InSerial : public PlantedFaults {
 protected:
  InSerial() : PlantedFaults("sphere", kSmall, "default", {"datapath.kind=serial"}) {}
};
TEST_F(InSerial, AreNamedWhereTheyWerePlanted) {
  ASSERT_EQ(frame_.setup.configuration.kind, DatapathKind::serial);
  plant_everywhere();
}

class InWide : public PlantedFaults {
 protected:
  InWide() : PlantedFaults("sphere", kSmall, "default", {"datapath.kind=wide2"}) {}
};
TEST_F(InWide, AreNamedWhereTheyWerePlanted) {
  ASSERT_EQ(frame_.setup.configuration.lanes(), 2);
  plant_everywhere();
}

// With three channels, a separate gate series and depth cueing.
class InColor : public PlantedFaults {
 protected:
  InColor()
      : PlantedFaults("effects/depth-cue",
                      {"scene.image.width=48", "scene.image.height=48",
                       "scene.light.0.color=[1,0.8,0.6]", "scene.material.green.diffuse=0"}) {}
};
TEST_F(InColor, AreNamedWhereTheyWerePlanted) {
  ASSERT_TRUE(frame_.setup.configuration.depth_cue);
  ASSERT_EQ(frame_.setup.configuration.gate, GateSource::series);
  plant_everywhere();
}

}  // namespace
}  // namespace phongpipe
