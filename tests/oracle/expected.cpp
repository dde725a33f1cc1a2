// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "expected.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <ostream>
#include <sstream>
#include <string_view>
#include <utility>

#include "impinge/collide.hpp"
#include "impinge/scene.hpp"
#include "kept.hpp"
#include "scenes/random.hpp"
#include "scenes/scene_file.hpp"
#include "tests/core/instruction_sets.hpp"
#include "tests/core/support.hpp"

extern char** environ;

namespace impinge::scenes {

void PrintTo(const Judgement& judgement, std::ostream* out) {
  constexpr std::array<const char*, 6> kNames{"duplicate", "inside", "penetrating", "crossing", "touching", "apart"};
  *out << kNames.at(static_cast<std::size_t>(judgement.verdict));
  if (judgement.verdict == Verdict::inside)
    *out << (judgement.inner == 0 ? " (a in b)" : judgement.inner == 1 ? " (b in a)" : " (neither in the other)");
}

}  // namespace impinge::scenes

namespace impinge::expected {
namespace {

namespace fs = std::filesystem;

/// Whether this build has it (CMakeLists.txt).
constexpr bool kHasOracle = !std::string_view(IMPINGE_ORACLE_FOLDER).empty();

/// Raise it when the oracle's answers change: those kept under older names are then computed anew.
constexpr const char* kOracleVersion = "1";

/// FNV-1a over words of eight bytes, with the length: names a set, nothing more.
std::string name_of(const std::string& bytes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash = (hash ^ word) * 0x100000001b3u;
    hash ^= hash >> 32;
  }
  std::ostringstream name;
  name << std::hex << hash << '-' << std::dec << bytes.size() << '-' << kOracleVersion;
  return name.str();
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::optional<Set> read_set(const fs::path& file) {
  const std::string bytes = bytes_of(file);
  std::uint64_t count = 0;
  if (bytes.size() < 16 || bytes.compare(0, 8, "impset01") != 0) return std::nullopt;
  std::memcpy(&count, bytes.data() + 8, 8);
  if (count != (bytes.size() - 16) / sizeof(Contact) || bytes.size() != 16 + count * sizeof(Contact))
    return std::nullopt;
  Set set(count);
  if (count != 0) std::memcpy(set.data(), bytes.data() + 16, count * sizeof(Contact));
  return set;
}

bool runs(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& argument : command) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  return failure == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

/// Which program, with which option or none, and what its answers are named.
struct Oracle {
  const char *program, *option, *extension;
};
constexpr Oracle kOracle{"impinge_oracle", nullptr, ".set"}, kRational{"impinge_oracle", "--rational", ".rational"},
    kModelOracle{"impinge_model_oracle", nullptr, ".model"},
    kVerdictOracle{"impinge_verdict_oracle", nullptr, ".verdict"},
    kTetrahedra{"impinge_verdict_oracle", "--tetrahedra", ".tetrahedra"};

/// What the oracle finds in a file, or has found before in this build.
Set computed(const Oracle& oracle, const std::string& key, const fs::path& file) {
  const fs::path set_file = fs::path(IMPINGE_ORACLE_SETS) / (key + oracle.extension);
  if (auto known = read_set(set_file)) return *std::move(known);
  fs::create_directories(IMPINGE_ORACLE_SETS);
  std::vector<std::string> command{(fs::path(IMPINGE_ORACLE_FOLDER) / oracle.program).string()};
  if (oracle.option != nullptr) command.emplace_back(oracle.option);
  command.insert(command.end(), {file.string(), set_file.string()});
  if (!runs(command)) {
    ADD_FAILURE() << "The oracle failed, or is missing: " << command[0] << " on " << file;
    return {};
  }
  auto set = read_set(set_file);
  EXPECT_TRUE(set) << set_file << " is not a set, though the oracle has just written it.";
  return set ? *std::move(set) : Set{};
}

Set computed(const Oracle& oracle, const scenes::PlacedScene& scene) {
  const std::string bytes = scenes::scene_bytes(scene), key = name_of(bytes);
  const fs::path file = fs::temp_directory_path() / (key + "." + std::to_string(::getpid()) + ".scene");
  std::ofstream(file, std::ios::binary) << bytes;
  Set set = computed(oracle, key, file);
  fs::remove(file);
  return set;
}

/// A hash of the whole set, and how many cross, touch and are coplanar.
std::string summary(const Set& set) {
  std::array<std::size_t, 3> counts{};
  for (const Contact& contact : set) ++counts.at(contact[4]);
  std::ostringstream words;
  words << name_of({reinterpret_cast<const char*>(set.data()), set.size() * sizeof(Contact)}) << ' ' << counts[0] << ' '
        << counts[1] << ' ' << counts[2];
  return words.str();
}

/// The set, if it is the one that the oracle once found.
Set held_to_kept(const std::string& key, Set found) {
  const std::string kept = kept_answer(key);
  if (!kept.empty() && kept != summary(found)) {
    ADD_FAILURE() << "What the plainest way finds is not the oracle's answer: " << summary(found) << " instead of "
                  << kept << "; ./dev test --all, which has the oracle, tells the pairs";
    return {};
  }
  return found;
}

Set listed_or_failed(const Result<Contacts>& contacts) {
  if (!contacts) {
    ADD_FAILURE() << "The query failed: " << contacts.error().message;
    return {};
  }
  EXPECT_FALSE(contacts->truncated);
  return listed(*contacts);
}

std::string written(const Contact& c) {
  std::ostringstream out;
  out << "objects " << c[0] << ' ' << c[1] << " triangles " << c[2] << ' ' << c[3];
  return out.str();
}

std::string written_kind(std::uint32_t kind) {
  constexpr std::array<const char*, 3> kNames{"crossing", "touching", "coplanar"};
  return kind < 3 ? kNames[kind] : "kind " + std::to_string(kind);
}

scenes::Judgement judgement_by(const Oracle& oracle, const scenes::SolidPair& pair) {
  const Set set = computed(oracle, scenes::pair_scene(pair.a, pair.b));
  if (set.size() != 1) {
    ADD_FAILURE() << "No verdict on " << pair.name;
    return {};
  }
  return {static_cast<Verdict>(set[0][2]), static_cast<int>(set[0][3]) - 1};
}

const Options kPlainest{.threads = 1, .backend = "paper"};

}  // namespace

Set by_oracle(const scenes::PlacedScene& scene) {
  const std::string key = name_of(scenes::scene_bytes(scene)) + kOracle.extension;
  if (!kHasOracle) return held_to_kept(key, by_scene(scene, kPlainest));
  Set set = computed_set(scene);
  hold_to_kept(key, summary(set));
  return set;
}

Set computed_set(const scenes::PlacedScene& scene) { return computed(kOracle, scene); }

Set by_rationals(const scenes::PlacedScene& scene) { return computed(kRational, scene); }

scenes::Judgement judgement(const scenes::SolidPair& pair) {
  const scenes::PlacedScene scene = scenes::pair_scene(pair.a, pair.b);
  const std::string key = name_of(scenes::scene_bytes(scene)) + kVerdictOracle.extension;
  if (kHasOracle) {
    const scenes::Judgement judgement = computed_judgement(pair);
    hold_to_kept(key, std::to_string(static_cast<int>(judgement.verdict)) + ' ' + std::to_string(judgement.inner));
    return judgement;
  }
  std::istringstream words(kept_answer(key));
  int verdict = 0, inner = 0;
  EXPECT_TRUE(words >> verdict >> inner) << "No verdict on " << pair.name;
  return {static_cast<Verdict>(verdict), inner};
}

scenes::Judgement computed_judgement(const scenes::SolidPair& pair) { return judgement_by(kVerdictOracle, pair); }

scenes::Judgement judgement_by_tetrahedra(const scenes::SolidPair& pair) { return judgement_by(kTetrahedra, pair); }

Set of_model(const std::filesystem::path& model, const Scene& scene) {
  const std::string key = name_of(bytes_of(model)), kept_key = key + kModelOracle.extension;
  if (!kHasOracle) return held_to_kept(kept_key, listed_or_failed(scene.collide(kPlainest)));
  Set set = computed(kModelOracle, key, model);
  hold_to_kept(kept_key, summary(set));
  return set;
}

Set listed(const Contacts& contacts) {
  Set set = test::listed(contacts);
  EXPECT_TRUE(std::is_sorted(set.begin(), set.end())) << "The answer is not in canonical order.";
  return set;
}

Set by_scene(const scenes::PlacedScene& scene, const Options& options) {
  return listed_or_failed(test::scene_of(scene).collide(options));
}

std::uint64_t hash_by_scene(const scenes::PlacedScene& scene, const Options& options) {
  const Result<Contacts> contacts = test::scene_of(scene).collide(options);
  EXPECT_TRUE(contacts);
  return contacts ? contacts->hash : 0;
}

void expect_way(const Set& expected, std::uint64_t hash, const scenes::PlacedScene& scene, const test::Way& way) {
  const testing::ScopedTrace trace(__FILE__, __LINE__, way.name());
  const test::OnInstructionSet on(way.instruction_set);
  const Scene placed = test::scene_of(scene, way.leaf_size);
  const Result<Contacts> all = placed.collide(way.options());
  expect_same(expected, listed_or_failed(all));
  if (testing::Test::HasFailure()) return;
  EXPECT_EQ(all->hash, hash);

  const auto kinds = static_cast<std::uint8_t>(1 + hash % kAllKinds);
  Set wanted;
  std::copy_if(expected.begin(), expected.end(), std::back_inserter(wanted),
               [&](const Contact& c) { return (kinds >> c[4] & 1) != 0; });
  Options options = way.options();
  options.kinds = kinds;
  options.limit = hash / 8 % (wanted.size() + 2);
  const Result<Contacts> cut = placed.collide(options);
  if (!cut) {
    ADD_FAILURE() << "The query with a limit failed: " << cut.error().message;
    return;
  }
  const std::size_t kept = std::min<std::size_t>(options.limit, wanted.size());
  expect_same(Set(wanted.begin(), wanted.begin() + static_cast<std::ptrdiff_t>(kept)), listed(*cut));
  EXPECT_EQ(cut->truncated, kept < wanted.size());

  options.limit = Options{}.limit;
  options.find = Options::Find::first;
  const Set witnesses = listed_or_failed(placed.collide(options));
  std::size_t next = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (i > 0 && wanted[i][0] == wanted[i - 1][0] && wanted[i][1] == wanted[i - 1][1]) continue;
    if (next >= witnesses.size() || witnesses[next][0] != wanted[i][0] || witnesses[next][1] != wanted[i][1]) {
      ADD_FAILURE() << "No witness for " << written(wanted[i]);
      return;
    }
    EXPECT_TRUE(std::binary_search(wanted.begin(), wanted.end(), witnesses[next])) << written(witnesses[next]);
    ++next;
  }
  EXPECT_EQ(next, witnesses.size()) << "Witnesses of what does not touch.";
}

