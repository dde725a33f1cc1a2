// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pipeline/device_part.hpp"
#include "schedule/split.hpp"
#include "schedule/two_ended.hpp"

namespace impinge {

/// What the CPU's threads and the device share in a hybrid query.
struct SharedWork {
  SharedWork(std::vector<DevicePiece> all, const std::vector<double>& weights) : pieces(std::move(all)), row(weights) {}
  const std::vector<DevicePiece> pieces;
  schedule::TwoEnded row;           ///< the device takes from the front, the CPU from the back
  std::atomic<double> cpu_done{0};  ///< in weight
  const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
};

/// The device's side of a query: takes portions of the shared work for as long as that ends it sooner.
class DeviceDriver {
 public:
  /// `device` may be null: it is opened when it is needed. `mix`: counts of what the query has done so far, by which
  /// both sides' speeds are compared.
  DeviceDriver(const Query& query, const broad::ObjectPairs& pairs, SharedWork& work,
               std::shared_ptr<gpu::ReadyDevice> device, const Statistics& mix)
      : query_(query), pairs_(pairs), work_(work), device_(std::move(device)), mix_(mix) {}

  /// Whether a query of backend "auto" should be a hybrid one: it is large, and there is a device that is hardware.
  static bool may_help(const Query& query, const broad::ObjectPairs& pairs);
  /// One took so long on the CPU alone.
  static void count_without_help(double seconds);

  /// Sets so much of all work aside for the device, before others take from it. `is_all`: and no more; else the device
  /// takes what it sees fit after that, and must be open.
  void reserve(double share, bool is_all) {
    reserved_ = work_.row.take_front(share * work_.row.total()), is_all_ = is_all;
  }

  /// Returns when the device's part is done. Whatever goes wrong is in `complaint`.
  void drive(const DevicePart::Sink& sink);

  [[nodiscard]] std::span<const DevicePiece> done() const { return {work_.pieces.data(), taken_}; }
  /// Of those, what the device could not take.
  [[nodiscard]] const std::vector<DevicePiece>& left() const { return left_; }
  /// Why all of it is left undone, as a sentence without its full stop; empty: it is not.
  [[nodiscard]] const std::string& complaint() const { return complaint_; }
  /// As it may be spoken of.
  [[nodiscard]] std::string device_name() const;
  [[nodiscard]] const Statistics& statistics() const { return statistics_; }
  /// Whether the device has got meshes that it did not have.
  [[nodiscard]] bool has_brought_meshes() const { return part_ && part_->has_brought_meshes(); }
  /// What the device's part should have taken by the cost function, with the constants of now.
  [[nodiscard]] double predict_seconds() const;

 private:
  bool open();
  void drive_by_cost(const DevicePart::Sink& sink);
  void run(const schedule::TwoEnded::Range& range, const DevicePart::Sink& sink);
  [[nodiscard]] bool is_over() const;

  const Query& query_;
  const broad::ObjectPairs& pairs_;
  SharedWork& work_;
  std::shared_ptr<gpu::ReadyDevice> device_;
  std::optional<DevicePart> part_;
  const Statistics& mix_;
  std::optional<schedule::TwoEnded::Range> reserved_;
  bool is_all_ = false;
  std::size_t taken_ = 0;
  unsigned portions_ = 0;
  std::vector<DevicePiece> left_;
  std::string complaint_;
  Statistics statistics_;
};

}  // namespace impinge
