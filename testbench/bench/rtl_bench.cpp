// The RTL loop alone, and with the model computed and every pixel compared.
#include <benchmark/benchmark.h>

#include "testbench/bench/pawn_frame.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

class RtlLoop {
 public:
  RtlLoop() : library_(pawn().frame.configuration, {}), rtl_(library_) {
    rtl_.load_material(pawn().material());
    for (const Span& span : pawn().spans) spans_.push_back(to_rtl(span, pawn().material()));
    pixels_.resize(static_cast<std::size_t>(pawn().pixels));
  }
  void run() {
    library_.interface().run(rtl_.rtl(), spans_.data(), spans_.size(), pixels_.data());
  }
  const std::vector<RtlPixel>& pixels() const { return pixels_; }

 private:
  RtlLibrary library_;
  RtlDatapath rtl_;
  std::vector<RtlSpan> spans_;
  std::vector<RtlPixel> pixels_;
};

void bare(benchmark::State& state) {
  RtlLoop loop;
  for (auto _ : state) loop.run();
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

void compared(benchmark::State& state) {
  RtlLoop loop;
  PixelDatapath datapath(pawn().frame.configuration);
  datapath.load_material(pawn().material());
  std::vector<std::uint32_t> colors(4096 + PixelDatapath::kLanes);
  std::uint64_t mismatches = 0;
  for (auto _ : state) {
    loop.run();
    const RtlPixel* pixel = loop.pixels().data();
    for (const Span& span : pawn().spans) {
      datapath.shade(span, colors.data());
      for (int i = 0; i < span.row.length; ++i, ++pixel) {
        mismatches += pixel->x != span.row.x + i || pixel->y != span.row.y ||
                      pixel->color != colors[static_cast<std::size_t>(i)];
      }
    }
  }
  if (mismatches != 0) state.SkipWithError("the RTL and the model differ");
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

BENCHMARK(bare)->Unit(benchmark::kMillisecond);
BENCHMARK(compared)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
