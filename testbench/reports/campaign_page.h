// The runs of a campaign as a page, and its front as a chart.
#pragma once

#include <string>
#include <vector>

#include "testbench/drawing/plot.h"
#include "testbench/reports/result_page.h"

namespace phongpipe {

// `table`: of a Store. The page has its rows in the same order; of hardware that can be loaded it
// has all settings. Without pictures. `alternatives`: the runs of a scene compete, as in a sweep.
PageContent campaign_page(const ResultTable& table, const std::string& title, bool alternatives);

// Error against time of the runs that passed, with the front of each scene joined.
Chart front_chart(const ResultTable& table, const std::string& title, bool alternatives);

}  // namespace phongpipe
