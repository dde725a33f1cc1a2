// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <bit>
#include <iterator>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "broad/may_touch.hpp"
#include "core/guarded.hpp"
#include "core/stopped.hpp"
#include "impinge/scene.hpp"
#include "pipeline/configuration_search.hpp"
#include "pipeline/domain_error.hpp"
#include "pipeline/on_threads.hpp"
#include "pipeline/options.hpp"
#include "pipeline/workspace_state.hpp"
#include "scene/validate_pose.hpp"
#include "schedule/parallel.hpp"

namespace impinge {
namespace {

Result<void> validate(const Scene::State& scene, int threads) {
  if (threads < 0) return validate(Options{.threads = threads});
  return scene.check_domain();
}

/// A thread is woken for so many items, and takes so many at once or more.
struct Shares {
  std::size_t worth_waking = 32, at_once = 8;  // of a microsecond or more
};

/// Calls body(worker, i) for i = 0 to n - 1 on up to so many threads until it returns false or throws. Each thread at
/// work has a worker of its own, which `make` makes.
template <class Make, class Body>
void share(std::size_t n, int threads, const Make& make, const Body& body, const Shares& shares = {}) {
  constexpr std::size_t kTurns = 16, kMostAtOnce = 64;
  // A thread takes so few at once that none is long at work when the others are done, but neighbours in memory are
  // mostly written by one thread.
  const auto most = static_cast<std::size_t>(schedule::concurrency(threads));
  const std::size_t at_once = std::clamp(n / (kTurns * most), shares.at_once, kMostAtOnce);
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> ended = false;
  run_each(on_threads(threads), std::min(most, (n + shares.worth_waking - 1) / shares.worth_waking), [&](std::size_t) {
    if (next >= n) return;
    try {
      auto worker = make();
      for (std::size_t i; (i = next.fetch_add(at_once)) < n;)
        for (const std::size_t end = std::min(i + at_once, n); i < end; ++i) {
          if (ended) return;
          if (!body(worker, i)) ended = true;
        }
    } catch (...) {
      ended = true;
      throw;
    }
  });
}

/// Configurations of some objects of a scene.
struct Batch {
  Movers movers;
  std::span<const Pose> poses;
  CurrentPairs near_pairs;
  int threads;
  std::stop_token stop;

  template <class AnyOptions>
  static Result<Batch> of(const Scene::State& scene, std::span<const ObjectId> ids, std::span<const Pose> poses,
                          const AnyOptions& options) {
    if (auto valid = validate(scene, options.threads); !valid) return valid.error();
    auto movers = Movers::of(scene, ids);
    if (!movers) return movers.error();
    if (ids.empty() ? !poses.empty() : poses.size() % ids.size() != 0)
      return Error{Code::bad_option, "there are " + std::to_string(poses.size()) + " poses, which is no multiple of " +
                                         std::to_string(ids.size()) + " ids; give each configuration one of each"};
    return Batch{std::move(*movers), poses, {scene.near_pairs, options.threads}, options.threads, options.stop};
  }

  [[nodiscard]] TouchingConfigurations touching() const { return {movers, *near_pairs, stop}; }
  [[nodiscard]] std::size_t size() const { return movers.size() == 0 ? 0 : poses.size() / movers.size(); }

