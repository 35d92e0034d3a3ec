#include "testbench/reports/campaign_report.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "testbench/campaign/pareto.h"
#include "testbench/cosim/metrics_json.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

// ", 3 failed" for each outcome that occurred.
std::string outcomes(const CampaignProgress& p) {
  std::string text;
  for (const Outcome outcome :
       {Outcome::failed, Outcome::crashed, Outcome::timed_out, Outcome::refused}) {
    if (const std::uint64_t count = p.done[outcome]) {
      text += fmt::format(", {} {}", count_text(count), words_of(outcome));
    }
  }
  return text;
}

std::string duration(double seconds) {
  if (seconds < 100) return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 1 : 0);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

// The keys by which the rows of a table differ. What differs between scenes is in their names.
std::vector<std::string> varied_keys(const ResultTable& table,
                                     const std::vector<std::string>& keys) {
  std::vector<std::string> varied;
  for (const std::string& key : keys) {
    if (key == "scene" || is_scene_key(key)) continue;
    for (std::size_t row = 1; row < table.rows.size(); ++row) {
      if (table.text(row, key) == table.text(0, key)) continue;
      varied.push_back(key);
      break;
    }
  }
  return varied;
}

// A line for each point of the front, without those as good as the one before; of several scenes
// the first and the last. "…" stands for the others.
void add_front(std::string& text, const Store& store) {
  const ResultTable table = store.table();
  const std::vector<std::string> keys = varied_keys(table, store.keys());
  const auto fronts = fronts_by_scene(table);
  constexpr std::size_t kMostLines = 5;
  std::size_t scenes = 0;
  for (const auto& front : fronts) {
    if (++scenes > kMostLines) {
      text += "           …\n";
      return;
    }
    std::vector<std::string> lines;
    std::string before;
    for (const std::size_t row : front) {
      const std::string measures =
          fmt::format("{:.2f} ns a pixel, at most {:.2f} LSB",
                      *table.number(row, "frame_ns_per_pixel"), *table.number(row, "max_lsb"));
      if (measures == before) continue;
      before = measures;
      std::string& line = lines.emplace_back(measures + ":");
      for (const std::string& key : keys) {
        const std::string value = printable(table.text(row, key));
        line += fmt::format(" {}={}", key.substr(key.rfind('.') + 1), value);
      }
    }
    const std::size_t points = lines.size();
    const std::size_t most = fronts.size() > 1 ? 2 : kMostLines;
    if (lines.size() > most) {
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(most) - 1, lines.end() - 1);
      if (fronts.size() == 1) lines.insert(lines.end() - 1, "…");
    }
    text += fmt::format("  front    {}least error for its time at {}{}:\n",
                        fronts.size() > 1 ? printable(scene_text(table, front.front())) + ": " : "",
                        count_text(points, "point"),
                        front.size() > points ? fmt::format(", by {} runs", front.size()) : "");
    for (const std::string& line : lines) text += fmt::format("           {}\n", line);
  }
}

// Failures are compared by the pixels that they shaded, then by the settings that they name.
std::pair<double, std::size_t> size_of(const StoredRun& run) {
  static const std::size_t pixels = metric_index("pixels");
  const bool has_metrics = !run.result.metrics.empty();
  return {has_metrics ? *number_of(run.result.metrics[pixels]) : std::numeric_limits<double>::max(),
          run.command.size()};
}

// Failures by bucket; of each the smallest, with the command that shows it again.
void add_failures(std::string& text, const CampaignResult& result) {
  std::map<std::string, std::vector<const StoredRun*>> buckets;
  for (const StoredRun& run : result.not_passed) buckets[run.result.bucket].push_back(&run);
  for (const auto& [bucket, runs] : buckets) {
    const StoredRun& smallest = **std::min_element(
        runs.begin(), runs.end(),
        [](const StoredRun* a, const StoredRun* b) { return size_of(*a) < size_of(*b); });
    text += fmt::format("  {:<8} {} × {}: {}\n", name(smallest.result.outcome), runs.size(), bucket,
                        printable(smallest.result.message));
    text += fmt::format("    again  {}\n", printable(smallest.command));
  }
}

