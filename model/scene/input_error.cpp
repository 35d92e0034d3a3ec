#include "model/scene/input_error.h"

#include <fmt/format.h>

namespace phongpipe {

InputError::InputError(const std::string& source, unsigned line, const std::string& message)
    : std::runtime_error(line == 0 ? fmt::format("{}: {}", source, message)
                                   : fmt::format("{}:{}: {}", source, line, message)) {}

}  // namespace phongpipe