  /// Calls take(configuration, found) for the configurations number_of(0), number_of(1), .. until it returns false.
  template <class MakeSearch, class Number, class Take>
  Result<void> run(const MakeSearch& make_search, const Number& number_of, const Take& take,
                   const Shares& shares = {}) const {
    std::mutex mutex;
    std::optional<std::pair<std::size_t, Error>> first_error;  // of the lowest configuration that has one
    bool is_over = false;
    const auto body = [&](auto& search, std::size_t i) {
      if (stop.stop_requested()) return false;
      const std::size_t configuration = number_of(i);
      const auto found = search.find(poses.subspan(configuration * movers.size(), movers.size()));
      if (found && take(configuration, *found)) return true;
      const std::lock_guard lock(mutex);
      if (found)
        is_over = true;
      else if (!first_error || configuration < first_error->first)
        first_error = {configuration, found.error()};
      return !found;
    };
    share(size(), threads, make_search, body, shares);
    if (stop.stop_requested()) return cancelled();
    if (is_over || !first_error) return {};
    const auto& [configuration, error] = *first_error;
    return Error{error.code, "configuration " + std::to_string(configuration) + ": " + error.message};
  }
};

std::size_t in_order(std::size_t i) { return i; }

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

void offer(const Scene::State& s, std::uint32_t a, std::uint32_t b, NearestObjectsSearch& search) {
  if (s.are_tested(a, b)) search.offer(a, s.objects[a], b, s.objects[b]);
}

/// Where an object is along x.
struct Extent {
  double low, high;
  std::uint32_t object, group;
};

/// The group of more than half of them, if there is one; else any.
std::uint32_t largest_group(const std::vector<Extent>& extents) {
  std::uint32_t group = 0;
  std::size_t votes = 0;  // Boyer and Moore, "MJRTY", 1981
  for (const Extent& one : extents) {
    if (votes == 0) group = one.group;
    one.group == group ? ++votes : --votes;
  }
  return group;
}

/// Offers all pairs but those that are certainly farther apart along x than the nearest so far. Most of a scene may
/// stand still in one group: no two of those are looked at.
void offer_all(const Scene::State& s, const std::stop_token& stop, NearestObjectsSearch& search) {
  std::vector<Extent> others;
  others.reserve(s.objects.size());
  for (std::uint32_t i = 0; i < s.objects.size(); ++i)
    if (const scene::PlacedObject& one = s.objects[i]; one.mesh != nullptr)
      others.push_back({one.box.lo.x, one.box.hi.x, i, one.group});
  std::sort(others.begin(), others.end(), [](const Extent& p, const Extent& q) { return p.low < q.low; });
  std::vector<Extent> standing;
  if (const std::uint32_t group = largest_group(others); group != 0) {
    const auto stands = [&](const Extent& one) { return one.group == group; };
    std::copy_if(others.begin(), others.end(), std::back_inserter(standing), stands);
    std::erase_if(others, stands);
  }
  const auto offer_behind = [&](const Extent& one, auto first, auto end) {
    for (; first != end && first->low - one.high <= search.nearest_most(); ++first)
      offer(s, one.object, first->object, search);
  };
  auto behind = others.begin();
  for (const Extent& one : standing) {
    if (stop.stop_requested()) return;
    while (behind != others.end() && behind->low < one.low) ++behind;
    offer_behind(one, behind, others.end());
  }
  behind = standing.begin();
  for (auto one = others.begin(); one != others.end() && !stop.stop_requested(); ++one) {
    while (behind != standing.end() && behind->low <= one->low) ++behind;
    offer_behind(*one, behind, standing.end());
    offer_behind(*one, one + 1, others.end());
  }
}

/// The nearest of the pairs that `offer_some` offers.
template <class OfferSome>
Result<std::vector<ObjectDistance>> nearest_objects(const Scene::State& s, std::size_t count,
                                                    const MeasureOptions& options, const OfferSome& offer_some) {
  if (auto valid = validate(s, options.threads); !valid) return valid.error();
  if (auto valid = validate_limits(options); !valid) return valid.error();
  std::vector<ObjectDistance> nearest;
  if (count == 0) return nearest;
  NearestObjectsSearch search(count, options.stop_above, options.enough_below);
  offer_some(search);
  QueryMemory memory(nullptr);
  for (const NearestObjects& found : search.find([&](std::uint32_t i) { return s.placed(i); },
                                                 {on_threads(options.threads), options.stop, &memory.nearest()}))
    nearest.push_back(object_distance(found));
  if (options.stop.stop_requested()) return cancelled();
  return nearest;
}

/// Whether any of these pairs touches; `placed` has the objects by their numbers.
template <class Placed>
Result<bool> any_touches(broad::ObjectPairs& pairs, const Placed& placed, const ConfigurationOptions& options,
                         Workspace::State& memory) {
  constexpr std::size_t kFew = 64;
  const auto square = [&](const broad::ObjectPair& pair) {
    const Vec3 d = placed(pair.a).object.sphere.center - placed(pair.b).object.sphere.center;
    return dot(d, d);
  };
  const auto touch = [&](TouchSearch& search, std::size_t i) {
    return search.find(placed(pairs[i].a), placed(pairs[i].b)).has_value();
  };
  std::atomic<bool> found = false;
  if (pairs.size() <= kFew)  // the nearest first: they are the likeliest to touch
    std::sort(pairs.begin(), pairs.end(),
              [&](const broad::ObjectPair& p, const broad::ObjectPair& q) { return square(p) < square(q); });
  if (options.threads == 1 || pairs.size() <= kFew) {
    memory.touch.restart(options.stop);
    for (std::size_t i = 0; i < pairs.size() && !found && !options.stop.stop_requested(); ++i)
      found = touch(memory.touch, i);
  } else {
    share(
        pairs.size(), options.threads, [&] { return TouchSearch(options.stop); },
        [&](TouchSearch& search, std::size_t i) {
          if (touch(search, i)) found = true;
          return !found && !options.stop.stop_requested();
        });
  }
  if (options.stop.stop_requested() && !found) return cancelled();
  return found.load();
}

Result<std::optional<ObjectDistance>> first_of(const Result<std::vector<ObjectDistance>>& nearest) {
  if (!nearest) return nearest.error();
  return nearest->empty() ? std::nullopt : std::optional(nearest->front());
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
    if (auto done = batch->run([&] { return batch->touching(); }, in_order, take); !done) return done.error();
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
    if (auto done = batch->run([&] { return batch->touching(); }, [&](std::size_t i) { return order[i]; }, take); !done)
      return done.error();
    return found;
  });
}

