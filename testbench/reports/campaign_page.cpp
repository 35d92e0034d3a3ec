#include "testbench/reports/campaign_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <set>

#include "model/scene/input_error.h"
#include "testbench/campaign/pareto.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

constexpr const char* kTime = "frame_ns_per_pixel";
constexpr const char* kError = "max_lsb";

// The hardware of a row, as its command gives it.
class HardwareOfRows {
 public:
  // Empty if it is not legal, or its files are gone.
  std::optional<Hardware> operator()(const std::string& command) {
    try {
      const RunRequest request = parse_command(command);
      auto preset = presets_.find(request.hardware);
      if (preset == presets_.end()) {
        preset = presets_.emplace(request.hardware, load_hardware(request.hardware, {})).first;
      }
      return override_hardware(preset->second, request.settings);
    } catch (const InputError&) {
      return std::nullopt;
    }
  }

 private:
  std::map<std::string, Hardware> presets_;
};

Cell setting_cell(const Setting<Hardware>& setting, const Hardware& hardware) {
  if (!setting.choices.empty()) return setting.value(hardware);
  if (setting.per_unit > 1) return MetricValue(setting.in_units(setting.get(hardware)));
  return MetricValue(static_cast<std::int64_t>(setting.get(hardware)));
}

// "rom_address_bits=6 diffuse_fraction_bits=8": what varies in the table, for one row.
std::string settings_text(const ResultTable& table, std::size_t row) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const PageColumn column = page_column(table.columns[i]);
    const bool chosen =
        column.kind == PageColumn::Kind::setting || column.kind == PageColumn::Kind::input;
    if (!chosen) continue;
    const auto differs = [&](const auto& other) { return other[i] != table.rows.front()[i]; };
    const std::string value = exact_text(table.rows[row][i]);
    if (value.empty() || column.name == "scene") continue;
    if (std::none_of(table.rows.begin(), table.rows.end(), differs)) continue;
    texts.push_back(fmt::format("{}={}", column.name.substr(column.name.rfind('.') + 1), value));
  }
  return fmt::format("{}", fmt::join(texts, " "));
}

std::string measures_text(const ResultTable& table, std::size_t row) {
  const std::string settings = settings_text(table, row);
  return fmt::format("{:.2f} ns a pixel with at most {:.2f} LSB{}", *table.number(row, kTime),
                     *table.number(row, kError), settings.empty() ? "" : " (" + settings + ")");
}

std::string front_text(const ResultTable& table, const std::vector<std::size_t>& front) {
  std::set<std::string> different;
  for (const std::size_t row : front) {
    different.insert(table.text(row, kTime) + " " + table.text(row, kError));
  }
  const std::string fastest = measures_text(table, front.front());
  if (different.size() == 1) return fmt::format("Best in both time and error: {}.", fastest);
  return fmt::format("Best trade-offs, {} in all: fastest {}; most accurate {}.",
                     count_text(different.size()), fastest, measures_text(table, front.back()));
}

// Of each scene that has runs that passed.
std::vector<std::string> front_texts(const ResultTable& table) {
  std::vector<std::string> texts;
  const auto fronts = fronts_by_scene(table);
  for (const auto& front : fronts) {
    const std::string scene = fronts.size() > 1 ? scene_text(table, front.front()) + ": " : "";
    texts.push_back(scene + front_text(table, front));
  }
  if (texts.empty()) texts.emplace_back("Best trade-offs: none, for no run passed.");
  return texts;
}

// The runs to look at where there is no front.
std::string extremes_text(const ResultTable& table) {
  const auto largest = [&](const char* name) {
    std::optional<std::size_t> found;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      const auto value = table.number(row, name);
      if (value && (!found || *value > *table.number(*found, name))) found = row;
    }
    return found;
  };
  const auto slowest = largest(kTime), least_accurate = largest(kError);
  if (!slowest || !least_accurate) return "No run has a result.";
  return fmt::format("Slowest: {:.2f} ns a pixel ({}). Largest error: {:.2f} LSB ({}).",
                     *table.number(*slowest, kTime), table.text(*slowest, "scene"),
                     *table.number(*least_accurate, kError), table.text(*least_accurate, "scene"));
}

