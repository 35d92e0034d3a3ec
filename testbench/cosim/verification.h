// One scene three ways: bit-accurate model, SystemC pipeline and Verilated RTL, pixel by pixel,
// with accuracy against exact Phong and time against the budget.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/cosim/effect_set.h"
#include "testbench/cosim/implementation_result.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

// What is built and simulated: the effects that the scene calls for, all there are, or the first
// and beside it the second, to see what leaving out saves and that it changes no pixel.
enum class EffectsToVerify { scene, all, both };

struct VerificationOptions {
  double budget_ns = 100;  // for a pixel of the whole frame
  Detail detail = Detail::span;
  int stall_percent = 0;
  std::uint32_t seed = 1;  // of the random back-pressure
  EffectsToVerify effects = EffectsToVerify::scene;
  std::filesystem::path rtl_sources;  // folder; empty: the installed RTL
  bool pictures = false;              // whether the result has any
};

// The same frame by SystemC hardware that has every effect and leaves nothing out. Its picture must
// be the same to the bit.
struct FullHardwareResult {
  DatapathConfiguration datapath;
  ImplementationResult systemc;
};

struct VerificationResult {
  std::string scene;  // what messages call it
  int width = 0, height = 0;
  VerificationOptions options;
  Hardware hardware;  // resolved
  FrameConfiguration configuration;
  double clock_ns = 0;
  std::vector<std::string> notes;   // what a user should know of the scene
  std::size_t triangles_read = 0;   // of the meshes
  std::size_t triangles = 0;        // after clipping and culling
  std::size_t triangles_split = 0;  // that turn too sharply for one series
  std::size_t pieces = 0;           // that these became
  TriangleCounts set_up;            // pieces for those split
  std::uint64_t pixels = 0;         // shaded
  double rom_error = 0;             // largest of the materials' tables, as a share of full scale
  ImplementationResult systemc, rtl;
  EffectSet effects;
  std::optional<FullHardwareResult> full_hardware;  // with EffectsToVerify::both
  Accuracy accuracy;
  Picture result_picture;  // as the other two, where pictures are asked for

  // Time of the RTL's datapath, and of the whole frame, over the pixels shaded.
  double datapath_ns_per_pixel() const;
  double frame_ns_per_pixel() const;
  std::int64_t cycle_difference() const {
    return rtl.counts.frame_cycles - systemc.counts.frame_cycles;
  }
  bool same_cycles() const;  // of every pixel
  bool within_budget() const { return frame_ns_per_pixel() <= options.budget_ns; }
  bool passed() const;
};

// Told what is being done.
using ShowProgress = std::function<void(const std::string&)>;

// Throws InputError where nothing is to be seen, or where the technology has no such clock.
VerificationResult verify(const std::shared_ptr<const PreparedScene>& scene,
                          const Hardware& hardware, const VerificationOptions& options,
                          const ShowProgress& progress = {});
inline VerificationResult verify(const Scene& scene, const Hardware& hardware,
                                 const VerificationOptions& options,
                                 const ShowProgress& progress = {}) {
  return verify(std::make_shared<const PreparedScene>(scene), hardware, options, progress);
}

}  // namespace phongpipe
