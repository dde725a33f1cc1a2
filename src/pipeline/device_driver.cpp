// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/device_driver.hpp"

#include <algorithm>
#include <new>
#include <thread>

#include "core/float_environment.hpp"
#include "pipeline/calibration.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

using Clock = std::chrono::steady_clock;

/// Parts of the portion that the cost function predicts. The first prediction rests on constants measured on another
/// scene, so half of it is taken; later ones rest on this query.
constexpr double kFirstPortion = 0.5, kNextPortion = 0.8;
/// Time between checks of the CPU's progress.
constexpr std::chrono::microseconds kPause{50};

/// Opening a device takes a program longer than most queries, and is worth it only for a program that has long ones or
/// many: it begins when so many seconds of the CPU's have gone into work that could have been shared.
constexpr double kPatientSeconds = 0.05;
std::atomic<double> seconds_without{0};

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

void DeviceDriver::drive(const DevicePart::Sink& sink) {
  const FloatEnvironment nearest;
  try {
    if (reserved_) {
      taken_ = reserved_->end;  // also where the device cannot be opened
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

// The CPU begins at once; the device joins when the CPU has done enough for its speed to be known, and when what is
// then left would take it longer than the constant time of a portion on the device.
void DeviceDriver::drive_by_cost(const DevicePart::Sink& sink) {
  if (gpu::Devices::of_process().look_up(query_.options.device).is_software) return;
  while (!device_ && seconds_without + seconds_since(work_.start) < kPatientSeconds && !is_over())
    std::this_thread::sleep_for(kPause);
  if (!device_) seconds_without.fetch_add(seconds_since(work_.start));
  if (is_over() || !open()) return;
  const schedule::DeviceConstants constants = calibrated_device(part_->device());
  const double threads = schedule::concurrency(query_.options.threads);
  const double mix_cpu = schedule::predict_seconds(mix_, calibrated_constants("simd")) / threads;
  const double mix_device = schedule::predict_device_seconds(mix_, constants);
  const std::size_t to_bring = part_->triangles_to_bring(work_.pieces);
  const double upload = static_cast<double>(to_bring) * constants.mesh_triangle;
  schedule::Speeds speeds{.question = constants.question + upload};
  double device_done = 0, device_seconds = 0;
  for (double portion = kFirstPortion; !is_over();) {
    const double elapsed = seconds_since(work_.start), cpu_done = work_.cpu_done;
    if (cpu_done == 0 || elapsed < constants.question) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    speeds.cpu = cpu_done / elapsed;
    speeds.device = device_done > 0 ? device_done / device_seconds : speeds.cpu * mix_cpu / mix_device;
    const double wanted = portion * schedule::device_portion(work_.row.left(), speeds);
    const auto range = work_.row.take_front(wanted);
    if (range.empty()) break;
    const Clock::time_point start = Clock::now();
    run(range, sink);
    device_done += range.weight, device_seconds += std::max(seconds_since(start) - speeds.question, 1e-9);
    speeds.question = constants.question, portion = kNextPortion;
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
