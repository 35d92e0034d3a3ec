#include "testbench/campaign/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/campaign/database_check.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

std::string quoted_name(std::string_view name) {
  std::string result = "\"";
  for (const char c : name) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

// A value that we would not have written.
class DamagedRow : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

template <typename Enum, int kCount>
Enum from_name(const std::string& text) {
  for (int i = 0; i < kCount; ++i) {
    if (name(static_cast<Enum>(i)) == text) return static_cast<Enum>(i);
  }
  throw DamagedRow(fmt::format("unknown word '{}'", printable(excerpt(text))));
}
Outcome outcome_from(const std::string& text) {
  return from_name<Outcome, kOutcomes>(text);
}
VerifiedBy verified_by_from(const std::string& text) {
  return from_name<VerifiedBy, kStrengths>(text);
}

// Runs `work`; errors of SQLite become ours, and name the file.
template <typename Work>
auto guarded(const fs::path& file, Work work) -> decltype(work()) {
  const std::string name = printable(file.string());
  try {
    return work();
  } catch (const DamagedRow& error) {
    throw InputError(fmt::format("{}: a damaged database ({})", name, error.what()));
  } catch (const SQLite::Exception& error) {
    switch (error.getErrorCode()) {
      case SQLITE_BUSY:
      case SQLITE_LOCKED:
        throw InputError(
            fmt::format("{}: in use by another process; wait for it, or give it a file "
                        "of its own",
                        name));
      case -1:  // SQLiteCpp's own: a row that is not there
      case SQLITE_CONSTRAINT:
      case SQLITE_NOTADB:
      case SQLITE_CORRUPT:
      case SQLITE_FORMAT:
      case SQLITE_TOOBIG:
      case SQLITE_ERROR:  // a table or a column is not there
        throw InputError(fmt::format("{}: no database, or a damaged one ({})", name, error.what()));
      case SQLITE_CANTOPEN:
      case SQLITE_READONLY:
      case SQLITE_PERM:
        throw InputError(fmt::format("{}: cannot be opened for this ({})", name, error.what()));
      case SQLITE_FULL:
      case SQLITE_IOERR:
        throw InputError(fmt::format(
            "{}: cannot be written ({}): is the disk full, or the size of files limited? "
            "What it has is safe; with more room, the same command goes on",
            name, error.what()));
      default:
        throw ToolError(fmt::format("{}: {}", name, error.what()));
    }
  }
}

std::vector<std::string> first_column(const SQLite::Database& database, const std::string& query) {
  SQLite::Statement statement(const_cast<SQLite::Database&>(database), query);
  std::vector<std::string> texts;
  while (statement.executeStep()) texts.push_back(statement.getColumn(0).getString());
  return texts;
}

void add_column(SQLite::Database& database, const std::set<std::string>& present,
                std::string_view name) {
  // Without a type, so that a number stays a number and a text a text.
  if (present.count(std::string(name)) == 0) {
    database.exec(fmt::format("ALTER TABLE runs ADD COLUMN {}", quoted_name(name)));
  }
}

bool is_fixed_column(std::string_view name) {
  return std::find(std::begin(kFixedColumns), std::end(kFixedColumns), name) !=
         std::end(kFixedColumns);
}

void create_schema(SQLite::Database& database, const std::string& kind) {
  database.exec(fmt::format("PRAGMA application_id = {}", kApplicationId));
  database.exec(fmt::format("PRAGMA user_version = {}", kSchemaVersion));
  database.exec("CREATE TABLE about (kind TEXT NOT NULL)");
  SQLite::Statement insert(database, "INSERT INTO about VALUES (?)");
  insert.bind(1, kind);
  insert.exec();
  database.exec("CREATE TABLE keys (name TEXT PRIMARY KEY)");
  database.exec("CREATE TABLE shards (name TEXT PRIMARY KEY)");
  // With the columns of all metrics: one statement is faster than one for each.
  std::string columns =
      "identity TEXT PRIMARY KEY, text TEXT NOT NULL, command TEXT NOT NULL, scene TEXT NOT NULL, "
      "scene_hash TEXT NOT NULL, hardware TEXT NOT NULL, outcome TEXT NOT NULL, message TEXT NOT "
      "NULL, bucket TEXT NOT NULL, verified_by TEXT NOT NULL, configuration_hash TEXT NOT NULL, "
      "seconds REAL NOT NULL";
  for (const Metric& metric : metrics()) columns += ", " + quoted_name(metric.name);
  database.exec(fmt::format("CREATE TABLE runs ({}) WITHOUT ROWID", columns));
}

// The value of a key in a canonical text; none if the text does not have it, as with keys of the
// scene.
std::optional<std::string> value_in(const std::string& text, const std::string& key) {
  const std::string start = key + "=";
  std::string_view line;
  for (LineReader lines(text); lines.next(line);) {
    if (line.substr(0, start.size()) != start) continue;
    std::string value(line.substr(start.size()));
    // The technology's name comes before its clocks.
    if (key == "technology") value = value.substr(0, value.find(' '));
    return value;
  }
  return std::nullopt;
}

// Numbers are stored as numbers, so that they sort and compare as such.
void bind_text_or_number(SQLite::Statement& statement, int index, const std::string& text) {
  if (const auto whole = parse_integer(text)) {
    statement.bind(index, static_cast<std::int64_t>(*whole));
  } else if (const auto number = parse_number(text)) {
    statement.bind(index, *number);
  } else {
    statement.bind(index, text);
  }
}

void bind_metric(SQLite::Statement& statement, int index, const MetricValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) {
    statement.bind(index, *whole);
  } else if (const auto* number = std::get_if<double>(&value);
             number != nullptr && std::isfinite(*number)) {
    statement.bind(index, *number);
  } else {
    statement.bind(index);  // NULL
  }
}

