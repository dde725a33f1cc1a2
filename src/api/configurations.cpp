// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <bit>
#include <mutex>
#include <optional>
#include <string>

#include "core/guarded.hpp"
#include "core/stopped.hpp"
#include "impinge/scene.hpp"
#include "pipeline/configuration_search.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/pipeline.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

/// Configurations that one thread takes at once: enough to be worth waking it.
constexpr std::size_t kAtOnce = 64;

Result<void> validate(const Scene::State& scene, const ConfigurationOptions& options) {
  if (auto valid = validate(Options{.threads = options.threads}); !valid) return valid;
  return scene.check_domain();
}

/// The error of the lowest configuration that has one.
class FirstError {
 public:
  void take(std::size_t configuration, const Error& error) {
    const std::lock_guard lock(mutex_);
    if (error_ && configuration > at_) return;
    at_ = configuration;
    error_ = Error{error.code, "configuration " + std::to_string(configuration) + ": " + error.message};
  }
  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

 private:
  std::mutex mutex_;
  std::size_t at_ = 0;
  std::optional<Error> error_;
};

/// Configurations of some objects of a scene.
struct Batch {
  Movers movers;
  std::span<const Pose> poses;
  CurrentPairs near_pairs;
  const ConfigurationOptions& options;

  static Result<Batch> of(const Scene::State& scene, std::span<const ObjectId> ids, std::span<const Pose> poses,
                          const ConfigurationOptions& options) {
    if (auto valid = validate(scene, options); !valid) return valid.error();
    auto movers = Movers::of(scene, ids);
    if (!movers) return movers.error();
    if (ids.empty() ? !poses.empty() : poses.size() % ids.size() != 0)
      return Error{Code::bad_option, "there are " + std::to_string(poses.size()) + " poses, which is no multiple of " +
                                         std::to_string(ids.size()) + " ids; give each configuration one of each"};
    return Batch{std::move(*movers), poses, {scene.near_pairs, options.threads}, options};
  }

  [[nodiscard]] std::size_t size() const { return movers.size() == 0 ? 0 : poses.size() / movers.size(); }

  /// Calls take(configuration, touch) for the configurations number_of(0), number_of(1), .. until it returns false.
  template <class Number, class Take>
  Result<void> run(const Number& number_of, const Take& take) const {
    FirstError failed;
    std::atomic<bool> ended = false;
    const auto run_some = [&](std::size_t chunk) {
      ConfigurationSearch search(movers, *near_pairs, options.stop);
      for (std::size_t i = chunk * kAtOnce; i < std::min((chunk + 1) * kAtOnce, size()); ++i) {
        if (ended || options.stop.stop_requested()) return;
        const std::size_t configuration = number_of(i);
        auto found = search.find(poses.subspan(configuration * movers.size(), movers.size()));
        if (!found)
          failed.take(configuration, found.error());
        else if (!take(configuration, *found))
          ended = true;
      }
    };
    const std::size_t chunks = (size() + kAtOnce - 1) / kAtOnce;
    run_each(chunks > 1 ? on_threads(options.threads) : ForEach(), chunks, run_some);
    if (options.stop.stop_requested()) return cancelled();
    if (!ended && failed.error()) return *failed.error();
    return {};
  }
};

/// Numbers 0 to n - 1 from coarse to fine: both ends, the middle, the middles of both halves and so on.
std::vector<std::size_t> coarse_to_fine(std::size_t n) {
  std::vector<std::size_t> order;
  order.reserve(n);
  if (n > 0) order.push_back(0);
  for (std::size_t step = std::bit_ceil(n); step > 0; step /= 2) {
    if (step == std::bit_ceil(n) && n > 1) order.push_back(n - 1);
    for (std::size_t i = step; i + 1 < n; i += 2 * step) order.push_back(i);
  }
  return order;
}

}  // namespace

Result<Configurations> Scene::collide_configurations(std::span<const ObjectId> ids, std::span<const Pose> poses,
                                                     const ConfigurationOptions& options) const {
  return guarded([&]() -> Result<Configurations> {
    const auto batch = Batch::of(*state_, ids, poses, options);
    if (!batch) return batch.error();
    Configurations found{std::vector<std::uint8_t>(batch->size())};
    if (options.witnesses) found.witnesses.resize(batch->size());
    const auto take = [&](std::size_t i, const std::optional<Touch>& touch) {
      found.touches[i] = touch ? 1 : 0;
      if (options.witnesses) found.witnesses[i] = touch;
      return true;
    };
    if (auto done = batch->run([](std::size_t i) { return i; }, take); !done) return done.error();
    return found;
  });
}

Result<std::optional<std::size_t>> Scene::first_touching(std::span<const ObjectId> ids, std::span<const Pose> poses,
                                                         const ConfigurationOptions& options) const {
  return guarded([&]() -> Result<std::optional<std::size_t>> {
    const auto batch = Batch::of(*state_, ids, poses, options);
    if (!batch) return batch.error();
    const std::vector<std::size_t> order = coarse_to_fine(batch->size());
    std::mutex mutex;
    std::optional<std::size_t> found;
    const auto take = [&](std::size_t i, const std::optional<Touch>& touch) {
      if (!touch) return true;
      const std::lock_guard lock(mutex);
      found = i;
      return false;
    };
    if (auto done = batch->run([&](std::size_t i) { return order[i]; }, take); !done) return done.error();
    return found;
  });
}

Result<bool> Scene::touches_any(const ConfigurationOptions& options) const {
  return guarded([&]() -> Result<bool> {
    const State& s = *state_;
    if (auto valid = validate(s, options); !valid) return valid.error();
    broad::ObjectPairs pairs;
    std::vector<std::uint64_t> scratch;
    (*CurrentPairs(s.near_pairs, options.threads))
        .find(s.view(), pairs, scratch, {.stop = options.stop, .for_each = on_threads(options.threads)});
    std::atomic<bool> found = false;
    const std::size_t chunks = (pairs.size() + kAtOnce - 1) / kAtOnce;
    run_each(chunks > 1 ? on_threads(options.threads) : ForEach(), chunks, [&](std::size_t chunk) {
      TouchSearch search(options.stop);
      const auto placed = [&](std::uint32_t i) { return PlacedMesh{s.objects[i], *s.meshes[i]}; };
      for (std::size_t i = chunk * kAtOnce; i < std::min((chunk + 1) * kAtOnce, pairs.size()) && !found; ++i)
        if (search.find(placed(pairs[i].a), placed(pairs[i].b))) found = true;
    });
    if (options.stop.stop_requested() && !found) return cancelled();
    return found.load();
  });
}

}  // namespace impinge
