// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <set>

#include "results/assemble.hpp"
#include "results/collector.hpp"
#include "scenes/shapes.hpp"
#include "tests/core/support.hpp"

namespace impinge {
namespace {

constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// The hash as docs/hash.md tells a user to recompute it, from that page alone.
namespace documented {

std::uint64_t mix(std::uint64_t x) {
  x = x + 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}
std::uint64_t fold(std::uint64_t h, std::uint64_t w) { return mix(h ^ mix(w)); }
std::uint64_t number(double x) { return x == 0 ? 0 : std::bit_cast<std::uint64_t>(x); }

std::uint64_t key(const Mesh& mesh, const Pose& pose) {
  std::uint64_t h = fold(mesh.vertex_count(), mesh.triangle_count());
  for (const Point& v : mesh.vertices()) h = fold(fold(fold(h, number(v.x)), number(v.y)), number(v.z));
  for (const auto& t : mesh.triangles()) h = fold(fold(fold(h, t[0]), t[1]), t[2]);
  for (const double r : pose.R) h = fold(h, number(r));
  for (const double t : pose.t) h = fold(h, number(t));
  return h;
}

std::uint64_t contact(std::uint64_t key_a, std::uint32_t a, std::uint64_t key_b, std::uint32_t b, std::uint32_t kind) {
  std::uint64_t u = fold(key_a, a), v = fold(key_b, b);
  if (u > v) std::swap(u, v);
  return fold(fold(u, v), kind);
}

}  // namespace documented

TEST(Hash, IsTheDocumentedOne) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    test::Seeded seeded(seed);
    for (const test::NamedScene& named : test::hard_scenes(seeded.random, 24)) {
      SCOPED_TRACE(named.name);
      const std::vector<Mesh> meshes = test::meshes_of(named.scene);
      const auto &a = named.scene.objects[0], &b = named.scene.objects[1];
      const auto found = collide(meshes[a.mesh], a.pose, meshes[b.mesh], b.pose);
      ASSERT_TRUE(found);
      const std::uint64_t key_a = documented::key(meshes[a.mesh], a.pose);
      const std::uint64_t key_b = documented::key(meshes[b.mesh], b.pose);
      std::uint64_t sum = 0;
      for (const test::Contact& c : test::listed(*found)) sum += documented::contact(key_a, c[2], key_b, c[3], c[4]);
      EXPECT_EQ(found->hash, sum);
      EXPECT_EQ(found->hash == 0, found->triangles.empty());
    }
  }
}

TEST(Hash, TakesMinusZeroAsZero) {
  scenes::MeshData negative = scenes::cube();
  for (double& x : negative.xyz)
    if (x == 0) x = -0.0;
  Pose pose, minus;
  pose.t = {1, 0, 0};
  minus.t = {1, -0.0, -0.0};
  minus.R[1] = minus.R[5] = -0.0;
  const Mesh cube = test::mesh_of(scenes::cube()), same = test::mesh_of(negative);
  const auto expected = collide(cube, {}, cube, pose), found = collide(same, {}, cube, minus);
  EXPECT_NE(expected->hash, 0u);
  test::expect_same(*expected, *found);
}

/// Any contacts of any object pairs, each once, in any order.
struct Case {
  broad::ObjectPairs pairs;
  std::vector<std::uint64_t> keys;
  std::vector<exact::Contact> contacts;
};

Case any_case() {
  Case c;
  c.keys = *rc::gen::container<std::vector<std::uint64_t>>(6, rc::gen::arbitrary<std::uint64_t>());
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t a = 0; a < 6; ++a)
    for (std::uint32_t b = a + 1; b < 6; ++b)
      if (*rc::gen::inRange(0, 3) != 0) c.pairs.push_back({a, b, {}});
  if (c.pairs.empty()) c.pairs.push_back({0, 5, {}});
  const auto id = rc::gen::element<std::uint32_t>(0, 1, 2, 3, 0x7FFFFFFE, 5);
  std::set<std::array<std::uint32_t, 3>> known;
  const int n = *rc::gen::inRange(0, 40);
  for (int i = 0; i < n; ++i) {
    const std::array<std::uint32_t, 3> at{
        *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(c.pairs.size())), *id, *id};
    if (!known.insert(at).second) continue;
    c.contacts.push_back({at[0], at[1], at[2], static_cast<Kind>(*rc::gen::inRange(0, 3))});
  }
  return c;
}

test::Contact plain(const Case& c, const exact::Contact& contact) {
  const broad::ObjectPair& pair = c.pairs[contact.object_pair];
  return {pair.a, pair.b, contact.a, contact.b, static_cast<std::uint32_t>(contact.kind)};
}

