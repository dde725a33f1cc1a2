// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <set>
#include <thread>
#include <tuple>

#include "results/assemble.hpp"
#include "results/collector.hpp"
#include "results/row_hash.hpp"
#include "tests/core/instruction_sets.hpp"
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
  std::uint64_t vertices = 0, triangles = 0, i = 0, j = 0;
  for (const Point& v : mesh.vertices()) vertices += fold(fold(fold(i++, number(v.x)), number(v.y)), number(v.z));
  for (const auto& t : mesh.triangles()) triangles += fold(fold(fold(j++, t[0]), t[1]), t[2]);
  std::uint64_t h = fold(fold(fold(mesh.vertex_count(), mesh.triangle_count()), vertices), triangles);
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

/// Rows of every length up to some vectors', with the largest ids.
TEST(Hash, OfARowIsTheDocumentedOneOnEveryInstructionSet) {
  scenes::Random random(1);
  const auto id = [&] {
    const int any = random.integer(0, 0x7FFFFFFE);
    return static_cast<std::uint32_t>(random.integer(0, 2) == 0 ? 0x7FFFFFFE : any);
  };
  const std::uint64_t key_a = 0x123456789ABCDEF0, key_b = 0xFEDCBA9876543210;
  for (const std::int64_t set : test::instruction_sets()) {
    const test::OnInstructionSet on(set);
    std::vector<results::ContactKey> row;
    std::uint64_t sum = 0;
    for (int size = 0; size <= 40; ++size) {
      ASSERT_EQ(results::row_hash(row, key_a, key_b), sum) << size;
      const std::uint32_t a = id(), b = id();
      row.push_back(results::contact_key(a, b, static_cast<Kind>(size % 3)));
      sum += documented::contact(key_a, a, key_b, b, static_cast<std::uint32_t>(size % 3));
    }
  }
}

/// A contact of the pair of objects at an index.
struct Found {
  std::uint32_t object_pair, a, b;
  Kind kind;
};

/// Any contacts of any object pairs, each once, in any order.
struct Case {
  broad::ObjectPairs pairs;
  std::vector<std::uint64_t> keys;
  std::vector<Found> contacts;
};

Case any_case() {
  Case c;
  c.keys = *rc::gen::container<std::vector<std::uint64_t>>(6, rc::gen::arbitrary<std::uint64_t>());
  for (std::uint32_t a = 0; a < 6; ++a)
    for (std::uint32_t b = a + 1; b < 6; ++b)
      if (*rc::gen::inRange(0, 3) != 0) c.pairs.push_back({a, b});
  if (*rc::gen::inRange(0, 3) == 0) c.pairs.resize(std::min<std::size_t>(c.pairs.size(), 2));
  if (c.pairs.empty()) c.pairs.push_back({0, 5});
  const auto id = rc::gen::element<std::uint32_t>(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 1u << 30, 0x7FFFFFFE);
  std::set<std::array<std::uint32_t, 3>> known;
  const int n = *rc::gen::inRange(0, 200);  // long rows may be sorted in another way than short ones
  for (int i = 0; i < n; ++i) {
    const std::array<std::uint32_t, 3> at{
        *rc::gen::inRange<std::uint32_t>(0, static_cast<std::uint32_t>(c.pairs.size())), *id, *id};
    if (!known.insert(at).second) continue;
    c.contacts.push_back({at[0], at[1], at[2], static_cast<Kind>(*rc::gen::inRange(0, 3))});
  }
  return c;
}

test::Contact plain(const Case& c, const Found& contact) {
  const broad::ObjectPair& pair = c.pairs[contact.object_pair];
  return {pair.a, pair.b, contact.a, contact.b, static_cast<std::uint32_t>(contact.kind)};
}

