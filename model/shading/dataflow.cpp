#include "model/shading/dataflow.h"

#include <stdexcept>

namespace phongpipe {
namespace {

thread_local Recording* current = nullptr;

}  // namespace

OperationCounts operator+(const OperationCounts& a, const OperationCounts& b) {
  OperationCounts sum = a;
  std::apply([&](const auto&... field) { ((sum.*field.member += b.*field.member), ...); },
             OperationCounts::fields());
  return sum;
}

OperationCounts operator*(std::size_t times, const OperationCounts& counts) {
  OperationCounts product = counts;
  std::apply([&](const auto&... field) { ((product.*field.member *= times), ...); },
             OperationCounts::fields());
  return product;
}

OperationCounts operator-(const OperationCounts& a, const OperationCounts& b) {
  OperationCounts difference = a;
  std::apply([&](const auto&... field) { ((difference.*field.member -= b.*field.member), ...); },
             OperationCounts::fields());
  return difference;
}

bool operator==(const OperationCounts& a, const OperationCounts& b) {
  return equal_fields(a, b);
}

OperationCounts Dataflow::counts() const {
  OperationCounts counts;
  for (const Node& node : nodes) {
    switch (node.operation) {
      case Operation::add:
        ++counts.add;
        break;
      case Operation::multiply:
        ++counts.multiply;
        break;
      case Operation::rsqrt:
        ++counts.rsqrt;
        break;
      case Operation::power:
        ++counts.power;
        break;
      case Operation::divide:
        ++counts.divide;
        break;
      case Operation::sqrt:
        ++counts.sqrt;
        break;
      case Operation::read:
        ++counts.read;
        break;
    }
  }
  return counts;
}

Recording::Recording() {
  if (current != nullptr) throw std::logic_error("a Recording is alive already");
  current = this;
}

Recording::~Recording() {
  current = nullptr;
}

Recorded::Recorded(Operation operation, int left, int right) {
  if (current == nullptr) throw std::logic_error("Recorded used outside a Recording");
  auto& nodes = current->dataflow_.nodes;
  nodes.push_back({operation, left, right});
  node_ = static_cast<int>(nodes.size()) - 1;
}

}  // namespace phongpipe