std::vector<std::string> summary_of(const ResultTable& table, bool alternatives) {
  std::map<std::string, std::size_t> outcomes;
  std::set<std::string> scenes;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    ++outcomes[table.text(row, "outcome")];
    scenes.insert(table.text(row, "scene"));
  }
  std::vector<std::string> counts;
  for (const Outcome outcome :
       {Outcome::passed, Outcome::failed, Outcome::refused, Outcome::crashed, Outcome::timed_out}) {
    const std::size_t count = outcomes[std::string(name(outcome))];
    const bool always = outcome <= Outcome::refused;
    if (!always && count == 0) continue;
    counts.push_back(fmt::format("{} {}", count_text(count), words_of(outcome)));
  }
  std::vector<std::string> lines =
      alternatives ? front_texts(table) : std::vector<std::string>{extremes_text(table)};
  const std::size_t runs = table.rows.size();
  const std::string of_what =
      scenes.size() == 1 ? *scenes.begin() : count_text(scenes.size(), "scene");
  lines.insert(lines.begin(), {fmt::format("{} of {}.", count_text(runs, "run"), of_what),
                               fmt::format("{}.", fmt::join(counts, ", "))});
  return lines;
}

}  // namespace

PageContent campaign_page(const ResultTable& table, const std::string& title, bool alternatives) {
  PageContent page;
  page.title = title;
  page.summary = summary_of(table, alternatives);
  page.alternatives = alternatives;
  page.logarithmic = !alternatives;  // different scenes may differ by orders of magnitude
  page.x = kTime;
  page.y = kError;
  page.rows.resize(table.rows.size());
  const auto add_column = [&](const std::string& name, const auto& cell_of) {
    page.columns.push_back(page_column(name));
    for (std::size_t row = 0; row < page.rows.size(); ++row) page.rows[row].push_back(cell_of(row));
  };
  const auto add_stored = [&](std::size_t i) {
    add_column(table.columns[i], [&](std::size_t row) { return table.rows[row][i]; });
  };
  HardwareOfRows hardware_of;
  std::vector<std::optional<Hardware>> hardware;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    page.commands.push_back(table.text(row, "command"));
    hardware.push_back(hardware_of(page.commands.back()));
  }
  // A setting that varies is stored, also where it was refused.
  const auto stored = [&](const std::string& name, std::size_t row) -> Cell {
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    return found == table.columns.end() ? Cell(MetricValue()) : table.rows[row][table.column(name)];
  };
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const PageColumn::Kind kind = page_column(table.columns[i]).kind;
    const bool left_out = table.columns[i] == "identity" || table.columns[i] == "command";
    if (kind != PageColumn::Kind::setting && !left_out) add_stored(i);
  }
  for (const Setting<Hardware>& setting : hardware_settings()) {
    add_column(setting.name(), [&](std::size_t row) {
      return hardware[row] ? setting_cell(setting, *hardware[row]) : stored(setting.name(), row);
    });
  }
  add_column("technology", [&](std::size_t row) {
    return hardware[row] ? Cell(hardware[row]->technology.name) : stored("technology", row);
  });
  return page;
}

Chart front_chart(const ResultTable& table, const std::string& title, bool alternatives) {
  const auto label = [](const char* name) {
    const PageColumn column = page_column(name);
    return fmt::format("{}, {}", column.meaning, column.unit);
  };
  const auto point = [&](std::size_t row) {
    return PlotPoint{*table.number(row, kTime), *table.number(row, kError), ""};
  };
  Chart chart;
  chart.title = title;
  chart.x_label = label(kTime);
  chart.y_label = label(kError);
  std::set<std::size_t> on_front;
  const auto fronts =
      alternatives ? fronts_by_scene(table) : std::vector<std::vector<std::size_t>>{};
  for (const auto& front : fronts) {
    PlotSeries series = {"Pareto front", {}};
    if (fronts.size() > 1) series.name += " of " + scene_text(table, front.front());
    for (const std::size_t row : front) series.points.push_back(point(row));
    on_front.insert(front.begin(), front.end());
    chart.series.push_back(std::move(series));
  }
  PlotSeries others = {fronts.empty() ? "runs that passed" : "other runs that passed", {}, false};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const bool passed = table.text(row, "outcome") == "passed";
    if (passed && on_front.count(row) == 0) others.points.push_back(point(row));
  }
  chart.series.push_back(std::move(others));
  return chart;
}

}  // namespace phongpipe
