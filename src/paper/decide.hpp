// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/contact.hpp"
#include "paper/batch.hpp"

namespace impinge::paper {

/// Appends the contacts of a batch: `crossing` pairs as they are, `unsure` ones decided by exact arithmetic. Returns
/// how many of those there were.
std::uint64_t decide(const Batch& batch, std::span<const Verdict> pairs, std::vector<exact::Contact>& contacts);

}  // namespace impinge::paper
