// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "command_options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>

#include "date.hpp"
#include "numbers.hpp"
#include "report/units.hpp"

namespace impinge::cli {
namespace {

constexpr std::uint64_t kMostWhole = std::numeric_limits<std::uint64_t>::max();
constexpr double kMostLength = std::numeric_limits<double>::max();

[[noreturn]] void refuse(std::string sentence) { throw CLI::ValidationError(std::move(sentence)); }

/// An option that takes a number from `least` to `most`, or the word for what holds by default.
template <class T, class To>
CLI::Option* add_number(CLI::App& command, const std::string& name, To& to, T least, T most, const std::string& about,
                        const std::string& word = {}) {
  const auto take = [=, &to](const std::string& text) {
    if (!word.empty() && text == word) return;
    const std::optional<T> number = parse_number<T>(text);
    if (!number || !(*number >= least && *number <= most))
      refuse(fmt::format("{} takes {}a {}number from {} {}, not '{}'", name, word.empty() ? "" : word + " or ",
                         std::is_integral_v<T> ? "whole " : "", least,
                         most == std::numeric_limits<T>::max() ? "up" : fmt::format("to {}", most), text));
    to = static_cast<To>(*number + T{});  // which makes 0 of -0
  };
  return command.add_option_function<std::string>(name, take, about)->type_name("N");
}

/// An option that takes one of a few words, each of which stands for a value.
template <class T, class To>
CLI::Option* add_choice(CLI::App& command, const std::string& name, To& to,
                        const std::vector<std::pair<std::string, T>>& choices, const std::string& about) {
  std::string words;
  for (const auto& [word, _] : choices) words += (words.empty() ? "" : "|") + word;
  const auto take = [=, &to](const std::string& text) {
    const auto chosen = std::find_if(choices.begin(), choices.end(), [&](const auto& c) { return c.first == text; });
    if (chosen == choices.end()) refuse(fmt::format("{} takes {}, not '{}'", name, words, text));
    to = chosen->second;
  };
  return command.add_option_function<std::string>(name, take, about)->type_name(words);
}

CLI::Option* add_files(CLI::App& command, std::vector<std::string>& files) {
  return command.add_option("FILE", files, "meshes, read as one scene in the coordinates that they have")
      ->type_name("...")
      ->required();
}

void add_json(CLI::App& command, std::optional<std::string>& json, const std::string& what) {
  command
      .add_option("--json", json,
                  "write the " + what + " as JSON to a file, or to standard output (-) in place of the table")
      ->type_name("FILE|-");
}

void add_output(CLI::App& command, const std::string& name, std::optional<std::string>& file,
                const std::string& about) {
  command.add_option(name, file, about)->type_name(name == "--csv" || name == "--matrix" ? "FILE|-" : "FILE");
}

void add_threads(CLI::App& command, int& threads) {
  add_number(command, "--threads", threads, 0, 1024,
             "work on N threads, 0 for as many as the machine has (default: 0)");
}

/// An option that takes a length, or the word for what holds by default.
template <class To>
CLI::Option* add_length(CLI::App& command, const std::string& name, To& to, const std::string& about,
                        const std::string& word = {}) {
  const auto take = [=, &to](const std::string& text) {
    if (!word.empty() && text == word) return;
    const std::optional<Length> length = parse_length(text);
    if (!length)
      refuse(
          fmt::format("{} takes {}a length from 0 up, such as 10 or 10mm, not '{}'; the units are m, cm, mm, in and ft",
                      name, word.empty() ? "" : word + " or ", text));
    to = *length;
  };
  return command.add_option_function<std::string>(name, take, about);
}

void add_tolerance(CLI::App& command, std::optional<Length>& tolerance) {
  add_length(command, "--tolerance", tolerance,
             "parts that reach into each other by no more than D touch; 0: exactly; auto: what rounding leaves of the "
             "files' coordinates; a length may have a unit, as 10mm has (default: auto)",
             "auto")
      ->type_name("auto|0|D");
}

void add_depth(CLI::App& command, double& precision) {
  const auto take = [&precision](const std::string& text) {
    const std::optional<double> share = parse_number<double>(text);
    if (text == "none")
      precision = std::numeric_limits<double>::infinity();
    else if (share && *share > 0 && *share <= 1)
      precision = *share;
    else
      refuse(fmt::format("--depth takes none or a share of the depth, above 0 and up to 1, not '{}'", text));
  };
  command
      .add_option_function<std::string>("--depth", take,
                                        "measure depths to a share P of them, such as 0.01; none: verdicts alone, "
                                        "which is faster (default: 0.05)")
      ->type_name("P|none");
}

void add_fail_on(CLI::App& command, FailOn& to, const std::vector<std::string>& names, const std::string& about) {
  const auto take = [&to](const std::vector<std::string>& words) {
    const auto given = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
    to = {given("contact"), given("penetration"), given("inside"), given("clearance"), given("new")};
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--fail-on", take,
          fmt::format("{}, one or several with commas between them: {} (default: penetration,inside)", about,
                      fmt::join(names, ", ")))
      ->type_name("LIST")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::IsMember(names).description(""));
}

void add_ignore(CLI::App& command, SceneOptions& to) {
  command
      .add_option("--ignore", to.ignored,
                  "leave out all pairs of an object named A and one named B; * stands for any characters, ? for one; "
                  "class:IfcWall, file:steel*.ifc and storey:'Level 1' name those of a class, a file or a storey; may "
                  "be given again")
      ->type_name("A B")
      ->allow_extra_args(false);
}

void add_scale(CLI::App& command, SceneOptions& to) {
  const auto take = [&to](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) {
      const std::size_t at = text.rfind('=');
      if (at == std::string::npos) refuse(fmt::format("--scale takes FILE=S, such as plate.stl=25.4, not '{}'", text));
      const std::string file = text.substr(0, at), number = text.substr(at + 1);
      const std::optional<double> factor = parse_number<double>(number);
      if (!factor || !(*factor > 0 && *factor <= kMostLength))
        refuse(fmt::format("--scale {}: '{}' is not a positive number such as 25.4", text, number));
      for (const auto& [other, _] : to.scales)
        if (other == file) refuse(fmt::format("--scale is given twice for '{}'", file));
      to.scales.emplace_back(file, *factor);
    }
  };
  command
      .add_option_function<std::vector<std::string>>(
          "--scale", take, "multiply the coordinates of one of the files by S; may be given again")
      ->type_name("FILE=S")
      ->allow_extra_args(false);
}

