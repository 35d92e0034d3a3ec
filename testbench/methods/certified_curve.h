// What accuracy costs in time: nanoseconds a pixel over the error that is proved for every pixel.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "model/fixed/prepared_frame.h"
#include "testbench/hardware/hardware.h"
#include "testbench/methods/curves.h"

namespace phongpipe {

// One series with the frame's time for limits from the least that can be had to 8 LSB; one with the
// largest error that is measured in place of the limit; and a point for the same hardware without
// setup_engine.max_error, at the error that it has. Simulated in SystemC, without RTL.
Curve certified_curve(const std::shared_ptr<const PreparedScene>& scene, const Hardware& hardware,
                      const std::function<void(const std::string&)>& progress);

}  // namespace phongpipe