// Gives the runs that are there the value of a key that has become a column.
void fill_column(SQLite::Database& database, const std::string& key) {
  SQLite::Statement select(database, "SELECT identity, text FROM runs");
  std::vector<std::pair<std::string, std::string>> values;  // by identity
  while (select.executeStep()) {
    if (auto value = value_in(select.getColumn(1).getString(), key)) {
      values.emplace_back(select.getColumn(0).getString(), std::move(*value));
    }
  }
  SQLite::Statement update(
      database, fmt::format("UPDATE runs SET {} = ? WHERE identity = ?", quoted_name(key)));
  for (const auto& [identity, value] : values) {
    bind_text_or_number(update, 1, value);
    update.bind(2, identity);
    update.exec();
    update.reset();
  }
}

Cell cell_of(const SQLite::Column& column) {
  if (column.isInteger()) return MetricValue(static_cast<std::int64_t>(column.getInt64()));
  if (column.isFloat()) return MetricValue(column.getDouble());
  if (column.isNull()) return MetricValue();
  return column.getString();
}

}  // namespace

std::size_t ResultTable::column(std::string_view name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) throw std::out_of_range(fmt::format("no column {}", name));
  return static_cast<std::size_t>(found - columns.begin());
}

std::string ResultTable::text(std::size_t row, std::string_view name) const {
  return exact_text(rows[row][column(name)]);
}

std::optional<double> ResultTable::number(std::size_t row, std::string_view name) const {
  const auto* value = std::get_if<MetricValue>(&rows[row][column(name)]);
  return value == nullptr ? std::nullopt : number_of(*value);
}

std::string exact_text(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  const MetricValue& value = std::get<MetricValue>(cell);
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("{}", *number);
  return {};
}

Store::Store(const fs::path& file, Access access, const std::string& kind)
    : file_(file), kind_(kind) {
  std::error_code none;
  if (access == Access::read && !fs::exists(file, none)) {
    throw InputError(fmt::format("{}: no such file", printable(file.string())));
  }
  check_files(file);
  const fs::path folder = fs::absolute(file).parent_path();
  if (access == Access::write && !fs::is_directory(folder, none)) {
    throw InputError(fmt::format("{}: there is no folder {}", printable(file.string()),
                                 printable(folder.string())));
  }
  std::signal(SIGXFSZ, SIG_IGN);  // beyond the limit of file sizes, a write then fails
  guarded(file_, [&] {
    // What was interrupted while it was written is put in order by opening it for writing.
    const fs::path journal = file_.string() + "-journal";
    const bool interrupted = fs::exists(journal, none) && fs::file_size(journal, none) > 0;
    const bool writes = access == Access::write || interrupted;
    database_ = std::make_unique<SQLite::Database>(
        file_.string(),
        writes ? SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE : SQLite::OPEN_READONLY);
    distrust(*database_);
    const auto is_empty = [&] {
      return database_->execAndGet("SELECT count(*) FROM sqlite_master").getInt() == 0;
    };
    if (access == Access::read || !is_empty()) check_contents(file_, *database_);
    if (access == Access::write) {
      // The lock is taken by the transaction below and kept. A rollback journal, for write-ahead
      // logs do not work on the file systems that clusters share.
      database_->exec("PRAGMA locking_mode = EXCLUSIVE");
      database_->exec("PRAGMA journal_mode = TRUNCATE");
      database_->exec("BEGIN EXCLUSIVE");
      if (is_empty()) create_schema(*database_, kind);
      kind_ = database_->execAndGet("SELECT kind FROM about").getString();
      check_kind(kind);
      const std::set<std::string> present = columns_of_runs(*database_);
      for (const Metric& metric : metrics()) add_column(*database_, present, metric.name);
      database_->exec("COMMIT");
    }
    kind_ = database_->execAndGet("SELECT kind FROM about").getString();
  });
  check_kind(kind);
}