template <class Options>
void add_unit(CLI::App& command, Options& to, const std::string& what) {
  add_choice<double>(command, "--unit", to.unit_in_metres, named_units(), what);
}

/// Of commands that make one scene of several files.
void add_scene_unit(CLI::App& command, SceneOptions& to) {
  add_unit(command, to,
           "the unit of all lengths and places: files that say their own are brought to it, others are taken to be in "
           "it (default: that of the first file that says its own)");
}

void check_scales(const SceneOptions& arguments) {
  for (const auto& [file, _] : arguments.scales)
    if (std::find(arguments.files.begin(), arguments.files.end(), file) == arguments.files.end())
      refuse(fmt::format("--scale {}: it is none of the files to read; write it as it stands among them", file));
}

void add_skip_unreadable(CLI::App& command, bool& skip) {
  command.add_flag("--skip-unreadable", skip, "go on without files that cannot be read, and say so with every answer");
}

void add_max_file(CLI::App& command, std::uint64_t& bytes) {
  command.add_option("--max-file", bytes, "refuse larger files unread: bytes, or 500M, 2G (default: 2G)")
      ->transform(CLI::AsSizeValue(true).description(""))
      ->check([](const std::string& text) { return text.starts_with('-') ? "Value " + text + " is negative" : ""; })
      ->type_name("BYTES");
}

CLI::Option* add_page_triangles(CLI::App& command, PageOptions& to) {
  return add_number(
      command, "--page-triangles", to.page_triangles, std::uint64_t{0}, kMostWhole,
      "draw about N triangles at most on the page; larger meshes are simplified there (default: 1000000)");
}

CLI::Option* add_up(CLI::App& command, PageOptions& to, const std::string& outputs) {
  return add_choice<bool>(command, "--up", to.y_up, {{"y", true}, {"z", false}},
                          "which of the coordinates' axes is up, for " + outputs +
                              " (default: by the formats: z if all files are OBJ, OFF, PLY, STL or AMF, else that of "
                              "the first other one: z for 3MF and Blender, y for the rest)");
}

void add_backend(CLI::App& command, std::string& backend) {
  command
      .add_option(
          "--backend", backend,
          "what does the work: auto (simd, or hybrid for long work where a GPU is), simd, paper (the paper's method, "
          "plainly), gpu (a device), raster (the paper's way in image space: a device draws the tests), or hybrid (a "
          "device, the CPU or both, whichever is quickest); the answer is the same")
      ->type_name("NAME")
      ->check(CLI::IsMember({"auto", "simd", "paper", "scalar", "gpu", "raster", "hybrid"}).description(""));
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet", quiet, "print no table, no progress and no warnings");
}

