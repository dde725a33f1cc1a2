// SPDX-FileCopyrightText: The impinge authors
// SPDX-License-Identifier: MIT
#include "io/importer/threemf.hpp"

#include <Common/NMR_ErrorConst.h>
#include <Model/COM/NMR_DLLInterfaces.h>

#include <array>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <vector>

#include "io/text.hpp"

namespace impinge::importer {
namespace {

using Matrix = std::array<double, 16>;
constexpr Matrix kIdentity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// A few lines of components in components show one mesh a billion times.
constexpr std::uint32_t kMostParts = 1'000'000;
constexpr std::uint32_t kMostLevels = 200;
constexpr std::size_t kMostWarnings = 10;

struct Release {
  void operator()(NMR::PLib3MFBase* instance) const { NMR::lib3mf_release(instance); }
};
using Handle = std::unique_ptr<NMR::PLib3MFBase, Release>;

struct Failure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws with what lib3mf says of the instance unless the call succeeded.
void check(LIB3MFRESULT result, const Handle& instance) {
  if (result == 0) return;
  DWORD code = 0;
  LPCSTR message = nullptr;
  if (instance) NMR::lib3mf_getlasterror(instance.get(), &code, &message);
  throw Failure(message && *message ? message : "it gives no reason");
}

/// What a function of lib3mf makes: an instance, a number, a truth.
template <class Make>
Handle made(const Handle& by, Make make) {
  NMR::PLib3MFBase* instance = nullptr;
  check(make(by.get(), &instance), by);
  return Handle(instance);
}
template <class T, class Ask>
T asked(const Handle& of, Ask ask) {
  T value{};
  check(ask(of.get(), &value), of);
  return value;
}

/// A text that a function copies into a buffer, whose size it tells first.
template <class Ask>
std::string text(const Handle& of, Ask ask) {
  ULONG size = 0;
  check(ask(of.get(), nullptr, 0, &size), of);
  std::string result(size + 1, '\0');
  check(ask(of.get(), result.data(), static_cast<ULONG>(result.size()), &size), of);
  return result.c_str();
}

std::string name_of(const Handle& object) {
  std::string name = text(object, NMR::lib3mf_object_getnameutf8);
  return name.empty() ? text(object, NMR::lib3mf_object_getpartnumberutf8) : name;
}

/// The map of an instance that may have one, after that of what it is in.
template <class Ask>
Matrix placed(const Matrix& outer, const Handle& of, bool has_transform, Ask ask) {
  if (!has_transform) return outer;
  const auto inner = asked<NMR::MODELTRANSFORM>(of, ask);
  Matrix out = kIdentity;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) {
      double sum = column == 3 ? outer[4 * row + 3] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += outer[4 * row + k] * double{inner.m_fFields[k][column]};
      out[4 * row + column] = sum;
    }
  return out;
}

class Importer {
 public:
  Importer(const Handle& model, io::ImportWriter& writer) : model_(model), writer_(writer) {}

  void write_build() {
    const Handle items = made(model_, NMR::lib3mf_model_getbuilditems);
    while (asked<BOOL>(items, NMR::lib3mf_builditemiterator_movenext)) {
      const Handle item = made(items, NMR::lib3mf_builditemiterator_getcurrent);
      const bool has_transform = asked<BOOL>(item, NMR::lib3mf_builditem_hasobjecttransform);
      write(made(item, NMR::lib3mf_builditem_getobjectresource),
            {.world = placed(kIdentity, item, has_transform, NMR::lib3mf_builditem_getobjecttransform)});
    }
  }

 private:
  /// Where an object is shown: `name` is that of what it is part of, for those that have none.
  struct Place {
    std::uint32_t group = io::kNoNode;
    std::string path{}, name{};
    Matrix world = kIdentity;
    std::uint32_t levels = 0;
  };
  struct Shape {
    std::uint32_t mesh = io::kNoNode;  ///< nothing: it has no triangles
    std::string incomplete;
  };

  void write(const Handle& object, const Place& at) {
    const std::string own = name_of(object), name = own.empty() ? at.name : own;
    const std::string path = own.empty() ? at.path : at.path.empty() ? own : at.path + "/" + own;
    if (shown_++ == kMostParts || at.levels == kMostLevels)
      throw Failure(io::sentence("it shows more than ", kMostParts, " objects, or in more than ", kMostLevels,
                                 " levels of components"));
    if (asked<BOOL>(object, NMR::lib3mf_object_iscomponentsobject)) {
      writer_.group(own, at.group);
      const std::uint32_t number = groups_++;
      const auto count = asked<DWORD>(object, NMR::lib3mf_componentsobject_getcomponentcount);
      for (DWORD i = 0; i < count; ++i) {
        NMR::PLib3MFBase* instance = nullptr;
        check(NMR::lib3mf_componentsobject_getcomponent(object.get(), i, &instance), object);
        const Handle component(instance);
        const bool has_transform = asked<BOOL>(component, NMR::lib3mf_component_hastransform);
        const Matrix world = placed(at.world, component, has_transform, NMR::lib3mf_component_gettransform);
        write(made(component, NMR::lib3mf_component_getobjectresource), {number, path, name, world, at.levels + 1});
      }
      return;
    }
    const Shape& shape = shape_of(object, name);
    if (shape.mesh == io::kNoNode) return;
    writer_.object(name, path, {}, shape.mesh, io::kNoNode, at.group, at.world);
    if (!shape.incomplete.empty()) writer_.incomplete(shape.incomplete);
  }

