// The file of results: kept, merged, locked, and refused where it is not ours.
#include "testbench/campaign/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class StoreTest : public ::testing::Test {
 protected:
  StoreTest()
      : folder_(fs::path(::testing::TempDir()) / fmt::format("phongpipe-store-{}", getpid())) {
    fs::create_directories(folder_);
  }
  ~StoreTest() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name) const { return folder_ / name; }

  static StoredRun run(const std::string& identity, int width, Outcome outcome = Outcome::passed,
                       VerifiedBy verified_by = VerifiedBy::native) {
    StoredRun run;
    run.identity = identity;
    run.text = "text of " + identity;
    run.command = "phongpipe verify teapot --set x=" + identity;
    run.scene = "teapot";
    run.hardware = "default";
    run.values = {{"scene", "teapot"}, {"datapath.diffuse_fraction_bits", std::to_string(width)}};
    run.result.outcome = outcome;
    run.result.verified_by = verified_by;
    run.result.message = "a message, with \"quotes\"";
    if (outcome == Outcome::passed) {
      run.result.metrics.resize(metrics().size(), MetricValue(std::int64_t{width}));
      run.result.metrics[metric_index("rms_lsb")] = 1.0 / 3;
      run.result.metrics[metric_index("psnr_db")] = INFINITY;
    }
    return run;
  }
  // A store of one run, closed again.
  fs::path store_of(const std::string& name, StoredRun run,
                    const std::vector<std::string>& keys = {"scene",
                                                            "datapath.diffuse_fraction_bits"},
                    const std::string& kind = "sweep", const std::string& shard = {}) const {
    Store store(file(name), Store::Access::write, kind);
    store.add_keys(keys);
    if (keys.empty() || keys.back() == "stall") run.values.clear();
    if (!shard.empty()) store.add_shard(shard);
    store.put({run});
    return file(name);
  }
  template <typename Work>
  static void expect_refused(Work work, const std::string& message) {
    try {
      work();
      FAIL() << "not refused: " << message;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(message), std::string::npos) << error.what();
    }
  }

  fs::path folder_;
};

TEST_F(StoreTest, KeepsRunsAndSortsThemByWhatVaries) {
  {
    Store store(file("a.db"), Store::Access::write, "sweep");
    store.add_keys({"scene", "datapath.diffuse_fraction_bits"});
    store.put({run("b", 10), run("a", 9), run("c", 4, Outcome::refused, VerifiedBy::nothing)});
    store.put({run("a", 9)});
  }
  const Store store(file("a.db"), Store::Access::read);
  EXPECT_EQ(store.kind(), "sweep");
  EXPECT_EQ(store.known().size(), 3U);
  EXPECT_EQ(store.known().at("c").outcome, Outcome::refused);
  EXPECT_EQ(store.known().at("a").verified_by, VerifiedBy::native);
  const ResultTable table = store.table();
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_EQ(table.text(0, "datapath.diffuse_fraction_bits"), "4");
  EXPECT_EQ(table.text(1, "datapath.diffuse_fraction_bits"), "9");
  EXPECT_EQ(table.text(2, "datapath.diffuse_fraction_bits"), "10") << "sorted as numbers";
  EXPECT_EQ(*table.number(1, "rms_lsb"), 1.0 / 3) << "to the last digit";
  EXPECT_EQ(table.text(1, "psnr_db"), "") << "no number";
  EXPECT_EQ(table.text(0, "max_lsb"), "") << "a run without a result has no metrics";
  EXPECT_EQ(table.text(1, "command"), "phongpipe verify teapot --set x=a");
}

TEST_F(StoreTest, OneProcessAtATimeUsesAFile) {
  store_of("a.db", run("a", 4));
  const Store first(file("a.db"), Store::Access::write, "sweep");
  expect_refused([&] { const Store second(file("a.db"), Store::Access::write, "sweep"); },
                 "in use");
  expect_refused([&] { const Store second(file("a.db"), Store::Access::read); }, "in use");
}

