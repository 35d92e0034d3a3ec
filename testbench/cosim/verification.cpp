#include "testbench/cosim/verification.h"

#include <fmt/format.h>

#include <ctime>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "sim/setup_balance.h"
#include "testbench/cosim/lockstep.h"
#include "testbench/cosim/metrics.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/synthesis/place_and_route.h"
#include "testbench/system/installation.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

// One implementation over one frame. `library` is null for SystemC.
class Implementation {
 public:
  Implementation(const FrameSetup& frame, const PipelineConfiguration& pipeline,
                 const SimulationOptions& options, const RtlLibrary* library)
      : frame_(frame), pipeline_(pipeline), options_(options), library_(library) {}

  // For RTL that is wider than the configuration.
  void align(const RtlAlignment& alignment) { alignment_ = alignment; }
  // For RTL of the configuration's own: how it was built.
  void built_by(const RtlBuildOptions& build) { rtl_build_ = &build; }

  // Starts the simulation in a child process, which hashes what comes. Call it once.
  void start() {
    child_.emplace([this] {
      StreamHash hash;
      SimulationOptions options = options_;
      options.observe = [&hash](const ShadedPixel* pixels, const std::int64_t* cycles,
                                std::size_t count) { hash.add(pixels, cycles, count); };
      const double start = processor_seconds();
      const SimulationResult simulated = simulate_with(options);
      ImplementationResult result;
      result.processor_seconds = processor_seconds() - start;
      result.counts = simulated;
      result.fingerprint = hash.fingerprint(simulated.framebuffer, frame_.configuration.channels);
      return to_bytes(result);
    });
  }

  // Waits for the simulation, and starts it if it was not.
  ImplementationResult result() {
    if (!child_) start();
    return from_bytes<ImplementationResult>(child_->get());
  }

  // Simulates once more and finds what differs from the model. A frame of other hardware has other
  // streams: there only the pictures are compared.
  void locate_mismatches(const FrameSetup& model_frame, const Framebuffer& model,
                         ImplementationResult& result) const {
    const bool same_hardware = &model_frame == &frame_;
    Child child([&] {
      StreamChecker checker(model_frame);
      SimulationOptions options = options_;
      options.observe = [&checker, same_hardware](const ShadedPixel* pixels,
                                                  const std::int64_t* cycles, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) checker.observe(pixels[i], cycles[i]);
        if (same_hardware && checker.enough()) stop_simulation();
      };
      const SimulationResult simulated = simulate_with(options);
      if (same_hardware) {
        checker.finish(simulated.datapath_cycles);
        result.stream_mismatches = checker.mismatches();
        result.first_divergence = checker.first();
      }
      if (!result.stopped()) {
        result.frame_mismatches =
            count_frame_mismatches(model, model_frame.configuration.channels, simulated.framebuffer,
                                   frame_.configuration.channels);
      }
      return to_bytes(result);
    });
    result = from_bytes<ImplementationResult>(child.get());
    locate_signal(result);
    // The hashes differed: that the second simulation agrees is no agreement.
    if (result.agrees()) {
      result.counts.failure = "simulated twice, it differed from the model only once";
    }
  }

  // Simulates once more, in lockstep with the model, and finds the register that differs first.
  void locate_signal(ImplementationResult& result) const {
    if (library_ == nullptr || rtl_build_ == nullptr) return;
    try {
      RtlBuildOptions build = *rtl_build_;
      build.build = RtlBuild::signals;
      const RtlLibrary with_signals(frame_.configuration, build);
      result.signal_divergence = find_signal_divergence(
          frame_, pipeline_, options_,
          [&] { return std::make_unique<RtlDatapath>(with_signals, frame_.cue_color); },
          result.first_divergence);
    } catch (const ToolError&) {
      // The pixel is known all the same.
    }
  }

 private:
  SimulationResult simulate_with(SimulationOptions& options) const {
    std::unique_ptr<RtlDatapath> datapath;
    if (library_ != nullptr) {
      datapath = std::make_unique<RtlDatapath>(*library_, frame_.cue_color, alignment_);
      options.datapath = datapath.get();
    }
    return simulate(frame_, pipeline_, options);
  }

  const FrameSetup& frame_;
  const PipelineConfiguration& pipeline_;
  SimulationOptions options_;
  const RtlLibrary* library_;
  RtlAlignment alignment_;
  const RtlBuildOptions* rtl_build_ = nullptr;
  std::optional<Child> child_;
};