// Why runs were refused.
void add_refusals(std::string& text, const CampaignResult& result) {
  constexpr std::size_t kMostLines = 3;
  std::size_t lines = 0;
  for (const auto& [reason, count] : result.refusals) {
    if (++lines > kMostLines) {
      text += "           …\n";
      return;
    }
    text += fmt::format("  refused  {} × {}\n", count_text(count), printable(reason));
  }
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string progress_line(const CampaignProgress& p) {
  const std::uint64_t done = p.done.all(), left = p.left();
  std::string text =
      fmt::format("{} of {}{}", count_text(p.total - left), count_text(p.total), outcomes(p));
  if (done > 0 && p.seconds > 0) {
    const double rate = static_cast<double>(done) / p.seconds;
    text +=
        fmt::format(", {:.1f} a second, {} left", rate, duration(static_cast<double>(left) / rate));
  }
  if (p.best) {
    text += fmt::format("; best so far {:.2f} LSB at {:.2f} ns", p.best->max_lsb,
                        p.best->frame_ns_per_pixel);
  }
  return text;
}

std::string campaign_text(const CampaignResult& result, const Store& store, const std::string& file,
                          bool color) {
  const CampaignProgress& p = result.progress;
  const bool good = p.failures() == 0 && !result.interrupted;
  std::string verdict = result.interrupted ? "STOPPED" : p.failures() > 0 ? "FAILED" : "PASSED";
  if (color) {
    verdict = fmt::format(
        fmt::emphasis::bold | fmt::fg(good ? fmt::terminal_color::green : fmt::terminal_color::red),
        "{}", verdict);
  }
  std::vector<std::string> parts;
  const bool all_known = p.known.all() == p.total;
  if (!all_known) {
    parts.push_back(fmt::format("{} of {} runs passed{}", count_text(p.done[Outcome::passed]),
                                count_text(p.total - p.known.all()), outcomes(p)));
  }
  if (p.known.all() > 0) {
    parts.push_back(
        fmt::format("{}{} were known", all_known ? "all " : "", count_text(p.known.all())));
  }
  if (p.known.failures() > 0) {
    parts.back() += fmt::format(", {} of them failed", count_text(p.known.failures()));
    parts.emplace_back("--retry-failed does these again");
  }
  parts.push_back(duration(p.seconds));
  std::string text = fmt::format("{} {}  {}\n", verdict, store.kind(), fmt::join(parts, "; "));
  add_failures(text, result);
  add_refusals(text, result);
  if (store.kind() == "sweep") add_front(text, store);
  if (file == Store::kInMemory) return text;
  if (result.interrupted) {
    text +=
        fmt::format("  go on    the same command does the other {} runs\n", count_text(p.left()));
  }
  text +=
      fmt::format("  more     phongpipe export {0} --csv -, phongpipe report {0} -o report.html\n",
                  printable(file));
  return text;
}

std::string table_csv(const ResultTable& table) {
  std::string text;
  const auto add_row = [&text](const auto& row, auto cell_text) {
    bool first = true;
    for (const auto& cell : row) {
      if (!first) text += ',';
      first = false;
      text += csv_cell(cell_text(cell));
    }
    text += '\n';
  };
  add_row(table.columns, [](const std::string& name) { return name; });
  for (const auto& row : table.rows) add_row(row, exact_text);
  return text;
}

std::string table_json(const ResultTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json json;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (const auto* text = std::get_if<std::string>(&row[i])) {
        json[table.columns[i]] = printable(*text);
      } else {
        json[table.columns[i]] = std::get<MetricValue>(row[i]);
      }
    }
    rows.push_back(std::move(json));
  }
  return rows.dump(2) + "\n";
}

}  // namespace phongpipe
