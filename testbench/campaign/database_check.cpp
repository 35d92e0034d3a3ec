#include "testbench/campaign/database_check.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <vector>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/cosim/run.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxValueBytes = 64 << 20;  // of a text in a row

// The bytes of a file from a place on; fewer where it ends.
std::string bytes_at(const fs::path& file, std::uintmax_t at, std::size_t count) {
  std::ifstream in(file, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(at));
  std::string bytes(count, '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(in.gcount()));
  return bytes;
}

// Without what stands in double quotes: names of columns may be any words.
std::string without_names(const std::string& sql) {
  std::string rest;
  bool quoted = false;
  for (const char c : sql) {
    if (c == '"') quoted = !quoted;
    if (!quoted) rest += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  return rest;
}

template <typename Enum, int kCount>
std::string quoted_names() {
  std::vector<std::string> names;
  names.reserve(kCount);
  for (int i = 0; i < kCount; ++i) names.push_back(fmt::format("'{}'", name(static_cast<Enum>(i))));
  return fmt::format("{}", fmt::join(names, ", "));
}

class ContentsCheck {
 public:
  ContentsCheck(const fs::path& file, SQLite::Database& database)
      : name_(printable(file.string())), database_(database) {}

  void run() {
    if (database_.execAndGet("PRAGMA application_id").getInt() != kApplicationId) {
      throw InputError(fmt::format("{}: a database, but none of phongpipe's", name_));
    }
    const int version = database_.execAndGet("PRAGMA user_version").getInt();
    if (version > kSchemaVersion) {
      throw InputError(
          fmt::format("{}: written by a later phongpipe (schema {}, this one knows {})", name_,
                      version, kSchemaVersion));
    }
    check_schema();
    const std::string fault = database_.execAndGet("PRAGMA quick_check(1)").getString();
    if (fault != "ok") fail(excerpt(fault, 200));
    check_columns();
    refuse_rows(fmt::format("SELECT outcome FROM runs WHERE outcome NOT IN ({})",
                            quoted_names<Outcome, kOutcomes>()),
                "outcome");
    refuse_rows(fmt::format("SELECT verified_by FROM runs WHERE verified_by NOT IN ({})",
                            quoted_names<VerifiedBy, kStrengths>()),
                "verified_by");
    refuse_rows("SELECT name FROM shards WHERE name NOT GLOB '[0-9]*/[0-9]*'", "shard");
  }

 private:
  void check_schema() {
    std::set<std::string> missing = {"about", "keys", "shards", "runs"};
    SQLite::Statement schema(database_, "SELECT type, name, sql FROM sqlite_master");
    while (schema.executeStep()) {
      const std::string type = schema.getColumn(0).getString(),
                        item = schema.getColumn(1).getString();
      if (type == "index" && schema.getColumn(2).isNull()) continue;  // of a primary key
      const std::string sql = without_names(schema.getColumn(2).getString());
      const auto holds = [&](const char* word) { return sql.find(word) != std::string::npos; };
      if (type != "table" || missing.erase(item) == 0 || sql.rfind("CREATE TABLE", 0) != 0 ||
          holds("CHECK") || holds("DEFAULT") || holds("REFERENCES") || holds("COLLATE") ||
          holds("GENERATED") || holds(" AS ") || holds("AS(") || holds("ON CONFLICT")) {
        fail(fmt::format("{} '{}' is none that phongpipe makes", type, excerpt(item)));
      }
    }
    if (!missing.empty()) fail(fmt::format("there is no table '{}'", *missing.begin()));
  }

  // Those of metrics may be missing in the file of an earlier version.
  void check_columns() {
    const std::set<std::string> present = columns_of_runs(database_);
    std::vector<std::string> needed(kFixedColumns.begin(), kFixedColumns.end());
    SQLite::Statement keys(database_, "SELECT name FROM keys");
    while (keys.executeStep()) needed.push_back(keys.getColumn(0).getString());
    for (const std::string& column : needed) {
      if (present.count(column) == 0) fail(fmt::format("there is no column '{}'", excerpt(column)));
    }
    if (database_.execAndGet("SELECT count(*) FROM about").getInt() != 1) {
      fail("it does not say of what campaign it is");
    }
  }

  // A query whose rows are words that we do not write.
  void refuse_rows(const std::string& query, const char* what) {
    SQLite::Statement statement(database_, query);
    if (!statement.executeStep()) return;
    fail(fmt::format("unknown {} '{}'", what, excerpt(statement.getColumn(0).getString())));
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(fmt::format("{}: a damaged database ({})", name_, printable(what)));
  }

  std::string name_;
  SQLite::Database& database_;
};

}  // namespace

std::set<std::string> columns_of_runs(SQLite::Database& database) {
  SQLite::Statement statement(database, "SELECT name FROM pragma_table_info('runs')");
  std::set<std::string> names;
  while (statement.executeStep()) names.insert(statement.getColumn(0).getString());
  return names;
}

void check_files(const fs::path& file) {
  const std::string name = printable(file.string());
  for (const char* companion : {"", "-journal", "-wal", "-shm"}) {
    const fs::path path = file.string() + companion;
    std::error_code none;
    if (fs::exists(path, none) && !fs::is_regular_file(path, none)) {
      throw InputError(fmt::format("{}: not a file", printable(path.string())));
    }
  }
  const fs::path journal = file.string() + "-journal";
  std::error_code missing;
  const std::uintmax_t size = fs::file_size(journal, missing);
  const std::string journal_magic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  if (!missing && size >= journal_magic.size() &&
      bytes_at(journal, size - journal_magic.size(), journal_magic.size()) == journal_magic) {
    throw InputError(
        fmt::format("{}: the journal of several databases, which phongpipe does not write; move it "
                    "away if {} is whole",
                    printable(journal.string()), name));
  }
  constexpr std::string_view kMagic = "SQLite format 3";
  constexpr std::size_t kFormatVersion = 18;  // of the header; 2: with a write-ahead log
  if (bytes_at(file, 0, kMagic.size()) == kMagic && bytes_at(file, kFormatVersion, 1) == "\2") {
    throw InputError(
        fmt::format("{}: has a write-ahead log, which phongpipe's databases have not; as "
                    "sqlite3 {} 'PRAGMA journal_mode = DELETE' changes",
                    name, name));
  }
}

void distrust(SQLite::Database& database) {
  sqlite3* const handle = database.getHandle();
  database.exec("PRAGMA trusted_schema = OFF");
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kMaxValueBytes);
  for (const int option : {SQLITE_DBCONFIG_DQS_DML, SQLITE_DBCONFIG_DQS_DDL}) {
    sqlite3_db_config(handle, option, 0, nullptr);
  }
}

void check_contents(const fs::path& file, SQLite::Database& database) {
  ContentsCheck(file, database).run();
}

}  // namespace phongpipe
