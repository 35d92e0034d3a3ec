#include "testbench/methods/certified_curve.h"

#include <fmt/format.h>

#include <cmath>

#include "testbench/cosim/verification.h"

namespace phongpipe {

Curve certified_curve(const std::shared_ptr<const PreparedScene>& scene, const Hardware& hardware,
                      const std::function<void(const std::string&)>& progress) {
  VerificationOptions options;
  options.rtl = RtlToVerify::off;
  const auto verified = [&](int max_error_thousandths) {
    Hardware changed = hardware;
    changed.setup.max_error_thousandths = max_error_thousandths;
    return verify(scene, changed, options);
  };
  Curve curve;
  curve.title = "Time over accuracy, " + scene->scene.source;
  curve.x_label = "largest error, LSB";
  curve.y_label = "ns a pixel";
  curve.log_x = true;
  PlotSeries proved{"proved", {}}, measured{"measured there", {}};
  DatapathConfiguration datapath;
  static_cast<FixedPointFormats&>(datapath) = hardware.formats;
  const int least = static_cast<int>(std::ceil(1000 * least_certified_error_lsb(datapath)));
  for (const int limit : {least, 550, 600, 700, 850, 1000, 1500, 2000, 3000, 4000, 6000, 8000}) {
    if (limit < least) continue;
    progress(fmt::format("at most {:g} LSB", limit / 1000.0));
    const VerificationResult result = verified(limit);
    proved.points.push_back({limit / 1000.0, result.frame_ns_per_pixel(), ""});
    measured.points.push_back({result.accuracy.total.largest_lsb, result.frame_ns_per_pixel(), ""});
  }
  progress("without a limit");
  const VerificationResult without = verified(0);
  PlotSeries uncertified{"no limit, measured",
                         {{without.accuracy.total.largest_lsb, without.frame_ns_per_pixel(), ""}}};
  uncertified.joined = false;
  measured.joined = false;
  curve.series = {proved, measured, uncertified};
  return curve;
}

}  // namespace phongpipe
