// Simulations in processes of their own, since SystemC elaborates once a process.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include "sim/pipeline.h"
#include "testbench/system/process.h"

namespace phongpipe {

// What a SimulationResult says, in a form that travels between processes.
struct Trace {
  std::vector<ShadedPixel> stream;
  std::vector<std::uint32_t> cycles;  // of each pixel
  std::vector<std::uint32_t> colors;  // of the image at the end
  std::int64_t frame_cycles = 0, datapath_cycles = 0, setup_cycles = 0, rom_load_cycles = 0;
  std::int64_t busy_cycles = 0;  // of the datapath
  std::string failure;
};

class TraceText {  // writes where it is empty, reads where it is not
 public:
  explicit TraceText(std::string text = {}) : text_(std::move(text)), reads_(!text_.empty()) {}

  template <typename T>
  TraceText& operator()(std::vector<T>& items) {
    auto size = static_cast<std::int64_t>(items.size());
    (*this)(size);
    items.resize(static_cast<std::size_t>(size));
    bytes(items.data(), items.size() * sizeof(T));
    return *this;
  }
  TraceText& operator()(std::int64_t& number) {
    bytes(&number, sizeof(number));
    return *this;
  }
  TraceText& operator()(std::string& string) {
    std::vector<char> letters(string.begin(), string.end());
    (*this)(letters);
    string.assign(letters.begin(), letters.end());
    return *this;
  }
  TraceText& operator()(Trace& t) {
    return (*this)(t.stream)(t.cycles)(t.colors)(t.frame_cycles)(t.datapath_cycles)(t.setup_cycles)(
        t.rom_load_cycles)(t.failure);
  }
  const std::string& text() const { return text_; }

 private:
  void bytes(void* data, std::size_t count) {
    if (count == 0) return;
    if (reads_) {
      std::memcpy(data, text_.data() + place_, count);
      place_ += count;
    } else {
      text_.append(static_cast<const char*>(data), count);
    }
  }
  std::string text_;
  bool reads_;
  std::size_t place_ = 0;
};

inline Trace trace_of(const SimulationResult& result) {
  Trace trace;
  trace.stream = result.stream;
  trace.cycles = result.pixel_cycles;
  for (std::size_t i = 0; i < result.framebuffer.size(); ++i) {
    trace.colors.push_back(result.framebuffer.color(i));
  }
  trace.frame_cycles = result.frame_cycles;
  trace.datapath_cycles = result.datapath_cycles;
  trace.setup_cycles = result.setup_cycles;
  trace.rom_load_cycles = result.rom_load_cycles;
  trace.busy_cycles = result.datapath_busy_cycles;
  trace.failure = result.failure;
  return trace;
}

inline Trace simulate_apart(const FrameSetup& frame, const Geometry& geometry,
                            const PipelineConfiguration& configuration,
                            const SimulationOptions& options) {
  Child child([&] {
    Trace trace = trace_of(simulate(frame, geometry, configuration, options));
    return TraceText()(trace).text();
  });
  Trace trace;
  TraceText{child.get()}(trace);
  return trace;
}

}  // namespace phongpipe
