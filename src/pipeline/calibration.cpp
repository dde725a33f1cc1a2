// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/calibration.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "broad/near_pairs.hpp"
#include "impinge/collide.hpp"
#include "impinge/devices.hpp"
#include "impinge/scene.hpp"
#include "paper/sweep_and_prune.hpp"
#include "pipeline/device_part.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/options.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/stage_clock.hpp"
#include "scene/scene_view.hpp"

namespace impinge {
namespace {

/// A surface of rows of vertices with two triangles between each four. `is_closed`: the last vertex of a row is beside
/// its first. Its coordinates have few digits, as those of most models: how long exact arithmetic takes depends on
/// them. Its triangles are in no order that would help memory, as those of a scan.
template <class Place>
Mesh surface(std::uint32_t rows, std::uint32_t columns, bool is_closed, const TreeConfig& tree, const Place& place) {
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles, shuffled;
  for (std::uint32_t i = 0; i < rows; ++i) {
    for (std::uint32_t j = 0; j < columns; ++j) {
      const Point p = place(i, j);
      for (const double x : {p.x, p.y, p.z}) xyz.push_back(0x1p-12 * std::round(0x1p12 * x));
      if (i + 1 == rows || (j + 1 == columns && !is_closed)) continue;
      const std::uint32_t a = i * columns + j, b = i * columns + (j + 1) % columns, c = a + columns, d = b + columns;
      triangles.insert(triangles.end(), {a, c, b, b, c, d});
    }
  }
  constexpr std::size_t kStride = 7919;  // a prime that no number of triangles here has as a factor
  for (std::size_t i = 0, n = triangles.size() / 3; i < n; ++i)
    for (std::size_t k = 0; k < 3; ++k) shuffled.push_back(triangles[3 * (i * kStride % n) + k]);
  return Mesh::create(std::span<const double>(xyz), shuffled, tree).value();
}

/// With bumps, so that neither the boxes nor the contacts are of one size.
Mesh bumpy_sphere(std::uint32_t rings, const TreeConfig& tree = {}) {
  const std::uint32_t sides = rings * 3 / 2;
  return surface(rings + 1, sides, true, tree, [&](std::uint32_t i, std::uint32_t j) {
    const double theta = 3.141592653589793 * i / rings, phi = 6.283185307179586 * j / sides;
    const double r = 1 + 0.05 * std::sin(7 * theta) * std::cos(5 * phi);
    return Point{r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
  });
}

/// A level square of 2 x 2, parted so often in either direction.
Mesh plate(std::uint32_t parts) {
  return surface(parts + 1, parts + 1, false, {}, [&](std::uint32_t i, std::uint32_t j) {
    return Point{2.0 * i / parts, 2.0 * j / parts, 0};
  });
}

/// Others at work on the machine only ever add to a time: the quickest of these runs is the truest.
constexpr int kRounds = 5;

/// The least that each stage took in runs that do the same.
void keep_quickest(Statistics& kept, const Statistics& run) {
  if (kept.total_seconds == 0) return static_cast<void>(kept = run);
  for (double Statistics::*const stage : {&Statistics::hierarchy_seconds, &Statistics::partition_seconds,
                                          &Statistics::narrow_seconds, &Statistics::exact_seconds})
    kept.*stage = std::min(kept.*stage, run.*stage);
}

/// Seconds; the quickest of all rounds.
template <class Work>
double quickest(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    StageClock clock;
    double seconds = 0;
    work(clock);
    clock.charge(seconds);
    least = std::min(least, seconds);
  }
  return least;
}

/// Where an object of a cloud stands, in which each of a radius of 1 meets some others; moved on a little with each
/// step.
constexpr int kCloudSize = 512;
Pose cloud_pose(int i, int step) {
  constexpr double kEdge = 12, kStep = 0.05;
  const auto coordinate = [&](double ratio, int period) {  // a low-discrepancy sequence
    return kEdge * std::fmod(ratio * i, 1) + (i % period == 0 ? kStep : -kStep) * step;
  };
  return {.t = {coordinate(0.8191725, 2), coordinate(0.6710436, 3), coordinate(0.5497005, 2)}};
}

std::vector<scene::PlacedObject> cloud(const Mesh& mesh, int step) {
  std::vector<scene::PlacedObject> placed;
  for (int i = 0; i < kCloudSize; ++i)
    placed.push_back(scene::place(mesh.state().data, cloud_pose(i, step), static_cast<std::uint32_t>(i)));
  return placed;
}

void calibrate_broad_phase(bool is_papers_way, const Mesh& mesh, schedule::CostConstants& constants) {
  const std::vector<scene::PlacedObject> resting = cloud(mesh, 0), moved = cloud(mesh, 1);
  const scene::SceneView view{moved, nullptr};
  broad::ObjectPairs pairs;
  if (!is_papers_way) {
    broad::NearPairs near_pairs;
    broad::NearPairs::Scratch scratch;
    near_pairs.reserve(moved.size());
    for (std::uint32_t i = 0; i < moved.size(); ++i) near_pairs.place(i, moved[i]);
    near_pairs.update();
    constants.sphere_test = quickest([&](StageClock&) { near_pairs.find(view, pairs, scratch); }) /
                            static_cast<double>(std::max<std::size_t>(near_pairs.candidates(), 1));
    return;
  }
  paper::SweepAndPrune borders;
  const auto& counts = borders.counts();
  borders.update({resting, nullptr});
  const double rest = quickest([&](StageClock&) { borders.update({resting, nullptr}); });
  constants.bounds_update = rest / static_cast<double>(counts.updated);
  const double move = quickest([&](StageClock& clock) {
    borders.update({resting, nullptr});
    clock = StageClock();
    borders.update(view);
  });
  constants.border_move = std::max(move - rest, 0.0) / static_cast<double>(counts.moves);
  const std::uint64_t before = counts.sphere_tests;
  const double search = quickest([&](StageClock&) { borders.find(view, pairs); });
  constants.sphere_test = search * kRounds / static_cast<double>(counts.sphere_tests - before);
}

schedule::CostConstants calibrate(std::string_view backend, const TreeConfig& tree) {
  const Options one_thread{.threads = 1, .backend = backend, .statistics = true};
  const auto ask = [&](const Mesh& a, const Mesh& b, const Point& t) {
    return collide(a, {}, b, {.t = {t.x, t.y, t.z}}, one_thread).value().statistics;
  };
  const auto ask_twice = [&](std::uint32_t rings, const Point& t, schedule::CostRuns& runs) {
    const Mesh mesh = bumpy_sphere(rings, tree);  // in each round anew, so that its tree is made anew
    keep_quickest(runs.building, ask(mesh, mesh, t));
    keep_quickest(runs.repeated, ask(mesh, mesh, t));
  };
  // Surfaces that share all vertices, and surfaces that lie on each other and share none: about as many exact calls,
  // which take 27 and 72 ns with "simd".
  const Mesh small = bumpy_sphere(32), coarse = plate(57), fine = plate(69);
  Scene tiny;  // objects so small that their pairs are done with at once
  for (int i = 0; i < kCloudSize; ++i) static_cast<void>(tiny.add(bumpy_sphere(2), cloud_pose(i, 0)));
  schedule::CostRuns light, deep;
  Statistics same, level, at_once;
  for (int round = 0; round < kRounds; ++round) {
    ask_twice(128, {1.97, 0.1, 0.1}, light);
    ask_twice(64, {1.2, 0.3, 0.1}, deep);
    keep_quickest(same, ask(small, small, {}));
    keep_quickest(level, ask(coarse, fine, {0.1, 0.1, 0}));
    keep_quickest(at_once, tiny.collide(one_thread).value().statistics);
  }
  same.exact_calls += level.exact_calls, same.exact_seconds += level.exact_seconds;
  schedule::CostConstants constants = schedule::constants_from(light, deep, same);
  const double begin = at_once.hierarchy_seconds - static_cast<double>(at_once.box_tests) * constants.box_test;
  constants.object_pair = std::max(begin, 0.0) / static_cast<double>(std::max<std::uint64_t>(at_once.object_pairs, 1));
  calibrate_broad_phase(is_papers_way(one_thread), small, constants);
  return constants;
}

/// Questions to a device as a query would put them: the sphere against itself, a number of times.
class Asking {
 public:
  explicit Asking(std::shared_ptr<gpu::ReadyDevice> device) : device_(std::move(device)), mesh_(bumpy_sphere(96)) {}

