// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// impinge-import FILE MEMORY_BYTES CPU_SECONDS
///
/// Reads a mesh file by assimp, or 3MF by lib3mf, and writes it to standard output as io/import_stream.hpp describes. A
/// process of its own, because these crash, hang and take all memory on some broken files. For IFC it becomes another
/// program, with the same limits.
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <string_view>

#include "io/import_stream.hpp"
#include "io/importer/ifc.hpp"
#include "io/importer/scene_writer.hpp"
#include "io/importer/threemf.hpp"
#include "io/text.hpp"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define IMPINGE_IS_SANITIZED 1
#elif defined(__has_feature)
#define IMPINGE_IS_SANITIZED (__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define IMPINGE_IS_SANITIZED 0
#endif

namespace impinge::importer {
namespace {

void limit(decltype(RLIMIT_CPU) what, rlim_t value) {
  rlimit now{};
  getrlimit(what, &now);
  if (now.rlim_max != RLIM_INFINITY && value > now.rlim_max) value = now.rlim_max;
  const rlimit wanted{value, now.rlim_max};
  setrlimit(what, &wanted);
}

void set_limits(decltype(RLIMIT_CPU) memory, std::int64_t memory_bytes, std::int64_t cpu_seconds) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(cpu_seconds));
#if !IMPINGE_IS_SANITIZED  // sanitizers reserve terabytes of addresses
  limit(memory, static_cast<rlim_t>(memory_bytes));
#else
  (void)memory, (void)memory_bytes;
#endif
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nobody waits for the answer of an orphan
}

/// The stream's own descriptor; whatever a library prints goes nowhere.
int take_standard_output() {
  const int stream = fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, 3);
  const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (nowhere >= 0) dup2(nowhere, STDOUT_FILENO);
  return stream;
}

int run_ifc(const char* file, bool property_sets, std::int64_t memory_bytes, std::int64_t cpu_seconds) {
  // WebAssembly reserves more addresses than any limit on these would leave it.
  set_limits(RLIMIT_DATA, memory_bytes, cpu_seconds);
  const std::string problem = become_ifc_importer(file, property_sets);
  io::ImportWriter(STDOUT_FILENO).error(problem);
  return 0;
}

int run(const char* file, std::int64_t memory_bytes, std::int64_t cpu_seconds) {
  set_limits(RLIMIT_AS, memory_bytes, cpu_seconds);
  const int stream = take_standard_output();
  if (stream < 0) return 1;
  io::ImportWriter writer(stream);
  const bool by_lib3mf = is_3mf(file);
  const std::string library = by_lib3mf ? "lib3mf" : "assimp";
  try {
    const std::string problem = by_lib3mf ? write_3mf(file, writer) : write_scene(file, writer);
    if (problem.empty()) return writer.end() ? 0 : 1;
    const bool is_memory = problem.find("bad_alloc") != problem.npos;
    if (!is_memory) {
      writer.error(io::sentence(library, " cannot read the file (", io::trimmed(problem),
                                "); mend it, or export to another format"));
      return 0;
    }
  } catch (const std::bad_alloc&) {
  } catch (const std::exception& error) {
    writer.error(io::sentence(library, " cannot read the file (", error.what(), ")"));
    return 0;
  }
  writer.error(io::sentence("it needs more than the memory limit of ", memory_bytes,
                            " bytes; raise the limit if the file is good"));
  return 0;
}

}  // namespace
}  // namespace impinge::importer

int main(int argc, char** argv) {
  std::int64_t memory_bytes = 0, cpu_seconds = 0;
  std::string problem;
  const bool property_sets = argc == 5 && std::string_view(argv[4]) == "property-sets";
  if ((argc != 4 && !property_sets) || !impinge::io::parse_integer(argv[2], memory_bytes, problem) ||
      memory_bytes <= 0 || !impinge::io::parse_integer(argv[3], cpu_seconds, problem) || cpu_seconds <= 0) {
    std::fputs("usage: impinge-import FILE MEMORY_BYTES CPU_SECONDS [property-sets]\n", stderr);
    return 2;
  }
  if (impinge::importer::is_ifc(argv[1]))
    return impinge::importer::run_ifc(argv[1], property_sets, memory_bytes, cpu_seconds);
  return impinge::importer::run(argv[1], memory_bytes, cpu_seconds);
}
