// SPDX-License-Identifier: MIT
// Commands and their options: a thin wrapper of CLI11, whose header only command.cpp includes
// because it compiles slowly.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace cornerd::tool {

/// One option of a command. Each function changes it and returns it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  /// Its value as --help shows it: "FILE".
  Option& type_name(const std::string& name);
  Option& required();
  /// --help shows the current value of the target, or `text`.
  Option& capture_default_str();
  Option& default_str(const std::string& text);
  /// Several values in one word: "a,b".
  Option& delimiter(char delimiter);
  /// One word for each use of the option.
  Option& one_word();
  /// --help leaves it out.
  Option& hidden();
  Option& choices(const std::vector<std::string>& values);
  /// A whole number from `low` to `high`.
  template <typename T>
  Option& range(T low, T high);
  /// A finite number from `low` to `high`. CLI11's own checks let "nan" pass.
  Option& within(double low, double high);
  Option& positive();
  /// `check` returns the error of a value; empty if it is valid.
  Option& check(const std::function<std::string(const std::string&)>& check);

  bool is_given() const;

 private:
  CLI::Option* option_;
};

/// A command of a program, or the program itself, which may have commands of its own.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command add_subcommand(const std::string& name, const std::string& help);
  /// One of the commands must be named.
  void require_subcommand();

  /// `names`: "-o,--output"; without dashes, a positional argument. The target is a string, a path,
  /// a number, an optional or a vector of them; it must live until the program ends.
  template <typename T>
  Option add_option(const std::string& names, T& target, const std::string& help = {});
  Option add_flag(const std::string& names, bool& target, const std::string& help);
  /// Calls `take` with the value.
  Option add_option_function(const std::string& names,
                             const std::function<void(const std::string&)>& take,
                             const std::string& help);

  /// An option, or a command, of an earlier version: its use fails with the new name.
  void add_renamed(const std::string& old_name, const std::string& new_name);

  /// The action, called after the options are parsed. Throws the exceptions of failure.hpp.
  void callback(const std::function<void()>& run);

 private:
  CLI::App* app_;
};

/// Runs a program and returns its exit code. `add` adds commands or options. Prints --help,
/// --version and errors; never throws.
int run_program(const std::string& name, const std::string& summary,
                const std::function<void(Command& program)>& add, int argc,
                const char* const* argv);

}  // namespace cornerd::tool