void add_force(CLI::App& command, bool& force) {
  command.add_flag("--force", force, "replace files even if their names do not end in .json, .html and so on");
}

/// The options that follow stand under this heading of the help page.
void begin_group(CLI::App& command, const std::string& heading) { command.option_defaults()->group(heading); }

void add_check(CLI::App& command, CheckArguments& to) {
  add_files(command, to.files);
  begin_group(command, "Answer");
  add_json(command, to.json, "answer");
  command.add_flag("--triangles", to.triangles, "list every pair of triangles in the JSON")->needs("--json");
  command.add_flag("--first", to.first,
                   "only whether objects touch, with one pair of triangles as the witness; faster, and without a hash");
  command.add_flag("--self", to.self, "test each object against itself too, but for neighbouring triangles as such");
  add_number(command, "--limit", to.limit, std::uint64_t{0}, kMostWhole,
             "keep only the first N pairs of triangles, in order of objects and triangles");
  add_ignore(command, to);
  add_quiet(command, to.quiet);
  add_force(command, to.force);
  command.add_flag("--stats", to.stats, "print what was done at each stage, and the time predicted and measured");
  begin_group(command, "Reading");
  add_scene_unit(command, to);
  add_scale(command, to);
  add_skip_unreadable(command, to.skip_unreadable);
  add_max_file(command, to.max_file_bytes);
  begin_group(command, "Work");
  add_threads(command, to.threads);
  add_backend(command, to.backend);
  command
      .add_option("--device", to.device,
                  "which device gpu, raster and hybrid use: its number or part of its name, see impinge devices "
                  "(default: IMPINGE_DEVICE, or the first)")
      ->type_name("N|NAME");
  add_number(command, "--device-share", to.device_share, 0.0, 1.0,
             "how much of the work hybrid gives to the device, from 0 to 1 (default: what ends soonest)")
      ->type_name("S");
  command.final_callback([&to] {
    if (to.device_share >= 0 && to.backend != "hybrid") refuse("--device-share is for --backend hybrid");
    check_scales(to);
  });
}

/// What the options of `clash` ask of each other, and what some of them include.
void complete(ClashArguments& to, bool fail_on_given) {
  if (to.files.empty() && !to.config) refuse("no file to read is named");
  if (to.group_by == GroupBy::test && !to.config)
    refuse("--group-by test needs tests: name their file with --config FILE");
  const bool names_verdicts = to.fail_on.contact || to.fail_on.penetration || to.fail_on.inside || to.fail_on.clearance;
  if (to.config && fail_on_given && names_verdicts)
    refuse("with --config, the mode of each test says what fails, and --fail-on takes new alone");
  if (to.fail_on.fresh && !to.previous)
    refuse("--fail-on new needs an earlier run to compare with: add --previous FILE, with its JSON");
  if (to.fail_on.clearance && to.clearance.value == 0)
    refuse("--fail-on clearance needs the distance to keep: add --clearance C, with C above 0");
  // The tests of a configuration say themselves what fails; "new" alone is of what fails by default.
  if (to.config || !names_verdicts) to.fail_on.penetration = to.fail_on.inside = !to.config;
  if (!to.html && !to.csv && !to.bcf && !to.gltf && to.y_up)
    refuse("--up is for --html FILE, --csv FILE, --bcf FILE and --gltf FILE; nothing else depends on it");
  if (to.bcf && to.date.empty()) {
    Result<std::string> date = usual_date();
    if (!date) refuse(date.error().message);
    to.date = *std::move(date);
  }
  // These outputs tell the regions of each clash.
  if (to.html || to.csv || to.bcf || to.gltf || to.previous) to.regions = true;
  if (!to.config) check_scales(to);  // a configuration names files too; they are read later
}

