// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "pipeline/options.hpp"

#include <string>
#include <utility>

namespace impinge {

bool is_papers_way(const Options& options) {
  return options.backend == "paper" || options.backend == "scalar" || options.backend == "raster";
}

Result<void> validate(const Options& options) {
  const auto bad = [](std::string message) { return Error{Code::bad_option, std::move(message)}; };
  if (options.threads < 0)
    return bad("threads is " + std::to_string(options.threads) + "; choose 0 for all, or a positive number");
  if (options.find != Options::Find::all && options.find != Options::Find::first)
    return bad("find is neither Find::all nor Find::first");
  if (options.kinds > kAllKinds) return bad("kinds has bits beyond kCrossing | kTouching | kCoplanar");
  if (options.adjacency > Adjacency::by_index) return bad("adjacency is neither by_position nor by_index");
  const auto is_one_of = [&](const auto&... names) { return (is_named(options.backend, names) || ...); };
  if (!is_one_of("auto", "simd", "paper", "scalar", "gpu", "raster", "hybrid"))
    return bad("there is no backend '" + std::string(options.backend) +
               "'; choose auto, simd, paper, gpu, raster or hybrid");
  if (!(options.device_share <= 1)) return bad("device_share is not a number up to 1");
  return {};
}

}  // namespace impinge
