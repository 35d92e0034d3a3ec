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

// As it lies in memory, the first pixel of a row so that x is counted on by addition.
std::uint64_t pack(const RtlPixel& pixel) {
  std::uint64_t packed;
  std::memcpy(&packed, &pixel, sizeof(packed));
  return packed;
}

// What the RTL must give for a span, behind `expected`; pixels beyond its length are rubbish.
void expect_span(const Span& span, const std::uint32_t* colors, RtlPixel* expected) {
  constexpr int kBlock = PixelDatapath::kLanes;
  const std::uint64_t first_pixel =
      pack({static_cast<std::uint16_t>(span.row.x), static_cast<std::uint16_t>(span.row.y), 0});
  for (int first = 0; first < span.row.length; first += kBlock) {
    std::uint64_t packed[kBlock];
    for (int i = 0; i < kBlock; ++i) {
      packed[i] = first_pixel + static_cast<std::uint64_t>(first + i) +
                  (std::uint64_t{colors[first + i]} << 32);
    }
    std::memcpy(expected + first, packed, sizeof(packed));
  }
}

void compared(benchmark::State& state) {
  RtlLoop loop;
  PixelDatapath datapath(pawn().frame.configuration);
  datapath.load_table(pawn().table());
  std::vector<std::uint32_t> colors(RtlLoop::kPixels + PixelDatapath::kLanes);
  std::vector<RtlPixel> expected(RtlLoop::kPixels + PixelDatapath::kLanes);
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
