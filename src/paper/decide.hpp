// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "exact/contact.hpp"
#include "paper/batch.hpp"
#include "paper/verdict.hpp"

namespace impinge::exact {

/// Appends the contacts of a batch: `crossing` pairs as they are, `unsure` ones decided by exact arithmetic. Returns
/// how many of those there were.
std::uint64_t decide(const partition::Batch& batch, std::span<const narrow::Verdict> pairs,
                     std::vector<Contact>& contacts);

}  // namespace impinge::exact
