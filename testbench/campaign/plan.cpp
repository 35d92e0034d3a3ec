#include "testbench/campaign/plan.h"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

#include "model/files/spelling.h"
#include "model/files/text_file.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

std::pair<std::string, std::string> split_at_equals(const std::string& text,
                                                    const std::string& what) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError(fmt::format("{}: write {}", text, what));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

// Splits at commas outside brackets, so that a value may be an array.
std::vector<std::string> list_items(const std::string& text) {
  constexpr std::size_t kMaxBytes = 65536;
  if (text.size() > kMaxBytes) {
    throw InputError(
        fmt::format("{}: the values of a key may take at most {} bytes", excerpt(text), kMaxBytes));
  }
  std::vector<std::string> items(1);
  int depth = 0;
  for (const char c : text) {
    depth += c == '[' ? 1 : c == ']' ? -1 : 0;
    if (c == ',' && depth == 0) {
      items.emplace_back();
    } else {
      items.back() += c;
    }
  }
  return items;
}

// FROM:TO or FROM:TO:STEP as values; nothing if the item is no range.
std::optional<std::vector<std::string>> range_values(const std::string& item) {
  const std::vector<std::string_view> parts = split(item, ':');
  if (parts.size() != 2 && parts.size() != 3) return std::nullopt;
  std::vector<double> numbers;
  for (const std::string_view part : parts) {
    const auto number = parse_number(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  const double from = numbers[0], to = numbers[1];
  const double step = numbers.size() == 3 ? numbers[2] : from <= to ? 1 : -1;
  if (step == 0) throw InputError(fmt::format("{}: a step of 0 leads nowhere", item));
  const double steps = std::floor((to - from) / step + 1e-9);
  if (steps < 0) {
    throw InputError(
        fmt::format("{}: no value lies from {} to {} in steps of {}", item, from, to, step));
  }
  if (steps >= static_cast<double>(kMostPoints)) {
    throw InputError(
        fmt::format("{}: {:.0f} values, at most {} are possible", item, steps + 1, kMostPoints));
  }
  std::vector<std::string> values;
  for (int i = 0; i <= static_cast<int>(steps); ++i) {
    values.push_back(fmt::format("{:.12g}", from + i * step));
  }
  return values;
}

std::vector<std::string> parse_values(const std::string& key, const std::string& text) {
  std::vector<std::string> values;
  for (const std::string& item : list_items(text)) {
    const std::string value(trimmed(item));
    if (value.empty()) throw InputError(fmt::format("{}={}: an empty value", key, text));
    if (const auto range = range_values(value)) {
      values.insert(values.end(), range->begin(), range->end());
    } else {
      values.push_back(value);
    }
    if (values.size() > kMostPoints) {
      throw InputError(fmt::format("{}: more than {} values", key, kMostPoints));
    }
  }
  std::set<std::string> distinct;
  for (const std::string& value : values) {
    if (!distinct.insert(value).second) {
      throw InputError(fmt::format("{}={}: {} stands there twice", key, text, value));
    }
  }
  return values;
}

std::vector<std::string> known_keys() {
  std::vector<std::string> keys = {"scene", "hardware", "technology"};
  for (const RunOption& option : run_options()) keys.emplace_back(option.name);
  for (const Setting<Hardware>& setting : hardware_settings()) {
    keys.emplace_back(setting.key);
    keys.push_back(setting.name());
  }
  return keys;
}

const Setting<Hardware>* setting_called(const std::string& key) {
  for (const Setting<Hardware>& setting : hardware_settings()) {
    if (setting.is_called(key)) return &setting;
  }
  return nullptr;
}

// A single = would be an assignment.
bool has_assignment(const std::string& text) {
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 1)) {
    const char before = i > 0 ? text[i - 1] : ' ', after = i + 1 < text.size() ? text[i + 1] : ' ';
    if (after == '=') {
      ++i;
    } else if (before != '!' && before != '<' && before != '>') {
      return true;
    }
  }
  return false;
}