std::vector<exact::Contact> shuffled(std::vector<exact::Contact> contacts, std::uint64_t seed) {
  scenes::Random random(seed);
  for (std::size_t i = contacts.size(); i > 1; --i)
    std::swap(contacts[i - 1], contacts[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
  return contacts;
}

RC_GTEST_PROP(Assemble, GivesCanonicalRowsAndAPrefixUnderALimit, (std::uint64_t seed)) {
  const Case c = any_case();
  std::vector<test::Contact> expected;
  for (const exact::Contact& contact : c.contacts) expected.push_back(plain(c, contact));
  std::sort(expected.begin(), expected.end());
  const Contacts whole =
      results::assemble(shuffled(c.contacts, seed), c.pairs, c.keys, {kNoLimit, c.contacts.size(), true});
  RC_ASSERT(test::listed(whole) == expected);
  RC_ASSERT(!whole.truncated);

  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1}, seed % 40, std::uint64_t{expected.size()}}) {
    const Contacts cut =
        results::assemble(shuffled(c.contacts, seed + 1), c.pairs, c.keys, {limit, c.contacts.size(), true});
    const std::size_t kept = std::min<std::size_t>(limit, expected.size());
    const std::vector<test::Contact> prefix(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(kept));
    RC_ASSERT(test::listed(cut) == prefix);
    RC_ASSERT(cut.truncated == (kept < expected.size()));
    std::uint64_t sum = 0;
    for (const test::Contact& p : prefix) sum += documented::contact(c.keys[p[0]], p[2], c.keys[p[1]], p[3], p[4]);
    RC_ASSERT(cut.hash == sum);
  }
  RC_ASSERT(results::assemble(c.contacts, c.pairs, c.keys, {kNoLimit, c.contacts.size(), false}).hash == 0);
}

/// Objects renumbered and pairs turned round: the arrays change, the hash does not.
RC_GTEST_PROP(Assemble, HashIsIndependentOfIdsAndSwap, ()) {
  const Case c = any_case();
  Case turned{{}, {c.keys.rbegin(), c.keys.rend()}, c.contacts};
  for (const broad::ObjectPair& pair : c.pairs) turned.pairs.push_back({5 - pair.b, 5 - pair.a, {}});
  for (exact::Contact& contact : turned.contacts) std::swap(contact.a, contact.b);
  const auto hash = [](const Case& x) {
    return results::assemble(x.contacts, x.pairs, x.keys, {kNoLimit, x.contacts.size(), true}).hash;
  };
  RC_ASSERT(hash(c) == hash(turned));
  if (c.contacts.empty()) return;
  Case other = c;
  other.contacts[0].kind = static_cast<Kind>((static_cast<int>(other.contacts[0].kind) + 1) % 3);
  RC_ASSERT(hash(c) != hash(other));
}

/// Small limits, so that the collector cuts again and again.
TEST(Collector, KeepsTheFirstInBoundedMemory) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const auto limit = static_cast<std::uint64_t>(random.integer(0, 3000));
    const auto kinds = static_cast<std::uint8_t>(random.integer(0, 7));
    results::Collector collector(kinds, limit);
    std::vector<exact::Contact> wanted;
    std::uint64_t number = seed;
    for (int chunk = 0; chunk < 60; ++chunk) {
      std::vector<exact::Contact> contacts;
      for (int i = random.integer(0, 500); i > 0; --i) {
        number = number * 0x9E3779B97F4A7C15 + 1;  // odd multipliers visit each number once
        const auto id = static_cast<std::uint32_t>(number >> 40);
        contacts.push_back(
            {id >> 20, id, static_cast<std::uint32_t>(wanted.size()), static_cast<Kind>(random.integer(0, 2))});
        if (kinds >> static_cast<int>(contacts.back().kind) & 1) wanted.push_back(contacts.back());
      }
      collector.add(contacts);
      ASSERT_EQ(collector.seen(), wanted.size());
      ASSERT_LE(collector.kept().size(), 2 * limit + 4096 + 500);
    }
    std::vector<exact::Contact> kept = collector.kept();
    const auto order = [](std::vector<exact::Contact>& contacts) {
      std::sort(contacts.begin(), contacts.end(), results::precedes);
    };
    order(kept), order(wanted);
    const std::size_t n = std::min<std::size_t>(limit, wanted.size());
    ASSERT_GE(kept.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(kept[i].object_pair, wanted[i].object_pair);
      ASSERT_EQ(kept[i].a, wanted[i].a);
      ASSERT_EQ(kept[i].b, wanted[i].b);
      ASSERT_EQ(kept[i].kind, wanted[i].kind);
    }
  }
}

TEST(Collector, WithoutALimitKeepsAll) {
  results::Collector collector(kAllKinds, kNoLimit);
  const std::vector<exact::Contact> contacts(20000, {1, 2, 3, Kind::touching});
  collector.add(contacts);
  EXPECT_EQ(collector.kept().size(), 20000u);
}

TEST(Precedes, IsTheCanonicalOrder) {
  const std::array<std::uint32_t, 4> values{0, 1, 0x7FFFFFFF, 0xFFFFFFFE};
  std::vector<exact::Contact> all;
  for (const std::uint32_t p : values)
    for (const std::uint32_t a : values)
      for (const std::uint32_t b : values) all.push_back({p, a, b, Kind::touching});
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = 0; j < all.size(); ++j) EXPECT_EQ(results::precedes(all[i], all[j]), i < j);
}

}  // namespace
}  // namespace impinge
