#include "testbench/reports/pixel_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

using nlohmann::ordered_json;

// Values of one pixel by channel, in the channels that are in use.
class Channels {
 public:
  explicit Channels(const DatapathConfiguration& configuration)
      : count_(static_cast<std::size_t>(configuration.channels)) {}

  std::vector<double> of(const Color& color) const {
    return std::vector<double>(color.data(), color.data() + count_);
  }
  std::vector<int> of(std::uint32_t packed) const {
    std::vector<int> values;
    for (std::size_t c = 0; c < count_; ++c) {
      values.push_back(static_cast<int>(packed >> (c * kOutputBits)) & kOutputMax);
    }
    return values;
  }
  // Of an array of registers, each in units of 2^-fraction_bits.
  template <typename Value>
  std::vector<double> of(const std::array<Value, 3>& registers, int fraction_bits) const {
    std::vector<double> values;
    for (std::size_t c = 0; c < count_; ++c) {
      values.push_back(std::ldexp(static_cast<double>(registers[c]), -fraction_bits));
    }
    return values;
  }
  std::vector<bool> of(const std::array<bool, 3>& registers) const {
    return std::vector<bool>(registers.begin(),
                             registers.begin() + static_cast<std::ptrdiff_t>(count_));
  }

 private:
  std::size_t count_;
};

// What the blocks behind the series made of the pixel.
struct BlockValues {
  std::optional<int> address;  // of the table, if there is one
  double table_x = 0;          // that it stands for
  std::vector<double> word;    // LSB
  bool open = false;           // the gate
  std::vector<bool> lit;
  std::vector<double> clamped, sum;  // LSB
  std::optional<double> own_share;   // of the pixel's own colour under depth cueing
  std::vector<bool> saturated;
  std::vector<int> output;
};

BlockValues block_values(const PixelStory& story, const SpanStory& span) {
  const DatapathConfiguration& f = story.configuration;
  const Channels channels(f);
  BlockValues values;
  if (f.specular) {
    values.address = span.pixel.address;
    values.table_x = ExponentRom::entry_x(f, span.pixel.address, story.material.shininess);
    std::array<std::int32_t, 3> words = span.pixel.word;
    for (std::size_t c = 0; c < words.size(); ++c) words[c] += span.pixel.increment[c];
    values.word = channels.of(words, f.rom_data_bits - kOutputBits);
    values.open = span.pixel.open;
  }
  values.lit = channels.of(span.pixel.lit);
  values.clamped = channels.of(span.pixel.clamped, f.sum_fraction_bits());
  values.sum = channels.of(span.pixel.sum, 0);
  if (f.depth_cue) values.own_share = std::ldexp(span.pixel.cue_factor, -kCueFactorBits);
  values.saturated = channels.of(span.saturated);
  values.output = channels.of(span.pixel.color);
  return values;
}

std::string hex(const RegisterValue& value) {
  const int width = value.signal.width;
  const auto bits = static_cast<std::uint64_t>(value.bits) & (~std::uint64_t{0} >> (64 - width));
  return fmt::format("0x{:0{}x}", bits, (width + 3) / 4);
}

double units(const RegisterValue& value) {
  return value.signal.real(value.bits);
}

double in_units(const SeriesCoefficients& series, std::size_t i) {
  return std::ldexp(static_cast<double>(series.rounded[i]), -series.fraction_bits);
}

std::vector<double> numbers(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}
std::vector<double> numbers(const Color& c) {
  return {c[0], c[1], c[2]};
}

// What the depth test, or the addition of a further light, did with a visit.
std::string fate(const PixelVisit& visit) {
  const auto holder = [&visit] { return fmt::format("triangle {}", *visit.held_by); };
  if (visit.light > 0) return visit.taken ? "added" : fmt::format("not added: {} won", holder());
  if (!visit.held_by) return "written first";
  return visit.taken ? fmt::format("written over {}, which is farther", holder())
                     : fmt::format("rejected: not nearer than {}", holder());
}

class TextReport {
 public:
  explicit TextReport(const PixelStory& story) : story_(story), channels_(story.configuration) {}

  std::string text() {
    answer();
    visits();
    triangle();
    error_parts();
    for (std::size_t i = 0; i < story_.lights.size(); ++i) light(i, story_.lights[i]);
    neighbours();
    return std::move(text_);
  }

