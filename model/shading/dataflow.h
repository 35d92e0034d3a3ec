// A scalar that records the operations applied to it. Running a formula template with it gives the
// operations executed and their dependences. So operation counts and the setup engine's schedule
// come from the same templates as the values.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "model/shading/fields.h"

namespace phongpipe {

// The setup engine has the first four; software shaders also divide, take roots and read tables.
// `power` takes any constant exponent: logarithm, product and exponential, by tables.
enum class Operation { add, multiply, rsqrt, power, divide, sqrt, read };

struct OperationCounts {
  std::size_t add = 0, multiply = 0, rsqrt = 0;
  std::size_t divide = 0, sqrt = 0, read = 0;  // read: one word of a table in memory
  std::size_t power = 0;

  static constexpr auto fields() {
    using C = OperationCounts;
    return std::make_tuple(field("add", &C::add), field("multiply", &C::multiply),
                           field("rsqrt", &C::rsqrt), field("divide", &C::divide),
                           field("sqrt", &C::sqrt), field("read", &C::read),
                           field("power", &C::power));
  }
};
OperationCounts operator+(const OperationCounts& a, const OperationCounts& b);
OperationCounts operator-(const OperationCounts& a, const OperationCounts& b);
OperationCounts operator*(std::size_t times, const OperationCounts& counts);
bool operator==(const OperationCounts& a, const OperationCounts& b);
inline bool operator!=(const OperationCounts& a, const OperationCounts& b) {
  return !(a == b);
}

// Nodes in the order of execution; an operand is the index of an earlier node or kInput.
struct Dataflow {
  static constexpr int kInput = -1;
  struct Node {
    Operation operation;
    int left;
    int right;  // kInput for rsqrt, sqrt and read
  };
  std::vector<Node> nodes;

  OperationCounts counts() const;
};

// Operations on Recorded values enter the dataflow of the current Recording; constants and inputs
// cost nothing.
class Recorded {
 public:
  Recorded() = default;
  Recorded(double) {}  // NOLINT(google-explicit-constructor): constants appear in the formulas

  Recorded operator-() const { return *this; }  // a sign flip needs no unit
  friend Recorded operator+(const Recorded& a, const Recorded& b) {
    return Recorded(Operation::add, a.node_, b.node_);
  }
  friend Recorded operator-(const Recorded& a, const Recorded& b) { return a + b; }
  friend Recorded operator*(const Recorded& a, const Recorded& b) {
    return Recorded(Operation::multiply, a.node_, b.node_);
  }
  Recorded& operator+=(const Recorded& b) { return *this = *this + b; }
  Recorded& operator-=(const Recorded& b) { return *this = *this - b; }
  Recorded& operator*=(const Recorded& b) { return *this = *this * b; }
  friend Recorded rsqrt(const Recorded& x) {
    return Recorded(Operation::rsqrt, x.node_, Dataflow::kInput);
  }
  friend Recorded power(const Recorded& x, const Recorded& p) {
    return Recorded(Operation::power, x.node_, p.node_);
  }
  friend Recorded operator/(const Recorded& a, const Recorded& b) {
    return Recorded(Operation::divide, a.node_, b.node_);
  }
  friend Recorded sqrt(const Recorded& x) {
    return Recorded(Operation::sqrt, x.node_, Dataflow::kInput);
  }
  friend Recorded read_word(const Recorded& address) {
    return Recorded(Operation::read, address.node_, Dataflow::kInput);
  }
  friend Recorded half(const Recorded& x) { return x; }
  friend Recorded twice(const Recorded& x) { return x; }

 private:
  Recorded(Operation operation, int left, int right);
  int node_ = Dataflow::kInput;
};

// While it exists, collects its thread's operations on Recorded values in dataflow(). Not nested.
class Recording {
 public:
  Recording();
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  const Dataflow& dataflow() const { return dataflow_; }

 private:
  friend class Recorded;
  Dataflow dataflow_;
};

}  // namespace phongpipe

namespace Eigen {
template <>
struct NumTraits<phongpipe::Recorded> : NumTraits<double> {
  using Real = phongpipe::Recorded;
  using NonInteger = phongpipe::Recorded;
  using Nested = phongpipe::Recorded;
  enum { RequireInitialization = 1 };
};
}  // namespace Eigen
