#include "testbench/cosim/verification.h"

#include <fmt/format.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "model/files/scene_file.h"
#include "model/scene/input_error.h"
#include "model/scene/subdivision.h"
#include "testbench/drawing/pictures.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

using nlohmann::json;

std::uint32_t triangle_at(const ModelFrame& model, std::uint64_t place) {
  std::uint64_t end = 0;
  for (const TracedSpan& span : model.spans) {
    end += static_cast<std::uint64_t>(span.row.length);
    if (place < end) return span.triangle;
  }
  return model.spans.empty() ? 0 : model.spans.back().triangle;
}

Account account_of(const SimulationResult& result) {
  Account account;
  account.frame_cycles = result.frame_cycles;
  account.datapath_cycles = result.datapath_cycles;
  account.setup_cycles = result.setup_cycles;
  account.rom_load_cycles = result.rom_load_cycles;
  account.datapath_busy_cycles = result.datapath_busy_cycles;
  account.failure = result.failure;
  account.setup_operations = result.setup_operations;
  account.pixel_operations = result.pixel_operations;
  account.pixel_operations.additions += result.depth_additions;
  account.modules = result.modules;
  return account;
}

// Of the frame's pixels; a grey model is compared with all channels of a frame in colour.
std::uint64_t frame_mismatches(const ModelFrame& model, int model_channels,
                               const SimulationResult& result, int channels) {
  const std::uint32_t repeat = model_channels == channels ? 1 : 0x010101;
  std::uint64_t mismatches = 0;
  for (std::size_t i = 0; i < model.framebuffer.size(); ++i) {
    mismatches += model.framebuffer.color(i) * repeat != result.framebuffer.color(i);
  }
  return mismatches;
}

// Compares an account with the model while it is simulated.
class Comparison {
 public:
  explicit Comparison(const ModelFrame& model) : model_(model) {}

  void observe(const ShadedPixel& pixel, std::int64_t cycle) {
    hash_.add(static_cast<std::uint64_t>(cycle));
    if (place_ < model_.stream.size() && pixel == model_.stream[place_]) {
      ++place_;
      return;
    }
    if (!first_) first_ = divergence(pixel, cycle);
    ++mismatches_;
    ++place_;
  }

  Account finish(const SimulationResult& result) {
    Account account = account_of(result);
    account.cycles_hash = hash_.value();
    account.mismatches = mismatches_;
    if (place_ < model_.stream.size()) {
      account.mismatches += model_.stream.size() - place_;
      if (!first_) {
        first_ = divergence({}, result.datapath_cycles);
        first_->missing = true;
      }
    }
    account.first = first_;
    account.frame_mismatches = frame_mismatches(model_, 1, result, 1);
    return account;
  }

 private:
  Divergence divergence(const ShadedPixel& pixel, std::int64_t cycle) const {
    Divergence result;
    result.place = place_;
    result.triangle = triangle_at(model_, place_);
    result.cycle = cycle;
    result.other = pixel;
    if (place_ < model_.stream.size()) result.model = model_.stream[place_];
    return result;
  }

  const ModelFrame& model_;
  std::size_t place_ = 0;
  std::uint64_t mismatches_ = 0;
  FnvHash hash_;  // of the cycles
  std::optional<Divergence> first_;
};

std::uint64_t pack(const ShadedPixel& pixel) {
  return std::uint64_t{pixel.color} << 32 | std::uint64_t{pixel.y} << 16 | pixel.x;
}
ShadedPixel unpack(std::uint64_t packed) {
  return {static_cast<std::uint16_t>(packed), static_cast<std::uint16_t>(packed >> 16),
          static_cast<std::uint32_t>(packed >> 32)};
}

