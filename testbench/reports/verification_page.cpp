#include "testbench/reports/verification_page.h"

#include <fmt/format.h>

#include "testbench/reports/campaign_page.h"

namespace phongpipe {

void VerificationPage::add(const RunRequest& request, const VerificationResult& result,
                           const std::array<std::filesystem::path, 3>& pictures) {
  put(request, phongpipe::summary_of(result));
  const auto beside = [](const std::filesystem::path& file) { return file.filename().string(); };
  pictures_[runs_.back().identity] = {{"result", {}, beside(pictures[0])},
                                      {"exact Phong", {}, beside(pictures[1])},
                                      {"error map", {}, beside(pictures[2])}};
}

void VerificationPage::add_picture(const std::string& label, const std::filesystem::path& file) {
  pictures_[runs_.back().identity].push_back({label, {}, file.filename().string()});
}

void VerificationPage::add_refused(const RunRequest& request, const std::string& why) {
  put(request, refused(why));
}

void VerificationPage::put(const RunRequest& request, RunResult result) {
  StoredRun& run = runs_.emplace_back();
  run.identity = fmt::format("{:08}", runs_.size());  // the order in which they were given
  run.command = command_of(request);
  run.scene = request.scene;
  run.hardware = request.hardware;
  run.result = std::move(result);
}

std::string VerificationPage::text() const {
  Store store(Store::kInMemory, Store::Access::write, "verification");
  store.put(runs_);
  ResultTable table = store.table();
  // Only campaigns measure it.
  const auto seconds = static_cast<std::ptrdiff_t>(table.column("seconds"));
  table.columns.erase(table.columns.begin() + seconds);
  for (auto& row : table.rows) row.erase(row.begin() + seconds);
  PageContent page = campaign_page(
      table, runs_.size() == 1 ? runs_.front().scene + ": verification" : "Verification", false);
  page.row = "scene";
  page.summary.pop_back();  // each scene is told of below
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto pictures = pictures_.find(table.text(row, "identity"));
    if (pictures != pictures_.end()) page.pictures[row] = pictures->second;
    const std::string message = table.text(row, "message");
    page.summary.push_back(message.empty()
                               ? fmt::format("{}: {:.2f} ns a pixel, at most {:.2f} LSB",
                                             table.text(row, "scene"),
                                             table.number(row, "frame_ns_per_pixel").value_or(0),
                                             table.number(row, "max_lsb").value_or(0))
                               : fmt::format("{}: {}: {}", table.text(row, "scene"),
                                             table.text(row, "outcome"), message));
  }
  return result_page(page);
}

}  // namespace phongpipe
