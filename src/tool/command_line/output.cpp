// SPDX-License-Identifier: MIT
#include "tool/command_line/output.hpp"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "tool/command_line/failure.hpp"

namespace cornerd::tool {

void Output::Closer::operator()(std::FILE* file) const {
  if (file != stdout && file != stderr) std::fclose(file);
}

Output::Output(std::FILE* stream, std::string name, bool flush_each)
    : file_(stream), name_(std::move(name)), flush_each_(flush_each) {}

Output::Output(bool flush_each) : Output(stdout, "standard output", flush_each) {}

Output::Output(const std::filesystem::path& file)
    : Output(file == kStandardOutput ? stdout : std::fopen(file.c_str(), "wbe"), file.string(),
             false) {
  if (!file_) fail();
}

Output Output::replacing(const std::filesystem::path& file) {
  if (file == kStandardOutput) return Output(file);
  auto replacement = std::make_unique<Replacement>(file);
  Output output(std::fopen(replacement->path().c_str(), "wbe"), file.string(), false);
  if (!output.file_) output.fail();
  output.replacement_ = std::move(replacement);
  return output;
}

Output Output::report_beside(const std::filesystem::path& data) {
  if (data == kStandardOutput) return {stderr, "standard error", false};
  return Output();
}

void Output::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
  if (flush_each_) flush();
}

void Output::flush() {
  if (std::fflush(file_.get()) != 0) fail();
}

void Output::commit() {
  flush();
  if (replacement_) replacement_->commit();
}

void Output::fail() const {
  if (errno == EPIPE) throw OutputClosed();
  throw Failure(name_ + ": " + std::strerror(errno));
}

Replacement::Replacement(const std::filesystem::path& file) : path_(file) {
  std::error_code ignored;
  const bool is_new = !std::filesystem::exists(file, ignored);
  if (file.empty() || (!is_new && !std::filesystem::is_regular_file(file, ignored))) return;
  // Not in place of a link, but of what it points at.
  target_ = is_new ? file : std::filesystem::canonical(file, ignored);
  path_ =
      target_.parent_path() / (target_.stem().string() + ".part" + target_.extension().string());
}

Replacement::~Replacement() {
  std::error_code ignored;
  if (!target_.empty()) std::filesystem::remove(path_, ignored);
}

void Replacement::commit() {
  if (target_.empty()) return;
  if (std::rename(path_.c_str(), target_.c_str()) != 0) {
    throw Failure(target_.string() + ": " + std::strerror(errno));
  }
  target_.clear();
}

void write_file(const std::filesystem::path& file, std::string_view text) {
  Output output = Output::replacing(file);
  output.write(text);
  output.commit();
}

void keep_earlier(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error) || std::filesystem::is_empty(file, error)) {
    return;
  }
  // Not a link, but what it points at.
  const std::filesystem::path target = std::filesystem::canonical(file, error);
  std::filesystem::path earlier = target.string() + '~';
  for (int i = 2; std::filesystem::exists(earlier, error); ++i) {
    earlier = target.string() + '~' + std::to_string(i);
  }
  std::filesystem::rename(target, earlier, error);
  if (error) throw Failure(earlier.string() + ": " + error.message());
  std::fprintf(stderr, "%s: the earlier file is %s now\n", file.c_str(), earlier.c_str());
}

namespace {

namespace fs = std::filesystem;

/// Also for files that do not exist yet.
bool is_same_file(const fs::path& one, const fs::path& other) {
  if (one.empty() || other.empty()) return false;
  std::error_code ignored;
  return fs::equivalent(one, other, ignored) ||
         fs::weakly_canonical(fs::absolute(one, ignored), ignored) ==
             fs::weakly_canonical(fs::absolute(other, ignored), ignored);
}

/// Several outputs may share a device such as /dev/null.
bool is_device(const fs::path& file) {
  std::error_code ignored;
  return fs::is_character_file(file, ignored);
}

}  // namespace

void guard_files(const CommandFiles& files) {
  for (const fs::path& file : files.written) {
    if (file == kStandardOutput) {
      throw UsageError("-: this output cannot be standard output; name a file (./- for a file -)");
    }
  }
  std::vector<fs::path> written = files.written;
  if (files.output != kStandardOutput) written.push_back(files.output);
  for (std::size_t i = 0; i < written.size(); ++i) {
    for (const fs::path& file : files.read) {
      if (is_same_file(file, written[i])) {
        throw UsageError(written[i].string() +
                         ": is an input of this command; name another output");
      }
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (is_same_file(written[i], written[j]) && !is_device(written[i])) {
        throw UsageError(written[i].string() + ": is named for two outputs; name a file for each");
      }
    }
  }
}

}  // namespace cornerd::tool