void add_exports(CLI::App& command, ClashArguments& to) {
  add_output(command, "--csv", to.csv, "write a table for spreadsheets, a row for each pair; includes --regions");
  add_output(command, "--matrix", to.matrix,
             "write a table of how many pairs fail between each two files, IFC classes and storeys");
  add_output(command, "--bcf", to.bcf,
             "write BCF for BIM tools: a topic with viewpoint and picture for each pair that fails; includes "
             "--regions");
  add_choice<BcfVersion>(command, "--bcf-version", to.bcf_version,
                         {{"2.1", BcfVersion::v2_1}, {"3.0", BcfVersion::v3_0}}, "of the BCF (default: 2.1)")
      ->needs("--bcf");
  constexpr std::uint64_t kMostTopics = 20'000;  // a zip archive counts its members in 16 bits
  add_number(command, "--bcf-topics", to.topics, std::uint64_t{0}, kMostTopics,
             "the worst N pairs at most become topics of the BCF (default: 1000)")
      ->needs("--bcf");
  to.date.clear();  // SOURCE_DATE_EPOCH says it where the option does not
  const auto add_date = [&command](const std::string& option, std::string& date, const std::string& help) {
    const auto take = [option, &date](const std::string& text) {
      const std::optional<std::string> taken = parse_date(text);
      if (!taken) refuse(fmt::format("{} takes now, or a date such as 2024-05-31, not '{}'", option, text));
      date = *taken;
    };
    command.add_option_function<std::string>(option, take, help)->type_name("DATE")->needs("--bcf");
  };
  add_date("--date", to.date,
           "of the BCF's topics: now, 2024-05-31 or 2024-05-31T16:30:00Z (default: SOURCE_DATE_EPOCH, or now)");
  add_date("--due", to.due, "by when the BCF's topics are to be done, such as 2024-06-14");
  command.add_option("--stage", to.stage, "of the project, in the BCF's topics")->type_name("NAME")->needs("--bcf");
  command.add_option("--author", to.author, "of the BCF's topics and comments (default: impinge)")
      ->type_name("NAME")
      ->check([](const std::string& text) {
        return text.find_first_not_of(" \t") == std::string::npos ? "an author has a name" : "";
      })
      ->needs("--bcf");
  add_output(command, "--gltf", to.gltf,
             "write the regions of contact as binary glTF, lines and points for other viewers; includes --regions");
  add_up(command, to, "the page, CSV, BCF and glTF");
}

void add_clash(CLI::App& command, ClashArguments& to) {
  add_files(command, to.files)->required(false);  // a configuration may name them
  begin_group(command, "What is a clash");
  add_output(command, "--config", to.config,
             "named tests between groups of parts, each with its mode, tolerance, clearance and exceptions, from a "
             "file (docs/triage.md); clash sets of IfcClash are read too");
  add_tolerance(command, to.tolerance);
  add_length(command, "--clearance", to.clearance,
             "list parts that are nearer to each other than C as well, with their distance")
      ->type_name("C");
  add_ignore(command, to);
  command.add_option("--between", to.between, "only pairs of a part of the one file and a part of the other")
      ->type_name("FILE FILE");
  command.add_flag("--within-products", to.within_products,
                   "test the parts of one IFC product against each other as well");
  add_fail_on(command, to.fail_on, {"contact", "penetration", "inside", "clearance", "new"},
              "what makes the exit code 1");
  add_output(command, "--previous", to.previous,
             "the JSON of an earlier run: say what is new, what persists and what is resolved since then; includes "
             "--regions");
  add_output(
      command, "--decisions", to.decisions,
      "what people decided about pairs: a status, comment and assignee for each, in JSON by its id or by two names of "
      "parts, "
      "in a table that --csv wrote, or in BCF (docs/triage.md); it is only read");
  begin_group(command, "What is told of it");
  add_depth(command, to.depth_precision);
  command.add_flag("--volume", to.volumes, "find how much space two solids that overlap have in common");
  command.add_flag("--regions", to.regions,
                   "find the regions of contact, with place, area, normal and lines in the JSON");
  add_choice<GroupBy>(
      command, "--group-by", to.group_by,
      {{"part", GroupBy::part}, {"type", GroupBy::type}, {"test", GroupBy::test}, {"none", GroupBy::none}},
      "a row for each part, each two types of part (instances of one mesh) or each test, and what clashes there "
      "(default: none)");
  add_number(command, "--limit", to.limit, std::uint64_t{0}, kMostWhole,
             "print only the first N rows of the table; the JSON stays whole");
  add_quiet(command, to.quiet);
  add_force(command, to.force);
  begin_group(command, "Files to write");
  add_json(command, to.json, "verdicts");
  add_output(command, "--html", to.html,
             "write a page to look at: the assembly, the list of clashes, each in its place; includes --regions");
  add_page_triangles(command, to)->needs("--html");
  add_exports(command, to);
  begin_group(command, "Reading and work");
  add_scene_unit(command, to);
  add_scale(command, to);
  add_skip_unreadable(command, to.skip_unreadable);
  add_max_file(command, to.max_file_bytes);
  add_threads(command, to.threads);
  add_backend(command, to.backend);
  command.final_callback([&] { complete(to, command.count("--fail-on") > 0); });
}

