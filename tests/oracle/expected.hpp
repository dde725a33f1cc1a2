// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <vector>

#include "impinge/contacts.hpp"
#include "impinge/options.hpp"
#include "impinge/scene.hpp"
#include "scenes/scene.hpp"
#include "scenes/solid_pairs.hpp"
#include "tests/core/support.hpp"
#include "tests/core/ways.hpp"

namespace impinge::scenes {
/// For messages of failed tests.
void PrintTo(const Judgement& judgement, std::ostream* out);
}  // namespace impinge::scenes

/// Expected answers, by the oracle's own programs where this build has them (IMPINGE_BUILD_ORACLE). Elsewhere they are
/// those that impinge finds in the plainest way, held to the hash and the counts that the oracle's have in answers.txt.
/// What goes wrong fails the running test with a sentence.
namespace impinge::expected {

using test::Contact;
/// A whole answer is sorted.
using Set = std::vector<Contact>;

/// What the oracle finds by boxes, CGAL's exact predicates and rationals.
Set by_oracle(const scenes::PlacedScene& scene);
/// Its verdict on two solids.
scenes::Judgement judgement(const scenes::SolidPair& pair);
/// What it finds in a model file that it loads itself; `scene`: the same by our reader.
Set of_model(const std::filesystem::path& model, const Scene& scene);

// Of builds with the oracle alone, for its own tests, which keep nothing: the set and the verdict that it computes, the
// set by rationals alone, every triangle against every other, and the verdict on solids put together in another way.
Set computed_set(const scenes::PlacedScene& scene);
scenes::Judgement computed_judgement(const scenes::SolidPair& pair);
Set by_rationals(const scenes::PlacedScene& scene);
scenes::Judgement judgement_by_tetrahedra(const scenes::SolidPair& pair);

/// An answer as a set. Fails the test where its arrays do not fit together, or it is not sorted.
Set listed(const Contacts& contacts);

/// What impinge finds with a `Scene`, and fails the test if it finds an error.
Set by_scene(const scenes::PlacedScene& scene, const Options& options = {});
std::uint64_t hash_by_scene(const scenes::PlacedScene& scene, const Options& options = {});
/// Fails unless a `Scene` finds `expected` in this way, with this hash; and of it the wanted kinds, the first few, and
/// a witness for each pair of objects.
void expect_way(const Set& expected, std::uint64_t hash, const scenes::PlacedScene& scene, const test::Way& way);
/// What it finds with the function `collide` on a scene's two objects, in this order or swapped.
Set by_collide(const scenes::PlacedScene& scene, bool swapped = false);

/// Fails with the counts and first examples of missed, added and misnamed pairs.
void expect_same(const Set& expected, const Set& found);

/// `Scene`, and for two objects `collide` both ways, find `expected` in `scene`, and a few of all ways, drawn by the
/// scene, do so too.
void expect_finds(const Set& expected, const scenes::PlacedScene& scene);
/// .. what the oracle finds. Returns it.
Set expect_exact(const scenes::PlacedScene& scene);

}  // namespace impinge::expected
