// Verifies one scene: compares bit-accurate model, SystemC pipeline and Verilated RTL pixel by
// pixel, and measures accuracy against exact Phong shading and time against the budget.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "model/fixed/register_ranges.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/accuracy/error_chain.h"
#include "testbench/cosim/effect_set.h"
#include "testbench/cosim/implementation_result.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

// Which hardware is simulated: with the effects that the scene uses; with all effects; or both, to
// see what leaving effects out saves and that it changes no pixel.
enum class EffectsToVerify { scene, all, both };

// The RTL that the model is compared with: built with the parameters of the configuration; with the
// largest parameters, in which every configuration runs, see superset.h; or none.
enum class RtlToVerify { native, superset, off };

// The parameters with which that RTL is built.
DatapathConfiguration rtl_configuration(const DatapathConfiguration& configuration,
                                        RtlToVerify rtl);

struct VerificationOptions {
  double budget_ns = 100;  // per shaded pixel, for the whole frame
  // Largest error against exact Phong shading that a pixel may have; no limit if empty.
  std::optional<double> max_error_lsb;
  Detail detail = Detail::span;
  int stall_percent = 0;
  std::uint32_t seed = 1;  // of the random back-pressure
  EffectsToVerify effects = EffectsToVerify::scene;
  RtlToVerify rtl = RtlToVerify::native;
  std::filesystem::path rtl_sources;  // folder; empty: the installed RTL
  bool pictures = false;              // whether the result contains pictures
  bool synthesize = false;            // place and route the RTL for its clock and area
  bool one_core = false;              // do everything in turn, for callers that run many at once
};

// What is simulated with these options.
Effects simulated_effects(const VerificationOptions& options);
SimulationOptions simulation_options(const VerificationOptions& options);

// One of the pixels with the largest errors. Colours are in LSB; channels in use only.
struct WorstPixel {
  int x = 0, y = 0;
  std::uint32_t triangle = 0;  // shown there, of the scene even if it was split
  double error_lsb = 0;        // the largest of its channels, without sign
  Color output, exact;
  std::string_view largest_part;  // of the error, see kErrorParts
};

// The same frame, simulated by SystemC hardware that has every effect. Its picture must be the same
// to the bit.
struct FullHardwareResult {
  DatapathConfiguration datapath;
  ImplementationResult systemc;
};

// Cycles in which a block is occupied by the frame, waits not included.
struct BlockLoad {
  std::string_view block;
  std::int64_t cycles = 0;
};

struct VerificationResult {
  std::string scene;  // its name in messages
  int width = 0, height = 0;
  VerificationOptions options;
  Hardware hardware;  // resolved
  FrameConfiguration configuration;
  ClockFigure clock;
  std::optional<AreaFigure> area;   // of pixel_datapath, if the technology knows
  std::vector<std::string> notes;   // messages for the user about the scene
  std::size_t triangles_read = 0;   // of the meshes
  std::size_t triangles = 0;        // after clipping and culling
  std::size_t triangles_split = 0;  // because they turn too sharply for one series
  std::size_t pieces = 0;           // that the split triangles became
  TriangleCounts set_up;            // counts pieces in place of split triangles
  std::uint64_t pixels = 0;         // shaded
  Ledger ledger;                    // of these pixels, by how they were shaded
  // Proved for every pixel, if the hardware certifies errors; full scale if some are refused.
  std::optional<double> certified_error_lsb;
  // If values do not fit their registers: what the registers of each series hold.
  std::vector<SeriesRanges> overflowing;
  double rom_error = 0;  // largest of the power's tables, as a fraction of full scale
  ImplementationResult systemc;
  std::optional<ImplementationResult> rtl;  // none with RtlToVerify::off
  EffectSet effects;
  std::optional<FullHardwareResult> full_hardware;  // with EffectsToVerify::both
  Accuracy accuracy;
  std::vector<WorstPixel> worst_pixels;  // at most kWorstPixels, the largest error first
  Picture result_picture;                // if requested, like those of `accuracy`

  // Time of the RTL's datapath (with RTL only), and of the whole frame, per shaded pixel.
  double datapath_ns_per_pixel() const;
  double frame_ns_per_pixel() const;
  std::int64_t cycle_difference() const {  // with RTL only
    return rtl->counts.frame_cycles - systemc.counts.frame_cycles;
  }
  // The implementation whose difference is told: RTL if the register is known, else the first of
  // SystemC and RTL with a pixel that differs, else null.
  const ImplementationResult* diverging() const;
  bool same_cycles() const;  // of every pixel, in SystemC and RTL; true without RTL
  bool agrees() const { return systemc.agrees() && (!rtl || rtl->agrees()) && same_cycles(); }
  bool within_budget() const { return frame_ns_per_pixel() <= options.budget_ns; }
  // "12 pixels off by more than 2 LSB, at most 3.21", by the limit or else by 2; empty without any.
  std::string over_limit_text() const;
  bool within_error() const {
    return !options.max_error_lsb || accuracy.total.largest_lsb <= *options.max_error_lsb;
  }
  // Whether the proved error holds where it was measured.
  bool certificate_holds() const {
    return !certified_error_lsb || accuracy.total.largest_lsb <= *certified_error_lsb;
  }
  // What each block of the pipeline is occupied for by the whole frame, in the order of the
  // pipeline; exact_path only if it is built. The blocks work at the same time.
  std::vector<BlockLoad> block_loads() const;
  BlockLoad limiting_block() const;  // with the largest load
  double ns_per_pixel(const BlockLoad& load) const;
  // The pipeline with the fewest units of the setup engine with which another block limits the
  // frame; empty if no number of units suffices.
  std::optional<PipelineConfiguration> balanced_units() const;
  std::int64_t least_setup_cycles() const;  // with as many units as there may be
  // Cycles of the units for the pixels of a path: of the setup engine, and one a pixel of
  // pixel_datapath or those of exact_path. Units work at the same time, so that the sum of all is
  // more than the frame takes.
  std::uint64_t unit_cycles(ShadingPath path) const;
  bool passed() const;
};

// Called with a description of the current step.
using ShowProgress = std::function<void(const std::string&)>;

// Called once the result has its pictures, while SystemC and RTL may still be simulated.
using TakePictures = std::function<void(const VerificationResult&)>;

// Throws InputError if no pixel is visible, or if the technology has no device to synthesize for.
VerificationResult verify(const std::shared_ptr<const PreparedScene>& scene,
                          const Hardware& hardware, const VerificationOptions& options,
                          const ShowProgress& progress = {},
                          const TakePictures& take_pictures = {});
inline VerificationResult verify(const Scene& scene, const Hardware& hardware,
                                 const VerificationOptions& options,
                                 const ShowProgress& progress = {}) {
  return verify(std::make_shared<const PreparedScene>(scene), hardware, options, progress);
}

}  // namespace phongpipe
