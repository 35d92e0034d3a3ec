// Tables in memory: 1 read per look-up. Forming the address is free: the stepped value is scaled so
// that its integer part is the address.
#pragma once

#include <vector>

#include "model/shading/dataflow.h"

namespace phongpipe {

// A function of [0, end] sampled at equal distances; arguments outside saturate.
class LookupTable {
 public:
  template <typename Function>
  LookupTable(int words, double end, Function function) : scale_((words - 1) / end) {
    words_.reserve(static_cast<std::size_t>(words));
    for (int i = 0; i < words; ++i) words_.push_back(function(i / scale_));
  }

  // The word nearest to x.
  double at(double x) const {
    const double address = x * scale_ + 0.5;
    if (!(address > 0)) return words_.front();
    const auto index = static_cast<std::size_t>(address);
    return index < words_.size() ? words_[index] : words_.back();
  }

 private:
  std::vector<double> words_;
  double scale_;
};

inline double lookup(const LookupTable& table, double x) {
  return table.at(x);
}
inline Recorded lookup(const LookupTable&, const Recorded& x) {
  return read_word(x);
}

}  // namespace phongpipe