Set by_collide(const scenes::PlacedScene& scene, bool swapped) {
  const std::vector<Mesh> meshes = test::meshes_of(scene);
  const scenes::PlacedObject& a = scene.objects.at(swapped ? 1 : 0);
  const scenes::PlacedObject& b = scene.objects.at(swapped ? 0 : 1);
  return listed_or_failed(collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose));
}

void expect_same(const Set& expected, const Set& found) {
  if (expected == found) return;
  std::map<Contact, std::array<std::uint32_t, 2>> kinds;  // pair -> 1 + kind expected, 1 + kind found; 0: none
  const auto pair_of = [](Contact c) {
    c[4] = 0;
    return c;
  };
  for (const Contact& c : expected) kinds[pair_of(c)][0] = 1 + c[4];
  for (const Contact& c : found) kinds[pair_of(c)][1] = 1 + c[4];
  std::size_t missed = 0, added = 0, misnamed = 0;
  std::string examples;
  for (const auto& [pair, kind] : kinds) {
    if (kind[0] == kind[1]) continue;
    const std::size_t examples_before = missed + added + misnamed;
    missed += kind[1] == 0;
    added += kind[0] == 0;
    misnamed += kind[0] != 0 && kind[1] != 0;
    if (examples_before < 5)
      examples += "\n  " + written(pair) + ": " + (kind[0] == 0 ? "no contact" : written_kind(kind[0] - 1)) +
                  " found as " + (kind[1] == 0 ? "no contact" : written_kind(kind[1] - 1));
  }
  ADD_FAILURE() << "Of " << expected.size() << " contacts " << missed << " missed, " << misnamed << " misnamed; "
                << added << " added" << (found.size() != kinds.size() - missed ? "; some found twice" : "") << examples;
}

void expect_finds(const Set& expected, const scenes::PlacedScene& scene) {
  const std::size_t count = scene.objects.size() < 1000 ? 4 : 1;
  {
    SCOPED_TRACE("by Scene");
    expect_same(expected, by_scene(scene));
  }
  if (testing::Test::HasFailure()) return;
  const std::vector<test::Way>& ways = test::all_ways();
  scenes::Random random(std::hash<std::string>()(scenes::scene_bytes(scene)));
  const std::uint64_t hash = hash_by_scene(scene);
  for (std::size_t i = 0; i < count; ++i) expect_way(expected, hash, scene, ways[random.bits() % ways.size()]);
  if (scene.objects.size() != 2) return;
  {
    SCOPED_TRACE("by collide");
    expect_same(expected, by_collide(scene));
  }
  {
    SCOPED_TRACE("by collide, swapped");
    expect_same(test::transposed(expected), by_collide(scene, true));
  }
}

Set expect_exact(const scenes::PlacedScene& scene) {
  Set expected = by_oracle(scene);
  expect_finds(expected, scene);
  return expected;
}

}  // namespace impinge::expected
