// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <unordered_map>

#include "core/guarded.hpp"
#include "io/import_process.hpp"
#include "io/readers.hpp"

namespace impinge::io {
namespace {

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

Error system_error(const Source& source, int code) {
  return file_error(source, sentence("the file cannot be read: ", std::strerror(code)));
}

/// The size of what `status` describes, if it is a file to read.
Result<std::uint64_t> size_to_read(const struct stat& status, std::uint64_t max_bytes, const Source& source) {
  if (S_ISDIR(status.st_mode)) return file_error(source, "this is a directory; name a mesh file in it");
  if (!S_ISREG(status.st_mode)) return file_error(source, "this is no regular file; copy its contents into one");
  const auto size = static_cast<std::uint64_t>(status.st_size);
  if (size == 0) return file_error(source, "the file is empty; export it again");
  if (size > max_bytes) {
    return file_error(source, sentence("the file has ", size, " bytes, more than the limit of ", max_bytes,
                                       "; raise the limit if it is good"));
  }
  return size;
}

/// Opens a file without waiting, for a pipe may lie under its name.
Result<std::uint64_t> open_and_measure(const Descriptor& descriptor, std::uint64_t max_bytes, const Source& source) {
  struct stat status {};
  if (descriptor.number() < 0 || fstat(descriptor.number(), &status) != 0) return system_error(source, errno);
  return size_to_read(status, max_bytes, source);
}

int open_file(const std::filesystem::path& file) {
  struct stat status {};
  // Opening a device may have effects of its own.
  if (stat(file.c_str(), &status) == 0 && (S_ISCHR(status.st_mode) || S_ISBLK(status.st_mode))) {
    return open("/dev/null", O_RDONLY | O_CLOEXEC);
  }
  return open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
}

/// Whether there is a regular file that may be read, not empty and at most so large; nothing of it is read.
/// Errors: `bad_file`.
Result<void> check_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source) {
  const Descriptor descriptor(open_file(file));
  if (const auto size = open_and_measure(descriptor, max_bytes, source); !size) return size.error();
  return {};
}

/// The file's bytes, with the same checks. Copied, not mapped: a mapped file that another program cuts short ends this
/// one. Errors: `bad_file`.
Result<std::string> read_file(const std::filesystem::path& file, std::uint64_t max_bytes, const Source& source) {
  const Descriptor descriptor(open_file(file));
  const Result<std::uint64_t> size = open_and_measure(descriptor, max_bytes, source);
  if (!size) return size.error();
  std::string bytes(*size, '\0');
  std::size_t done = 0;
  while (done < *size) {
    const ssize_t count = ::read(descriptor.number(), bytes.data() + done, *size - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return system_error(source, errno);
    if (count == 0) break;  // the file has become shorter meanwhile
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

using Reader = Result<Model> (*)(std::string_view, const Source&);

/// The reader of our own for a file name's ending, or none.
Reader own_reader(const std::filesystem::path& file) {
  const std::string ending = lower_case(file.extension().string());
  if (ending == ".obj") return read_obj;
  if (ending == ".off") return read_off;
  if (ending == ".ply") return read_ply;
  if (ending == ".stl") return read_stl;
  return nullptr;
}

/// What a file is whose format no reader knows, and what to export in its place; empty for any other ending.
std::string foreign_format(const std::filesystem::path& file) {
  struct Format {
    std::initializer_list<std::string_view> endings;
    std::string_view sentence;
  };
  static const Format formats[] = {
      {{".step", ".stp", ".p21", ".iges", ".igs"},
       "this is STEP or IGES, curved surfaces without triangles; export it from the CAD program as 3MF, glTF or STL"},
      {{".rvt", ".rfa", ".rte"}, "this is a model of Revit, which it alone opens; export it there as IFC"},
      {{".nwc", ".nwd", ".nwf"},
       "this is a model of Navisworks, which it alone opens; export what it was made of as IFC, or from there as FBX"},
      {{".dwg", ".dgn"}, "this is a drawing of a CAD program; export its solids there as IFC, FBX or STL"},
      {{".ifcxml"}, "this is IFC as XML; export it as IFC in its usual form, .ifc"},
  };
  const std::string ending = lower_case(file.extension().string());
  for (const Format& format : formats)
    if (std::find(format.endings.begin(), format.endings.end(), ending) != format.endings.end())
      return std::string(format.sentence);
  return {};
}

/// Multiplies every coordinate: vertices by the formula of a pose, so that meshes stay shared and answers do not
/// depend on who scales; points of grids and the shifts of poses, nodes and tracks by
/// one product each.
Result<void> scale_model(Model& model, double scale, const Source& source) {
  std::unordered_map<const MeshState*, Mesh> scaled;
  for (Object& object : model.objects) {
    const MeshState* const key = &object.mesh.state();
    if (const auto known = scaled.find(key); known != scaled.end()) {
      object.mesh = known->second;
    } else {
      Result<Mesh> mesh = object.mesh.transformed(Affine{{scale, 0, 0, 0, scale, 0, 0, 0, scale}, {}});
      if (!mesh) return file_error(source, sentence("object '", object.name, "', scaled: ", mesh.error().message));
      scaled.emplace(key, *mesh);
      object.mesh = std::move(*mesh);
    }
    for (double& shift : object.pose.t) {
      shift *= scale;
      if (!std::isfinite(shift))
        return file_error(source, sentence("object '", object.name, "', scaled, is too far away"));
    }
  }
  const auto scale_all = [&](auto& lengths) {
    for (double& length : lengths) length *= scale;
  };
  for (Grid& grid : model.grids)
    for (GridAxis& axis : grid.axes)
      for (Point& p : axis.points) p = {scale * p.x, scale * p.y, scale * p.z};
  for (Node& node : model.nodes) scale_all(node.local.t), scale_all(node.translation);
  for (Animation& animation : model.animations)
    for (Track& track : animation.tracks)
      if (track.property == Track::Property::translation) scale_all(track.values);
  return {};
}

Result<void> bring_to_unit(Model& model, double metres, const Source& source) {
  if (!model.unit_in_metres) return {};
  const double scale = *model.unit_in_metres / metres;
  model.unit_in_metres = metres;
  // Units of files are products of several numbers, each of them rounded: where it is the same, meshes stay as they
  // are.
  constexpr double kUnitRounding = 1e-12;
  return std::abs(scale - 1) < kUnitRounding ? Result<void>() : scale_model(model, scale, source);
}

Result<Model> read_unguarded(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string label = file.string(), name = file.stem().string();
  const Source source{label, name};
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    return Error{Code::bad_option, sentence(label, ": the scale ", options.scale, " is not a positive, finite number")};
  }
  if (const Result<void> readable = check_file(file, options.max_file_bytes, source); !readable)
    return readable.error();
  if (const std::string problem = foreign_format(file); !problem.empty()) return file_error(source, problem);
  if (options.stop.stop_requested()) return Error{Code::cancelled, sentence(label, ": reading was cancelled")};
  Result<Model> model = Error{Code::bad_file, {}};
  if (const Reader reader = own_reader(file)) {
    Result<std::string> bytes = read_file(file, options.max_file_bytes, source);
    if (!bytes) return bytes.error();
    model = reader(*bytes, source);
  } else {
    model = import_file(file, source, options);
  }
  if (!model) return model;
  Result<void> scaled;
  if (options.scale != 1) {
    model->unit_in_metres.reset();
    scaled = scale_model(*model, options.scale, source);
  } else if (options.unit_in_metres) {
    scaled = bring_to_unit(*model, *options.unit_in_metres, source);
  }
  if (!scaled) return scaled.error();
  return model;
}

}  // namespace

Result<Model> read(const std::filesystem::path& file, const ReadOptions& options) {
  return guarded([&] { return read_unguarded(file, options); });
}

Result<void> bring_to_unit(Model& model, double metres, const std::filesystem::path& file) {
  const std::string label = file.string(), name = file.stem().string();
  return guarded([&] { return bring_to_unit(model, metres, Source{label, name}); });
}

}  // namespace impinge::io