 private:
  void plain(const std::string& line) { text_ += line + "\n"; }
  void line(std::string_view label, const std::string& text) {
    text_ += fmt::format("  {:<10} {}\n", label, text);
  }
  template <typename Values>
  static std::string list(const Values& values) {
    return fmt::format("{}", fmt::join(values, ", "));
  }
  template <typename Values>
  static std::string list(const Values& values, const char* format) {
    std::string text;
    for (const auto& value : values) {
      text += (text.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), value);
    }
    return text;
  }
  static std::string vertex_text(const ScreenVertex& v) {
    return fmt::format("x {:.6g}, y {:.6g}, z {:.6g}, normal ({})", in_pixels(v.x), in_pixels(v.y),
                       v.z, list(numbers(v.normal), "{:.6g}"));
  }

  void answer() {
    const ErrorSplit& error = story_.error;
    plain(fmt::format("{}  pixel {},{}: triangle {}, hardware {} {}", printable(story_.scene),
                      story_.x, story_.y, story_.triangle, printable(story_.hardware.name),
                      configuration_hash(story_.hardware).substr(0, 8)));
    line("output", list(channels_.of(story_.color)) + " LSB");
    line("exact", list(channels_.of(error.exact), "{:.4f}"));
    line("error", list(channels_.of(error.error()), "{:+.4f}"));
    const std::size_t largest = error.largest_part();
    line("largest", fmt::format("{} {}", kErrorParts[largest].name,
                                list(channels_.of(error.parts[largest]), "{:+.4f}")));
    if (!story_.rtl_agrees()) {
      line("differs", fmt::format("{}; `phongpipe verify` names the register",
                                  story_.rtl_visits.empty() ? "the RTL shades it in another colour"
                                                            : story_.rtl_visits));
    }
  }

  void visits() {
    plain(fmt::format("triangles that cover it, in drawing order{}",
                      story_.depth_test ? ", with their stored depth"
                                        : "; no depth test, as no pixel is covered twice"));
    for (const PixelVisit& v : story_.visits) {
      line(fmt::format("light {}", v.light),
           fmt::format("triangle {}{}, colour {}, cycle {} in SystemC, {} in RTL: {}", v.triangle,
                       story_.depth_test && v.light == 0 ? fmt::format(", depth {}", v.depth) : "",
                       list(channels_.of(v.color)), cycle_text(v.systemc_cycle),
                       cycle_text(v.rtl_cycle), fate(v)));
      if (v.rtl_color.value_or(v.color) != v.color) {
        line("", fmt::format("WRONG in the RTL: colour {}", list(channels_.of(*v.rtl_color))));
      }
    }
  }
  static std::string cycle_text(const std::optional<std::int64_t>& cycle) {
    return cycle ? fmt::format("{}", *cycle) : "-";
  }

  void triangle() {
    const Material& m = story_.material;
    plain(fmt::format("triangle {}", story_.triangle));
    for (const ScreenVertex& v : story_.whole.vertices) line("vertex", vertex_text(v));
    if (story_.piece) {
      line("split", "one series is not enough for it; the piece here:");
      for (const ScreenVertex& v : story_.piece->vertices) line("vertex", vertex_text(v));
    }
    line("normal", fmt::format("({}) at the pixel", list(numbers(story_.normal), "{:.6g}")));
    line("material", fmt::format("{}: ambient {}; diffuse {}; specular {}; shininess {}",
                                 printable(m.name), list(numbers(m.ambient)),
                                 list(numbers(m.diffuse)), list(numbers(m.specular)), m.shininess));
    if (story_.certificate) {
      line("proved",
           fmt::format("an error of at most {:.3f} LSB, {}", story_.certificate->error_lsb,
                       story_.certificate->exact ? "by exact_path" : "by quadratics"));
    }
    line("effects", list(story_.effects.used));
    line("not built", list(story_.effects.left_out));
  }

  void error_parts() {
    plain("error in LSB, its parts along the chain from exact Phong to the output");
    for (std::size_t i = 0; i < kErrorParts.size(); ++i) {
      plain(fmt::format("  {:<21} {}  {}", kErrorParts[i].name,
                        list(channels_.of(story_.error.parts[i]), "{:+10.6f}"),
                        kErrorParts[i].meaning));
    }
    plain(
        fmt::format("  {:<21} {}", "error", list(channels_.of(story_.error.error()), "{:+10.6f}")));
  }

  void light(std::size_t index, const LightStory& light) {
    const Light& l = light.light;
    std::string place;
    if (l.type != LightType::directional) {
      place += fmt::format(" at ({})", list(numbers(l.position), "{:.6g}"));
    }
    if (l.type != LightType::point) {
      place += fmt::format(", travels along ({})", list(numbers(l.direction), "{:.6g}"));
    }
    plain(fmt::format("light {}: {}{}, colour {}", index, name(l.type), place,
                      list(numbers(l.color))));
    for (const LeftOut& left_out : light.left_out) {
      line("left out", fmt::format("{}: {}", left_out.what, left_out.why));
    }
    if (!light.span) {
      line("", "adds nothing to the pixel");
      return;
    }
    line("expansion", fmt::format("about pixel {},{}", light.expansion->x, light.expansion->y));
    for (const SeriesCoefficients& series : light.coefficients) coefficients(series);
    span(*light.span);
  }

  void coefficients(const SeriesCoefficients& series) {
    plain(fmt::format("    {:<18} {:>18} {:>18}  as an integer of 2^-{}{}{}", series.name, "real",
                      "rounded", series.fraction_bits, series.unit.empty() ? "" : " ",
                      series.unit));
    for (std::size_t i = 0; i < series.real.size(); ++i) {
      plain(fmt::format("      T{:<15} {:>18.10f} {:>18.10f}  {}", i, series.real[i],
                        in_units(series, i), series.rounded[i]));
    }
  }

  void span(const SpanStory& span) {
    const BlockValues values = block_values(story_, span);
    line("span", fmt::format("x {} to {}, y {}; the pixel is step {}", span.row.x,
                             span.row.x + span.row.length - 1, span.row.y, span.step));
    if (values.address) {
      line("table", fmt::format("address {} (x = {:.6f}), word {} LSB", *values.address,
                                values.table_x, list(values.word)));
      line("gate", values.open ? "open: the word counts" : "closed: the word does not count");
    }
    line("lit", list(values.lit));
    line("clamped", list(values.clamped) + " LSB");
    line("sum", list(values.sum) + " LSB");
    if (values.own_share) {
      line("cue", fmt::format("{:.6g} of the pixel's own colour", *values.own_share));
    }
    line("output",
         fmt::format("{} LSB; saturated: {}", list(values.output), list(values.saturated)));
    plain("    registers that take the span's start");
    registers(span.start);
    plain("    registers of all stages, each while it holds the pixel");
    registers(span.registers);
  }

  void registers(const std::vector<RegisterValue>& values) {
    for (const RegisterValue& value : values) {
      plain(fmt::format("      {:<58} {:>12} {:>18.10g}{}{}", value.signal.full_name(), hex(value),
                        units(value), value.signal.unit.empty() ? "" : " ", value.signal.unit));
    }
  }

  void neighbours() {
    plain("neighbours");
    for (const Neighbour& n : story_.neighbours) {
      line(fmt::format("{},{}", n.x, n.y),
           fmt::format(
               "{} LSB, {}", list(channels_.of(n.color)),
               n.triangle ? fmt::format("triangle {}", *n.triangle) : std::string("background")));
    }
  }

  const PixelStory& story_;
  Channels channels_;
  std::string text_;
};