  /// Each mesh is written once, however often it is shown.
  const Shape& shape_of(const Handle& object, const std::string& name) {
    const auto [place, is_new] = shapes_.try_emplace(asked<DWORD>(object, NMR::lib3mf_resource_getresourceid));
    Shape& shape = place->second;
    if (!is_new) return shape;
    if (asked<DWORD>(object, NMR::lib3mf_meshobject_getbeamcount) > 0)
      shape.incomplete = "its beam lattice is left out";
    else if (asked<DWORD>(object, NMR::lib3mf_meshobject_getslicestackid) != 0 &&
             asked<NMR::eModelSlicesMeshResolution>(object, NMR::lib3mf_meshobject_getslicesmeshresolution) ==
                 NMR::MODELSLICESMESHRESOLUTION_LOW)
      shape.incomplete = "its mesh is a coarse one, and its slices are left out";
    auto vertices = asked<DWORD>(object, NMR::lib3mf_meshobject_getvertexcount),
         triangles = asked<DWORD>(object, NMR::lib3mf_meshobject_gettrianglecount);
    if (!shape.incomplete.empty() || triangles == 0)
      writer_.missing(io::sentence("The shape of ", io::in_quotes(name), " is incomplete: ",
                                   shape.incomplete.empty() ? "it has no triangles" : shape.incomplete, "."));
    if (triangles == 0) return shape;
    std::vector<NMR::MODELMESHVERTEX> points(vertices);
    std::vector<NMR::MODELMESHTRIANGLE> corners(triangles);
    check(NMR::lib3mf_meshobject_getvertices(object.get(), points.data(), vertices, &vertices), object);
    check(NMR::lib3mf_meshobject_gettriangleindices(object.get(), corners.data(), triangles, &triangles), object);
    std::vector<double> xyz;
    std::vector<std::uint32_t> indices;
    for (const auto& point : points) xyz.insert(xyz.end(), std::begin(point.m_fPosition), std::end(point.m_fPosition));
    for (const auto& three : corners)
      indices.insert(indices.end(), std::begin(three.m_nIndices), std::end(three.m_nIndices));
    writer_.mesh(xyz, indices);
    shape.mesh = meshes_++;
    return shape;
  }

  const Handle& model_;
  io::ImportWriter& writer_;
  std::map<DWORD, Shape> shapes_;
  std::uint32_t meshes_ = 0, groups_ = 0, shown_ = 0;
};

double metres_of(DWORD unit) {
  constexpr std::array<double, 6> kMetres{1e-6, 0.001, 0.01, 0.0254, 0.3048, 1};
  return unit < kMetres.size() ? kMetres[unit] : 0.001;
}

/// What lib3mf says of the file. Of extensions that the file calls required, and that lib3mf does not know, nothing is
/// read.
void write_warnings(const Handle& reader, io::ImportWriter& writer) {
  std::set<std::string> said;
  const auto count = asked<DWORD>(reader, NMR::lib3mf_reader_getwarningcount);
  for (DWORD i = 0; i < count && said.size() < kMostWarnings; ++i) {
    DWORD code = 0;
    const std::string message = text(reader, [&](NMR::PLib3MFBase* of, LPSTR buffer, ULONG size, ULONG* needed) {
      return NMR::lib3mf_reader_getwarningutf8(of, i, &code, buffer, size, needed);
    });
    if (!said.insert(message).second) continue;
    if (code == NMR_ERROR_REQUIREDEXTENSIONNOTSUPPORTED)
      writer.missing(io::sentence("lib3mf leaves something out: ", message));
    else
      writer.warning(io::sentence("lib3mf says: ", message));
  }
}

}  // namespace

bool is_3mf(const char* file) { return io::lower_case(std::filesystem::path(file).extension().string()) == ".3mf"; }

std::string write_3mf(const char* file, io::ImportWriter& writer) try {
  NMR::PLib3MFBase* instance = nullptr;
  check(NMR::lib3mf_createmodel(&instance), {});
  const Handle model(instance);
  const Handle reader = made(
      model, [](NMR::PLib3MFBase* of, NMR::PLib3MFBase** to) { return NMR::lib3mf_model_queryreader(of, "3mf", to); });
  check(NMR::lib3mf_reader_readfromfileutf8(reader.get(), file), reader);
  write_warnings(reader, writer);
  writer.unit(metres_of(asked<DWORD>(model, NMR::lib3mf_model_getunit)));
  Importer(model, writer).write_build();
  return {};
} catch (const Failure& failure) {
  return failure.what();
}

}  // namespace impinge::importer
