// Pages of results: whole, harmless whatever texts they show, and small.
#include "testbench/reports/result_page.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "testbench/hardware/hardware.h"
#include "testbench/tests/occurrences.h"

namespace phongpipe {
namespace {

std::string between(const std::string& text, const std::string& begin, const std::string& end) {
  const std::size_t from = text.find(begin) + begin.size();
  return text.substr(from, text.find(end, from) - from);
}

nlohmann::json data_of(const std::string& page) {
  return nlohmann::json::parse(between(page, "id=\"data\">", "</script>"));
}

PageContent small_page() {
  PageContent page;
  page.title = "A title";
  page.x = "frame_ns_per_pixel";
  page.y = "max_lsb";
  for (const char* name : {"scene", "datapath.rom_address_bits", "frame_ns_per_pixel", "max_lsb"}) {
    page.columns.push_back(page_column(name));
  }
  for (int i = 0; i < 20; ++i) {
    page.rows.push_back({std::string("sphere"), MetricValue(std::int64_t{1000000007 + i % 2}),
                         MetricValue(1.0 / 3 + i), MetricValue()});
    page.commands.push_back(fmt::format("phongpipe verify sphere --seed {}", i % 2));
  }
  page.commands[3] = "phongpipe verify sphere";
  return page;
}

TEST(ResultPage, DescribesColumnsAsTheyAreDescribedElsewhere) {
  const Metric& metric = metrics()[metric_index("psnr_db")];
  const PageColumn column = page_column("psnr_db");
  EXPECT_EQ(column.meaning, metric.meaning);
  EXPECT_EQ(column.unit, metric.unit);
  EXPECT_EQ(column.better, Metric::Better::more);
  EXPECT_EQ(column.kind, PageColumn::Kind::metric);
  for (const Setting<Hardware>& setting : hardware_settings()) {
    EXPECT_EQ(page_column(setting.name()).meaning, setting.meaning);
    EXPECT_EQ(page_column(setting.name()).kind, PageColumn::Kind::setting);
  }
  EXPECT_EQ(page_column("scene.image.width").kind, PageColumn::Kind::input);
  EXPECT_EQ(page_column("outcome").kind, PageColumn::Kind::text);
}

TEST(ResultPage, StoresEachColumnInItsShortestForm) {
  const nlohmann::json data = data_of(result_page(small_page()));
  EXPECT_EQ(data["rows"], 20);
  const nlohmann::json& columns = data["columns"];
  EXPECT_EQ(columns[0]["same"], "sphere");
  EXPECT_EQ(columns[1]["words"], nlohmann::json({1000000007, 1000000008}))
      << "whole numbers exactly";
  EXPECT_EQ(columns[1]["index"][3], 1);
  EXPECT_EQ(columns[2]["values"][0], 0.333333) << "6 digits";
  EXPECT_TRUE(columns[3]["same"].is_null());
  // Words of commands: those in common once.
  const nlohmann::json& words = data["commands"];
  ASSERT_EQ(words.size(), 5U);
  EXPECT_EQ(words[0]["same"], "phongpipe");
  EXPECT_EQ(words[4]["words"], nlohmann::json({"0", "1", nullptr}));
}

TEST(ResultPage, NothingFromOutsideEndsTheScriptOrBecomesAnElement) {
  const std::string hostile = "</script><b>x\"'&<!--{{data}}\x1b\xff";
  const std::size_t scripts = occurrences(result_page(small_page()), "</script");
  PageContent page = small_page();
  page.title = page.row = page.details = hostile;
  page.summary = page.notes = {hostile};
  page.columns[0] = {hostile, hostile, hostile, PageColumn::Kind::input, Metric::Better::neither};
  for (auto& row : page.rows) row[0] = hostile;
  page.commands.front() = "phongpipe verify '" + hostile + "'";
  page.pictures[0] = {{hostile, hostile}, {hostile, "", hostile}};
  const std::string text = result_page(page);
  EXPECT_EQ(occurrences(text, "</script"), scripts);
  EXPECT_EQ(occurrences(text, "<b>"), 0U);
  EXPECT_EQ(occurrences(text, "<!--"), 0U);
  EXPECT_EQ(occurrences(text, "\x1b"), 0U);
  const nlohmann::json data = data_of(text);
  EXPECT_EQ(data["columns"][0]["same"], "</script><b>x\"'&<!--{{data}}\\x1b\\xff");
  EXPECT_EQ(data["commands"][2]["words"][0], "'</script><b>x\"'&<!--{{data}}\\x1b\\xff'");
}

TEST(ResultPage, KeepsPicturesOnce) {
  PageContent page = small_page();
  page.pictures[2] = {{"result", "abc"}, {"error map", "abcd"}};
  page.pictures[5] = {{"result", "abc"}};
  const nlohmann::json data = data_of(result_page(page));
  EXPECT_EQ(data["images"],
            nlohmann::json({"data:image/png;base64,YWJj", "data:image/png;base64,YWJjZA=="}));
  EXPECT_EQ(data["pictures"]["2"], nlohmann::json::parse(R"([["result",0],["error map",1]])"));
  EXPECT_EQ(data["pictures"]["5"], nlohmann::json::parse(R"([["result",0]])"));
}

TEST(ResultPage, NamesFilesBesideIt) {
  PageContent page = small_page();
  page.pictures[0] = {{"result", "", "a b%\"\xff.png"}};
  const nlohmann::json data = data_of(result_page(page));
  EXPECT_EQ(data["images"], nlohmann::json({"a%20b%25%22%FF.png"}));
}

TEST(ResultPage, AsksNoNetworkForAnything) {
  const std::string text = result_page(small_page());
  EXPECT_NE(text.find("default-src 'none'"), std::string::npos);
  for (const char* request : {" src=", "@import", "url(", "fetch("}) {
    EXPECT_EQ(text.substr(0, text.find("https://d3js.org")).find(request), std::string::npos)
        << request;
  }
}

// All metrics differ in all rows, and so do two settings.
TEST(ResultPage, TenThousandRunsFitInto5MB) {
  std::mt19937 random(1);
  PageContent page;
  page.x = "frame_ns_per_pixel";
  page.y = "max_lsb";
  for (const char* name : {"scene", "outcome", "configuration_hash", "seconds"}) {
    page.columns.push_back(page_column(name));
  }
  for (const auto& setting : hardware_settings())
    page.columns.push_back(page_column(setting.name()));
  for (const Metric& metric : metrics()) page.columns.push_back(page_column(metric.name));
  constexpr int kRows = 10'000;
  for (int i = 0; i < kRows; ++i) {
    const auto fraction = [&] { return static_cast<double>(random()) / 4294967296.0; };
    auto& row = page.rows.emplace_back();
    row = {std::string("teapot"), std::string("passed"),
           fmt::format("{:08x}{:08x}", random(), random()), MetricValue(fraction())};
    for (std::size_t k = 0; k < hardware_settings().size(); ++k) {
      row.push_back(MetricValue(static_cast<std::int64_t>(k < 2 ? random() % 20 : 7)));
    }
    for (const Metric& metric : metrics()) {
      const auto count = static_cast<std::int64_t>(random() % 1'000'000);
      row.push_back(metric.unit.empty() ? MetricValue(count) : MetricValue(10 * fraction()));
    }
    page.commands.push_back(
        fmt::format("phongpipe verify teapot --set datapath.rom_address_bits={} --set "
                    "datapath.diffuse_fraction_bits={}",
                    random() % 20, random() % 20));
  }
  const std::string text = result_page(page);
  EXPECT_LE(text.size(), 5'000'000U);
  EXPECT_EQ(data_of(text)["rows"], kRows);
}

}  // namespace
}  // namespace phongpipe
