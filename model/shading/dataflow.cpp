#include "model/shading/dataflow.h"

#include <stdexcept>

namespace phongpipe {
namespace {

thread_local Recording* current = nullptr;

}  // namespace

OperationCounts Dataflow::counts() const {
  OperationCounts counts;
  for (const Node& node : nodes) {
    switch (node.operation) {
      case Operation::add: ++counts.add; break;
      case Operation::multiply: ++counts.multiply; break;
      case Operation::rsqrt: ++counts.rsqrt; break;
    }
  }
  return counts;
}

Recording::Recording() {
  if (current != nullptr) throw std::logic_error("a Recording is alive already");
  current = this;
}

Recording::~Recording() { current = nullptr; }

Recorded::Recorded(Operation operation, int left, int right) {
  if (current == nullptr) throw std::logic_error("Recorded used outside a Recording");
  auto& nodes = current->dataflow_.nodes;
  nodes.push_back({operation, left, right});
  node_ = static_cast<int>(nodes.size()) - 1;
}

}  // namespace phongpipe
