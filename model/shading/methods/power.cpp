#include "model/shading/methods/power.h"

#include <cmath>
#include <stdexcept>

namespace phongpipe {
namespace {

constexpr int kTableWords = 1024;  // "a table of 1k bytes", with words that are not rounded

}  // namespace

const std::vector<PowerKind>& power_kinds() {
  static const std::vector<PowerKind> kinds = {PowerKind::exact,   PowerKind::table,
                                               PowerKind::schlick, PowerKind::lyon4,
                                               PowerKind::lyon8,   PowerKind::lyon16};
  return kinds;
}

std::string_view name(PowerKind kind) {
  switch (kind) {
    case PowerKind::exact:
      return "exact";
    case PowerKind::table:
      return "table";
    case PowerKind::schlick:
      return "schlick";
    case PowerKind::lyon4:
      return "lyon-4";
    case PowerKind::lyon8:
      return "lyon-8";
    case PowerKind::lyon16:
      return "lyon-16";
  }
  throw std::logic_error("unknown power");
}

Power::Power(PowerKind kind, double n) : kind_(kind), n_(n) {
  const int words = kind == PowerKind::table ? kTableWords : 0;
  table_ = std::make_shared<LookupTable>(words, 1, [n](double x) { return std::pow(x, n); });
}

int Power::squarings() const {
  switch (kind_) {
    case PowerKind::lyon4:
      return 2;
    case PowerKind::lyon8:
      return 3;
    case PowerKind::lyon16:
      return 4;
    default:
      return 0;
  }
}

double Power::operator()(double x) const {
  const double cosine = not_negative(x);
  return kind_ == PowerKind::exact ? std::pow(cosine, n_) : unit(cosine);
}

}  // namespace phongpipe