  struct Answer {
    double seconds;
    Statistics counts;
  };
  /// The quickest of three runs.
  Answer ask(const Point& t, std::size_t times) {
    const Pose poses[2] = {{}, {.t = {t.x, t.y, t.z}}};
    std::vector<scene::PlacedObject> placed;
    for (const Pose& pose : poses) placed.push_back(scene::place(mesh_.state().data, pose, 0));
    const MeshState* const meshes[2] = {&mesh_.state(), &mesh_.state()};
    const broad::ObjectPairs pairs(times, {0, 1});
    const Options options{.threads = 1, .statistics = true};
    std::vector<DevicePiece> pieces;
    for (std::uint32_t i = 0; i < times; ++i) pieces.push_back({i});
    const Query query{{placed, nullptr}, meshes, nullptr, &pairs, true, options};
    DevicePart part(query, pairs, device_);
    Answer best{std::numeric_limits<double>::infinity(), {}};
    for (int round = 0; round < 3; ++round) {
      Statistics counts;
      part.run(
          pieces, [](std::uint32_t, auto) {}, counts);
      if (counts.device_seconds < best.seconds) best = {counts.device_seconds, counts};
    }
    return best;
  }
  /// Repeats the question within a query until the constant cost counts for little, but for no more than some 0.02 s.
  Answer ask_long(const Point& t, double question) {
    Answer answer = ask(t, 1);
    for (std::size_t times = 4; times <= 256 && answer.seconds < std::min(8 * question, 0.02); times *= 4)
      answer = ask(t, times);
    return answer;
  }
  [[nodiscard]] double triangles() const { return static_cast<double>(mesh_.triangle_count()); }

