// SPDX-License-Identifier: MIT
#include "replay/simulator/scenarios.hpp"

#include <algorithm>

namespace cornerd::replay {

std::span<const Scenario> scenarios() {
  static const std::vector<Scenario> kScenarios = {
      {"circuit-1", {{1.65, 2.7}, {1.0, 2.7}, {1.3, 0.8}, {3.3, 0.8}, {3.3, 2.4}}},
      {"circuit-2",
       {{1.65, 4.0},
        {1.65, 1.5},
        {5.75, 1.5},
        {5.75, 4.0},
        {8.85, 4.0},
        {8.85, 6.6},
        {7.4, 6.6},
        {7.4, 5.4},
        {8.85, 5.4},
        {8.85, 4.0}}},
      {"exploration", {{0.7, 4.0}, {1.65, 4.0}, {1.65, 2.6}, {1.2, 0.9},  {3.3, 0.9},  {3.3, 1.5},
                       {5.2, 1.5}, {5.9, 0.7},  {5.75, 2.6}, {5.75, 4.0}, {8.05, 4.0}, {8.05, 2.6},
                       {9.2, 1.0}, {7.8, 1.0},  {8.05, 2.6}, {8.05, 4.0}, {8.85, 4.0}, {8.85, 5.4},
                       {9.2, 7.2}, {7.2, 6.9},  {8.85, 5.4}, {8.85, 4.0}, {4.75, 4.0}, {4.75, 5.4},
                       {5.3, 7.2}, {4.3, 7.2},  {4.75, 5.4}, {4.75, 4.0}, {2.65, 4.0}, {2.65, 5.4},
                       {1.2, 5.6}, {1.2, 7.2},  {1.6, 6.6},  {2.65, 5.4}, {2.65, 4.0}}}};
  return kScenarios;
}

const Scenario* find_scenario(std::string_view name) {
  const auto all = scenarios();
  const auto found = std::find_if(all.begin(), all.end(),
                                  [&](const Scenario& scenario) { return scenario.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace cornerd::replay