void add_motion(CLI::App& command, MotionArguments& to) {
  add_files(command, to.files)->description("one file with an animation, of glTF or another format");
  begin_group(command, "What is looked at");
  add_number(command, "--frames", to.frames, 1U, 1'000'000U,
             "look at N steps of equal length, and follow parts between them (default: 120)");
  command
      .add_option("--animation", to.animation, "which of the file's animations, by name or number (default: the first)")
      ->type_name("NAME|N");
  add_ignore(command, to);
  begin_group(command, "What is a clash");
  add_tolerance(command, to.tolerance);
  add_depth(command, to.depth_precision);
  add_fail_on(command, to.fail_on, {"contact", "penetration", "inside"}, "what is a clash");
  begin_group(command, "Output");
  add_json(command, to.json, "times");
  add_output(command, "--html", to.html, "write a page to look at, with the motion on a timeline");
  add_page_triangles(command, to)->needs("--html");
  add_up(command, to, "the page")->needs("--html");
  add_quiet(command, to.quiet);
  add_force(command, to.force);
  begin_group(command, "Reading and work");
  add_unit(
      command, to,
      "the unit of all lengths and places: the file is brought to it, or taken to be in it (default: the file's own)");
  add_max_file(command, to.max_file_bytes);
  add_threads(command, to.threads);
  command.final_callback([&to] {
    if (to.files.size() > 1) refuse("impinge motion takes one file; what stands still beside it belongs into it");
  });
}

void add_impacts(CLI::App& command, ImpactsArguments& to) {
  add_files(command, to.files)
      ->description(
          "the states in order of time, with the same triangles: two or more files, or one name with # for each "
          "digit of a number, as in frame_####.ply");
  begin_group(command, "Answer");
  command.add_flag("--self", to.self, "test each part against itself too, but for features with a common vertex");
  command.add_flag("--earliest", to.earliest, "only the first impact of all; faster");
  add_length(command, "--separation", to.separation,
             "find what comes within D, and not only what meets: certified, and not exact as at 0")
      ->type_name("D");
  add_number(command, "--limit", to.limit, std::uint64_t{0}, kMostWhole,
             "keep only the first N impacts, in order of states, parts and features");
  add_json(command, to.json, "impacts");
  add_output(command, "--csv", to.csv, "write a table for spreadsheets, a row for each impact");
  add_quiet(command, to.quiet);
  add_force(command, to.force);
  begin_group(command, "Reading and work");
  add_unit(command, to,
           "the unit of all places: files that say their own are brought to it, others are taken to be in it (default: "
           "that of the first file)");
  add_max_file(command, to.max_file_bytes);
  add_threads(command, to.threads);
}

void add_view(CLI::App& command, ViewArguments& to) {
  add_files(command, to.files);
  begin_group(command, "Options");
  add_output(command, "--html", to.html, "the page to write (default: the first file's name with .html after it)");
  add_page_triangles(command, to);
  add_up(command, to, "the page");
  add_scene_unit(command, to);
  add_scale(command, to);
  add_skip_unreadable(command, to.skip_unreadable);
  add_max_file(command, to.max_file_bytes);
  add_quiet(command, to.quiet);
  add_force(command, to.force);
  command.final_callback([&to] {
    if (!to.html) to.html = std::filesystem::path(to.files.front()).filename().string() + ".html";
    check_scales(to);
  });
}

void add_info(CLI::App& command, InfoArguments& to) {
  add_files(command, to.files)->description("meshes");
  begin_group(command, "Options");
  add_json(command, to.json, "list");
  add_unit(command, to, "tell lengths and places of files that say their own unit in this one");
  add_max_file(command, to.max_file_bytes);
  add_force(command, to.force);
}

}  // namespace

void add_commands(CLI::App& program, AllArguments& to) {
  const auto add = [&](const char* name, const HelpPage& page) -> CLI::App& {
    return *program.add_subcommand(name, page.about)->group("Commands")->footer(page.end);
  };
  add_check(add("check", kCheckHelp), to.check);
  add_clash(add("clash", kClashHelp), to.clash);
  add_motion(add("motion", kMotionHelp), to.motion);
  add_impacts(add("impacts", kImpactsHelp), to.impacts);
  add_view(add("view", kViewHelp), to.view);
  add_info(add("info", kInfoHelp), to.info);
  add("devices", kDevicesHelp);
  for (CLI::App* command : program.get_subcommands({})) command->set_help_flag("-h,--help", "print this page");
}

}  // namespace impinge::cli
