// Result of simulating one implementation of the pipeline, SystemC or RTL.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/pipeline.h"
#include "testbench/cosim/lockstep.h"

namespace phongpipe {

// The first pixel at which an implementation differs from the model.
struct Divergence {
  std::uint64_t stream_index = 0;  // of the pixel among all shaded pixels
  std::uint64_t span = 0;          // of the pixel, in the order of pixel_datapath
  std::uint32_t triangle = 0;      // of the scene, even if it was split
  std::int64_t cycle = 0;
  ShadedPixel model, found;
  bool missing = false;  // the implementation ended before this pixel

  static constexpr auto fields() {
    using D = Divergence;
    return std::make_tuple(field("stream_index", &D::stream_index), field("span", &D::span),
                           field("triangle", &D::triangle), field("cycle", &D::cycle),
                           field("model", &D::model), field("found", &D::found),
                           field("missing", &D::missing));
  }
};

// Hashes of the stream, of the frame and of the cycles of all pixels, to compare two simulations.
struct Fingerprint {
  std::uint64_t pixels = 0;  // shaded
  std::uint64_t stream_hash = 0;
  std::uint64_t frame_hash = 0;
  std::uint64_t cycles_hash = 0;

  static constexpr auto fields() {
    using F = Fingerprint;
    return std::make_tuple(field("pixels", &F::pixels), field("stream_hash", &F::stream_hash),
                           field("frame_hash", &F::frame_hash),
                           field("cycles_hash", &F::cycles_hash));
  }
};

// Result of simulating one implementation in a child process.
struct ImplementationResult {
  SimulationCounts counts;
  Fingerprint fingerprint;
  double processor_seconds = 0;  // CPU time of the simulation
  // Numbers of pixels that differ from the model, in the stream and in the final frame.
  std::uint64_t stream_mismatches = 0, frame_mismatches = 0;
  std::optional<Divergence> first_divergence;
  // The register at which RTL differs first, which is the cause of the pixel above.
  std::optional<SignalDivergence> signal_divergence;

  static constexpr auto fields() {
    using R = ImplementationResult;
    return std::make_tuple(field("counts", &R::counts), field("fingerprint", &R::fingerprint),
                           field("processor_seconds", &R::processor_seconds),
                           field("stream_mismatches", &R::stream_mismatches),
                           field("frame_mismatches", &R::frame_mismatches),
                           field("first_divergence", &R::first_divergence),
                           field("signal_divergence", &R::signal_divergence));
  }

  bool agrees() const {
    return stream_mismatches == 0 && frame_mismatches == 0 && counts.failure.empty();
  }
};

}  // namespace phongpipe