Result<bool> Scene::touches_any(const ConfigurationOptions& options, Workspace* workspace) const {
  return guarded([&]() -> Result<bool> {
    const State& s = *state_;
    if (auto valid = validate(s, options.threads); !valid) return valid.error();
    const QueryMemory memory(workspace);
    (*CurrentPairs(s.near_pairs, options.threads))
        .find(s.view(), memory->pairs, memory->near_pairs,
              {.stop = options.stop, .for_each = on_threads(options.threads)});
    return any_touches(
        memory->pairs, [&s](std::uint32_t object) { return s.placed(object); }, options, *memory);
  });
}

Result<bool> Scene::touches_with(const Mesh& mesh, const Pose& pose, const ConfigurationOptions& options,
                                 Workspace* workspace) const {
  return guarded([&]() -> Result<bool> {
    const State& s = *state_;
    if (auto valid = validate(s, options.threads); !valid) return valid.error();
    if (auto valid = scene::validate(pose); !valid) return valid.error();
    const scene::PlacedObject guest = scene::place(mesh.state().data, pose, 0);
    if (!guest.in_domain) return not_in_range("the mesh");
    if (guest.mesh == nullptr) return false;
    const QueryMemory memory(workspace);
    (*CurrentPairs(s.near_pairs, options.threads)).find_near(guest.box, memory->near_pairs.jumping);
    const auto guest_index = static_cast<std::uint32_t>(s.objects.size());
    memory->pairs.clear();
    for (const std::uint64_t found : memory->near_pairs.jumping.found) {
      const auto object = static_cast<std::uint32_t>(found);
      if (broad::bounds_meet(s.objects[object], guest)) memory->pairs.push_back({object, guest_index});
    }
    const auto placed = [&](std::uint32_t object) {
      return object == guest_index ? PlacedMesh{guest, mesh.state()} : s.placed(object);
    };
    return any_touches(memory->pairs, placed, options, *memory);
  });
}

Result<std::vector<std::optional<ObjectDistance>>> Scene::distance_configurations(std::span<const ObjectId> ids,
                                                                                  std::span<const Pose> poses,
                                                                                  const MeasureOptions& options) const {
  return guarded([&]() -> Result<std::vector<std::optional<ObjectDistance>>> {
    if (auto valid = validate_limits(options); !valid) return valid.error();
    const auto batch = Batch::of(*state_, ids, poses, options);
    if (!batch) return batch.error();
    std::vector<std::optional<ObjectDistance>> found(batch->size());
    const auto take = [&](std::size_t i, const std::optional<ObjectDistance>& one) { return found[i] = one, true; };
    const auto make_search = [&] { return DistantConfigurations(batch->movers, options); };
    constexpr Shares kOfMilliseconds{1, 1};
    if (auto done = batch->run(make_search, in_order, take, kOfMilliseconds); !done) return done.error();
    return found;
  });
}

Result<std::optional<ObjectDistance>> Scene::distance_with(ObjectId id, const MeasureOptions& options) const {
  return guarded([&]() -> Result<std::optional<ObjectDistance>> {
    if (auto known = state_->check(id); !known) return known.error();
    return first_of(nearest_objects(*state_, 1, options, [&](NearestObjectsSearch& search) {
      for (std::uint32_t i = 0; i < state_->objects.size(); ++i)
        if (i != id.index) offer(*state_, id.index, i, search);
    }));
  });
}

Result<std::optional<ObjectDistance>> Scene::distance(const MeasureOptions& options) const {
  return first_of(closest(1, options));
}

Result<std::vector<ObjectDistance>> Scene::closest(std::size_t count, const MeasureOptions& options) const {
  return guarded([&] {
    return nearest_objects(*state_, count, options,
                           [&](NearestObjectsSearch& search) { offer_all(*state_, options.stop, search); });
  });
}

}  // namespace impinge
