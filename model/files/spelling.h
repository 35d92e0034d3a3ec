// "did you mean": the known word closest to what was written.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace phongpipe {

// The candidate that `word` is a likely misspelling of, or an empty string.
std::string closest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace phongpipe
