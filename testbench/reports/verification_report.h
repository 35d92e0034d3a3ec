// Reports of a verification: on the screen, and as pictures.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "testbench/cosim/verification.h"
#include "testbench/system/process.h"

namespace phongpipe {

// Style of a report on the screen.
struct ReportStyle {
  bool color = false;
  bool verbose = false;
  std::string command;            // that verifies the same, or empty
  std::vector<std::string> more;  // files that were written, for the last line
};

// The answer in five lines, or in one line for one of several results; failures are shown in
// detail. With `verbose`, all measurements follow.
std::string report_text(const VerificationResult& result, const ReportStyle& style);
std::string report_line(const VerificationResult& result, const ReportStyle& style);

// name-result.png, name-exact.png and name-error.png.
std::array<std::filesystem::path, 3> picture_files(const std::filesystem::path& folder,
                                                   const std::string& name);
// Writes the pictures of a result, in child processes that start at once.
class WrittenPictures {
 public:
  WrittenPictures(const VerificationResult& result,
                  const std::array<std::filesystem::path, 3>& files);
  void wait();  // call it once; throws what the children throw

 private:
  Child colors_, errors_;
};

}  // namespace phongpipe
