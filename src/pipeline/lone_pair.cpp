// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/lone_pair.hpp"

#include "pipeline/device_driver.hpp"
#include "pipeline/options.hpp"
#include "pipeline/workspace_state.hpp"

namespace impinge {

void begin_lone_pair(const Query& query, const broad::ObjectPair& objects, bool is_timed, Workspace::State& memory) {
  memory.touch.begin(FastStages::Pair(query, objects), query.options, StageClock(is_timed), memory.spare.statistics);
}

bool may_end_at_once(const Query& query) {
  const Options& options = query.options;
  return query.pairs != nullptr && query.pairs->size() <= 1 && !query.all_rows && !options.statistics &&
         !options.predict_cost && options.progress == nullptr &&
         (is_named(options.backend, "simd") ||
          (is_named(options.backend, "auto") && !DeviceDriver::may_help(query, *query.pairs)));
}

bool answer_at_once(const Query& query, Workspace::State& memory) {
  const Options& options = query.options;
  Contacts& answer = memory.spare;
  answer.objects.clear(), answer.offsets.assign(1, 0), answer.triangles.clear(), answer.kinds.clear();
  answer.truncated = false, answer.partial = options.find == Options::Find::first || options.kinds != kAllKinds;
  answer.hash = 0, answer.statistics = {}, answer.warnings.clear();
  if (query.pairs->empty()) return true;
  const broad::ObjectPair& objects = query.pairs->front();
  begin_lone_pair(query, objects, false, memory);
  answer.statistics.object_pairs = 1;
  if (memory.touch.contacts().empty()) return memory.touch.left().empty();
  if (options.find != Options::Find::first || options.limit == 0) return false;
  const results::ContactKey found = memory.touch.contacts().front();
  answer.objects.push_back({objects.a, objects.b}), answer.offsets.push_back(1);
  answer.triangles.push_back({results::triangle_a(found), results::triangle_b(found)});
  answer.kinds.push_back(results::kind_of(found));
  return true;
}

}  // namespace impinge
