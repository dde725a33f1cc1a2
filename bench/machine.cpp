// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// The machine and the build that the other tables were made on.
#include <CGAL/version.h>
#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "bench/device.hpp"
#include "bench/ours.hpp"
#include "bench/support.hpp"
#include "impinge/version.hpp"

namespace impinge::bench {
namespace {

/// What follows `separator` on the first line of a file that starts with `key`.
std::string value_in(const char* file, const std::string& key, char separator) {
  std::ifstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(separator);
    if (line.rfind(key, 0) != 0 || at == std::string::npos) continue;
    std::string value = line.substr(at + 1);
    std::erase(value, '"');
    std::erase(value, ',');
    value.erase(0, value.find_first_not_of(" \t"));
    return value;
  }
  return "unknown";
}

}  // namespace

void bench_main(const Arguments& arguments) {
  utsname system{};
  if (uname(&system) != 0) fail("cannot ask for the system's name");
  std::string flags = IMPINGE_FLAGS;
  std::erase(flags, ',');
  std::string load;
  std::getline(std::ifstream("/proc/loadavg"), load);
  Table table({"what", "value"});
  table.add({"processor", value_in("/proc/cpuinfo", "model name", ':') + " (family " +
                              value_in("/proc/cpuinfo", "cpu family", ':') + " model " +
                              value_in("/proc/cpuinfo", "model\t", ':') + ")"});
  table.add({"cores", std::to_string(std::thread::hardware_concurrency())});
  table.add({"cache", value_in("/proc/cpuinfo", "cache size", ':')});
  table.add({"memory", value_in("/proc/meminfo", "MemTotal", ':')});
  const std::string release = system.release;
  table.add({"system",
             value_in("/etc/os-release", "PRETTY_NAME", '=') + " with kernel " + release.substr(0, release.find('-'))});
  table.add({"compiler", IMPINGE_COMPILER});
  table.add({"flags", flags});
  table.add({"impinge", IMPINGE_VERSION});
  table.add({"impinge backend", std::string(fast_backend())});
  table.add(
      {"FCL", std::string(IMPINGE_FCL_VERSION) + " as Debian compiled it; native: its headers by -O3 -march=native"});
  table.add(
      {"Embree", std::string(IMPINGE_EMBREE_VERSION) + " as Debian compiled it; the triangle test by -march=native"});
  table.add({"CGAL", std::string(CGAL_VERSION_STR) + " headers by -march=native"});
  std::string device = choose_device().line;
  std::erase(device, ',');
  table.add({"device", device});
  table.add({"load average at the start", load.substr(0, load.find(' '))});
  table.write(arguments.folder, "machine");
}

}  // namespace impinge::bench
