// The RTL loop alone, and compared with the model as `verify` does it: the model is computed at the
// same time on another core, and the hashes of the two streams are compared.
#include <benchmark/benchmark.h>

#include <future>

#include "testbench/bench/pawn_frame.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

// Spans go to the RTL in batches, whose pixels stay in the cache until they are hashed.
class RtlLoop {
 public:
  static constexpr std::size_t kBatch = 256;
  static constexpr std::size_t kPixels = kBatch * 4096;

  RtlLoop() : library_(pawn().frame.configuration, {}), rtl_(library_), spans_(pawn().spans()) {
    rtl_.load_table(pawn().table());
    for (const Span& span : spans_) rtl_spans_.push_back(to_rtl(span));
    run([](auto&&...) {});  // touches all memory once, so that no turn pays for that
  }

  // visit(spans of a batch, their number, the RTL's pixels)
  template <typename Visit>
  void run(Visit visit) {
    pixels_.resize(kPixels);
    for (std::size_t first = 0; first < spans_.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, spans_.size() - first);
      library_.interface().run(rtl_.rtl(), pawn().frame.cue_color.data(), rtl_spans_.data() + first,
                               count, pixels_.data());
      visit(spans_.data() + first, count, pixels_.data());
    }
  }

 private:
  RtlLibrary library_;
  RtlDatapath rtl_;
  std::vector<Span> spans_;
  std::vector<RtlSpan> rtl_spans_;
  std::vector<RtlPixel> pixels_;
};

void bare(benchmark::State& state) {
  RtlLoop loop;
  for (auto _ : state) {
    loop.run(
        [](const Span*, std::size_t, const RtlPixel* pixels) { benchmark::DoNotOptimize(pixels); });
  }
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

// The model's hash of the stream.
Fingerprint hash_model() {
  StreamHash hash;
  SpanStream stream(pawn().frame);
  while (stream.next()) hash.add(stream.span().row, stream.colors());
  return hash.fingerprint();
}

void compared(benchmark::State& state) {
  RtlLoop loop;
  for (auto _ : state) {
    std::future<Fingerprint> model = std::async(std::launch::async, hash_model);
    StreamHash hash;
    loop.run([&](const Span* spans, std::size_t count, const RtlPixel* pixels) {
      std::size_t pixel_count = 0;
      for (std::size_t s = 0; s < count; ++s) {
        pixel_count += static_cast<std::size_t>(spans[s].row.length);
      }
      for (std::size_t i = 0; i < pixel_count; ++i) {
        hash.add({pixels[i].x, pixels[i].y, pixels[i].color});
      }
    });
    if (!same_stream(hash.fingerprint(), model.get())) {
      state.SkipWithError("the RTL and the model differ");
      break;
    }
  }
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

BENCHMARK(bare)->Unit(benchmark::kMillisecond);
BENCHMARK(compared)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