// An expression over the values of a point. Keys are variables, by their full names and by the last
// part of these, unless two keys share it; words that are values of keys are numbers that only they
// equal.
class Expression {
 public:
  // `ties`: how many of the plan's ties it may use.
  Expression(const std::string& text, const Plan& plan, std::size_t ties) : text_(text) {
    constexpr std::size_t kLongest = 1000;
    if (text.size() > kLongest) {
      throw InputError(fmt::format("{}…: an expression of {} characters, at most {} are possible",
                                   text.substr(0, 40), text.size(), kLongest));
    }
    if (has_assignment(text)) throw InputError(fmt::format("{}: write == to compare", text));
    parser_.DefineNameChars("0123456789_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    for (const Axis& axis : plan.axes) variables_.push_back({axis.key});
    for (std::size_t i = 0; i < ties; ++i) variables_.push_back({plan.ties[i].key});
    for (Variable& variable : variables_) {
      define(variable.key, variable);
      const std::string last = last_part(variable.key);
      const auto shares =
          std::count_if(variables_.begin(), variables_.end(),
                        [&](const Variable& other) { return last_part(other.key) == last; });
      if (last != variable.key && shares == 1) define(last, variable);
    }
    for (const Axis& axis : plan.axes) {
      for (const std::string& value : axis.values) define_word(value);
    }
    for (const Variable& variable : variables_) {
      const Setting<Hardware>* const setting = setting_called(variable.key);
      if (setting == nullptr) continue;
      for (const std::string_view word : setting->choices) define_word(std::string(word));
    }
    try {
      parser_.SetExpr(text);
      check_names();
    } catch (const mu::Parser::exception_type& error) {
      throw InputError(fmt::format("{}: {}", text_, error.GetMsg()));
    }
  }

  double evaluate(const std::vector<std::pair<std::string, std::string>>& values) {
    for (const auto& [key, value] : values) {
      for (Variable& variable : variables_) {
        if (variable.key == key) variable.value = number_of(value);
      }
    }
    try {
      const double result = parser_.Eval();
      if (!std::isfinite(result)) {
        throw InputError(fmt::format("{}: not a finite number at some point", text_));
      }
      return result;
    } catch (const mu::Parser::exception_type& error) {
      throw InputError(fmt::format("{}: {}", text_, error.GetMsg()));
    }
  }

 private:
  struct Variable {
    std::string key;
    double value = 0;
  };

  // Throws InputError if the expression has a name of something that does not vary.
  void check_names() {
    std::vector<std::string> known;
    for (const auto& [name, value] : parser_.GetVar()) known.push_back(name);
    for (const auto& [name, value] : parser_.GetUsedVar()) {
      if (std::find(known.begin(), known.end(), name) != known.end()) continue;
      const std::vector<std::string> keys = known_keys();
      if (std::find(keys.begin(), keys.end(), name) != keys.end()) {
        throw InputError(fmt::format("{}: {} does not vary", text_, name));
      }
      for (const auto& [word, number] : words_) known.push_back(word);
      const std::string close = closest_word(name, known);
      throw InputError(fmt::format("{}: {} is no name of what varies{}", text_, name,
                                   close.empty() ? "" : fmt::format("; did you mean {}?", close)));
    }
  }

  static std::string last_part(const std::string& key) { return key.substr(key.rfind('.') + 1); }

  // What is no name, such as a key with spaces or six-point, cannot be part of an expression.
  void define(const std::string& name, Variable& variable) {
    try {
      parser_.DefineVar(name, &variable.value);
    } catch (const mu::Parser::exception_type&) {
    }
  }
  void define_word(const std::string& word) {
    if (parse_number(word) || words_.count(word) > 0 || parser_.GetVar().count(word) > 0) return;
    try {
      parser_.DefineConst(word, number_of(word));
    } catch (const mu::Parser::exception_type&) {
    }
  }
  // A number as it is, a word as a number of its own.
  double number_of(const std::string& value) {
    if (const auto number = parse_number(value)) return *number;
    const auto next = -1e6 - static_cast<double>(words_.size());
    return words_.emplace(value, next).first->second;
  }

  std::string text_;
  mu::Parser parser_;
  std::deque<Variable> variables_;  // stay where they are
  std::map<std::string, double> words_;
};

// Turns places of the grid into points.
class PointMaker {
 public:
  explicit PointMaker(const Plan& plan) : plan_(plan) {
    // A tie may use those before it.
    for (std::size_t i = 0; i < plan.ties.size(); ++i) {
      ties_.emplace_back(plan.ties[i].expression, plan, i);
    }
    for (const std::string& condition : plan.conditions) {
      conditions_.emplace_back(condition, plan, plan.ties.size());
    }
  }

  // Nothing where a condition leaves the point out.
  std::optional<PlanPoint> point(std::uint64_t place) {
    PlanPoint point{plan_.base, {}};
    point.values.resize(plan_.axes.size());
    for (std::size_t i = plan_.axes.size(); i-- > 0;) {
      const Axis& axis = plan_.axes[i];
      point.values[i] = {axis.key, axis.values[place % axis.values.size()]};
      place /= axis.values.size();
    }
    for (std::size_t i = 0; i < ties_.size(); ++i) {
      point.values.emplace_back(plan_.ties[i].key,
                                fmt::format("{:.12g}", ties_[i].evaluate(point.values)));
    }
    for (Expression& condition : conditions_) {
      if (condition.evaluate(point.values) == 0) return std::nullopt;
    }
    for (const auto& [key, value] : point.values) set_key(point.request, key, value);
    return point;
  }

