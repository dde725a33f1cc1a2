// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "command_options.hpp"

namespace impinge::cli {

constexpr std::size_t kPageWidth = 80, kOptionWidth = 25;

HelpFormatter::HelpFormatter() {
  column_width(kOptionWidth);
  label("Positionals", "Files");
  label("OPTIONS", "options");
  label("SUBCOMMAND", "COMMAND");
}

std::string HelpFormatter::make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const {
  return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, name, mode), "\n\n\n", "\n\n");
}

std::string HelpFormatter::make_subcommand(const CLI::App* command) const {
  const std::string about = command->get_description();
  return fmt::format("  {:<9}{}\n", command->get_name(), about.substr(0, about.find('\n')));
}

std::string HelpFormatter::make_option_opts(const CLI::Option* option) const {
  return option->get_type_size() == 0 ? "" : " " + option->get_type_name();
}

std::string HelpFormatter::make_option_desc(const CLI::Option* option) const {
  std::string lines, line;
  for (const std::string& word : CLI::detail::split(option->get_description(), ' ')) {
    if (!line.empty() && kOptionWidth + line.size() + 1 + word.size() > kPageWidth) {
      lines += line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return lines + line;
}

namespace {

/// What each exit code means; an empty `some`: there is no 1.
std::string exit_codes(std::string_view none, std::string_view some,
                       std::string_view failed =
                           "an error or an interruption; a sentence on standard error says what "
                           "and\n     where") {
  return fmt::format("\n\nExit codes:\n  0  {}\n{}  2  {}", none, some.empty() ? "" : fmt::format("  1  {}\n", some),
                     failed);
}

}  // namespace

const HelpPage kProgramHelp{
    R"(Finds every pair of triangles that touch between the objects of mesh files,
exactly: no tolerance, nothing missed, nothing made up. Triangles that share a
single point touch.
)",
    R"(Files: OBJ, OFF, PLY and STL, read in double precision; IFC through web-ifc,
which needs Node.js; 3MF through lib3mf; glTF, GLB, COLLADA, FBX and others
through assimp.
Several files make one scene, in the coordinates that they have; files that say
their unit are brought to that of --unit, or of the first of them.

Examples:
  impinge check engine.obj fixture.stl
      A table of the objects that touch.
  impinge clash engine.obj fixture.stl
      A table of what an engineer should look at, worst first.
  impinge info engine.obj
      Look at a file before trusting it.
  impinge clash --help
      All about a command, with examples.)" +
        exit_codes("nothing touches",
                   "something touches; with clash and motion, something that --fail-on names;\n     with impacts, "
                   "something that meets on the way")};

const HelpPage kCheckHelp{
    R"(Which objects touch, and in how many triangles

Reads all files as one scene and finds every pair of triangles of two different
objects that share a point, within a file and between files. The table counts
them for each pair of objects:
  crossing   the triangles cut through each other
  touching   they only touch, at a corner, along an edge, or with a triangle
             that has no area
  coplanar   they lie in one plane and share a point, as flush faces do
)",
    R"(Examples:
  impinge check engine.obj fixture.stl
      Which objects touch?
  impinge check engine.obj fixture.stl --json clashes.json --triangles
      The same as JSON, with every pair of triangles.
  impinge check robot.ply cell.off --first --quiet && echo free
      Only yes or no, by the exit code: the fastest question.
  impinge check bracket.stl plate.stl --scale plate.stl=25.4
      plate.stl is in inches, bracket.stl in millimetres.
  impinge check robot.ply cell.off --ignore 'rob*' cell
      Leave out pairs that are meant to touch.)" +
        exit_codes("nothing touches", "something touches")};

const HelpPage kClashHelp{
    R"(What parts are to each other: penetrating, inside, touching, near

Reads all files as one scene and says of each two parts how deep one reaches
into the other, worst first. A part is a solid if it is closed; cracked if it is
not, but it is clear at its open edges what is inside; else a surface, and the
report says where it is open. What reaches deeper than the tolerance, or through
the other, is one of the first four:
  duplicate    each lies in the other
  inside       the first lies in the second
  penetrating  two parts with an inside reach into each other
  crossing     the same with a surface
  touching     they are no farther apart than the tolerance
  apart        they are; listed if they are nearer than --clearance

Flush parts overlap by a hair after a rotation, and round ones by what their
facets leave: that is what the tolerance is for. The larger it is, the fewer
pairs fail. Parts of one IFC product are not tested against each other; --ignore
'bolt*' 'bolt*' says the same of any group.
)",
    R"(What --fail-on names:
  penetration  duplicate, penetrating and crossing
  inside       inside
  contact      everything but apart: penetration, inside and touching
  clearance    apart, and nearer than --clearance; touching is not among it
  new          of these only what is new since --previous

