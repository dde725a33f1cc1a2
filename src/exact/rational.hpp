// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <boost/multiprecision/cpp_int.hpp>

/// Rational numbers: for the few constructions (points, not signs) that must be exact.
namespace impinge::exact {

using Rational = boost::multiprecision::cpp_rational;
using RationalPoint = std::array<Rational, 3>;

}  // namespace impinge::exact
