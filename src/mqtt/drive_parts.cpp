// SPDX-License-Identifier: MIT
#include "mqtt/drive_parts.hpp"

#include <charconv>
#include <utility>

#include "message/field_reader.hpp"
#include "message/json_text.hpp"
#include "settings/sha256.hpp"

namespace cornerd::mqtt {

namespace {

constexpr std::size_t kPartBytes = 512 * 1024;
constexpr std::size_t kMaxHeaderBytes = 4096;
constexpr std::size_t kMaxDrives = 64;
constexpr std::size_t kWholeParts = kMaxDriveBytes / kPartBytes;
constexpr double kMaxParts = kWholeParts;

}  // namespace

std::vector<Message> drive_messages(const std::string& site, const std::string& robot,
                                    const std::string& name, std::string_view bytes) {
  const std::string topic = "cornerd/" + site + "/drive/" + robot + "/" + name;
  std::vector<Message> messages;
  for (std::size_t at = 0; at < bytes.size(); at += kPartBytes) {
    messages.push_back({topic + "/" + std::to_string(messages.size()),
                        std::string(bytes.substr(at, kPartBytes)), true});
  }
  message::JsonText json(256);
  json.open_object();
  json.integer("parts", messages.size());
  json.string("sha256", settings::sha256(bytes));
  json.close_object();
  messages.push_back({topic, std::string(json.view()), true});
  return messages;
}

void DriveParts::take(const Message& message) {
  if (!message.topic.starts_with(start_) || message.payload.empty()) return;
  std::string name = message.topic.substr(start_.size());
  std::optional<std::size_t> part;
  if (const std::size_t slash = name.find('/'); slash != std::string::npos) {
    std::size_t index = 0;
    const char* const end = name.data() + name.size();
    const auto [parsed_to, error] = std::from_chars(name.data() + slash + 1, end, index);
    if (error != std::errc() || parsed_to != end) return;
    part = index;
    name.resize(slash);
  }
  if (drives_.size() >= kMaxDrives && !drives_.contains(name)) return;
  Parts& drive = drives_[name];
  if (part) {
    if (bytes_ + message.payload.size() > 4 * kMaxDriveBytes) return;
    bytes_ += message.payload.size();
    drive.parts[*part] = message.payload;
    return;
  }
  message::RequestError error;
  const auto object = message::parse_object(message.payload, kMaxHeaderBytes, error);
  if (!object) return;
  message::FieldReader fields(*object);
  drive.count = static_cast<std::size_t>(fields.number("parts", {1, kMaxParts}));
  drive.sha256 = fields.text("sha256");
  if (fields.error()) drive.count = 0;
}

std::optional<DriveParts::Drive> DriveParts::assembled(const std::string& name,
                                                       const Parts& parts) {
  if (parts.count == 0) return std::nullopt;
  Drive drive{name, {}};
  for (std::size_t i = 0; i < parts.count; ++i) {
    const auto part = parts.parts.find(i);
    if (part == parts.parts.end()) return std::nullopt;
    drive.bytes += part->second;
  }
  if (settings::sha256(drive.bytes) != parts.sha256) return std::nullopt;
  return drive;
}

std::vector<DriveParts::Drive> DriveParts::whole() const {
  std::vector<Drive> whole;
  for (const auto& [name, parts] : drives_) {
    if (auto drive = assembled(name, parts)) whole.push_back(std::move(*drive));
  }
  return whole;
}

std::vector<std::string> DriveParts::incomplete() const {
  std::vector<std::string> names;
  for (const auto& [name, parts] : drives_) {
    if (!assembled(name, parts)) names.push_back(name);
  }
  return names;
}

}  // namespace cornerd::mqtt
