#include "testbench/trace/wave_format.h"

#include <fmt/format.h>

#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace fs = std::filesystem;

PartialFile::PartialFile(const fs::path& file) : file_(file) {
  check_writable(file);
  try {
    folder_ = std::make_unique<ToolFolder>(fs::absolute(file).parent_path());
  } catch (const ToolError& error) {
    throw InputError(error.what());
  }
}

void PartialFile::complete() const {
  std::error_code error;
  fs::rename(name(), file_, error);
  if (error) fail(error.message());
}

void PartialFile::fail(const std::string& reason) const {
  throw ToolError(fmt::format("{}: {}", printable(file_.string()), reason));
}

WaveVariable variable_of(const std::string& scope, const std::string& declared, int width,
                         bool real) {
  WaveVariable variable;
  variable.scope = scope;
  variable.width = width;
  variable.real = real;
  std::string_view name = declared;
  // A range has a colon; an index such as channel[0] has none.
  const std::size_t bracket = name.rfind('[');
  if (bracket != std::string_view::npos && name.find(':', bracket) != std::string_view::npos) {
    name = name.substr(0, bracket);
  }
  variable.name = std::string(trimmed(name));
  return variable;
}

}  // namespace phongpipe
