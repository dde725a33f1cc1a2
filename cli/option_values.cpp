// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "option_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "numbers.hpp"
#include "report/date.hpp"

namespace impinge::cli {
namespace {

Error bad(std::string sentence) { return {Code::bad_option, std::move(sentence)}; }

Result<void> take_limit(const std::string& text, std::uint64_t& to) {
  if (text.empty()) return {};
  const auto limit = parse_whole(text);
  if (!limit) return bad(fmt::format("--limit takes a whole number from 0 up, not '{}'", text));
  to = *limit;
  return {};
}

Result<void> take_threads(const std::string& text, int& to) {
  if (text.empty()) return {};
  const auto threads = parse_whole(text);
  if (!threads || *threads > 1024)
    return bad(fmt::format("--threads takes a whole number from 0 to 1024, not '{}'", text));
  to = static_cast<int>(*threads);
  return {};
}

Result<void> take_backend(const Raw& raw, CheckArguments& to) {
  constexpr std::string_view kBackends[] = {"auto", "simd", "scalar", "gpu", "raster", "hybrid"};
  if (std::find(std::begin(kBackends), std::end(kBackends), to.backend) == std::end(kBackends))
    return bad(fmt::format("--backend is auto, simd, scalar, gpu, raster or hybrid, not '{}'", to.backend));
  if (raw.device_share.empty()) return {};
  const char* const end = raw.device_share.data() + raw.device_share.size();
  const auto [stop, error] = std::from_chars(raw.device_share.data(), end, to.device_share);
  if (error != std::errc() || stop != end || !(to.device_share >= 0 && to.device_share <= 1))
    return bad(fmt::format("--device-share takes a number from 0 to 1, not '{}'", raw.device_share));
  if (to.backend != "hybrid") return bad("--device-share is for --backend hybrid");
  return {};
}

Result<void> take_scales(const std::vector<std::string>& raw, SceneArguments& to) {
  for (const std::string& text : raw) {
    const std::size_t at = text.rfind('=');
    if (at == std::string::npos)
      return bad(fmt::format("--scale takes FILE=S, such as plate.stl=25.4, not '{}'", text));
    const std::string file = text.substr(0, at);
    const auto factor = parse_positive(std::string_view(text).substr(at + 1));
    if (!factor)
      return bad(fmt::format("--scale {}: '{}' is not a positive number such as 25.4", text, text.substr(at + 1)));
    if (std::find(to.files.begin(), to.files.end(), file) == to.files.end())
      return bad(
          fmt::format("--scale {}: '{}' is none of the files to read; write it as it stands among them", text, file));
    for (const auto& [other, _] : to.scales)
      if (other == file) return bad(fmt::format("--scale is given twice for '{}'", file));
    to.scales.emplace_back(file, *factor);
  }
  return {};
}

Result<void> take_max_file(const std::string& text, std::uint64_t& to) {
  if (text.empty()) return {};
  const auto bytes = parse_bytes(text);
  if (!bytes) return bad(fmt::format("--max-file takes a number of bytes such as 500M or 2G, not '{}'", text));
  to = *bytes;
  return {};
}

Result<void> take_page(const Raw& raw, PageArguments& to) {
  if (!raw.html.empty()) to.html = raw.html;
  if (raw.page_triangles.empty()) return {};
  const auto triangles = parse_whole(raw.page_triangles);
  if (!triangles)
    return bad(fmt::format("--page-triangles takes a whole number from 0 up, not '{}'", raw.page_triangles));
  if (!to.html) return bad("--page-triangles is for the page: name its file with --html FILE");
  to.page_triangles = *triangles;
  return {};
}

Result<void> take_unit(const std::string& text, ExportArguments& to) {
  constexpr std::pair<std::string_view, double> kUnits[] = {
      {"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}};
  if (text.empty()) return {};
  for (const auto& [name, metres] : kUnits)
    if (text == name) return to.metres = metres, Result<void>();
  return bad(fmt::format("--unit is m, cm, mm, in or ft, not '{}'", text));
}

Result<void> take_date(const std::string& text, ExportArguments& to) {
  if (text.empty()) {
    const Result<std::string> date = usual_date();
    if (!date) return date.error();
    to.date = *date;
    return {};
  }
  const std::optional<std::string> date = parse_date(text);
  if (!date) return bad(fmt::format("--date takes now, or a date such as 2024-05-31, not '{}'", text));
  to.date = *date;
  return {};
}

Result<void> take_exports(const Raw& raw, ExportArguments& to) {
  if (!raw.csv.empty()) to.csv = raw.csv;
  if (!raw.bcf.empty()) to.bcf = raw.bcf;
  if (!raw.gltf.empty()) to.gltf = raw.gltf;
  if (!to.bcf && !raw.date.empty()) return bad("--date is for the topics of --bcf FILE");
  if (!to.bcf && !raw.topics.empty()) return bad("--bcf-topics is for the topics of --bcf FILE");
  if (!to.csv && !to.bcf && !to.gltf && !(raw.unit.empty() && raw.up.empty()))
    return bad(fmt::format("{} is for --csv FILE, --bcf FILE and --gltf FILE; nothing else depends on it",
                           raw.unit.empty() ? "--up" : "--unit"));
  if (auto taken = take_unit(raw.unit, to); !taken) return taken;
  if (!raw.up.empty() && raw.up != "y" && raw.up != "z") return bad(fmt::format("--up is y or z, not '{}'", raw.up));
  if (!raw.up.empty()) to.y_up = raw.up == "y";
  constexpr std::uint64_t kMostTopics = 20'000;  // a zip archive counts its members in 16 bits
  if (!raw.topics.empty()) {
    const auto topics = parse_whole(raw.topics);
    if (!topics || *topics > kMostTopics)
      return bad(fmt::format("--bcf-topics takes a whole number from 0 to {}, not '{}'", kMostTopics, raw.topics));
    to.topics = *topics;
  }
  return to.bcf ? take_date(raw.date, to) : Result<void>();
}

/// What `check` and `clash` both take; `--threads` has been taken.
Result<void> take_scene(const Raw& raw, SceneArguments& to) {
  if (!raw.json.empty()) to.json = raw.json;
  for (std::size_t i = 0; i + 1 < raw.ignored.size(); i += 2)
    to.ignored.emplace_back(raw.ignored[i], raw.ignored[i + 1]);
  if (auto taken = take_scales(raw.scales, to); !taken) return taken;
  return take_max_file(raw.max_file, to.max_file_bytes);
}

Result<void> take_tolerance(const std::string& text, std::optional<double>& to) {
  if (text.empty() || text == "auto") return {};
  to = parse_length(text);
  if (to) return {};
  return bad(
      fmt::format("--tolerance takes auto, or a length from 0 up in the files' unit such as 0.01, not '{}'", text));
}

Result<void> take_lengths(const Raw& raw, ClashArguments& to) {
  if (auto taken = take_tolerance(raw.tolerance, to.tolerance); !taken) return taken;
  if (raw.clearance.empty()) return {};
  const auto clearance = parse_length(raw.clearance);
  if (!clearance)
    return bad(
        fmt::format("--clearance takes a length from 0 up in the files' unit such as 2.5, not '{}'", raw.clearance));
  to.clearance = *clearance;
  return {};
}

Result<void> take_triage(const Raw& raw, ClashArguments& to) {
  if (!raw.config.empty()) to.config = raw.config;
  if (!raw.previous.empty()) to.previous = raw.previous;
  if (to.files.empty() && !to.config) return bad("no file to read is named; see impinge clash --help");
  if (raw.group_by.empty() || raw.group_by == "none") return {};
  if (raw.group_by == "part")
    to.group_by = GroupBy::part;
  else if (raw.group_by == "type")
    to.group_by = GroupBy::type;
  else if (raw.group_by == "test" && to.config)
    to.group_by = GroupBy::test;
  else if (raw.group_by == "test")
    return bad("--group-by test needs tests: name their file with --config FILE");
  else
    return bad(fmt::format("--group-by takes part, type, test or none, not '{}'", raw.group_by));
  return {};
}

/// The words of `--fail-on`, of which none is set if none is given.
Result<void> take_words(const std::vector<std::string>& lists, FailOn& to) {
  to = {};
  for (const std::string& list : lists) {
    std::string_view left = list;
    for (bool more = true; more;) {
      const std::size_t comma = left.find(',');
      const std::string_view word = left.substr(0, comma);
      more = comma != std::string_view::npos;
      if (more) left.remove_prefix(comma + 1);
      bool* const named = word == "contact"       ? &to.contact
                          : word == "penetration" ? &to.penetration
                          : word == "inside"      ? &to.inside
                          : word == "clearance"   ? &to.clearance
                          : word == "new"         ? &to.fresh
                                                  : nullptr;
      if (named == nullptr)
        return bad(
            fmt::format("--fail-on takes contact, penetration, inside, clearance or new, or several with commas "
                        "between them, not '{}'",
                        word));
      *named = true;
    }
  }
  return {};
}

Result<void> take_fail_on(const std::vector<std::string>& lists, ClashArguments& to) {
  if (lists.empty() && !to.config) return {};
  if (auto taken = take_words(lists, to.fail_on); !taken) return taken;
  const bool names_verdicts = to.fail_on.contact || to.fail_on.penetration || to.fail_on.inside || to.fail_on.clearance;
  if (to.config && names_verdicts)
    return bad("with --config, the mode of each test says what fails, and --fail-on takes new alone");
  if (to.fail_on.fresh && !to.previous)
    return bad("--fail-on new needs an earlier run to compare with: add --previous FILE, with its JSON");
  if (!names_verdicts) to.fail_on.penetration = to.fail_on.inside = !to.config;
  if (to.fail_on.clearance && to.clearance == 0)
    return bad("--fail-on clearance needs the distance to keep: add --clearance C, with C above 0");
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
  if (to.files.size() > 1) return bad("impinge motion takes one file; what stands still beside it belongs into it");
  if (auto taken = take_tolerance(raw.tolerance, to.tolerance); !taken) return taken.error();
  if (!raw.fail_on.empty()) {
    if (auto taken = take_words(raw.fail_on, to.fail_on); !taken) return taken.error();
    if (to.fail_on.clearance || to.fail_on.fresh)
      return bad("--fail-on of impinge motion takes contact, penetration or inside");
  }
  if (!raw.frames.empty()) {
    const auto frames = parse_whole(raw.frames);
    if (!frames || *frames == 0 || *frames > kMostFrames)
      return bad(fmt::format("--frames takes a whole number from 1 to {}, not '{}'", kMostFrames, raw.frames));
    to.frames = static_cast<std::uint32_t>(*frames);
  }
  if (!raw.animation.empty()) to.animation = raw.animation;
  if (auto taken = take_threads(raw.threads, to.threads); !taken) return taken.error();
  if (auto taken = take_page(raw, to); !taken) return taken.error();
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
