// SPDX-License-Identifier: MIT
#include "bench/localization/evidence_samples.hpp"
#include "bench/program/benches.hpp"
#include "bench/program/contest_maps.hpp"
#include "settings/map_file.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/progress_bar.hpp"

namespace cornerd::bench {

void run_evidence_bench(const EvidenceBenchOptions& options) {
  const std::filesystem::path folder = contest_maps_folder(options.maps);
  auto maps = load_contest_maps(folder);
  maps.push_back(settings::load_map(folder / "flat-7.json"));
  tool::Output output(options.file);
  EvidenceSamples samples(std::move(maps), options.seed);
  tool::ProgressBar bar("evidence", options.scans);
  output.write(std::string(kEvidenceColumns) + '\n');
  for (std::size_t k = 0; k < options.scans; ++k) {
    output.write(samples.take());
    bar.show(k + 1);
  }
  output.flush();
}

}  // namespace cornerd::bench
