#include "testbench/campaign/batch.h"

#include <sys/resource.h>

#include <new>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/cosim/metrics_json.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/record_json.h"
#include "testbench/trace/capsule.h"

namespace phongpipe {
namespace {

void limit_memory([[maybe_unused]] int mib) {
#ifndef __SANITIZE_ADDRESS__  // which reserves terabytes of addresses
  rlimit limit{};
  limit.rlim_cur = limit.rlim_max = static_cast<rlim_t>(mib) << 20;
  setrlimit(RLIMIT_AS, &limit);
#endif
}

RunResult crashed(const std::string& message, const std::string& bucket) {
  RunResult result;
  result.outcome = Outcome::crashed;
  result.message = message;
  result.bucket = bucket;
  return result;
}

RunResult result_of(const ResolvedRun& run) {
  try {
    const VerificationResult result = verify(run.scene, run.hardware, run.options);
    RunResult summary = summary_of(result);
    if (result.diverging() != nullptr) {
      summary.capsule = capsule_text(run.scene->scene, result);
    }
    return summary;
  } catch (const InputError& error) {
    return refused(error.what());
  } catch (const std::bad_alloc&) {
    return crashed("out of memory", "memory");
  } catch (const ToolError& error) {
    return crashed(error.what(), "tool");
  } catch (const std::exception& error) {
    return crashed(error.what(), "exception");
  }
}

// Builds the RTL of all runs at once. A failure is left to the runs, which tell it.
void build_rtl_of(const std::vector<ResolvedRun>& runs) {
  std::vector<DatapathConfiguration> configurations;
  for (const ResolvedRun& run : runs) {
    if (run.options.rtl == RtlToVerify::off) continue;
    const Effects effects =
        run.options.effects == EffectsToVerify::all ? Effects::all : Effects::derived;
    const DatapathConfiguration configuration{
        run.hardware.formats,
        derive_blocks(run.hardware.formats, run.scene->scene, run.scene->geometry, effects)};
    configurations.push_back(rtl_configuration(configuration, run.options.rtl));
  }
  if (configurations.empty()) return;
  try {
    RtlBuildOptions options;
    // Native RTL runs once.
    if (runs.front().options.rtl == RtlToVerify::native) options.build = RtlBuild::quick;
    options.sources = runs.front().options.rtl_sources;
    build_missing_rtl(configurations, options);
  } catch (const std::exception&) {
  }
}

}  // namespace

std::unique_ptr<Worker> start_batch(const std::vector<ResolvedRun>& runs, int memory_mib,
                                    const volatile bool* stop) {
  return std::make_unique<Worker>([&runs, memory_mib, stop](const Worker::Send& send) {
    limit_memory(memory_mib);
    build_rtl_of(runs);
    for (const ResolvedRun& run : runs) {
      if (*stop) return;
      send(to_bytes(BatchMessage{false, run.index, {}}));
      send(to_bytes(BatchMessage{true, run.index, result_of(run)}));
    }
  });
}

BatchMessage to_batch_message(const std::string& bytes) {
  return from_bytes<BatchMessage>(bytes);
}

}  // namespace phongpipe
