// SPDX-License-Identifier: MIT
// cornerctl export: a recording as MCAP.
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include "core/pipeline.hpp"
#include "foxglove/converter.hpp"
#include "foxglove/mcap_writer.hpp"
#include "message/line_writer.hpp"
#include "message/parsed_line.hpp"
#include "replay/line_reader.hpp"
#include "replay/recording.hpp"
#include "tool/command_line/command.hpp"
#include "tool/command_line/failure.hpp"
#include "tool/command_line/output.hpp"
#include "tool/command_line/shared_options.hpp"
#include "tool/commands.hpp"
#include "tool/replay/playback.hpp"

namespace cornerd::tool {

namespace {

struct McapOptions {
  std::filesystem::path recording;
  std::filesystem::path output;
  SettingsOptions settings;
  std::string wire = "auto";
};

class Exporter {
 public:
  explicit Exporter(const std::filesystem::path& file)
      : file_(Output::replacing(file)),
        mcap_([this](std::string_view bytes) { file_.write(bytes); }) {}

  /// Of the file, as it is. Returns what was skipped, in a line; empty if nothing was.
  std::string add_messages(const std::filesystem::path& recording) {
    std::ifstream stream(recording);
    replay::LineReader lines(stream, message::kMaxMessageBytes);
    using Result = replay::LineReader::Result;
    std::uint64_t skipped = 0;
    std::string first;
    for (Result result = lines.next(); result != Result::kEnd; result = lines.next()) {
      // The end of a recording may be torn.
      if (result == Result::kTornLine || (result == Result::kLine && lines.line().empty()))
        continue;
      const std::string problem =
          result == Result::kTooLong ? "too long for a message" : add(lines.line());
      if (problem.empty() || skipped++ > 0) continue;
      first = "line " + std::to_string(lines.number()) + ": " + problem;
    }
    return skipped == 0 ? first : std::to_string(skipped) + " lines skipped; the first: " + first;
  }
  /// A line, with or without its end. Returns what is damaged in it; empty if nothing is.
  std::string add(std::string_view line) {
    if (line.ends_with('\n')) line.remove_suffix(1);
    // A map is in force from the first message after it.
    if (line.starts_with(R"({"class":"MAP")")) {
      const message::ParsedLine parsed = message::parse_line(line);
      if (const auto* damage = std::get_if<message::RequestError>(&parsed)) return damage->text;
      map_ = line;
      return {};
    }
    return converter_.convert(line, 0,
                              [&](foxglove::ChannelId channel, core::TimeNs t_ns, auto json) {
                                if (!map_.empty())
                                  map_converter_.convert(std::exchange(map_, {}), t_ns, emit_);
                                emit_(channel, t_ns, json);
                              });
  }
  bool has_scans() const { return has_scans_; }
  void finish() {
    mcap_.finish();
    file_.commit();
  }
  std::uint64_t messages() const { return mcap_.messages(); }

 private:
  Output file_;
  foxglove::McapWriter mcap_;
  foxglove::Converter converter_;
  foxglove::Converter map_converter_;
  std::string map_;
  bool has_scans_ = false;
  const foxglove::Converter::Emit emit_ = [this](foxglove::ChannelId channel, core::TimeNs t_ns,
                                                 std::string_view json) {
    has_scans_ = has_scans_ || channel == foxglove::ChannelId::kScan;
    mcap_.add(channel, t_ns, json);
  };
};

/// Scans of the bytes of a port.
void add_decoded(Exporter& exporter, const McapOptions& options) {
  const settings::Config config = options.settings.resolve(/*needs_map=*/false);
  core::Pipeline pipeline(nullptr, config.localizer());
  message::LineWriter line;
  Playback playback(pipeline, [&](const core::Scan& scan, const core::ScanResult&) {
    exporter.add(line.scan(scan));
  });
  playback.play(options.recording, {parse_wire(options.wire), config.lidar.mount.inverted});
}

void export_recording(const McapOptions& options) {
  guard_files({.read = {options.recording, options.settings.config_file()},
               .written = {},
               .output = options.output});
  const std::string ending = options.output.extension().string();
  if (ending == ".bag" || ending == ".db3") {
    throw UsageError("-o: MCAP is no " + ending + " of rosbag: name it *.mcap");
  }
  const auto kind = replay::kind_of_recording(options.recording);
  Exporter exporter(options.output);
  std::string skipped;
  if (kind == replay::RecordingKind::kMessages) skipped = exporter.add_messages(options.recording);
  if (!exporter.has_scans()) {
    add_decoded(exporter, options);  // says itself what it skips
  } else if (!skipped.empty()) {
    std::fprintf(stderr, "%s: %s\n", options.recording.c_str(), skipped.c_str());
  }
  exporter.finish();
}

}  // namespace

void add_export(Command& program) {
  Command command = program.add_subcommand("export", "write a recording as MCAP, for Foxglove");
  const auto options = std::make_shared<McapOptions>();
  command
      .add_option("recording", options->recording,
                  ".bin, or .ndjson, such as the output of replay: POSE and MAP are exported too")
      .required()
      .type_name("FILE");
  command.add_option("-o,--output", options->output, "the MCAP file, or - for standard output")
      .required()
      .type_name("FILE");
  options->settings.add_config(command);
  add_wire_option(command, options->wire);
  command.callback([options] { export_recording(*options); });
}

}  // namespace cornerd::tool
