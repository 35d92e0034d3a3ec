// What is written of a verification that failed because implementations differ.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "model/fixed/prepared_frame.h"
#include "testbench/cosim/verification.h"

namespace phongpipe {

// Files of one failure: the capsule, and the trace with its views, if there is one.
struct FailureFiles {
  std::filesystem::path capsule, trace;
};

// Where failures are kept if nobody says.
constexpr const char* kFailureFolder = "phongpipe-failures";

// Writes NAME.toml, the capsule, and NAME.fst with its views: what RTL and SystemC do around the
// first difference. Writes nothing and returns empty paths if all implementations agree. Throws as
// write_text() does. A trace that cannot be made is left out.
FailureFiles write_failure(const std::shared_ptr<const PreparedScene>& scene,
                           const VerificationResult& result, const std::filesystem::path& folder,
                           const std::string& name);

}  // namespace phongpipe
