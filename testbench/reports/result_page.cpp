#include "testbench/reports/result_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_map>

#include "model/files/text_file.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/installation.h"
#include "testbench/system/markup.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

std::string html(std::string_view text) {
  return markup_text(printable(text));
}

// A string literal. Nothing in it can end the script that it stands in.
std::string json_text(std::string_view text) {
  std::string result;
  for (const char c : nlohmann::json(printable(text)).dump()) {
    result += c == '<' ? std::string("\\u003c") : std::string(1, c);
  }
  return result;
}

std::string json_list(const std::vector<std::string>& items) {
  return fmt::format("[{}]", fmt::join(items, ","));
}

std::string json_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return json_text(*text);
  const MetricValue& value = std::get<MetricValue>(cell);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr || !std::isfinite(*number)) return "null";
  return fmt::format("{:.6g}", *number);
}

// The members that give a column's values, by whichever way is shortest: "same": the one value of
// all rows; "values": each row's; "words" and "index": the different values, and which of them each
// row has.
std::string json_values(const std::vector<std::string>& values) {
  std::unordered_map<std::string_view, std::size_t> places;
  std::vector<std::string> words, index;
  std::size_t size_of_values = 0, size_of_words = 0;
  for (const std::string& value : values) {
    const auto [place, added] = places.emplace(value, words.size());
    if (added) {
      words.push_back(value);
      size_of_words += value.size() + 1;
    }
    index.push_back(fmt::format("{}", place->second));
    size_of_values += value.size() + 1;
    size_of_words += index.back().size() + 1;
  }
  if (words.size() == 1) return fmt::format("\"same\":{}", words.front());
  if (size_of_values <= size_of_words) return fmt::format("\"values\":{}", json_list(values));
  return fmt::format("\"words\":{},\"index\":{}", json_list(words), json_list(index));
}

