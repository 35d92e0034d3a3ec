// The result of a verification as JSON, for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "testbench/cosim/verification.h"

namespace phongpipe {

// `capsule`: file that shows its divergence again, or empty.
nlohmann::ordered_json report_json(const VerificationResult& result,
                                   const std::string& capsule = {});

}  // namespace phongpipe
