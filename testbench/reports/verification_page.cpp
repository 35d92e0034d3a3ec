#include "testbench/reports/verification_page.h"

#include <fmt/format.h>

#include "testbench/reports/campaign_page.h"

namespace phongpipe {
namespace {

// What came of a scene.
std::string line_of(const ResultTable& table, std::size_t row) {
  const std::string scene = table.text(row, "scene"), outcome = table.text(row, "outcome");
  const std::string message = table.text(row, "message");
  if (message.empty()) {
    return fmt::format("{}: {:.2f} ns a pixel, at most {:.2f} LSB", scene,
                       table.number(row, "frame_ns_per_pixel").value_or(0),
                       table.number(row, "max_lsb").value_or(0));
  }
  if (outcome == name(Outcome::passed)) return fmt::format("{}: {}", scene, message);
  return fmt::format("{}: {}: {}", scene, outcome, message);
}

}  // namespace

void VerificationPage::add_pictures(const std::array<std::filesystem::path, 3>& files) {
  const char* const labels[] = {"result", "exact Phong", "error map"};
  for (std::size_t i = 0; i < files.size(); ++i) add_picture(labels[i], files[i]);
}

void VerificationPage::add_picture(const std::string& label, const std::filesystem::path& file) {
  pictures_[runs_.back().identity].push_back({label, {}, file.filename().string()});
}

void VerificationPage::add(const std::string& name, const std::string& hardware,
                           const std::string& command, RunResult result) {
  StoredRun& run = runs_.emplace_back();
  run.identity = fmt::format("{:08}", runs_.size());  // the order in which they were given
  run.command = command;
  run.scene = name;
  run.hardware = hardware;
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
      table, runs_.size() == 1 ? runs_.front().scene + ": verification" : title_, false);
  page.row = row_;
  // The graph must be in sight.
  constexpr std::size_t kFew = 8;
  const bool few = runs_.size() <= kFew;
  if (few) page.summary.pop_back();  // each scene is told of below
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto pictures = pictures_.find(table.text(row, "identity"));
    if (pictures != pictures_.end()) page.pictures[row] = pictures->second;
    const std::string line = line_of(table, row);
    if (few) {
      page.summary.push_back(line);
    } else {
      page.details += line + "\n";
    }
  }
  return result_page(page);
}

}  // namespace phongpipe
