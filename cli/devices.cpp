// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "impinge/devices.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "commands.hpp"
#include "report/sink.hpp"
#include "report/text.hpp"

namespace impinge::cli {
namespace {

std::string_view type_name(DeviceInfo::Type type) {
  switch (type) {
    case DeviceInfo::Type::discrete:
      return "discrete GPU";
    case DeviceInfo::Type::integrated:
      return "integrated GPU";
    case DeviceInfo::Type::virtual_gpu:
      return "virtual GPU";
    case DeviceInfo::Type::cpu:
      return "software on the CPU";
    case DeviceInfo::Type::other:
      break;
  }
  return "unknown";
}

std::string bytes_text(std::uint64_t bytes) {
  const double gib = static_cast<double>(bytes) / (1 << 30);
  return gib >= 1 ? fmt::format("{:.1f} GiB", gib) : fmt::format("{:.0f} MiB", gib * 1024);
}

std::string yes_or_no(bool yes) { return yes ? "yes" : "no"; }

void print_device(Sink& out, std::size_t number, const DeviceInfo& device) {
  const auto line = [&](const char* what, const std::string& value) {
    out.write(fmt::format("   {:<16}{}\n", what, value));
  };
  out.write(fmt::format("{}  {}\n", number, printable(device.name)));
  line("kind", std::string(type_name(device.type)));
  line("driver", printable(device.driver));
  line("memory", bytes_text(device.memory_bytes));
  line("largest buffer", bytes_text(device.largest_buffer_bytes));
  line("subgroup", fmt::format("{} invocations", device.subgroup_size));
  line("doubles, int64", yes_or_no(device.has_doubles) + ", " + yes_or_no(device.has_int64) + " (neither is needed)");
  line("arithmetic", device.is_certified ? "tried out: every bound holds, the device is used" : "");
  if (!device.is_certified) out.write("   left out: " + printable(device.complaint) + "\n");
}

}  // namespace

Result<bool> list_devices() {
  Sink out(STDOUT_FILENO, "standard output");
  const Result<std::vector<DeviceInfo>> found = devices();
  if (!found) return found.error();
  for (std::size_t i = 0; i < found->size(); ++i) {
    if (i > 0) out.write("\n");
    print_device(out, i, (*found)[i]);
  }
  out.write(
      "\nimpinge check --backend gpu (or hybrid) uses the first that is not left out; --device N or --device NAME, or "
      "the "
      "variable\nIMPINGE_DEVICE, chooses another. Answers are the same on every one of them, and without any.\n");
  if (auto flushed = out.flush(); !flushed) return flushed.error();
  return std::any_of(found->begin(), found->end(), [](const DeviceInfo& device) { return device.is_certified; });
}

}  // namespace impinge::cli