template <typename Value>
ordered_json or_null(const std::optional<Value>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json vertices_json(const ScreenTriangle& triangle) {
  ordered_json json = ordered_json::array();
  for (const ScreenVertex& v : triangle.vertices) {
    json.push_back(
        {{"x", in_pixels(v.x)}, {"y", in_pixels(v.y)}, {"z", v.z}, {"normal", numbers(v.normal)}});
  }
  return json;
}

ordered_json registers_json(const std::vector<RegisterValue>& values) {
  ordered_json json = ordered_json::object();
  for (const RegisterValue& value : values) {
    json[value.signal.full_name()] = {
        {"hex", hex(value)}, {"value", units(value)}, {"unit", value.signal.unit}};
  }
  return json;
}

ordered_json span_json(const PixelStory& story, const SpanStory& span) {
  const BlockValues values = block_values(story, span);
  ordered_json json = {
      {"x", span.row.x}, {"y", span.row.y}, {"length", span.row.length}, {"step", span.step}};
  if (values.address) {
    json["table"] = {{"address", *values.address},
                     {"x", values.table_x},
                     {"word_lsb", values.word},
                     {"open", values.open}};
  }
  json["lit"] = values.lit;
  json["clamped_lsb"] = values.clamped;
  json["sum_lsb"] = values.sum;
  if (values.own_share) json["own_share"] = *values.own_share;
  json["saturated"] = values.saturated;
  json["output"] = values.output;
  json["start"] = registers_json(span.start);
  json["registers"] = registers_json(span.registers);
  return json;
}

ordered_json light_json(const PixelStory& story, const LightStory& light) {
  const Light& l = light.light;
  ordered_json json = {{"type", name(l.type)}, {"color", numbers(l.color)}};
  if (l.type != LightType::point) json["direction"] = numbers(l.direction);
  if (l.type != LightType::directional) json["position"] = numbers(l.position);
  json["left_out"] = ordered_json::array();
  for (const LeftOut& left_out : light.left_out) {
    json["left_out"].push_back({{"what", left_out.what}, {"why", left_out.why}});
  }
  if (!light.span) return json;
  json["expansion"] = {{"x", light.expansion->x}, {"y", light.expansion->y}};
  json["coefficients"] = ordered_json::object();
  for (const SeriesCoefficients& series : light.coefficients) {
    std::vector<double> rounded;
    for (std::size_t i = 0; i < series.rounded.size(); ++i) rounded.push_back(in_units(series, i));
    json["coefficients"][series.name] = {{"unit", series.unit},
                                         {"fraction_bits", series.fraction_bits},
                                         {"real", series.real},
                                         {"rounded", rounded},
                                         {"integer", series.rounded}};
  }
  json["span"] = span_json(story, *light.span);
  return json;
}

}  // namespace

