// A page of results for a browser: two measures against each other with their Pareto front,
// parallel coordinates, a table, pictures. It is one file, but for pictures that
// lie beside it, and asks no network for anything.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "testbench/campaign/store.h"

namespace phongpipe {

struct PageColumn {
  // setting: of the hardware, named section.key; input: anything else that was chosen before the
  // run; metric: a number that came out; text: for reading only.
  enum class Kind { setting, input, metric, text };

  std::string name, unit, meaning;
  Kind kind = Kind::text;
  Metric::Better better = Metric::Better::neither;
};

// The column of a metric, of a setting of the hardware by its full name, or of anything else that a
// campaign records, with its description.
PageColumn page_column(std::string_view name);

// A PNG: its bytes, which become part of the page, or the name of a file beside the page.
struct PagePicture {
  std::string label;
  std::string png = {};
  std::string file = {};
};

struct PageContent {
  std::string title;
  std::string row = "run";           // what a row is
  std::vector<std::string> summary;  // what comes first, a line each
  std::vector<std::string> notes;  // what else there is to know, such as pictures that are missing
  std::vector<PageColumn> columns;
  // Cells in the order of the columns. A column `outcome`, if there is one, tells what passed.
  std::vector<std::vector<Cell>> rows;
  std::vector<std::string> commands;  // of each row, to see it again, or empty; or none at all
  std::map<std::size_t, std::vector<PagePicture>> pictures;  // by row
  bool logarithmic = false;                                  // both axes at first
  bool alternatives = true;  // rows compete, so that there is a front
  std::string x, y;          // metrics that are shown first
  std::string details;       // a text with lines of its own, shown on demand; or empty
};

// Texts from outside may hold anything. Fractional numbers are given with 6 digits.
std::string result_page(const PageContent& content);

}  // namespace phongpipe
