// report: a page and a chart of a campaign; the pages of verify.
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "testbench/campaign/pareto.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class Reports : public Program {
 protected:
  ProcessOutput sweep(const std::string& scene, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments = {"sweep",  scene,
                                          "--set",  "scene.image.width=96",
                                          "--set",  "scene.image.height=96",
                                          "--set",  "scene.object.0.segments=[12,8]",
                                          "--vary", "rom_address_bits=5:9",
                                          "--vary", "diffuse_fraction_bits=4,8,16",
                                          "--rtl",  "off",
                                          "--db",   file("a.db")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  ProcessOutput report() const { return run({"report", file("a.db"), "-o", file("a.html")}); }
  ResultTable table() const { return Store(file("a.db"), Store::Access::read).table(); }
  nlohmann::json data(const std::string& name) const {
    const std::string page = read_whole_file(file(name)), begin = "id=\"data\">";
    const std::size_t from = page.find(begin) + begin.size();
    return nlohmann::json::parse(page.substr(from, page.find("</script>", from) - from));
  }
  static nlohmann::json column(const nlohmann::json& data, const std::string& name) {
    for (const auto& column : data["columns"]) {
      if (column["name"] == name) return column;
    }
    return nullptr;
  }
  // The values of a column in all rows.
  static std::vector<nlohmann::json> values(const nlohmann::json& data, const std::string& name) {
    const nlohmann::json found = column(data, name);
    std::vector<nlohmann::json> result;
    for (std::size_t row = 0; row < data["rows"]; ++row) {
      result.push_back(found.contains("same") ? found["same"]
                       : found.contains("values")
                           ? found["values"][row]
                           : found["words"][found["index"][row].get<std::size_t>()]);
    }
    return result;
  }
};

TEST_F(Reports, ShowsEveryRunWithPicturesOfTheFront) {
  ASSERT_EQ(sweep("sphere").status, 0);
  const ProcessOutput output = report();
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("15 runs of sphere.\n12 passed, 0 failed, 3 refused.\nBest"),
            std::string::npos)
      << output.text;
  const nlohmann::json page = data("a.html");
  EXPECT_EQ(page["rows"], 15);
  const std::vector<std::size_t> front = fronts_by_scene(table()).front();
  ASSERT_FALSE(front.empty());
  EXPECT_EQ(page["pictures"].size(), front.size());
  for (const std::size_t row : front) {
    const auto& pictures = page["pictures"].at(std::to_string(row));
    ASSERT_EQ(pictures.size(), 2U);
    const std::string png = page["images"][pictures[0][1].get<std::size_t>()];
    EXPECT_EQ(png.rfind("data:image/png;base64,iVBORw0KGgo", 0), 0U)
        << "the first bytes of a PNG file";
  }
  const ResultTable runs = table();
  const auto bits = values(page, "datapath.rom_address_bits");
  const auto adders = values(page, "setup_engine.adders");
  const auto errors = values(page, "max_lsb");
  for (std::size_t row = 0; row < runs.rows.size(); ++row) {
    EXPECT_EQ(bits[row], *runs.number(row, "datapath.rom_address_bits")) << "refused ones, too";
    const bool refused = runs.text(row, "outcome") == "refused";
    EXPECT_EQ(adders[row].is_null(), refused) << "of hardware that is not legal";
    ASSERT_EQ(errors[row].is_null(), refused);
    if (refused) continue;
    EXPECT_NEAR(errors[row], *runs.number(row, "max_lsb"), 1e-5 * *runs.number(row, "max_lsb"));
  }
  EXPECT_EQ(read_whole_file(file("a.svg")).rfind("<svg", 0), 0U);
  EXPECT_NE(read_whole_file(file("a.svg")).find("Pareto front"), std::string::npos);
}

