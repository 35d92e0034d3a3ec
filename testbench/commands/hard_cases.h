// phongpipe verify --hard-cases: the corpus of hard cases.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace phongpipe {

struct HardCaseOptions {
  std::vector<std::string> names;  // of cases, or of folders of them; all if empty
  std::filesystem::path out;       // folder for the contact sheet and the page, or empty
  std::string json;
  std::filesystem::path rtl_sources;
  bool verbose = false;
};

// The exit status.
int verify_hard_cases(const HardCaseOptions& options);

}  // namespace phongpipe
