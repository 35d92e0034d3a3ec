// The Verilated pixel_datapath of one configuration, as a shared library: found where it was built
// beforehand, else built from the installed RTL and kept for the next time.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "sim/clocked_datapath.h"
#include "testbench/rtl/rtl_abi.h"

namespace phongpipe {

struct RtlBuildOptions {
  std::filesystem::path sources;      // of the RTL; empty: the installed one
  std::filesystem::path destination;  // where a new library is kept; empty: the user's cache
  std::function<void(const std::string&)> progress;  // told what is being built, if anything is
};

// Loads, after building if need be. Throws InputError where there are no sources, ToolError where
// they cannot be built or the library cannot be loaded.
class RtlLibrary {
 public:
  RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options);
  ~RtlLibrary();
  RtlLibrary(const RtlLibrary&) = delete;
  RtlLibrary& operator=(const RtlLibrary&) = delete;

  const RtlInterface& interface() const { return *interface_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  void* handle_ = nullptr;
  const RtlInterface* interface_ = nullptr;
};

RtlSpan to_rtl(const Span& span);

// One instance of the RTL behind the ports the SystemC pipeline drives.
class RtlDatapath : public ClockedDatapath {
 public:
  explicit RtlDatapath(const RtlLibrary& library, const OutputColor& cue_color = {});
  ~RtlDatapath() override;
  RtlDatapath(const RtlDatapath&) = delete;
  RtlDatapath& operator=(const RtlDatapath&) = delete;

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

  // Writes a table, one word a clock.
  void load_table(const HighlightTable& table);

  void* rtl() const { return rtl_; }

 private:
  const RtlInterface* interface_;
  void* rtl_;
  RtlPorts ports_ = {};
  RtlSpan presented_ = {};
  bool presenting_ = false;
};

}  // namespace phongpipe
