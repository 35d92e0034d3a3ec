// The results of a campaign in an SQLite file: a row for each run, with a column for each setting
// and each metric. One process at a time uses the file.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "testbench/cosim/run.h"

namespace SQLite {
class Database;
}

namespace phongpipe {

// A run with its result.
struct StoredRun {
  std::string identity;  // see identity_of()
  std::string text;      // canonical
  std::string command;   // that verifies the same
  std::string scene, scene_hash, hardware;
  std::vector<std::pair<std::string, std::string>> values;  // of keys that vary, by full name
  RunResult result;
  double seconds = 0;  // wall-clock time, its share of building RTL included
};

// What is known of a run that is stored.
struct KnownRun {
  Outcome outcome;
  VerifiedBy verified_by;
};

// A table as text or numbers, for export: MetricValue or text in each cell.
using Cell = std::variant<std::string, MetricValue>;
struct ResultTable {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;

  // The place of a column. Throws std::out_of_range if there is none of that name.
  std::size_t column(std::string_view name) const;
  // A cell as text: numbers exactly, no value as an empty text.
  std::string text(std::size_t row, std::string_view column) const;
  std::optional<double> number(std::size_t row, std::string_view column) const;
};
std::string exact_text(const Cell& cell);

class Store {
 public:
  enum class Access { read, write };
  static constexpr const char* kInMemory = ":memory:";  // a file that is not kept

  // Opens a file; with Access::write makes it if there is none. `kind`: of the campaign, "sweep" or
  // "regress"; empty: any. Throws InputError if the file is in use, is none of ours, is from a
  // later version or of another kind, or cannot be written.
  Store(const std::filesystem::path& file, Access access, const std::string& kind = {});
  ~Store();
  Store(const Store&) = delete;
  Store& operator=(const Store&) = delete;

  const std::string& kind() const { return kind_; }
  // Keys that vary, by full name, in the order in which they were added.
  std::vector<std::string> keys() const;
  // Adds keys, with their values in the runs that are there. Throws InputError for keys that differ
  // only by case.
  void add_keys(const std::vector<std::string>& keys);
  // The divisions into shards that the runs were computed in, as "1/4", sorted; none for a whole.
  std::vector<std::string> shards() const;
  void add_shard(const std::string& shard);

  // All runs by identity.
  std::unordered_map<std::string, KnownRun> known() const;
  // Adds runs, or replaces those of the same identity; a run that passed is replaced only by a
  // result, not by a crash. They are safe when put() returns. Keys that a run's values lack are
  // taken from its text.
  void put(const std::vector<StoredRun>& runs);
  // Throws InputError if the other store is of another campaign.
  void check_fits(const Store& other) const;
  // Copies all runs, keys and shards of another store. Of a run that both have, the one verified
  // more strongly is kept. Throws as check_fits() does, and then nothing is copied.
  void merge(const Store& other);

  // Columns scene, those that vary, outcome, …, all metrics, command; rows sorted by scene and by
  // what varies.
  ResultTable table() const;

 private:
  void check_kind(const std::string& kind) const;

  std::filesystem::path file_;
  std::unique_ptr<SQLite::Database> database_;
  std::string kind_;
};

}  // namespace phongpipe
