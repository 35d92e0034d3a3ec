// Reports of hard cases: a line each, JSON, and a contact sheet of their pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "testbench/drawing/pictures.h"
#include "testbench/methods/hard_case_run.h"

namespace phongpipe {

// `verbose`: with what the case breaks, and what must happen. `name_width`: of the column of names.
std::string hard_case_line(const HardCaseResult& result, std::size_t name_width, bool color,
                           bool verbose);
nlohmann::ordered_json hard_case_json(const HardCaseResult& result);

// The pictures of all cases that have one, in rows, in their order; each beside its error map.
Picture contact_sheet(const std::vector<HardCaseResult>& results);

}  // namespace phongpipe