 private:
  std::shared_ptr<gpu::ReadyDevice> device_;
  Mesh mesh_;
};

// The device's C_0 is the time of a question whose answer is clear at the roots; C_v and C_p follow from two questions,
// one of which is nearly all walk and one rich in contacts. Where noise makes one of them negative, both sides'
// constants are taken to be in one proportion.
schedule::DeviceConstants calibrate(const std::shared_ptr<gpu::ReadyDevice>& device) {
  Asking asking(device);
  StageClock clock;
  double first = 0;
  asking.ask({10, 0, 0}, 1);  // uploads the mesh, and makes the programs ready
  clock.charge(first);
  schedule::DeviceConstants constants;
  constants.question = asking.ask({10, 0, 0}, 1).seconds;
  constants.mesh_triangle = std::max(0.0, first - 4 * constants.question) / asking.triangles();
  const Asking::Answer light = asking.ask_long({1.97, 0.1, 0.1}, constants.question);
  const Asking::Answer deep = asking.ask_long({0.3, 0.1, 0.05}, constants.question);
  const auto v = [](const Asking::Answer& a) { return static_cast<double>(a.counts.box_tests); };
  const auto p = [](const Asking::Answer& a) { return static_cast<double>(a.counts.element_tests); };
  const double light_seconds = std::max(light.seconds - constants.question, 1e-9);
  const double deep_seconds = std::max(deep.seconds - constants.question, 1e-9);
  const double determinant = v(light) * p(deep) - v(deep) * p(light);
  constants.box_test = (light_seconds * p(deep) - deep_seconds * p(light)) / determinant;
  constants.element_test = (v(light) * deep_seconds - v(deep) * light_seconds) / determinant;
  if (!(constants.box_test > 0) || !(constants.element_test > 0)) {
    const schedule::CostConstants cpu = calibrated_constants("simd");
    const double scale = deep_seconds / schedule::predict_seconds(deep.counts, cpu);
    constants.box_test = scale * cpu.box_test, constants.element_test = scale * cpu.element_test;
    constants.leaf_pair = scale * cpu.leaf_pair;
  }
  return constants;
}

std::array<double*, 5> fields(schedule::DeviceConstants& c) {
  return {&c.question, &c.box_test, &c.element_test, &c.leaf_pair, &c.mesh_triangle};
}

std::array<double*, schedule::kCostTerms.size()> fields(schedule::CostConstants& c) {
  std::array<double*, schedule::kCostTerms.size()> fields;
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i] = &(c.*schedule::kCostTerms[i].constant);
  return fields;
}

/// The constants of what has been measured, by name. As text each is a line: the kind, the constants, the name.
template <class Constants>
class Known {
 public:
  explicit Known(std::string_view kind) : kind_(std::string(kind) + " ") {}

  template <class Measure>
  Constants get(const std::string& name, const Measure& measure) {
    const std::lock_guard lock(mutex_);
    const auto found = constants_.find(name);
    return found != constants_.end() ? found->second : constants_[name] = measure();
  }
  /// Does not wait while others are measured.
  std::optional<Constants> find(const std::string& name) {
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock) return std::nullopt;
    const auto found = constants_.find(name);
    return found != constants_.end() ? std::optional(found->second) : std::nullopt;
  }
  template <class Change>
  void change(const std::string& name, const Change& change) {
    const std::lock_guard lock(mutex_);
    change(constants_[name]);
  }

