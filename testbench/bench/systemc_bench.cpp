// The pawn's frame in SystemC, by the span and by the clock; and how the time of the whole grows
// with pixels and with triangles. Every simulation is a process of its own, which tells the
// processor time it took: that is what rates of the other benchmarks are by.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <ctime>
#include <sstream>

#include "sim/pipeline.h"
#include "testbench/bench/pawn_frame.h"
#include "testbench/cosim/stream_checker.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

void simulate_frame(benchmark::State& state, const PawnFrame& pawn, Detail detail) {
  for (auto _ : state) {
    Child child([&] {
      SimulationOptions options;
      options.detail = detail;
      StreamHash hash;  // as `verify` does
      options.observe = [&hash](const ShadedPixel* pixels, const std::int64_t* cycles,
                                std::size_t count) { hash.add(pixels, cycles, count); };
      const std::clock_t start = std::clock();
      const SimulationResult result = simulate(pawn.frame, pawn.hardware.pipeline, options);
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      benchmark::DoNotOptimize(hash);
      benchmark::DoNotOptimize(result.frame_cycles);
      return fmt::format("{}", seconds);
    });
    double seconds = 0;
    std::istringstream(child.get()) >> seconds;
    state.SetIterationTime(seconds);
  }
  state.SetItemsProcessed(state.iterations() * pawn.pixels);
}

void by_span(benchmark::State& state) {
  simulate_frame(state, pawn(), Detail::span);
}
void by_clock(benchmark::State& state) {
  simulate_frame(state, pawn(), Detail::cycle);
}

// A matt pawn, by hardware with the effects it needs and by one with all.
template <Effects kEffects, Detail kDetail>
void matt(benchmark::State& state) {
  Scene scene = PawnFrame::load(2048);
  for (Material& material : scene.materials) material.specular = Color::Zero();
  simulate_frame(state, PawnFrame(scene, "default", kEffects), kDetail);
}

void by_span_at_size(benchmark::State& state) {
  simulate_frame(state, PawnFrame(static_cast<int>(state.range(0))), Detail::span);
}

void model_at_size(benchmark::State& state) {
  const PawnFrame frame(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(run_model(frame.frame).pixels);
  }
  state.SetItemsProcessed(state.iterations() * frame.pixels);
}

BENCHMARK(by_span)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK(by_clock)->Unit(benchmark::kMillisecond)->UseManualTime();
BENCHMARK_TEMPLATE(matt, Effects::derived, Detail::span)
    ->Name("matt/derived/span")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_TEMPLATE(matt, Effects::all, Detail::span)
    ->Name("matt/all/span")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_TEMPLATE(matt, Effects::derived, Detail::cycle)
    ->Name("matt/derived/cycle")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK_TEMPLATE(matt, Effects::all, Detail::cycle)
    ->Name("matt/all/cycle")
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK(by_span_at_size)
    ->RangeMultiplier(2)
    ->Range(256, 4096)
    ->Unit(benchmark::kMillisecond)
    ->UseManualTime();
BENCHMARK(model_at_size)->RangeMultiplier(2)->Range(256, 4096)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
