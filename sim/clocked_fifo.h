// A bounded queue between modules that act in every clock. An item written in one clock becomes
// visible in the next, and so does a slot freed: both flags are registered, as in hardware.
// (sc_fifo is similar, but cannot show its front item without removing it, which valid/ready
// needs.)
#pragma once

#include <systemc>
#include <vector>

namespace phongpipe {

template <typename T>
class ClockedFifo : public sc_core::sc_prim_channel {
 public:
  ClockedFifo(const char* name, int depth)
      : sc_core::sc_prim_channel(name), slots_(static_cast<std::size_t>(depth)) {}

  bool empty() const { return size_ == 0; }
  bool full() const { return size_ == slots_.size(); }
  std::size_t size() const { return size_; }
  std::size_t depth() const { return slots_.size(); }

  const T& front() const { return slots_[first_]; }  // while not empty
  void pop() {                                       // once a clock, while not empty
    popped_ = true;
    request_update();
  }
  void push(T item) {  // once a clock, while not full
    slots_[(first_ + size_) % slots_.size()] = std::move(item);
    pushed_ = true;
    request_update();
  }

 private:
  void update() override {
    if (popped_) {
      first_ = (first_ + 1) % slots_.size();
      --size_;
    }
    if (pushed_) ++size_;
    popped_ = pushed_ = false;
  }

  std::vector<T> slots_;
  std::size_t first_ = 0, size_ = 0;
  bool popped_ = false, pushed_ = false;
};

}  // namespace phongpipe
