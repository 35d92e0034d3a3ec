// What people and programs read of a campaign: the live line, the summary, CSV and JSON.
#pragma once

#include <string>

#include "testbench/campaign/campaign.h"

namespace phongpipe {

// "132 of 300, 2 failed, 5.1 a second, 33 s left": one line, shorter than a terminal's.
std::string progress_line(const CampaignProgress& progress);

// The answer of a campaign in a few lines. `store` has the results, in `file`.
std::string campaign_text(const CampaignResult& result, const Store& store, const std::string& file,
                          bool color);

std::string table_csv(const ResultTable& table);
// An array of objects, one for each row.
std::string table_json(const ResultTable& table);

}  // namespace phongpipe
