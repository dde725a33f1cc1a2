// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/ready_device.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>

#include "gpu/probe.hpp"

namespace impinge::gpu {
namespace {

std::string in_lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

/// The last that was given back; null: there is none.
template <class T>
std::unique_ptr<T> take_from(std::vector<std::unique_ptr<T>>& kept, std::mutex& mutex) {
  const std::lock_guard lock(mutex);
  if (kept.empty()) return nullptr;
  std::unique_ptr<T> last = std::move(kept.back());
  kept.pop_back();
  return last;
}

/// What `sweep_doubles.comp` reads and writes.
constexpr std::uint32_t kBuffersWithDoubles = 13;

}  // namespace

ReadyDevice::ReadyDevice(const PhysicalDevice& physical, const Limits& limits)
    : device(physical, limits),
      with_doubles(physical.has_doubles && !limits.no_doubles &&
                   physical.properties.limits.maxPerStageDescriptorStorageBuffers >= kBuffersWithDoubles &&
                   probe_doubles(device).empty()),
      kernels(device, with_doubles),
      meshes(device, with_doubles) {}

template <class Make>
auto ReadyDevice::with_room(const Make& make) {
  while (true) {
    try {
      return make();
    } catch (const Failure& failure) {
      if (failure.result() != VK_ERROR_OUT_OF_DEVICE_MEMORY || !meshes.drop_one()) throw;
    }
  }
}

std::unique_ptr<DeviceWalk> ReadyDevice::take_walk() {
  if (auto kept = take_from(walks_, mutex_)) return kept;
  return with_room([&] { return std::make_unique<DeviceWalk>(device, kernels); });
}

void ReadyDevice::give_back(std::unique_ptr<DeviceWalk> walk) {
  const std::lock_guard lock(mutex_);
  walks_.push_back(std::move(walk));
}

const Drawing& ReadyDevice::raster_drawing() {
  const std::lock_guard lock(drawing_mutex_);
  if (drawing_) return *drawing_;
  if (drawing_complaint_.empty()) {
    if (!device.physical().draws) drawing_complaint_ = "it computes, but does not draw";
    if (!device.physical().fragments_store) drawing_complaint_ = "its fragments write to no buffers";
  }
  if (drawing_complaint_.empty()) {
    auto drawing = paper::make_raster_drawing(device);
    drawing_complaint_ = with_room([&] { return paper::probe_fragments(*drawing); });
    if (drawing_complaint_.empty()) drawing_ = std::move(drawing);
  }
  if (!drawing_) throw Failure(drawing_complaint_);
  return *drawing_;
}

std::unique_ptr<paper::RasterBackend> ReadyDevice::take_raster() {
  const Drawing& drawing = raster_drawing();
  if (auto kept = take_from(rasters_, mutex_)) return kept;
  return with_room([&] { return std::make_unique<paper::RasterBackend>(drawing); });
}

void ReadyDevice::give_back(std::unique_ptr<paper::RasterBackend> raster) {
  const std::lock_guard lock(mutex_);
  rasters_.push_back(std::move(raster));
}

Devices& Devices::of_process() {
  // Never destroyed: at the program's end drivers may be gone before it.
  static auto& devices = *new Devices;
  return devices;
}

void Devices::look() {
  if (instance_) return;
  instance_ = std::make_unique<Instance>(validate_);
  for (const PhysicalDevice& physical : instance_->devices()) slots_.push_back({.known = {physical, ""}});
}

void Devices::try_out(Slot& slot) {
  if (slot.opened && slot.opened->device.is_lost()) {
    slot.known.complaint = "it was lost while it worked";
    slot.opened = nullptr;
  }
  if (std::exchange(slot.is_tried, true)) return;
  try {
    auto opened = std::make_shared<ReadyDevice>(slot.known.physical, limits_);
    slot.known.complaint = probe(opened->device);
    slot.known.physical.has_doubles = opened->with_doubles;
    if (slot.known.complaint.empty()) slot.opened = std::move(opened);
  } catch (const Failure& failure) {
    slot.known.complaint = failure.what();
  }
}

std::vector<FoundDevice> Devices::list() {
  const std::lock_guard lock(mutex_);
  look();
  std::vector<FoundDevice> known;
  for (Slot& slot : slots_) {
    try_out(slot);
    known.push_back(slot.known);
  }
  return known;
}

std::string Devices::complaint() {
  const std::lock_guard lock(mutex_);
  look();
  return instance_->complaint();
}

Devices::Choice Devices::choice_of(const Slot& slot) const {
  const VkPhysicalDeviceProperties& properties = slot.known.physical.properties;
  const bool is_left_out = slot.is_tried && !slot.opened;
  return {.opened = slot.opened,
          .complaint = is_left_out ? std::string(properties.deviceName) + ": " + slot.known.complaint : "",
          .is_software = properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU && !limits_.trusts_software};
}

Devices::Choice Devices::choose(std::string_view name) { return choose(name, true); }
Devices::Choice Devices::look_up(std::string_view name) { return choose(name, false); }

Devices::Choice Devices::choose(std::string_view name, bool may_open) {
  const std::lock_guard lock(mutex_);
  const char* const environment = std::getenv("IMPINGE_DEVICE");
  const bool is_from_environment = name.empty() && environment != nullptr;
  if (is_from_environment) name = environment;
  if (is_from_environment && name == "none") return {nullptr, "IMPINGE_DEVICE is 'none'"};
  look();
  if (slots_.empty()) return {nullptr, instance_->complaint()};
  if (name.empty()) {
    for (Slot& slot : slots_) {
      if (may_open || slot.is_tried) try_out(slot);
      if (slot.opened || !slot.is_tried) return choice_of(slot);
    }
    return choice_of(slots_[0]);
  }
  // Digits alone are a number of the list, never part of a name: names have versions and widths in them.
  const bool is_number = name.find_first_not_of("0123456789") == std::string_view::npos;
  std::size_t number = slots_.size();
  std::from_chars(name.data(), name.data() + name.size(), number);
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    Slot& slot = slots_[i];
    const std::string own = in_lower_case(slot.known.physical.properties.deviceName);
    if (is_number ? i != number : own.find(in_lower_case(name)) == std::string::npos) continue;
    if (may_open || slot.is_tried) try_out(slot);
    return choice_of(slot);
  }
  std::string sentence = "there is no device '" + std::string(name) + "'";
  if (is_from_environment) sentence += ", which IMPINGE_DEVICE names";
  for (std::size_t i = 0; i < slots_.size(); ++i)
    sentence += (i == 0 ? "; there is " : ", ") + std::to_string(i) + " '" +
                slots_[i].known.physical.properties.deviceName + "'";
  return {nullptr, sentence, true};
}

void Devices::reopen(const Limits& limits, bool validate) {
  const std::lock_guard lock(mutex_);
  for (Slot& slot : slots_) slot = {.known = {slot.known.physical, ""}};
  if (validate != validate_) slots_.clear(), instance_ = nullptr;  // not each time: a driver may not load for ever
  limits_ = limits, validate_ = validate;
}

}  // namespace impinge::gpu