 private:
  const Plan& plan_;
  std::deque<Expression> ties_, conditions_;
};

void check_keys(const Plan& plan) {
  std::set<std::string> keys;
  const auto add = [&keys](const std::string& key) {
    if (!keys.insert(key).second) throw InputError(fmt::format("{} varies twice", key));
  };
  for (const Axis& axis : plan.axes) add(axis.key);
  for (const Tie& tie : plan.ties) add(tie.key);
}

std::vector<PlanPoint> sampled_points(const Plan& plan, std::uint64_t size) {
  PointMaker maker(plan);
  Random random(plan.seed);
  std::set<std::uint64_t> places;
  std::map<std::uint64_t, PlanPoint> chosen;  // in the order of the grid
  // Conditions may leave out all but a few points: give up after many draws.
  const std::uint64_t most_draws = 1000 + 200 * plan.sample;
  constexpr std::uint64_t kMostVainDraws = 20'000;
  for (std::uint64_t draw = 0;
       draw < most_draws && chosen.size() < plan.sample && places.size() < size; ++draw) {
    const std::uint64_t place = random.below(size);
    if (chosen.empty() && draw > kMostVainDraws) break;
    if (!places.insert(place).second) continue;
    if (auto point = maker.point(place)) chosen.emplace(place, std::move(*point));
  }
  std::vector<PlanPoint> points;
  points.reserve(chosen.size());
  for (auto& [place, point] : chosen) points.push_back(std::move(point));
  return points;
}

}  // namespace

std::string full_key(const std::string& key) {
  if (is_scene_key(key)) return key;
  if (const auto* setting = setting_called(key)) return setting->name();
  const std::vector<std::string> known = known_keys();
  if (std::find(known.begin(), known.end(), key) != known.end()) return key;
  const std::string close = closest_word(key, known);
  throw InputError(fmt::format(
      "{}: unknown key; {}", key,
      close.empty() ? "`phongpipe sweep --help-settings` lists the settings of the hardware"
                    : fmt::format("did you mean {}?", close)));
}

Axis parse_axis(const std::string& text) {
  const auto [key, values] = split_at_equals(text, "KEY=VALUE,VALUE or KEY=FROM:TO[:STEP]");
  return {full_key(key), parse_values(key, values)};
}

Tie parse_tie(const std::string& text) {
  auto [key, expression] = split_at_equals(text, "KEY=EXPRESSION");
  return {full_key(key), std::move(expression)};
}

void read_sweep_file(const std::filesystem::path& file, Plan& plan) {
  const TomlTable root = TomlTable::read_file(file);
  if (root.has("scenes")) plan.axes.push_back({"scene", root.values("scenes")});
  plan.base.hardware = root.text("hardware", plan.base.hardware);
  if (root.has("where")) plan.conditions = root.values("where");
  constexpr std::size_t kMostConditions = 32;
  if (plan.conditions.size() > kMostConditions) {
    root.fail("where", fmt::format("{} conditions, may be at most {}", plan.conditions.size(),
                                   kMostConditions));
  }
  plan.sample = static_cast<std::uint64_t>(
      root.integer("sample", 1, static_cast<int>(kMostPoints), static_cast<int>(plan.sample)));
  plan.seed = static_cast<std::uint64_t>(
      root.integer("seed", 0, std::numeric_limits<int>::max(), static_cast<int>(plan.seed)));
  const auto set = root.optional_table("set"), vary = root.optional_table("vary"),
             tie = root.optional_table("tie");
  root.finish();
  const auto for_each_key = [](const std::optional<TomlTable>& table, const auto& visit) {
    if (!table) return;
    for (const std::string& key : table->keys()) {
      try {
        visit(full_key(key), table->values(key));
      } catch (const InputError& error) {
        table->fail(key, error.what());
      }
    }
  };
  for_each_key(set, [&](const std::string& key, const std::vector<std::string>& values) {
    if (values.size() != 1) throw InputError("one value is needed; [vary] takes several");
    set_key(plan.base, key, values.front());
  });
  for_each_key(vary, [&](const std::string& key, const std::vector<std::string>& values) {
    plan.axes.push_back({key, parse_values(key, fmt::format("{}", fmt::join(values, ",")))});
  });
  for_each_key(tie, [&](const std::string& key, const std::vector<std::string>& values) {
    if (values.size() != 1) throw InputError("one expression is needed");
    plan.ties.push_back({key, values.front()});
  });
}

std::uint64_t grid_size(const Plan& plan) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 63;
  std::uint64_t size = 1;
  for (const Axis& axis : plan.axes) {
    const std::uint64_t values = axis.values.size();
    if (size > kMost / values) return kMost;
    size *= values;
  }
  return size;
}

std::vector<PlanPoint> points_of(const Plan& plan) {
  check_keys(plan);
  const std::uint64_t size = grid_size(plan);
  std::vector<PlanPoint> points;
  if (plan.sample > 0 && plan.sample < size) {
    points = sampled_points(plan, size);
  } else if (size > kMostPoints) {
    throw InputError(fmt::format(
        "the space has {} points, more than the {} that are computed one "
        "by one; give --sample N or fewer values",
        metric_text(
            static_cast<std::int64_t>(std::min<std::uint64_t>(size, std::int64_t{1} << 62))),
        metric_text(static_cast<std::int64_t>(kMostPoints))));
  } else {
    PointMaker maker(plan);
    for (std::uint64_t place = 0; place < size; ++place) {
      if (auto point = maker.point(place)) points.push_back(std::move(*point));
    }
  }
  if (points.empty()) throw InputError("no point is left: the conditions leave out all of them");
  return points;
}

}  // namespace phongpipe
