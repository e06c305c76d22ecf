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

const std::array<NamedMethod, 0> kVariants = {};

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