template <class T>
void shuffle(std::vector<T>& list, scenes::Random& random) {
  for (std::size_t i = list.size(); i > 1; --i)
    std::swap(list[i - 1], list[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
}

/// As threads find them: in any order, a few of one pair at a time, by one of several collectors.
std::vector<results::Collector> collected(const Case& c, std::uint64_t limit, std::uint64_t seed) {
  scenes::Random random(seed);
  std::vector<Found> contacts = c.contacts;
  shuffle(contacts, random);
  std::vector<results::Collector> collectors(static_cast<std::size_t>(random.integer(1, 3)));
  for (results::Collector& collector : collectors) collector.restart(kAllKinds, limit);
  for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
    std::vector<results::ContactKey> keys;
    while (end < contacts.size() && contacts[end].object_pair == contacts[begin].object_pair) {
      keys.push_back(results::contact_key(contacts[end].a, contacts[end].b, contacts[end].kind));
      ++end;
    }
    const auto last = static_cast<int>(collectors.size()) - 1;
    collectors[static_cast<std::size_t>(random.integer(0, last))].add(contacts[begin].object_pair, keys);
  }
  return collectors;
}

/// Memory that every call uses anew.
struct Kept {
  results::AssembleScratch scratch;
  Contacts contacts;

  const Contacts& assemble(const Case& c, const results::AssembleConfig& config, std::uint64_t seed) {
    const std::vector<results::Collector> collectors = collected(c, config.limit, seed);
    std::vector<const results::Collector*> pointers;
    for (const results::Collector& collector : collectors) pointers.push_back(&collector);
    results::assemble(
        pointers, c.pairs, [&](std::uint32_t i) { return c.keys[i]; }, config, scratch, contacts);
    return contacts;
  }
};

RC_GTEST_PROP(Assemble, GivesCanonicalRowsAndAPrefixUnderALimit, (std::uint64_t seed)) {
  const Case c = any_case();
  std::vector<test::Contact> expected;
  for (const Found& contact : c.contacts) expected.push_back(plain(c, contact));
  std::sort(expected.begin(), expected.end());
  Kept kept;
  const Contacts& whole = kept.assemble(c, {kNoLimit, true, false}, seed);
  RC_ASSERT(test::listed(whole) == expected);
  RC_ASSERT(!whole.truncated);

  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1}, seed % 200, std::uint64_t{expected.size()}}) {
    const Contacts& cut = kept.assemble(c, {limit, true, false}, seed + 1);
    const std::size_t count = std::min<std::size_t>(limit, expected.size());
    const std::vector<test::Contact> prefix(expected.begin(), expected.begin() + static_cast<std::ptrdiff_t>(count));
    RC_ASSERT(test::listed(cut) == prefix);
    RC_ASSERT(cut.truncated == (count < expected.size()));
    std::uint64_t sum = 0;
    for (const test::Contact& p : prefix) sum += documented::contact(c.keys[p[0]], p[2], c.keys[p[1]], p[3], p[4]);
    RC_ASSERT(cut.hash == sum);
  }
  RC_ASSERT(kept.assemble(c, {kNoLimit, false, false}, seed).hash == 0);
}

/// A row for every pair, in the order of the pairs, with the same contacts in it; a limit empties rows and drops none.
RC_GTEST_PROP(Assemble, GivesARowForEveryPairWhenAskedFor, (std::uint64_t seed)) {
  const Case c = any_case();
  Kept kept;
  for (const std::uint64_t limit : {kNoLimit, seed % 40, std::uint64_t{0}}) {
    const Contacts sparse = kept.assemble(c, {limit, true, false}, seed);
    const Contacts& full = kept.assemble(c, {limit, true, true}, seed);
    RC_ASSERT(full.objects.size() == c.pairs.size());
    RC_ASSERT(full.offsets.size() == c.pairs.size() + 1);
    std::vector<std::array<std::uint32_t, 2>> with_contacts;
    for (std::size_t i = 0; i < c.pairs.size(); ++i) {
      RC_ASSERT(full.objects[i] == (std::array{c.pairs[i].a, c.pairs[i].b}));
      RC_ASSERT(full.offsets[i] <= full.offsets[i + 1]);
      if (full.offsets[i] < full.offsets[i + 1]) with_contacts.push_back(full.objects[i]);
    }
    RC_ASSERT(with_contacts == sparse.objects);
    RC_ASSERT(full.triangles == sparse.triangles);
    RC_ASSERT(full.kinds == sparse.kinds);
    RC_ASSERT(full.hash == sparse.hash);
    RC_ASSERT(full.truncated == sparse.truncated);
  }
}

