// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "contact.hpp"

namespace oracle {

struct Counts {
  std::uint64_t candidates = 0;  ///< pairs of triangles whose boxes meet
  std::uint64_t rationals = 0;   ///< of them, decided by rational.hpp
};

/// Every pair of triangles of different objects that share a point, sorted. Boxes, then CGAL's exact predicates, then
/// rationals where those leave the kind open.
std::vector<Contact> contacts_of(const std::vector<WorldObject>& objects, Counts& counts);

/// The same from rationals alone, every triangle against every other: slow, and with nothing to get wrong.
std::vector<Contact> contacts_by_rationals(const std::vector<WorldObject>& objects);

}  // namespace oracle
