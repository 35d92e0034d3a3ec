#include "testbench/reports/hard_case_report.h"

#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>

#include "testbench/cases/guards.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

constexpr int kCell = 96;  // pixels of a picture's square
constexpr int kGap = 4;
constexpr int kAcross = 8;  // cases in a row

// Copies a picture into a square of the sheet, its pixels repeated to fill it.
void paste(const Picture& picture, int left, int top, Picture& sheet) {
  const int larger = std::max(picture.width, picture.height);
  for (int y = 0; y < kCell; ++y) {
    for (int x = 0; x < kCell; ++x) {
      const int from_x = x * larger / kCell, from_y = y * larger / kCell;
      if (from_x >= picture.width || from_y >= picture.height) continue;
      const int from_pixel = from_y * picture.width + from_x;
      const int to_pixel = (top + y) * sheet.width + left + x;
      const Rgb color = picture.color(static_cast<std::size_t>(from_pixel));
      std::copy(color.begin(), color.end(), sheet.pixel(static_cast<std::size_t>(to_pixel)));
    }
  }
}

}  // namespace

std::string hard_case_line(const HardCaseResult& result, std::size_t name_width, bool color,
                           bool verbose) {
  const HardCase& c = result.hard_case;
  const auto verdict =
      fmt::format(color ? fmt::emphasis::bold | fmt::fg(result.passed() ? fmt::terminal_color::green
                                                                        : fmt::terminal_color::red)
                        : fmt::text_style(),
                  "{}", result.passed() ? "PASSED" : "FAILED");
  std::string text = fmt::format("{} {:<{}} ", verdict, c.name, name_width);
  if (!result.passed()) {
    text += printable(result.failure);
  } else if (result.verification) {
    const Accuracy& accuracy = result.verification->accuracy;
    text += fmt::format("{}: {}; at most {:.2f} LSB, real arithmetic {:.2f}; {}, worst {} {:.1f}",
                        c.guard, count_text(result.guarded, find_guard(c.guard)->counts),
                        accuracy.total.largest_lsb, accuracy.series.largest_lsb,
                        count_text(result.methods, "method"), result.worst_method,
                        result.worst_method_lsb);
  } else {
    text += printable(as_run(result).message);
  }
  if (verbose) text += fmt::format("\n       breaks {}\n       must   {}", c.breaks, c.must);
  return text + "\n";
}

nlohmann::ordered_json hard_case_json(const HardCaseResult& result) {
  const HardCase& c = result.hard_case;
  nlohmann::ordered_json json = {{"case", c.name},
                                 {"passed", result.passed()},
                                 {"failure", result.failure},
                                 {"breaks", c.breaks},
                                 {"must", c.must},
                                 {"guard", c.guard},
                                 {"guarded", result.guarded},
                                 {"command", command_of(c)}};
  if (!result.refusal.empty()) json["refusal"] = printable(result.refusal);
  if (!result.verification) return json;
  json["max_error_lsb"] = result.verification->accuracy.total.largest_lsb;
  json["real_arithmetic_lsb"] = result.verification->accuracy.series.largest_lsb;
  json["methods"] = result.methods;
  json["worst_method"] = result.worst_method;
  json["worst_method_lsb"] = result.worst_method_lsb;
  return json;
}

Picture contact_sheet(const std::vector<HardCaseResult>& results) {
  const auto has_picture = [](const HardCaseResult& result) {
    return result.verification.has_value();
  };
  const auto count = static_cast<int>(std::count_if(results.begin(), results.end(), has_picture));
  const int rows = (count + kAcross - 1) / kAcross;
  const std::uint8_t background[3] = {24, 24, 28};
  Picture sheet(kAcross * (2 * kCell + 2 * kGap) + kGap, rows * (kCell + 2 * kGap) + kGap, 3,
                background);
  int place = 0;
  for (const HardCaseResult& result : results) {
    if (!has_picture(result)) continue;
    const int left = kGap + place % kAcross * (2 * kCell + 2 * kGap);
    const int top = kGap + place / kAcross * (kCell + 2 * kGap);
    paste(result.verification->result_picture, left, top, sheet);
    paste(result.verification->accuracy.error_picture, left + kCell, top, sheet);
    ++place;
  }
  return sheet;
}

}  // namespace phongpipe