TEST_F(StoreTest, RefusesWhatIsNotOurs) {
  const auto open = [&](const std::string& name) {
    return [this, name] { const Store store(file(name), Store::Access::write, "sweep"); };
  };
  std::ofstream(file("text.db")) << std::string(5000, 'x');
  expect_refused(open("text.db"), "no database, or a damaged one");
  // In its 18th byte a database has the version of its format.
  std::ofstream(file("picture.db")) << "\x89PNG" << std::string(100, '\2');
  expect_refused(open("picture.db"), "no database, or a damaged one");
  {
    SQLite::Database other(file("other.db").string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    other.exec("CREATE TABLE t (x)");
  }
  expect_refused(open("other.db"), "none of phongpipe's");
  store_of("newer.db", run("a", 4));
  {
    SQLite::Database newer(file("newer.db").string(), SQLite::OPEN_READWRITE);
    newer.exec("PRAGMA user_version = 99");
  }
  expect_refused(open("newer.db"), "a later phongpipe");
  store_of("regress.db", run("a", 4), {}, "regress");
  expect_refused(open("regress.db"), "the results of a regress, not of a sweep");
  expect_refused(open("no/such/folder.db"), "there is no folder");
  expect_refused(open("."), "not a file");
  expect_refused([&] { const Store store(file("none.db"), Store::Access::read); }, "no such file");
}

TEST_F(StoreTest, AFileOfAnEarlierVersionGetsTheMetricsItLacks) {
  store_of("old.db", run("a", 4));
  {
    SQLite::Database old(file("old.db").string(), SQLite::OPEN_READWRITE);
    old.exec("ALTER TABLE runs DROP COLUMN max_lsb");
  }
  {
    const Store read_only(file("old.db"), Store::Access::read);
    const ResultTable table = read_only.table();
    EXPECT_EQ(table.text(0, "max_lsb"), "");
  }
  Store store(file("old.db"), Store::Access::write, "sweep");
  store.put({run("b", 5)});
  const ResultTable table = store.table();
  EXPECT_EQ(table.text(0, "max_lsb"), "");
  EXPECT_EQ(table.text(1, "max_lsb"), "5");
}

TEST_F(StoreTest, MergeKeepsTheMoreStronglyVerifiedRun) {
  const fs::path a = store_of("a.db", run("x", 4, Outcome::passed, VerifiedBy::model));
  const fs::path b = store_of("b.db", run("x", 4, Outcome::passed, VerifiedBy::native));
  Store merged(file("all.db"), Store::Access::write, "sweep");
  for (const fs::path& part : {b, a}) merged.merge(Store(part, Store::Access::read));
  ASSERT_EQ(merged.known().size(), 1U);
  EXPECT_EQ(merged.known().at("x").verified_by, VerifiedBy::native);
}

TEST_F(StoreTest, MergeRefusesPartsOfDifferentCampaigns) {
  const std::vector<std::string> keys = {"datapath.diffuse_fraction_bits"};
  Store merged(file("all.db"), Store::Access::write, "sweep");
  merged.merge(Store(store_of("a.db", run("a", 4), keys, "sweep", "1/2"), Store::Access::read));
  merged.merge(Store(store_of("b.db", run("b", 5), keys, "sweep", "2/2"), Store::Access::read));
  EXPECT_EQ(merged.known().size(), 2U);
  EXPECT_EQ(merged.shards(), (std::vector<std::string>{"1/2", "2/2"}));
  const auto merge = [&](const fs::path& part) {
    return [&merged, part] { merged.merge(Store(part, Store::Access::read)); };
  };
  expect_refused(merge(store_of("c.db", run("c", 4), keys, "sweep", "1/3")), "do not fit together");
  expect_refused(merge(store_of("d.db", run("d", 4), {"stall"})), "not one campaign");
  expect_refused(merge(store_of("e.db", run("e", 4), keys, "regress")), "not one campaign");
  EXPECT_EQ(merged.known().size(), 2U) << "nothing of what was refused";
}

TEST_F(StoreTest, ACrashDoesNotReplaceAResult) {
  Store store(file("a.db"), Store::Access::write, "sweep");
  store.put({run("a", 4)});
  store.put({run("a", 4, Outcome::crashed, VerifiedBy::nothing)});
  EXPECT_EQ(store.known().at("a").outcome, Outcome::passed);
  store.put({run("a", 4, Outcome::failed)});
  EXPECT_EQ(store.known().at("a").outcome, Outcome::failed) << "a check that failed is a result";
  EXPECT_EQ(store.table().text(0, "max_lsb"), "") << "of the new result only";
}

// A key that one campaign varies has its value in the runs of another, too.
TEST_F(StoreTest, KeysAreFilledInFromTheTextOfRuns) {
  Store store(file("a.db"), Store::Access::write, "sweep");
  StoredRun first = run("a", 4);
  first.values.clear();
  first.text = "datapath.rom_address_bits=9\nstall=25\ntechnology=generic 0 11 20:5\n";
  store.put({first});
  store.add_keys({"stall", "technology", "scene.light.0.color"});
  StoredRun second = first;
  second.identity = "b";
  second.values = {{"scene.light.0.color", "[1,1,1]"}};
  store.put({second});
  store.add_keys({"datapath.rom_address_bits"});
  const ResultTable table = store.table();
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(table.text(row, "stall"), "25");
    EXPECT_EQ(table.text(row, "technology"), "generic");
    EXPECT_EQ(table.text(row, "datapath.rom_address_bits"), "9");
  }
  EXPECT_EQ(table.text(0, "scene.light.0.color"), "");
  EXPECT_EQ(table.text(1, "scene.light.0.color"), "[1,1,1]");
  expect_refused([&] { store.add_keys({"Stall"}); }, "upper and lower case");
}

