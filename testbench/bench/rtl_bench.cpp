// The RTL loop alone, and with the model computed and every pixel compared.
#include <benchmark/benchmark.h>

#include "testbench/bench/pawn_frame.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

// Spans go to the RTL in batches, whose pixels stay in the cache until they are compared.
class RtlLoop {
 public:
  RtlLoop() : library_(pawn().frame.configuration, {}), rtl_(library_), spans_(pawn().spans()) {
    rtl_.load_material(pawn().material());
    for (const Span& span : spans_) rtl_spans_.push_back(to_rtl(span, pawn().material()));
  }

  // visit(spans of a batch, their number, the RTL's pixels)
  template <typename Visit>
  void run(Visit visit) {
    constexpr std::size_t kBatch = 256;
    pixels_.resize(kBatch * 4096);
    for (std::size_t first = 0; first < spans_.size(); first += kBatch) {
      const std::size_t count = std::min(kBatch, spans_.size() - first);
      library_.interface().run(rtl_.rtl(), rtl_spans_.data() + first, count, pixels_.data());
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

void compared(benchmark::State& state) {
  RtlLoop loop;
  PixelDatapath datapath(pawn().frame.configuration);
  datapath.load_material(pawn().material());
  std::vector<std::uint32_t> colors(4096 + PixelDatapath::kLanes);
  std::uint64_t mismatches = 0;
  for (auto _ : state) {
    loop.run([&](const Span* spans, std::size_t count, const RtlPixel* pixel) {
      for (std::size_t s = 0; s < count; ++s) {
        const RowSpan row = spans[s].row;
        datapath.shade(spans[s], colors.data());
        for (int i = 0; i < row.length; ++i, ++pixel) {
          mismatches += static_cast<unsigned>(
              (pixel->x ^ (row.x + i)) | (pixel->y ^ row.y) |
              static_cast<int>(pixel->color ^ colors[static_cast<std::size_t>(i)]));
        }
      }
    });
  }
  if (mismatches != 0) state.SkipWithError("the RTL and the model differ");
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

BENCHMARK(bare)->Unit(benchmark::kMillisecond);
BENCHMARK(compared)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
