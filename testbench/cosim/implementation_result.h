// Result of simulating one implementation of the pipeline, SystemC or RTL.
#pragma once

#include <cstdint>
#include <optional>

#include "sim/pipeline.h"
#include "testbench/cosim/divergence.h"

namespace phongpipe {

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

// An implementation that differs is simulated once more, beside the model, until this many pixels
// of the stream have differed.
constexpr std::uint64_t kMismatchesCounted = 100;

// Result of simulating one implementation in a child process.
struct ImplementationResult {
  SimulationCounts counts;
  Fingerprint fingerprint;
  double processor_seconds = 0;  // CPU time of the simulation
  // Numbers of pixels that differ from the model: in the stream, at most kMismatchesCounted; in the
  // final frame, 0 if the count of the stream stopped there.
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

  bool stopped() const { return stream_mismatches == kMismatchesCounted; }
  bool agrees() const {
    return stream_mismatches == 0 && frame_mismatches == 0 && counts.failure.empty();
  }
};

}  // namespace phongpipe
