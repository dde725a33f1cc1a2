// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "report/motion/mover.hpp"
#include "report/motion/passages.hpp"
#include "report/review.hpp"
#include "report/scene.hpp"
#include "report/units.hpp"

namespace impinge::report {
namespace {

using Objects = std::array<std::uint32_t, 2>;
using Frame = std::map<Objects, Clash>;  ///< the pairs that clash at one time

/// Where a passage is judged, as parts of it. Towards its ends they lie ever closer: a part that goes through a hollow
/// one penetrates its walls there alone.
constexpr auto kJudgedParts = [] {
  constexpr int kFirst = 3, kLast = 12;
  std::array<double, 3 + 2 * (kLast - kFirst + 1)> parts{0.5, 0.25, 0.75};
  double part = 0.125;
  for (std::size_t i = 3; i < parts.size(); i += 2, part /= 2) parts[i] = part, parts[i + 1] = 1 - part;
  return parts;
}();

/// A scene of parts that move, and what is known of them from one time to the next.
class MovingScene {
 public:
  /// The scene's objects are these parts, in their order.
  MovingScene(Scene scene, std::vector<Posed> posed) : scene_(std::move(scene)), posed_(std::move(posed)) {}

  /// Tells the scene of those that are elsewhere, or in another shape, than before. Errors: as `Scene::set_pose`.
  Result<void> move_to(std::vector<Posed> posed) {
    for (std::uint32_t i = 0; i < posed.size(); ++i) {
      const ObjectId id = scene_.id(i).value();
      const Posed &now = posed[i], &before = posed_[i];
      if (&now.mesh.state() != &before.mesh.state()) {
        if (auto set = scene_.set_mesh(id, now.mesh, now.pose); !set) return set;
      } else if (now.pose.R != before.pose.R || now.pose.t != before.pose.t) {
        if (auto set = scene_.set_pose(id, now.pose); !set) return set;
      }
    }
    posed_ = std::move(posed);
    return {};
  }
  [[nodiscard]] const std::vector<Posed>& posed() const { return posed_; }
  /// As `find_clashes`, which looks only at what moved since the last call.
  Result<Clashes> clashes(const ClashOptions& options) { return find_clashes(scene_, options, &memory_); }

 private:
  Scene scene_;
  std::vector<Posed> posed_;
  ClashMemory memory_;
};

/// The pairs that `TimelineOptions::ignored` and products leave out, as a scene does.
class LeftOutPairs {
 public:
  static Result<LeftOutPairs> create(const Assembly& assembly, const TimelineOptions& options) {
    LeftOutPairs pairs;
    pairs.products_ = products_of(assembly);
    for (const auto& words : options.ignored) {
      std::array<std::vector<std::uint32_t>, 2> named;
      for (const std::size_t side : {0, 1}) {
        auto objects = objects_named(assembly, side == 0 ? words.first : words.second);
        if (!objects) return objects.error();
        named[side] = *std::move(objects);
      }
      pairs.ignored_.push_back(std::move(named));
    }
    return pairs;
  }
  [[nodiscard]] bool contains(const Objects& objects) const {
    const auto& [a, b] = objects;
    if (products_[a] != 0 && products_[a] == products_[b]) return true;
    const auto is_in = [](const std::vector<std::uint32_t>& all, std::uint32_t one) {
      return std::ranges::find(all, one) != all.end();
    };
    return std::ranges::any_of(ignored_, [&](const auto& named) {
      return (is_in(named[0], a) && is_in(named[1], b)) || (is_in(named[0], b) && is_in(named[1], a));
    });
  }

 private:
  std::vector<std::uint32_t> products_;
  std::vector<std::array<std::vector<std::uint32_t>, 2>> ignored_;
};

class Search {
 public:
  /// `assembly` has the parts of the model, and is changed to have them where they stand.
  Search(const Mover& mover, Assembly& assembly, const TimelineOptions& options)
      : mover_(mover), assembly_(assembly), options_(options) {}

  Result<Timeline> run() {
    for (std::uint32_t frame = 0; frame <= options_.frames; ++frame) {
      const double time = mover_.seconds() * frame / options_.frames;
      const std::vector<Posed> before = frame == 0 ? std::vector<Posed>() : scene_->posed();
      const std::set<Objects> touched = std::exchange(touching_, {});
      Result<Frame> found = look(time, frame == 0);
      if (!found) return found.error();
      if (frame > 0)
        if (auto passed = take_passages(before, time, *found, touched); !passed) return passed.error();
      if (auto taken = take(time, *found); !taken) return taken.error();
      timeline_.times.push_back(time);
      if (options_.progress != nullptr) options_.progress->done.fetch_add(1);
    }
    for (const auto& [objects, span] : open_) timeline_.spans.push_back(span);
    std::sort(timeline_.spans.begin(), timeline_.spans.end(),
              [](const ClashSpan& a, const ClashSpan& b) { return key_of(a) < key_of(b); });
    return std::move(timeline_);
  }

