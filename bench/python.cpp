// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT

/// What bench/python.py measures Python against: the same questions about the same numbers, asked from C++. It reads
/// FOLDER/python.bin, which that program wrote, and prints microseconds a question, and how many were answered by yes.
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>

#include "bench/peers/fcl_crowd.hpp"
#include "bench/support.hpp"
#include "impinge/collide.hpp"
#include "impinge/scene.hpp"

namespace impinge::bench {
namespace {

/// Arrays of 8-byte numbers, each after its length.
class Numbers {
 public:
  explicit Numbers(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    if (bytes_.empty()) fail(path.string() + " is missing; bench/python.py writes it");
  }
  template <class T>
  std::vector<T> next() {
    const auto count = static_cast<std::size_t>(take<std::int64_t>());
    std::vector<T> numbers(count);
    for (T& number : numbers) number = take<T>();
    return numbers;
  }
  scenes::MeshData next_mesh() {
    scenes::MeshData mesh{next<double>(), {}};
    for (const std::int64_t vertex : next<std::int64_t>()) mesh.triangles.push_back(static_cast<std::uint32_t>(vertex));
    return mesh;
  }
  /// (4, 4) matrices.
  std::vector<Pose> next_poses() {
    const std::vector<double> m = next<double>();
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < m.size(); i += 16)
      poses.push_back({{m[i], m[i + 1], m[i + 2], m[i + 4], m[i + 5], m[i + 6], m[i + 8], m[i + 9], m[i + 10]},
                       {m[i + 3], m[i + 7], m[i + 11]}});
    return poses;
  }

 private:
  template <class T>
  T take() {
    static_assert(sizeof(T) == 8);
    if (at_ + sizeof(T) > bytes_.size()) fail("python.bin ends early");
    T number;
    std::memcpy(&number, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return number;
  }
  std::vector<char> bytes_;
  std::size_t at_ = 0;
};

/// `ask(i)` for each question, of which the first half grows what is kept: prints a name, microseconds a question of
/// the second half, and the number of yeses in it.
template <class Ask>
void measure(const char* name, std::size_t questions, const Ask& ask) {
  const std::size_t half = questions / 2;
  std::size_t yes = 0;
  for (std::size_t i = 0; i < half; ++i) ask(i);
  const double seconds = seconds_of([&] {
    for (std::size_t i = half; i < questions; ++i) yes += ask(i) ? 1 : 0;
  });
  std::printf("%s,%.4f,%zu\n", name, 1e6 * seconds / static_cast<double>(questions - half), yes);
}

Scene scene_of(const Mesh& mesh, std::span<const Pose> poses) {
  Scene scene;
  for (const Pose& pose : poses) must(scene.add(mesh, pose));
  return scene;
}

}  // namespace

void bench_main(const Arguments& arguments) {
  pin_to_one_core();
  Numbers numbers(arguments.folder / "python.bin");
  const scenes::MeshData small = numbers.next_mesh(), body = numbers.next_mesh();
  const std::vector<Pose> beside = numbers.next_poses(), standing = numbers.next_poses(), path = numbers.next_poses(),
                          moves = numbers.next_poses(), visits = numbers.next_poses();

  const Mesh box = make_mesh(small), mesh = make_mesh(body);
  must(box.build_tree()), must(mesh.build_tree());
  const Options first{.find = Options::Find::first, .threads = 1};
  measure("touches", beside.size(),
          [&](std::size_t i) { return !must(collide(box, {}, box, beside[i], first)).kinds.empty(); });

  Scene robot = scene_of(mesh, standing);
  const ObjectId mover = must(robot.add(mesh));
  must(robot.update(1));
  // As many questions as poses, in one call.
  std::size_t yes = 0;
  const auto configurations = [&] {
    yes = 0;
    for (const std::uint8_t one : must(robot.collide_configurations({&mover, 1}, path, {.threads = 1})).touches)
      yes += one;
  };
  configurations();
  std::printf("configurations,%.4f,%zu\n", 1e6 * seconds_of(configurations) / static_cast<double>(path.size()), yes);

  scenes::PlacedScene obstacles{{body}, {}}, visitor{{body}, {{.mesh = 0}}};
  for (const Pose& pose : standing) obstacles.objects.push_back({.mesh = 0, .pose = pose});
  FclRobot fcl(FclManager::tree, obstacles, visitor, {});
  measure("fcl", moves.size(), [&](std::size_t i) {
    fcl.move_obstacle(i % standing.size(), moves[i]);
    return fcl.touches({&visits[i], 1});
  });
}

}  // namespace impinge::bench
