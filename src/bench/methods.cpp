// SPDX-License-Identifier: MIT
#include "bench/methods.hpp"

#include <array>

namespace cornerd::bench {
namespace {

using core::DetectorConfig;
using core::Method;

DetectorConfig of(Method method) {
  DetectorConfig config;
  config.method = method;
  return config;
}

const std::array kPaperMethods = {
    NamedMethod{"altbd", "ALTBD", of(Method::kAltbd)},
    NamedMethod{"abd-iepf", "ABD+IEPF", of(Method::kAbdIepf)},
    NamedMethod{"lt", "LT", of(Method::kLineTracking)},
};

/// As the paper has them: walls of more than four points.
DetectorConfig walls_of_five(Method method) {
  DetectorConfig config = of(method);
  config.min_support = 5;
  return config;
}

DetectorConfig printed_altbd(const core::PrintedAltbdConfig& reading) {
  DetectorConfig config = walls_of_five(Method::kPrintedAltbd);
  config.printed_altbd = reading;
  return config;
}

DetectorConfig abd_iepf(core::AbdThreshold threshold, double split_limit_m) {
  DetectorConfig config = of(Method::kAbdIepf);
  config.abd_iepf.threshold = threshold;
  config.abd_iepf.split_limit_m = split_limit_m;
  return config;
}

using core::AbdThreshold;
using core::EllipseAxes;
using core::ErrorMean;
using core::MinorAxis;
using core::TrackedLine;

const std::array kVariants = {
    NamedMethod{"altbd-5", "ALTBD, walls of 5", walls_of_five(Method::kAltbd)},
    NamedMethod{"abd-iepf-5", "ABD+IEPF, walls of 5", walls_of_five(Method::kAbdIepf)},
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
