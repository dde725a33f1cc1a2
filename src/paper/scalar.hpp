// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "paper/batch.hpp"

namespace impinge::paper {

/// The batch's tests in plain C++, a verdict each: the reference that drawn tests are held against.
void test_edges(const Batch& batch, std::vector<Verdict>& verdicts);

/// Folds the tests' verdicts into one a candidate pair. A pair is `crossing` only if both triangles are certainly
/// proper as well.
void fold(const Batch& batch, std::span<const Verdict> tests, std::vector<Verdict>& pairs);

}  // namespace impinge::paper
