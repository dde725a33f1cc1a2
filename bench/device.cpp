// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "bench/device.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "bench/support.hpp"
#include "impinge/devices.hpp"

namespace impinge::bench {
namespace {

std::string in_lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

bool is_named(const DeviceInfo& device, std::size_t place, const std::string& wanted) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), number);
  if (error == std::errc() && end == wanted.data() + wanted.size()) return number == place;
  return in_lower_case(device.name).find(in_lower_case(wanted)) != std::string::npos;
}

}  // namespace

TargetDevice choose_device(std::string wanted, bool allows_software) {
  if (const char* const environment = std::getenv("IMPINGE_DEVICE"); wanted.empty() && environment != nullptr)
    wanted = environment;
  if (wanted == "none") return {"", "none (as asked for)"};
  const auto list = devices();
  if (!list) return {"", "none (" + list.error().message + ")"};
  std::string complaints;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const DeviceInfo& device = (*list)[i];
    if (!wanted.empty() && !is_named(device, i, wanted)) continue;
    if (!device.is_certified) {
      complaints += (complaints.empty() ? "" : "; ") + device.name + ": " + device.complaint;
      continue;
    }
    const std::string name = device.name + ", driver " + device.driver + ", " +
                             digits(1e-9 * static_cast<double>(device.memory_bytes)) + " GB";
    if (device.type != DeviceInfo::Type::cpu) return {std::to_string(i), name};
    if (allows_software) return {std::to_string(i), name + " (**software driver, not a GPU**)"};
    return {"", name + " (a software driver: not measured)"};
  }
  if (!wanted.empty() && complaints.empty()) fail("there is no device '" + wanted + "'");
  return {"", "none that may be used (" + complaints + ")"};
}

}  // namespace impinge::bench
