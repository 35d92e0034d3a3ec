// Finding the result of a method.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "testbench/methods/comparison.h"

namespace phongpipe {

inline const MethodResult& result_of(const Comparison& comparison, std::string_view name) {
  for (const MethodResult& result : comparison.methods) {
    if (result.name == name) return result;
  }
  throw std::logic_error("no method " + std::string(name));
}

}  // namespace phongpipe
