// SPDX-License-Identifier: MIT
// cornerctl export: a recording as MCAP.
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
      : file_(file), mcap_([this](std::string_view bytes) { file_.write(bytes); }) {}

  /// Of the file, as it is.
  void add_messages(const std::filesystem::path& recording) {
    std::ifstream stream(recording);
    replay::LineReader lines(stream, message::kMaxMessageBytes);
    using Result = replay::LineReader::Result;
    for (Result result = lines.next(); result != Result::kEnd; result = lines.next()) {
      if (result == Result::kLine) add(lines.line());
    }
  }
  /// A line, with or without its end.
  void add(std::string_view line) {
    if (line.ends_with('\n')) line.remove_suffix(1);
    // A map is in force from the first message after it.
    if (line.starts_with(R"({"class":"MAP")")) {
      map_ = line;
      return;
    }
    converter_.convert(line, 0, [&](foxglove::ChannelId channel, core::TimeNs t_ns, auto json) {
      if (!map_.empty()) map_converter_.convert(std::exchange(map_, {}), t_ns, emit_);
      emit_(channel, t_ns, json);
    });
  }
  bool has_scans() const { return has_scans_; }
  void finish() {
    mcap_.finish();
    file_.flush();
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
  const auto kind = replay::kind_of_recording(options.recording);
  Exporter exporter(options.output);
  if (kind == replay::RecordingKind::kMessages) exporter.add_messages(options.recording);
  if (!exporter.has_scans()) add_decoded(exporter, options);
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
