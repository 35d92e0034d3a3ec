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

  RtlLoop() : library_(pawn().frame.configuration, {}), rtl_(library_) {
    rtl_.load_table(pawn().table());
    pawn().for_each_span([this](const Span& span) { spans_.push_back(to_rtl(span)); });
    run([](auto&&...) {});  // touches all memory once, so that no turn pays for that
  }

  // visit(spans of a batch, their number, the RTL's pixels)
  template <typename Visit>
  void run(Visit visit) {
    pixels_.resize(kPixels);
    for (std::size_t first = 0; first < spans_.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, spans_.size() - first);
      library_.interface().run(rtl_.rtl(), pawn().frame.cue_color.data(), spans_.data() + first,
                               count, pixels_.data());
      visit(spans_.data() + first, count, pixels_.data());
    }
  }

 private:
  RtlLibrary library_;
  RtlDatapath rtl_;
  std::vector<RtlSpan> spans_;
  std::vector<RtlPixel> pixels_;
};

void bare(benchmark::State& state) {
  RtlLoop loop;
  for (auto _ : state) {
    loop.run([](const RtlSpan*, std::size_t, const RtlPixel* pixels) {
      benchmark::DoNotOptimize(pixels);
    });
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
    loop.run([&](const RtlSpan* spans, std::size_t count, const RtlPixel* pixels) {
      for (const RtlSpan* span = spans; span != spans + count; ++span) {
        for (int i = 0; i < span->length; ++i, ++pixels) {
          hash.add({pixels->x, pixels->y, pixels->color});
        }
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
