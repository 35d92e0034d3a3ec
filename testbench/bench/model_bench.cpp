// The bit-accurate model against double-precision Phong, one core: on spans of the pawn, and on
// spans of 64 pixels that start where they do. Every 64th triangle, so that spans are in the cache,
// as they are when they come from the span walker.
#include <benchmark/benchmark.h>

#include <cmath>

#include "model/shading/methods/shading_method.h"
#include "testbench/bench/pawn_frame.h"

namespace phongpipe {
namespace {

constexpr int kOwnLength = 0;

std::vector<Span> spans_of_length(std::int64_t length) {
  std::vector<Span> spans;
  for (Span span : pawn().spans()) {
    if (span.triangle % 64 != 0) continue;
    if (length != kOwnLength) span.row.length = static_cast<int>(length);
    spans.push_back(span);
  }
  return spans;
}

void count_pixels(benchmark::State& state, const std::vector<Span>& spans) {
  std::int64_t pixels = 0;
  for (const Span& span : spans) pixels += span.row.length;
  state.SetItemsProcessed(state.iterations() * pixels);
}

// Normals stepped by differences, normalised and raised to the power at each pixel, one channel.
void phong_in_double(benchmark::State& state) {
  const std::vector<Span> spans = spans_of_length(state.range(0));
  const PawnFrame& frame = pawn();
  const Material& material = frame.prepared.geometry().materials.front();
  const Power power(PowerKind::exact, material.shininess);
  const ShadingMethod& method = *find_shading_method("phong");
  std::vector<std::unique_ptr<TriangleShader>> triangles;
  for (const ScreenTriangle& triangle : frame.prepared.geometry().triangles) {
    const auto [x, y] = centroid_pixel(triangle);
    triangles.push_back(method.create({frame.prepared.scene(), material, triangle, power, x, y}));
  }
  const double ambient =
      255 * material.ambient[0] * frame.prepared.scene().shading.ambient_light[0];
  const double diffuse = 255 * material.diffuse[0], specular = 255 * material.specular[0];
  std::vector<Reflection<double>> reflections(4096);
  std::vector<double> colors(4096);
  for (auto _ : state) {
    for (const Span& span : spans) {
      const RowSpan row = span.row;
      triangles[span.triangle]->reflect(row.x, row.y, row.length, reflections.data());
      for (std::size_t i = 0; i < static_cast<std::size_t>(row.length); ++i) {
        const Reflection<double>& r = reflections[i];
        colors[i] = ambient;
        if (r.diffuse > 0) {
          colors[i] += diffuse * r.diffuse +
                       specular * std::pow(std::max(0.0, r.highlight), material.shininess);
        }
      }
      benchmark::DoNotOptimize(colors.data());
      benchmark::ClobberMemory();
    }
  }
  count_pixels(state, spans);
}

struct SpansOfTriangle {
  const Span* first;
  std::size_t count, pixels;
};

std::vector<SpansOfTriangle> by_triangle(const std::vector<Span>& spans) {
  std::vector<SpansOfTriangle> triangles;
  for (const Span& span : spans) {
    if (triangles.empty() || triangles.back().first->triangle != span.triangle) {
      triangles.push_back({&span, 0, 0});
    }
    ++triangles.back().count;
    triangles.back().pixels += static_cast<std::size_t>(span.row.length);
  }
  return triangles;
}

// A triangle at a time, as run_model does.
void model(benchmark::State& state, Evaluation evaluation) {
  const std::vector<Span> spans = spans_of_length(state.range(0));
  const std::vector<SpansOfTriangle> triangles = by_triangle(spans);
  std::size_t most = 0;
  for (const SpansOfTriangle& triangle : triangles) most = std::max(most, triangle.pixels);
  PixelDatapath datapath(pawn().frame.configuration, evaluation);
  datapath.load_table(pawn().table());
  std::vector<std::uint32_t> colors(most + PixelDatapath::kLanes);
  for (auto _ : state) {
    for (const SpansOfTriangle& triangle : triangles) {
      datapath.shade(triangle.first, triangle.count, colors.data());
      benchmark::DoNotOptimize(colors.data());
      benchmark::ClobberMemory();
    }
  }
  count_pixels(state, spans);
}

void lengths(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(kOwnLength)->Arg(64)->Unit(benchmark::kMillisecond);
}
BENCHMARK(phong_in_double)->Apply(lengths);
BENCHMARK_CAPTURE(model, stepping, Evaluation::stepping)->Apply(lengths);
BENCHMARK_CAPTURE(model, portable, Evaluation::portable)->Apply(lengths);
BENCHMARK_CAPTURE(model, best, best_evaluation())->Apply(lengths);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