TEST_F(Reports, EachSceneHasItsFrontAndARegressionHasNone) {
  ASSERT_EQ(run({"sweep", "sphere", "torus", "--vary", "rom_address_bits=6:9", "--vary",
                 "budget=1000", "--rtl", "off", "--db", file("a.db")})
                .status,
            0);
  ProcessOutput output = report();
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("\nsphere: Best"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("\ntorus: Best"), std::string::npos) << output.text;
  EXPECT_NE(read_whole_file(file("a.svg")).find("Pareto front of torus"), std::string::npos);
  std::set<std::string> scenes;
  const ResultTable runs = table();
  const nlohmann::json page = data("a.html");
  for (const auto& [row, pictures] : page["pictures"].items()) {
    scenes.insert(runs.text(std::stoul(row), "scene"));
  }
  EXPECT_EQ(scenes, (std::set<std::string>{"sphere", "torus"}));

  fs::remove(file("a.db"));
  ASSERT_EQ(run({"regress", "--random", "--count", "8", "--seed", "7", "--rtl", "off", "--db",
                 file("a.db")})
                .status,
            0);
  output = report();
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("Slowest: "), std::string::npos) << output.text;
  EXPECT_EQ(data("a.html")["alternatives"], false);
}

TEST_F(Reports, AreTheSameEachTime) {
  ASSERT_EQ(sweep("sphere").status, 0);
  ASSERT_EQ(report().status, 0);
  const std::string first = read_whole_file(file("a.html"));
  ASSERT_EQ(report().status, 0);
  EXPECT_TRUE(read_whole_file(file("a.html")) == first);
}

TEST_F(Reports, SayWhichScenesAreGoneOrHaveChanged) {
  const std::string scene = write("own.toml", shipped_scene("sphere"));
  ASSERT_EQ(sweep(scene).status, 0);
  std::string changed = shipped_scene("sphere");
  const std::string key = "shininess = ";
  changed.insert(changed.find(key) + key.size(), "1");
  write("own.toml", changed);
  ProcessOutput output = report();
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("has changed since"), std::string::npos) << output.text;
  EXPECT_TRUE(data("a.html")["pictures"].empty());
  fs::remove(scene);
  output = report();
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("are without pictures"), std::string::npos) << output.text;
  EXPECT_NE(read_whole_file(file("a.html")).find("are without pictures"), std::string::npos);
  EXPECT_EQ(data("a.html")["rows"], 15);
  EXPECT_TRUE(data("a.html")["pictures"].empty());
}

TEST_F(Reports, OfNothingAreRefused) {
  expect_refused({"report", file("none.db"), "-o", file("a.html")}, "no such file");
  Store(file("a.db"), Store::Access::write, "sweep");
  fs::remove(file("a.db-journal"));
  expect_refused({"report", file("a.db"), "-o", file("a.html")}, "no runs yet");
  expect_refused({"report", file("a.db"), "-o", file("a.db")}, "would replace the results");
  expect_refused({"report", file("a.db"), "-o", file("a.svg")}, "needs another name");
  expect_refused({"report", file("a.db"), "-o", file("none/a.html")}, "none");
  expect_refused({"report", file("a.db")}, "--output");
}

TEST_F(Reports, VerifyWritesItsScenesAsAPage) {
  const ProcessOutput output =
      run({"verify", "sphere", "torus", "--set", "scene.image.width=96", "--set",
           "scene.image.height=96", "--budget", "1000", "--out", folder_.string()});
  ASSERT_EQ(output.status, 0) << output.text;
  const nlohmann::json page = data("verify.html");
  EXPECT_EQ(page["rows"], 2);
  EXPECT_EQ(page["alternatives"], false);
  EXPECT_EQ(page["pictures"]["0"].size(), 3U);
  EXPECT_EQ(page["pictures"]["1"].size(), 3U);
  EXPECT_EQ(column(page, "rtl_mismatches")["same"], 0);
  EXPECT_EQ(values(page, "scene"), (std::vector<nlohmann::json>{"sphere", "torus"}));
  EXPECT_TRUE(column(page, "seconds").is_null()) << "not measured";
}

}  // namespace
}  // namespace phongpipe
