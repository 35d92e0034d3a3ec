// One setting of the hardware. It is described once; files, --set, --help, range checks, hashes,
// reports and the RTL's parameters are made from the description.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "model/scene/input_error.h"

namespace phongpipe {

// A setting, which holds a number or the index of a choice.
struct SettingDescription {
  std::string_view section, key;  // key = … under [section] of a hardware file
  std::string_view unit;          // "bits", "cycles", …; empty for a choice
  std::string_view meaning;
  int low = 0, high = 0;                  // the legal values, inclusive
  std::vector<std::string_view> choices;  // names of the values from 0; empty for a number
  std::string_view rtl_parameter;         // of the RTL; empty where it has none
  int per_unit = 1;                       // the value counts parts of the unit, so many to one

  std::string name() const { return fmt::format("{}.{}", section, key); }
  // Whether the setting is meant by `text`: its key, or section and key.
  bool is_called(std::string_view text) const {
    if (text.size() < key.size() || text.substr(text.size() - key.size()) != key) return false;
    const std::string_view before = text.substr(0, text.size() - key.size());
    return before.empty() || (before.size() == section.size() + 1 && before.back() == '.' &&
                              before.substr(0, section.size()) == section);
  }
  // A value as text, as in files and --set.
  std::string text(int value) const {
    if (!choices.empty()) return std::string(choices[static_cast<std::size_t>(value)]);
    return per_unit == 1 ? fmt::format("{}", value) : fmt::format("{:.10g}", in_units(value));
  }
  double in_units(int value) const { return static_cast<double>(value) / per_unit; }
  // The nearest value to a number of units.
  int parts(double units) const { return static_cast<int>(std::lround(units * per_unit)); }
};

// Of a `Record` that holds the value.
template <typename Record>
struct Setting : SettingDescription {
  std::function<int(const Record&)> get;
  std::function<void(Record&, int)> put;

  std::string value(const Record& record) const { return text(get(record)); }
  // Throws InputError naming key, value and legal range.
  void check(const Record& record) const {
    const int value = get(record);
    if (value >= low && value <= high) return;
    throw InputError(fmt::format("{} = {} is out of range: {} to {} {}", name(), text(value),
                                 text(low), text(high), unit));
  }
  // The same setting for a record that has `part` as a member.
  template <typename Whole>
  Setting<Whole> of(Record Whole::*part) const {
    return {*this, [get = get, part](const Whole& whole) { return get(whole.*part); },
            [put = put, part](Whole& whole, int value) { put(whole.*part, value); }};
  }
};

template <typename Record>
using Settings = std::vector<Setting<Record>>;

template <typename Record>
void check_settings(const Settings<Record>& settings, const Record& record) {
  for (const Setting<Record>& setting : settings) setting.check(record);
}

// A whole number from `low` to `high`.
template <typename Record>
Setting<Record> number_setting(std::string_view section, std::string_view key, int Record::*member,
                               std::string_view unit, int low, int high, std::string_view meaning,
                               std::string_view rtl_parameter = {}) {
  return {{section, key, unit, meaning, low, high, {}, rtl_parameter},
          [member](const Record& record) { return record.*member; },
          [member](Record& record, int value) { record.*member = value; }};
}

// A number with decimals, held in parts of its unit, `per_unit` to one, from `low` to `high` parts.
template <typename Record>
Setting<Record> decimal_setting(std::string_view section, std::string_view key, int Record::*member,
                                std::string_view unit, int per_unit, int low, int high,
                                std::string_view meaning) {
  Setting<Record> setting = number_setting(section, key, member, unit, low, high, meaning);
  setting.per_unit = per_unit;
  return setting;
}

// One of `choices`, which name the enumerators in their order.
template <typename Record, typename Enum>
Setting<Record> choice_setting(std::string_view section, std::string_view key, Enum Record::*member,
                               std::vector<std::string_view> choices, std::string_view meaning) {
  const int last = static_cast<int>(choices.size()) - 1;
  return {{section, key, {}, meaning, 0, last, std::move(choices), {}},
          [member](const Record& record) { return static_cast<int>(record.*member); },
          [member](Record& record, int value) { record.*member = static_cast<Enum>(value); }};
}

}  // namespace phongpipe
