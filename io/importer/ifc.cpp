// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/ifc.hpp"

#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "io/text.hpp"

namespace impinge::importer {
namespace {

constexpr const char* kScript = "import-ifc.cjs";

/// The script beside this program, or else where ./dev builds it: this is build/PRESET/bin then.
std::filesystem::path find_script() {
  std::error_code ignored;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", ignored).parent_path();
  const bool beside = std::filesystem::exists(folder / kScript, ignored);
  return beside ? folder / kScript : folder.parent_path().parent_path() / "ifc" / kScript;
}

}  // namespace

bool is_ifc(const char* file) {
  const std::string ending = io::lower_case(std::filesystem::path(file).extension().string());
  return ending == ".ifc" || ending == ".ifczip";
}

std::string become_ifc_importer(const char* file, bool property_sets) {
  const std::string script = find_script().string();
  std::error_code ignored;
  if (!std::filesystem::exists(script, ignored)) {
    return io::sentence("the script that reads IFC, ", script,
                        ", is missing; './dev page' builds it, and an installed impinge has it beside impinge-import");
  }
  std::string node = "node", name = file, sets = "property-sets";
  std::array<char*, 5> arguments{node.data(), const_cast<char*>(script.c_str()), name.data(),
                                 property_sets ? sets.data() : nullptr, nullptr};
  execvp(node.c_str(), arguments.data());
  if (errno == ENOENT) {
    return "IFC is read by Node.js, and there is no program 'node' on the PATH; install Node.js 18 or newer (Debian's "
           "package nodejs)";
  }
  return io::sentence("IFC is read by Node.js, and the program 'node' does not run: ", std::strerror(errno));
}

}  // namespace impinge::importer
