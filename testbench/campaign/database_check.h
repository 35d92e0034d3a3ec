// What a database that came from elsewhere must be before it is used: SQLite trusts it in more ways
// than we do.
#pragma once

#include <array>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>

namespace SQLite {
class Database;
}

namespace phongpipe {

constexpr int kApplicationId = 0x70686f67;  // "phog"
constexpr int kSchemaVersion = 1;

// Columns of the table `runs` before those of keys and metrics.
constexpr std::array<std::string_view, 12> kFixedColumns = {
    "identity", "text",    "command", "scene",       "scene_hash",         "hardware",
    "outcome",  "message", "bucket",  "verified_by", "configuration_hash", "seconds"};

// The names of the columns of the table `runs`.
std::set<std::string> columns_of_runs(SQLite::Database& database);

// Before it is opened. The file and those that SQLite keeps beside it are files, if they are there:
// it would wait for a pipe. The journal names no other: rolling it back would delete that file.
// Throws InputError.
void check_files(const std::filesystem::path& file);

// Lets the schema run no function with side effects, and takes no text in double quotes for the
// name of a column that is missing.
void distrust(SQLite::Database& database);

// After it is opened. It is ours, holds our tables and no views, triggers, constraints or computed
// columns, which would run as programs, its pages are not damaged, and words are those that we
// write. Throws InputError.
void check_contents(const std::filesystem::path& file, SQLite::Database& database);

}  // namespace phongpipe
