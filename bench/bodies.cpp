// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// 1,000 and 10,000 slowly moving bodies: a frame of impinge's `Scene` and of FCL's `DynamicAABBTreeCollisionManager`,
/// each for all pairs of triangles and for what a solver needs of them, manifolds and FCL's contacts.
#include "bench/contest.hpp"
#include "bench/crowd.hpp"
#include "bench/ours.hpp"
#include "bench/peers/fcl_crowd.hpp"
#include "impinge/manifolds.hpp"

namespace impinge::bench {
namespace {

/// A library's seconds, an entry a frame: placing the bodies, the broad phase, and the whole frame with both.
struct Frames {
  std::vector<double> place, broad, whole;
};

class OurCrowd {
 public:
  OurCrowd(const scenes::PlacedScene& scene, const Options& options) : options_(options) {
    const Mesh mesh = make_mesh(scene.meshes.front());
    for (const scenes::PlacedObject& object : scene.objects) ids_.push_back(must(scene_.add(mesh, object.pose)));
    must(scene_.update());
  }

  /// `with_manifolds`: the same frame, with the manifolds of its contacts.
  void step(const std::vector<Pose>& poses, Frames& frames, Frames* with_manifolds = nullptr) {
    const double place = seconds_of([&] {
      for (std::size_t i = 0; i < ids_.size(); ++i) must(scene_.set_pose(ids_[i], poses[i]));
    });
    const double update = seconds_of([&] { must(scene_.update()); });
    const double query = seconds_of([&] {
      workspace_.recycle(std::move(contacts));
      contacts = must(scene_.collide(options_, &workspace_));
    });
    frames.place.push_back(place);
    frames.broad.push_back(update + contacts.statistics.broad_seconds);
    frames.whole.push_back(place + update + query);
    if (with_manifolds == nullptr) return;
    const double made = seconds_of([&] { must(manifolds_.update(scene_, contacts)); });
    with_manifolds->place.push_back(place), with_manifolds->broad.push_back(frames.broad.back());
    with_manifolds->whole.push_back(frames.whole.back() + made);
  }

  Contacts contacts;

 private:
  Options options_;
  Workspace workspace_;
  Scene scene_;
  ContactManifolds manifolds_;
  std::vector<ObjectId> ids_;
};

/// From `before`, so that the manager has the same to repair when its broad phase alone, and what makes a point, a
/// normal and a depth of each pair too, are timed as in the whole frame.
void step(FclCrowd& fcl, const std::vector<Pose>& before, const std::vector<Pose>& poses, Frames& frames,
          Frames& with_points) {
  const double place = seconds_of([&] { fcl.move(poses); });
  const double pairs = seconds_of([&] { fcl.collide(); });
  const auto go_back = [&] {
    fcl.move(before);
    fcl.broad_phase();
    fcl.move(poses);
  };
  go_back();
  const double points = seconds_of([&] { fcl.collide(true); });
  go_back();
  const double broad = seconds_of([&] { fcl.broad_phase(); });
  for (Frames* some : {&frames, &with_points}) some->place.push_back(place), some->broad.push_back(broad);
  frames.whole.push_back(place + pairs), with_points.whole.push_back(place + points);
}

/// Frame by frame how many times impinge's seconds another library's are.
Spread ratio(const std::vector<double>& theirs, const std::vector<double>& ours) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < ours.size(); ++i) ratios.push_back(theirs[i] / ours[i]);
  return spread(std::move(ratios));
}

void measure(int bodies, std::size_t frames, Table& table) {
  const Crowd crowd(bodies);
  OurCrowd quick(crowd.scene(), timed()), plain(crowd.scene(), paper_way());
  FclCrowd fcl(crowd.scene());
  Frames of_quick, of_manifolds, of_plain, of_fcl, of_points, not_counted;
  std::uint64_t contacts = 0, candidates = 0;
  Disagreement wrong;
  for (std::size_t f = 0; f <= frames; ++f) {
    const bool counts = f > 0;  // trees are made in the first frame
    quick.step(crowd.frame(f), counts ? of_quick : not_counted, counts ? &of_manifolds : &not_counted);
    step(fcl, crowd.frame(f + Crowd::kFrames - 1), crowd.frame(f), counts ? of_fcl : not_counted,
         counts ? of_points : not_counted);
    plain.step(crowd.frame(f), counts ? of_plain : not_counted);
    if (quick.contacts.hash != plain.contacts.hash) fail("the paper's way and the fast one do not agree");
    if (!counts) continue;
    wrong += compare(flat(quick.contacts), fcl.contacts());
    contacts += quick.contacts.triangles.size();
    candidates += quick.contacts.statistics.object_pairs;
  }
  const auto mean = [&](std::uint64_t sum) { return digits(static_cast<double>(sum) / static_cast<double>(frames)); };
  const auto add = [&](const char* library, const Frames& times, const Disagreement& errors) {
    const Spread whole = ratio(times.whole, of_quick.whole), broad = ratio(times.broad, of_quick.broad);
    table.add({count(static_cast<std::uint64_t>(bodies)), library, count(frames), mean(candidates), mean(contacts),
               milliseconds(median(times.place)), milliseconds(median(times.broad)), milliseconds(median(times.whole)),
               digits(whole.median), digits(whole.low), digits(whole.high), digits(broad.median), count(errors.missed),
               count(errors.added)});
  };
  add("impinge", of_quick, {});
  add("impinge manifolds", of_manifolds, {});
  add("impinge paper", of_plain, {});
  add("FCL", of_fcl, wrong);
  add("FCL contacts", of_points, wrong);
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  Table table({"bodies", "library", "frames", "candidate_pairs", "exact_pairs", "place_ms", "broad_ms", "frame_ms",
               "ratio", "ratio_low", "ratio_high", "broad_ratio", "missed", "added"});
  measure(1000, arguments.quick ? 4 : 31, table);
  measure(10'000, arguments.quick ? 2 : 15, table);
  table.write(arguments.folder, "bodies");
}

}  // namespace impinge::bench
