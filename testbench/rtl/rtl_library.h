// The Verilated pixel_datapath of one configuration, as a shared library. It is loaded if it was
// built before, else built from the installed RTL and kept.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/clocked_datapath.h"
#include "testbench/rtl/rtl_abi.h"
#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/superset.h"

namespace phongpipe {

struct RtlBuildOptions {
  std::filesystem::path sources;      // folder of the RTL; empty: the installed one
  std::filesystem::path destination;  // where a new library is kept; empty: the user's cache
  RtlBuild build = RtlBuild::fast;    // quick: what there is may be fast
  std::function<void(const std::string&)> progress;  // called with what is being built, if anything
};

// Hash of the RTL in a folder, and of what is compiled with it. Empty: the installed RTL.
std::uint64_t rtl_hash(const std::filesystem::path& sources);

// Builds the libraries of the configurations that are not built yet, together, which is faster than
// one by one. Throws as RtlLibrary does.
void build_missing_rtl(const std::vector<DatapathConfiguration>& configurations,
                       const RtlBuildOptions& options);

// Loads the library, after building it if necessary. Throws InputError if there are no sources,
// ToolError if building or loading fails.
class RtlLibrary {
 public:
  RtlLibrary(const DatapathConfiguration& configuration, const RtlBuildOptions& options);
  ~RtlLibrary();
  RtlLibrary(const RtlLibrary&) = delete;
  RtlLibrary& operator=(const RtlLibrary&) = delete;

  const RtlInterface& interface() const { return *interface_; }
  const std::filesystem::path& file() const { return file_; }

 private:
  void load(const DatapathConfiguration& configuration, const RtlBuildOptions& options);

  std::filesystem::path file_;
  void* handle_ = nullptr;
  const RtlInterface* interface_ = nullptr;
};

RtlSpan to_rtl(const Span& span, const RtlAlignment& alignment = {});

// One instance of the RTL, behind the ports that the SystemC pipeline drives. In RTL of a superset,
// a word of the table takes several clocks of the RTL in one clock() of ours.
class RtlDatapath : public ClockedDatapath {
 public:
  explicit RtlDatapath(const RtlLibrary& library, const OutputColor& cue_color = {},
                       const RtlAlignment& alignment = {});
  ~RtlDatapath() override;
  RtlDatapath(const RtlDatapath&) = delete;
  RtlDatapath& operator=(const RtlDatapath&) = delete;

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

  // Writes a table, one word a clock.
  void load_table(const HighlightTable& table);

  // Calls `look` in every clock, when all values are settled, before its edge.
  void before_edge(std::function<void()> look);

  void* rtl() const { return rtl_; }
  const RtlInterface& interface() const { return *interface_; }

 private:
  void write_word(const HighlightTable& table, int address);

  const RtlInterface* interface_;
  void* rtl_;
  RtlAlignment alignment_;
  RtlPorts ports_ = {};
  std::function<void()> look_;
  RtlSpan presented_ = {};
  bool presenting_ = false;
};

}  // namespace phongpipe
