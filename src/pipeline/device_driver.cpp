// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/device_driver.hpp"

#include <algorithm>
#include <cassert>
#include <new>
#include <string_view>
#include <thread>

#include "core/float_environment.hpp"
#include "pipeline/calibration.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

using Clock = std::chrono::steady_clock;

/// Time between checks of the CPU's progress.
constexpr std::chrono::microseconds kPause{50};

/// Opening a device takes a program longer than most queries, and is worth it only for a program that has long ones or
/// many: it begins when so many seconds of the CPU's have gone into work that could have been shared.
constexpr double kPatientSeconds = 0.05;
std::atomic<double> seconds_without{0};

// Where nobody asked for a device, large queries are those of so many triangles, counted with each pair of objects.
// After so many seconds of queries of any size, or before one of so many more, a program looks once whether there is a
// device for them, which takes some hundredths of a second.
constexpr std::size_t kLarge = 1 << 20, kHuge = 1 << 24;
constexpr double kSecondsBeforeLook = 0.5;
std::atomic<double> seconds_of_auto{0};
enum class Help : std::uint8_t { unknown, none, some };
std::atomic<Help> help_for_auto{Help::unknown};

/// Whether there is such a device, unless it is found to fail, and it is no program on the CPU.
bool is_worth_asking(std::string_view device) {
  const gpu::Devices::Choice choice = gpu::Devices::of_process().look_up(device);
  return choice.complaint.empty() && !choice.is_software;
}

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

void DeviceDriver::drive(const DevicePart::Sink& sink) {
  const FloatEnvironment nearest;
  try {
    if (reserved_) taken_ = reserved_->end;  // also where the device cannot be opened
    if (is_all_) {
      if (open()) run(*reserved_, sink);
    } else {
      drive_by_cost(sink);
    }
  } catch (const gpu::Failure& failure) {
    complaint_ = device_name() + " failed (" + failure.what() + ")";
  } catch (const std::bad_alloc&) {
    complaint_ = "memory ran out beside " + device_name();
  }
}

bool DeviceDriver::may_help(const Query& query, const broad::ObjectPairs& pairs) {
  if (help_for_auto == Help::none) return false;
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < pairs.size() && triangles < kHuge; ++i)
    for (const std::uint32_t object : {pairs[i].a, pairs[i].b})
      if (const auto* const mesh = query.view.objects[object].mesh) triangles += mesh->triangles.size();
  if (triangles < kLarge) return false;
  if (help_for_auto == Help::unknown) {
    if (triangles < kHuge && seconds_of_auto < kSecondsBeforeLook) return false;
    help_for_auto = is_worth_asking(query.options.device) ? Help::some : Help::none;
  }
  return help_for_auto == Help::some;
}

void DeviceDriver::count_without_help(double seconds) { seconds_of_auto.fetch_add(seconds); }

std::string DeviceDriver::device_name() const {
  if (!device_) return "the device";
  return std::string("the device '") + device_->device.physical().properties.deviceName + "'";
}

bool DeviceDriver::open() {
  if (!device_) {
    gpu::Devices::Choice choice = gpu::Devices::of_process().choose(query_.options.device);
    device_ = std::move(choice.opened), complaint_ = std::move(choice.complaint);
  }
  if (device_) part_.emplace(query_, pairs_, device_);
  return device_ != nullptr;
}

// The CPU begins at once; the device joins, unless it has a portion from the beginning, when the CPU has done enough
// for its speed to be known, and when what is then left would take it longer than the constant time of a portion on the
// device.
void DeviceDriver::drive_by_cost(const DevicePart::Sink& sink) {
  assert(!reserved_ || device_);
  if (!reserved_ && !is_worth_asking(query_.options.device)) return;
  while (!device_ && seconds_without + seconds_since(work_.start) < kPatientSeconds && !is_over())
    std::this_thread::sleep_for(kPause);
  if (!device_) seconds_without.fetch_add(seconds_since(work_.start));
  if (!reserved_ && is_over()) return;
  if (!open()) {
    if (query_.options.backend == "auto") help_for_auto = Help::none, complaint_.clear();
    return;
  }
  const schedule::DeviceConstants constants = calibrated_device(part_->device());
  const double threads = schedule::concurrency(query_.options.threads);
  const double mix_cpu = schedule::predict_seconds(mix_, calibrated_constants("simd")) / threads;
  const double mix_device = schedule::predict_device_seconds(mix_, constants);
  const std::size_t to_bring = part_->triangles_to_bring(work_.pieces);
  schedule::DevicePortions portions(mix_cpu / mix_device, constants.question,
                                    static_cast<double>(to_bring) * constants.mesh_triangle);
  const auto run_portion = [&](const schedule::TwoEnded::Range& range) {
    const Clock::time_point start = Clock::now();
    run(range, sink);
    portions.done(range.weight, seconds_since(start));
  };
  if (reserved_ && !reserved_->empty()) run_portion(*reserved_);
  while (!is_over()) {
    const double elapsed = seconds_since(work_.start), cpu_done = work_.cpu_done;
    if (portions.is_early(cpu_done, elapsed)) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    const auto range = work_.row.take_front(portions.next(work_.row.left(), cpu_done, elapsed));
    if (range.empty()) break;
    run_portion(range);
  }
  if (to_bring == 0) refine_calibration(device_, predict_seconds(), statistics_.device_seconds);
}

double DeviceDriver::predict_seconds() const {
  if (portions_ == 0) return 0;
  try {
    const schedule::DeviceConstants constants = calibrated_device(device_);
    return portions_ * constants.question + schedule::predict_device_seconds(statistics_, constants) +
           static_cast<double>(statistics_.exact_calls) * calibrated_constants("simd").exact_call;
  } catch (const gpu::Failure&) {  // lost just now
    return 0;
  }
}

bool DeviceDriver::is_over() const { return work_.row.left() == 0 || query_.options.stop.stop_requested(); }

void DeviceDriver::run(const schedule::TwoEnded::Range& range, const DevicePart::Sink& sink) {
  if (range.empty()) return;
  taken_ = range.end, ++portions_;
  const auto undone =
      part_->run(std::span(work_.pieces).subspan(range.begin, range.end - range.begin), sink, statistics_);
  left_.insert(left_.end(), undone.begin(), undone.end());
}

}  // namespace impinge