// Accounts travel from the child that simulates to the parent as text.
std::string to_text(const Account& a) {
  json j = {{"mismatches", a.mismatches},
            {"frame_mismatches", a.frame_mismatches},
            {"frame_cycles", a.frame_cycles},
            {"datapath_cycles", a.datapath_cycles},
            {"setup_cycles", a.setup_cycles},
            {"rom_load_cycles", a.rom_load_cycles},
            {"busy", a.datapath_busy_cycles},
            {"cycles_hash", a.cycles_hash},
            {"failure", a.failure},
            {"modules", a.modules},
            {"seconds", a.seconds},
            {"setup",
             {a.setup_operations.add, a.setup_operations.multiply, a.setup_operations.rsqrt,
              a.setup_operations.power}},
            {"pixel",
             {a.pixel_operations.additions, a.pixel_operations.multiplications,
              a.pixel_operations.reads}}};
  if (a.first) {
    j["first"] = {{"place", a.first->place},       {"triangle", a.first->triangle},
                  {"cycle", a.first->cycle},       {"model", pack(a.first->model)},
                  {"other", pack(a.first->other)}, {"missing", a.first->missing}};
  }
  return j.dump();
}

Account from_text(const std::string& text) {
  const json j = json::parse(text);
  Account a;
  j["mismatches"].get_to(a.mismatches);
  j["frame_mismatches"].get_to(a.frame_mismatches);
  j["frame_cycles"].get_to(a.frame_cycles);
  j["datapath_cycles"].get_to(a.datapath_cycles);
  j["setup_cycles"].get_to(a.setup_cycles);
  j["rom_load_cycles"].get_to(a.rom_load_cycles);
  j["busy"].get_to(a.datapath_busy_cycles);
  j["cycles_hash"].get_to(a.cycles_hash);
  j["failure"].get_to(a.failure);
  j["modules"].get_to(a.modules);
  j["seconds"].get_to(a.seconds);
  j["setup"][0].get_to(a.setup_operations.add);
  j["setup"][1].get_to(a.setup_operations.multiply);
  j["setup"][2].get_to(a.setup_operations.rsqrt);
  j["setup"][3].get_to(a.setup_operations.power);
  j["pixel"][0].get_to(a.pixel_operations.additions);
  j["pixel"][1].get_to(a.pixel_operations.multiplications);
  j["pixel"][2].get_to(a.pixel_operations.reads);
  if (j.contains("first")) {
    const json& f = j["first"];
    a.first = Divergence{f["place"],         f["triangle"],      f["cycle"],
                         unpack(f["model"]), unpack(f["other"]), f["missing"]};
  }
  return a;
}

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

Everything simulate_everything(const Scene& scene, const Geometry& geometry, Hardware hardware,
                               SimulationOptions simulation, const ModelFrame& model,
                               int channels) {
  suit_scene(hardware, scene, geometry, Effects::all);
  Child child([&] {
    const FrameSetup frame(scene, geometry, hardware.datapath, hardware.pipeline.depth_bits,
                           Effects::all);
    // What the comparison of the stream costs, so that seconds can be compared.
    FnvHash hash;
    simulation.observe = [&hash](const ShadedPixel*, const std::int64_t* cycles,
                                 std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) hash.add(static_cast<std::uint64_t>(cycles[i]));
    };
    const double start = processor_seconds();
    const SimulationResult result = simulate(frame, geometry, hardware.pipeline, simulation);
    const double seconds = processor_seconds() - start;
    Account account = account_of(result);
    account.seconds = seconds;
    account.frame_mismatches =
        frame_mismatches(model, channels, result, frame.configuration.channels);
    return to_text(account);
  });
  return {hardware.datapath, from_text(child.get())};
}

void write_pictures(const Verification& v, const ModelFrame& model, const FrameSetup& frame) {
  const int channels = frame.configuration.channels;
  const std::string name = v.scene.stem().string();
  std::error_code error;
  std::filesystem::create_directories(v.options.pictures, error);
  const auto file = [&](const char* what) {
    return v.options.pictures / fmt::format("{}-{}.png", name, what);
  };
  write_png(file("result"), picture_of(model.colors(), frame.width, frame.height, channels));
  write_png(file("exact"), v.accuracy.exact_picture);
  write_png(file("error"), v.accuracy.error_picture);
}

}  // namespace

double Verification::datapath_ns() const {
  return hardware.clock_ns() * static_cast<double>(rtl.datapath_busy_cycles) /
         static_cast<double>(pixels);
}

double Verification::frame_ns() const {
  return hardware.clock_ns() * static_cast<double>(systemc.frame_cycles) /
         static_cast<double>(pixels);
}

bool Verification::same_cycles() const {
  return cycle_difference() == 0 && rtl.datapath_cycles == systemc.datapath_cycles &&
         rtl.cycles_hash == systemc.cycles_hash;
}

