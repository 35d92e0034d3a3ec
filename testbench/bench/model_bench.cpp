// The bit-accurate model against double-precision Phong, on the spans of the pawn, one core.
#include <benchmark/benchmark.h>

#include "model/shading/phong.h"
#include "testbench/bench/pawn_frame.h"

namespace phongpipe {
namespace {

void count_pixels(benchmark::State& state) {
  state.SetItemsProcessed(state.iterations() * pawn().pixels);
}

void phong_in_double(benchmark::State& state) {
  const std::vector<Span> spans = pawn().spans();
  const PawnFrame& frame = pawn();
  std::vector<PhongTriangle> triangles;
  for (const ScreenTriangle& triangle : frame.geometry.triangles) {
    triangles.emplace_back(frame.scene, frame.geometry.materials[triangle.material], triangle);
  }
  std::vector<Color> colors(4096);
  for (auto _ : state) {
    for (const Span& span : spans) {
      triangles[span.triangle].shade(span.row.x, span.row.y, span.row.length, colors.data());
      benchmark::DoNotOptimize(colors.data());
      benchmark::ClobberMemory();
    }
  }
  count_pixels(state);
}

void model(benchmark::State& state, Evaluation evaluation) {
  const std::vector<Span> spans = pawn().spans();
  PixelDatapath datapath(pawn().frame.configuration, evaluation);
  datapath.load_material(pawn().material());
  std::vector<std::uint32_t> colors(4096 + PixelDatapath::kLanes);
  for (auto _ : state) {
    for (const Span& span : spans) {
      datapath.shade(span, colors.data());
      benchmark::DoNotOptimize(colors.data());
      benchmark::ClobberMemory();
    }
  }
  count_pixels(state);
}

BENCHMARK(phong_in_double)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(model, stepping, Evaluation::stepping)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(model, portable, Evaluation::portable)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(model, best, best_evaluation())->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
