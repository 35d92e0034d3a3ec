#include "testbench/reports/junit_report.h"

#include <pugixml.hpp>
#include <sstream>

#include "testbench/system/terminal.h"

namespace phongpipe {

std::string junit_xml(const Store& store, const std::string& name) {
  const ResultTable table = store.table();
  pugi::xml_document document;
  pugi::xml_node suite = document.append_child("testsuites").append_child("testsuite");
  suite.append_attribute("name") = printable(name).c_str();
  int failures = 0, errors = 0, skipped = 0;
  double seconds = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string outcome = table.text(row, "outcome"), command = table.text(row, "command");
    pugi::xml_node test = suite.append_child("testcase");
    test.append_attribute("classname") = printable(table.text(row, "scene")).c_str();
    test.append_attribute("name") = printable(command).c_str();
    test.append_attribute("time") = table.text(row, "seconds").c_str();
    seconds += table.number(row, "seconds").value_or(0);
    if (outcome == "passed") continue;
    const bool failed = outcome == "failed", refused = outcome == "refused";
    (failed ? failures : refused ? skipped : errors) += 1;
    pugi::xml_node reason = test.append_child(failed ? "failure" : refused ? "skipped" : "error");
    reason.append_attribute("message") = printable(table.text(row, "message")).c_str();
    if (refused) continue;
    reason.append_attribute("type") = printable(table.text(row, "bucket")).c_str();
    reason.text() = printable(command).c_str();
  }
  suite.append_attribute("tests") = static_cast<unsigned>(table.rows.size());
  suite.append_attribute("failures") = failures;
  suite.append_attribute("errors") = errors;
  suite.append_attribute("skipped") = skipped;
  suite.append_attribute("time") = seconds;
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace phongpipe
