#include "model/scene/input_error.h"

#include <fmt/format.h>

namespace phongpipe {

InputError::InputError(const std::filesystem::path& file, unsigned line, const std::string& message)
    : std::runtime_error(line == 0 ? fmt::format("{}: {}", file.string(), message)
                                   : fmt::format("{}:{}: {}", file.string(), line, message)) {}

}  // namespace phongpipe
