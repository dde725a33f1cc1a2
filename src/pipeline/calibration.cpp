// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "impinge/collide.hpp"
#include "impinge/devices.hpp"
#include "pipeline/device_part.hpp"
#include "pipeline/mesh_state.hpp"
#include "pipeline/stage_clock.hpp"
#include "scene/scene_view.hpp"

namespace impinge {
namespace {

/// A closed surface with bumps, so that neither the boxes nor the contacts are of one size. Its coordinates have few
/// digits, as those of most models: how long exact arithmetic takes depends on them.
Mesh bumpy_sphere(std::uint32_t rings) {
  const std::uint32_t sides = rings * 3 / 2;
  std::vector<double> xyz;
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t i = 0; i <= rings; ++i) {
    for (std::uint32_t j = 0; j < sides; ++j) {
      const double theta = 3.141592653589793 * i / rings, phi = 6.283185307179586 * j / sides;
      const double r = 1 + 0.05 * std::sin(7 * theta) * std::cos(5 * phi);
      for (const double x :
           {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)})
        xyz.push_back(0x1p-12 * std::round(0x1p12 * x));
      if (i == rings) continue;
      const std::uint32_t right = (j + 1) % sides;
      const std::uint32_t a = i * sides + j, b = i * sides + right, c = a + sides, d = b + sides;
      triangles.insert(triangles.end(), {a, c, b, b, c, d});
    }
  }
  return Mesh::create(std::span<const double>(xyz), triangles).value();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

schedule::CostConstants calibrate(std::string_view backend) {
  constexpr int kRounds = 5;
  std::vector<double> box_test, element_test, node, leaf_pair, exact_call;
  Pose pose;
  pose.t = {1.2, 0.3, 0.1};
  const Options one_thread{.threads = 1, .backend = backend};
  for (int round = 0; round < kRounds; ++round) {
    const Mesh mesh = bumpy_sphere(32);  // anew, so that its tree is made anew
    const Statistics building = collide(mesh, {}, mesh, pose, one_thread).value().statistics;
    const Statistics repeated = collide(mesh, {}, mesh, pose, one_thread).value().statistics;
    const Statistics touching = collide(mesh, {}, mesh, {}, one_thread).value().statistics;
    const schedule::CostConstants constants = schedule::constants_from(building, repeated, touching);
    box_test.push_back(constants.box_test);
    element_test.push_back(constants.element_test);
    node.push_back(constants.node);
    leaf_pair.push_back(constants.leaf_pair);
    exact_call.push_back(constants.exact_call);
  }
  return {median(box_test), median(element_test), median(node), median(leaf_pair), median(exact_call)};
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
    const Options options{.threads = 1};
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
    const schedule::CostConstants& cpu = calibrated_constants("simd");
    const double scale = deep_seconds / schedule::predict_seconds(deep.counts, cpu);
    constants.box_test = scale * cpu.box_test, constants.element_test = scale * cpu.element_test;
    constants.leaf_pair = scale * cpu.leaf_pair;
  }
  return constants;
}

struct KnownDevices {
  std::mutex mutex;
  std::map<std::string, schedule::DeviceConstants, std::less<>> constants;  ///< by name and driver
};
KnownDevices& known_devices() {
  static KnownDevices known;
  return known;
}

std::string name_of(const gpu::ReadyDevice& device) {
  const gpu::PhysicalDevice& physical = device.device.physical();
  return std::string(physical.properties.deviceName) + ", " + physical.driver;
}

/// The first line of a calibration's text. Texts of other versions begin otherwise and are ignored.
constexpr std::string_view kCalibrationTitle = "impinge calibration 1";

}  // namespace

schedule::DeviceConstants calibrated_device(const std::shared_ptr<gpu::ReadyDevice>& device) {
  KnownDevices& known = known_devices();
  const std::string name = name_of(*device);
  const std::lock_guard lock(known.mutex);
  const auto found = known.constants.find(name);
  return found != known.constants.end() ? found->second : known.constants[name] = calibrate(device);
}

void refine_calibration(const std::shared_ptr<gpu::ReadyDevice>& device, double predicted_seconds, double seconds) {
  if (!(predicted_seconds > 0) || !(seconds > 0)) return;
  const double factor = std::pow(std::clamp(seconds / predicted_seconds, 0.1, 10.0), 0.25);
  KnownDevices& known = known_devices();
  const std::lock_guard lock(known.mutex);
  schedule::DeviceConstants& constants = known.constants[name_of(*device)];
  constants.box_test *= factor, constants.element_test *= factor, constants.leaf_pair *= factor;
}

std::string calibration() {
  KnownDevices& known = known_devices();
  const std::lock_guard lock(known.mutex);
  if (known.constants.empty()) return {};
  std::string text = std::string(kCalibrationTitle) + "\n";
  for (const auto& [name, c] : known.constants) {
    char numbers[160];
    std::snprintf(numbers, sizeof numbers, "%.6e %.6e %.6e %.6e %.6e ", c.question, c.box_test, c.element_test,
                  c.leaf_pair, c.mesh_triangle);
    text += numbers + name + "\n";
  }
  return text;
}

void set_calibration(std::string_view text) {
  const auto next_line = [&] {
    std::string line(text.substr(0, text.find('\n')));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
  };
  if (next_line() != kCalibrationTitle) return;
  KnownDevices& known = known_devices();
  const std::lock_guard lock(known.mutex);
  while (!text.empty()) {
    const std::string line = next_line();
    schedule::DeviceConstants c;
    const char* at = line.data();
    bool is_sound = true;
    for (double* const constant : {&c.question, &c.box_test, &c.element_test, &c.leaf_pair, &c.mesh_triangle}) {
      const auto [end, error] = std::from_chars(at, line.data() + line.size(), *constant);
      is_sound =
          is_sound && error == std::errc() && *constant >= 0 && *constant < 1 && end != line.data() + line.size();
      if (!is_sound) break;
      at = end + 1;  // a blank
    }
    if (is_sound && c.box_test > 0 && c.element_test > 0)
      known.constants[std::string(at, line.data() + line.size())] = c;
  }
}

const schedule::CostConstants& calibrated_constants(std::string_view backend) {
  if (backend == "paper" || backend == "scalar") {
    static const schedule::CostConstants paper = calibrate("paper");
    return paper;
  }
  if (backend == "raster") {  // on the device that is taken where none is named
    static const schedule::CostConstants raster = calibrate("raster");
    return raster;
  }
  static const schedule::CostConstants simd = calibrate("simd");
  return simd;
}

}  // namespace impinge
