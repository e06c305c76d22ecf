// SPDX-License-Identifier: MIT
#include "daemon/daemon_options.hpp"

#include <optional>

#include "settings/document.hpp"

namespace cornerd::daemon {
namespace {

/// Iterates over the arguments; "--name=value" equals "--name" "value".
class Arguments {
 public:
  explicit Arguments(std::span<const char* const> arguments) : rest_(arguments) {}

  bool next() {
    if (value_) throw UsageError(std::string(name_) + " takes no value");
    if (rest_.empty()) return false;
    name_ = take();
    const std::size_t equals = name_.find('=');
    if (name_.starts_with("--") && equals != std::string_view::npos) {
      value_ = name_.substr(equals + 1);
      name_ = name_.substr(0, equals);
    }
    return true;
  }

  std::string_view name() const { return name_; }

  std::string value() {
    if (!value_ && rest_.empty()) throw UsageError(std::string(name_) + " needs a value");
    const std::string value(value_ ? *value_ : take());
    value_.reset();
    return value;
  }

 private:
  std::string_view take() {
    const std::string_view first = rest_.front();
    rest_ = rest_.subspan(1);
    return first;
  }

  std::span<const char* const> rest_;
  std::string_view name_;
  std::optional<std::string_view> value_;
};

}  // namespace

constexpr std::string_view kHelp =
    R"(cornerd: localizes a robot in a known map, from one scan of its lidar.

    cornerd --config FILE            run in the foreground; SIGTERM ends it
    cornerd --config FILE --check    check config and map; print "ok" or errors

    --config FILE           the config, JSON with // comments
    --set /POINTER=VALUE    overrides one value of the config; may be repeated
    --check                 check only
    --help, --version

Exit codes: 0 success; 1 failure, see standard error; 2 wrong usage; 78 invalid
config or map, named by file, JSON pointer and reason.
)";

Options parse_options(std::span<const char* const> arguments) {
  Options options;
  Arguments rest(arguments);
  while (rest.next()) {
    if (rest.name() == "--config") {
      options.config = rest.value();
    } else if (rest.name() == "--set") {
      options.overrides.push_back(rest.value());
      if (!settings::is_override(options.overrides.back())) {
        throw UsageError("--set takes /POINTER=VALUE, not \"" + options.overrides.back() + "\"");
      }
    } else if (rest.name() == "--check") {
      options.check = true;
    } else if (rest.name() == "--help" || rest.name() == "-h") {
      options.help = true;
    } else if (rest.name() == "--version") {
      options.version = true;
    } else {
      throw UsageError("unknown argument \"" + std::string(rest.name()) + "\"");
    }
  }
  if (options.config.empty() && !options.help && !options.version) {
    throw UsageError("--config FILE is missing");
  }
  return options;
}

}  // namespace cornerd::daemon