void backwards(std::size_t n, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = n; i > 0; --i) body(i - 1);
}

void by_three(std::size_t n, const std::function<void(std::size_t)>& body) {
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 3; ++t)
    threads.emplace_back([&, t] {
      for (std::size_t i = t; i < n; i += 3) body(i);
    });
  for (std::thread& thread : threads) thread.join();
}

/// Rows far longer than what one thread takes on, rows of nothing, and many short ones; ids spread out, or crowded so
/// that some samples of a row say little of the rest.
TEST(Assemble, GivesTheSameByManyHands) {
  scenes::Random random(1);
  for (const int spread : {1 << 30, 300, 2}) {
    SCOPED_TRACE(spread);
    Case c;
    c.keys = {3, 1, 4, 1, 5, 9};
    for (std::uint32_t a = 0; a < 6; ++a)
      for (std::uint32_t b = a + 1; b < 6; ++b) c.pairs.push_back({a, b});
    const std::array sizes{0, 5, 150000, 0, 0, 70, 40000, 1, 33000, 3, 20000, 16384, 0, 2, 0};
    for (std::uint32_t pair = 0; pair < sizes.size(); ++pair)
      for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sizes[pair]); ++i)
        c.contacts.push_back({pair, static_cast<std::uint32_t>(random.integer(0, spread)), i, Kind::touching});
    std::vector<test::Contact> expected;
    for (const Found& contact : c.contacts) expected.push_back(plain(c, contact));
    std::sort(expected.begin(), expected.end());
    for (const std::size_t count : {expected.size(), std::size_t{150005}, std::size_t{100000}, std::size_t{7}}) {
      expected.resize(count);
      std::uint64_t sum = 0;
      for (const test::Contact& p : expected) sum += documented::contact(c.keys[p[0]], p[2], c.keys[p[1]], p[3], p[4]);
      for (const bool all_rows : {false, true}) {
        Kept kept;
        const Contacts alone = kept.assemble(c, {count, true, all_rows}, 1);
        ASSERT_TRUE(all_rows || test::listed(alone) == expected);
        ASSERT_EQ(alone.hash, sum);
        for (const auto& hands : {backwards, by_three}) {
          const Contacts& shared = kept.assemble(c, {count, true, all_rows, hands}, 2);
          ASSERT_TRUE(shared.triangles == alone.triangles && shared.kinds == alone.kinds);
          ASSERT_TRUE(shared.objects == alone.objects && shared.offsets == alone.offsets);
          ASSERT_EQ(shared.hash, sum);
        }
      }
    }
  }
}

/// Objects renumbered and pairs turned round: the arrays change, the hash does not.
RC_GTEST_PROP(Assemble, HashIsIndependentOfIdsAndSwap, (std::uint64_t seed)) {
  const Case c = any_case();
  Case turned{{}, {c.keys.rbegin(), c.keys.rend()}, c.contacts};
  for (const broad::ObjectPair& pair : c.pairs) turned.pairs.push_back({5 - pair.b, 5 - pair.a});
  for (Found& contact : turned.contacts) std::swap(contact.a, contact.b);
  const auto hash = [&](const Case& x) { return Kept().assemble(x, {kNoLimit, true, false}, seed).hash; };
  RC_ASSERT(hash(c) == hash(turned));
  if (c.contacts.empty()) return;
  Case other = c;
  other.contacts[0].kind = static_cast<Kind>((static_cast<int>(other.contacts[0].kind) + 1) % 3);
  RC_ASSERT(hash(c) != hash(other));
}

