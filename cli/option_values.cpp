// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "export_values.hpp"
#include "numbers.hpp"
#include "scene_values.hpp"
#include "verdict_values.hpp"

namespace impinge::cli {
namespace {

Result<void> take_backend(const Raw& raw, CheckArguments& to) {
  constexpr std::string_view kBackends[] = {"auto", "simd", "scalar", "gpu", "raster", "hybrid"};
  if (std::find(std::begin(kBackends), std::end(kBackends), to.backend) == std::end(kBackends))
    return bad_option(fmt::format("--backend is auto, simd, scalar, gpu, raster or hybrid, not '{}'", to.backend));
  if (raw.device_share.empty()) return {};
  const char* const end = raw.device_share.data() + raw.device_share.size();
  const auto [stop, error] = std::from_chars(raw.device_share.data(), end, to.device_share);
  if (error != std::errc() || stop != end || !(to.device_share >= 0 && to.device_share <= 1))
    return bad_option(fmt::format("--device-share takes a number from 0 to 1, not '{}'", raw.device_share));
  if (to.backend != "hybrid") return bad_option("--device-share is for --backend hybrid");
  return {};
}

}  // namespace

Result<Command> take_check(Raw raw) {
  CheckArguments& to = raw.check;
  if (auto taken = take_limit(raw.limit, to.limit); !taken) return taken.error();
  if (auto taken = take_threads(raw.threads, to.threads); !taken) return taken.error();
  if (auto taken = take_backend(raw, to); !taken) return taken.error();
  if (auto taken = take_scene(raw, to); !taken) return taken.error();
  return Command(std::move(to));
}

Result<Command> take_clash(Raw raw) {
  ClashArguments& to = raw.clash;
  if (auto taken = take_lengths(raw, to); !taken) return taken.error();
  if (auto taken = take_triage(raw, to); !taken) return taken.error();
  if (auto taken = take_fail_on(raw.fail_on, to); !taken) return taken.error();
  if (auto taken = take_page(raw, to); !taken) return taken.error();
  if (auto taken = take_exports(raw, to); !taken) return taken.error();
  if (to.y_up && !to.html && !to.csv && !to.bcf && !to.gltf)
    return bad_option("--up is for --html FILE, --csv FILE, --bcf FILE and --gltf FILE; nothing else depends on it");
  // What these tell of a clash.
  if (to.html || to.csv || to.bcf || to.gltf) to.depth = to.regions = true;
  if (to.previous) to.regions = true;
  if (auto taken = take_limit(raw.limit, to.limit); !taken) return taken.error();
  if (auto taken = take_threads(raw.threads, to.threads); !taken) return taken.error();
  if (auto taken = take_scene(raw, to); !taken) return taken.error();
  return Command(std::move(to));
}

Result<Command> take_motion(Raw raw) {
  constexpr std::uint64_t kMostFrames = 1'000'000;
  MotionArguments& to = raw.motion;
  if (to.files.size() > 1)
    return bad_option("impinge motion takes one file; what stands still beside it belongs into it");
  if (auto taken = take_tolerance(raw.tolerance, to.tolerance); !taken) return taken.error();
  if (!raw.fail_on.empty()) {
    if (auto taken = take_words(raw.fail_on, to.fail_on); !taken) return taken.error();
    if (to.fail_on.clearance || to.fail_on.fresh)
      return bad_option("--fail-on of impinge motion takes contact, penetration or inside");
  }
  if (!raw.frames.empty()) {
    const auto frames = parse_whole(raw.frames);
    if (!frames || *frames == 0 || *frames > kMostFrames)
      return bad_option(fmt::format("--frames takes a whole number from 1 to {}, not '{}'", kMostFrames, raw.frames));
    to.frames = static_cast<std::uint32_t>(*frames);
  }
  if (!raw.animation.empty()) to.animation = raw.animation;
  if (auto taken = take_threads(raw.threads, to.threads); !taken) return taken.error();
  if (auto taken = take_page(raw, to); !taken) return taken.error();
  if (to.y_up && !to.html) return bad_option("--up is for the page: name its file with --html FILE");
  if (to.html) to.depth = true;  // what the page shows of a clash
  if (auto taken = take_scene(raw, to); !taken) return taken.error();
  return Command(std::move(to));
}

Result<Command> take_view(Raw raw) {
  ViewArguments& to = raw.view;
  if (raw.html.empty() && !to.files.empty())
    raw.html = std::filesystem::path(to.files.front()).filename().string() + ".html";
  if (auto taken = take_page(raw, to); !taken) return taken.error();
  if (auto taken = take_scene(raw, to); !taken) return taken.error();
  return Command(std::move(to));
}

Result<Command> take_info(Raw raw) {
  if (!raw.json.empty()) raw.info.json = raw.json;
  if (auto taken = take_max_file(raw.max_file, raw.info.max_file_bytes); !taken) return taken.error();
  return Command(std::move(raw.info));
}

}  // namespace impinge::cli
