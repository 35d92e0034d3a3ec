// The pipeline's two queues keep the time of a registered queue in hardware: what one clock writes
// is seen in the next, and so is the place that one clock frees.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "sim/clocked_fifo.h"
#include "sim/timestamped_fifo.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

constexpr unsigned kQueueSeed = 53;
constexpr int kScenarios = 60, kItems = 80;

struct Scenario {
  int depth;
  std::vector<Cycle> making, using_up;  // cycles from one item to the next, at least 1
};

struct QueueTimes {
  std::vector<Cycle> written, read;
  std::vector<int> items;  // as they were read
};

// A counter and two flags that are looked at before the clock's edge.
QueueTimes by_hand(const Scenario& s) {
  QueueTimes times;
  Cycle may_write = 0, may_read = 0;
  for (Cycle cycle = 0; times.read.size() < s.using_up.size(); ++cycle) {
    const std::size_t waiting = times.written.size() - times.read.size();
    const std::size_t next = times.written.size(), taken = times.read.size();
    if (waiting > 0 && cycle >= may_read) {
      times.read.push_back(cycle);
      times.items.push_back(static_cast<int>(taken));
      if (taken + 1 < s.using_up.size()) may_read = cycle + s.using_up[taken + 1];
    }
    if (next < s.making.size() && waiting < static_cast<std::size_t>(s.depth) &&
        cycle >= may_write) {
      times.written.push_back(cycle);
      if (next + 1 < s.making.size()) may_write = cycle + s.making[next + 1];
    }
  }
  return times;
}

class AheadOfTheClock : public sc_core::sc_module {
 public:
  AheadOfTheClock(const sc_core::sc_module_name& name, const Scenario& scenario)
      : sc_core::sc_module(name), scenario_(scenario), fifo_("fifo", scenario.depth) {
    SC_THREAD(produce);
    SC_THREAD(consume);
  }
  SC_HAS_PROCESS(AheadOfTheClock);
  QueueTimes times;

 private:
  void produce() {
    Cycle earliest = 0;
    for (std::size_t i = 0; i < scenario_.making.size(); ++i) {
      if (i > 0) earliest = times.written.back() + scenario_.making[i];
      const auto item = static_cast<int>(i);
      if (i % 2 == 0) {
        times.written.push_back(fifo_.write(item, earliest));
      } else {
        fifo_.free_slot() = item;
        times.written.push_back(fifo_.write(earliest));
      }
    }
    fifo_.close();
  }
  void consume() {
    for (std::size_t i = 0; fifo_.wait_for_item(); ++i) {
      Cycle cycle = fifo_.front_seen_from();
      if (i > 0) cycle = std::max(cycle, times.read.back() + scenario_.using_up[i]);
      times.read.push_back(cycle);
      times.items.push_back(fifo_.front());
      for (std::size_t k = 0; k < fifo_.side_by_side(); ++k) {
        EXPECT_EQ((&fifo_.front())[k], times.items.back() + static_cast<int>(k));
      }
      most_side_by_side_ = std::max(most_side_by_side_, fifo_.side_by_side());
      fifo_.pop(cycle);
    }
    EXPECT_EQ(most_side_by_side_, fifo_.depth()) << "the writer runs ahead until it is full";
  }
  Scenario scenario_;
  TimestampedFifo<int> fifo_;
  std::size_t most_side_by_side_ = 0;
};

class WithTheClock : public sc_core::sc_module {
 public:
  WithTheClock(const sc_core::sc_module_name& name, const Scenario& scenario,
               sc_core::sc_clock& clk)
      : sc_core::sc_module(name), scenario_(scenario), fifo_("fifo", scenario.depth) {
    SC_METHOD(produce);
    sensitive << clk.posedge_event();
    dont_initialize();
    SC_METHOD(consume);
    sensitive << clk.posedge_event();
    dont_initialize();
  }
  SC_HAS_PROCESS(WithTheClock);
  QueueTimes times;

 private:
  void produce() {
    const Cycle cycle = producer_cycle_++;
    const std::size_t i = times.written.size();
    if (i == scenario_.making.size() || fifo_.full()) return;
    if (i > 0 && cycle < times.written.back() + scenario_.making[i]) return;
    fifo_.push(static_cast<int>(i));
    times.written.push_back(cycle);
  }
  void consume() {
    const Cycle cycle = consumer_cycle_++;
    const std::size_t i = times.read.size();
    if (fifo_.empty()) return;
    if (i > 0 && cycle < times.read.back() + scenario_.using_up[i]) return;
    times.items.push_back(fifo_.front());
    fifo_.pop();
    times.read.push_back(cycle);
  }
  Scenario scenario_;
  ClockedFifo<int> fifo_;
  Cycle producer_cycle_ = 0, consumer_cycle_ = 0;
};

void expect_times(const QueueTimes& times, const QueueTimes& expected, const std::string& which) {
  EXPECT_EQ(times.written, expected.written) << which;
  EXPECT_EQ(times.read, expected.read) << which;
  EXPECT_EQ(times.items, expected.items) << which;
}

TEST(Queues, KeepTheTimeOfARegisteredQueue) {
  SCOPED_TRACE(kQueueSeed);
  Random random(kQueueSeed);
  const auto pick = [&random](int low, int high) { return random.integer(low, high); };
  sc_core::sc_clock clk("clk", sc_core::sc_time(1, sc_core::SC_NS), 0.5,
                        sc_core::sc_time(1, sc_core::SC_NS));
  std::vector<QueueTimes> expected;
  std::vector<std::unique_ptr<AheadOfTheClock>> ahead;
  std::vector<std::unique_ptr<WithTheClock>> clocked;
  for (int i = 0; i < kScenarios; ++i) {
    Scenario scenario{pick(1, 6), {}, {}};
    const int slowest_maker = pick(1, 8), slowest_user = pick(1, 8);
    for (int k = 0; k < kItems; ++k) {
      scenario.making.push_back(pick(1, slowest_maker));
      scenario.using_up.push_back(pick(1, slowest_user));
    }
    expected.push_back(by_hand(scenario));
    ahead.push_back(
        std::make_unique<AheadOfTheClock>(("ahead" + std::to_string(i)).c_str(), scenario));
    clocked.push_back(
        std::make_unique<WithTheClock>(("clocked" + std::to_string(i)).c_str(), scenario, clk));
  }
  sc_core::sc_start(kItems * 20, sc_core::SC_NS);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    expect_times(ahead[i]->times, expected[i], "TimestampedFifo, scenario " + std::to_string(i));
    expect_times(clocked[i]->times, expected[i], "ClockedFifo, scenario " + std::to_string(i));
  }
}

// A queue of one place moves an item every other clock, as both its flags are registered: what the
// account by hand has to say of itself.
TEST(Queues, OfOnePlaceMoveAnItemEveryOtherClock) {
  const QueueTimes times = by_hand({1, std::vector<Cycle>(10, 1), std::vector<Cycle>(10, 1)});
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(times.written[i], 2 * static_cast<Cycle>(i));
    EXPECT_EQ(times.read[i], 2 * static_cast<Cycle>(i) + 1);
  }
}

}  // namespace
}  // namespace phongpipe