 private:
  static std::tuple<Objects, double> key_of(const ClashSpan& span) {
    return {span.objects, span.from ? span.from->lo : -1.0};
  }

  [[nodiscard]] ClashOptions clash_options(bool verdicts_alone = false) const {
    ClashOptions options;
    options.tolerance = value_of(options_.tolerance);
    options.depth_precision = verdicts_alone ? std::numeric_limits<double>::infinity() : options_.depth_precision;
    options.threads = options_.threads;
    options.stop = options_.stop;
    return options;
  }

  /// The pairs that clash at a time. Pairs that stand still to each other are looked at once, at the first frame, and
  /// are what they were.
  Result<Frame> look(double time, bool is_first) {
    if (auto moved = move_to(time); !moved) return moved.error();
    ClashOptions options = clash_options();
    const auto stand_still = [this](std::uint32_t a, std::uint32_t b) {
      return mover_.bodies()[a] == mover_.bodies()[b];
    };
    if (!is_first) {
      // The automatic tolerance is that of each pair; the reach only has to be as large as a tolerance that was given.
      options.clearance = options_.tolerance.value_or(0).value;
      options.terms = [&](std::uint32_t a, std::uint32_t b, std::vector<ClashTerms>& terms) {
        if (!stand_still(a, b)) terms.push_back({.tolerance = value_of(options_.tolerance)});
      };
    }
    Result<Clashes> clashes = scene_->clashes(options);
    if (!clashes) return clashes.error();
    Frame frame;
    for (Clash& clash : clashes->pairs) {
      if (clash.verdict == Verdict::touching) touching_.insert(clash.objects);
      if (names(options_.fail_on, clash.verdict)) frame.emplace(clash.objects, std::move(clash));
    }
    if (is_first) {
      std::copy_if(frame.begin(), frame.end(), std::inserter(still_, still_.end()),
                   [&](const auto& pair) { return stand_still(pair.first[0], pair.first[1]); });
    } else {
      frame.insert(still_.begin(), still_.end());
    }
    return frame;
  }

  Result<void> move_to(double time) {
    Result<std::vector<Posed>> posed = mover_.at(time);
    if (!posed) return posed.error();
    if (scene_) return scene_->move_to(*std::move(posed));
    for (std::size_t i = 0; i < posed->size(); ++i)
      assembly_.objects[i].mesh = (*posed)[i].mesh, assembly_.objects[i].pose = (*posed)[i].pose;
    Result<Scene> scene = scene_of(assembly_, options_, products_of(assembly_));
    if (!scene) return scene.error();
    scene_.emplace(*std::move(scene), *std::move(posed));
    auto left_out = LeftOutPairs::create(assembly_, options_);
    if (!left_out) return left_out.error();
    left_out_ = *std::move(left_out);
    return {};
  }

  /// Ends the spans of pairs that clash no more, goes on with others, begins new ones.
  Result<void> take(double time, const Frame& frame) {
    const bool is_first = timeline_.times.empty();
    for (auto place = open_.begin(); place != open_.end();) {
      if (frame.contains(place->first)) {
        ++place;
        continue;
      }
      const auto moment = moment_between(place->first, timeline_.times.back(), time, true);
      if (!moment) return moment.error();
      place->second.to = *moment;
      timeline_.spans.push_back(place->second);
      place = open_.erase(place);
    }
    for (const auto& [objects, clash] : frame) {
      const auto [place, is_new] = open_.try_emplace(objects);
      ClashSpan& span = place->second;
      if (is_new) span.objects = objects;
      note(span, clash, time);
      if (!is_new || is_first) continue;
      if (auto begun = begin(span, timeline_.times.back(), time); !begun) return begun;
    }
    return {};
  }

  /// Spans of pairs that clash neither at the last time nor at this one, but between. When the parts are near is told
  /// by screws, and whether they clash then by where the animation has them. Those that touch at both times do so by
  /// design, as a shaft in its bearing, and are left out.
  Result<void> take_passages(const std::vector<Posed>& before, double time, const Frame& frame,
                             const std::set<Objects>& touched) {
    PassageOptions options{.tolerance = options_.tolerance.value_or(0).value,
                           .measure = {.threads = options_.threads, .stop = options_.stop}};
    options.skip = [&](const Objects& objects) {
      return frame.contains(objects) || open_.contains(objects) ||
             (touched.contains(objects) && touching_.contains(objects)) || left_out_->contains(objects);
    };
    const auto passages = passages_between(before, scene_->posed(), mover_.bodies(), options);
    if (!passages) return passages.error();
    for (const Passage& passage : *passages)
      if (auto taken = take_passage(passage, timeline_.times.back(), time); !taken) return taken.error();
    return {};
  }

