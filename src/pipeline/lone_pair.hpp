// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#pragma once

#include "broad/object_pairs.hpp"
#include "impinge/workspace.hpp"
#include "pipeline/query.hpp"

/// A query about one pair of objects begins, and mostly ends, on the calling thread.
namespace impinge {

/// Begins with a query's only pair, before any other thread is woken. What it finds and leaves is in `memory.touch`,
/// and what it counts in the answer to be, `memory.spare`.
void begin_lone_pair(const Query& query, const broad::ObjectPair& objects, bool is_timed, Workspace::State& memory);

/// Whether a query about one pair, or none, needs no more of the pipeline than its stages unless it turns out to be
/// large: no device, and nobody asks for its progress or its times.
bool may_end_at_once(const Query& query);

/// Begins a query that `may_end_at_once`. Returns whether `memory.spare` is its answer.
bool answer_at_once(const Query& query, Workspace::State& memory);

}  // namespace impinge
