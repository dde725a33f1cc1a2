// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "report/page.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>
#include <vector>

#include "report/conventions.hpp"
#include "report/encoded.hpp"
#include "report/json_writer.hpp"
#include "report/text.hpp"

namespace impinge::report {
namespace {

static_assert(std::endian::native == std::endian::little, "the page reads numbers with the lowest byte first");

constexpr std::string_view kMark = "<!-- impinge: data -->";
constexpr std::string_view kName = "report.html";

std::vector<std::filesystem::path> places_of_template(const std::string& program) {
  if (!program.empty()) return {program};
  if (const char* const named = std::getenv("IMPINGE_PAGE"); named != nullptr && *named != '\0') return {named};
  std::vector<std::filesystem::path> places;
  std::error_code unknown;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  if (!folder.empty()) {
    places.push_back(folder / kName);
    places.push_back(folder.parent_path() / "share" / "impinge" / kName);
    places.push_back(folder.parent_path().parent_path() / "page" / kName);  // this is build/PRESET/cli
  }
  places.emplace_back(IMPINGE_INSTALLED_PAGE);
  return places;
}

/// The names of the files, without their folders.
std::string title_of(const std::vector<std::string>& files) {
  std::string title;
  for (const std::string& file : files)
    title += (title.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
  return title;
}

std::string simplified(const DrawnScene& scene) {
  const std::string why =
      scene.shown > scene.asked
          ? fmt::format("with --page-triangles {} parts would lose their shape", grouped(scene.asked))
          : fmt::format("it is simplified to some {}, which --page-triangles changes", grouped(scene.asked));
  return fmt::format("the page draws {} of {}: {}; verdicts and figures are those of the full model",
                     grouped(scene.shown), counted(scene.triangles, "triangle"), why);
}

Result<void> write_scene(Sink& sink, const std::vector<std::string>& files, bool y_up, const DrawnScene& scene,
                         const std::stop_token& stop) {
  JsonDocument document(sink, stop);
  document.member("version", 1);
  document.member("title", title_of(files));
  document.member("up", y_up ? "y" : "z");
  document.member("triangles", scene.triangles);
  document.member("shown", scene.shown);
  document.member("asked", scene.asked);
  document.list("meshes", scene.meshes.size(), [&](std::size_t i) {
    return Json{{"vertices", scene.meshes[i].xyz.size() / 3}, {"triangles", scene.meshes[i].triangles.size() / 3}};
  });
  document.list("groups", scene.groups.size(), [&](std::size_t i) {
    Json group{{"name", scene.groups[i].name}};
    if (scene.groups[i].parent) group["parent"] = *scene.groups[i].parent;
    return group;
  });
  document.list("objects", scene.objects.size(), [&](std::size_t i) {
    const DrawnObject& drawn = scene.objects[i];
    Json object{{"mesh", drawn.mesh ? Json(*drawn.mesh) : Json(-1)}, {"pose", json_map({drawn.pose.R, drawn.pose.t})}};
    if (drawn.group) object["group"] = *drawn.group;
    return object;
  });
  return document.end();
}

Result<void> write_geometry(Sink& sink, const DrawnScene& scene, const std::stop_token& stop) {
  Encoded encoded(sink);
  for (const DrawnMesh& mesh : scene.meshes) {
    if (stop.stop_requested()) return interrupted();
    encoded.write(std::span<const float>(mesh.xyz));
    encoded.write(std::span<const std::uint32_t>(mesh.triangles));
  }
  encoded.finish();
  return {};
}

}  // namespace

Result<std::string> read_page_template(const std::string& named) {
  const std::vector<std::filesystem::path> places = places_of_template(named);
  std::string looked;
  for (const auto& place : places) {
    looked += (looked.empty() ? "" : ", ") + place.lexically_normal().string();
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(place, unknown)) continue;
    std::ifstream file(place, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), {}};
    if (file && text.find(kMark) != std::string::npos) return text;
    looked += " (another file)";
  }
  return Error{
      Code::bad_file,
      fmt::format("the page's program, {}, is not at {}; ./dev page builds it, the variable IMPINGE_PAGE may name "
                  "it, and every output but --html works without it",
                  kName, looked)};
}

Result<void> write_page(Sink& sink, const std::string& page_template, const Assembly& assembly,
                        const PageOptions& options, const PageBlocks& blocks, const std::stop_token& stop) {
  const Result<DrawnScene> scene = draw(assembly, options.page_triangles, stop);
  if (!scene) return scene.error();
  if (scene->shown < scene->triangles) blocks.warn(simplified(*scene));
  const std::size_t mark = page_template.find(kMark);
  sink.write(std::string_view(page_template).substr(0, mark));
  Result<void> written;
  const auto write_json = [&](std::string_view id, const auto& write) {
    sink.write(fmt::format("<script type=\"application/json\" id=\"{}\">\n", id));
    sink.in_page(true);
    written = write();
    sink.in_page(false);
    sink.write("</script>");
  };
  write_json("report", [&] { return blocks.report(sink); });
  if (!written) return written;
  sink.write("\n");
  write_json("scene",
             [&] { return write_scene(sink, assembly.files, is_y_up(assembly.files, options.y_up), *scene, stop); });
  if (!written) return written;
  sink.write("\n<script type=\"text/plain\" id=\"geometry\">\n");
  written = write_geometry(sink, *scene, stop);
  sink.write("\n</script>");
  if (written && blocks.motion) {
    sink.write("\n");
    write_json("motion", [&] { return blocks.motion(sink, *scene); });
  }
  sink.write(std::string_view(page_template).substr(mark + kMark.size()));
  return written;
}

}  // namespace impinge::report
