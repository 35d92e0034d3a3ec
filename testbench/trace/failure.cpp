#include "testbench/trace/failure.h"

#include <algorithm>

#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"
#include "testbench/trace/capsule.h"
#include "testbench/trace/views.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// The cycle of the first difference.
std::int64_t cycle_of(const VerificationResult& r) {
  const ImplementationResult& found = *r.diverging();
  return found.signal_divergence ? found.signal_divergence->cycle : found.first_divergence->cycle;
}

void write_trace(const std::shared_ptr<const PreparedScene>& scene, const VerificationResult& r,
                 const fs::path& file) {
  const PreparedFrame frame(scene, r.hardware.formats, r.hardware.setup,
                            simulated_effects(r.options));
  RtlBuildOptions build;
  build.build = RtlBuild::signals;
  build.sources = r.options.rtl_sources;
  const RtlLibrary library(frame.setup.configuration, build);
  constexpr std::int64_t kMargin = 64;
  const std::int64_t cycle = cycle_of(r);
  const CycleWindow window = {std::max<std::int64_t>(cycle - kMargin, 0), cycle + kMargin};
  TraceOptions options;
  options.simulation = simulation_options(r.options);
  options.rtl_drives = true;
  RecordedTrace trace =
      record_trace(frame, r.hardware, library, {window}, TraceTarget(), options, file);
  trace.markers.push_back({"differs", cycle});
  fs::path view = file;
  write_text(view.replace_extension(".gtkw"), gtkwave_view(trace, window, file));
  write_text(view.replace_extension(".sucl"), surfer_view(trace));
}

}  // namespace

FailureFiles write_failure(const std::shared_ptr<const PreparedScene>& scene,
                           const VerificationResult& result, const fs::path& folder,
                           const std::string& name) {
  FailureFiles files;
  if (result.diverging() == nullptr) return files;
  make_folder(folder);
  files.capsule = folder / (name + ".toml");
  write_text(files.capsule, capsule_text(scene->scene, result));
  try {
    files.trace = folder / (name + ".fst");
    write_trace(scene, result, files.trace);
  } catch (const ToolError&) {
    files.trace.clear();
  }
  return files;
}

}  // namespace phongpipe
