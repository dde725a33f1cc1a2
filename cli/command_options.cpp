// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "command_options.hpp"

#include <CLI/CLI.hpp>

namespace impinge::cli {
namespace {

void add_files(CLI::App& command, std::vector<std::string>& files) {
  command.set_help_flag("--help,-h", "this page");
  command.add_option("FILE", files, "")->required()->type_name("");
}

void add_json(CLI::App& command, Raw& raw, const std::string& what) {
  command
      .add_option("--json", raw.json,
                  "write the " + what + " as JSON to a file, or to standard output (-) in place of the table")
      ->type_name("FILE|-");
}

void add_threads(CLI::App& command, Raw& raw) {
  command.add_option("--threads", raw.threads, "work on N threads, 0 for as many as the machine has (default: 0)")
      ->type_name("N");
}

void add_tolerance(CLI::App& command, Raw& raw, const std::string& what) {
  command.add_option("--tolerance", raw.tolerance, what + " (default: auto)")->type_name("auto|0|D");
}

void add_depth(CLI::App& command, bool& depth) {
  command.add_flag("--depth", depth, "measure how deep the solids that overlap reach into each other");
}

/// `words` are those that the command takes.
void add_fail_on(CLI::App& command, Raw& raw, const std::string& words, const std::string& more) {
  command
      .add_option(
          "--fail-on", raw.fail_on,
          words + ", or several with commas between them; may be given again (default: penetration,inside)" + more)
      ->type_name("LIST")
      ->allow_extra_args(false);
}

void add_ignore(CLI::App& command, Raw& raw) {
  command
      .add_option("--ignore", raw.ignored,
                  "leave out all pairs of an object named A and one named B; * stands for any characters, ? for one; "
                  "may be given again")
      ->type_name("A B")
      ->type_size(2)
      ->allow_extra_args(false);
}

void add_scale(CLI::App& command, Raw& raw) {
  command.add_option("--scale", raw.scales, "multiply the coordinates of one of the files by S; may be given again")
      ->type_name("FILE=S")
      ->allow_extra_args(false);
}

void add_max_file(CLI::App& command, Raw& raw) {
  command.add_option("--max-file", raw.max_file, "refuse larger files unread: bytes, or 500M, 2G (default: 2G)")
      ->type_name("BYTES");
}

void add_page_triangles(CLI::App& command, Raw& raw) {
  command
      .add_option("--page-triangles", raw.page_triangles,
                  "draw about N triangles at most on the page; larger meshes are simplified there (default: 1000000)")
      ->type_name("N");
}

void add_up(CLI::App& command, Raw& raw, const std::string& outputs) {
  command
      .add_option(
          "--up", raw.up,
          "which of the coordinates' axes is up, for " + outputs +
              ": y or z (default: by the formats: z if all files are OBJ, OFF, PLY, STL or AMF, else that of the "
              "first other one: z for 3MF and Blender, y for the rest)")
      ->type_name("y|z");
}

void add_exports(CLI::App& command, Raw& raw) {
  command
      .add_option("--csv", raw.csv,
                  "write a table for spreadsheets, a row for each pair; includes --depth and --regions")
      ->type_name("FILE|-");
  command
      .add_option("--bcf", raw.bcf,
                  "write BCF 2.1 for BIM tools: a topic with viewpoint and picture for each pair that fails; includes "
                  "--depth and --regions")
      ->type_name("FILE");
  command
      .add_option("--gltf", raw.gltf,
                  "write the regions of contact as binary glTF, lines and points for other viewers; includes --depth "
                  "and --regions")
      ->type_name("FILE");
  command
      .add_option("--unit", raw.unit,
                  "the unit of the files' coordinates, for CSV, BCF and glTF, which have metres: m, cm, mm, in or ft "
                  "(default: m)")
      ->type_name("UNIT");
  command
      .add_option("--date", raw.date,
                  "of the BCF's topics: now, 2024-05-31 or 2024-05-31T16:30:00Z (default: SOURCE_DATE_EPOCH, or the "
                  "start of 1970)")
      ->type_name("DATE");
  command.add_option("--bcf-topics", raw.topics, "the worst N pairs at most become topics of the BCF (default: 1000)")
      ->type_name("N");
}

void add_quiet(CLI::App& command, bool& quiet) {
  command.add_flag("--quiet", quiet, "print no table, no progress and no warnings");
}

}  // namespace

void add_check(CLI::App& command, Raw& raw) {
  CheckArguments& to = raw.check;
  add_files(command, to.files);
  add_json(command, raw, "answer");
  command.add_flag("--triangles", to.triangles, "list every pair of triangles in the JSON")->needs("--json");
  command.add_flag("--first", to.first,
                   "only whether objects touch, with one pair of triangles as the witness; faster, and without a hash");
  command
      .add_option("--limit", raw.limit, "keep only the first N pairs of triangles, in order of objects and triangles")
      ->type_name("N");
  add_threads(command, raw);
  command
      .add_option(
          "--backend", to.backend,
          "what does the work: auto (simd), simd, scalar (the plain reference), gpu (a device), raster (the "
          "paper's way: a device draws the tests), or hybrid (a device and the CPU together); the answer is the "
          "same")
      ->type_name("NAME");
  command
      .add_option(
          "--device", to.device,
          "which device gpu, raster and hybrid use: its number or part of its name, see impinge devices (default: "
          "IMPINGE_DEVICE, or the first)")
      ->type_name("N|NAME");
  command
      .add_option("--device-share", raw.device_share,
                  "how much of the work hybrid gives to the device, from 0 to 1 (default: what ends soonest)")
      ->type_name("S");
  add_ignore(command, raw);
  add_scale(command, raw);
  add_max_file(command, raw);
  add_quiet(command, to.quiet);
  command.add_flag("--stats", to.stats, "print what was done at each stage, and the time predicted and measured");
}

void add_clash(CLI::App& command, Raw& raw) {
  ClashArguments& to = raw.clash;
  add_files(command, to.files);
  command.get_option("FILE")->required(false);  // a configuration may name them
  command
      .add_option(
          "--config", raw.config,
          "named tests between groups of parts, each with its mode, tolerance, clearance and exceptions, from a "
          "file (docs/triage.md); clash sets of IfcClash are read too")
      ->type_name("FILE");
  add_tolerance(
      command, raw,
      "parts that overlap by no more than D touch; 0: exactly; auto: what rounding leaves in the files, 2^-20 "
      "of a pair's largest coordinate");
  command
      .add_option("--clearance", raw.clearance,
                  "list parts that are nearer to each other than C as well, with their distance")
      ->type_name("C");
  add_depth(command, to.depth);
  command.add_flag("--regions", to.regions,
                   "find the regions of contact, with place, area, normal and lines in the JSON");
  add_fail_on(command, raw, "what makes the exit code 1: contact, penetration, inside, clearance",
              "; with new, only what is new since --previous");
  add_json(command, raw, "verdicts");
  command
      .add_option("--html", raw.html,
                  "write a page to look at: the assembly, the list of clashes, each in its place; includes --depth and "
                  "--regions")
      ->type_name("FILE");
  add_page_triangles(command, raw);
  command
      .add_option("--previous", raw.previous,
                  "the JSON of an earlier run: say what is new, what persists and what is resolved since then, and "
                  "keep the status and comments written in it; includes --regions")
      ->type_name("FILE");
  command
      .add_option("--group-by", raw.group_by,
                  "a row for each part, each two types of part (instances of one mesh) or each test, and what clashes "
                  "there: part, type, test or none (default: none)")
      ->type_name("WHAT");
  add_exports(command, raw);
  add_up(command, raw, "the page, CSV, BCF and glTF");
  command.add_option("--limit", raw.limit, "print only the first N rows of the table; the JSON stays whole")
      ->type_name("N");
  add_ignore(command, raw);
  command.add_flag("--within-products", to.within_products,
                   "test the parts of one IFC product against each other as well");
  add_scale(command, raw);
  add_threads(command, raw);
  add_max_file(command, raw);
  add_quiet(command, to.quiet);
}

void add_motion(CLI::App& command, Raw& raw) {
  MotionArguments& to = raw.motion;
  add_files(command, to.files);
  command
      .add_option("--frames", raw.frames,
                  "look at N steps of equal length; what is over within one of them may be missed (default: 120)")
      ->type_name("N");
  command
      .add_option("--animation", raw.animation,
                  "which of the file's animations, by name or number (default: the first)")
      ->type_name("NAME|N");
  add_tolerance(command, raw, "as with impinge clash");
  add_depth(command, to.depth);
  add_fail_on(command, raw, "what is a clash: contact, penetration, inside", "");
  add_json(command, raw, "times");
  command.add_option("--html", raw.html, "write a page to look at, with the motion on a timeline")->type_name("FILE");
  add_page_triangles(command, raw);
  add_up(command, raw, "the page");
  add_ignore(command, raw);
  add_threads(command, raw);
  add_max_file(command, raw);
  add_quiet(command, to.quiet);
}

void add_view(CLI::App& command, Raw& raw) {
  ViewArguments& to = raw.view;
  add_files(command, to.files);
  command.add_option("--html", raw.html, "the page to write (default: the first file's name with .html after it)")
      ->type_name("FILE");
  add_page_triangles(command, raw);
  add_up(command, raw, "the page");
  add_scale(command, raw);
  add_max_file(command, raw);
  add_quiet(command, to.quiet);
}

void add_info(CLI::App& command, Raw& raw) {
  add_files(command, raw.info.files);
  add_json(command, raw, "list");
  add_max_file(command, raw);
}

}  // namespace impinge::cli
