// The runs of a campaign as JUnit XML, which CI systems show.
#pragma once

#include <string>

#include "testbench/campaign/store.h"

namespace phongpipe {

// A test case for each run: failed runs are failures, crashed and timed out ones errors, refused
// ones skipped. Each carries the command that verifies the same.
std::string junit_xml(const Store& store, const std::string& name);

}  // namespace phongpipe
