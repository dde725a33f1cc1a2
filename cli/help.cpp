// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "help.hpp"

#include <algorithm>
#include <string_view>

#include "report/text.hpp"

namespace impinge::cli {
using namespace report;
namespace {

constexpr std::size_t kNarrowest = 40, kWidest = 100;

class Page {
 public:
  explicit Page(std::size_t width) : width_(std::clamp(width, kNarrowest, kWidest)) {}

  Page& paragraph(std::string_view text) {
    separate();
    text_ += wrapped(text, width_, 0) + "\n";
    return *this;
  }

  /// Entries side by side with their explanations, or above them where the terminal is narrow.
  Page& section(std::string_view heading, const std::vector<HelpEntry>& entries) {
    separate();
    text_ += std::string(heading) + "\n";
    std::size_t left = 0;
    for (const HelpEntry& entry : entries) left = std::max(left, columns(entry.left));
    for (const HelpEntry& entry : entries) add(entry, left + 4 <= width_ / 2 ? left + 4 : 0);
    return *this;
  }

  /// Command lines, each above its explanation, so that they can be copied whole.
  Page& examples(const std::vector<HelpEntry>& entries) {
    separate();
    text_ += "Examples:\n";
    for (const HelpEntry& entry : entries) add(entry, 0);
    return *this;
  }

  [[nodiscard]] std::string text() { return std::move(text_); }

 private:
  void separate() {
    if (!text_.empty()) text_ += "\n";
  }

  void add(const HelpEntry& entry, std::size_t beside) {
    constexpr std::size_t kIndentBelow = 6;
    text_ += "  " + entry.left;
    if (beside > 0) {
      text_.append(beside - 2 - columns(entry.left), ' ');
    } else {
      text_ += "\n" + std::string(kIndentBelow, ' ');
    }
    text_ += wrapped(entry.explanation, width_, beside > 0 ? beside : kIndentBelow) + "\n";
  }

