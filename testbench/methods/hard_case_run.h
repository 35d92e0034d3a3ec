// Runs of hard cases: model, SystemC and RTL are compared, the error is checked, every shading
// method that takes the scene draws it, and the guard is shown to be needed.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "testbench/cases/hard_case.h"
#include "testbench/cosim/run.h"

namespace phongpipe {

struct HardCaseResult {
  HardCase hard_case;
  std::string failure;        // what does not hold, or empty
  std::uint64_t guarded = 0;  // pixels, triangles, … that are other without the guard
  std::string refusal;        // the message with which the input is refused, or empty
  // None for input that is refused.
  std::optional<VerificationResult> verification;
  std::size_t methods = 0;        // shading methods that drew the scene
  std::string_view worst_method;  // of these, with the largest error
  double worst_method_lsb = 0;

  bool passed() const { return failure.empty(); }
};

// `rtl_sources`: as in VerificationOptions. Pictures are kept if wanted.
HardCaseResult run_hard_case(const HardCase& hard_case, const std::filesystem::path& rtl_sources,
                             bool pictures);

// The result as one of a run, whose metrics are kept: a case that ends as it must has passed, and
// the message tells how if that is not as other runs pass.
RunResult as_run(const HardCaseResult& result);

// The command that runs the case alone.
std::string command_of(const HardCase& hard_case);

}  // namespace phongpipe
