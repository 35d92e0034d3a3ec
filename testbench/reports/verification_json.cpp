#include "testbench/reports/verification_json.h"

#include <utility>

#include "testbench/cosim/metrics_json.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

using nlohmann::ordered_json;

ordered_json effects_json(const VerificationResult& r) {
  ordered_json json = {{"used", r.effects.used}, {"left_out", r.effects.left_out}};
  for_each_block_metric(r,
                        [&](const Metric& metric, const MetricValue& own, const MetricValue& full) {
                          json["built"][std::string(metric.name)] = own;
                          if (r.full_hardware) json["everything"][std::string(metric.name)] = full;
                        });
  json["built"]["modules"] = r.systemc.counts.modules;
  if (r.full_hardware) {
    json["everything"]["modules"] = r.full_hardware->systemc.counts.modules;
    json["everything"]["frame_mismatches"] = r.full_hardware->systemc.frame_mismatches;
  }
  return json;
}

ordered_json configuration_json(const VerificationResult& r) {
  ordered_json json = {{"hardware", r.hardware.name}, {"technology", r.hardware.technology.name}};
  for (const Setting<Hardware>& setting : hardware_settings()) {
    auto& value = json[std::string(setting.section)][std::string(setting.key)];
    if (setting.per_unit > 1) {
      value = setting.in_units(setting.get(r.hardware));
    } else if (setting.choices.empty()) {
      value = setting.get(r.hardware);
    } else {
      value = setting.value(r.hardware);
    }
  }
  json["datapath"]["channels"] = r.configuration.channels;
  return json;
}

ordered_json divergence_json(const VerificationResult& r, const std::string& capsule) {
  ordered_json json;
  const ImplementationResult* const found = r.diverging();
  if (found == nullptr) return json;
  if (found->first_divergence) {
    const Divergence& d = *found->first_divergence;
    json = {{"triangle", d.triangle},
            {"x", d.model.x},
            {"y", d.model.y},
            {"cycle", d.cycle},
            {"block", "pixel_datapath"},
            {"signal", "pixel_color"},
            {"model", d.model.color},
            {"other", d.found.color}};
  }
  if (found->signal_divergence) {
    const SignalDivergence& s = *found->signal_divergence;
    json["cycle"] = s.cycle;
    json["block"] = s.block;
    json["signal"] = s.signal;
    json["model"] = s.model;
    json["other"] = s.other;
  }
  json["capsule"] = capsule.empty() ? ordered_json() : ordered_json(capsule);
  return json;
}

}  // namespace

ordered_json report_json(const VerificationResult& r, const std::string& capsule) {
  ordered_json json = {
      {"scene", r.scene},
      {"passed", r.passed()},
      {"configuration", configuration_json(r)},
      {"clock_kind", name(r.clock.kind)},
      {"clock_limited_by", r.clock.limited_by},
      {"too_large_for_device", r.clock.too_large},
      {"configuration_hash", configuration_hash(r.hardware)},
      {"detail", r.options.detail == Detail::cycle ? "cycle" : "span"},
      {"stall_percent", r.options.stall_percent},
      {"seed", r.options.seed},
      {"budget_ns", r.options.budget_ns},
      {"within_budget", r.within_budget()},
      {"max_error_limit_lsb",
       r.options.max_error_lsb ? ordered_json(*r.options.max_error_lsb) : ordered_json()},
      {"max_error_lsb", r.accuracy.total.largest_lsb},
      {"within_error", r.within_error()},
      {"clock_source", r.hardware.technology.source},
      {"limited_by", r.limiting_block().block},
      {"notes", r.notes}};
  for (const Metric& metric : metrics()) {
    if (metric.json.empty()) continue;
    json[ordered_json::json_pointer(std::string(metric.json))] = metric.value(r);
  }
  for (std::size_t i = 0; i < kShadingPaths; ++i) {
    json["ledger_cycles"][std::string(kShadingPathNames[i])] =
        r.unit_cycles(static_cast<ShadingPath>(i));
  }
  for (const BlockLoad& load : r.block_loads()) {
    const double ns = r.ns_per_pixel(load);
    json["blocks"][std::string(load.block)] = {
        {"cycles", load.cycles}, {"ns_per_pixel", ns}, {"slack_ns", r.options.budget_ns - ns}};
  }
  if (const auto units = r.balanced_units()) {
    json["fewest_setup_units"] = {{"adders", units->adders.count},
                                  {"multipliers", units->multipliers.count},
                                  {"rsqrt", units->rsqrt.count},
                                  {"power_units", units->power.count}};
  } else {
    json["fewest_setup_units"] = nullptr;
  }
  json["worst_pixels"] = ordered_json::array();
  for (const WorstPixel& worst : r.worst_pixels) {
    ordered_json pixel = {{"x", worst.x},
                          {"y", worst.y},
                          {"error_lsb", worst.error_lsb},
                          {"triangle", worst.triangle},
                          {"largest_part", worst.largest_part}};
    for (int c = 0; c < r.configuration.channels; ++c) {
      pixel["output"].push_back(worst.output[c]);
      pixel["exact_lsb"].push_back(worst.exact[c]);
    }
    json["worst_pixels"].push_back(pixel);
  }
  json["first_divergence"] = divergence_json(r, capsule);
  json["effects"] = effects_json(r);
  const auto add = [&json](const char* name, const ImplementationResult& found) {
    ordered_json& entry = json["implementations"][name];
    entry["failure"] =
        found.counts.failure.empty() ? ordered_json() : ordered_json(found.counts.failure);
    entry["first_divergence"] = nlohmann::json(found.first_divergence);
  };
  add("systemc", r.systemc);
  if (r.rtl) add("rtl", *r.rtl);
  return json;
}

}  // namespace phongpipe
