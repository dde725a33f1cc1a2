// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/import_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "io/child_process.hpp"

namespace impinge::io {
namespace {

bool is_program(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0;
}

/// The first line of what the child said on standard error, as a sentence's tail.
std::string last_words(std::string_view said) {
  said = trimmed(said);
  said = said.substr(0, std::min<std::size_t>(said.find('\n'), 300));
  return said.empty() ? "" : sentence(", saying: ", said);
}

/// What an importer without a whole stream died of.
std::string cause_of(const ChildReport& report, const ReadOptions& options) {
  if (report.timed_out) {
    return sentence("the importer was stopped after the time limit of ", options.time_limit.count(),
                    " s; raise the limit if the file is good");
  }
  if (report.too_much) {
    return sentence("the importer wrote more than the memory limit of ", options.memory_limit_bytes,
                    " bytes; raise the limit if the file is good");
  }
  if (WIFSIGNALED(report.status)) {
    const int signal = WTERMSIG(report.status);
    if (signal == SIGXCPU) {
      return sentence("the importer used up the time limit of ", options.time_limit.count(),
                      " s; raise the limit if the file is good");
    }
    if (signal == SIGKILL) {
      return sentence(
          "the importer was killed", last_words(report.said),
          "; the machine ran out of memory, or somebody ended it: close other programs, or split the model");
    }
    return sentence("the importer stopped (signal ", signal, ", ", strsignal(signal), ") on this file",
                    last_words(report.said), "; the file is probably broken, or needs a newer importer");
  }
  return sentence("the importer ended with status ", WEXITSTATUS(report.status), last_words(report.said));
}

/// The child's program: `options.importer`, the environment's IMPINGE_IMPORTER, impinge-import beside the running
/// program or in ../libexec/impinge from there, or where it was installed. Errors: `bad_file`.
Result<std::filesystem::path> find_importer(const ReadOptions& options) {
  std::vector<std::filesystem::path> places;
  if (!options.importer.empty()) {
    places.push_back(options.importer);
  } else if (const char* const named = std::getenv("IMPINGE_IMPORTER"); named && *named) {
    places.emplace_back(named);
  } else {
    std::error_code ignored;
    const auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
    if (!folder.empty()) {
      places.push_back(folder / "impinge-import");
      places.push_back(folder / ".." / "libexec" / "impinge" / "impinge-import");
    }
    places.emplace_back(IMPINGE_INSTALLED_IMPORTER);
  }
  for (const auto& place : places) {
    if (is_program(place)) return place;
  }
  return Error{Code::bad_file,
               sentence("the program impinge-import, which reads every format but OBJ, OFF, PLY and STL, is not at ",
                        places.front().string(),
                        "; install it there, or name its place in the environment variable IMPINGE_IMPORTER")};
}

}  // namespace

Result<Model> import_file(const std::filesystem::path& file, const Source& source, const ReadOptions& options) {
  const Result<std::filesystem::path> importer = find_importer(options);
  if (!importer) return file_error(source, importer.error().message);

  const auto seconds = std::max<std::chrono::seconds::rep>(options.time_limit.count(), 1);
  std::vector<std::string> arguments{importer->string(), file.string(), std::to_string(options.memory_limit_bytes),
                                     std::to_string(seconds)};
  if (options.property_sets) arguments.emplace_back("property-sets");
  ChildLimits limits{options.time_limit, options.memory_limit_bytes, options.stop};
  const ChildReport report = run_child(arguments, limits);
  if (report.cancelled) return Error{Code::cancelled, sentence(source.label, ": reading was cancelled")};
  if (!report.failure.empty()) {
    return file_error(source, sentence("the importer ", importer->string(), " did not run: ", report.failure));
  }
  const bool ended_well = !report.timed_out && !report.too_much && WIFEXITED(report.status);
  Result<Imported> imported = decode_import(report.output);
  if (ended_well && imported && !imported->error.empty()) {
    return file_error(source, trimmed(imported->error));
  }
  if (!ended_well || WEXITSTATUS(report.status) != 0) return file_error(source, cause_of(report, options));
  if (!imported) return file_error(source, sentence("the importer ended well, but ", imported.error().message));
  return model_of(std::move(*imported), source);
}

}  // namespace impinge::io
