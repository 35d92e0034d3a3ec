#include "testbench/methods/hard_case_run.h"

#include <fmt/format.h>

#include <cmath>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/cases/guards.h"
#include "testbench/cases/named_scene.h"
#include "testbench/methods/real_frame.h"

namespace phongpipe {
namespace {

constexpr double kAnyTime = 1e9;  // ns a pixel: small scenes have few pixels to spread setup over

RunRequest request_of(const HardCase& hard_case) {
  RunRequest request;
  request.scene = hard_case.file.string();
  request.hardware = hard_case.hardware;
  request.settings = hard_case.settings;
  request.options.budget_ns = kAnyTime;
  request.options.max_error_lsb = hard_case.max_error_lsb;
  request.options.stall_percent = hard_case.stall_percent;
  request.options.rtl = RtlToVerify::superset;  // one for many cases
  return request;
}

// With one thing changed, without RTL.
VerificationResult verify_other(const HardCase& hard_case, const std::vector<std::string>& changes,
                                int stall_percent) {
  RunRequest request = request_of(hard_case);
  request.settings.insert(request.settings.end(), changes.begin(), changes.end());
  request.options.rtl = RtlToVerify::off;
  request.options.stall_percent = stall_percent;
  return verify(load_named_scene(request.scene, request.settings),
                load_hardware(request.hardware, request.settings), request.options);
}

std::uint64_t count_guarded(const HardCase& hard_case, const PreparedScene& scene,
                            const Hardware& hardware, const VerificationResult& result) {
  if (hard_case.guard == kSettings) {
    return verify_other(hard_case, hard_case.without, hard_case.stall_percent)
        .accuracy.pixels_over_limit;
  }
  if (hard_case.guard == kStalls) {
    const std::int64_t freely = verify_other(hard_case, {}, 0).systemc.counts.frame_cycles;
    return static_cast<std::uint64_t>(
        std::max<std::int64_t>(0, result.systemc.counts.frame_cycles - freely));
  }
  const Guard& guard = *find_guard(hard_case.guard);
  if (guard.count == nullptr) return 0;  // kRefusal, which has come this far
  const PreparedFrame frame(scene.scene, hardware.formats, hardware.setup);
  return guard.count({frame, run_model(frame.setup)});
}

// Every method that does not refuse the scene draws it, with numbers as colours.
void draw_by_all_methods(const PreparedScene& prepared, HardCaseResult& result) {
  const Scene& scene = prepared.scene;
  const Visibility visibility = find_visible(scene, prepared.geometry);
  const std::vector<Color> exact = render_phong(scene, prepared.geometry, visibility);
  for (const ShadingMethod& method : shading_methods()) {
    if (refusal(method, scene, prepared.geometry.materials)) continue;
    ++result.methods;
    const std::vector<Color> colors =
        render_method(scene, prepared.geometry, visibility, method, PowerKind::exact).colors;
    double largest = 0;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (!colors[i].isFinite().all()) {
        result.failure = fmt::format("{} draws a pixel that is no number", method.name);
        return;
      }
      largest = std::max(largest, (colors[i] - exact[i]).abs().maxCoeff());
    }
    if (largest < result.worst_method_lsb) continue;
    result.worst_method_lsb = largest;
    result.worst_method = method.name;
  }
}

// What does not hold of the verification, or empty.
std::string failure_of(const HardCase& hard_case, const VerificationResult& result) {
  if (hard_case.guard == "overflow") {
    if (!result.agrees()) return summary_of(result).message;
    return result.set_up.overflows > 0 ? "" : "no overflow is told";
  }
  return result.passed() ? "" : summary_of(result).message;
}

void verify_case(HardCaseResult& result, const std::filesystem::path& rtl_sources, bool pictures) {
  const HardCase& hard_case = result.hard_case;
  RunRequest request = request_of(hard_case);
  request.options.rtl_sources = rtl_sources;
  request.options.pictures = pictures;
  const auto scene =
      std::make_shared<const PreparedScene>(load_named_scene(request.scene, request.settings));
  const Hardware hardware = load_hardware(request.hardware, request.settings);
  result.verification = verify(scene, hardware, request.options);
  result.failure = failure_of(hard_case, *result.verification);
  if (!result.passed()) return;
  result.guarded = count_guarded(hard_case, *scene, hardware, *result.verification);
  if (result.guarded == 0) {
    result.failure = fmt::format("does not need its guard, {}", hard_case.guard);
    return;
  }
  draw_by_all_methods(*scene, result);
}

}  // namespace

std::string command_of(const HardCase& hard_case) {
  return fmt::format("phongpipe verify --hard-cases {} --verbose", hard_case.name);
}

HardCaseResult run_hard_case(const HardCase& hard_case, const std::filesystem::path& rtl_sources,
                             bool pictures) {
  HardCaseResult result;
  result.hard_case = hard_case;
  try {
    verify_case(result, rtl_sources, pictures);
    if (hard_case.guard == kRefusal) result.failure = "is not refused";
  } catch (const InputError& error) {
    result.refusal = error.what();
    // Where the program is installed is of no interest.
    if (const std::string file = hard_case.file.string(); starts_with(result.refusal, file)) {
      result.refusal.replace(0, file.size(), hard_case.file.filename().string());
    }
    if (hard_case.guard != kRefusal) {
      result.failure = "is refused: " + result.refusal;
    } else if (result.refusal.find(hard_case.refused) == std::string::npos) {
      result.failure = fmt::format("is refused with other words: {}", result.refusal);
    } else {
      result.guarded = 1;
    }
  }
  return result;
}

RunResult as_run(const HardCaseResult& result) {
  RunResult run = result.verification ? summary_of(*result.verification) : refused(result.refusal);
  if (!result.passed()) {
    if (run.outcome == Outcome::passed) run.outcome = Outcome::failed;
    run.message = result.failure;
  } else if (run.outcome != Outcome::passed) {
    run.message = fmt::format("{}, as expected: {}", run.bucket, run.message);
    run.outcome = Outcome::passed;
    run.bucket.clear();
  }
  return run;
}

}  // namespace phongpipe