// The model's frame and what it hashes to.
struct ModelRun {
  ModelFrame frame;
  Fingerprint fingerprint;
};

ModelRun run_and_hash_model(const FrameSetup& frame) {
  StreamHash hash;
  ModelFrame model = run_model(frame, [&hash](const Span& span, const std::uint32_t* colors) {
    hash.add(span.row, colors);
  });
  const Fingerprint fingerprint = hash.fingerprint(model.framebuffer, frame.configuration.channels);
  return {std::move(model), fingerprint};
}

bool same_pixels(const Fingerprint& a, const Fingerprint& b) {
  return same_stream(a, b) && a.frame_hash == b.frame_hash;
}

std::vector<WorstPixel> describe_worst(const PreparedFrame& frame, const ModelFrame& model,
                                       const Accuracy& accuracy) {
  std::vector<WorstPixel> worst;
  worst.reserve(accuracy.worst_pixels.size());
  const auto width = static_cast<std::size_t>(frame.setup.width);
  for (const PixelError& pixel : accuracy.worst_pixels) {
    const int x = static_cast<int>(pixel.index % width), y = static_cast<int>(pixel.index / width);
    const ErrorSplit split = split_error(frame, model, accuracy.misplaced, x, y);
    worst.push_back({x, y, frame.subdivision().whole[model.framebuffer.owner(pixel.index)],
                     pixel.error_lsb, split.output, split.exact,
                     kErrorParts[split.largest_part()].name});
  }
  return worst;
}

void describe_frame(const PreparedFrame& frame, VerificationResult& result) {
  const Subdivision& subdivision = frame.subdivision();
  result.configuration = frame.setup.configuration;
  result.width = frame.setup.width;
  result.height = frame.setup.height;
  result.notes = frame.geometry().notes;
  result.triangles_read = frame.geometry().triangles_read;
  result.triangles = frame.geometry().triangles.size() - subdivision.pieces + subdivision.split;
  result.triangles_split = subdivision.split;
  result.pieces = subdivision.pieces;
  result.effects = effects_of(frame.setup);
  for (const HighlightTable& table : frame.setup.tables) {
    result.rom_error = std::max(
        result.rom_error, ExponentRom::largest_error(frame.setup.configuration, table.shininess));
  }
}

}  // namespace

DatapathConfiguration rtl_configuration(const DatapathConfiguration& configuration,
                                        RtlToVerify rtl) {
  return rtl == RtlToVerify::superset ? superset_of(configuration) : configuration;
}

Effects simulated_effects(const VerificationOptions& options) {
  return options.effects == EffectsToVerify::all ? Effects::all : Effects::derived;
}

SimulationOptions simulation_options(const VerificationOptions& options) {
  SimulationOptions simulation;
  simulation.detail = options.detail;
  simulation.stall_percent = options.stall_percent;
  simulation.stall_seed = options.seed;
  return simulation;
}

double VerificationResult::datapath_ns_per_pixel() const {
  return clock.ns * static_cast<double>(rtl->counts.datapath_busy_cycles) /
         static_cast<double>(pixels);
}

double VerificationResult::frame_ns_per_pixel() const {
  return clock.ns * static_cast<double>(systemc.counts.frame_cycles) / static_cast<double>(pixels);
}

const ImplementationResult* VerificationResult::diverging() const {
  if (rtl && rtl->signal_divergence) return &*rtl;
  if (systemc.first_divergence) return &systemc;
  return rtl && rtl->first_divergence ? &*rtl : nullptr;
}

