// SPDX-License-Identifier: MIT
#include "tool/command_line/command.hpp"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "settings/object_reader.hpp"
#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

Option& Option::type_name(const std::string& name) {
  option_->type_name(name);
  return *this;
}

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::capture_default_str() {
  option_->capture_default_str();
  return *this;
}

Option& Option::default_str(const std::string& text) {
  option_->default_str(text);
  return *this;
}

Option& Option::delimiter(char delimiter) {
  option_->delimiter(delimiter);
  return *this;
}

Option& Option::one_word() {
  option_->allow_extra_args(false);
  return *this;
}

Option& Option::hidden() {
  option_->group("");
  return *this;
}

Option& Option::choices(const std::vector<std::string>& values) {
  option_->check(CLI::IsMember(values));
  return *this;
}

template <typename T>
Option& Option::range(T low, T high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
template Option& Option::range(int, int);
template Option& Option::range(std::size_t, std::size_t);

Option& Option::within(double low, double high) {
  const std::string limits = settings::to_text(low) + " to " + settings::to_text(high);
  option_->check(
      [low, high, limits](const std::string& text) {
        double number = 0;
        const bool read = CLI::detail::lexical_cast(text, number);
        return read && number >= low && number <= high
                   ? std::string()
                   : "must be a number from " + limits + ", not " + text;
      },
      "FLOAT in [" + limits + "]");
  return *this;
}

Option& Option::positive() {
  // CLI11's own message has the largest double in 309 digits.
  option_->check([](const std::string& text) {
    // NaN passes PositiveNumber.
    const bool is_number = text.find("nan") == text.npos && text.find("NaN") == text.npos &&
                           CLI::PositiveNumber(text).empty();
    return is_number ? "" : "must be a number above 0, not " + text;
  });
  return *this;
}

Option& Option::check(const std::function<std::string(const std::string&)>& check) {
  option_->check(check);
  return *this;
}

bool Option::is_given() const { return option_->count() > 0; }

Command Command::add_subcommand(const std::string& name, const std::string& help) {
  return Command(*app_->add_subcommand(name, help));
}

void Command::require_subcommand() { app_->require_subcommand(1); }

template <typename T>
Option Command::add_option(const std::string& names, T& target, const std::string& help) {
  return Option(*app_->add_option(names, target, help));
}
template Option Command::add_option(const std::string&, std::string&, const std::string&);
template Option Command::add_option(const std::string&, std::filesystem::path&, const std::string&);
template Option Command::add_option(const std::string&, double&, const std::string&);
template Option Command::add_option(const std::string&, std::size_t&, const std::string&);
template Option Command::add_option(const std::string&, std::int64_t&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::optional<std::size_t>&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::string>&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::filesystem::path>&,
                                    const std::string&);
template Option Command::add_option(const std::string&, std::vector<double>&, const std::string&);
template Option Command::add_option(const std::string&, std::vector<std::size_t>&,
                                    const std::string&);
#if SIZE_MAX != UINT64_MAX
template Option Command::add_option(const std::string&, std::uint64_t&, const std::string&);
#endif

Option Command::add_flag(const std::string& names, bool& target, const std::string& help) {
  return Option(*app_->add_flag(names, target, help));
}

Option Command::add_option_function(const std::string& names,
                                    const std::function<void(const std::string&)>& take,
                                    const std::string& help) {
  return Option(*app_->add_option_function<std::string>(names, take, help));
}

void Command::add_renamed(const std::string& old_name, const std::string& new_name) {
  const auto refuse = [text = old_name + " is now called " + new_name] { throw UsageError(text); };
  if (old_name.starts_with('-')) {
    app_->add_flag_callback(old_name, refuse)->trigger_on_parse()->group("");
  } else {
    app_->add_subcommand(old_name)->group("")->preparse_callback(
        [refuse](std::size_t) { refuse(); });
  }
}

void Command::callback(const std::function<void()>& run) { app_->callback(run); }

namespace {

/// CLI11's help, wrapped at 80 columns. Continued lines keep the column of their description.
class WrappedHelp : public CLI::Formatter {
 public:
  std::string make_help(const CLI::App* app, std::string name,
                        CLI::AppFormatMode mode) const override {
    std::istringstream lines(CLI::Formatter::make_help(app, std::move(name), mode));
    std::string wrapped;
    for (std::string line; std::getline(lines, line);) wrapped += wrap(line);
    return wrapped;
  }

 private:
  static constexpr std::size_t kWidth = 80;

  static std::string wrap(std::string line) {
    // Where the description begins: after the name, or after the spaces of a continued line.
    const std::size_t name = line.find_first_not_of(' ');
    std::size_t column = name == std::string::npos ? 0 : name;
    if (const std::size_t gap = line.find("  ", column); gap != std::string::npos) {
      column = line.find_first_not_of(' ', gap);
    }
    std::string wrapped;
    while (line.size() > kWidth && column < kWidth / 2) {
      const std::size_t space = line.rfind(' ', kWidth);
      if (space == std::string::npos || space <= column) break;
      wrapped += line.substr(0, space) + '\n';
      line = std::string(column, ' ') + line.substr(space + 1);
    }
    return wrapped + line + '\n';
  }
};

/// "noise, bias, odometry"; old names, which have no group, are left out.
std::string names_of_subcommands(const CLI::App& group) {
  std::string names;
  for (const CLI::App* one : group.get_subcommands([](const CLI::App*) { return true; })) {
    if (!one->get_group().empty()) names += (names.empty() ? "" : ", ") + one->get_name();
  }
  return names + "\n";
}

}  // namespace

int run_program(const std::string& name, const std::string& summary,
                const std::function<void(Command& program)>& add, int argc,
                const char* const* argv) {
  const auto fail = [&](const char* text, int exit_code) {
    std::fprintf(stderr, "%s: %s\n", name.c_str(), text);
    return exit_code;
  };
  // A write beyond a limit of file sizes fails with a message.
  std::signal(SIGXFSZ, SIG_IGN);
  CLI::App app(name + ": " + summary, name);
  app.formatter(std::make_shared<WrappedHelp>());
  app.set_version_flag("--version", name + " " CORNERD_VERSION);
  app.fallthrough();
  app.failure_message([&](const CLI::App* parsed, const CLI::Error& error) {
    const CLI::App* command = parsed;
    while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
    // CLI11's own words do not name the choices.
    if (command != parsed && command->get_require_subcommand_min() > 0) {
      return name + ": " + command->get_name() + " needs one of: " + names_of_subcommands(*command);
    }
    return name + ": " + CLI::FailureMessage::simple(parsed, error);
  });
  Command program(app);
  add(program);
  try {
    const std::string first = argc > 1 ? argv[1] : "";
    if (app.get_require_subcommand_min() > 0 && !first.empty() && first.front() != '-' &&
        app.get_subcommands([&](CLI::App* one) { return one->get_name() == first; }).empty()) {
      throw UsageError("there is no command \"" + first + "\"; " + name + " --help lists them");
    }
    app.parse(argc, argv);
    return kExitDone;
  } catch (const CLI::RequiredError& error) {
    // An unknown option may be the required one, misspelt.
    const std::vector<std::string> unknown = app.remaining(/*recurse=*/true);
    unknown.empty() ? app.exit(error) : app.exit(CLI::ExtrasError(app.get_name(), unknown));
    return kExitUsage;
  } catch (const CLI::ParseError& error) {
    if (app.exit(error) != 0) return kExitUsage;
    if (std::cout.flush() || errno == EPIPE) return kExitDone;
    return fail(("standard output: " + std::string(std::strerror(errno))).c_str(), kExitFailed);
  } catch (const OutputClosed&) {
    return kExitDone;
  } catch (const UsageError& error) {
    return fail(error.what(), kExitUsage);
  } catch (const settings::SettingsError& error) {
    return fail(error.what(), kExitConfig);
  } catch (const std::exception& error) {
    return fail(error.what(), kExitFailed);
  }
}

}  // namespace cornerd::tool