std::string_view kind_text(PageColumn::Kind kind) {
  static constexpr std::string_view kNames[] = {"setting", "input", "metric", "text"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string_view better_text(Metric::Better better) {
  static constexpr std::string_view kNames[] = {"less", "more", "neither"};
  return kNames[static_cast<std::size_t>(better)];
}

std::string json_columns(const PageContent& content) {
  std::vector<std::string> columns;
  for (std::size_t i = 0; i < content.columns.size(); ++i) {
    const PageColumn& column = content.columns[i];
    std::vector<std::string> values;
    values.reserve(content.rows.size());
    for (const auto& row : content.rows) values.push_back(json_cell(row[i]));
    columns.push_back(
        fmt::format(R"({{"name":{},"unit":{},"meaning":{},"kind":"{}","better":"{}",{}}})",
                    json_text(column.name), json_text(column.unit), json_text(column.meaning),
                    kind_text(column.kind), better_text(column.better), json_values(values)));
  }
  return json_list(columns);
}

// Commands as columns of their words. Rows with fewer words have none in the last columns.
std::string json_commands(const std::vector<std::string>& commands) {
  std::vector<std::vector<std::string>> columns;
  for (std::size_t row = 0; row < commands.size(); ++row) {
    if (commands[row].empty()) continue;
    std::size_t place = 0;
    for (const std::string_view word : split(commands[row], ' ')) {
      if (place == columns.size()) columns.emplace_back(commands.size(), "null");
      columns[place++][row] = json_text(word);
    }
  }
  std::vector<std::string> items;
  items.reserve(columns.size());
  for (const auto& column : columns) items.push_back(fmt::format("{{{}}}", json_values(column)));
  return json_list(items);
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      group = group << 8 | (k < bytes.size() ? static_cast<std::uint8_t>(bytes[k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18 - 6 * k) & 0x3f];
    }
  }
  return text;
}

// A file name as a relative URL.
std::string file_url(std::string_view name) {
  std::string url;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || c == '-' || c == '_' || c == '.';
    url += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return url;
}

// "images": URLs, those that differ once; "pictures": of each row that has some, their labels and
// their places among the images.
std::string json_pictures(const PageContent& content) {
  std::unordered_map<std::string_view, std::size_t> places;
  std::vector<std::string> images, rows;
  for (const auto& [row, pictures] : content.pictures) {
    std::vector<std::string> items;
    for (const PagePicture& picture : pictures) {
      const bool inside = picture.file.empty();
      const auto [place, added] =
          places.emplace(inside ? picture.png : picture.file, images.size());
      if (added) {
        images.push_back(fmt::format("\"{}\"", inside
                                                   ? "data:image/png;base64," + base64(picture.png)
                                                   : file_url(picture.file)));
      }
      items.push_back(fmt::format("[{},{}]", json_text(picture.label), place->second));
    }
    rows.push_back(fmt::format("\"{}\":{}", row, json_list(items)));
  }
  return fmt::format("\"images\":{},\"pictures\":{{{}}}", json_list(images), fmt::join(rows, ","));
}

std::string json_data(const PageContent& content) {
  return fmt::format(
      "{{\"title\":{},\"row\":{},\"rows\":{},\"alternatives\":{},\"logarithmic\":{},\"x\":{},\"y\":"
      "{},\n"
      "\"columns\":{},\n\"commands\":{},\n{}}}",
      json_text(content.title), json_text(content.row), content.rows.size(), content.alternatives,
      content.logarithmic, json_text(content.x), json_text(content.y), json_columns(content),
      json_commands(content.commands), json_pictures(content));
}

std::string paragraphs(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result += fmt::format("<p>{}</p>\n", html(text));
  return result;
}

// As html(), with its lines.
std::string preformatted(const std::string& text) {
  std::string result;
  std::string_view line;
  for (LineReader lines(text); lines.next(line);) result += html(line) + "\n";
  return result;
}

// A text with {{name}} in the places of other texts, which are taken as they are.
std::string filled(std::string_view form, const std::function<std::string(std::string_view)>& of) {
  std::string result;
  while (true) {
    const std::size_t begin = form.find("{{");
    if (begin == std::string_view::npos) return result.append(form);
    const std::size_t end = form.find("}}", begin);
    result.append(form.substr(0, begin));
    result += of(form.substr(begin + 2, end - begin - 2));
    form.remove_prefix(end + 2);
  }
}

const Setting<Hardware>* find_setting(std::string_view name) {
  for (const Setting<Hardware>& setting : hardware_settings()) {
    if (setting.name() == name) return &setting;
  }
  return nullptr;
}

// What a campaign records beside settings and metrics.
struct Described {
  std::string_view name, unit, meaning;
  PageColumn::Kind kind;
};
constexpr Described kDescribed[] = {
    {"scene", "", "file or name of the scene", PageColumn::Kind::input},
    {"hardware", "", "preset or file that the settings change", PageColumn::Kind::input},
    {"technology", "", "card that gives the clock", PageColumn::Kind::setting},
    {"outcome", "", "how the run ended", PageColumn::Kind::text},
    {"verified_by", "", "what the pixels were compared with", PageColumn::Kind::text},
    {"message", "", "why the run has not passed, or how it had to end", PageColumn::Kind::text},
    {"bucket", "", "what failed first", PageColumn::Kind::text},
    {"configuration_hash", "", "of the hardware", PageColumn::Kind::text},
    {"identity", "", "of all that the result depends on", PageColumn::Kind::text},
    {"command", "", "that verifies the same", PageColumn::Kind::text},
    {"seconds", "s", "that the run took here", PageColumn::Kind::text},
};

}  // namespace

PageColumn page_column(std::string_view name) {
  for (const Metric& metric : metrics()) {
    if (metric.name != name) continue;
    return {std::string(name), std::string(metric.unit), std::string(metric.meaning),
            PageColumn::Kind::metric, metric.better};
  }
  if (const auto* setting = find_setting(name)) {
    return {std::string(name), std::string(setting->unit), std::string(setting->meaning),
            PageColumn::Kind::setting, Metric::Better::neither};
  }
  for (const Described& column : kDescribed) {
    if (column.name != name) continue;
    return {std::string(name), std::string(column.unit), std::string(column.meaning), column.kind,
            Metric::Better::neither};
  }
  return {std::string(name), "", "", PageColumn::Kind::input, Metric::Better::neither};
}

std::string result_page(const PageContent& content) {
  const auto& folder = installation().page;
  return filled(read_whole_file(folder / "page.html"), [&](std::string_view name) -> std::string {
    if (name == "title") return html(content.title);
    if (name == "row") return html(content.row);
    if (name == "summary") return paragraphs(content.summary);
    if (name == "notes") return paragraphs(content.notes);
    if (name == "details") return preformatted(content.details);
    if (name == "data") return json_data(content);
    return read_whole_file(folder / std::string(name));
  });
}

}  // namespace phongpipe