void Store::check_kind(const std::string& kind) const {
  if (!kind.empty() && kind != kind_) {
    throw InputError(fmt::format("{}: the results of a {}, not of a {}", printable(file_.string()),
                                 kind_, kind));
  }
}

Store::~Store() = default;

std::vector<std::string> Store::keys() const {
  return guarded(file_,
                 [&] { return first_column(*database_, "SELECT name FROM keys ORDER BY rowid"); });
}

void Store::add_keys(const std::vector<std::string>& keys) {
  const auto lower = [](std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  };
  guarded(file_, [&] {
    SQLite::Transaction transaction(*database_);
    const std::vector<std::string> before = this->keys();
    std::set<std::string> present = columns_of_runs(*database_);
    std::map<std::string, std::string> spellings;  // SQL does not tell upper case from lower
    for (const std::string& column : present) spellings.emplace(lower(column), column);
    for (const std::string& key : keys) {
      const auto& same = spellings.emplace(lower(key), key).first->second;
      if (same != key) {
        throw InputError(
            fmt::format("{} and {} differ only by upper and lower case; rename one", same, key));
      }
      if (std::find(before.begin(), before.end(), key) != before.end()) continue;
      SQLite::Statement insert(*database_, "INSERT OR IGNORE INTO keys VALUES (?)");
      insert.bind(1, key);
      insert.exec();
      if (!present.insert(key).second) continue;
      add_column(*database_, {}, key);
      fill_column(*database_, key);
    }
    transaction.commit();
  });
}

std::vector<std::string> Store::shards() const {
  return guarded(file_,
                 [&] { return first_column(*database_, "SELECT name FROM shards ORDER BY name"); });
}

void Store::add_shard(const std::string& shard) {
  guarded(file_, [&] {
    SQLite::Statement insert(*database_, "INSERT OR IGNORE INTO shards VALUES (?)");
    insert.bind(1, shard);
    insert.exec();
  });
}

std::unordered_map<std::string, KnownRun> Store::known() const {
  return guarded(file_, [&] {
    std::unordered_map<std::string, KnownRun> result;
    SQLite::Statement statement(*database_, "SELECT identity, outcome, verified_by FROM runs");
    while (statement.executeStep()) {
      result.emplace(statement.getColumn(0).getString(),
                     KnownRun{outcome_from(statement.getColumn(1).getString()),
                              verified_by_from(statement.getColumn(2).getString())});
    }
    return result;
  });
}

void Store::put(const std::vector<StoredRun>& runs) {
  if (runs.empty()) return;
  const std::vector<std::string> keys = this->keys();
  guarded(file_, [&] {
    std::vector<std::string> columns(std::begin(kFixedColumns), std::end(kFixedColumns));
    for (const std::string& key : keys) {
      if (!is_fixed_column(key)) columns.push_back(key);
    }
    const std::size_t before_metrics = columns.size();
    for (const Metric& metric : metrics()) columns.emplace_back(metric.name);
    std::vector<std::string> names, marks, updates;
    for (const std::string& column : columns) {
      names.push_back(quoted_name(column));
      marks.emplace_back("?");
      updates.push_back(fmt::format("{0} = excluded.{0}", names.back()));
    }
    SQLite::Transaction transaction(*database_);
    // That a process ended this time is no reason to forget a result.
    SQLite::Statement insert(
        *database_,
        fmt::format("INSERT INTO runs ({}) VALUES ({}) ON CONFLICT (identity) DO UPDATE SET {} "
                    "WHERE runs.outcome <> 'passed' OR excluded.outcome IN ('passed', 'failed')",
                    fmt::join(names, ","), fmt::join(marks, ","), fmt::join(updates, ",")));
    for (const StoredRun& run : runs) {
      int index = 0;
      for (const std::string& text :
           {run.identity, run.text, run.command, run.scene, run.scene_hash, run.hardware,
            std::string(name(run.result.outcome)), run.result.message, run.result.bucket,
            std::string(name(run.result.verified_by)), run.result.configuration_hash}) {
        insert.bind(++index, text);
      }
      insert.bind(++index, run.seconds);
      while (static_cast<std::size_t>(index) < before_metrics) {
        const std::string& key = columns[static_cast<std::size_t>(index)];
        const auto own = std::find_if(run.values.begin(), run.values.end(),
                                      [&](const auto& value) { return value.first == key; });
        const std::optional<std::string> value =
            own != run.values.end() ? own->second : value_in(run.text, key);
        if (value) {
          bind_text_or_number(insert, ++index, *value);
        } else {
          insert.bind(++index);  // NULL
        }
      }
      for (std::size_t i = 0; i < metrics().size(); ++i) {
        const auto& values = run.result.metrics;
        bind_metric(insert, ++index, values.empty() ? MetricValue() : values[i]);
      }
      insert.exec();
      insert.reset();
    }
    transaction.commit();
  });
}