  std::string lines() {
    const std::lock_guard lock(mutex_);
    std::string text;
    for (auto& [name, constants] : constants_) {
      text += kind_;
      for (const double* constant : fields(constants)) {
        char number[32];
        std::snprintf(number, sizeof number, "%.6e ", *constant);
        text += number;
      }
      text += name + "\n";
    }
    return text;
  }
  /// A line of another kind, or one that is not understood, is passed over.
  void read(std::string_view line) {
    if (!line.starts_with(kind_)) return;
    Constants constants;
    const char *at = line.data() + kind_.size(), *const end = line.data() + line.size();
    for (double* const constant : fields(constants)) {
      const auto [rest, error] = std::from_chars(at, end, *constant);
      if (error != std::errc() || !(*constant >= 0 && *constant < 1) || rest == end) return;
      at = rest + 1;  // a blank
    }
    if (!(constants.box_test > 0) || !(constants.element_test > 0)) return;
    const std::lock_guard lock(mutex_);
    constants_[std::string(at, end)] = constants;
  }

 private:
  std::string kind_;
  std::mutex mutex_;
  std::map<std::string, Constants, std::less<>> constants_;
};
Known<schedule::DeviceConstants>& known_devices() {
  static Known<schedule::DeviceConstants> known("device");
  return known;
}
Known<schedule::CostConstants>& known_processors() {
  static Known<schedule::CostConstants> known("cpu");
  return known;
}

std::string name_of(const gpu::ReadyDevice& device) {
  const gpu::PhysicalDevice& physical = device.device.physical();
  return std::string(physical.properties.deviceName) + ", " + physical.driver;
}

/// The processor's name, as it gives it itself.
std::string processor() {
#if defined(__x86_64__)
  std::array<std::array<unsigned, 4>, 3> words;
  for (unsigned i = 0; i < words.size(); ++i) {
    auto& [a, b, c, d] = words[i];
    if (__get_cpuid(0x80000002u + i, &a, &b, &c, &d) == 0) return "unknown";
  }
  const char* const text = reinterpret_cast<const char*>(words.data());
  return std::string(text, strnlen(text, sizeof words));
#else
  return "unknown";
#endif
}

/// What a backend's constants on this processor are kept under.
std::string processor_name(const std::string& way, std::uint32_t leaf_size) {
  static const std::string name = processor();
  return way + (leaf_size == 0 ? "" : " in leaves of " + std::to_string(leaf_size)) + ", " + name;
}

/// The first line of a calibration's text. Texts of other versions begin otherwise and are ignored.
constexpr std::string_view kCalibrationTitle = "impinge calibration 2";

}  // namespace

schedule::DeviceConstants calibrated_device(const std::shared_ptr<gpu::ReadyDevice>& device) {
  return known_devices().get(name_of(*device), [&] { return calibrate(device); });
}

std::optional<KnownConstants> known_constants(const std::shared_ptr<gpu::ReadyDevice>& device) {
  const auto of_device = known_devices().find(name_of(*device));
  const auto of_cpu = known_processors().find(processor_name("simd", 0));
  if (!of_device || !of_cpu) return std::nullopt;
  return KnownConstants{*of_device, *of_cpu};
}

void refine_calibration(const std::shared_ptr<gpu::ReadyDevice>& device, double predicted_seconds, double seconds) {
  if (!(predicted_seconds > 0) || !(seconds > 0)) return;
  const double factor = std::pow(std::clamp(seconds / predicted_seconds, 0.1, 10.0), 0.25);
  known_devices().change(name_of(*device), [&](schedule::DeviceConstants& constants) {
    constants.box_test *= factor, constants.element_test *= factor, constants.leaf_pair *= factor;
  });
}

std::string calibration() {
  const std::string lines = known_processors().lines() + known_devices().lines();
  return lines.empty() ? lines : std::string(kCalibrationTitle) + "\n" + lines;
}

void set_calibration(std::string_view text) {
  const auto next_line = [&] {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
  };
  if (next_line() != kCalibrationTitle) return;
  while (!text.empty()) {
    const std::string_view line = next_line();
    known_processors().read(line);
    known_devices().read(line);
  }
}

schedule::CostConstants calibrated_constants(std::string_view backend, std::uint32_t leaf_size) {
  if (backend == "raster") {  // on the device that is taken where none is named, which the name of a CPU does not tell
    static const schedule::CostConstants raster = calibrate(backend, {});
    return raster;
  }
  const std::string way = backend == "paper" || backend == "scalar" ? "paper" : "simd";
  return known_processors().get(processor_name(way, leaf_size),
                                [&] { return calibrate(way, {.leaf_size = leaf_size}); });
}

}  // namespace impinge
