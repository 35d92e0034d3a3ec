// One scene three ways: bit-accurate model, SystemC pipeline and Verilated RTL, pixel by pixel,
// with accuracy against exact Phong and time against the budget.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "sim/pipeline.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/cosim/effect_set.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

struct VerificationOptions {
  double budget_ns = 100;
  Detail detail = Detail::span;
  int stall_percent = 0;
  std::uint32_t seed = 1;
  Effects effects = Effects::derived;
  std::filesystem::path rtl_sources;                 // empty: the installed RTL
  std::filesystem::path pictures;                    // folder; empty: none
  std::function<void(const std::string&)> progress;  // told what is being done
};

// The first pixel at which an account leaves the model's.
struct Divergence {
  std::uint64_t place = 0;  // in the stream
  std::uint32_t triangle = 0;
  std::int64_t cycle = 0;
  ShadedPixel model, other;
  bool missing = false;  // the account ended before it
};

// What an account that is simulated in a process of its own is found to be.
struct Account {
  std::uint64_t mismatches = 0;        // pixels of the stream that are not the model's
  std::uint64_t frame_mismatches = 0;  // pixels of the final frame
  std::optional<Divergence> first;
  std::int64_t frame_cycles = 0;
  std::int64_t datapath_cycles = 0;
  std::int64_t setup_cycles = 0;
  std::int64_t rom_load_cycles = 0;
  std::int64_t datapath_busy_cycles = 0;  // of the RTL
  std::uint64_t cycles_hash = 0;          // over the cycle of every pixel
  OperationCounts setup_operations;
  PixelOperations pixel_operations;
  std::vector<std::string> modules;  // that SystemC elaborated
  double seconds = 0;                // of processor time to simulate
  std::string failure;
};

// The same frame by hardware that has every effect and leaves nothing out: what the effects left
// out save. Its picture must be the same to the bit.
struct Everything {
  DatapathConfiguration datapath;
  Account systemc;
};

struct Verification {
  std::filesystem::path scene;
  Hardware hardware;
  VerificationOptions options;
  std::vector<std::string> notes;
  std::size_t triangles_read = 0;    // of the meshes
  std::size_t triangles = 0;         // after clipping and culling
  std::size_t triangles_split = 0;   // that turn too sharply for one series
  std::size_t pieces = 0;            // that these became
  std::size_t triangles_set_up = 0;  // that cover a pixel, pieces for those split, for each light
  std::size_t triangles_dropped = 0;
  std::uint64_t pixels = 0;  // shaded
  std::uint64_t visible_pixels = 0;
  std::size_t coefficient_overflows = 0;
  double rom_error = 0;  // largest of the materials' tables, share of full scale
  Account systemc, rtl;
  EffectSet effects;
  std::optional<Everything> everything;  // unless everything is what was asked for
  Accuracy accuracy;

  // Per shaded pixel: the clocks the RTL was occupied, and those of the whole frame.
  double datapath_ns() const;
  double frame_ns() const;
  std::int64_t cycle_difference() const { return rtl.frame_cycles - systemc.frame_cycles; }
  bool same_cycles() const;
  bool within_budget() const { return frame_ns() <= options.budget_ns; }
  bool passed() const;
};

// Throws InputError on bad input.
Verification verify(const std::filesystem::path& scene, const Hardware& hardware,
                    const VerificationOptions& options);

}  // namespace phongpipe
