// A batch: runs that one forked worker does one after the other.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "testbench/cosim/run.h"
#include "testbench/system/process.h"

namespace phongpipe {

// A run whose scene is loaded and whose hardware is known.
struct ResolvedRun {
  std::size_t index = 0;  // in the campaign
  Hardware hardware;
  VerificationOptions options;
  std::shared_ptr<const PreparedScene> scene;
};

// Sent when a run begins, and when it is finished.
struct BatchMessage {
  bool finished = false;
  std::size_t index = 0;  // in the campaign
  RunResult result;       // if finished

  static constexpr auto fields() {
    using M = BatchMessage;
    return std::make_tuple(field("finished", &M::finished), field("index", &M::index),
                           field("result", &M::result));
  }
};

// Starts a worker that builds the RTL of the batch and does its runs. It stops before its next run
// once `*stop` is set; `stop` is in memory that parent and worker share.
std::unique_ptr<Worker> start_batch(const std::vector<ResolvedRun>& runs, int memory_mib,
                                    const volatile bool* stop);
BatchMessage to_batch_message(const std::string& bytes);

}  // namespace phongpipe
