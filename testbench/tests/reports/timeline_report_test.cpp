// The reports of a timeline: trace events that Perfetto takes, and a picture that adds up.
#include "testbench/reports/timeline_report.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>

#include "testbench/cases/named_scene.h"

namespace phongpipe {
namespace {

using nlohmann::json;

Timeline timeline_of(const std::string& scene, int stall_percent) {
  VerificationOptions options;
  options.stall_percent = stall_percent;
  return record_timeline(std::make_shared<const PreparedScene>(load_named_scene(scene)),
                         load_hardware("default", {"rom_address_bits=6"}), options);
}

TEST(TimelineReport, SlicesOfEachThreadFillTheFrameWithoutOverlap) {
  for (const char* scene : {"sphere", "effects/two-lights", "random:3", "random:4", "random:5"}) {
    for (const int stall_percent : {0, 40}) {
      SCOPED_TRACE(scene);
      const Timeline timeline = timeline_of(scene, stall_percent);
      std::map<int, std::string> threads;
      std::map<int, std::int64_t> ends;
      std::map<std::string, std::int64_t> samples;  // the last one's time
      std::string process;
      const json trace = json::parse(timeline_json(timeline, scene));
      for (const json& event : trace["traceEvents"]) {
        EXPECT_EQ(event["pid"], 1);
        if (event["name"] == "process_name") process = event["args"]["name"];
        if (event["name"] == "thread_name") threads[event["tid"]] = event["args"]["name"];
        if (event["ph"] == "X") {
          ASSERT_TRUE(event["ts"].is_number_integer() && event["dur"].is_number_integer());
          ASSERT_EQ(event["ts"], ends[event["tid"]]) << event;
          ASSERT_GT(event["dur"], 0);
          ASSERT_EQ(event.contains("args"), event["name"] == "busy") << event;
          ends[event["tid"]] += event["dur"].get<std::int64_t>();
        }
        if (event["ph"] == "C") {
          const std::string queue = event["name"];
          ASSERT_TRUE(samples.count(queue) == 0 || samples[queue] < event["ts"]) << event;
          samples[queue] = event["ts"];
        }
      }
      EXPECT_EQ(process, "SystemC");
      ASSERT_EQ(threads.size(), kModules.size());
      for (const Module module : kModules) {
        const int thread = static_cast<int>(module) + 1;
        EXPECT_EQ(threads[thread], name(module));
        EXPECT_EQ(ends[thread], timeline.frame_cycles) << name(module);
      }
      EXPECT_EQ(samples.size(), 3U);
      for (const char* queue : {"triangles", "spans", "pixels"})
        EXPECT_EQ(samples.count(queue), 1U);
    }
  }
}

// 10 cycles; the setup engine is stalled for 2 and done for 1.
Timeline small_timeline() {
  Timeline timeline;
  timeline.frame_cycles = 10;
  timeline.modules.resize(kModules.size());
  for (ModuleActivity& activity : timeline.modules) {
    activity.starts = {0, 4, 6, 9};
    activity.triangles = {0, 0, 1, 0};
    activity.states = {ModuleState::busy, ModuleState::stalled, ModuleState::busy,
                       ModuleState::done};
    activity.fill_cycles = {0};
    activity.fills = {3};
  }
  timeline.modules.back().states = {ModuleState::waiting, ModuleState::busy, ModuleState::busy,
                                    ModuleState::busy};
  return timeline;
}

TEST(TimelineReport, PictureTellsSharesAndWhatLimitsTheFrame) {
  const std::string picture = timeline_picture(small_timeline(), "a<b>&\x01");
  for (const char* text :
       {"<title>a&lt;b&gt;&amp;\\x01: limited by setup_engine</title>",
        ">It works in 70.0 % of the frame's 10 cycles", ">busy 70.0 %<",
        ">stalled by span_walker 20.0 %<", ">stalled by framebuffer 20.0 %<", ">done 10.0 %<",
        ">waiting for pixel_datapath 40.0 %<", ">busy 60.0 %<"}) {
    EXPECT_NE(picture.find(text), std::string::npos) << text << "\n" << picture;
  }
  EXPECT_EQ(picture.rfind("</svg>\n"), picture.size() - 7);
}

TEST(TimelineReport, EventsNameStatesTrianglesAndQueues) {
  const json events = json::parse(timeline_json(small_timeline(), "\xff"))["traceEvents"];
  const auto count = [&events](const json& wanted) {
    return std::count(events.begin(), events.end(), wanted);
  };
  EXPECT_EQ(count({{"ph", "X"},
                   {"pid", 1},
                   {"tid", 1},
                   {"ts", 4},
                   {"dur", 2},
                   {"name", "stalled by span_walker"}}),
            1);
  EXPECT_EQ(count({{"ph", "X"},
                   {"pid", 1},
                   {"tid", 3},
                   {"ts", 6},
                   {"dur", 3},
                   {"name", "busy"},
                   {"args", {{"triangle", 1}}}}),
            1);
  EXPECT_EQ(
      count({{"ph", "C"}, {"pid", 1}, {"ts", 0}, {"name", "spans"}, {"args", {{"items", 3}}}}), 1);
}

}  // namespace
}  // namespace phongpipe
