// The RTL loop alone, and with the model computed and every pixel compared.
#include <benchmark/benchmark.h>

#include <cstring>

#include "testbench/bench/pawn_frame.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

// Spans go to the RTL in batches, whose pixels stay in the cache until they are compared.
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

// A pixel of the RTL as it lies in memory.
std::uint64_t packed(int x, int y, std::uint32_t color) {
  return std::uint64_t{color} << 32 | static_cast<std::uint64_t>(y) << 16 |
         static_cast<std::uint64_t>(x);
}
static_assert(sizeof(RtlPixel) == sizeof(std::uint64_t));

// What the RTL must give for a span, behind `expected`; pixels beyond its length are rubbish.
void expect_span(const Span& span, const std::uint32_t* colors, std::uint64_t* expected) {
  constexpr int kBlock = PixelDatapath::kLanes;
  const std::uint64_t first_pixel = packed(span.row.x, span.row.y, 0);
  for (int first = 0; first < span.row.length; first += kBlock) {
    for (int i = first; i < first + kBlock; ++i) {
      expected[i] = (std::uint64_t{colors[i]} << 32) + first_pixel + static_cast<std::uint64_t>(i);
    }
  }
}

void compared(benchmark::State& state) {
  RtlLoop loop;
  PixelDatapath datapath(pawn().frame.configuration);
  datapath.load_table(pawn().table());
  std::vector<std::uint32_t> colors(RtlLoop::kPixels + PixelDatapath::kLanes);
  std::vector<std::uint64_t> expected(RtlLoop::kPixels + PixelDatapath::kLanes);
  std::uint64_t different_batches = 0;
  for (auto _ : state) {
    loop.run([&](const Span* spans, std::size_t count, const RtlPixel* pixels) {
      datapath.shade(spans, count, colors.data());
      std::size_t end = 0;
      for (std::size_t s = 0; s < count; ++s) {
        expect_span(spans[s], colors.data() + end, expected.data() + end);
        end += static_cast<std::size_t>(spans[s].row.length);
      }
      different_batches += std::memcmp(expected.data(), pixels, end * sizeof(RtlPixel)) != 0;
    });
  }
  if (different_batches != 0) state.SkipWithError("the RTL and the model differ");
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

BENCHMARK(bare)->Unit(benchmark::kMillisecond);
BENCHMARK(compared)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