// Databases that somebody made to do harm, or damaged: SQLite runs what is in a schema, follows
// journals, and takes the name of a missing column for a text.
TEST_F(StoreTest, WhatPhongpipeDoesNotWriteIsRefused) {
  const std::pair<const char*, const char*> changes[] = {
      {"CREATE VIEW v AS SELECT 1", "view 'v' is none that phongpipe makes"},
      {"CREATE TRIGGER t INSERT ON runs BEGIN SELECT 1; END", "trigger 't' is none"},
      {"CREATE TABLE t (a)", "table 't' is none that phongpipe makes"},
      {"CREATE INDEX i ON runs (length(text))", "index 'i' is none"},
      {"DROP TABLE about; CREATE TABLE about (kind TEXT CHECK (length(kind) > 1))",
       "table 'about' is none"},
      {"DROP TABLE about; CREATE TABLE about (kind TEXT DEFAULT (hex(randomblob(9))))",
       "table 'about' is none"},
      {"DROP TABLE about; CREATE TABLE about (a, kind TEXT AS (upper(a)))",
       "table 'about' is none"},
      {"DROP TABLE shards", "there is no table 'shards'"},
      {"DELETE FROM about", "it does not say of what campaign it is"},
      {"ALTER TABLE runs RENAME COLUMN message TO other", "there is no column 'message'"},
      {"INSERT INTO keys VALUES ('ghost')", "there is no column 'ghost'"},
      {"UPDATE runs SET outcome = 'zebra'", "unknown outcome 'zebra'"},
      {"UPDATE runs SET verified_by = 'zebra'", "unknown verified_by 'zebra'"},
      {"INSERT INTO shards VALUES ('zzz')", "unknown shard 'zzz'"},
      {"PRAGMA journal_mode = WAL", "has a write-ahead log"},
  };
  for (const auto& [change, message] : changes) {
    SCOPED_TRACE(change);
    const fs::path path = store_of("a.db", run("a", 8));
    {
      SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
      database.exec(change);
    }
    expect_refused([&] { Store(path, Store::Access::read); }, message);
    expect_refused([&] { Store(path, Store::Access::write); }, message);
    fs::remove(path);
  }
}

TEST_F(StoreTest, AJournalIsAFileThatNamesNoOther) {
  const fs::path path = store_of("a.db", run("a", 8)), journal = file("a.db-journal");
  fs::remove(journal);
  mkfifo(journal.c_str(), 0600);
  expect_refused([&] { Store(path, Store::Access::read); }, "a.db-journal: not a file");
  fs::remove(journal);
  // Rolling it back, SQLite would delete the file that it names.
  std::ofstream(journal, std::ios::binary)
      << std::string(512, 'x') << "/some/file\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  expect_refused([&] { Store(path, Store::Access::read); }, "the journal of several databases");
  expect_refused([&] { Store(path, Store::Access::write); }, "the journal of several databases");
}

}  // namespace
}  // namespace phongpipe
