#include "testbench/synthesis/fitted_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace phongpipe {
namespace {

// The least coefficients that fit the rows, for features that always occur together.
Eigen::VectorXd solve(const Eigen::MatrixXd& features, const Eigen::VectorXd& values) {
  const Eigen::VectorXd weights = values.cwiseInverse();
  return (weights.asDiagonal() * features)
      .completeOrthogonalDecomposition()
      .solve(Eigen::VectorXd::Ones(values.size()));
}

Eigen::VectorXd without(const Eigen::VectorXd& all, Eigen::Index left_out) {
  Eigen::VectorXd rest(all.size() - 1);
  rest << all.head(left_out), all.tail(all.size() - left_out - 1);
  return rest;
}

}  // namespace

std::vector<std::string_view> area_features(std::string_view module) {
  if (module == "pixel_datapath_wide") {
    return {"constant", "lanes", "series_bits", "word_bits"};
  }
  if (module == "pixel_datapath_serial") {
    return {"constant",       "channels",  "specular",
            "series_bits",    "bank_bits", "octave_address_bits",
            "increment_bits", "depth_cue", "depth_cue_channels"};
  }
  return {"constant",  "channels",    "series_bits",         "level_bits",
          "word_bits", "bank_bits",   "octave_address_bits", "increment_bits",
          "specular",  "gate_series", "depth_cue",           "depth_cue_channels"};
}

// Of the serial datapath, digits of 8 bits; of the wide ones, carries through whole series.
std::vector<std::string_view> clock_features(std::string_view module) {
  if (module == "pixel_datapath_serial") return {"constant", "depth_cue"};
  if (module == "pixel_datapath_wide") return {"constant", "lanes", "widest_series_bits"};
  return {"constant", "channels", "long_carry_bits", "specular", "depth_cue", "depth_cue_channels"};
}

FittedModel fit_model(const std::vector<DatapathConfiguration>& configurations,
                      const std::vector<double>& values,
                      const std::vector<std::string_view>& used) {
  const auto is_used = [&used](std::string_view name) {
    return std::find(used.begin(), used.end(), name) != used.end();
  };
  const auto count = static_cast<Eigen::Index>(values.size());
  Eigen::MatrixXd features(count, static_cast<Eigen::Index>(used.size()));
  for (Eigen::Index row = 0; row < count; ++row) {
    Eigen::Index column = 0;
    for (const auto& [name, value] :
         synthesis_features(configurations[static_cast<std::size_t>(row)])) {
      if (is_used(name)) features(row, column++) = value;
    }
  }
  const Eigen::VectorXd known = Eigen::VectorXd::Map(values.data(), count);
  FittedModel model;
  for (Eigen::Index left_out = 0; left_out < count; ++left_out) {
    Eigen::MatrixXd rest(count - 1, features.cols());
    rest << features.topRows(left_out), features.bottomRows(count - left_out - 1);
    const double guess = features.row(left_out).dot(solve(rest, without(known, left_out)));
    model.relative_error = std::max(model.relative_error, std::abs(guess / known(left_out) - 1));
  }
  const Eigen::VectorXd coefficients = solve(features, known);
  Eigen::Index column = 0;
  for (const auto& [name, value] : synthesis_features({})) {
    model.coefficients.push_back(is_used(name) ? coefficients(column++) : 0);
  }
  return model;
}

}  // namespace phongpipe