  std::size_t width_;
  std::string text_;
};

const std::vector<HelpEntry> kExitCodes = {
    {"0", "nothing touches"},
    {"1", "something touches"},
    {"2", "an error or an interruption; a sentence on standard error says what and where"},
};

}  // namespace

std::string general_help(std::size_t width) {
  return Page(width)
      .paragraph(
          "impinge finds every pair of triangles that touch between the objects of mesh files, exactly: no "
          "tolerance, nothing missed, nothing made up. Triangles that share a single point touch.")
      .section("Usage:", {{"impinge check FILE...", "which objects touch, and in how many triangles"},
                          {"impinge clash FILE...",
                           "what the parts are to each other: penetrating, inside, touching, or too near"},
                          {"impinge motion FILE", "when the parts of an animated file clash"},
                          {"impinge view FILE...", "a page to look at them: the assembly in 3D and its parts"},
                          {"impinge info FILE...", "what the files hold: objects, triangles, open surfaces, warnings"},
                          {"impinge devices", "the GPUs that --backend gpu and hybrid can use"},
                          {"impinge check --help", "all about a command, with examples"},
                          {"impinge --version", "which version this is"}})
      .paragraph(
          "Files: OBJ, OFF, PLY and STL, read in double precision; glTF, GLB, 3MF, COLLADA, IFC, FBX and others "
          "through assimp. Several files make one scene, in the coordinates that they have.")
      .examples({{"impinge check engine.obj fixture.stl", "A table of the objects that touch."},
                 {"impinge clash engine.obj fixture.stl", "A table of what an engineer should look at, worst first."},
                 {"impinge info engine.obj", "Look at a file before trusting it."}})
      .section("Exit codes:", kExitCodes)
      .paragraph(
          "impinge clash ends with 1 when parts penetrate or lie inside each other, or for what --fail-on names. "
          "impinge info ends with 0 when it could read every file.")
      .text();
}

std::string check_help(const std::vector<HelpEntry>& options, std::size_t width) {
  return Page(width)
      .paragraph("impinge check FILE... [options]")
      .paragraph(
          "Reads all files as one scene and finds every pair of triangles of two different objects that share a "
          "point, within a file and between files. The table counts them for each pair of objects:")
      .section("Kinds:",
               {{"crossing", "the triangles cut through each other"},
                {"touching", "they only touch, at a corner, along an edge, or with a triangle that has no area"},
                {"coplanar", "they lie in one plane and share a point, as flush faces do"}})
      .section("Options:", options)
      .examples({{"impinge check engine.obj fixture.stl", "Which objects touch?"},
                 {"impinge check engine.obj fixture.stl --json clashes.json --triangles",
                  "The same as JSON, with every pair of triangles."},
                 {"impinge check robot.ply cell.off --first --quiet && echo free",
                  "Only yes or no, by the exit code: the fastest question."},
                 {"impinge check bracket.stl plate.stl --scale plate.stl=25.4",
                  "plate.stl is in inches, bracket.stl in millimetres."},
                 {"impinge check robot.ply cell.off --ignore 'rob*' cell", "Leave out pairs that are meant to touch."}})
      .section("Exit codes:", kExitCodes)
      .text();
}

std::string clash_help(const std::vector<HelpEntry>& options, std::size_t width) {
  return Page(width)
      .paragraph("impinge clash FILE... [options]")
      .paragraph(
          "Reads all files as one scene and says of each two parts what they are to each other, worst first. A part is "
          "a solid if its surface is closed and does not cross itself; anything else is a surface, and the report "
          "says why. The first that holds:")
      .section("Verdicts:", {{"duplicate", "both are the same set of points"},
                             {"inside", "the first lies in the second, a solid, whether their surfaces meet or not"},
                             {"penetrating", "the interiors of two solids meet"},
                             {"crossing", "a surface passes through a solid's boundary, or through a surface"},
                             {"touching", "they share points, and no more than that"},
                             {"apart", "they share no point; listed if they are nearer than --clearance"}})
      .paragraph(
          "Verdicts are exact, but for the tolerance: parts that are flush by design overlap by a hair after a "
          "rotation. A tolerance that a thin part could hide in is not applied, and a note says so. Parts of one "
          "IFC product are not tested against each other; --ignore 'bolt*' 'bolt*' says the same of any group.")
      .section("Options:", options)
      .section("What --fail-on names:", {{"penetration", "duplicate, penetrating and crossing"},
                                         {"inside", "inside"},
                                         {"contact", "everything but apart: penetration, inside and touching"},
                                         {"clearance", "apart, and nearer than --clearance; touching is not among it"},
                                         {"new", "of these only what is new since --previous"}})
      .examples({{"impinge clash engine.obj fixture.stl", "What clashes?"},
                 {"impinge clash engine.obj fixture.stl --depth --limit 20", "The twenty worst, and how deep they go."},
                 {"impinge clash robot.ply cell.off --clearance 5 --fail-on contact,clearance",
                  "Fail if anything touches the robot or comes nearer to it than 5 units."},
                 {"impinge clash --config clash.json --previous last.json --fail-on new --json this.json",
                  "The named tests of a configuration; fail only on what is new since last week's report."},
                 {"impinge clash engine.obj fixture.stl --html report.html",
                  "A page for the design review: open it in a browser; it needs nothing else."},
                 {"impinge clash bracket.stl plate.stl --bcf clashes.bcf --csv clashes.csv --unit mm",
                  "The same for a BIM tool and a spreadsheet; the files' coordinates are millimetres."},
                 {"impinge clash bracket.stl plate.stl --tolerance 0.01 --regions --json clashes.json",
                  "What overlaps by 0.01 counts as touching; every region of contact as JSON."}})
      .section("Exit codes:", {{"0", "nothing that --fail-on names"},
                               {"1", "something that --fail-on names"},
                               {"2", "an error or an interruption; a sentence on standard error says what and where"}})
      .text();
}

std::string motion_help(const std::vector<HelpEntry>& options, std::size_t width) {
  return Page(width)
      .paragraph("impinge motion FILE [options]")
      .paragraph(
          "Runs an animation of the file (glTF, or another format with moving nodes) and says of each two parts when "
          "they "
          "begin and cease to clash. It looks at steps of equal length, and halves the time between two of them on "
          "which "
          "the answers differ until it is known to a millionth of a step. What begins and ends within one step is not "
          "seen: --frames makes steps shorter.")
      .section("Options:", options)
      .examples({{"impinge motion robot.glb", "When does what clash?"},
                 {"impinge motion robot.glb --frames 2000 --depth", "In finer steps, and how deep it goes."},
                 {"impinge motion robot.glb --html motion.html", "A page on which the motion can be played."}})
      .section("Exit codes:", {{"0", "nothing clashes"},
                               {"1", "something does"},
                               {"2", "an error or an interruption; a sentence on standard error says what and where"}})
      .text();
}

std::string view_help(const std::vector<HelpEntry>& options, std::size_t width) {
  return Page(width)
      .paragraph("impinge view FILE... [options]")
      .paragraph(
          "Writes a page that shows the assembly in 3D with its parts, to be opened in a browser; it needs no network "
          "and "
          "no other file. Nothing is tested; impinge clash FILE... --html FILE makes such a page with the clashes.")
      .section("Options:", options)
      .examples({{"impinge view engine.obj fixture.stl", "Writes engine.obj.html."},
                 {"impinge view robot.ply --html robot.html", "Writes robot.html."}})
      .section("Exit codes:", {{"0", "the page is written"},
                               {"2", "an error or an interruption; a sentence on standard error says what and where"}})
      .text();
}

std::string info_help(const std::vector<HelpEntry>& options, std::size_t width) {
  return Page(width)
      .paragraph("impinge info FILE... [options]")
      .paragraph(
          "Lists the objects of each file as `check` sees them, placed in the world: triangles, vertices, "
          "degenerate triangles (without area, exactly), whether the surface is closed, and the bounding sphere. "
          "A surface is closed when every edge is used by as many triangles one way as the other; corners are "
          "the same where their coordinates are exactly equal. An object is a solid if it is closed and no two of its "
          "triangles cross or share an area; for others the first defects are named, with places. Warnings tell where "
          "a format lost precision or a reader turned axes or changed units.")
      .section("Options:", options)
      .examples({{"impinge info engine.obj fixture.stl", "What do these files hold?"},
                 {"impinge info engine.obj --json -", "The same as JSON on standard output."}})
      .section("Exit codes:",
               {{"0", "all files were read"}, {"2", "an error or an interruption; the other files are still listed"}})
      .text();
}

std::string devices_help(std::size_t width) {
  return Page(width)
      .paragraph("impinge devices")
      .paragraph(
          "Lists the devices that Vulkan knows of, the likely fastest first: graphics processors, and programs that "
          "play "
          "one on the CPU. Vulkan is what graphics drivers offer to programs; Debian has it in libvulkan1, and the "
          "drivers "
          "of AMD, Intel and software in mesa-vulkan-drivers; NVIDIA's comes with its own driver. Nothing else needs "
          "to "
          "be installed.")
      .paragraph(
          "Each device's arithmetic is tried out at the borders of rounding. One that fails is left out: answers are "
          "exact on every device that is used, and the same as on the CPU.")
      .section("Where they are used:",
               {{"--backend gpu", "the device does the work, and the CPU what cannot be decided in floating point"},
                {"--backend hybrid", "both share it, so that they end together; small questions stay on the CPU"},
                {"--device N|NAME", "which device, by its number in the list or part of its name"},
                {"IMPINGE_DEVICE", "a variable that says the same for every run"}})
      .section("Exit codes:", {{"0", "there is a device that can be used"},
                               {"2", "there is none, or an error; a sentence on standard error says why"}})
      .text();
}

}  // namespace impinge::cli
