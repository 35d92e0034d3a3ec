// What a verification says: on the screen, and as JSON for programs.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "testbench/cosim/verification.h"

namespace phongpipe {

std::string report_text(const Verification& v, bool color);
nlohmann::ordered_json report_json(const Verification& v);

}  // namespace phongpipe
