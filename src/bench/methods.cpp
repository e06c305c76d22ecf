// SPDX-License-Identifier: MIT
#include "bench/methods.hpp"

#include <array>
#include <utility>

#include "baseline/wall_finders.hpp"

namespace cornerd::bench {
namespace {

using core::DetectorConfig;

DetectorConfig of(core::WallFinderFactory finder) {
  DetectorConfig config;
  config.finder = std::move(finder);
  return config;
}

const std::array kPaperMethods = {
    NamedMethod{"altbd", "ALTBD", of({})},
    NamedMethod{"abd-iepf", "ABD+IEPF", of(baseline::abd_iepf())},
    NamedMethod{"lt", "LT", of(baseline::line_tracking())},
};

/// The paper's walls have more than four points (section V.B).
DetectorConfig walls_of_five(core::WallFinderFactory finder) {
  DetectorConfig config = of(std::move(finder));
  config.min_support = 5;
  return config;
}

DetectorConfig printed_altbd(const baseline::PrintedAltbdConfig& reading) {
  return walls_of_five(baseline::printed_altbd(reading));
}

DetectorConfig abd_iepf(baseline::AbdThreshold threshold, double split_limit_m) {
  return of(baseline::abd_iepf({.threshold = threshold, .split_limit_m = split_limit_m}));
}

using baseline::AbdThreshold;
using baseline::EllipseAxes;
using baseline::ErrorMean;
using baseline::MinorAxis;
using baseline::TrackedLine;

const std::array kVariants = {
    NamedMethod{"altbd-5", "ALTBD, walls of 5", walls_of_five({})},
    NamedMethod{"abd-iepf-5", "ABD+IEPF, walls of 5", walls_of_five(baseline::abd_iepf())},
    NamedMethod{"altbd-printed", "ALTBD as printed", printed_altbd({})},
    NamedMethod{"altbd-printed-metres", "printed: h_max in metres",
                printed_altbd({.minor = MinorAxis::kMetres})},
    NamedMethod{"altbd-printed-squared", "printed: axes squared",
                printed_altbd({.axes = EllipseAxes::kSquared})},
    NamedMethod{"altbd-printed-last-three", "printed: line of last three",
                printed_altbd({.line = TrackedLine::kLastThree})},
    NamedMethod{"altbd-printed-all", "printed: line of all",
                printed_altbd({.line = TrackedLine::kAll})},
    NamedMethod{"altbd-printed-mean-all", "printed: mean of all errors",
                printed_altbd({.mean = ErrorMean::kAll})},
    NamedMethod{"altbd-printed-squared-all", "printed: squared, line of all",
                printed_altbd({.axes = EllipseAxes::kSquared, .line = TrackedLine::kAll})},
    NamedMethod{"abd-iepf-borges", "ABD (eq. 4)+IEPF", abd_iepf(AbdThreshold::kBorgesAldon, 0.03)},
    NamedMethod{"abd-iepf-printed", "ABD+IEPF, 46 cm", abd_iepf(AbdThreshold::kWeerakoon, 0.46)},
};

}  // namespace

std::span<const NamedMethod> paper_methods() { return kPaperMethods; }
std::span<const NamedMethod> variants() { return kVariants; }

const NamedMethod* find_method(std::string_view name) {
  for (const auto methods : {paper_methods(), variants()}) {
    for (const NamedMethod& method : methods) {
      if (method.name == name) return &method;
    }
  }
  return nullptr;
}

}  // namespace cornerd::bench
