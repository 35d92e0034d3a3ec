// Verified scenes as a page: their metrics and pictures.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "testbench/reports/result_page.h"

namespace phongpipe {

class VerificationPage {
 public:
  // `row`: what a scene is called in the page.
  explicit VerificationPage(std::string title = "Verification", std::string row = "scene")
      : title_(std::move(title)), row_(std::move(row)) {}

  // `name`: of the scene.
  void add(const std::string& name, const std::string& hardware, const std::string& command,
           RunResult result);
  // Of the last result: the files of WrittenPictures, which belong into the page's folder.
  void add_pictures(const std::array<std::filesystem::path, 3>& files);
  // One more picture of it, a file in the page's folder.
  void add_picture(const std::string& label, const std::filesystem::path& file);
  std::string text() const;

 private:
  std::string title_, row_;
  std::vector<StoredRun> runs_;
  std::map<std::string, std::vector<PagePicture>> pictures_;  // by the identity of the run
};

}  // namespace phongpipe
