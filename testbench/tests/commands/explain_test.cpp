// explain: the values of the picture, the same in text and JSON, and what it refuses.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstring>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

using Json = nlohmann::json;

class Explain : public Program {
 protected:
  Json explain(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), "explain");
    arguments.insert(arguments.end(), {"--json", file("pixel.json")});
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 0) << output.text;
    return json("pixel.json");
  }
};

TEST_F(Explain, FinalValuesAreThoseOfRender) {
  ASSERT_EQ(run({"render", "torus", "-o", file("torus.pfm")}).status, 0);
  const std::string picture = read_whole_file(file("torus.pfm"));
  constexpr int kWidth = 512, kHeight = 512;
  constexpr std::size_t kColor = 3 * sizeof(float);
  const std::size_t header = picture.size() - kWidth * kHeight * kColor;
  const auto rendered = [&](int x, int y) {  // the bottom row comes first
    std::array<float, 3> color{};
    const auto place = static_cast<std::size_t>((kHeight - 1 - y) * kWidth + x);
    std::memcpy(color.data(), picture.data() + header + place * kColor, kColor);
    return Json(color);
  };
  for (const auto& [x, y] : {std::pair{256, 102}, {80, 256}, {400, 330}, {256, 450}}) {
    const Json story = explain({"torus", "--pixel", fmt::format("{},{}", x, y)});
    EXPECT_EQ(story["pixel"], (Json{{"x", x}, {"y", y}}));
    EXPECT_EQ(story["output"], rendered(x, y)) << x << "," << y;
    ASSERT_EQ(story["neighbours"].size(), 8U);
    for (const Json& neighbour : story["neighbours"]) {
      EXPECT_EQ(neighbour["output"], rendered(neighbour["x"], neighbour["y"]));
    }
    for (const Json& visit : story["visits"]) {
      EXPECT_EQ(visit["cycle"]["systemc"], visit["cycle"]["rtl"]);
      EXPECT_GT(visit["cycle"]["rtl"], 0);
    }
  }
}

TEST_F(Explain, CyclesAreThoseOfTheBackPressureAskedFor) {
  const auto cycle = [&](std::vector<std::string> options) {
    options.insert(options.begin(), {"sphere", "--pixel", "100,120"});
    const Json visit = explain(options)["visits"][0]["cycle"];
    EXPECT_EQ(visit["systemc"], visit["rtl"]);
    return visit["rtl"].get<int>();
  };
  const int stalled = cycle({"--stall", "60"});
  EXPECT_GT(stalled, cycle({}));
  EXPECT_NE(stalled, cycle({"--stall", "60", "--seed", "2"}));
}

TEST_F(Explain, PartsInJsonAddUpToTheErrorExactly) {
  // In the last one a normal vanishes, and the coefficients of its series are no numbers.
  for (const char* scene :
       {"teapot", "effects/two-lights", "effects/depth-cue",
        PHONGPIPE_SOURCES "/testbench/hard_cases/normals/cancel-at-the-centroid.toml"}) {
    const Json story = explain({scene, "--worst"});
    const std::size_t channels = story["output"].size();
    ASSERT_EQ(story["error_parts"].size(), 7U);
    for (std::size_t c = 0; c < channels; ++c) {
      double sum = 0;
      for (const Json& part : story["error_parts"]) sum += part[c].get<double>();
      EXPECT_EQ(sum, story["error_lsb"][c].get<double>()) << scene;
      EXPECT_EQ(sum, story["output"][c].get<double>() - story["exact_lsb"][c].get<double>());
    }
  }
}

TEST_F(Explain, WorstIsTheFirstWorstPixelOfVerify) {
  const Json verified = verify({"sphere"});
  const Json& worst = verified["worst_pixels"];
  ASSERT_EQ(worst.size(), 10U);
  for (std::size_t i = 1; i < worst.size(); ++i) {
    EXPECT_GE(worst[i - 1]["error_lsb"], worst[i]["error_lsb"]);
  }
  const Json story = explain({"sphere", "--worst"});
  EXPECT_EQ(story["pixel"]["x"], worst[0]["x"]);
  EXPECT_EQ(story["pixel"]["y"], worst[0]["y"]);
  double largest = 0;
  for (const Json& error : story["error_lsb"]) {
    largest = std::max(largest, std::fabs(error.get<double>()));
  }
  EXPECT_NEAR(worst[0]["error_lsb"].get<double>(), largest, 1e-11);
}

TEST_F(Explain, TextAndJsonSayTheSame) {
  const std::string json_text = run_for_answer("explain sphere --pixel 128,128 --json -").text;
  const Json story = Json::parse(json_text);
  EXPECT_EQ(story, explain({"sphere", "--pixel", "128,128"}));
  const std::string text = run_for_answer("explain sphere --pixel 128,128").text;
  EXPECT_EQ(text.rfind(fmt::format("sphere  pixel 128,128: triangle {}, hardware default",
                                   story["triangle"].get<int>()),
                       0),
            0U)
      << text;
  const Json& span = story["lights"][0]["span"];
  EXPECT_GT(span["registers"].size(), 20U);
  const std::size_t middle = text.find("registers of all stages");
  for (const char* list : {"start", "registers"}) {
    const bool at_start = list == std::string_view("start");
    const std::string half = at_start ? text.substr(0, middle) : text.substr(middle);
    for (const auto& [name, value] : span[list].items()) {
      const std::size_t place = half.find("      " + name + " ");
      ASSERT_NE(place, std::string::npos) << list << " " << name;
      const std::string line = half.substr(place, half.find('\n', place) - place);
      EXPECT_NE(line.find(" " + value["hex"].get<std::string>() + " "), std::string::npos) << line;
    }
  }
  for (const auto& [name, part] : story["error_parts"].items()) {
    EXPECT_NE(text.find(fmt::format("{:+.6f}", part[0].get<double>())), std::string::npos) << name;
  }
  EXPECT_NE(text.find(fmt::format("address {} ", span["table"]["address"].get<int>())),
            std::string::npos);
  EXPECT_NE(text.find(fmt::format("cycle {} in SystemC",
                                  story["visits"][0]["cycle"]["systemc"].get<int>())),
            std::string::npos);
}

TEST_F(Explain, RefusesWhatIsNoPixel) {
  const std::string output = file("story.json");
  for (const char* pixel : {"5", "1,2,3", "1,2,x", "a,b", "1,", "1.5,2"}) {
    expect_refused({"explain", "sphere", "--pixel", pixel, "--json", output},
                   fmt::format("--pixel {}: give X,Y", pixel));
  }
  expect_refused({"explain", "sphere"}, "Give one of --pixel X,Y and --worst");
  expect_refused({"explain", "sphere", "--worst", "--pixel", "1,2"},
                 "Give one of --pixel X,Y and --worst");
  expect_refused({"explain", "sphere", "--pixel", "256,0", "--json", output},
                 "x goes from 0 to 255, y from 0 to 255");
  expect_refused({"explain", "sphere", "--pixel", "-1,0"}, "x goes from 0 to 255");
  expect_refused({"explain", "sphere", "--pixel", "0,0", "--json", output},
                 "is not covered; the nearest that is: ");
  expect_refused({"explain", write_empty_picture(), "--worst"}, "nor is any other");
  expect_refused({"explain", "sphere", "--pixel", "128,128", "--json", file("no/such.json")}, "no");
}

}  // namespace
}  // namespace phongpipe
