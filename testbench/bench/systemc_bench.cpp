// The pawn's frame in SystemC, by the span and by the clock; and how the time of the whole grows with
// pixels and with triangles. Every simulation is a process of its own, started for it.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "sim/pipeline.h"
#include "testbench/bench/pawn_frame.h"
#include "testbench/process.h"

namespace phongpipe {
namespace {

void simulate_frame(benchmark::State& state, const PawnFrame& pawn, Detail detail) {
  for (auto _ : state) {
    Child child([&] {
      SimulationOptions options;
      options.detail = detail;
      return fmt::format(
          "{}", simulate(pawn.frame, pawn.geometry, pawn.hardware.pipeline, options).frame_cycles);
    });
    state.counters["cycles"] = std::stod(child.get());
  }
  state.counters["triangles"] = static_cast<double>(pawn.geometry.triangles.size());
  state.SetItemsProcessed(state.iterations() * pawn.pixels);
}

void by_span(benchmark::State& state) { simulate_frame(state, pawn(), Detail::span); }
void by_clock(benchmark::State& state) { simulate_frame(state, pawn(), Detail::cycle); }

void by_span_at_size(benchmark::State& state) {
  simulate_frame(state, PawnFrame(static_cast<int>(state.range(0))), Detail::span);
}

void model_at_size(benchmark::State& state) {
  const PawnFrame frame(static_cast<int>(state.range(0)));
  for (auto _ : state) {
    benchmark::DoNotOptimize(run_model(frame.frame, frame.geometry).stream.size());
  }
  state.SetItemsProcessed(state.iterations() * frame.pixels);
}

// The wall clock: the work is done in the children.
BENCHMARK(by_span)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(by_clock)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(by_span_at_size)->RangeMultiplier(2)->Range(256, 4096)->Unit(benchmark::kMillisecond)
    ->UseRealTime();
BENCHMARK(model_at_size)->RangeMultiplier(2)->Range(256, 4096)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace phongpipe

BENCHMARK_MAIN();
