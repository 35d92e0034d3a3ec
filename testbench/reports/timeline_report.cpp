#include "testbench/reports/timeline_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "testbench/cosim/metrics.h"
#include "testbench/drawing/plot_axis.h"
#include "testbench/drawing/plot_labels.h"
#include "testbench/system/markup.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

using nlohmann::ordered_json;

// One event after the other, since there may be millions.
class Trace {
 public:
  void add(const ordered_json& event) {
    text_ += text_.empty() ? "{\"traceEvents\":[\n" : ",\n";
    text_ += event.dump();
  }
  void add_name(const char* what, int thread, std::string_view name) {
    add({{"ph", "M"}, {"name", what}, {"pid", 1}, {"tid", thread}, {"args", {{"name", name}}}});
  }
  // Call it once.
  std::string text() {
    text_ += "\n]}\n";
    return std::move(text_);
  }

 private:
  std::string text_;
};

int thread_of(Module module) {
  return static_cast<int>(module) + 1;
}

std::string_view queue_before(Module module) {
  constexpr std::string_view kQueues[] = {"", "triangles", "spans", "pixels"};
  return kQueues[static_cast<std::size_t>(module)];
}

void add_module(Trace& trace, const Timeline& timeline, Module module) {
  trace.add_name("thread_name", thread_of(module), name(module));
  timeline.for_each_run(module, [&](ModuleState state, std::uint32_t triangle, std::int64_t start,
                                    std::int64_t cycles) {
    ordered_json event = {{"ph", "X"},   {"pid", 1},      {"tid", thread_of(module)},
                          {"ts", start}, {"dur", cycles}, {"name", state_text(module, state)}};
    if (state == ModuleState::busy) event["args"]["triangle"] = triangle;
    trace.add(event);
  });
  const ModuleActivity& activity = timeline.modules[static_cast<std::size_t>(module)];
  for (std::size_t i = 0; i < activity.fills.size(); ++i) {
    trace.add({{"ph", "C"},
               {"pid", 1},
               {"ts", activity.fill_cycles[i]},
               {"name", queue_before(module)},
               {"args", {{"items", activity.fills[i]}}}});
  }
}

// Different in brightness too, for print and for the colour-blind. In the order of ModuleState.
constexpr std::array<const char*, kModuleStates> kColors = {"#1f4e8c", "#c2418f", "#8fc1ea",
                                                            "#e8900c", "#d9d9d9", "#ffffff"};
constexpr double kWidth = 1120, kLeft = 130, kBarWidth = 960, kTop = 68;
constexpr double kBarHeight = 20, kBarRow = 56, kStripHeight = 44, kStripRow = 54;
constexpr double kModuleCount = kModules.size();
constexpr double kStripTop = kTop + kBarRow * kModuleCount + 34;
constexpr double kHeight = kStripTop + kStripRow * kModuleCount + 48;
constexpr std::int64_t kColumns = 240;  // of a strip, each a part of the frame

using Column = std::array<double, kModuleStates>;  // the shares of the states

// What the module does over the frame, column by column.
std::vector<Column> columns_of(const Timeline& timeline, Module module) {
  const std::int64_t count = std::min(kColumns, timeline.frame_cycles);
  const auto edge = [&](std::int64_t column) { return column * timeline.frame_cycles / count; };
  std::vector<Column> columns(static_cast<std::size_t>(count), Column{});
  std::int64_t column = 0;
  timeline.for_each_run(
      module, [&](ModuleState state, std::uint32_t, std::int64_t start, std::int64_t cycles) {
        for (std::int64_t at = start; at < start + cycles;) {
          while (edge(column + 1) <= at) ++column;
          const std::int64_t end = std::min(start + cycles, edge(column + 1));
          columns[static_cast<std::size_t>(column)][static_cast<std::size_t>(state)] +=
              static_cast<double>(end - at) / static_cast<double>(edge(column + 1) - edge(column));
          at = end;
        }
      });
  return columns;
}

class Drawing {
 public:
  Drawing(const Timeline& timeline, std::string scene)
      : timeline_(timeline), scene_(std::move(scene)) {}

