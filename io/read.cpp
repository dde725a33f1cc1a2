// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include <cmath>
#include <unordered_map>

#include "core/guarded.hpp"
#include "io/file_bytes.hpp"
#include "io/import_process.hpp"
#include "io/readers.hpp"

namespace impinge::io {
namespace {

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

/// Multiplies every coordinate: vertices by the formula of a pose, so that meshes stay shared and answers do not
/// depend on who scales; the poses' shifts by one product each.
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
  return {};
}

Result<Model> read_unguarded(const std::filesystem::path& file, const ReadOptions& options) {
  const std::string label = file.string(), name = file.stem().string();
  const Source source{label, name};
  if (!(options.scale > 0) || !std::isfinite(options.scale)) {
    return Error{Code::bad_option, sentence(label, ": the scale ", options.scale, " is not a positive, finite number")};
  }
  if (const Result<void> readable = check_file(file, options.max_file_bytes, source); !readable)
    return readable.error();
  if (options.stop.stop_requested()) return Error{Code::cancelled, sentence(label, ": reading was cancelled")};
  Result<Model> model = Error{Code::bad_file, {}};
  if (const Reader reader = own_reader(file)) {
    Result<std::string> bytes = read_file(file, options.max_file_bytes, source);
    if (!bytes) return bytes.error();
    model = reader(*bytes, source);
  } else {
    model = import_file(file, source, options);
  }
  if (!model || options.scale == 1) return model;
  if (const Result<void> scaled = scale_model(*model, options.scale, source); !scaled) return scaled.error();
  return model;
}

}  // namespace

Result<Model> read(const std::filesystem::path& file, const ReadOptions& options) {
  return guarded([&] { return read_unguarded(file, options); });
}

}  // namespace impinge::io