bool Verification::passed() const {
  const auto agrees = [](const Account& account) {
    return account.mismatches == 0 && account.frame_mismatches == 0 && account.failure.empty();
  };
  return agrees(systemc) && agrees(rtl) && (!everything || agrees(everything->systemc)) &&
         same_cycles() && within_budget() && coefficient_overflows == 0;
}

Verification verify(const std::filesystem::path& file, const Hardware& hardware,
                    const VerificationOptions& options) {
  const auto progress = [&options](const std::string& what) {
    if (options.progress) options.progress(what);
  };
  Verification v;
  v.scene = file;
  v.options = options;
  progress("reading the scene");
  const Scene scene = load_scene(file);
  const Subdivision subdivision =
      subdivide(scene, make_geometry(scene), hardware.datapath.subdivide_degrees);
  const Geometry& geometry = subdivision.geometry;
  v.hardware = hardware;
  suit_scene(v.hardware, scene, geometry, options.effects);
  v.notes = geometry.notes;
  v.triangles_read = geometry.triangles_read;
  v.triangles = geometry.triangles.size() - subdivision.pieces + subdivision.split;
  v.triangles_split = subdivision.split;
  v.pieces = subdivision.pieces;
  const FrameSetup frame(scene, geometry, v.hardware.datapath, v.hardware.pipeline.depth_bits,
                         options.effects);
  v.effects = effects_of(scene, geometry, frame);
  for (const HighlightTable& table : frame.tables) {
    v.rom_error =
        std::max(v.rom_error, ExponentRom::largest_error(frame.configuration, table.shininess));
  }
  v.hardware.clock_ns();  // fails before the long work where the card has no such clock

  RtlBuildOptions build;
  build.sources = options.rtl_sources;
  build.progress = [&](const std::string& what) { progress("building the RTL for " + what); };
  const RtlLibrary library(frame.configuration, build);

  progress("shading with the bit-accurate model");
  const ModelFrame model = run_model(frame, geometry);
  v.triangles_set_up = model.triangles_set_up;
  v.triangles_dropped = model.triangles_dropped;
  v.coefficient_overflows = model.coefficient_overflows;
  v.pixels = model.stream.size();
  if (v.pixels == 0) {
    throw InputError(file, 0,
                     "nothing of the scene covers a pixel; look at the camera and the objects");
  }
  for (std::size_t i = 0; i < model.framebuffer.size(); ++i) {
    v.visible_pixels += model.framebuffer.covered(i);
  }

  progress("simulating SystemC and RTL");
  SimulationOptions simulation;
  simulation.detail = options.detail;
  simulation.stall_percent = options.stall_percent;
  simulation.stall_seed = options.seed;
  const auto simulate_in_child = [&](bool rtl) {
    return [&, simulation, rtl]() mutable {
      std::unique_ptr<RtlDatapath> datapath;
      if (rtl) {
        datapath = std::make_unique<RtlDatapath>(library, frame.cue_color);
        simulation.datapath = datapath.get();
      }
      Comparison comparison(model);
      simulation.observe = [&comparison](const ShadedPixel* pixels, const std::int64_t* cycles,
                                         std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) comparison.observe(pixels[i], cycles[i]);
      };
      const double start = processor_seconds();
      const SimulationResult result = simulate(frame, geometry, v.hardware.pipeline, simulation);
      const double seconds = processor_seconds() - start;
      Account account = comparison.finish(result);
      account.seconds = seconds;
      return to_text(account);
    };
  };
  Child rtl(simulate_in_child(true));
  Child systemc(simulate_in_child(false));
  v.accuracy = measure_accuracy(scene, geometry, frame, model);
  if (!options.pictures.empty()) write_pictures(v, model, frame);
  v.systemc = from_text(systemc.get());
  if (options.effects == Effects::derived) {
    v.everything = simulate_everything(scene, geometry, hardware, simulation, model,
                                       frame.configuration.channels);
  }
  v.rtl = from_text(rtl.get());
  for (Account* account : {&v.systemc, &v.rtl}) {
    if (account->first) account->first->triangle = subdivision.whole[account->first->triangle];
  }
  return v;
}

}  // namespace phongpipe