/// What a collector holds, pair by pair as it came.
std::vector<Found> unpacked(const results::Collector& collector) {
  std::vector<Found> all;
  auto next = collector.kept().begin();
  for (const results::Run& run : collector.runs())
    for (std::size_t i = 0; i < run.count; ++i, ++next)
      all.push_back({run.object_pair, results::triangle_a(*next), results::triangle_b(*next), results::kind_of(*next)});
  EXPECT_EQ(next, collector.kept().end());
  return all;
}

/// Small limits, so that the collector cuts again and again. One collector for all, as a worker keeps it.
TEST(Collector, KeepsTheFirstInBoundedMemory) {
  results::Collector collector;
  for (std::uint64_t seed = 1; seed <= 20u; ++seed) {
    test::Seeded seeded(seed);
    scenes::Random& random = seeded.random;
    const auto limit = static_cast<std::uint64_t>(random.integer(0, 3000));
    const auto kinds = static_cast<std::uint8_t>(random.integer(0, 7));
    collector.restart(kinds, limit);
    const auto in_order = [](std::vector<Found> contacts) {
      std::sort(contacts.begin(), contacts.end(), [](const Found& x, const Found& y) {
        return std::tie(x.object_pair, x.a, x.b) < std::tie(y.object_pair, y.a, y.b);
      });
      return contacts;
    };
    std::vector<Found> wanted;
    std::uint64_t number = seed;
    for (int chunk = 0; chunk < 60; ++chunk) {
      std::vector<results::ContactKey> keys;
      const auto object_pair = static_cast<std::uint32_t>(random.integer(0, 15));
      for (int i = random.integer(0, 500); i > 0; --i) {
        number = number * 0x9E3779B97F4A7C15 + 1;  // odd multipliers visit each number once
        const Found found{object_pair, static_cast<std::uint32_t>(number >> 40),
                          static_cast<std::uint32_t>(wanted.size()), static_cast<Kind>(random.integer(0, 2))};
        keys.push_back(results::contact_key(found.a, found.b, found.kind));
        if (kinds >> static_cast<int>(found.kind) & 1) wanted.push_back(found);
      }
      collector.add(object_pair, keys);
      ASSERT_EQ(collector.seen(), wanted.size());
      ASSERT_LE(collector.kept().size(), 2 * limit + 4096 + 500);
    }
    const std::vector<Found> kept = in_order(unpacked(collector)), expected = in_order(wanted);
    const std::size_t n = std::min<std::size_t>(limit, expected.size());
    ASSERT_GE(kept.size(), n);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_EQ(kept[i].object_pair, expected[i].object_pair);
      ASSERT_EQ(kept[i].a, expected[i].a);
      ASSERT_EQ(kept[i].b, expected[i].b);
      ASSERT_EQ(kept[i].kind, expected[i].kind);
    }
  }
}

TEST(Collector, WithoutALimitKeepsAll) {
  results::Collector collector;
  collector.restart(kAllKinds, kNoLimit);
  const std::vector<results::ContactKey> contacts(20000, results::contact_key(2, 3, Kind::touching));
  collector.add(1, contacts);
  EXPECT_EQ(collector.kept().size(), 20000u);
}

TEST(ContactKey, HoldsItsPartsAndSortsInCanonicalOrder) {
  const std::array<std::uint32_t, 5> values{0, 1, 0x3FFFFFFF, 0x7FFFFFFD, 0x7FFFFFFE};
  std::vector<results::ContactKey> all;
  for (const std::uint32_t a : values) {
    for (const std::uint32_t b : values)
      for (const Kind kind : {Kind::crossing, Kind::touching, Kind::coplanar}) {
        all.push_back(results::contact_key(a, b, kind));
        EXPECT_EQ(results::triangle_a(all.back()), a);
        EXPECT_EQ(results::triangle_b(all.back()), b);
        EXPECT_EQ(results::kind_of(all.back()), kind);
      }
  }
  EXPECT_TRUE(std::is_sorted(all.begin(), all.end()));
  EXPECT_EQ(std::set<results::ContactKey>(all.begin(), all.end()).size(), all.size());
}

}  // namespace
}  // namespace impinge
