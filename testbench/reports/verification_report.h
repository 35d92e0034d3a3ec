// What a verification says: on the screen, as JSON for programs, and as pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testbench/cosim/verification.h"

namespace phongpipe {

// Colours and words around a result.
struct ReportStyle {
  bool color = false;
  bool verbose = false;
  std::string command;            // that the result came from; without the scene
  std::vector<std::string> more;  // files that were written, for the last line
};

// The answer in five lines, or a line each where there are several; failures are expanded. With
// `verbose` all that was measured follows.
std::string report_text(const VerificationResult& result, const ReportStyle& style);
std::string report_line(const VerificationResult& result, const ReportStyle& style);

nlohmann::ordered_json report_json(const VerificationResult& result);

// Writes name-result.png, name-exact.png and name-error.png; returns the files.
std::vector<std::filesystem::path> write_pictures(const VerificationResult& result,
                                                  const std::filesystem::path& folder,
                                                  const std::string& name);

}  // namespace phongpipe