std::string VerificationResult::over_limit_text() const {
  const std::uint64_t pixels = accuracy.pixels_over_limit;
  if (pixels == 0) return {};
  return fmt::format("{} off by more than {:g} LSB, at most {:.2f}", count_text(pixels, "pixel"),
                     options.max_error_lsb.value_or(AccuracyOptions().limit_lsb),
                     accuracy.total.largest_lsb);
}

constexpr std::string_view kSetupEngine = "setup_engine";

std::vector<BlockLoad> VerificationResult::block_loads() const {
  const SimulationCounts& counts = systemc.counts;
  std::vector<BlockLoad> loads = {
      {kSetupEngine, counts.setup_cycles},
      {"span_walker", counts.walker_cycles},
      {"pixel_datapath",
       counts.pixel_groups * configuration.interval_cycles() + counts.rom_load_cycles},
      {"framebuffer", counts.framebuffer_cycles}};
  if (certified_error_lsb) {
    loads.insert(loads.begin() + 1, BlockLoad{"exact_path", counts.exact_path_cycles});
  }
  return loads;
}

BlockLoad VerificationResult::limiting_block() const {
  const std::vector<BlockLoad> loads = block_loads();
  return *std::max_element(loads.begin(), loads.end(), [](const BlockLoad& a, const BlockLoad& b) {
    return a.cycles < b.cycles;
  });
}

double VerificationResult::ns_per_pixel(const BlockLoad& load) const {
  return clock.ns * static_cast<double>(load.cycles) / static_cast<double>(pixels);
}

std::optional<PipelineConfiguration> VerificationResult::balanced_units() const {
  std::int64_t others = 0;
  for (const BlockLoad& load : block_loads()) {
    if (load.block != kSetupEngine) others = std::max(others, load.cycles);
  }
  return fewest_setup_units(systemc.counts.setup_uses, hardware.pipeline, others);
}

std::int64_t VerificationResult::least_setup_cycles() const {
  return setup_cycles(systemc.counts.setup_uses, with_most_units(hardware.pipeline));
}

std::uint64_t VerificationResult::unit_cycles(ShadingPath path) const {
  const SimulationCounts& counts = systemc.counts;
  const std::uint64_t setup = counts.setup_cycles_by_path[path];
  return setup + (path == ShadingPath::exact_path
                      ? static_cast<std::uint64_t>(counts.exact_path_cycles)
                  : path == ShadingPath::refused ? 0
                                                 : ledger[path]);
}

bool VerificationResult::same_cycles() const {
  if (!rtl) return true;
  return cycle_difference() == 0 && rtl->counts.datapath_cycles == systemc.counts.datapath_cycles &&
         rtl->fingerprint.cycles_hash == systemc.fingerprint.cycles_hash;
}

bool VerificationResult::passed() const {
  return agrees() && (!full_hardware || full_hardware->systemc.agrees()) && within_budget() &&
         within_error() && certificate_holds() && set_up.overflows == 0;
}

namespace {

// Clock and area of the configuration in the device of its technology.
void synthesize(VerificationResult& result) {
  const Technology& technology = result.hardware.technology;
  if (technology.device.empty()) {
    throw InputError(fmt::format(
        "--synthesize: the technology {} has no device; choose --technology ice40-hx8k or "
        "ice40-up5k",
        technology.name));
  }
  const std::filesystem::path& sources = result.options.rtl_sources;
  const MeasuredDesign design = Netlist(datapath_target(result.configuration),
                                        sources.empty() ? installation().hardware : sources)
                                    .place(technology.device, technology.package);
  result.clock = {design.clock_ns, FigureKind::measured, 0, design.limited_by};
  result.area = AreaFigure{FigureKind::measured, design.luts, design.registers, design.block_rams};
}

}  // namespace