void Store::check_fits(const Store& other) const {
  const std::string here = printable(file_.string()), there = printable(other.file_.string());
  if (other.kind_ != kind_) {
    throw InputError(
        fmt::format("{} is a {}, {} a {}: not one campaign", here, kind_, there, other.kind_));
  }
  const std::vector<std::string> their_keys = other.keys(), our_keys = keys();
  if (!our_keys.empty() && our_keys != their_keys) {
    throw InputError(fmt::format("{} varies {}, {} varies {}: not one campaign", there,
                                 fmt::join(their_keys, ", "), here, fmt::join(our_keys, ", ")));
  }
  const auto division = [](const std::string& shard) { return shard.substr(shard.find('/')); };
  const std::vector<std::string> our_shards = shards();
  for (const std::string& theirs : other.shards()) {
    for (const std::string& ours : our_shards) {
      if (division(ours) == division(theirs)) continue;
      throw InputError(fmt::format("{} is shard {}, others are {}: these do not fit together",
                                   there, theirs, fmt::join(our_shards, ", ")));
    }
  }
}

void Store::merge(const Store& other) {
  check_fits(other);
  const std::vector<std::string> their_keys = other.keys(), their_shards = other.shards();
  add_keys(their_keys);
  for (const std::string& shard : their_shards) add_shard(shard);
  guarded(file_, [&] {
    SQLite::Statement attach(*database_, "ATTACH ? AS other");
    attach.bind(1, other.file_.string());
    attach.exec();
    {
      SQLite::Transaction transaction(*database_);
      const std::set<std::string> present = columns_of_runs(*database_);
      std::vector<std::string> names;
      for (const std::string& column :
           first_column(*database_, "SELECT name FROM pragma_table_info('runs', 'other')")) {
        add_column(*database_, present, column);
        names.push_back(quoted_name(column));
      }
      const std::string columns = fmt::format("{}", fmt::join(names, ","));
      std::string rank;
      for (int i = 0; i < kStrengths; ++i) {
        rank += fmt::format(" WHEN '{}' THEN {}", name(static_cast<VerifiedBy>(i)), i);
      }
      database_->exec(fmt::format(
          "INSERT OR REPLACE INTO runs ({0}) SELECT {0} FROM other.runs AS theirs WHERE NOT EXISTS "
          "(SELECT 1 FROM main.runs AS ours WHERE ours.identity = theirs.identity AND "
          "CASE ours.verified_by{1} END >= CASE theirs.verified_by{1} END)",
          columns, rank));
      transaction.commit();
    }
    database_->exec("DETACH other");
  });
}

ResultTable Store::table() const {
  return guarded(file_, [&] {
    ResultTable table;
    std::vector<std::string> varied = keys();
    varied.erase(std::remove(varied.begin(), varied.end(), "scene"), varied.end());
    table.columns.emplace_back("scene");
    table.columns.insert(table.columns.end(), varied.begin(), varied.end());
    for (const char* column :
         {"scene_hash", "outcome", "verified_by", "message", "bucket", "configuration_hash"}) {
      table.columns.emplace_back(column);
    }
    const std::set<std::string> present = columns_of_runs(*database_);
    for (const Metric& metric : metrics()) {
      table.columns.emplace_back(metric.name);
    }
    for (const char* column : {"seconds", "identity", "command"})
      table.columns.emplace_back(column);
    std::vector<std::string> names, order = {"scene"};
    for (const std::string& column : table.columns) {
      // A file of an earlier version may lack a metric.
      names.push_back(present.count(column) != 0 ? quoted_name(column) : "NULL");
    }
    for (const std::string& key : varied) order.push_back(quoted_name(key));
    SQLite::Statement statement(
        *database_, fmt::format("SELECT {} FROM runs ORDER BY {}, identity", fmt::join(names, ","),
                                fmt::join(order, ",")));
    while (statement.executeStep()) {
      std::vector<Cell>& row = table.rows.emplace_back();
      row.reserve(table.columns.size());
      for (int i = 0; i < statement.getColumnCount(); ++i)
        row.push_back(cell_of(statement.getColumn(i)));
    }
    return table;
  });
}

}  // namespace phongpipe
