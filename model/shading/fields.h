// Names the data members of a record once, for all code that visits every member: comparison,
// transfer between processes, JSON.
//
//     struct Record {
//       int a = 0;
//       std::string b;
//       static constexpr auto fields() {
//         return std::make_tuple(field("a", &Record::a), field("b", &Record::b));
//       }
//     };
//
// If fields() leaves out a member, code that uses the fields does not compile.
#pragma once

#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace phongpipe {

template <typename Record, typename Value>
struct Field {
  std::string_view name;
  Value Record::*member;
};

template <typename Record, typename Value>
constexpr Field<Record, Value> field(std::string_view name, Value Record::*member) {
  return {name, member};
}

template <typename Record, typename = void>
struct HasFields : std::false_type {};
template <typename Record>
struct HasFields<Record, std::void_t<decltype(Record::fields())>> : std::true_type {};

namespace detail {

// Converts to any type, so it can initialise any member of an aggregate.
struct AnyMember {
  template <typename T>
  constexpr operator T() const;  // NOLINT(google-explicit-constructor): the conversion is the point
};

// For a std::optional member, its constructor and AnyMember's conversion match equally well, and
// -Wconversion warns. Neither is ever run.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
template <typename Record, typename Indices, typename = void>
struct TakesMembers : std::false_type {};
template <typename Record, std::size_t... kIndex>
struct TakesMembers<
    Record, std::index_sequence<kIndex...>,
    std::void_t<decltype(Record{(static_cast<void>(kIndex), std::declval<AnyMember>())...})>>
    : std::true_type {};
#pragma GCC diagnostic pop

}  // namespace detail

// Whether fields() names every member: the aggregate takes exactly that many initialisers.
template <typename Record>
constexpr bool names_every_field() {
  constexpr std::size_t kNamed = std::tuple_size_v<decltype(Record::fields())>;
  return detail::TakesMembers<Record, std::make_index_sequence<kNamed>>::value &&
         !detail::TakesMembers<Record, std::make_index_sequence<kNamed + 1>>::value;
}

// Calls visit(name, value) for each member, in the order of fields(). `Record` may be const.
template <typename Record, typename Visit>
void for_each_field(Record& record, Visit&& visit) {
  using Plain = std::remove_const_t<Record>;
  static_assert(names_every_field<Plain>(), "fields() has forgotten a member");
  std::apply([&](const auto&... field) { (visit(field.name, record.*field.member), ...); },
             Plain::fields());
}

// Whether all members are equal.
template <typename Record>
bool equal_fields(const Record& a, const Record& b) {
  static_assert(names_every_field<Record>(), "fields() has forgotten a member");
  return std::apply(
      [&](const auto&... field) { return ((a.*field.member == b.*field.member) && ...); },
      Record::fields());
}

}  // namespace phongpipe