Examples:
  impinge clash engine.obj fixture.stl
      What clashes?
  impinge clash engine.obj fixture.stl --depth 0.01 --limit 20
      The twenty worst, and how deep they go, to a hundredth.
  impinge clash robot.ply cell.off --clearance 5 --fail-on contact,clearance
      Fail if anything touches the robot or comes nearer to it than 5 units.
  impinge clash --config clash.json --previous last.json --fail-on new
      The named tests of a configuration; fail only on what is new since the
      report last.json.
  impinge clash engine.obj fixture.stl --html report.html
      A page for the design review: open it in a browser; it needs nothing else.
  impinge clash bracket.stl plate.stl --bcf new.bcf --csv new.csv --unit mm
      The same for a BIM tool and a spreadsheet; these files are in millimetres.
  impinge clash engine.obj fixture.stl --tolerance 0.01 --regions --json r.json
      What is 0.01 deep counts as touching; every region of contact as JSON.)" +
        exit_codes("nothing that --fail-on names", "something that --fail-on names")};

const HelpPage kMotionHelp{
    R"(When the parts of an animated file clash

Runs an animation of the file (glTF, or another format with moving nodes) and
says of each two parts when they begin and cease to clash. It looks at steps of
equal length, and halves the time between two of them on which the answers
differ until it is known to a millionth of a step. Between two steps it follows
parts from pose to pose on screws, so that what passes through within one step
is found; of parts that touch at both its ends, change their shape or move
otherwise it may be missed: --frames makes steps shorter.
)",
    R"(Examples:
  impinge motion robot.glb
      When does what clash?
  impinge motion robot.glb --frames 2000 --depth none
      In finer steps, and not how deep it goes, which is faster.
  impinge motion robot.glb --html motion.html
      A page on which the motion can be played.)" +
        exit_codes("nothing that --fail-on names", "something that --fail-on names")};

const HelpPage kImpactsHelp{
    R"(What meets on the way from one state of meshes to the next, exactly

Reads files that hold the same parts, with the same triangles, at one time after
the other, as a simulation writes them. Between two of them every vertex goes on
a straight line at constant speed. Finds each vertex and face, and each two
edges, of two different parts that meet on the way, and when: no tolerance,
nothing missed, nothing made up. A time is the step, from 0, and a number from 0
to 1 within it. With --separation D finds what comes within D: nothing is
missed, nothing found that stays farther apart than D and a small tolerance.
)",
    R"(Examples:
  impinge impacts before.ply after.ply --self
      Does this mesh pass through itself on the way?
  impinge impacts 'frame_####.ply' --self --earliest
      When does it first, in frame_0001.ply, frame_0002.ply and so on?
  impinge impacts step0.obj step1.obj --separation 2mm --unit m
      What comes nearer than two millimetres?
  impinge impacts step0.obj step1.obj --json impacts.json
      Every impact between the parts, as JSON.)" +
        exit_codes("nothing meets", "something meets")};

const HelpPage kViewHelp{
    R"(A page to look at the assembly in 3D

Writes a page that shows the assembly in 3D with its parts, to be opened in a
browser; it needs no network and no other file. Nothing is tested; impinge
clash FILE... --html FILE makes such a page with the clashes.
)",
    R"(Examples:
  impinge view engine.obj fixture.stl
      Writes engine.obj.html.
  impinge view robot.ply --html robot.html
      Writes robot.html.)" +
        exit_codes("the page is written", "")};

const HelpPage kInfoHelp{
    R"(What the files hold: objects, triangles, open surfaces, warnings

Lists the objects of each file as impinge check sees them, placed in the world:
triangles, vertices, degenerate triangles (without area, exactly), whether the
surface is closed, and the bounding sphere. A surface is closed when every edge
is used by as many triangles one way as the other; corners are the same where
their coordinates are exactly equal. A solid is closed and has an inside; a
cracked part is open, but it is clear at its open edges what is inside; anything
else is a surface. Where parts are open or cross themselves is said. Warnings
tell where a format lost precision or a reader turned axes or changed units.
)",
    R"(Examples:
  impinge info engine.obj fixture.stl
      What do these files hold?
  impinge info engine.obj --json -
      The same as JSON on standard output.)" +
        exit_codes("all files were read", "", "an error or an interruption; the other files are still listed")};

const HelpPage kDevicesHelp{
    R"(The GPUs that --backend gpu and hybrid can use

Lists the devices that Vulkan knows of, the likely fastest first: graphics
processors, and programs that play one on the CPU. Vulkan is what graphics
drivers offer to programs; Debian has it in libvulkan1, and the drivers of AMD,
Intel and software in mesa-vulkan-drivers; NVIDIA's comes with its own driver.
Nothing else needs to be installed.

Each device's arithmetic is tried out at the borders of rounding. One that fails
is left out: answers are exact on every device that is used, and the same as on
the CPU.
)",
    R"(Where they are used:
  --backend gpu     the device does the work, and the CPU what cannot be decided
                    in floating point
  --backend hybrid  the device, the CPU or both, whichever was quickest before;
                    small questions stay on the CPU
  --device N|NAME   which device, by its number in the list or part of its name
  IMPINGE_DEVICE    a variable that says the same for every run)" +
        exit_codes("there is a device that can be used", "",
                   "there is none, or an error; a sentence on standard error says why")};

}  // namespace impinge::cli