  std::string text() {
    const Module limiting = limiting_module(timeline_);
    const std::string title = fmt::format("{}: limited by {}", scene_, name(limiting));
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0:.0f}" height="{1:.0f}" )"
        R"(viewBox="0 0 {0:.0f} {1:.0f}" font-family="sans-serif" font-size="11" fill="#222">)"
        "\n<title>{2}</title>\n"
        R"(<rect width="100%" height="100%" fill="white"/>)"
        "\n",
        kWidth, kHeight, markup_text(title));
    add_text(20, 28, "font-size=\"16\" font-weight=\"bold\"", title);
    add_text(20, 48, "font-size=\"13\"",
             fmt::format("It works in {} of the frame's {} cycles. Share of the cycles:",
                         percent(working_cycles(state_cycles(timeline_, limiting))),
                         metric_text(timeline_.frame_cycles)));
    for (const Module module : kModules) add_bar(module, module == limiting);
    add_text(20, kStripTop - 14, "font-size=\"13\"",
             "Over the frame, from the first cycle to the last:");
    for (const Module module : kModules) add_strip(module);
    add_axis();
    return out_ + "</svg>\n";
  }

 private:
  template <typename... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
  }
  void add_text(double x, double y, std::string_view style, std::string_view text) {
    add("<text x=\"{:.1f}\" y=\"{:.1f}\" {}>{}</text>\n", x, y, style, markup_text(text));
  }
  void add_box(double x, double y, double width, double height, const char* color) {
    add("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\" fill=\"{}\"/>\n", x, y,
        width, height, color);
  }
  void add_frame(double x, double y, double width, double height) {
    add("<rect x=\"{:.2f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.1f}\" fill=\"none\" "
        "stroke=\"#444\"/>\n",
        x, y, width, height);
  }

  double share(std::int64_t cycles) const {
    return static_cast<double>(cycles) / static_cast<double>(timeline_.frame_cycles);
  }
  std::string percent(std::int64_t cycles) const {
    const double percent = 100 * share(cycles);
    if (percent < 0.1) return "<0.1 %";
    return percent > 99.9 && percent < 100 ? ">99.9 %" : fmt::format("{:.1f} %", percent);
  }

  // The shares of the module's states, and each in words below.
  void add_bar(Module module, bool limiting) {
    const double top = kTop + kBarRow * static_cast<double>(module);
    add_text(kLeft - 10, top + 14, limiting ? kBoldName : kName, name(module));
    const StateCycles cycles = state_cycles(timeline_, module);
    double x = kLeft, entry = kLeft;
    for (std::size_t state = 0; state < kModuleStates; ++state) {
      if (cycles[state] == 0) continue;
      const double width = kBarWidth * share(cycles[state]);
      add_box(x, top, width, kBarHeight, kColors[state]);
      x += width;
      const std::string text = fmt::format(
          "{} {}", state_text(module, static_cast<ModuleState>(state)), percent(cycles[state]));
      add_box(entry, top + kBarHeight + 6, 10, 10, kColors[state]);
      add_frame(entry, top + kBarHeight + 6, 10, 10);
      add_text(entry + 14, top + kBarHeight + 15, "", text);
      entry += text_width(text) + 24;
    }
    add_frame(kLeft, top, kBarWidth, kBarHeight);
  }

  double across(std::int64_t cycle) const { return kLeft + kBarWidth * share(cycle); }

  // The same over time: of each column, the height of a colour is the state's share.
  void add_strip(Module module) {
    const double top = kStripTop + kStripRow * static_cast<double>(module);
    add_text(kLeft - 10, top + kStripHeight / 2 + 4, kName, name(module));
    const std::vector<Column> columns = columns_of(timeline_, module);
    const auto edge = [&columns](std::size_t i) {
      return kLeft + kBarWidth * static_cast<double>(i) / static_cast<double>(columns.size());
    };
    std::vector<double> height(columns.size(), 0);  // that is filled, from below
    for (std::size_t state = 0; state < kModuleStates; ++state) {
      std::string path;
      for (std::size_t i = 0; i < columns.size(); ++i) {
        if (columns[i][state] == 0) continue;
        const double low = height[i];
        height[i] += kStripHeight * columns[i][state];
        // Neighbours get the same numbers for the edge between them, or there would be seams.
        fmt::format_to(std::back_inserter(path), "M{0:.2f} {1:.2f}H{2:.2f}V{3:.2f}H{0:.2f}z",
                       edge(i), top + kStripHeight - low, edge(i + 1),
                       top + kStripHeight - height[i]);
      }
      if (!path.empty()) {
        add("<path d=\"{}\" fill=\"{}\" shape-rendering=\"crispEdges\"/>\n", path, kColors[state]);
      }
    }
    add_frame(kLeft, top, kBarWidth, kStripHeight);
  }

  void add_axis() {
    const double bottom = kStripTop + kStripRow * kModuleCount - (kStripRow - kStripHeight);
    for (const double tick : axis_ticks(0, static_cast<double>(timeline_.frame_cycles), false)) {
      const auto cycle = static_cast<std::int64_t>(tick);
      if (cycle > timeline_.frame_cycles) continue;
      add("<path d=\"M{:.1f} {:.1f}v6\" stroke=\"#444\"/>\n", across(cycle), bottom);
      add_text(across(cycle), bottom + 18, "text-anchor=\"middle\"", metric_text(cycle));
    }
    add_text(kLeft + kBarWidth / 2, bottom + 36, "font-size=\"13\" text-anchor=\"middle\"",
             "cycle");
  }

  static constexpr std::string_view kName = "text-anchor=\"end\" font-size=\"12\"";
  static constexpr std::string_view kBoldName =
      "text-anchor=\"end\" font-size=\"12\" font-weight=\"bold\"";

  const Timeline& timeline_;
  std::string scene_;
  std::string out_;
};

}  // namespace

std::string timeline_json(const Timeline& timeline, const std::string& scene) {
  Trace trace;
  trace.add_name("process_name", 0, "SystemC");
  trace.add({{"ph", "M"},
             {"name", "process_labels"},
             {"pid", 1},
             {"args", {{"labels", printable(scene) + ", 1 cycle = 1 µs"}}}});
  for (const Module module : kModules) add_module(trace, timeline, module);
  return trace.text();
}

std::string timeline_picture(const Timeline& timeline, const std::string& scene) {
  return Drawing(timeline, printable(scene)).text();
}

}  // namespace phongpipe