  Result<void> take_passage(const Passage& passage, double last, double time) {
    const auto& [objects, from, to] = passage;
    // Near all the time, as with play in a bearing: the parts of the time that find thin walls would cost much.
    const bool is_always_near = from <= 0 && to >= 1;
    std::optional<MovingScene> pair;
    for (const double part : std::span(kJudgedParts).first(is_always_near ? 3 : kJudgedParts.size())) {
      const double within = last + (time - last) * (from + (to - from) * part);
      Result<std::optional<Clash>> clash = clash_at(objects, within, pair, clash_options());
      if (!clash) return clash.error();
      if (!*clash || !names(options_.fail_on, (*clash)->verdict)) continue;
      ClashSpan span;
      span.objects = objects;
      if (auto begun = begin(span, last, within); !begun) return begun;
      const auto end = moment_between(objects, within, time, true);
      if (!end) return end.error();
      span.to = *end;
      note(span, **clash, within);
      timeline_.spans.push_back(span);
      return {};
    }
    return {};
  }

  /// Keeps the worst of a span, of equals the first.
  static void note(ClashSpan& span, const Clash& clash, double time) {
    if (badness(clash.verdict, clash.fails_below, clash.overlap_depth) >=
        badness(span.worst, span.fails_below, span.overlap_depth))
      return;
    span.worst = clash.verdict, span.inner = clash.inner, span.worst_at = time, span.note = clash.note;
    span.fails_below = clash.fails_below, span.overlap_depth = clash.overlap_depth;
  }

  /// Fills in when and where the clash of a span begins, of whose parts it is known that they clash at `hi` and not at
  /// `lo`.
  Result<void> begin(ClashSpan& span, double lo, double hi) {
    const auto moment = moment_between(span.objects, lo, hi, false);
    if (!moment) return moment.error();
    span.from = *moment;
    ClashOptions options = clash_options(true);
    options.regions = true;
    std::optional<MovingScene> pair;
    const auto clash = clash_at(span.objects, moment->hi, pair, options);
    if (!clash) return clash.error();
    if (*clash && !(*clash)->regions.empty()) span.point = (*clash)->regions.front().centroid;
    return {};
  }

  /// Halves the time between `lo` and `hi`, of which the parts clash at the first or at the last.
  Result<Moment> moment_between(const Objects& objects, double lo, double hi, bool clashes_first) {
    constexpr int kHalvings = 20;
    Moment moment{lo, hi};
    std::optional<MovingScene> pair;
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = moment.lo + (moment.hi - moment.lo) / 2;
      if (!(middle > moment.lo && middle < moment.hi)) break;
      const auto clash = clash_at(objects, middle, pair, clash_options(true));
      if (!clash) return clash.error();
      const Verdict verdict = *clash ? (*clash)->verdict : Verdict::apart;
      (names(options_.fail_on, verdict) == clashes_first ? moment.lo : moment.hi) = middle;
    }
    return moment;
  }

  /// Nothing where they are apart. `pair` is the two alone, where they were looked at last.
  Result<std::optional<Clash>> clash_at(const Objects& objects, double time, std::optional<MovingScene>& pair,
                                        const ClashOptions& options) {
    Result<std::vector<Posed>> both = mover_.at(time, objects);
    if (!both) return both.error();
    if (pair) {
      if (auto moved = pair->move_to(*std::move(both)); !moved) return moved.error();
    } else {
      Scene scene;
      for (const Posed& part : *both)
        if (auto added = scene.add(part.mesh, part.pose); !added) return added.error();
      pair.emplace(std::move(scene), *std::move(both));
    }
    Result<Clashes> clashes = pair->clashes(options);
    if (!clashes) return clashes.error();
    if (clashes->pairs.empty()) return std::optional<Clash>();
    return std::optional(std::move(clashes->pairs[0]));
  }

  const Mover& mover_;
  Assembly& assembly_;
  const TimelineOptions& options_;
  Timeline timeline_;
  std::optional<MovingScene> scene_;
  std::optional<LeftOutPairs> left_out_;
  std::map<Objects, ClashSpan> open_;
  Frame still_;
  std::set<Objects> touching_;  ///< at the last time
};

}  // namespace

Result<Timeline> find_timeline(const io::Model& model, const io::Animation& animation, const TimelineOptions& options) {
  if (options.progress != nullptr) options.progress->done = 0, options.progress->total = options.frames + 1;
  TimelineOptions of_model = options;
  if (of_model.tolerance)
    if (auto brought = bring_to_unit(*of_model.tolerance, model.unit_in_metres, "the tolerance"); !brought)
      return brought.error();
  const Mover mover(model, animation);
  Assembly assembly = assemble({options.files.empty() ? "" : options.files.front()}, {model});
  return Search(mover, assembly, of_model).run();
}

}  // namespace impinge::report
