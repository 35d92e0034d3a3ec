// Verified scenes as a page: their metrics and pictures.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "testbench/reports/result_page.h"

namespace phongpipe {

class VerificationPage {
 public:
  // A result, and the files of WrittenPictures, which belong into the page's folder.
  void add(const RunRequest& request, const VerificationResult& result,
           const std::array<std::filesystem::path, 3>& pictures);
  // One more picture of the last result, a file in the page's folder.
  void add_picture(const std::string& label, const std::filesystem::path& file);
  // A scene that cannot be verified.
  void add_refused(const RunRequest& request, const std::string& why);
  std::string text() const;

 private:
  void put(const RunRequest& request, RunResult result);

  std::vector<StoredRun> runs_;
  std::map<std::string, std::vector<PagePicture>> pictures_;  // by the identity of the run
};

}  // namespace phongpipe