VerificationResult verify(const std::shared_ptr<const PreparedScene>& scene,
                          const Hardware& hardware, const VerificationOptions& options,
                          const ShowProgress& progress, const TakePictures& take_pictures) {
  const auto show = [&progress](const std::string& what) {
    if (progress) progress(what);
  };
  show("preparing the frame");
  const PreparedFrame frame(scene, hardware.formats, hardware.setup, simulated_effects(options));
  VerificationResult result;
  result.scene = scene->scene.source;
  result.options = options;
  result.hardware = resolved(hardware, frame.setup.configuration);
  result.clock = hardware.technology.clock(frame.setup.configuration);
  result.area = hardware.technology.area(frame.setup.configuration);
  describe_frame(frame, result);
  if (options.synthesize) {
    show("placing and routing the RTL");
    synthesize(result);
  }

  std::optional<RtlLibrary> library;
  RtlBuildOptions build;
  if (options.rtl != RtlToVerify::off) {
    build.sources = options.rtl_sources;
    build.progress = [&](const std::string& what) { show("building the RTL for " + what); };
    library.emplace(rtl_configuration(frame.setup.configuration, options.rtl), build);
  }

  show(library ? "simulating SystemC and RTL" : "simulating SystemC");
  const SimulationOptions simulation = simulation_options(options);
  Implementation systemc(frame.setup, hardware.pipeline, simulation, nullptr);
  std::optional<Implementation> rtl;
  if (library) {
    rtl.emplace(frame.setup, hardware.pipeline, simulation, &*library);
    if (options.rtl == RtlToVerify::superset) {
      rtl->align(superset_alignment(frame.setup.configuration));
    } else {
      rtl->built_by(build);
    }
  }
  if (!options.one_core) {
    if (rtl) rtl->start();
    systemc.start();
  }

  const ModelRun model = run_and_hash_model(frame.setup);
  result.set_up = model.frame.triangles;
  result.pixels = model.frame.pixels;
  result.ledger = model.frame.ledger;
  if (result.set_up.overflows > 0) {
    for (const SeriesRanges& ranges : register_ranges(frame.setup)) {
      if (!ranges.fits()) result.overflowing.push_back(ranges);
    }
  }
  if (result.pixels == 0) throw nothing_covered(scene->scene);
  AccuracyOptions wanted;
  wanted.pictures = options.pictures;
  wanted.one_core = options.one_core;
  wanted.limit_lsb = options.max_error_lsb.value_or(wanted.limit_lsb);
  result.accuracy = measure_accuracy(frame.setup, model.frame, wanted);
  // Certificates are of shading: a pixel that shows the wrong triangle may have any colour.
  result.certified_error_lsb = certified_error(frame.setup);
  if (result.certified_error_lsb && !result.accuracy.misplaced.empty()) {
    result.certified_error_lsb = kOutputMax;
  }
  result.worst_pixels = describe_worst(frame, model.frame, result.accuracy);
  if (options.pictures) {
    result.result_picture = picture_of(model.frame.framebuffer, result.width, result.height,
                                       frame.setup.configuration.channels);
    if (take_pictures) take_pictures(result);
  }
  const auto finish = [&](Implementation& implementation) {
    ImplementationResult found = implementation.result();
    if (!same_pixels(found.fingerprint, model.fingerprint)) {
      show("looking for the pixels that differ");
      implementation.locate_mismatches(frame.setup, model.frame.framebuffer, found);
      if (found.first_divergence) {
        std::uint32_t& triangle = found.first_divergence->triangle;
        triangle = frame.subdivision().whole[triangle];
      }
    }
    return found;
  };
  result.systemc = finish(systemc);
  if (options.effects == EffectsToVerify::both) {
    show("simulating hardware with everything");
    const PreparedFrame full(scene, hardware.formats, hardware.setup, Effects::all);
    Implementation all(full.setup, hardware.pipeline, simulation, nullptr);
    ImplementationResult found = all.result();
    if (found.fingerprint.frame_hash != model.fingerprint.frame_hash) {
      all.locate_mismatches(frame.setup, model.frame.framebuffer, found);
    }
    result.full_hardware = FullHardwareResult{full.setup.configuration, found};
  }
  if (rtl) {
    result.rtl = finish(*rtl);
    if (result.rtl->agrees() && !result.same_cycles()) rtl->locate_signal(*result.rtl);
  }
  return result;
}

}  // namespace phongpipe