std::string pixel_text(const PixelStory& story) {
  return TextReport(story).text();
}

ordered_json pixel_json(const PixelStory& story) {
  const Channels channels(story.configuration);
  const ErrorSplit& error = story.error;
  ordered_json json = {{"scene", story.scene},
                       {"hardware", story.hardware.name},
                       {"configuration_hash", configuration_hash(story.hardware)},
                       {"pixel", {{"x", story.x}, {"y", story.y}}},
                       {"triangle", story.triangle},
                       {"output", channels.of(story.color)},
                       {"exact_lsb", channels.of(error.exact)},
                       {"error_lsb", channels.of(error.error())}};
  for (std::size_t i = 0; i < kErrorParts.size(); ++i) {
    json["error_parts"][std::string(kErrorParts[i].name)] = channels.of(error.parts[i]);
  }
  json["largest_part"] = kErrorParts[error.largest_part()].name;
  json["depth_test"] = story.depth_test;
  json["rtl_agrees"] = story.rtl_agrees();
  for (const PixelVisit& v : story.visits) {
    json["visits"].push_back(
        {{"light", v.light},
         {"triangle", v.triangle},
         {"depth", v.depth},
         {"color", channels.of(v.color)},
         {"rtl_color", v.rtl_color ? ordered_json(channels.of(*v.rtl_color)) : ordered_json()},
         {"held_by", or_null(v.held_by)},
         {"taken", v.taken},
         {"cycle", {{"systemc", or_null(v.systemc_cycle)}, {"rtl", or_null(v.rtl_cycle)}}}});
  }
  json["vertices"] = vertices_json(story.whole);
  if (story.piece) json["piece_vertices"] = vertices_json(*story.piece);
  json["normal"] = numbers(story.normal);
  json["material"] = {{"name", story.material.name},
                      {"ambient", numbers(story.material.ambient)},
                      {"diffuse", numbers(story.material.diffuse)},
                      {"specular", numbers(story.material.specular)},
                      {"shininess", story.material.shininess}};
  json["certified_error_lsb"] =
      story.certificate ? ordered_json(story.certificate->error_lsb) : ordered_json();
  json["exact_path"] = story.certificate && story.certificate->exact;
  json["effects"] = {{"used", story.effects.used}, {"left_out", story.effects.left_out}};
  for (const LightStory& light : story.lights) json["lights"].push_back(light_json(story, light));
  json["neighbours"] = ordered_json::array();
  for (const Neighbour& n : story.neighbours) {
    json["neighbours"].push_back({{"x", n.x},
                                  {"y", n.y},
                                  {"triangle", or_null(n.triangle)},
                                  {"output", channels.of(n.color)}});
  }
  return json;
}

}  // namespace phongpipe
